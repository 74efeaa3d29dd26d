// SPDX-License-Identifier: GPL-2.0-or-later
#include "machine/compile.hpp"

#include "machine/compile_cache.hpp"
#include "machine/places.hpp"
#include "machine/process.hpp"
#include "machine/temporary_folder.hpp"
#include "machine/write_file.hpp"
#include "text/comma_list.hpp"
#include "text/diagnostic.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fmt/core.h>
#include <optional>
#include <sstream>
#include <string>
#include <sys/utsname.h>
#include <thread>
#include <vector>

namespace lagen {

namespace {

namespace fs = std::filesystem;

/// The headers that every compiled model begins with, read by the compiler once and kept in the cache: KEY.hpp, which
// includes them and says how long KEY.hpp.gch is. One that does not fit is left alone and made anew.

class PrecompiledHeader {
  public:
    /// For models that are compiled by one command, in the folder of the cache; `key` tells that command, the runtime
    /// and the compiler apart from others.
    PrecompiledHeader(const std::string& cache, const std::string& key) : header_(fmt::format("{}/{}.hpp", cache, key))
    {
    }

    /// True where the precompiled header is there and whole; it then counts as used just now.
    [[nodiscard]] bool is_ready() const
    try {
        std::error_code error;
        const std::uintmax_t length = fs::file_size(header_ + ".gch", error);
        if (error || !fs::is_regular_file(header_, error) || content_of_file(header_) != text_beside(length))
            return false;
        for (const std::string& file : {header_, header_ + ".gch"})
            fs::last_write_time(file, fs::file_time_type::clock::now(), error);
        return true;
    } catch (const MachineError&) {
        return false; // it cannot be read
    }

    /// The arguments of the compiler that use it.
    [[nodiscard]] std::vector<std::string> arguments() const { return {"-include", header_}; }

    /// The arguments that make it, in the folder `scratch`, which is there.
    [[nodiscard]] static std::vector<std::string> making(const std::string& scratch)
    {
        // clang asks for the file that was read to be where it was: an empty one that every system has.
        return {"-include", precompiled, "-x", "c++-header", "/dev/null", "-o", scratch + "/precompiled.gch"};
    }

    /// Keeps what was made there; a failure is none of the command's.
    void keep(const std::string& scratch) const
    try {
        std::error_code error;
        const std::uintmax_t length = fs::file_size(scratch + "/precompiled.gch", error);
        if (!error) fs::rename(scratch + "/precompiled.gch", header_ + ".gch", error);
        if (!error) write_file(header_, text_beside(length));
    } catch (const MachineError&) {
        // The next command makes it again.
    }

    /// It is not ready any more: the compiler did not take it.
    void discard() const
    {
        std::error_code error;
        fs::remove(header_, error);
    }

  private:
    static constexpr const char* precompiled = "lagen/export_model.hpp";

    /// KEY.hpp beside a precompiled header of this length.
    static std::string text_beside(std::uintmax_t length)
    {
        return fmt::format("// precompiled in {} bytes\n#include \"{}\"\n", length, precompiled);
    }

    std::string header_; ///< the path of KEY.hpp
};

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
        throw MachineError(fmt::format("the C++ compiler '{}' (from CXX) was not found", named[0]),
                           "`run` compiles the generated header; unset CXX or name a C++20 compiler");
    }
    for (const char* candidate : {"c++", "g++", "clang++"})
        if (!find_program(candidate).empty()) return {candidate};
    throw MachineError("no C++ compiler was found (tried c++, g++, clang++)",
                       "`run` compiles the generated header; install g++ or set CXX");
}

/// The last of these options under which a compiler takes every number for finite, or sums in another order than is
/// written: checks of finiteness and compensated sums are then optimised away. Empty: none is in force.
std::string unsafe_option(const std::vector<std::string>& options)
{
    const std::vector<std::string> finite{"-ffinite-math-only"},
        order{"-funsafe-math-optimizations", "-fassociative-math"};
    std::string finite_by, order_by;
    for (const std::string& option : options) {
        const bool off = option.starts_with("-fno-");
        const std::string name = off ? "-f" + option.substr(5) : option, by = off ? "" : option;
        // Another level of optimisation takes back what -Ofast asked for.
        const bool level = option.starts_with("-O"), all = level || name == "-ffast-math";
        for (std::string* found : {&finite_by, &order_by}) {
            const bool own = std::ranges::count(found == &finite_by ? finite : order, name) > 0;
            if (level && option != "-Ofast" && *found == "-Ofast") found->clear();
            if (own || (all && (!level || option == "-Ofast"))) *found = by;
        }
    }
    return finite_by.empty() ? order_by : finite_by;
}

/// CXXFLAGS, refused where no program made with them can be trusted.
std::vector<std::string> flags_of_user()
{
    std::vector<std::string> flags = words(std::getenv("CXXFLAGS"));
    if (const std::string option = unsafe_option(flags); !option.empty())
        throw MachineError(fmt::format("CXXFLAGS holds {}, with which a program cannot see that a number is not finite "
                                       "and loses its compensated sums",
                                       option),
                           "leave it out; -O3 -march=native is as fast here");
    return flags;
}

/// The compiler with all that it is told besides its files.
std::vector<std::string> compile_command(const std::vector<std::string>& options = {})
{
    std::vector<std::string> command = find_compiler();
    command.insert(command.end(), {"-std=c++20", "-O2", "-pthread", "-I" + runtime_folder(), "-I" + program_folder(),
                                   "-isystem", eigen_folder()});
    command.insert(command.end(), options.begin(), options.end());
    for (std::string& flag : flags_of_user()) command.push_back(std::move(flag));
    return command;
}

/// Every header below folder/part, by path: a change to any of them is a new key.
void add_headers(ContentHash& hash, const std::string& folder, const char* part)
{
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(fs::path(folder) / part))
        if (entry.is_regular_file() && (entry.path().extension() == ".hpp" || entry.path().extension() == ".h"))
            files.push_back(entry.path());
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
    utsname machine{};
    if (::uname(&machine) == 0) hash.add(machine.machine); // several of them may see the same cache
}

std::string line_of(const std::vector<std::string>& command)
{
    return comma_list(command, {}, " ");
}

void require_success(const std::vector<std::string>& command, const ProcessResult& result)
{
    if (result.interrupted) throw InterruptedError("lagen: interrupted while compiling");
    if (!result.started)
        throw MachineError(fmt::format("the C++ compiler '{}' could not be started: {}", command[0], result.error));
    if (result.exit_code != 0)
        throw MachineError(fmt::format("the C++ compiler failed with exit code {}\n{}\n{}{}", result.exit_code,
                                       line_of(command), result.error, result.output));
}

/// Where a program is kept.
std::string program_path(const std::string& cache, const ProgramText& text)
{
    ContentHash hash;
    hash.add(lines_of_code(text.header, "//")).add(text.main); // a new scene or title is no new program
    hash.add(text.is_model ? "model" : "program");
    for (const std::string& library : text.libraries) hash.add(library);
    for (const std::string& option : text.options) hash.add(option);
    add_compilation(hash);
    return fmt::format("{}/{}{}", cache, hash.hex32(), text.is_model ? ".so" : "");
}

/// The compiler with all that a text asks for. States of a compiled model begin wherever malloc puts them.
std::vector<std::string> command_of(const ProgramText& text)
{
    std::vector<std::string> options = text.options;
    if (text.is_model) options.insert(options.end(), {"-fPIC", "-fvisibility=hidden", "-DEIGEN_MAX_ALIGN_BYTES=16"});
    return compile_command(options);
}

/// The precompiled header of the models that this command compiles.
PrecompiledHeader precompiled_header(const std::string& cache, const std::vector<std::string>& command)
{
    ContentHash hash;
    add_headers(hash, runtime_folder(), "lagen");
    add_compiler(hash, command);
    return {cache, hash.hex32()};
}

/// The compiler's command for a program whose files are written into `folder`, which is made.
std::vector<std::string> command_in(const std::string& folder, const ProgramText& text,
                                    const std::vector<std::string>& further)
{
    fs::create_directory(folder);
    write_file(folder + "/model.hpp", text.header);
    write_file(folder + "/main.cpp", text.main);
    std::vector<std::string> command = command_of(text);
    if (text.is_model) command.emplace_back("-shared");
    command.insert(command.end(), further.begin(), further.end());
    command.insert(command.end(), {folder + "/main.cpp", "-o", folder + "/program"});
    command.insert(command.end(), text.libraries.begin(), text.libraries.end());
    return command;
}

/// True where the compiler takes a text with these further arguments; the result is thrown away.
bool takes(const std::string& text, const std::vector<std::string>& arguments)
{
    const TemporaryFolder scratch(shared_temporary_folder(), "lagen-look");
    write_file(scratch.file("look.cpp"), text);
    std::vector<std::string> command = compile_command();
    command.insert(command.end(), {scratch.file("look.cpp"), "-o", scratch.file("look")});
    command.insert(command.end(), arguments.begin(), arguments.end());
    const ProcessResult result = run_process(command);
    if (result.interrupted) throw InterruptedError("lagen: interrupted while compiling");
    return result.exit_code == 0;
}

} // namespace

std::string lines_of_code(const std::string& text, std::string_view comment)
{
    std::istringstream stream(text);
    std::string code;
    for (std::string line; std::getline(stream, line);) {
        const std::size_t first = line.find_first_not_of(" \t\r");
        if (first != std::string::npos && line.compare(first, comment.size(), comment) != 0) code += line + '\n';
    }
    return code;
}

void add_compilation(ContentHash& hash)
{
    add_headers(hash, runtime_folder(), "lagen");
    add_headers(hash, program_folder(), ".");
    add_compiler(hash, compile_command());
}

std::vector<std::string> rounding_options()
{
    return {"-ffp-contract=off", "-fno-tree-slp-vectorize", "-DLAGEN_SAME_BITS"};
}

std::vector<std::string> vector_options()
{
#if defined(__x86_64__)
    const char* level = nullptr;
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2"))
        level = "-march=x86-64-v3";
    if (level != nullptr && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
        __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
        level = "-march=x86-64-v4";
    if (level != nullptr && words(std::getenv("CXXFLAGS")).empty()) return {level, "-O3"};
#endif
    return {};
}

std::vector<std::string> compile_programs(const std::vector<ProgramText>& programs)
{
    const std::string cache = cache_folder();
    std::vector<std::string> paths;
    std::vector<std::size_t> missing;
    for (const ProgramText& text : programs) {
        paths.push_back(program_path(cache, text));
        if (!use_cached(paths.back())) missing.push_back(paths.size() - 1);
    }
    if (missing.empty()) return paths;
    if (missing.size() > 1) write_standard_error(fmt::format("compiling {} programs\n", missing.size()));
    const TemporaryFolder scratch(cache, "build");
    std::vector<std::vector<std::string>> commands;
    std::optional<PrecompiledHeader> header; // of the models, which are compiled by one command
    std::vector<std::string> making;         // makes it beside the models, which do without it then
    for (const std::size_t k : missing) {
        if (programs[k].is_model && !header) {
            const std::vector<std::string> command = command_of(programs[k]);
            header = precompiled_header(cache, command);
            if (!header->is_ready()) {
                making = command;
                for (const std::string& argument : header->making(scratch.file(""))) making.push_back(argument);
            }
        }
        commands.push_back(
            command_in(scratch.file(std::to_string(k)), programs[k],
                       programs[k].is_model && making.empty() ? header->arguments() : std::vector<std::string>{}));
    }
    std::vector<std::vector<std::string>> all = commands;
    if (!making.empty()) all.push_back(making);
    std::vector<ProcessResult> results = run_processes(all, std::thread::hardware_concurrency());
    for (std::size_t k = 0; k < missing.size(); ++k) {
        const ProgramText& program = programs[missing[k]];
        const std::string folder = scratch.file(std::to_string(missing[k]));
        if (program.is_model && making.empty() && results[k].exit_code != 0 && !results[k].interrupted) {
            commands[k] = command_in(folder, program, {}); // it may be the precompiled header's fault
            results[k] = run_process(commands[k]);
            if (results[k].exit_code == 0) header->discard();
        }
        require_success(commands[k], results[k]);
        keep_program(folder + "/program", paths[missing[k]]);
    }
    if (!making.empty() && results.back().exit_code == 0) header->keep(scratch.file(""));
    trim_cache(cache);
    return paths;
}

bool finds_header(const std::string& header)
{
    return takes(fmt::format("#if !__has_include(<{}>)\n#error\n#endif\n", header), {"-fsyntax-only"});
}

void require_quad()
{
    const char* text =
        "extern \"C\" __float128 sqrtq(__float128);\nint main(int count, char**)\n{\n    return sqrtq(count) "
        "> 2;\n}\n";
    if (takes(text, {"-lquadmath"})) return;
    throw MachineError(fmt::format("the reference of a chart has 113 bits, and the C++ compiler '{}' makes no program "
                                   "with __float128 and libquadmath",
                                   find_compiler()[0]),
                       "g++ on x86 does; CXX names the compiler");
}

std::string build_text()
{
    ContentHash hash;
    hash.add(content_of_file("/proc/self/exe"));
    add_headers(hash, runtime_folder(), "lagen");
    add_headers(hash, program_folder(), ".");
    std::vector<std::string> question = find_compiler();
    question.emplace_back("--version");
    const std::string answer = run_process(question).output;
    return fmt::format("lagen {} ({}), {}: {}", LAGEN_VERSION, hash.hex16(), compiler_text(),
                       answer.substr(0, answer.find('\n')));
}

std::string compiler_text()
{
    std::vector<std::string> command = find_compiler();
    command.insert(command.end(), {"-std=c++20", "-O2"});
    for (const std::string& flag : words(std::getenv("CXXFLAGS"))) command.push_back(flag);
    return line_of(command);
}

} // namespace lagen
