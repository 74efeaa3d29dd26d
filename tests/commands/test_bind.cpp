// SPDX-License-Identifier: GPL-2.0-or-later
/// `--bind`: parameters that become constants of the equations.
#include "program.hpp"

#include "support/golden.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string_view>

using namespace lagen::testing;
using Catch::Contains;

namespace {

/// t = 2 and the state there.
std::vector<double> bound_end_of(std::vector<std::string> arguments)
{
    arguments.insert(arguments.end(), {"--at", "2", "--tolerance", "1e-12"});
    return last_row(arguments);
}

double row_difference(const std::vector<double>& a, const std::vector<double>& b)
{
    REQUIRE(a.size() == b.size());
    double most = 0;
    for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, std::fabs(a[k] - b[k]));
    return most;
}

/// Of the line of `kernel` in the table of operations: + -, *, /.
std::vector<int> operations(const std::string& header, const std::string& kernel)
{
    const std::size_t line = header.find("///   " + kernel + " ");
    REQUIRE(line != std::string::npos);
    std::istringstream words(header.substr(line + 6 + kernel.size()));
    std::vector<int> counts(3);
    for (int& count : counts) words >> count;
    REQUIRE(words);
    return counts;
}

} // namespace

TEST_CASE("a bound parameter is a constant of the header: no member, folded, told of, and in the command that makes it")
{
    const std::string plain = call({"generate", "rigid_body.toml"}).out;
    const Outcome bound = done({"generate", "rigid_body.toml", "--bind", "I1=2,I2=2, I3 = 1"});
    CHECK_THAT(bound.out, Contains("/// Constant: I1 = 2\n/// Constant: I2 = 2\n/// Constant: I3 = 1\n"));
    CHECK_THAT(bound.out, Contains("lagen generate rigid_body.toml --bind I1=2 --bind I2=2 --bind 'I3= 1' -o"));
    CHECK_THAT(bound.out, Contains("struct Parameters {} parameters;"));
    const std::vector<int> before = operations(plain, "rhs"), after = operations(bound.out, "rhs");
    CHECK(after[0] < before[0]);
    CHECK(after[1] < before[1]);
    CHECK(after[2] <= before[2]);
    // I1 = I2: the third rate is nought.
    CHECK_THAT(bound.out, Contains("ds[2] = S(0);"));
}

TEST_CASE("a name alone is bound to the value that it has")
{
    const Outcome one = done({"generate", "heavy_top.toml", "--set", "mgl=3", "--bind", "mgl"});
    CHECK_THAT(one.out, Contains("/// Constant: mgl = 3\n"));
    const Outcome same = done({"generate", "heavy_top.toml", "--bind", "mgl=3"});
    const std::string_view kernels = "rhs(";
    CHECK(one.out.substr(one.out.find(kernels)) == same.out.substr(same.out.find(kernels)));
}

TEST_CASE("--set and --bind do not both give a value to the same parameter", "[run]")
{
    const std::pair<const char*, const char*> pairs[] = {{"m=1", "m=2"}, {"m[7]=1", "m=2"}, {"m=1", "m[7]=2"}};
    for (const auto& [set, bind] : pairs) {
        const Outcome outcome = call({"generate", "pleiades.toml", "--set", set, "--bind", bind});
        CHECK(outcome.code == 4);
        CHECK_THAT(outcome.err, Catch::StartsWith("lagen generate: --set gives 'm"));
    }
    // The names are different entries, or --bind takes the value of --set.
    CHECK(call({"generate", "pleiades.toml", "--set", "m[1]=2", "--bind", "m[7]=2"}).code == 0);
    CHECK(call({"generate", "pleiades.toml", "--set", "m[7]=2", "--bind", "m"}).code == 0);
}

TEST_CASE("a family is bound whole or an entry at a time", "[run]")
{
    const Outcome whole = done({"generate", "pleiades.toml", "--bind", "m"});
    CHECK_THAT(whole.out, Contains("/// Constant: m[7] = 7\n") && Contains("struct Parameters {} parameters;"));
    const Outcome entry = done({"generate", "pleiades.toml", "--bind", "m[7]=2"});
    CHECK_THAT(entry.out, Contains("/// Constant: m[7] = 2\n") && Contains("S m_6 = S(6);"));
}

TEST_CASE("a run with bound parameters is the run without, in the scene's values too", "[run]")
{
    for (const std::vector<std::string>& scene : {std::vector<std::string>{}, {"--scene", "softer"}}) {
        std::vector<std::string> arguments{"quartic_body.toml", "--form", "hamilton"};
        arguments.insert(arguments.end(), scene.begin(), scene.end());
        const std::vector<double> plain = bound_end_of(arguments);
        arguments.insert(arguments.end(), {"--bind", "I,c"});
        CHECK(row_difference(plain, bound_end_of(arguments)) < 1e-10);
        // The second time the cache answers.
        CHECK(row_difference(plain, bound_end_of(arguments)) < 1e-10);
    }
    const std::vector<double> file = bound_end_of({"quartic_body.toml", "--bind", "c"});
    CHECK(row_difference(file, bound_end_of({"quartic_body.toml", "--bind", "c", "--scene", "softer"})) > 1e-3);
    CHECK(row_difference(file, bound_end_of({"quartic_body.toml", "--bind", "c=0.25"})) > 1e-3);
    CHECK(row_difference(bound_end_of({"quartic_body.toml", "--set", "k=0.3", "--bind", "c"}),
                         bound_end_of({"quartic_body.toml", "--set", "k=0.3"})) < 1e-10);
}

TEST_CASE("rows of a sweep with bound parameters are the runs with them", "[sweep]")
{
    const std::string folder = fresh_folder();
    const Outcome swept = done({"sweep", "rigid_body.toml", "--bind", "I1", "--initial", "w3=4:6:2", "--t-end", "1",
                                "--tolerance", "1e-12", "-o", folder + "/a.csv"});
    std::istringstream rows(read_text(folder + "/a.csv"));
    std::string heading, row;
    REQUIRE(std::getline(rows, heading));
    for (const char* w3 : {"4", "6"}) {
        REQUIRE(std::getline(rows, row));
        const Outcome run = done({"run", "rigid_body.toml", "--bind", "I1", "--initial", std::string("w3=") + w3,
                                  "--at", "1", "--t-end", "1", "--tolerance", "1e-12"});
        std::istringstream lines(run.out), values;
        std::string line, value;
        REQUIRE(std::getline(lines, line));
        REQUIRE(std::getline(lines, line));
        std::istringstream swept_values(row);
        std::string field;
        for (int skipped = 0; skipped < 2; ++skipped) REQUIRE(std::getline(swept_values, field, ','));
        values.str(line);
        while (std::getline(values, value, ',')) {
            REQUIRE(std::getline(swept_values, field, ','));
            CHECK(std::stod(field) == std::stod(value));
        }
    }
}

TEST_CASE("what is proved for a bound value needs no warning and no condition on it")
{
    const Outcome bound = call({"generate", "quartic_body.toml", "--form", "hamilton", "--bind", "c"});
    CHECK(bound.code == 0);
    CHECK(bound.err.empty());
    CHECK_THAT(bound.out, Contains("/// left_domain unless I > 0.\n") && !Contains("WARNING"));
}
