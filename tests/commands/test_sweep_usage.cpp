// SPDX-License-Identifier: GPL-2.0-or-later
/// What a sweep that makes no sense is answered, beside tests/errors/commands.
#include "program.hpp"

#include "support/golden.hpp"

#include "commands/sweep/sweep_run.hpp"
#include "scene/table.hpp"

#include <catch2/catch.hpp>

using namespace lagen::testing;

namespace {

/// Nothing is written, and this is said.
void sweep_refused(std::vector<std::string> arguments, int code, const std::string& text)
{
    const std::string folder = fresh_folder();
    arguments.insert(arguments.begin(), {"sweep", models_folder() + "/pendulum.toml", "-o", "a.csv"});
    const Outcome outcome = call(arguments, {.folder = folder});
    INFO(text);
    CHECK(outcome.code == code);
    CHECK(outcome.out.empty());
    CHECK(outcome.err == text);
    CHECK(names_in(folder).empty());
}

const std::vector<std::string> a_range{"--initial", "w=0:1:3"};

std::vector<std::string> with(std::vector<std::string> more)
{
    more.insert(more.begin(), a_range.begin(), a_range.end());
    return more;
}

} // namespace

TEST_CASE("options of a sweep that exclude each other or are no numbers are refused", "[sweep]")
{
    sweep_refused({"--random", "3", "--ensemble", "a"}, 4, "lagen sweep: --random and --ensemble exclude each other\n");
    sweep_refused(with({"--seed", "3"}), 4, "lagen sweep: --seed needs --random\n");
    sweep_refused({"--ensemble", "a", "--set", "g=1:2:3"}, 4,
                  "lagen sweep: --set g=1:2:3: the values of an ensemble stand in its file\n");
    sweep_refused({"--random", "0", "--set", "g=1:2"}, 4,
                  "lagen sweep: --random is '0', where a whole number from 1 on is required\n");
    sweep_refused({"--random", "3", "--seed", "-1", "--set", "g=1:2"}, 4,
                  "lagen sweep: --seed is '-1', where a whole number from 0 on is required\n");
    sweep_refused(with({"--threads", "0"}), 4,
                  "lagen sweep: --threads is '0', where a whole number from 1 to 4096 is required\n");
    for (const std::string shard : {"3/3", "1", "/", "-1/2", "0/0"})
        sweep_refused(with({"--shard", shard}), 4,
                      "lagen sweep: --shard is '" + shard + "', where k/n with 0 <= k < n is required\n");
    sweep_refused(with({"--initial", "w=1:2:3"}), 4, "lagen sweep: --initial w=1:2:3: it is swept twice\n");
    sweep_refused(with({"--set", "g=1:2:999999999999999", "--set", "l=1:2:2"}), 4,
                  "lagen sweep: the grid has more than 1e15 points\n");
    sweep_refused({"b.toml", "--set", "g=1:2:3"}, 4,
                  "lagen sweep: unexpected argument 'b.toml' (see lagen sweep --help)\n");
    sweep_refused({"--merge", "--set", "g=1:2:3"}, 4,
                  "lagen sweep: --merge takes the parts and --output alone, found --set\n");
    const Outcome nowhere = call({"sweep", "pendulum.toml", "--set", "g=1:2:3"});
    CHECK(nowhere.code == 4);
    CHECK(nowhere.err == "lagen sweep: --output FILE is missing\n");
    CHECK(call({"sweep", "pendulum.toml", "--set", "g=1:2:3", "-o", "nowhere/a.csv"}).err ==
          "error: cannot write 'nowhere/a.csv': No such file or directory\n");
    CHECK(call({"sweep", "pendulum.toml", "--set", "g=1:2:3", "-o", "."}).err ==
          "error: cannot write '.': Is a directory\n");
}

TEST_CASE("ends of ranges are numbers", "[sweep]")
{
    sweep_refused(
        {"--set", "g=1:l:3"}, 3,
        "<--set g>:1:3: error: a range of --set ends at an expression of 'l', where a number is required\n  1:l:3\n "
        "   ^\n");
    sweep_refused(
        {"--set", "g=1:log(0):3"}, 3,
        "<--set g>:1:3: error: a range of --set ends at -inf, where a finite number is required\n  1:log(0):3\n    "
        "^~~~~~\n");
    sweep_refused(
        {"--set", "g=th:1:3"}, 3,
        "<--set g>:1:1: error: --set depends on 'th', which is no parameter\n  th:1:3\n  ^~\nhint: give numbers, or "
        "expressions of parameters\n");
}

TEST_CASE("an ensemble that is none is refused at its place", "[sweep]")
{
    const std::string folder = fresh_folder();
    const auto answer = [&](const std::string& text) {
        write_text(folder + "/e.csv", text);
        const Outcome outcome = call(
            {"sweep", models_folder() + "/pendulum.toml", "--ensemble", "e.csv", "-o", "a.csv"}, {.folder = folder});
        CHECK(names_in(folder) == std::vector<std::string>{"e.csv"});
        CHECK(outcome.code != 0);
        return outcome.err;
    };
    CHECK(answer("") == "lagen sweep: the ensemble 'e.csv' is no file that can be read, or empty\n");
    CHECK(answer("\r\n\r\n") == "lagen sweep: the ensemble 'e.csv' has no heading\n");
    CHECK(answer("w\r\n") == "lagen sweep: the ensemble 'e.csv' has no rows\n");
    CHECK(answer("w,w\n1,2\n") == "e.csv:1:3: error: the column 'w' stands there twice\n  w,w\n    ^\n");
    CHECK(answer("w,g\n1,2\n3\n") == "e.csv:3:1: error: row 1 has 1 fields, where the heading has 2\n  3\n  ^\n");
}

TEST_CASE("names of columns are identifiers, and times are told in their two largest units", "[sweep]")
{
    CHECK(lagen::duration_text(2.3) == "3 s");
    CHECK(lagen::duration_text(59.5) == "1 min 0 s");
    CHECK(lagen::duration_text(3725) == "1 h 2 min");
    CHECK(lagen::duration_text(200'000) == "2 d 7 h");
}
