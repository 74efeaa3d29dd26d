// SPDX-License-Identifier: GPL-2.0-or-later
/// What two tables of rows say of the state, without a run.
#include "commands/report/run.hpp"
#include "scene/table.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>

using namespace lagen;

namespace {

/// Rows of t, x, y; nothing between commas is no finite number.
Table table(const std::string& rows)
{
    Table made{{"t", "x", "y"}, {}};
    std::string field;
    for (const char c : rows) {
        if (c != ',' && c != '\n') {
            field += c;
            continue;
        }
        made.numbers.push_back(field.empty() ? NAN : std::strtod(field.c_str(), nullptr));
        field.clear();
    }
    return made;
}

std::string told(const std::string& rows, const std::string& finer, bool by_number = false)
{
    const std::optional<StateAccuracy> accuracy = accuracy_of(table(rows), table(finer), by_number);
    return accuracy ? text_of(*accuracy) + " " + to_json(record_of(*accuracy)) : "nothing";
}

RunOutcome that_took(double seconds)
{
    RunOutcome outcome;
    outcome.seconds = seconds;
    return outcome;
}

} // namespace

TEST_CASE("the error of the state is the largest distance of two rows in parts of the largest state")
{
    CHECK(told("0,3,4\n1,0.5,0\n2,0,1\n", "0,3,4\n1,0.5,0\n2,5e-8,1\n") ==
          "error of the state: about 1e-8 {\"estimate\": 1e-08, \"holds_until\": null}");
    CHECK(told("0,3,4\n1,5,0\n", "0,3,4\n1,5,0\n") ==
          "error of the state: about 0 {\"estimate\": 0, \"holds_until\": null}");
    CHECK(told("0,0,1\n1,0,1.004\n", "0,0,1\n1,0,1\n").starts_with("error of the state: about 0.004 "));
}

TEST_CASE("digits hold until the first row that is a hundredth of the largest state off")
{
    CHECK(told("0,0,10\n1,0.0999,0\n2.5,0.2,0\n3,0,0\n", "0,0,10\n1,0,0\n2.5,0,0\n3,0,0\n") ==
          "digits hold until t = 2.5 {\"estimate\": 0.02, \"holds_until\": 2.5}");
}

TEST_CASE("rows are compared up to the earlier end, those of an event row by row")
{
    const std::string whole = "0,1,0\n1,1,0\n2,1,0\n";
    CHECK(told(whole, "0,1,0\n1,1,0\n1.7,9,0\n").starts_with("error of the state: about 0 "));
    CHECK(told("0,1,0\n1,1,0\n1.7,9,0\n", whole).starts_with("error of the state: about 0 "));
    CHECK(told(whole, "0,1,0\n") == "nothing");
    CHECK(told("2,1,0\n", "2,1,0\n").starts_with("error of the state: about 0 ")); // the only row that was asked for
    CHECK(told("0,0,1\n1,0,1\n", "0,0,1\n1,1e-18,1\n").starts_with("error of the state: about 0 "));
    CHECK(told("", "") == "nothing");
    CHECK(told("0,1,0\n0.3,1,0\n", "0,1,0\n0.30000000000000004,1,0\n").starts_with("error of the state: about 0 "));
    CHECK(
        told("0.5,1,0\n1.5,1,0\n", "0.50001,1,0\n1.49,1.001,0\n", true).starts_with("error of the state: about 0.001"));
    CHECK(told("0.5,1,0\n1.5,1,0\n", "0.50001,1,0\n", true).starts_with("error of the state: about 0 "));
}

TEST_CASE("what is no finite number in a row is left out, and a row without columns tells nothing")
{
    CHECK(told("0,1,\n1,1,7\n", "0,1,2\n1,1,\n").starts_with("error of the state: about 0 "));
    CHECK(told("0\n1\n", "0\n1\n") == "nothing");
}

TEST_CASE("no second run is made unasked where the first one took more than five seconds")
{
    CHECK(reason_for_one_run(that_took(4.9), SecondRun::short_runs).empty());
    CHECK(reason_for_one_run(that_took(7.31), SecondRun::short_runs) ==
          "not estimated, the run took 7.3 s; --second-run makes a second one");
    CHECK(reason_for_one_run(that_took(7.31), SecondRun::always).empty());
}
