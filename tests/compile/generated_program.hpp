// SPDX-License-Identifier: GPL-2.0-or-later
/// A program on generated headers: lagen writes the headers, the system compiler the program, and its output is read.
#pragma once

#include "support/golden.hpp"

#include <filesystem>
#include <map>
#include <sstream>
#include <vector>

namespace lagen::testing {

/// Generates a header of every model (paths from the root of the sources) with `options`, compiles
/// NAME.cpp of `programs`, a folder of tests/compile, with all warnings as errors, runs it: what it prints.
inline std::string run_on_headers(const std::string& name, const std::vector<std::string>& models,
                                  const std::string& options = "", const std::string& programs = "programs/")
{
    const std::string source = LAGEN_SOURCE_DIR;
    const std::string folder = std::string(LAGEN_BINARY_DIR) + "/compiled/" + name;
    std::filesystem::create_directories(folder);
    for (const std::string& model : models) {
        const std::string header = folder + "/" + std::filesystem::path(model).stem().string() + ".hpp";
        const Shell generated = run_shell("'" LAGEN_PROGRAM "' generate '" + source + "/" + model + "' " + options +
                                          " -o '" + header + "'");
        INFO(generated.output);
        REQUIRE(generated.status == 0);
    }
    const char* chosen = std::getenv("CXX");
    const Shell build =
        run_shell(std::string(chosen == nullptr ? "c++" : chosen) +
                  " -std=c++20 -O1 -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror -I'" +
                  folder + "' -I'" + source + "/runtime/include' -I'" + source +
                  "/tests' $(pkg-config --cflags eigen3 | sed s/-I/-isystem/) '" + source + "/tests/compile/" +
                  programs + name + ".cpp' -o '" + folder + "/program'");
    INFO(build.output);
    REQUIRE(build.status == 0);
    const Shell run = run_shell("'" + folder + "/program'");
    REQUIRE(run.status == 0);
    return run.output;
}

/// Lines "KEY WORD REST" as words, by "KEY WORD".
inline std::map<std::string, std::vector<std::string>> lines_by_key(const std::string& text)
{
    std::map<std::string, std::vector<std::string>> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line);
        std::string first, second;
        words >> first >> second;
        auto& rest = lines[first + " " + second];
        for (std::string word; words >> word;) rest.push_back(word);
    }
    return lines;
}

} // namespace lagen::testing
