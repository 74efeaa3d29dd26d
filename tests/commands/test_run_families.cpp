// SPDX-License-Identifier: GPL-2.0-or-later
/// Models with families from end to end: checked, derived, generated, compiled, run and plotted, under the names x[1],
/// W[1,2] outside of C++ and x_1, W_1_2 in it.
#include "program.hpp"

#include "support/json.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

using namespace lagen::testing;
using Catch::Contains;
namespace json = lagen::json;

namespace {

using Columns = std::vector<std::string>;

/// x1..x7, y1..y7 and their rates at t = 3 [Test Set for IVP Solvers, Bari and Amsterdam: Pleiades problem].
constexpr double pleiades_at_3[] = {0.3706139143970502,  3.237284092057233,  -3.222559032418324,  0.659709145577531,
                                    0.3425581707156584,  1.562172101400631,  -0.7003092922212495, -3.943437585517392,
                                    -3.27138097397255,   5.225081843456543,  -2.59061243497747,   1.198213693392275,
                                    -0.2429682344935824, 1.09144924042898,   3.417003806314313,   1.354584501625501,
                                    -2.590065597810775,  2.025053734714242,  -1.155815100160448,  -0.8072988170223021,
                                    0.595239635420871,   -3.74124496123401,  0.377345968575063,   0.9386858869551074,
                                    0.3667922227200571,  -0.347404635380849, 2.344915448180937,   -1.947020434263292};

/// Jupiter and Pluto after 200000 days, in quadruple precision by two tolerances that agree to 20 digits.
constexpr double jupiter_at_200000[] = {2.61107957011286336008, -5.07952549678798696378, -2.24472067785305724453};
constexpr double pluto_at_200000[] = {36.5669506988226043798, -13.7676844012596252561, -15.0434692218232634938};

} // namespace

TEST_CASE("the Pleiades end where the literature has them, at all 28 published values", "[long]")
{
    const json::Value value = finished_run({"pleiades.toml", "--at", "3"});
    REQUIRE(value["columns"].size() == 29);
    CHECK(value["columns"][1].text == "x[1]");
    CHECK(value["columns"][28].text == "v[7]");
    // Two runs that start 1e-16 apart are some 1e-12 apart by then: pairs of stars have passed close by each other.
    for (std::size_t k = 0; k < 28; ++k) CHECK(std::fabs(value["rows"][0][k + 1].decimal() - pleiades_at_3[k]) < 1e-11);
    CHECK(value["invariants"].keys == Columns{"energy", "momentum[1]", "momentum[2]", "angular_momentum"});
}

TEST_CASE("Jupiter and Pluto are where quadruple precision has them after 200000 days", "[long]")
{
    const json::Value value = finished_run({"outer_solar_system.toml", "--at", "200000"});
    REQUIRE(value["columns"].size() == 37);
    CHECK(value["columns"][6].text == "Q[2,3]");
    for (std::size_t k = 0; k < 3; ++k) {
        CHECK(std::fabs(value["rows"][0][4 + k].decimal() - jupiter_at_200000[k]) < 1e-7);
        CHECK(std::fabs(value["rows"][0][16 + k].decimal() - pluto_at_200000[k]) < 1e-7);
    }
}

TEST_CASE("a chain of two links is the double pendulum", "[all]")
{
    std::ostringstream chain;
    chain << std::ifstream(models_folder() + "/chain.toml").rdbuf();
    const std::string path = fresh_folder() + "/chain.toml";
    std::ofstream(path) << chain.str()
                        << "\n[scene.two]\ninitial = { a = [1.2, -0.7], w = [0.5, 1.1] }\n"
                           "parameters = { m = [1, 0.6], l = [1, 0.8] }\nduration = 2\ntolerance = 1e-12\n";
    const json::Value links = finished_run({path, "--set", "n=2", "--scene", "two", "--at", "1,2"});
    CHECK(links["columns"].texts() == Columns{"t", "a[1]", "a[2]", "w[1]", "w[2]"});
    const json::Value rods = finished_run({"double_pendulum.toml", "--at", "1,2", "--tolerance", "1e-12"});
    for (const std::size_t row : {0U, 1U}) {
        for (std::size_t k = 1; k <= 4; ++k)
            CHECK(std::fabs(links["rows"][row][k].decimal() - rods["rows"][row][k].decimal()) < 1e-9);
    }
    CHECK(std::fabs(rods["rows"][1][1].decimal()) > 0.01);
}

TEST_CASE("a vector and a matrix are identifiers in CSV and keep their names in JSON and pictures", "[run]")
{
    const std::string picture = fresh_folder() + "/rotor.svg";
    const Outcome outcome = done({"run", "rotor.toml", "--scene", "matrix", "--plot", picture});
    CHECK(outcome.out == call({"run", "rotor.toml", "--scene", "matrix"}).out);
    CHECK_THAT(outcome.out, Catch::StartsWith("t,W_1_1,W_1_2,W_2_1,W_2_2,turned_1,turned_2\r\n0,0,-1,1,0,-2,1\r\n"));
    std::ostringstream svg;
    svg << std::ifstream(picture).rdbuf();
    CHECK_THAT(svg.str(), Contains(">W[1,2]<") && Contains(">turned[1]<"));
    const json::Value value = finished_run({"rotor.toml", "--set", "m=[9,1]", "--set", "m[n]=4", "--at", "1/n,1"});
    CHECK(value["columns"].texts() == Columns{"t", "x[1]", "x[2]", "v_x[1]", "v_x[2]"});
    CHECK(std::fabs(value["rows"][1][1].decimal() - std::cos(1.0)) < 1e-9);
    CHECK(std::fabs(value["rows"][0][2].decimal() - 2 * std::cos(0.5)) < 1e-9);
}

TEST_CASE("indices become parts of identifiers in C++ and subscripts in LaTeX")
{
    const Outcome header = call({"generate", "rotor.toml"});
    CHECK(header.code == 0);
    CHECK_THAT(header.out, Contains("S W_1_2 = S(-1);") && Contains("S x_1 = S(0);") && Contains("S v_x_2 = S(0);"));
    CHECK_THAT(header.out, Contains("observables_names = {\"turned[1]\", \"turned[2]\"}"));
    const Outcome latex = call({"derive", "rotor.toml", "--format", "latex"});
    CHECK_THAT(latex.out, Contains("p_{v_{x_{1}}} &= m_{1}\\, v_{x_{1}}"));
    const Outcome text = call({"derive", "rotor.toml"});
    CHECK_THAT(text.out, Contains("ẋ[1] = v_x[1]"));
}

TEST_CASE("invariants from the command line may be sums and vectors")
{
    const Outcome outcome = call({"check", "rotor.toml", "--format", "json", "--invariant",
                                  "sum(i, 1, n, m[i]*(v_x[i]^2 + x[i]^2))", "--invariant", "v_x^2 + x^2"});
    CHECK(outcome.code == 3);
    CHECK_THAT(outcome.err, Contains("<--invariant>:1:1: error:"));
    const Outcome proved =
        call({"check", "rotor.toml", "--format", "json", "--invariant", "sum(i, 1, n, m[i]*(v_x[i]^2 + x[i]^2))",
              "--invariant", "[v_x[1]^2 + x[1]^2, v_x[2]^2 + x[2]^2]", "--invariant", "[dot(x, x), x[1]]"});
    CHECK(proved.code == 1);
    const json::Value value = json::parse(proved.out);
    Columns names;
    for (const json::Value& check : value["checks"].entries)
        names.push_back(check["indices"][0].text + " " + check["status"].text);
    CHECK(names == Columns{"sum(i, 1, n, m[i]*(v_x[i]^2 + x[i]^2)) proved",
                           "([v_x[1]^2 + x[1]^2, v_x[2]^2 + x[2]^2])[1] proved",
                           "([v_x[1]^2 + x[1]^2, v_x[2]^2 + x[2]^2])[2] proved", "([dot(x, x), x[1]])[1] refuted",
                           "([dot(x, x), x[1]])[2] refuted"});
}

TEST_CASE("a bare name that is no file here means the example model, and standard error says which")
{
    Surroundings empty;
    empty.folder = fresh_folder();
    const Outcome example = call({"check", "kepler"}, empty);
    CHECK(example.code == 0);
    CHECK_THAT(example.err, Catch::StartsWith("note: 'kepler' is the example model ") && Contains("/kepler.toml\n"));
    CHECK_THAT(call({"check", "./kepler"}, empty).err, Contains("the model file './kepler' does not exist"));
    CHECK(call({"check", "kepler.toml"}, empty).code == 3);
    CHECK_THAT(call({"check", "keppler"}, empty).err, Contains("the model file 'keppler' does not exist"));
    // A model of that name in this folder is not passed over in silence.
    std::ofstream(empty.folder + "/kepler.toml") << "name = 'mine'\n";
    CHECK_THAT(call({"check", "kepler"}, empty).err, Contains("the model file 'kepler' does not exist"));
}
