// SPDX-License-Identifier: GPL-2.0-or-later
/// What the machine may lack: a compiler, room on a disk, somebody who reads, patience.
#include "program.hpp"

#include "lagen_run/archive.hpp"
#include "lagen_run/report.hpp"
#include "machine/activity_watch.hpp"
#include "support/golden.hpp"
#include "text/activity.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <poll.h>
#include <pty.h>
#include <sstream>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

using namespace lagen::testing;
namespace fs = std::filesystem;

namespace {

/// A splitting whose steps are scaled is compiled with its model.
std::vector<std::string> by_splitting(std::vector<std::string> arguments)
{
    for (const char* word : {"--method", "leapfrog_kdk", "--step", "0.001", "--time-scale", "1"})
        arguments.emplace_back(word);
    return arguments;
}

const std::vector<std::string> short_run = by_splitting({"run", "oscillator.toml", "--at", "1"});

/// An executable shell script.
std::string script(const std::string& body)
{
    const std::string path = written_file("compiler", "#!/bin/sh\n" + body);
    fs::permissions(path, fs::perms::owner_all);
    return path;
}

/// A compiler whose programs report success and do nothing else, and which counts its calls in `witness`.
std::string quick_compiler(const std::string& witness)
{
    lagen::detail::RunReport done;
    done.status = "ok";
    const std::string report = written_file("report", lagen::detail::packed(done));
    return script("echo called >>" + witness + R"(
while [ "$1" != -o ]; do shift; done
cat >"$2" <<'END'
#!/bin/sh
cp )" + report + R"( "$2"
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
    CHECK(call(by_splitting({"run", "oscillator.toml", "--t-end", "7"}),
               {.environment = counted.environment, .folder = folder})
              .code == 0);
    CHECK(read_text(witness) == "called\n");
    for (const char* setting : {"g=9.81", "g=1", "m=2"})
        CHECK(call(by_splitting({"run", "pendulum.toml", "--set", setting}), counted).code == 0);
    CHECK(read_text(witness) == "called\ncalled\n");
    CHECK(
        call({"run", "oscillator.toml", "--method", "kahanli8", "--step", "0.01", "--time-scale", "1"}, counted).code ==
        0);
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

TEST_CASE("flags under which numbers are taken for finite, or sums reordered, are refused: the last one given wins")
{
    const std::string broken = script("exit 3\n"); // a compiler that shows that it was called
    const auto with = [&](const std::string& flags) {
        return call(short_run, {.environment = {{"CXXFLAGS", flags}, {"CXX", broken}}});
    };
    for (const std::string flags :
         {"-ffast-math", "-Ofast", "-O2 -ffinite-math-only", "-funsafe-math-optimizations", "-fassociative-math",
          "-fno-fast-math -ffast-math", "-Ofast -fno-finite-math-only"}) {
        const Outcome refused = with(flags);
        INFO(flags << '\n' << refused.err);
        CHECK(refused.code == 5);
        CHECK(refused.out.empty());
        CHECK_THAT(refused.err, Catch::StartsWith("error: CXXFLAGS holds -"));
        CHECK(refused.err.find("with which a program cannot see that a number is not finite") != std::string::npos);
        CHECK(std::count(refused.err.begin(), refused.err.end(), '\n') == 2);
    }
    for (const std::string flags : {"-O3 -march=native", "-Ofast -fno-fast-math", "-Ofast -O2", "-fno-fast-math",
                                    "-ffast-math -fno-finite-math-only -fno-unsafe-math-optimizations"}) {
        INFO(flags);
        CHECK_THAT(with(flags).err, Catch::StartsWith("error: the C++ compiler failed with exit code 3\n"));
    }
}

TEST_CASE("without a compiler the run says which was looked for")
{
    const Outcome named = call(short_run, {.environment = {{"CXX", "/nonexistent"}}});
    CHECK(named.code == 5);
    CHECK(named.out.empty());
    CHECK(named.err == "error: the C++ compiler '/nonexistent' (from CXX) was not found\n"
                       "hint: `run` compiles the generated header; unset CXX or name a C++20 compiler\n");
    const Outcome none = call(short_run, {.environment = {{"PATH", "/nonexistent"}, {"CXX", ""}}});
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

TEST_CASE("a cache that cannot be used is replaced by a temporary folder, which is said once and serves the next run")
{
    const std::string temporary = fresh_folder(), witness = fresh_folder() + "/called";
    const std::string file = fresh_folder() + "/file", unusable = file + "/cache";
    write_text(file, "");
    const std::string own = temporary + "/lagen-" + std::to_string(::getuid());
    const Surroundings around{
        .environment = {{"LAGEN_CACHE", unusable}, {"TMPDIR", temporary}, {"CXX", quick_compiler(witness)}}};
    const std::string note =
        "note: '" + unusable + "' is no folder for compiled scenes: Not a directory; they go to '" + own + "'\n";
    for (int k = 0; k < 2; ++k) {
        const Outcome outcome = call(short_run, around);
        CHECK(outcome.code == 0);
        CHECK_THAT(outcome.err, Catch::StartsWith(note));
        CHECK(outcome.err.find("note:", 1) == std::string::npos);
    }
    CHECK(read_text(witness) == "called\n");
    CHECK(names_in(temporary) == std::vector<std::string>{"lagen-" + std::to_string(::getuid())});
    CHECK(names_in(own).size() == 2); // the program and its record

    const std::string taken = fresh_folder();
    write_text(taken + "/lagen-" + std::to_string(::getuid()), "somebody's");
    const Outcome nowhere = call(short_run, {.environment = {{"LAGEN_CACHE", unusable}, {"TMPDIR", taken}}});
    CHECK(nowhere.code == 5);
    CHECK_THAT(nowhere.err, Catch::StartsWith("error: '" + unusable +
                                              "' is no folder for compiled scenes: Not a directory\nand neither is '" +
                                              taken + "/lagen-"));
}

TEST_CASE("a full cache, and one that no program is run from, are replaced likewise")
{
    const std::string witness = fresh_folder() + "/called", temporary = fresh_folder();
    const auto note_for = [&](const std::string& options) {
        // A file system of our own: a namespace where this user may mount. Where none may, nothing is tested.
        const std::string shell = script("exec unshare -Urm sh -c 'mount -t tmpfs -o " + options +
                                         " none /mnt && exec \"" + LAGEN_PROGRAM + "\" \"$@\"' sh \"$@\"\n");
        const Outcome outcome = call(
            short_run,
            {.environment = {{"LAGEN_CACHE", "/mnt/cache"}, {"TMPDIR", temporary}, {"CXX", quick_compiler(witness)}},
             .program = shell});
        return outcome.code == 0 ? outcome.err.substr(0, outcome.err.find(';')) : "";
    };
    if (std::system("unshare -Urm mount -t tmpfs none /mnt 2>/dev/null") != 0) return;
    CHECK(note_for("noexec") ==
          "note: '/mnt/cache' is no folder for compiled scenes: no program can be run from there (noexec)");
    CHECK(note_for("ro") == "note: '/mnt/cache' is no folder for compiled scenes: Read-only file system");
    CHECK(note_for("size=1m") == "note: '/mnt/cache' is no folder for compiled scenes: No space left on device");
}

TEST_CASE("a damaged program or record in the cache is made again")
{
    const std::string witness = fresh_folder() + "/called", cache = fresh_folder();
    const Surroundings around{.environment = {{"LAGEN_CACHE", cache}, {"CXX", quick_compiler(witness)}}};
    REQUIRE(call(short_run, around).code == 0);
    const std::vector<std::string> names = names_in(cache);
    REQUIRE(names.size() == 2);
    std::size_t calls = 1;
    const auto is_mended = [&](bool compiles) {
        calls += compiles ? 1 : 0;
        const Outcome outcome = done(short_run, around);
        CHECK(read_text(witness).size() == calls * std::string("called\n").size());
        CHECK(names_in(cache) == names);
        CHECK(call(short_run, around).code == 0);
        CHECK(read_text(witness).size() == calls * std::string("called\n").size());
    };
    for (const std::string& name : names) {
        const std::string file = cache + "/" + name, good = read_text(file);
        const bool compiles = !name.ends_with(".run");
        std::string changed = good;
        changed[good.size() / 2] = static_cast<char>(changed[good.size() / 2] ^ 1);
        for (const std::string& damaged :
             {std::string(), good.substr(0, good.size() / 2), good.substr(0, good.size() - 1), changed, good + "x",
              std::string("some text\n"),
              std::string("\x7f"
                          "ELF\2\1\1")}) {
            write_text(file, damaged);
            is_mended(compiles);
        }
        fs::remove(file);
        fs::create_directory(file);
        write_text(file + "/inside", "");
        is_mended(compiles);
        fs::remove(file);
        fs::create_symlink("nowhere", file);
        is_mended(compiles);
    }
    const std::string program = names[names[0].ends_with(".run") ? 1 : 0];
    fs::permissions(cache + "/" + program, fs::perms::owner_read | fs::perms::owner_write);
    is_mended(true);
}

TEST_CASE("models share what the compiler has read of their headers, and do without it where that is damaged", "[run]")
{
    // By clang, which asks for every file that it read.
    const std::string cache = fresh_folder();
    const auto run = [&](std::vector<std::string> options) {
        options.insert(options.begin(), {"run", "oscillator.toml", "--at", "1", "--no-second-run"});
        return call(options, {.environment = {{"CXX", "clang++"}, {"CXXFLAGS", "-O0"}, {"LAGEN_CACHE", cache}}});
    };
    const auto named = [&](const char* ending) {
        for (const std::string& name : names_in(cache))
            if (name.ends_with(ending)) return cache + "/" + name;
        return std::string();
    };
    const Outcome first = run({});
    CHECK(first.code == 0);
    REQUIRE(!named(".hpp.gch").empty());
    CHECK(run({"--form", "hamilton"}).code == 0);
    CHECK(!named(".hpp").empty());
    write_text(named(".hpp.gch"), std::string(fs::file_size(named(".hpp.gch")), 'x'));
    const Outcome damaged = run({"--method", "radau5"});
    INFO(damaged.err);
    CHECK(damaged.code == 0);
    CHECK(named(".hpp").empty());
    CHECK(run({"--method", "taylor"}).code == 0);
    CHECK(!named(".hpp").empty());
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

TEST_CASE("a reader who goes away is no error: every command comes quietly to its own end")
{
    int ends[2];
    REQUIRE(::pipe(ends) == 0);
    ::close(ends[0]);
    const Surroundings unread{.output = "/dev/fd/" + std::to_string(ends[1])};
    for (const char* words : {"generate kepler.toml", "derive kepler.toml", "check kepler.toml", "models", "methods",
                              "--help", "run --help", "--version"}) {
        std::istringstream stream(words);
        const std::vector<std::string> line{std::istream_iterator<std::string>(stream), {}};
        const Outcome outcome = call(line, unread);
        CHECK(outcome.code == 0);
        CHECK(outcome.err == call(line).err);
    }
    CHECK(call({"check", "refuted.toml"}, unread).code == 1);
    const Outcome rows = call(short_run, unread);
    CHECK(rows.code == 0);
    CHECK(rows.err.find("error:") == std::string::npos);
    const Outcome file = call({"derive", "kepler.toml", "-o", "/dev/stdout"}, unread);
    CHECK(file.code == 0);
    CHECK(file.err.empty());
    ::close(ends[1]);
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

TEST_CASE("an interrupt in mid-run exits 130 and leaves the rows so far, and no process", "[run]")
{
    // One method is part of lagen, the other one a program; both are compiled already.
    REQUIRE(call({"run", "oscillator.toml", "--at", "1"}).code == 0);
    REQUIRE(call(short_run).code == 0);
    const std::string mark = "2718281828"; // the end of this run, to be found among the processes
    bool compiled_apart = false;
    const auto interrupted = [&](const std::vector<std::string>& options, int signal, const std::string& folder) {
        std::vector<std::string> arguments{"run", models_folder() + "/oscillator.toml", "--t-end", mark, "--at", "0,1"};
        if (compiled_apart) arguments = by_splitting(arguments);
        arguments.insert(arguments.end(), options.begin(), options.end());
        const Started started = start_call(arguments, {.folder = folder});
        for (int k = 0; k < 300 && compiled_apart && !alive("/lagen-run"); ++k)
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        std::this_thread::sleep_for(std::chrono::milliseconds(compiled_apart ? 100 : 1000));
        REQUIRE(::kill(started.process, signal) == 0);
        const Outcome outcome = finish(started);
        CHECK(outcome.code == 130);
        CHECK_FALSE(alive(mark));
        return outcome;
    };
    const auto said = [](const std::string& place) {
        return Catch::Matches("lagen: interrupted at t = [0-9.e+]+; the 2 rows so far are " + place + "\n");
    };
    for (const int signal : {SIGINT, SIGTERM}) {
        const std::string folder = fresh_folder();
        write_text(folder + "/rows.csv", "earlier");
        const Outcome outcome = interrupted({"-o", "rows.csv"}, signal, folder);
        CHECK(outcome.out.empty());
        CHECK_THAT(outcome.err, said("in 'rows\\.csv\\.partial'"));
        CHECK(read_text(folder + "/rows.csv") == "earlier");
        CHECK_THAT(read_text(folder + "/rows.csv.partial"), Catch::StartsWith("t,x,v\r\n0,1,0\r\n1,0.54030"));
        CHECK(names_in(folder).size() == 2);
        compiled_apart = true;
    }
    const Outcome rows = interrupted({}, SIGINT, fresh_folder());
    CHECK_THAT(rows.err, said("on standard output"));
    CHECK_THAT(rows.out, Catch::StartsWith("t,x,v\r\n0,1,0\r\n1,0.54030"));
    const Outcome closed = interrupted({"--format", "json"}, SIGINT, fresh_folder());
    const lagen::json::Value report = lagen::json::parse(closed.out);
    CHECK(report["status"].text == "interrupted");
    CHECK(report["rows"].entries.size() == 2);
    CHECK(report["t"].number() > 1);
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

/// What reaches standard error, a terminal or a pipe, from an activity that ends where something is shown, or after so
/// many milliseconds.
std::string told_in(int milliseconds, bool terminal)
{
    int ends[2] = {-1, -1};
    REQUIRE((terminal ? ::openpty(&ends[0], &ends[1], nullptr, nullptr, nullptr) : ::pipe(ends)) == 0);
    const int before = ::dup(STDERR_FILENO);
    ::dup2(ends[1], STDERR_FILENO);
    ::close(ends[1]);
    {
        const lagen::ActivityWatch watch;
        lagen::Activity activity("deciding top", 7);
        activity.next();
        pollfd shown{ends[0], POLLIN, 0};
        ::poll(&shown, 1, milliseconds);
    }
    ::dup2(before, STDERR_FILENO);
    ::close(before);
    // A terminal hands on what was written to it a little later: its end is read, too, now that nobody can write.
    std::string text;
    char part[4096];
    for (ssize_t count = 0; (count = ::read(ends[0], part, sizeof part)) > 0;)
        text.append(part, static_cast<std::size_t>(count));
    ::close(ends[0]);
    return text;
}

} // namespace

TEST_CASE("what lasts longer than two seconds is told on a terminal alone, and wiped where it ends")
{
    const std::string told = told_in(60000, true);
    CHECK(told.starts_with("\r2 s  deciding top, 1 of 7"));
    CHECK(told.ends_with(" \r"));
    CHECK(told_in(500, true).empty());
    CHECK(told_in(2600, false).empty());
}
