// SPDX-License-Identifier: GPL-2.0-or-later
/// Generated text against a committed file: equality, or a unified diff. LAGEN_UPDATE_GOLDEN=1 rewrites the files.
#pragma once

#include <catch2/catch.hpp>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

namespace lagen::testing {

inline std::string read_text(const std::string& path)
{
    std::ifstream in(path, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

inline void write_text(const std::string& path, const std::string& text)
{
    std::ofstream(path, std::ios::binary) << text;
}

/// What a shell command prints, both streams, and its exit status (0: success).
struct Shell {
    std::string output;
    int status = -1;
};

inline Shell run_shell(const std::string& command)
{
    Shell shell;
    std::FILE* pipe = popen((command + " 2>&1").c_str(), "r");
    if (pipe == nullptr) return shell;
    char buffer[4096];
    for (std::size_t count = 0; (count = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;)
        shell.output.append(buffer, count);
    shell.status = pclose(pipe);
    return shell;
}

/// `path` is relative to the source tree.
inline void check_text(const std::string& path, const std::string& text)
{
    const std::string file = std::string(LAGEN_SOURCE_DIR) + "/" + path;
    if (std::getenv("LAGEN_UPDATE_GOLDEN") != nullptr) write_text(file, text);
    if (read_text(file) == text) {
        SUCCEED();
        return;
    }
    const std::string actual = std::string(LAGEN_BINARY_DIR) + "/" + path.substr(path.rfind('/') + 1) + ".actual";
    write_text(actual, text);
    FAIL(run_shell("diff -u '" + file + "' '" + actual + "'").output
         << "set LAGEN_UPDATE_GOLDEN=1 to accept the new text");
}

/// `name` is a file of tests/golden.
inline void check_golden(const std::string& name, const std::string& text)
{
    check_text("tests/golden/" + name, text);
}

} // namespace lagen::testing
