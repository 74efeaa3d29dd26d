// SPDX-License-Identifier: GPL-2.0-or-later
/// Sweeps that end early: killed, interrupted, without room on the disk; and sweeps of several processes.
#include "program.hpp"
#include "sweep_table.hpp"

#include "commands/sweep/sweep_file.hpp"
#include "support/golden.hpp"
#include "support/sanitized.hpp"

#include <catch2/catch.hpp>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

using namespace lagen::testing;
namespace fs = std::filesystem;

namespace {

/// A folder for a.csv, the table of 24 rows each of which takes its time.
struct Slow {
    std::string folder = fresh_folder();

    [[nodiscard]] static std::vector<std::string> arguments(const std::vector<std::string>& more = {})
    {
        std::vector<std::string> all{"sweep",     models_folder() + "/oscillator.toml",
                                     "-o",        "a.csv",
                                     "--step",    "1/65536",
                                     "--method",  "euler",
                                     "--t-end",   "30",
                                     "--initial", "x=1:24:24"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    [[nodiscard]] Outcome sweep(const std::vector<std::string>& more = {}) const
    {
        return call(arguments(more), {.folder = folder});
    }
    [[nodiscard]] std::string table() const { return read_text(folder + "/a.csv"); }
    [[nodiscard]] std::string partial() const { return folder + "/a.csv.partial"; }

    [[nodiscard]] std::size_t lines() const
    {
        const std::string text = fs::exists(partial()) ? read_text(partial()) : "";
        return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
    }

    /// Starts the sweep; as soon as some rows are there, does `meanwhile` and sends `signal`.
    [[nodiscard]] Outcome cut_short(int signal, const std::function<void()>& meanwhile) const
    {
        const Started started = start_call(arguments({"--threads", "2"}), {.folder = folder});
        const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(60);
        while (lines() < 4 && std::chrono::steady_clock::now() < patience)
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        meanwhile();
        ::kill(started.process, signal);
        return finish(started);
    }
};

const std::string resume_hint = "\nhint: --resume goes on with the same model, options and lagen; without it the sweep "
                                "begins anew\n";

/// The table of an undisturbed sweep.
const std::string& whole()
{
    static const std::string text = [] {
        const Slow slow;
        const Outcome outcome = slow.sweep();
        INFO(outcome.err);
        REQUIRE(outcome.code == 0);
        return slow.table();
    }();
    return text;
}

} // namespace

TEST_CASE("a sweep that was killed goes on without a row lost or twice", "[sweep]")
{
    (void)whole();
    const Slow slow;
    CHECK(slow.cut_short(SIGKILL, [] {}).code == 128 + SIGKILL);
    CHECK_FALSE(fs::exists(slow.folder + "/a.csv"));
    const std::string kept = read_text(slow.partial());
    CHECK(slow.lines() < 25);
    CHECK(whole().starts_with(kept));
    SECTION("after a whole row") {}
    SECTION("in the middle of a row")
    {
        fs::resize_file(slow.partial(), kept.size() - 5);
    }
    SECTION("in the middle of its heading")
    {
        fs::resize_file(slow.partial(), 7);
    }
    SECTION("with nothing in the file")
    {
        fs::resize_file(slow.partial(), 0);
    }
    SECTION("without the file")
    {
        fs::remove(slow.partial());
    }
    const Outcome resumed = slow.sweep({"--resume", "--threads", "1"});
    CHECK(resumed.code == 0);
    CHECK(resumed.err == "a.csv: 24 rows\n");
    CHECK(slow.table() == whole());
    CHECK(names_in(slow.folder) == std::vector<std::string>{"a.csv", "a.csv.sweep"});
}

TEST_CASE("an interrupt keeps the rows that are done, and another sweep does not go on with them", "[sweep]")
{
    (void)whole();
    const Slow slow;
    const Outcome interrupted = slow.cut_short(SIGINT, [&] {
        const Outcome second = slow.sweep();
        CHECK(second.code == 4);
        CHECK(second.err == "lagen sweep: another sweep is writing 'a.csv.partial'\n");
    });
    CHECK(interrupted.code == 130);
    const std::string kept = read_text(slow.partial());
    std::string told = "lagen: interrupted, 3 of 24 rows are done; --resume goes on with them\n";
    told.replace(told.find('3'), 1, std::to_string(slow.lines() - 1));
    CHECK(interrupted.err == told);
    CHECK(whole().starts_with(kept));
    const std::string command = "lagen sweep " + models_folder() +
                                "/oscillator.toml --step 1/65536 --method euler --t-end 30 --initial x=1:24:24";
    for (const auto& [name, value] : {std::pair("--t-end", "29"), {"--initial", "v=1/3"}, {"--shard", "0/2"}}) {
        const Outcome refused = slow.sweep({name, value, "--resume"});
        CHECK(refused.code == 4);
        CHECK(refused.err == "lagen sweep: 'a.csv.partial' is of another sweep: " +
                                 (value == std::string("0/2") ? "part 0/1" : command) + resume_hint);
        CHECK(read_text(slow.partial()) == kept);
    }
    std::string damaged = kept;
    damaged.replace(damaged.find("\r\n1,") + 2, 1, "7");
    write_text(slow.partial(), damaged);
    CHECK(slow.sweep({"--resume"}).err == "lagen sweep: 'a.csv.partial' does not hold row 1 where it must stand\nhint: "
                                          "without --resume the sweep begins anew\n");
    CHECK(slow.sweep().code == 0);
    CHECK(slow.table() == whole());
}

TEST_CASE("--resume leaves a complete table as it is, and none of another sweep is replaced by it", "[sweep]")
{
    const std::string folder = fresh_folder(), file = folder + "/a.csv";
    write_text(folder + "/oscillator.toml", read_text(models_folder() + "/oscillator.toml"));
    const auto sweep = [&](const std::string& end, const std::vector<std::string>& more = {}) {
        std::vector<std::string> arguments{"sweep", "oscillator.toml", "--initial", "x=1:5:5", "--t-end", end, "-o",
                                           "a.csv"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return call(arguments, {.folder = folder});
    };
    REQUIRE(sweep("1").code == 0);
    const std::string table = read_text(file);
    const auto written = fs::last_write_time(file);
    CHECK(sweep("1", {"--resume"}).err == "a.csv: 5 rows\n");
    CHECK(fs::last_write_time(file) == written);
    const Outcome other = sweep("2", {"--resume"});
    CHECK(other.code == 4);
    CHECK(other.err ==
          "lagen sweep: 'a.csv' is of another sweep: lagen sweep oscillator.toml --initial x=1:5:5 --t-end 1" +
              resume_hint);
    fs::remove(file + ".sweep");
    const Outcome unknown = sweep("1", {"--resume"});
    CHECK(unknown.code == 4);
    CHECK(unknown.err == "lagen sweep: nothing says of which sweep 'a.csv' is" + resume_hint);
    CHECK(read_text(file) == table);
    CHECK(names_in(folder) == std::vector<std::string>{"a.csv", "oscillator.toml"});
    CHECK(sweep("2").code == 0);
    CHECK(read_text(file) != table);
}

TEST_CASE("a file that gets another name while somebody waits for it is not the one that is held")
{
    const std::string folder = fresh_folder(), file = folder + "/a", other = folder + "/b";
    const int first = lagen::open_locked(file, false);
    REQUIRE(first >= 0);
    CHECK(lagen::open_locked(file, false) == -1);
    CHECK(errno == EWOULDBLOCK);
    int second = -1;
    std::thread waiting([&] { second = lagen::open_locked(file, true); });
    std::this_thread::sleep_for(std::chrono::milliseconds(200)); // it has opened the file, most likely
    fs::rename(file, other);
    ::close(first);
    waiting.join();
    REQUIRE(second >= 0);
    REQUIRE(fs::exists(file));
    struct stat held {
    }, named{};
    REQUIRE((::fstat(second, &held) == 0 && ::stat(file.c_str(), &named) == 0));
    CHECK(held.st_ino == named.st_ino);
    ::close(second);
}

TEST_CASE("the parts of a sweep are removed when the whole is on the disk", "[sweep]")
{
    const std::string folder = fresh_folder();
    // A library in front of the system's notes what happens to files.
    write_text(folder + "/notes.c", R"(
#define _GNU_SOURCE
#include <dlfcn.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>
static void note(const char* what, const char* name)
{
    FILE* file = fopen("notes", "a");
    fprintf(file, "%s %s\n", what, strrchr(name, '/') ? strrchr(name, '/') + 1 : name);
    fclose(file);
}
int fsync(int file)
{
    char link[64], name[4096] = "";
    snprintf(link, sizeof link, "/proc/self/fd/%d", file);
    if (readlink(link, name, sizeof name - 1) > 0) note("fsync", name);
    return ((int (*)(int))dlsym(RTLD_NEXT, "fsync"))(file);
}
int rename(const char* from, const char* to)
{
    note("rename", to);
    return ((int (*)(const char*, const char*))dlsym(RTLD_NEXT, "rename"))(from, to);
}
int unlink(const char* name)
{
    note("unlink", name);
    return ((int (*)(const char*))dlsym(RTLD_NEXT, "unlink"))(name);
}
)");
    if (LAGEN_SANITIZED ||
        run_shell("cc -shared -fPIC '" + folder + "/notes.c' -o '" + folder + "/notes.so' -ldl").status)
        return;
    for (const std::string rank : {"0", "1"})
        REQUIRE(call({"sweep", models_folder() + "/oscillator.toml", "--initial", "x=1:4:4", "-o", "all.csv"},
                     {.environment = {{"PMI_RANK", rank}, {"PMI_SIZE", "2"}, {"LD_PRELOAD", folder + "/notes.so"}},
                      .folder = folder})
                    .code == 0);
    const std::string notes = read_text(folder + "/notes");
    const std::size_t whole = notes.find("fsync all.csv.partial\n"), named = notes.find("rename all.csv\n"),
                      part = notes.find("unlink all.csv.0-of-2\n");
    INFO(notes);
    REQUIRE(part != std::string::npos);
    CHECK(whole < named);
    CHECK(named < part);
    CHECK(notes.substr(named, part - named).find("fsync " + fs::path(folder).filename().string() + "\n") !=
          std::string::npos);
}

TEST_CASE("a full disk ends a sweep with the rows that were written", "[sweep]")
{
    const std::string folder = fresh_folder();
    const std::vector<std::string> arguments{
        "sweep", models_folder() + "/oscillator.toml", "--initial", "x=1:300:300", "-o", "a.csv", "--resume"};
    // The program is compiled before there is no room for it.
    std::vector<std::string> first = arguments;
    first[5] = "whole.csv";
    REQUIRE(call(first, {.folder = folder}).code == 0);
    const Outcome full = call(arguments, {.folder = folder, .largest_file = 9000});
    CHECK(full.code == 5);
    const CsvTable kept = read_csv(read_text(folder + "/a.csv.partial"));
    CHECK(kept.rows.size() > 20);
    CHECK(full.err.starts_with("error: cannot write 'a.csv.partial': File too large\nhint: "));
    CHECK(full.err.ends_with(" rows stay in it; --resume goes on with them\n"));
    REQUIRE(call(arguments, {.folder = folder}).code == 0);
    CHECK(read_text(folder + "/a.csv") == read_text(folder + "/whole.csv"));
}

TEST_CASE("processes of a launcher share a sweep, and the last one puts it together", "[sweep]")
{
    using Environment = std::vector<std::pair<std::string, std::string>>;
    const std::vector<std::string> arguments{"sweep", models_folder() + "/oscillator.toml", "--initial", "x=1:10:10",
                                             "-o"};
    const std::string folder = fresh_folder();
    const auto sweep = [&](const std::string& file, const Environment& environment,
                           const std::vector<std::string>& more = {}) {
        std::vector<std::string> all = arguments;
        all.push_back(file);
        all.insert(all.end(), more.begin(), more.end());
        return call(all, {.environment = environment, .folder = folder});
    };
    REQUIRE(sweep("whole.csv", {}).code == 0);
    const std::string expected = read_text(folder + "/whole.csv");
    const auto ranks = [&](const std::string& name, std::size_t count, const auto& environment_of) {
        std::string last;
        for (std::size_t k = 0; k < count; ++k) {
            CHECK_FALSE(fs::exists(folder + "/" + name));
            const Outcome outcome = sweep(name, environment_of(std::to_string(k)));
            INFO(outcome.err);
            REQUIRE(outcome.code == 0);
            last = outcome.err;
        }
        CHECK(read_text(folder + "/" + name) == expected);
        CHECK(last.ends_with(name + ": 10 rows of " + std::to_string(count) + " parts\n"));
    };
    ranks("mpi.csv", 4, [](const std::string& k) {
        return Environment{
            {"OMPI_COMM_WORLD_RANK", k}, {"OMPI_COMM_WORLD_SIZE", "4"}, {"SLURM_NTASKS", "9"}, {"SLURM_PROCID", "0"}};
    });
    ranks("slurm.csv", 3, [](const std::string& k) { return Environment{{"SLURM_PROCID", k}, {"SLURM_NTASKS", "3"}}; });
    ranks("array.csv", 2, [](const std::string& k) {
        return Environment{{"SLURM_ARRAY_TASK_ID", k == "0" ? "5" : "7"},
                           {"SLURM_ARRAY_TASK_MIN", "5"},
                           {"SLURM_ARRAY_TASK_MAX", "7"},
                           {"SLURM_ARRAY_TASK_STEP", "2"},
                           {"SLURM_ARRAY_TASK_COUNT", "2"},
                           {"SLURM_PROCID", "0"},
                           {"SLURM_NTASKS", "1"}};
    });
    CHECK(names_in(folder) == std::vector<std::string>{"array.csv", "array.csv.sweep", "mpi.csv", "mpi.csv.sweep",
                                                       "slurm.csv", "slurm.csv.sweep", "whole.csv", "whole.csv.sweep"});
    // A rank that is started again finds the whole; no rank leaves a lock behind, also where others are missing.
    const Environment again{{"SLURM_PROCID", "1"}, {"SLURM_NTASKS", "3"}};
    CHECK(sweep("slurm.csv", again, {"--resume"}).err.ends_with("slurm.csv: 10 rows, complete\n"));
    const Outcome other = sweep("slurm.csv", again, {"--resume", "--t-end", "2"});
    CHECK(other.code == 4);
    CHECK_THAT(other.err, Catch::Contains("'slurm.csv' is of another sweep: lagen sweep "));
    REQUIRE(sweep("alone.csv", again).code == 0);
    CHECK_FALSE(fs::exists(folder + "/alone.csv.lock"));

    // --shard wins; what numbers no part is refused.
    CHECK(sweep("own.csv", {{"SLURM_PROCID", "1"}, {"SLURM_NTASKS", "3"}}, {"--shard", "0/1"}).code == 0);
    CHECK(read_text(folder + "/own.csv") == expected);
    CHECK(sweep("no.csv", {{"PMI_RANK", "4"}, {"PMI_SIZE", "4"}}).err ==
          "lagen sweep: PMI_RANK is 4 and PMI_SIZE is 4, which is no part of a sweep\n"
          "hint: --shard k/n says which rows are computed\n");
    CHECK(sweep("no.csv", {{"SLURM_PROCID", "x"}, {"SLURM_NTASKS", "4"}}).err ==
          "lagen sweep: SLURM_PROCID is 'x', where a whole number is required\n"
          "hint: --shard k/n says which rows are computed\n");
    CHECK(sweep("no.csv", {{"SLURM_ARRAY_TASK_ID", "7"},
                           {"SLURM_ARRAY_TASK_COUNT", "2"},
                           {"SLURM_ARRAY_TASK_MIN", "1"},
                           {"SLURM_ARRAY_TASK_MAX", "7"}})
              .err == "lagen sweep: task 7 of a Slurm array of 2 from 1 to 7 cannot be numbered\nhint: give the array "
                      "indices without gaps (--array=0-1), or --shard k/n\n");
}

TEST_CASE("mpirun with four ranks gives the bytes of one process", "[sweep]")
{
    if (run_shell("command -v mpirun").status != 0) return; // nothing starts ranks here
    const std::string folder = fresh_folder();
    const std::string command = "sweep '" + models_folder() + "/pendulum.toml' --random 101 --initial w=-9:9 -o ";
    const std::string lagen = "cd '" + folder + "' && CXXFLAGS=-O1 LAGEN_CACHE='" + folder + "/cache' ";
    REQUIRE(run_shell(lagen + LAGEN_PROGRAM " " + command + "one.csv").status == 0);
    const Shell shell =
        run_shell(lagen + "mpirun --allow-run-as-root --oversubscribe -n 4 " LAGEN_PROGRAM " " + command + "four.csv");
    INFO(shell.output);
    REQUIRE(shell.status == 0);
    CHECK(read_text(folder + "/four.csv") == read_text(folder + "/one.csv"));
}
