// SPDX-License-Identifier: GPL-2.0-or-later
/// A program on generated headers: lagen writes the headers, the system compiler the program, and its output is read.
#pragma once

#include "support/golden.hpp"

#include <filesystem>
#include <map>
#include <sstream>
#include <unistd.h>
#include <vector>

namespace lagen::testing {

/// How a program is compiled. What it includes `first` is read once for all that are compiled alike.
struct Compilation {
    std::string first, level = "-O1", compiler = std::getenv("CXX") == nullptr ? "c++" : std::getenv("CXX");
    std::string programs = "programs/"; ///< the folder of tests/compile that it is in
};
inline const Compilation as_others{"lagen/lagen.hpp"}, as_for_a_user{""},
    quickly{"", "-O0", "clang++"}; ///< many methods are instantiated, and little is computed

/// A folder of headers that were read, removed when the test program ends.
class HeadersRead {
  public:
    HeadersRead() = default;
    ~HeadersRead()
    {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }
    HeadersRead(const HeadersRead&) = delete;
    HeadersRead& operator=(const HeadersRead&) = delete;

    /// The header that includes `first`, read by this command.
    [[nodiscard]] const std::string& read_by(const std::string& command, const std::string& first)
    {
        std::string& header = headers_[command + first];
        if (!header.empty()) return header;
        std::filesystem::create_directories(folder_);
        header = folder_ + "/" + std::to_string(headers_.size()) + ".hpp";
        write_text(header, "#include \"" + first + "\"\n");
        const Shell read = run_shell(command + " -x c++-header '" + header + "' -o '" + header + ".gch'");
        INFO(read.output);
        REQUIRE(read.status == 0);
        return header;
    }

  private:
    std::string folder_ = std::string(LAGEN_BINARY_DIR) + "/compiled/headers_" + std::to_string(::getpid());
    std::map<std::string, std::string> headers_;
};

/// Compiles a file with all warnings as errors.
inline void compile(const std::string& options, const Compilation& how, const std::string& file,
                    const std::string& folder, const std::string& output)
{
    static HeadersRead headers;
    const std::string source = LAGEN_SOURCE_DIR;
    const std::string command = how.compiler + " -std=c++20 " + how.level +
                                " -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror -I'" +
                                source + "/runtime/include' -I'" + source +
                                "/tests' $(pkg-config --cflags eigen3 | sed s/-I/-isystem/) " + options;
    const std::string read = how.first.empty() ? "" : " -include '" + headers.read_by(command, how.first) + "'";
    const Shell build = run_shell(command + read + " -I'" + folder + "' '" + file + "' -o '" + output + "'");
    INFO(build.output);
    REQUIRE(build.status == 0);
}

/// Generates a header of every model (paths from the root of the sources) with `options`, compiles NAME.cpp of
/// tests/compile/programs, runs it: what it prints.
inline std::string run_on_headers(const std::string& name, const std::vector<std::string>& models,
                                  const std::string& options = "", const Compilation& how = as_others)
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
    compile("", how, source + "/tests/compile/" + how.programs + name + ".cpp", folder, folder + "/program");
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
