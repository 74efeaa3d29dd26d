// SPDX-License-Identifier: GPL-2.0-or-later
/// fork and exec, with both streams in files: no pipe can fill up and no shell is in between.
#include "program.hpp"

#include "support/golden.hpp"
#include "support/json.hpp"
#include "support/precompiled.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace lagen::testing {

namespace {

namespace fs = std::filesystem;

/// Removed when the test program ends.
class Root {
  public:
    Root() : path_((fs::temp_directory_path() / "lagen-commands-XXXXXX").string())
    {
        if (::mkdtemp(path_.data()) == nullptr) std::abort();
        for (const char* name : {"cache", "tmp", "models", "home", "headers"}) fs::create_directory(path_ + "/" + name);
    }
    ~Root()
    {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    Root(const Root&) = delete;
    Root& operator=(const Root&) = delete;

    [[nodiscard]] std::string file(const std::string& name) const { return path_ + "/" + name; }
    [[nodiscard]] std::string next(const char* stem) { return file(stem + std::to_string(++count_)); }

  private:
    std::string path_;
    int count_ = 0;
};

Root& root()
{
    static Root one;
    return one;
}

const PrecompiledHeaders& headers()
{
    static const PrecompiledHeaders read(root().file("headers"));
    return read;
}

/// For a call; the compiler finds read what the call will compile, if it compiles. Of a run the compiler takes longer
/// than the program, of many it does not.
CompilerChoice compiler_for(const std::vector<std::string>& arguments, const Surroundings& around)
{
    const std::string command = arguments.empty() ? "" : arguments[0];
    const auto asks = [&](const char* option) { return std::ranges::find(arguments, option) != arguments.end(); };
    const bool measures = (command == "chart" && !asks("--stability")) || asks("--accuracy"),
               sweeps = command == "sweep";
    CompilerChoice choice{"clang++", sweeps || around.long_runs ? "-O1" : "-O0"};
    if (measures) choice = {"c++", "-Og"};
    if (measures) headers().read_for_charts(choice);
    if (sweeps || command == "run" || (command == "chart" && !measures)) headers().read_for_runs(choice);
    if (command == "run") headers().read_for_models(choice);
    return choice;
}

void redirect(int stream, const std::string& path)
{
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (file < 0 || ::dup2(file, stream) < 0) ::_exit(99);
    ::close(file);
}

void set_environment(const CompilerChoice& choice, const Surroundings& around)
{
    ::setenv("LAGEN_CACHE", root().file("cache").c_str(), 1);
    ::setenv("TMPDIR", root().file("tmp").c_str(), 1);
    ::setenv("HOME", root().file("home").c_str(), 1);
    ::setenv("CXXFLAGS", headers().flags(choice).c_str(), 1);
    ::setenv("CXX", choice.compiler.c_str(), 1);
    for (const char* name : {"XDG_CACHE_HOME", "LAGEN_INCLUDE", "LAGEN_MODELS", "LAGEN_EIGEN_INCLUDE"})
        ::unsetenv(name);
    for (const auto& [name, value] : around.environment)
        value.empty() ? ::unsetenv(name.c_str()) : ::setenv(name.c_str(), value.c_str(), 1);
}

[[noreturn]] void become_lagen(const std::vector<std::string>& arguments, const CompilerChoice& choice,
                               const Surroundings& around, const Started& started)
{
    set_environment(choice, around);
    redirect(STDOUT_FILENO, around.output.empty() ? started.out : around.output);
    redirect(STDERR_FILENO, started.err);
    if (around.output_closed) ::close(STDOUT_FILENO);
    if (around.error_closed) ::close(STDERR_FILENO);
    if (::chdir(around.folder.empty() ? models_folder().c_str() : around.folder.c_str()) != 0) ::_exit(98);
    if (around.largest_file > 0) {
        const rlimit limit{static_cast<rlim_t>(around.largest_file), static_cast<rlim_t>(around.largest_file)};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    std::vector<char*> pointers{const_cast<char*>("lagen")};
    for (const std::string& argument : arguments) pointers.push_back(const_cast<char*>(argument.c_str()));
    pointers.push_back(nullptr);
    ::execv(around.program.empty() ? LAGEN_PROGRAM : around.program.c_str(), pointers.data());
    ::_exit(97);
}

} // namespace

Started start_call(const std::vector<std::string>& arguments, const Surroundings& around)
{
    (void)models_folder();
    const CompilerChoice choice = compiler_for(arguments, around);
    Started started{0, root().next("out"), root().next("err")};
    started.process = ::fork();
    if (started.process == 0) become_lagen(arguments, choice, around, started);
    return started;
}

Outcome finish(const Started& started)
{
    int status = 0;
    ::waitpid(started.process, &status, 0);
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    const Outcome outcome{code, read_text(started.out), read_text(started.err)};
    CHECK(names_in(temporary_folder()).empty()); // whatever happened, nothing is left behind
    return outcome;
}

Outcome call(const std::vector<std::string>& arguments, const Surroundings& around)
{
    return finish(start_call(arguments, around));
}

Outcome done(const std::vector<std::string>& arguments, const Surroundings& around)
{
    Outcome outcome = call(arguments, around);
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    return outcome;
}

json::Value report_of(const char* command, std::vector<std::string> arguments, int code, const Surroundings& around)
{
    arguments.insert(arguments.begin(), command);
    arguments.insert(arguments.end(), {"--format", "json"});
    const Outcome outcome = call(arguments, around);
    INFO(outcome.err);
    REQUIRE(outcome.code == code);
    return json::parse(outcome.out);
}

json::Value finished_run(std::vector<std::string> arguments)
{
    json::Value value = report_of("run", std::move(arguments));
    REQUIRE(value["status"].text == "ok");
    return value;
}

std::map<std::string, double> last_columns(const json::Value& run)
{
    std::map<std::string, double> row;
    for (std::size_t k = 0; k < run["columns"].size(); ++k)
        row[run["columns"][k].text] = std::stod(run["rows"].entries.back()[k].text);
    return row;
}

std::vector<double> last_row(std::vector<std::string> arguments)
{
    const json::Value run = finished_run(std::move(arguments));
    std::vector<double> row;
    for (const json::Value& entry : run["rows"].entries.back().entries)
        row.push_back(static_cast<double>(entry.number()));
    return row;
}

std::string fresh_folder()
{
    const std::string folder = root().next("folder");
    fs::create_directory(folder);
    return folder;
}

std::string written_file(const std::string& name, const std::string& text)
{
    const std::string path = fresh_folder() + "/" + name;
    std::ofstream(path, std::ios::binary) << text;
    return path;
}

const std::string& models_folder()
{
    static const std::string folder = [] {
        const std::string made = root().file("models");
        for (const char* from : {"/models", "/tests/commands/models"})
            for (const fs::directory_entry& entry : fs::directory_iterator(LAGEN_SOURCE_DIR + std::string(from)))
                fs::copy(entry.path(), fs::path(made) / entry.path().filename(), fs::copy_options::recursive);
        return made;
    }();
    return folder;
}

std::vector<std::string> example_models()
{
    std::vector<std::string> names;
    for (const std::string& name : names_in(LAGEN_SOURCE_DIR "/models"))
        if (name.ends_with(".toml")) names.push_back(name.substr(0, name.size() - 5));
    return names;
}

std::vector<std::string> names_in(const std::string& folder)
{
    std::vector<std::string> names;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

const std::string& temporary_folder()
{
    static const std::string folder = root().file("tmp");
    return folder;
}

} // namespace lagen::testing
