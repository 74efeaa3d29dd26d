// SPDX-License-Identifier: GPL-2.0-or-later
/// Runs with inputs: expressions over the state, and tables whose rows are held.
#include "program.hpp"

#include "support/json.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

using namespace lagen::testing;
namespace json = lagen::json;

namespace {

using Rows = std::vector<std::vector<double>>;

Rows rows_of(const std::vector<std::string>& arguments)
{
    std::vector<std::string> all{"run"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Outcome run = done(all);
    std::istringstream lines(run.out);
    std::string line;
    std::getline(lines, line);
    Rows rows;
    while (std::getline(lines, line)) {
        std::istringstream cells(line);
        rows.emplace_back();
        for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(std::stod(cell));
    }
    return rows;
}

/// t, x, v and u of x'' = 2, -1, -1 on [0, 1), [1, 2), [2, 3].
const Rows pushed{{0, 0, 0, 2}, {1, 1, 2, -1}, {2, 2.5, 1, -1.5}, {3, 3, 0, -1.5}};

void require_near(const Rows& rows, const Rows& expected)
{
    REQUIRE(rows.size() == expected.size());
    for (std::size_t k = 0; k < rows.size(); ++k)
        for (std::size_t i = 0; i < expected[k].size(); ++i)
            CHECK(rows[k][i] == Approx(expected[k][i]).margin(1e-14).epsilon(1e-14));
}

} // namespace

TEST_CASE("between the rows of a table inputs are held: a mass moves on parabolas, exactly", "[run]")
{
    require_near(rows_of({"pushed_mass.toml", "--scene", "table"}), pushed);
    require_near(rows_of({"pushed_mass.toml", "--scene", "table", "--method", "rk4", "--step", "0.3"}), pushed);
    require_near(
        rows_of({"pushed_mass.toml", "--scene", "table", "--form", "hamilton", "--method", "gauss4", "--step", "0.4"}),
        pushed);
    Rows back(pushed.rbegin(), pushed.rend());
    require_near(rows_of({"pushed_mass.toml", "--scene", "back"}), back);
}

TEST_CASE("crossings are counted over the rows of a table, and the work of inputs balances the energy", "[run]")
{
    const Outcome run = done({"run", "pushed_mass.toml", "--scene", "watched", "--format", "json"});
    const json::Value report = json::parse(run.out);
    REQUIRE(report["events"].size() == 2);
    CHECK(std::strtod(report["events"][0]["t"].text.c_str(), nullptr) == Approx(0.75).epsilon(1e-13));
    CHECK(std::strtod(report["events"][1]["t"].text.c_str(), nullptr) == Approx(1.5).epsilon(1e-13));
}

TEST_CASE("a feedback law is a part of the right-hand side", "[run]")
{
    const Rows rows = rows_of({"pushed_mass.toml", "--scene", "feedback"});
    const double x = std::cos(2.0);
    CHECK(rows[1][1] == Approx(x).epsilon(1e-9));
    CHECK(rows[1][2] == Approx(-2 * std::sin(2.0)).epsilon(1e-9));
    CHECK(rows[1][3] == Approx(-4 * x - 0.5).epsilon(1e-9));
}

TEST_CASE("a pole stays upright by a PID controller, and falls without it", "[run]")
{
    const std::string model = "cart_pole.toml";
    const double pi = std::acos(-1.0);
    const auto lowest = [](const Rows& rows) {
        double least = rows[0][2];
        for (const std::vector<double>& row : rows) least = std::min(least, row[2]);
        return least;
    };
    const Rows balanced = rows_of({model, "--scene", "balanced"});
    CHECK(lowest(balanced) > 2.7);
    CHECK(std::abs(balanced.back()[2] - pi) < 0.01);
    CHECK(std::abs(balanced.back()[1]) < 0.05);
    CHECK(lowest(rows_of({model})) < 0);
    const Rows pushed_cart = rows_of({model, "--scene", "pushed"});
    CHECK(pushed_cart[50][3] == -2); // t = 0.75
}

TEST_CASE("a law of inputs stands in a sweep, with the parameters that are swept", "[sweep]")
{
    const std::string table = fresh_folder() + "/spring.csv";
    const Outcome sweep =
        call({"sweep", "pushed_mass.toml", "--scene", "spring", "--set", "stiffness=1:4:2", "-o", table});
    INFO(sweep.err);
    REQUIRE(sweep.code == 0);
    std::ifstream file(table);
    std::string line;
    std::getline(file, line);
    for (const double rate : {1.0, 2.0}) {
        REQUIRE(std::getline(file, line));
        std::istringstream cells(line);
        std::vector<std::string> row;
        for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
        CHECK(std::stod(row[3]) == Approx(std::cos(rate)).epsilon(1e-8));
    }
}
