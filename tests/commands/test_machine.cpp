// SPDX-License-Identifier: GPL-2.0-or-later
/// What the machine may lack: a compiler, room on a disk, somebody who reads, patience.
#include "program.hpp"

#include "activity.hpp"
#include "commands/machine/activity_watch.hpp"
#include "support/golden.hpp"

#include <catch2/catch.hpp>

#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <pty.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

using namespace lagen::testing;
namespace fs = std::filesystem;

namespace {

const std::vector<std::string> short_run{"run", "oscillator.toml", "--at", "1"};

/// An executable shell script.
std::string script(const std::string& body)
{
    const std::string path = fresh_folder() + "/compiler";
    write_text(path, "#!/bin/sh\n" + body);
    fs::permissions(path, fs::perms::owner_all);
    return path;
}

/// A compiler whose programs report success and do nothing else, and which counts its calls in `witness`.
std::string quick_compiler(const std::string& witness)
{
    return script("echo called >>" + witness + R"(
while [ "$1" != -o ]; do shift; done
cat >"$2" <<'END'
#!/bin/sh
while [ "$1" != --report ]; do shift; done
echo status=ok >"$2"
END
chmod +x "$2"
)");
}

/// True where a process whose command line holds `word` is alive.
bool alive(const std::string& word)
{
    for (const fs::directory_entry& entry : fs::directory_iterator("/proc")) {
        const std::string line = read_text(entry.path().string() + "/cmdline");
        if (line.find(word) != std::string::npos) return true;
    }
    return false;
}

} // namespace

TEST_CASE("a second run compiles nothing, whatever changes in comments and numbers; another compiler is another key")
{
    const std::string witness = fresh_folder() + "/called";
    const Surroundings counted{.environment = {{"CXX", quick_compiler(witness)}}};
    CHECK(call(short_run, counted).code == 0);
    CHECK(read_text(witness) == "called\n");
    CHECK(call(short_run, counted).code == 0);
    const std::string folder = fresh_folder();
    write_text(folder + "/oscillator.toml",
               "title = \"Another title\"\n" + read_text(models_folder() + "/oscillator.toml"));
    CHECK(
        call({"run", "oscillator.toml", "--t-end", "7"}, {.environment = counted.environment, .folder = folder}).code ==
        0);
    CHECK(read_text(witness) == "called\n");
    for (const char* setting : {"g=9.81", "g=1", "m=2"})
        CHECK(call({"run", "pendulum.toml", "--set", setting}, counted).code == 0);
    CHECK(read_text(witness) == "called\ncalled\n");
    CHECK(call({"run", "oscillator.toml", "--method", "tsit5"}, counted).code == 0);
    CHECK(read_text(witness) == "called\ncalled\ncalled\n");
    const std::string other = fresh_folder() + "/called";
    CHECK(call(short_run, {.environment = {{"CXX", quick_compiler(other)}}}).code == 0);
    CHECK(read_text(other) == "called\n");
}

TEST_CASE("CXXFLAGS is part of the key and reaches the compiler", "[run]")
{
    REQUIRE(call(short_run).code == 0);
    const Outcome outcome = call(short_run, {.environment = {{"CXXFLAGS", "--no-such-flag"}}});
    CHECK(outcome.code == 5);
    CHECK(outcome.err.find("--no-such-flag") != std::string::npos);
}

TEST_CASE("without a compiler the run says which was looked for")
{
    const Outcome named = call(short_run, {.environment = {{"CXX", "/nonexistent"}}});
    CHECK(named.code == 5);
    CHECK(named.out.empty());
    CHECK(named.err == "error: the C++ compiler '/nonexistent' (from CXX) was not found\n"
                       "hint: `run` compiles the generated header; unset CXX or name a C++20 compiler\n");
    const Outcome none = call(short_run, {.environment = {{"PATH", "/nonexistent"}}});
    CHECK(none.code == 5);
    CHECK(none.err == "error: no C++ compiler was found (tried c++, g++, clang++)\n"
                      "hint: `run` compiles the generated header; install g++ or set CXX\n");
}

TEST_CASE("a compiler that fails is quoted, and leaves nothing in the cache")
{
    const std::string cache = fresh_folder();
    const Outcome outcome = call(
        short_run, {.environment = {{"CXX", script("echo 'it is broken' >&2\nexit 3\n")}, {"LAGEN_CACHE", cache}}});
    CHECK(outcome.code == 5);
    CHECK(outcome.out.empty());
    CHECK_THAT(outcome.err, Catch::StartsWith("error: the C++ compiler failed with exit code 3\n"));
    CHECK_THAT(outcome.err, Catch::EndsWith("\nit is broken\n"));
    CHECK(names_in(cache).empty());
    const Outcome silent = call(short_run, {.environment = {{"CXX", "true"}, {"LAGEN_CACHE", cache}}});
    CHECK(silent.code == 5);
    CHECK_THAT(silent.err, Catch::StartsWith("error: cannot write '" + cache + "/"));
    CHECK(names_in(cache).empty());
}

TEST_CASE("a cache that cannot be used is replaced by the next place")
{
    const std::string home = fresh_folder();
    const std::string compiler = quick_compiler(home + "/called");
    const Outcome outcome =
        call(short_run, {.environment = {{"LAGEN_CACHE", "/dev/null/cache"}, {"HOME", home}, {"CXX", compiler}}});
    CHECK(outcome.code == 0);
    CHECK(names_in(home + "/.cache/lagen").size() == 2); // the program and its record
}

TEST_CASE("the cache forgets what was used longest ago")
{
    const std::string cache = fresh_folder();
    for (int k = 0; k < 205; ++k) {
        char name[40];
        std::snprintf(name, sizeof name, "%032x", k);
        write_text(cache + "/" + name, "old");
        fs::last_write_time(cache + "/" + name, fs::file_time_type::clock::now() - std::chrono::hours(1000 - k));
    }
    write_text(cache + "/notes.txt", "mine");
    const std::string compiler = quick_compiler(cache + "/called");
    REQUIRE(call(short_run, {.environment = {{"LAGEN_CACHE", cache}, {"CXX", compiler}}}).code == 0);
    const std::vector<std::string> names = names_in(cache);
    CHECK(names.size() == 202); // 200 programs and records, and two files that are none
    CHECK(read_text(cache + "/notes.txt") == "mine");
    CHECK_FALSE(fs::exists(cache + "/00000000000000000000000000000006")); // the seventh oldest made room
    CHECK(fs::exists(cache + "/00000000000000000000000000000007"));
}

TEST_CASE("a full disk is reported and no partial file is left")
{
    const std::string folder = fresh_folder();
    write_text(folder + "/old.hpp", "old\n");
    const Outcome header =
        call({"generate", models_folder() + "/kepler.toml", "-o", "old.hpp"}, {.folder = folder, .largest_file = 1000});
    CHECK(header.code == 5);
    CHECK(header.err == "error: cannot write 'old.hpp': File too large\n");
    CHECK(read_text(folder + "/old.hpp") == "old\n");
    CHECK(names_in(folder) == std::vector<std::string>{"old.hpp"});

    const Outcome device = call({"generate", "kepler.toml", "-o", "/dev/full"});
    CHECK(device.code == 5);
    CHECK(device.err == "error: cannot write '/dev/full': No space left on device\n");
    for (const char* command : {"generate", "derive", "check"}) {
        const Outcome stream = call({command, "kepler.toml"}, {.output = "/dev/full"});
        CHECK(stream.code == 5);
        CHECK(stream.err == "error: cannot write to standard output: No space left on device\n");
    }
    CHECK(call({"--help"}, {.output = "/dev/full"}).code == 5);
    const Outcome rows = call({"run", "oscillator.toml", "-o", "/dev/full"});
    CHECK(rows.code == 5);
    CHECK(rows.err == "error: cannot write '/dev/full': No space left on device\n");
}

TEST_CASE("an output folder that is missing or not a folder is reported")
{
    const Outcome missing = call({"generate", "kepler.toml", "-o", "no/such/k.hpp"});
    CHECK(missing.code == 5);
    CHECK(missing.err == "error: cannot write 'no/such/k.hpp': No such file or directory\n");
    const Outcome folder = call({"generate", "kepler.toml", "-o", "."});
    CHECK(folder.code == 5);
    CHECK(folder.err == "error: cannot write '.': Is a directory\n");
    const Outcome kernel = call({"generate", "kepler.toml", "-o", "/proc/k.hpp"}); // nobody may create files there
    CHECK(kernel.code == 5);
    CHECK_THAT(kernel.err, Catch::StartsWith("error: cannot write '/proc/k.hpp': "));
}

TEST_CASE("where rows and pictures cannot go is said before anything is compiled")
{
    const std::string folder = fresh_folder();
    write_text(folder + "/file", "");
    const std::string model = models_folder() + "/oscillator.toml";
    const auto answer = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin() + 1, model);
        const Outcome outcome = call(arguments, {.environment = {{"CXX", "/nonexistent"}}, .folder = folder});
        CHECK(outcome.code == 5);
        return outcome.err;
    };
    CHECK(answer({"run", "-o", "."}) == "error: cannot write '.': Is a directory\n");
    CHECK(answer({"run", "-o", "file/a.csv"}) == "error: cannot write 'file/a.csv': Not a directory\n");
    CHECK(answer({"run", "--plot", "no/a.svg"}) == "error: cannot write 'no/a.svg': No such file or directory\n");
    CHECK(answer({"sweep", "--initial", "x=1:2:2", "-o", "no/a.csv"}) ==
          "error: cannot write 'no/a.csv': No such file or directory\n");
    CHECK(answer({"sweep", "--initial", "x=1:2:2", "-o", "."}) == "error: cannot write '.': Is a directory\n");
    CHECK(names_in(folder) == std::vector<std::string>{"file"});
}

TEST_CASE("values that make no sense are told of before anything is compiled")
{
    const Outcome outcome = call({"run", "oscillator.toml", "--at", "1,1.5", "--t-end", "1.25"},
                                 {.environment = {{"CXX", "true"}, {"LAGEN_CACHE", fresh_folder()}}});
    CHECK(outcome.code == 3);
    CHECK_THAT(outcome.err, Catch::StartsWith("<--at>:1:1: error: a row is wanted at t = 1.5, outside of the run"));
}

TEST_CASE("closed standard streams are noticed and no file takes their place")
{
    const Outcome closed = call(short_run, {.output_closed = true});
    CHECK(closed.code == 5);
    CHECK(closed.err == "error: cannot write to standard output: Bad file descriptor\n");
    CHECK(call(short_run, {.error_closed = true}).code == 0);
    CHECK(call({"generate", "refuted.toml"}, {.error_closed = true}).code == 1);
}

TEST_CASE("a reader who goes away ends the program with an error")
{
    int ends[2];
    REQUIRE(::pipe(ends) == 0);
    ::close(ends[0]);
    const Outcome outcome = call({"generate", "kepler.toml"}, {.output = "/dev/fd/" + std::to_string(ends[1])});
    ::close(ends[1]);
    CHECK(outcome.code == 5);
    CHECK(outcome.err == "error: cannot write to standard output: Broken pipe\n");
}

TEST_CASE("--plot without gnuplot is said before the run")
{
    const std::string folder = fresh_folder();
    const Outcome outcome = call({"run", models_folder() + "/oscillator.toml", "--plot", "a.svg"},
                                 {.environment = {{"PATH", "/nonexistent"}}, .folder = folder});
    CHECK(outcome.code == 5);
    CHECK(outcome.out.empty());
    CHECK(outcome.err == "error: gnuplot was not found\nhint: --plot draws with gnuplot; install gnuplot-nox\n");
    CHECK(names_in(folder).empty());
}

TEST_CASE("an interrupt in mid-run exits 130 with one line, no file and no process left")
{
    REQUIRE(call(short_run).code == 0); // compiled already
    const std::string folder = fresh_folder();
    const std::string mark = "2718281828"; // the end of this run, to be found among the processes
    for (const int signal : {SIGINT, SIGTERM}) {
        const Started started = start_call({"run", models_folder() + "/oscillator.toml", "--t-end", mark, "--at", "0",
                                            "-o", "rows.csv", "--tolerance", "1e-14"},
                                           {.folder = folder});
        for (int k = 0; k < 300 && !alive(std::string("--end") + '\0' + mark); ++k)
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        REQUIRE(::kill(started.process, signal) == 0);
        const Outcome outcome = finish(started);
        CHECK(outcome.code == 130);
        CHECK(outcome.out.empty());
        CHECK(outcome.err == "lagen: interrupted, nothing was written\n");
        CHECK(names_in(folder).empty());
        CHECK_FALSE(alive(mark));
    }
}

TEST_CASE("an interrupt while compiling stops the compiler and its children")
{
    const std::string cache = fresh_folder();
    const std::string compiler = script("sleep 31.4159\necho not reached\n");
    const Started started = start_call(short_run, {.environment = {{"CXX", compiler}, {"LAGEN_CACHE", cache}}});
    for (int k = 0; k < 300 && !alive("31.4159"); ++k) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    REQUIRE(alive("31.4159"));
    REQUIRE(::kill(started.process, SIGINT) == 0);
    const Outcome outcome = finish(started);
    CHECK(outcome.code == 130);
    CHECK(outcome.err == "lagen: interrupted while compiling\n");
    CHECK(names_in(cache).empty());
    CHECK_FALSE(alive("31.4159"));
}

namespace {

/// What reaches standard error, a terminal or a pipe, while a activity lasts for so many milliseconds.
std::string told_in(int milliseconds, bool terminal)
{
    int ends[2] = {-1, -1};
    REQUIRE((terminal ? ::openpty(&ends[0], &ends[1], nullptr, nullptr, nullptr) : ::pipe(ends)) == 0);
    const int before = ::dup(STDERR_FILENO);
    ::dup2(ends[1], STDERR_FILENO);
    {
        const lagen::ActivityWatch watch;
        lagen::Activity activity("deciding top", 7);
        activity.next();
        std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
    }
    ::dup2(before, STDERR_FILENO);
    ::fcntl(ends[0], F_SETFL, O_NONBLOCK);
    std::string text(4096, ' ');
    const ssize_t count = ::read(ends[0], text.data(), text.size());
    for (const int file : {before, ends[0], ends[1]}) ::close(file);
    return text.substr(0, count < 0 ? 0 : static_cast<std::size_t>(count));
}

} // namespace

TEST_CASE("what lasts longer than two seconds is told on a terminal alone, and wiped where it ends")
{
    const std::string told = told_in(2600, true);
    CHECK(told.find("2 s  deciding top, 1 of 7") != std::string::npos);
    CHECK(told.ends_with(" \r"));
    CHECK(told_in(500, true).empty());
    CHECK(told_in(2600, false).empty());
}
