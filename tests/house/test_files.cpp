// SPDX-License-Identifier: GPL-2.0-or-later
/// What every file keeps to: its licence, its size, and no trace of the machine on which it was written.
#include "source_tree.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdio>
#include <iostream>

using namespace lagen::house;

namespace {

constexpr std::size_t largest_allowed = 600;

const std::vector<std::string>& hand_written()
{
    static const std::vector<std::string> folders{"",       "generator", "runtime", "models", "tests",
                                                  "python", "scripts",   "cmake",   "docs",   ".ci"};
    return folders;
}

bool is_script(const SourceText& text)
{
    return !text.lines.empty() && text.lines[0].starts_with("#!");
}

/// The licence that a file must name, or "" where none is asked.
std::string licence_of(const SourceText& text)
{
    const bool cpp = text.path.ends_with(".hpp") || text.path.ends_with(".cpp");
    if (text.path.starts_with("runtime/") || text.path.starts_with("generated/")) return cpp ? "MIT" : "";
    return cpp || is_script(text) ? "GPL-2.0-or-later" : "";
}

} // namespace

TEST_CASE("every C++ file and script names its licence in its first lines")
{
    std::vector<std::string> folders = hand_written();
    folders.push_back("generated");
    std::size_t checked = 0;
    for (const SourceText& text : read_tree(folders)) {
        const std::string licence = licence_of(text);
        if (licence.empty() || text.path.starts_with("tests/consumer/") || text.path.starts_with("tests/golden/"))
            continue;
        INFO(text.path);
        REQUIRE(text.lines.size() > 1);
        CHECK(text.lines[is_script(text) ? 1 : 0].ends_with("SPDX-License-Identifier: " + licence));
        ++checked;
    }
    CHECK(checked > 40);
}

TEST_CASE("no hand-written file is longer than 600 lines")
{
    for (const SourceText& text : read_tree(hand_written())) {
        if (text.path.starts_with("tests/golden/") || text.path == "docs/messages.md" || text.path == "docs/gallery.md")
            continue; // generated
        INFO(text.path << " has " << text.lines.size() << " lines");
        CHECK(text.lines.size() <= largest_allowed);
    }
}

TEST_CASE("no file names a folder of the machine on which it was written")
{
    std::vector<std::string> folders = hand_written();
    folders.insert(folders.end(), {"generated", "LICENSES"});
    // Written in two parts, so that this file keeps to its own rule.
    const std::vector<std::string> prefixes{"/ho"
                                            "me/",
                                            "/wo"
                                            "rk/",
                                            "/ro"
                                            "ot/",
                                            "/Us"
                                            "ers/"};
    for (const SourceText& text : read_tree(folders))
        for (std::size_t k = 0; k < text.lines.size(); ++k)
            for (const std::string& prefix : prefixes) {
                const bool found = text.lines[k].find(prefix) != std::string::npos;
                if (found) UNSCOPED_INFO(text.path << ":" << k + 1 << ": " << text.lines[k]);
                CHECK_FALSE(found);
            }
}

TEST_CASE("the median file of the generator and the runtime has fewer than 200 lines")
{
    std::map<std::string, std::vector<std::pair<std::size_t, std::string>>> rooms;
    std::vector<std::size_t> all;
    for (const SourceText& text : cpp_files(read_tree({"generator", "runtime"}))) {
        rooms[room_of(text.path)].emplace_back(text.lines.size(), text.path);
        all.push_back(text.lines.size());
    }
    REQUIRE(!all.empty());
    std::printf("%-12s %5s %6s %7s  largest\n", "room", "files", "lines", "median");
    for (auto& [room, files] : rooms) {
        std::sort(files.begin(), files.end());
        std::size_t lines = 0;
        for (const auto& file : files) lines += file.first;
        std::printf("%-12s %5zu %6zu %7zu  %zu %s\n", room.c_str(), files.size(), lines, files[files.size() / 2].first,
                    files.back().first, files.back().second.c_str());
    }
    std::fflush(stdout);
    std::sort(all.begin(), all.end());
    CHECK(all[all.size() / 2] < 200);
}
