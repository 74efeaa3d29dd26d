// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/compile.hpp"

#include "commands/compile_cache.hpp"
#include "commands/places.hpp"
#include "commands/process.hpp"
#include "commands/temporary_folder.hpp"
#include "commands/write_file.hpp"
#include "diagnostic.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <sstream>

namespace lagen {

namespace {

namespace fs = std::filesystem;

std::vector<std::string> words(const char* text)
{
    std::istringstream stream(text == nullptr ? "" : text);
    std::vector<std::string> list;
    for (std::string word; stream >> word;) list.push_back(word);
    return list;
}

/// The compiler with its own arguments; the program is found in PATH.
std::vector<std::string> find_compiler()
{
    std::vector<std::string> named = words(std::getenv("CXX"));
    if (!named.empty()) {
        if (!find_program(named[0]).empty()) return named;
        throw MachineError(fmt::format(
            "error: the C++ compiler '{}' (from CXX) was not found\nhint: `run` compiles the generated header; "
            "unset CXX or name a C++20 compiler",
            named[0]));
    }
    for (const char* candidate : {"c++", "g++", "clang++"})
        if (!find_program(candidate).empty()) return {candidate};
    throw MachineError("error: no C++ compiler was found (tried c++, g++, clang++)\nhint: `run` compiles the generated "
                       "header; install g++ or set CXX");
}

/// The compiler with all that it is told besides its files.
std::vector<std::string> compile_command()
{
    std::vector<std::string> command = find_compiler();
    command.insert(command.end(), {"-std=c++20", "-O2", "-pthread", "-I" + runtime_folder(), "-I" + program_folder(),
                                   "-isystem", eigen_folder()});
    for (const std::string& flag : words(std::getenv("CXXFLAGS"))) command.push_back(flag);
    return command;
}

/// The lines that are not comments alone: a new scene or title is no new program.
std::string code_of(const std::string& header)
{
    std::istringstream stream(header);
    std::string code;
    for (std::string line; std::getline(stream, line);) {
        const std::size_t first = line.find_first_not_of(' ');
        if (first != std::string::npos && line.compare(first, 2, "//") != 0) code += line + '\n';
    }
    return code;
}

/// Every header below folder/part, by path: a change to any of them is a new key.
void add_headers(ContentHash& hash, const std::string& folder, const char* part)
{
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(fs::path(folder) / part))
        if (entry.is_regular_file() && entry.path().extension() == ".hpp") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files)
        hash.add(file.lexically_relative(folder).string()).add(content_of_file(file.string()));
}

void add_compiler(ContentHash& hash, const std::vector<std::string>& command)
{
    std::error_code ignored;
    const fs::path program = fs::canonical(find_program(command[0]), ignored);
    hash.add(program.string()).add(std::to_string(fs::file_size(program, ignored)));
    hash.add(std::to_string(fs::last_write_time(program, ignored).time_since_epoch().count()));
    for (const std::string& word : command) hash.add(word);
}

void call_compiler(std::vector<std::string> command, const std::string& source, const std::string& program)
{
    command.insert(command.end(), {source, "-o", program});
    const ProcessResult result = run_process(command);
    if (result.interrupted) throw Error(ExitCode::interrupted, "lagen: interrupted while compiling");
    if (!result.started)
        throw MachineError(
            fmt::format("error: the C++ compiler '{}' could not be started: {}", command[0], result.error));
    if (result.exit_code == 0) return;
    std::string line;
    for (const std::string& word : command) line += (line.empty() ? "" : " ") + word;
    throw MachineError(fmt::format("error: the C++ compiler failed with exit code {}\n{}\n{}{}", result.exit_code, line,
                                   result.error, result.output));
}

} // namespace

void add_compilation(ContentHash& hash)
{
    add_headers(hash, runtime_folder(), "lagen");
    add_headers(hash, program_folder(), ".");
    add_compiler(hash, compile_command());
}

Compiled compile_program(const std::string& header, const std::string& main)
{
    ContentHash hash;
    hash.add(code_of(header)).add(main);
    add_compilation(hash);

    const std::string cache = cache_folder();
    Compiled compiled{fmt::format("{}/{}", cache, hash.hex32()), true, 0};
    if (use_cached(compiled.program)) return compiled;
    const auto start = std::chrono::steady_clock::now();
    const TemporaryFolder scratch(cache, "build");
    write_file(scratch.file("model.hpp"), header);
    write_file(scratch.file("main.cpp"), main);
    call_compiler(compile_command(), scratch.file("main.cpp"), scratch.file("program"));
    // Renamed into place whole: two runs at once may both compile, neither sees half a program.
    std::error_code error;
    fs::rename(scratch.file("program"), compiled.program, error);
    if (error) throw MachineError(fmt::format("error: cannot write '{}': {}", compiled.program, error.message()));
    trim_cache(cache);
    compiled.cached = false;
    compiled.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return compiled;
}

} // namespace lagen
