// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen sweep`: which rows there are, what stands in them, and that nothing but the command decides about their
/// bytes.
#include "program.hpp"
#include "sweep_table.hpp"

#include "machine/philox.hpp"
#include "support/golden.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lagen::testing;
using Catch::Contains;

namespace {

/// The values that a row of a sweep sets, as options of `run`.
std::vector<std::string> options_of(const CsvTable& table, std::size_t row)
{
    std::vector<std::string> options;
    for (std::size_t k = 0; k < table.heading.size(); ++k)
        for (const std::string option : {"set", "initial"})
            if (table.heading[k].starts_with(option + "."))
                options.insert(options.end(),
                               {"--" + option, table.heading[k].substr(option.size() + 1) + "=" + table.rows[row][k]});
    return options;
}

/// Row `row` of the sweep against the table and the report of `run` with the same values.
void check_against_run(const CsvTable& sweep, std::size_t row, std::vector<std::string> model,
                       const Surroundings& around = {})
{
    const std::vector<std::string> values = options_of(sweep, row);
    model.insert(model.begin(), "run");
    model.insert(model.end(), values.begin(), values.end());
    const Outcome outcome = call(model, around);
    INFO(outcome.err);
    const CsvTable run = read_csv(outcome.out);
    REQUIRE_FALSE(run.rows.empty());
    for (std::size_t k = 0; k < run.heading.size(); ++k) {
        const std::string& name = run.heading[k];
        INFO(name << " of row " << row);
        const double end = number_of(run.rows.back()[k]);
        CHECK(number_of(sweep.at(row, name)) == end);
        if (name == "t") continue;
        double least = end, most = end;
        for (const std::vector<std::string>& each : run.rows) {
            least = std::min(least, number_of(each[k]));
            most = std::max(most, number_of(each[k]));
        }
        CHECK(number_of(sweep.at(row, "min." + name)) <= least);
        CHECK(number_of(sweep.at(row, "max." + name)) >= most);
    }
}

/// Rows of many bodies, first and last, where runs and the sweep are compiled with these CXXFLAGS.
void check_rows_compiled_with(const std::string& flags)
{
    const Surroundings around{.environment = {{"CXXFLAGS", flags}, {"CXX", ""}}};
    const std::string file = fresh_folder() + "/a.csv";
    const std::vector<std::string> model{"outer_solar_system.toml", "--method", "taylor"};
    std::vector<std::string> arguments{"sweep"};
    arguments.insert(arguments.end(), model.begin(), model.end());
    arguments.insert(arguments.end(), {"--set", "G=2.9e-4:3e-4:9", "-o", file});
    const Outcome outcome = done(arguments, around);
    for (const std::size_t row : {0U, 8U}) check_against_run(read_csv(read_text(file)), row, model, around);
}

/// Sweeps, and compares rows with `lagen run`.
CsvTable check_sweep(std::vector<std::string> model, const std::vector<std::string>& ranges, std::size_t rows)
{
    const std::string file = fresh_folder() + "/a.csv";
    std::vector<std::string> arguments = model;
    arguments.insert(arguments.begin(), "sweep");
    arguments.insert(arguments.end(), ranges.begin(), ranges.end());
    arguments.insert(arguments.end(), {"-o", file});
    const Outcome outcome = done(arguments);
    CsvTable table = read_csv(read_text(file));
    REQUIRE(table.rows.size() == rows);
    for (std::size_t row = 0; row < rows; row += 1 + rows / 2) check_against_run(table, row, model);
    return table;
}

/// The column `status` of a sweep into `file`, and what was said.
std::pair<std::vector<std::string>, std::string> statuses_of(std::vector<std::string> arguments,
                                                             const std::string& file)
{
    arguments.insert(arguments.begin(), "sweep");
    arguments.insert(arguments.end(), {"-o", file});
    const Outcome outcome = done(arguments);
    std::vector<std::string> found;
    const CsvTable table = read_csv(read_text(file));
    for (std::size_t k = 0; k < table.rows.size(); ++k) {
        found.push_back(table.at(k, "status"));
        CHECK(table.rows[k].size() == table.heading.size());
    }
    return {found, outcome.err};
}

} // namespace

TEST_CASE("a grid has the ends of its ranges and equal steps between them, the last range fastest", "[sweep]")
{
    const std::string folder = fresh_folder();
    const Outcome outcome = call({"sweep", "oscillator.toml", "--initial", "x=0:0.3:4", "--initial", "v=1:-1:2",
                                  "--t-end", "2", "-o", folder + "/a.csv"});
    CHECK(outcome.code == 0);
    CHECK(outcome.out.empty());
    CHECK(outcome.err == folder + "/a.csv: 8 rows\n");
    const CsvTable table = read_csv(read_text(folder + "/a.csv"));
    CHECK(table.heading == std::vector<std::string>{"index", "initial.x", "initial.v", "t", "x", "v", "min.x", "max.x",
                                                    "min.v", "max.v", "status"});
    const std::vector<std::string> x{"0", "0", "0.1", "0.1", "0.2", "0.2", "0.3", "0.3"};
    REQUIRE(table.rows.size() == 8);
    for (std::size_t k = 0; k < 8; ++k) {
        CHECK(table.rows[k][0] == std::to_string(k));
        CHECK(table.rows[k][1] == x[k]);
        CHECK(table.rows[k][2] == (k % 2 == 0 ? "1" : "-1"));
        CHECK(table.rows[k][3] == "2");
        CHECK(table.rows[k].back() == "ok");
        const double x0 = number_of(x[k]), v0 = k % 2 == 0 ? 1 : -1;
        CHECK(std::abs(number_of(table.at(k, "x")) - (x0 * std::cos(2.0) + v0 * std::sin(2.0))) < 1e-9);
        // x = r cos(t - a) turns at t = a, which is inside the run for v > 0.
        const double turn = std::hypot(x0, v0);
        if (v0 > 0) CHECK(std::abs(number_of(table.at(k, "max.x")) - turn) < 1e-4);
        if (v0 > 0) CHECK(number_of(table.at(k, "max.x")) <= turn + 1e-9);
    }
    CHECK(names_in(folder) == std::vector<std::string>{"a.csv", "a.csv.sweep"});
}

TEST_CASE("each row has the bits of lagen run with the values that stand in it", "[sweep]")
{
    SECTION("an event ends each run at its own time")
    {
        const CsvTable table = check_sweep({"pendulum.toml", "--scene", "first_turn"}, {"--initial", "w=6.9:8.1:3"}, 3);
        for (std::size_t row = 0; row < 3; ++row) {
            CHECK(table.at(row, "status") == "stopped_by_event");
            CHECK(table.at(row, "event.over_the_top.count") == "1");
            CHECK(table.at(row, "event.over_the_top.t") == table.at(row, "t"));
        }
    }
    SECTION("trajectories on the lanes of packs, with functions and series")
    {
        check_sweep({"double_pendulum.toml", "--method", "taylor"}, {"--initial", "a=0.2:2.2:21"}, 21);
    }
}

TEST_CASE("each row has the bits of lagen run, for other forms and methods too", "[all]")
{
    SECTION("the duration follows from what is set")
    {
        check_sweep({"pendulum.toml", "--scene", "small"}, {"--set", "g=9.1:10.7:4"}, 4);
    }
    SECTION("momenta are made of velocities")
    {
        check_sweep({"heavy_top.toml", "--form", "hamilton"}, {"--set", "I1=1.1:1.3:3", "--initial", "w3=0.1:0.7:3"},
                    9);
    }
    SECTION("steps are fixed, rows have an interval of their own")
    {
        check_sweep({"duffing.toml", "--method", "rk4", "--step", "1/64"}, {"--initial", "q=0.1:1:4"}, 4);
    }
    SECTION("flows of the parts of H")
    {
        check_sweep({"heavy_top.toml", "--form", "hamilton", "--method", "kahanli8", "--step", "0.1"},
                    {"--set", "I1=1.1:1.3:5"}, 5);
    }
}

TEST_CASE("fused multiplication in the processor changes no bit of a row", "[all]")
{
    check_rows_compiled_with("-O1 -march=native");
}

TEST_CASE("vectors of this machine change no bit of a row", "[all]")
{
    check_rows_compiled_with("");
}

TEST_CASE("threads and parts change nothing", "[sweep]")
{
    const std::string folder = fresh_folder();
    const auto sweep = [&](const std::string& name, const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"sweep",     "heavy_top.toml", "--random", "150",          "--seed", "7",
                                           "--initial", "w3=-4:4",        "--set",    "mgl=-0.5:0.5", "-o",     name};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = done(arguments, {.folder = folder});
        return read_text(folder + "/" + name);
    };
    write_text(folder + "/heavy_top.toml", read_text(models_folder() + "/heavy_top.toml"));
    const std::string whole = sweep("one.csv", {"--threads", "1"});
    CHECK(read_csv(whole).rows.size() == 150);
    CHECK(sweep("two.csv", {"--threads", "2"}) == whole);
    CHECK(sweep("three.csv", {"--threads", "3"}) == whole);
    for (const std::string k : {"0", "1", "2"}) sweep("part" + k + ".csv", {"--shard", k + "/3"});
    CHECK(read_csv(read_text(folder + "/part1.csv")).rows[1][0] == "4");
    const auto merge = [&](const std::vector<std::string>& parts) {
        std::vector<std::string> arguments{"sweep", "--merge", "-o", "merged.csv"};
        arguments.insert(arguments.end(), parts.begin(), parts.end());
        return call(arguments, {.folder = folder});
    };
    CHECK(merge({"part2.csv", "part0.csv", "part1.csv"}).code == 0);
    CHECK(read_text(folder + "/merged.csv") == whole);
    CHECK(merge({"part2.csv", "part0.csv"}).err == "lagen sweep: part 1/3 is missing\n");
    CHECK(merge({"part2.csv", "part0.csv", "part2.csv"}).err ==
          "lagen sweep: part 2/3 is given twice, by 'part2.csv' and 'part2.csv'\n");
    CHECK(merge({"part2.csv", "two.csv"}).err ==
          "lagen sweep: 'part2.csv' and 'two.csv' are not parts of the same sweep\n");
    CHECK(merge({"part2.csv", "heavy_top.toml"}).err ==
          "lagen sweep: 'heavy_top.toml' is no complete part of a sweep: 'heavy_top.toml.sweep' does not say so\n");
    // Another build, which is no part of the key.
    for (const auto& [name, build] :
         {std::pair("/part1.csv.sweep", "lagen 7, c++ 3"), {"/part2.csv.sweep", "lagen 6, c++ 3"}}) {
        const std::string said = read_text(folder + name);
        const std::size_t at = said.find("build=lagen "), end = said.find('\n', at);
        REQUIRE(at != std::string::npos);
        CHECK_THAT(said.substr(at, end - at), Contains("), clang++ -std=c++20 -O2 -O1 -include "));
        write_text(folder + name, said.substr(0, at + 6) + build + said.substr(end));
    }
    const Outcome mixed = merge({"part2.csv", "part1.csv"});
    CHECK(mixed.code == 4);
    CHECK(mixed.err ==
          "lagen sweep: two builds have made these parts:\n  'part2.csv': lagen 6, c++ 3\n  'part1.csv': lagen "
          "7, c++ 3\nhint: make all parts with one of them\n");
    for (const std::string k : {"0", "1", "2"}) sweep("part" + k + ".csv", {"--shard", k + "/3"});
    sweep("other.csv", {"--shard", "1/3", "--t-end", "1"});
    CHECK(merge({"part2.csv", "part0.csv", "other.csv"}).err ==
          "lagen sweep: 'part2.csv' and 'other.csv' are not parts of the same sweep\n");
    const std::string part = read_text(folder + "/part1.csv");
    write_text(folder + "/part1.csv", part.substr(0, part.size() - 30));
    const std::string mark = read_text(folder + "/merged.csv.sweep"), unfinished = "of another sweep";
    write_text(folder + "/merged.csv.partial", unfinished);
    CHECK(merge({"part2.csv", "part0.csv", "part1.csv"}).err ==
          "lagen sweep: 'part1.csv' has no line that begins with '148,' where it must stand\n");
    CHECK(read_text(folder + "/merged.csv") == whole);
    CHECK(read_text(folder + "/merged.csv.sweep") == mark);
    CHECK(read_text(folder + "/merged.csv.partial") == unfinished);
}

TEST_CASE("draws are those of Philox, in their range, and row k does not depend on how many there are", "[sweep]")
{
    using Words = lagen::PhiloxCounter;
    // The known answers of Random123, kat_vectors.
    CHECK(lagen::philox({0, 0, 0, 0}, {0, 0}) == Words{0x6627e8d5U, 0xe169c58dU, 0xbc57ac4cU, 0x9b00dbd8U});
    CHECK(lagen::philox({0xffffffffU, 0xffffffffU, 0xffffffffU, 0xffffffffU}, {0xffffffffU, 0xffffffffU}) ==
          Words{0x408f276dU, 0x41c83b0eU, 0xa20bc7c6U, 0x6d5451fdU});
    CHECK(lagen::philox({0x243f6a88U, 0x85a308d3U, 0x13198a2eU, 0x03707344U}, {0xa4093822U, 0x299f31d0U}) ==
          Words{0xd16cfe09U, 0x94fdccebU, 0x5001e420U, 0x24126ea1U});
    double sum = 0, squares = 0;
    constexpr int draws = 20'000;
    for (int k = 0; k < draws; ++k) {
        const double u = lagen::uniform_number(1, static_cast<std::uint64_t>(k), 0);
        CHECK((u >= 0 && u < 1));
        sum += u - 0.5;
        squares += (u - 0.5) * (u - 0.5);
    }
    CHECK(std::abs(sum / draws) < 4 * std::sqrt(1.0 / 12 / draws));
    CHECK(std::abs(squares / draws - 1.0 / 12) < 4 * std::sqrt(1.0 / 180 / draws));

    const std::string folder = fresh_folder();
    const auto drawn = [&](const std::string& count, const std::string& seed) {
        const Outcome outcome = done({"sweep", "oscillator.toml", "--random", count, "--seed", seed, "--initial",
                                      "x=2:3", "--initial", "v=-1:0", "-o", folder + "/a.csv"});
        return read_text(folder + "/a.csv");
    };
    const std::string nine = drawn("9", "18446744073709551");
    CHECK(nine.starts_with(drawn("5", "18446744073709551")));
    CHECK_FALSE(nine == drawn("9", "1"));
    const CsvTable table = read_csv(nine);
    for (std::size_t k = 0; k < table.rows.size(); ++k) {
        CHECK((number_of(table.at(k, "initial.x")) >= 2 && number_of(table.at(k, "initial.x")) <= 3));
        CHECK((number_of(table.at(k, "initial.v")) >= -1 && number_of(table.at(k, "initial.v")) <= 0));
    }
}

TEST_CASE("the rows of an ensemble are those of its file", "[sweep]")
{
    const std::string folder = fresh_folder();
    write_text(folder + "/starts.csv", "\xEF\xBB\xBFinitial.w, \"g\"\r\n6.5,9.81\r\n\r\n1e0 ,\"1.25e1\"\r\n");
    const Outcome outcome =
        call({"sweep", "pendulum.toml", "--ensemble", folder + "/starts.csv", "-o", folder + "/a.csv"});
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const CsvTable table = read_csv(read_text(folder + "/a.csv"));
    REQUIRE(table.rows.size() == 2);
    CHECK(table.heading[1] == "initial.w");
    CHECK(table.heading[2] == "set.g");
    CHECK(table.rows[1][1] == "1");
    CHECK(table.rows[1][2] == "12.5");
    check_against_run(table, 0, {"pendulum.toml"});
    check_against_run(table, 1, {"pendulum.toml"});
}

TEST_CASE("a row that cannot start or go on has a status, and the sweep goes on", "[sweep]")
{
    const std::string file = fresh_folder() + "/a.csv";
    using Texts = std::vector<std::string>;
    const auto [fall, told] =
        statuses_of({"fall.toml", "--scene", "leave", "--initial", "v=-5:5:3", "--initial", "x=-1:1:3"}, file);
    CHECK(fall == Texts{"left_domain", "left_domain", "left_domain", "left_domain", "left_domain", "ok", "left_domain",
                        "left_domain", "ok"});
    CHECK(told == file + ": 9 rows, 7 failed: 7 left_domain\n  left_domain: row 0: the start of scene 'leave' lies "
                         "outside the domain: x > 0 is required, but the left side is -1 and the right side 0\n");
    CHECK(statuses_of({"heavy_top.toml", "--initial", "g1=0.5:0.6:2"}, file).first == Texts{"off_constraint", "ok"});
    CHECK(statuses_of({"kepler.toml", "--set", "eccentricity=0:2:3"}, file).first ==
          Texts{"ok", "non_finite", "non_finite"});
}

TEST_CASE("rows with values that a proof does not hold for are left out, and the sweep goes on", "[all]")
{
    const std::string file = fresh_folder() + "/a.csv";
    using Texts = std::vector<std::string>;
    // What is proved for c = 3/5 alone: other values do not run as if it held for them, and no start rests on it.
    const std::string quartic = fresh_folder() + "/quartic.toml";
    const std::string momenta = "\n[scene.momenta]\ninitial = { p_w1 = 2, p_w2 = 1, p_w3 = 0.5 }\nduration = 1\n";
    write_text(quartic, read_text(models_folder() + "/quartic_body.toml") + momenta);
    const std::vector<std::string> range{"--form", "hamilton", "--set", "c=0.5:0.7:3", "-o", file};
    std::vector<std::string> arguments{quartic, "--scene", "momenta"};
    arguments.insert(arguments.end(), range.begin(), range.end());
    const auto [proved, said] = statuses_of(arguments, file);
    CHECK(proved == Texts{"left_domain", "ok", "left_domain"});
    CHECK(said == file + ": 3 rows, 2 failed: 2 left_domain\nwarning: 2 rows are left out with left_domain: that the "
                         "momenta fix the velocities is proved for c = 3/5 alone\nhint: conditions on parameters in "
                         "[base] domain under which it can be proved make it hold for all of them\n");
    // Such a condition.
    std::string wide = read_text(quartic);
    wide.replace(wide.find("[\"I > 0\"]"), 9, "[\"I > 0\", \"c > 0\"]");
    write_text(quartic, wide);
    CHECK(statuses_of(arguments, file) == std::pair(Texts{"ok", "ok", "ok"}, file + ": 3 rows\n"));
    write_text(quartic, read_text(models_folder() + "/quartic_body.toml") + momenta);
    // Momenta of velocities rest on no proof, velocities of momenta do.
    arguments = {quartic};
    arguments.insert(arguments.end(), range.begin(), range.end());
    CHECK(statuses_of(arguments, file).first == Texts{"left_domain", "ok", "left_domain"});
    const Outcome refused =
        call({"sweep", quartic, "--scene", "momenta", "--form", "lagrange", "--set", "c=0.5:0.7:3", "-o", file});
    CHECK(refused.code == 1);
    CHECK_THAT(refused.err,
               Contains("error: the start converts between momenta and fibre coordinates, which is decided "
                        "for the parameters of the scene alone\nhint: give `initial` the lanes of the form, "
                        "or keep the parameters as they are\n"));
}

TEST_CASE("run --initial changes a start, and names what it cannot change", "[sweep]")
{
    const Outcome changed = call({"run", "oscillator.toml", "--initial", "x=1/4", "--initial", "v=0", "--at", "0"});
    CHECK(changed.out == "t,x,v\r\n0,0.25,0\r\n");
    const Outcome rested =
        call({"run", "heavy_top.toml", "--scene", "drop", "--initial", "w1=1/2*I1/1.2", "--at", "0", "--t-end", "1"});
    CHECK_THAT(rested.out, Contains("\r\n0,0.6,0,0.8,0.5,"));
}
