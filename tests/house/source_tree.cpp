// SPDX-License-Identifier: GPL-2.0-or-later
#include "source_tree.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>

namespace lagen::house {

namespace {

namespace fs = std::filesystem;

SourceText read_lines(const fs::path& root, const fs::path& file)
{
    SourceText text{fs::relative(file, root).generic_string(), {}};
    std::ifstream stream(file);
    for (std::string line; std::getline(stream, line);) text.lines.push_back(line);
    return text;
}

bool is_text(const fs::path& file)
{
    static const std::set<std::string> others{".png", ".svg", ".pdf", ".json", ".csv", ".pyc"};
    return !others.contains(file.extension().string());
}

} // namespace

std::vector<SourceText> read_tree(const std::vector<std::string>& folders)
{
    const fs::path root = LAGEN_SOURCE_DIR;
    std::vector<SourceText> texts;
    for (const std::string& folder : folders) {
        if (folder.empty()) {
            for (const auto& entry : fs::directory_iterator(root))
                if (entry.is_regular_file() && is_text(entry.path())) texts.push_back(read_lines(root, entry.path()));
        } else if (fs::is_directory(root / folder)) {
            for (const auto& entry : fs::recursive_directory_iterator(root / folder))
                if (entry.is_regular_file() && is_text(entry.path())) texts.push_back(read_lines(root, entry.path()));
        }
    }
    std::sort(texts.begin(), texts.end(), [](const SourceText& a, const SourceText& b) { return a.path < b.path; });
    return texts;
}

std::vector<SourceText> cpp_files(const std::vector<SourceText>& texts)
{
    std::vector<SourceText> found;
    for (const SourceText& text : texts)
        if (text.path.ends_with(".hpp") || text.path.ends_with(".cpp")) found.push_back(text);
    return found;
}

std::vector<Include> includes_of(const SourceText& text)
{
    static const std::regex pattern(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"].*)");
    std::vector<Include> includes;
    for (std::size_t k = 0; k < text.lines.size(); ++k) {
        std::smatch match;
        if (text.lines[k].find("include") == std::string::npos) continue;
        if (std::regex_match(text.lines[k], match, pattern)) includes.push_back({match[2], match[1] == "\"", k + 1});
    }
    return includes;
}

std::string room_of(const std::string& path)
{
    const fs::path parts(path);
    std::vector<std::string> names;
    for (const fs::path& part : parts) names.push_back(part.string());
    if (path.starts_with("runtime/program/")) return "program";
    if (names.empty() || names[0] != "generator") return names.empty() ? "" : names[0];
    if (names.size() > 2) return names[1];
    const std::string stem = parts.stem().string();
    if (stem == "lagen") return "commands";
    return stem;
}

const Arrows& planned_arrows()
{
    static const Arrows arrows{
        {"text", {}},
        {"expression", {"text"}},
        {"symbolic", {"expression"}},
        {"graph", {"expression"}},
        {"geometry", {"graph"}},
        {"model", {"geometry"}},
        {"proof", {"graph"}},
        {"typeset", {"expression"}},
        {"emit", {"graph"}},
        {"mechanics", {"geometry"}},
        {"verify", {"mechanics", "proof", "symbolic"}},
        {"advice", {"verify"}},
        {"analysis", {"verify"}},
        {"elaborate", {"model", "mechanics", "symbolic", "proof"}},
        {"equations", {"model", "analysis", "symbolic", "typeset"}},
        {"kernels", {"model", "mechanics", "verify"}},
        {"least", {"kernels", "analysis"}},
        {"pipeline", {"elaborate", "equations", "kernels", "advice", "emit"}},
        {"linear", {}},
        {"methods", {"program"}},
        {"machine", {"text", "program"}},
        {"scene", {"pipeline", "methods", "linear", "machine"}},
        {"reduction", {"pipeline", "least"}},
        {"commands", {"scene", "reduction"}},
        {"runtime", {}},
        {"program", {"runtime"}},
    };
    return arrows;
}

const Arrows& planned_folder_arrows()
{
    static const Arrows arrows{
        {"graph/core", {}},
        {"graph/calculus", {"graph/core"}},
        {"graph/unknowns", {"graph/calculus"}},
        {"graph/elimination", {"graph/calculus"}},
        {"graph/simplify", {"graph/elimination"}},
        {"graph/series", {"graph/unknowns"}},
        {"graph/terms", {"graph/core"}},
        {"graph", {"graph/simplify", "graph/series"}},
        {"commands/line", {}},
        {"commands/report", {"commands/line"}},
        {"commands/plot", {"commands/report"}},
        {"commands/chart", {"commands/line"}},
        {"commands/sweep", {"commands/report"}},
        {"commands", {"commands/plot", "commands/chart", "commands/sweep"}},
    };
    return arrows;
}

std::string folder_of(const std::string& path)
{
    const std::string room = room_of(path);
    if (!planned_folder_arrows().contains(room)) return "";
    const std::size_t start = path.find(room + "/"); // lagen.cpp stands beside its room
    const std::size_t end = start == std::string::npos ? start : path.find('/', start + room.size() + 1);
    return end == std::string::npos ? room : path.substr(start, end - start);
}

std::set<std::string> reachable_rooms(const Arrows& arrows, const std::string& room)
{
    std::set<std::string> reached;
    std::vector<std::string> open{room};
    while (!open.empty()) {
        const std::string next = open.back();
        open.pop_back();
        if (!reached.insert(next).second) continue;
        if (const auto found = arrows.find(next); found != arrows.end())
            open.insert(open.end(), found->second.begin(), found->second.end());
    }
    return reached;
}

} // namespace lagen::house
