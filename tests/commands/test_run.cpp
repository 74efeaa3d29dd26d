// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen run` where all goes well: rows, columns, events, drifts, and what the command line changes.
#include "program.hpp"

#include "support/golden.hpp"
#include "support/json.hpp"
#include "support/tolerances.hpp"

#include <catch2/catch.hpp>

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <filesystem>

using namespace lagen::testing;
namespace json = lagen::json;
namespace tolerance = lagen::tolerance;

namespace {

std::vector<double> column(const json::Value& value, std::size_t k)
{
    std::vector<double> numbers;
    for (const json::Value& row : value["rows"].entries) numbers.push_back(std::strtod(row[k].text.c_str(), nullptr));
    return numbers;
}

} // namespace

TEST_CASE(
    "run --format json has exactly the members of the interface, and every number is the shortest that reads back")
{
    const json::Value value = report_of("run", {"oscillator.toml", "--at", "0,1/3,1"});
    CHECK(value.keys == std::vector<std::string>{"model", "scene", "form", "method", "status", "t", "state", "steps",
                                                 "rejected", "rhs_calls", "seconds", "accuracy", "below_absolute",
                                                 "invariants", "casimirs", "constraints", "events", "columns", "rows"});
    CHECK(value["model"].text == "oscillator");
    CHECK(value["scene"].text == "default");
    CHECK(value["form"].text == "lagrange");
    CHECK(value["method"].text == "dop853");
    CHECK(value["status"].text == "ok");
    CHECK(value["columns"].texts() == std::vector<std::string>{"t", "x", "v"});
    CHECK(value["steps"].decimal() > 2);
    CHECK(value["rhs_calls"].decimal() > value["steps"].decimal());
    CHECK(value["events"].size() == 0);
    const json::Value& energy = value["invariants"]["energy"];
    CHECK(energy.keys == std::vector<std::string>{"initial", "max_drift", "t"}); // too few steps for a slope
    CHECK(energy["initial"].text == "0.5");
    CHECK(energy["max_drift"].decimal() < 1e-9);
    REQUIRE(value["rows"].size() == 3);
    CHECK(value["rows"][1][0].text == "0.3333333333333333");
    for (const json::Value& row : value["rows"].entries) {
        const double t = row[0].decimal();
        CHECK(std::abs(row[1].decimal() - std::cos(t)) < 1e-9);
        CHECK(std::abs(row[2].decimal() + std::sin(t)) < 1e-9);
        for (const json::Value& entry : row.entries) {
            char text[40];
            CHECK(entry.text == std::string(text, std::to_chars(text, text + sizeof text, entry.decimal()).ptr));
        }
    }
}

TEST_CASE("CSV has a heading, CRLF line ends and 201 even rows, and -o writes the same bytes")
{
    const Outcome outcome = call({"run", "oscillator.toml"});
    CHECK(outcome.code == 0);
    CHECK(outcome.out.substr(0, 14) == "t,x,v\r\n0,1,0\r\n");
    std::size_t rows = 0;
    for (std::size_t at = 0; (at = outcome.out.find('\n', at)) != std::string::npos; ++at) {
        REQUIRE(outcome.out[at - 1] == '\r');
        ++rows;
    }
    CHECK(rows == 202);
    CHECK(outcome.out.find("\r\n0.005,") != std::string::npos);
    CHECK_THAT(outcome.err, Catch::StartsWith("oscillator, scene default: ok at t = 1; dop853, "));
    const std::string folder = fresh_folder();
    const Outcome filed = call({"run", "oscillator.toml", "-o", folder + "/rows.csv"});
    CHECK(filed.code == 0);
    CHECK(filed.out.empty());
    CHECK(read_text(folder + "/rows.csv") == outcome.out);
    CHECK(names_in(folder) == std::vector<std::string>{"rows.csv"});
}

TEST_CASE("an output called .json has the report, and a name in other capitals is the nearest one")
{
    const std::string folder = fresh_folder();
    const std::string written = call({"run", "oscillator.toml", "--at", "0", "--format", "json"}).out;
    CHECK(call({"run", "oscillator.toml", "--at", "0", "-o", folder + "/run.json"}).out.empty());
    const std::string filed = read_text(folder + "/run.json");
    // But for the seconds that each took.
    CHECK(filed.substr(0, filed.find("\"seconds\"")) == written.substr(0, written.find("\"seconds\"")));
    CHECK(filed.ends_with("}\n"));
}

TEST_CASE("--at gives rows at exactly these times, sorted, and stretches the run to the last of them")
{
    const json::Value value = report_of("run", {"oscillator.toml", "--at", "3,0.1, pi/2 ,2"});
    const std::vector<double> times = column(value, 0);
    CHECK(times == std::vector<double>{0.1, 1.5707963267948966, 2, 3});
    CHECK(value["t"].text == "3");
    for (std::size_t k = 0; k < times.size(); ++k) CHECK(std::abs(column(value, 1)[k] - std::cos(times[k])) < 1e-9);
    const Outcome outside = call({"run", "oscillator.toml", "--at", "1,1.5", "--t-end", "1.25"});
    CHECK(outside.code == 3);
    CHECK(outside.err == "<--at>:1:1: error: a row is wanted at t = 1.5, outside of the run from 0 to 1.25\n"
                         "  1.5\n  ^~~\n");
}

TEST_CASE("a run goes backwards where its end lies before its start")
{
    const json::Value value = report_of("run", {"oscillator.toml", "--t-end", "-2", "--at", "-2,0,-1"});
    CHECK(column(value, 0) == std::vector<double>{0, -1, -2});
    CHECK(std::abs(column(value, 2)[2] + std::sin(-2.0)) < 1e-9);
    CHECK(column(report_of("run", {"oscillator.toml", "--t-end", "0"}), 1) == std::vector<double>{1});
}

TEST_CASE("a scene's `samples` and `sample` say how many rows there are")
{
    const std::string folder = fresh_folder();
    write_text(folder + "/oscillator.toml", read_text(models_folder() + "/oscillator.toml") +
                                                "[scene.few]\nlike = \"default\"\nsamples = 5\n"
                                                "[scene.spaced]\nlike = \"default\"\nsample = 0.4\n"
                                                "[scene.listed]\nlike = \"default\"\nat = [1, 0.5]\n");
    const auto times = [&](const char* scene) {
        return column(report_of("run", {"oscillator.toml", "--scene", scene}, 0, {.folder = folder}), 0);
    };
    CHECK(times("few") == std::vector<double>{0, 0.25, 0.5, 0.75, 1});
    CHECK(times("spaced") == std::vector<double>{0, 0.4, 0.8, 1});
    CHECK(times("listed") == std::vector<double>{0.5, 1});
}

TEST_CASE("`observe` says which columns there are; an event that stops a run is a success", "[run]")
{
    const json::Value value = report_of("run", {"pendulum.toml", "--scene", "first_turn"});
    CHECK(value["status"].text == "stopped_by_event");
    CHECK(value["columns"].texts() == std::vector<std::string>{"t", "th", "w", "height", "energy"});
    REQUIRE(value["events"].size() == 1);
    CHECK(value["events"][0]["name"].text == "over_the_top");
    const double t = value["events"][0]["t"].decimal();
    CHECK(t == value["t"].decimal());
    CHECK(std::abs(t - 0.571730904456) < 1e-10);
    REQUIRE(value["rows"].size() == 13); // t = 0, 0.05, .., 0.55, and the event's
    CHECK(column(value, 0).back() == t);
    CHECK(std::abs(column(value, 1).back() - 3.14159265358979) < 1e-12);
    for (const json::Value& row : value["rows"].entries)
        CHECK(std::abs(row[3].decimal() + 1.1 * std::cos(row[1].decimal())) <= tolerance::roundoff(8));
    const json::Value asked = report_of("run", {"pendulum.toml", "--scene", "first_turn", "--at", "0,0.1,2"});
    CHECK(asked["status"].text == "stopped_by_event");
    CHECK(column(asked, 0) == std::vector<double>{0, 0.1}); // rows at exactly these times, the event's is none of them
}

TEST_CASE("momenta in `initial` start the body whose momenta they are", "[run]")
{
    const json::Value value = report_of("run", {"rigid_body.toml", "--scene", "from_momenta", "--at", "0"});
    CHECK(value["columns"].texts() == std::vector<std::string>{"t", "w1", "w2", "w3"});
    const json::Value& row = value["rows"][0];
    CHECK(row[1].decimal() == 0);
    CHECK(row[2].decimal() == 20.0 / 23); // 2/2.3, rounded once
    CHECK(row[3].decimal() == 10.0 / 34);
    CHECK(value["invariants"].keys == std::vector<std::string>{"energy", "momentum_squared"});
    CHECK(std::abs(value["invariants"]["momentum_squared"]["initial"].decimal() - 5) <= 5 * tolerance::roundoff(8));
}

TEST_CASE("--set wins over the scene's parameters, exactly")
{
    // E(0) = (1 - b x) v^2/2 - 1/x with x = 1, v = 2; the scene says b = 1/2.
    const auto energy = [](const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"fall.toml", "--scene", "weighted", "--at", "0"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return report_of("run", arguments)["invariants"]["energy"]["initial"].text;
    };
    CHECK(energy({}) == "0");
    CHECK(energy({"--set", "b=1/4"}) == "0.5");
    CHECK(energy({"--set", "b=1/4", "--set", "b=3/4"}) == "-0.5");
}

TEST_CASE("--method, --step and --tolerance win over the scene")
{
    const json::Value coarse = report_of("run", {"oscillator.toml", "--method", "euler", "--step", "1/4", "--at", "1"});
    CHECK(coarse["method"].text == "euler");
    CHECK(coarse["steps"].text == "4");
    // (1 + h J)^4 applied to (1, 0) with h = 1/4: the real part of (1 - i/4)^4 is 1 - 6/16 + 1/256, all exact in
    // binary.
    CHECK(coarse["rows"][0][1].decimal() == 1 - 6.0 / 16 + 1.0 / 256);
    const auto drift = [](const char* wanted) {
        return report_of("run", {"oscillator.toml", "--tolerance", wanted})["invariants"]["energy"]["max_drift"]
            .decimal();
    };
    CHECK(drift("1e-13") < 1e-12);
    CHECK(drift("1e-13") < drift("1e-4"));
    const Outcome unused = call({"run", "oscillator.toml", "--step", "1", "--at", "1"});
    CHECK(unused.code == 0);
    CHECK_THAT(unused.err, Catch::StartsWith("warning: --step is not used: dop853 chooses its steps itself\n"));
    const Outcome fixed =
        call({"run", "oscillator.toml", "--method", "rk4", "--step", "1", "--tolerance", "1e-3", "--at", "1"});
    CHECK(fixed.code == 0);
    CHECK_THAT(fixed.err, Catch::StartsWith("warning: --tolerance is not used: the steps of rk4 are fixed\n"));
}

TEST_CASE("the energy of a Lagrangian that depends on t is reported as not conserved", "[run]")
{
    const std::string folder = fresh_folder();
    write_text(folder + "/driven.toml",
               "[base]\ncoordinates = ['x']\n[fibre]\ncoordinates = ['v']\n[algebroid]\nkind = "
               "'tangent'\n[lagrangian]\nL = 'v^2/2 + t*x'\n[scene.default]\n"
               "initial = { x = 0, v = 0 }\nduration = 1\n");
    const Outcome driven = call({"run", "driven.toml", "--at", "1"}, {.folder = folder});
    CHECK(driven.code == 0);
    // x = t^3/6, so the energy v^2/2 - t x is -t^4/24.
    CHECK_THAT(
        driven.err,
        Catch::Contains("\n  energy: 0 at the start, largest drift 0.0417 at t = 1") &&
            Catch::Contains(" (not conserved: forces, time, a drift or jumps)\n  energy less work: 0 at the start, "));
    CHECK_THAT(call({"run", "oscillator.toml", "--at", "1"}).err, !Catch::Contains("not conserved"));
}

TEST_CASE("--plot draws SVG and PNG")
{
    const std::string folder = fresh_folder();
    const Outcome outcome = call({"run", "oscillator.toml", "-o", folder + "/a.csv", "--plot", folder + "/a.svg"});
    CHECK(outcome.code == 0);
    const std::string svg = read_text(folder + "/a.svg");
    CHECK(svg.find("<svg") != std::string::npos);
    CHECK(svg.find("</svg>") != std::string::npos);
    CHECK(call({"run", "oscillator.toml", "-o", folder + "/a.csv", "--plot", folder + "/a.png"}).code == 0);
    CHECK(read_text(folder + "/a.png").substr(0, 4) == "\x89PNG");
    CHECK(names_in(folder) == std::vector<std::string>{"a.csv", "a.png", "a.svg"});
}

TEST_CASE("a run by an implicit method tells its Newton iterations and factorisations", "[run]")
{
    const Outcome text = call({"run", "oscillator.toml", "--method", "gauss4", "--step", "1/2", "--at", "1"});
    CHECK(text.code == 0);
    // A linear problem: one iteration finds the stages, one more finds nothing to correct.
    CHECK_THAT(text.err, Catch::Contains("2 steps") && Catch::Contains(" Newton iterations, 2 factorisations\n"));
    const Outcome json =
        call({"run", "oscillator.toml", "--method", "gauss4", "--step", "1/2", "--at", "1", "--format", "json"});
    CHECK_THAT(json.out, Catch::Contains("\"newton_iterations\": ") && Catch::Contains("\"decompositions\": 2,"));
    const Outcome explicitly = call({"run", "oscillator.toml", "--method", "rk4", "--step", "1/2", "--at", "1"});
    CHECK_THAT(explicitly.err, !Catch::Contains("Newton"));
}

TEST_CASE("splittings compose exact flows where Hamilton's equations do not separate", "[all]")
{
    for (const std::string model : {"heavy_top.toml", "kirchhoff.toml"}) {
        INFO(model);
        const json::Value exact =
            report_of("run", {model, "--form", "hamilton", "--t-end", "2", "--at", "2", "--tolerance", "1e-13"});
        const json::Value split = report_of("run", {model, "--form", "hamilton", "--t-end", "2", "--at", "2",
                                                    "--method", "kahanli8", "--step", "0.05"});
        CHECK(split["status"].text == "ok");
        CHECK(split["steps"].decimal() == 40);
        for (std::size_t k = 1; k < exact["columns"].size(); ++k)
            CHECK(column(split, k)[0] == Approx(column(exact, k)[0]).epsilon(1e-9).margin(1e-9));
        for (const std::string& name : split["invariants"].keys)
            CHECK(split["invariants"][name]["max_drift"].decimal() < 1e-9);
    }
}

TEST_CASE("--time-scale makes reversible steps, with the published error of an eccentric orbit", "[run]")
{
    const json::Value value = report_of("run", {"kepler.toml", "--method", "leapfrog_kdk", "--step", "0.05",
                                                "--time-scale", "r^(3/2)", "--t-end", "200*pi", "--at", "0,200*pi"});
    CHECK(value["invariants"]["energy"]["max_drift"].decimal() == Approx(8.921e-4).epsilon(1e-4));
    CHECK(value["steps"].decimal() / 100 == Approx(136).epsilon(4e-3));
}

TEST_CASE("a scene's time_scale is that of --time-scale, in runs and in sweeps", "[all]")
{
    const std::string folder = fresh_folder();
    write_text(folder + "/kepler.toml",
               read_text(models_folder() + "/kepler.toml") +
                   "\n[scene.steady]\nlike = 'default'\nmethod = 'leapfrog_kdk'\nstep = 0.05\nduration = 9\n"
                   "time_scale = 'r^(3/2)'\n\n[scene.even]\nlike = 'steady'\ntime_scale = 1\n");
    const auto rows = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"run", "kepler.toml", "--at", "9", "--t-end", "9"});
        const Outcome outcome = done(more, {.folder = folder});
        return outcome.out;
    };
    const std::string steady = rows({"--scene", "steady"});
    CHECK(steady == rows({"--method", "leapfrog_kdk", "--step", "0.05", "--time-scale", "r^(3/2)"}));
    CHECK(steady == rows({"--scene", "even", "--time-scale", "r^(3/2)"}));
    for (const std::vector<std::string>& swept :
         {std::vector<std::string>{"--scene", "steady"}, {"--scene", "even", "--time-scale", "r^(3/2)"}}) {
        std::vector<std::string> arguments{"sweep", "kepler.toml", "--set", "eccentricity=0.6:0.7:2", "-o", "s.csv"};
        arguments.insert(arguments.end(), swept.begin(), swept.end());
        CHECK(call(arguments, {.folder = folder}).code == 0);
        const std::string state = steady.substr(steady.find("\r\n9,") + 2); // "9,x,y,u,v\r\n"
        CHECK_THAT(read_text(folder + "/s.csv"), Catch::Contains("0,0.6," + state.substr(0, state.size() - 2) + ","));
        std::filesystem::remove(folder + "/s.csv");
    }
    const Outcome pair = call({"run", "kepler.toml", "--scene", "steady", "--method", "dop853"}, {.folder = folder});
    CHECK(pair.code == 0);
    CHECK_THAT(pair.err, Catch::StartsWith("warning: time_scale of scene 'steady' is not used: dop853 is no symmetric "
                                           "splitting\n"));
}
