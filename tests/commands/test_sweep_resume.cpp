// SPDX-License-Identifier: GPL-2.0-or-later
/// Sweeps that end early: killed, interrupted, without room on the disk; and sweeps of several processes.
#include "program.hpp"
#include "sweep_table.hpp"

#include "support/golden.hpp"

#include <catch2/catch.hpp>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>
#include <thread>

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
    CHECK(names_in(slow.folder) == std::vector<std::string>{"a.csv"});
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
    for (const std::vector<std::string>& other :
         {std::vector<std::string>{"--t-end", "29"}, {"--initial", "v=1/3"}, {"--shard", "0/2"}}) {
        std::vector<std::string> more = other;
        more.push_back("--resume");
        const Outcome refused = slow.sweep(more);
        CHECK(refused.code == 4);
        CHECK(refused.err == "lagen sweep: 'a.csv.partial' was begun by another sweep\nhint: --resume goes on with the "
                             "same model, options and lagen; without it the sweep begins anew\n");
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
    CHECK(names_in(folder) == std::vector<std::string>{"array.csv", "mpi.csv", "slurm.csv", "whole.csv"});

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
    const std::string lagen = "cd '" + folder + "' && LAGEN_CACHE='" + folder + "/cache' ";
    REQUIRE(run_shell(lagen + LAGEN_PROGRAM " " + command + "one.csv").status == 0);
    const Shell shell =
        run_shell(lagen + "mpirun --allow-run-as-root --oversubscribe -n 4 " LAGEN_PROGRAM " " + command + "four.csv");
    INFO(shell.output);
    REQUIRE(shell.status == 0);
    CHECK(read_text(folder + "/four.csv") == read_text(folder + "/one.csv"));
}
