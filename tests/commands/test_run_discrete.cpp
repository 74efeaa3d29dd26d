// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen run` of discrete Lagrangians: the reference trajectories of every kind of groupoid, all three sorts of start,
/// rows by steps, and steps that have no solution.
#include "program.hpp"

#include "geometry/reference_models.hpp"
#include "support/json.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>
#include <fstream>

using namespace lagen::testing;
using lagen::DiscreteCase;
using lagen::ReferenceArrow;
namespace json = lagen::json;

namespace {

long double long_number(const json::Value& value)
{
    return std::stold(value.text);
}

const DiscreteCase& case_called(const std::string& name)
{
    for (const DiscreteCase& each : lagen::discrete_cases())
        if (each.name == name) return each;
    throw std::runtime_error(name);
}

/// A scene of `count` steps from the first arrow of the reference.
std::string scene_text(const ReferenceArrow& first, const std::string& step, std::size_t count)
{
    std::string initial, next, element;
    for (const auto& [name, value] : first.coordinates) {
        const std::string entry = fmt::format("{:.25g}", value);
        if (name.ends_with("_next"))
            next += fmt::format("{} = {}, ", name.substr(0, name.size() - 5), entry);
        else if (name.starts_with("W[") || name.starts_with("g["))
            element += (name.ends_with(",1]") ? (element.empty() ? "[" : "], [") : ", ") + entry;
        else
            initial += fmt::format("\"{}\" = {}, ", name, entry);
    }
    std::string text = fmt::format("[scene.default]\nstep = {}\nsteps = {}\n", step, count);
    if (!initial.empty()) text += fmt::format("initial = {{ {} }}\n", initial.substr(0, initial.size() - 2));
    if (!next.empty()) text += fmt::format("next = {{ {} }}\n", next.substr(0, next.size() - 2));
    if (!element.empty()) text += fmt::format("element = [{}]]\n", element);
    return text;
}

const Surroundings long_runs{.long_runs = true};

/// The row without its momenta, by column.
std::map<std::string, long double> arrow_of(const json::Value& found, const json::Value& row, std::size_t momenta)
{
    std::map<std::string, long double> out;
    for (std::size_t k = 1; k + momenta < row.size(); ++k) out[found["columns"][k].text] = long_number(row[k]);
    return out;
}

/// A model of the free body with a scene: mu in `initial`, in units of the moments of inertia over h.
std::string free_body_from(const std::string& momenta, const std::string& more = "")
{
    return case_called("moser_veselov_so3").model +
           fmt::format("[scene.default]\nstep = 0.1\nsteps = 50\ninitial = {{ {} }}\n", momenta) + more;
}

} // namespace

TEST_CASE("fifty discrete steps give the reference trajectories of all kinds of groupoid", "[run]")
{
    constexpr long double exact = 1e-14L, exact_momenta = 1e-12L; // of the largest
    for (const DiscreteCase& each : lagen::discrete_cases()) {
        INFO(each.name);
        const json::Value file = lagen::read_discrete_case(each.name);
        const std::vector<json::Value>& steps = file["steps"].entries;
        const ReferenceArrow first = each.arrow(steps[0], file["parameters"]);
        const std::string model =
            written_file(each.name + std::string(".toml"),
                         each.model + scene_text(first, file["parameters"]["h"].text, steps.size() - 1));
        const json::Value found = report_of("run", {model});
        CHECK(found["form"].text == "discrete");
        CHECK(found["method"].text == "discrete");
        REQUIRE(found["rows"].size() == steps.size());
        const bool is_explicit = found["newton_iterations"].number() < 4; // those of the first arrow
        CHECK(is_explicit == (each.name == "verlet_pendulum"));
        long double arrows = 0, momenta = 0, size = 0;
        for (std::size_t k = 0; k < steps.size(); ++k) {
            const ReferenceArrow expected = each.arrow(steps[k], file["parameters"]);
            const json::Value& row = found["rows"][k];
            CHECK(std::abs(long_number(row[0]) - static_cast<long double>(k) * long_number(file["parameters"]["h"])) <
                  exact);
            const std::size_t shown = expected.momenta.size();
            for (const auto& [name, value] : arrow_of(found, row, shown))
                if (expected.coordinates.contains(name))
                    arrows = std::max(arrows, std::abs(value - expected.coordinates.at(name)));
            for (std::size_t a = 0; a < shown; ++a) {
                momenta = std::max(momenta, std::abs(long_number(row[row.size() - shown + a]) - expected.momenta[a]));
                size = std::max(size, std::abs(expected.momenta[a]));
            }
        }
        UNSCOPED_INFO(fmt::format("arrows {:.2g}, momenta {:.2g}", arrows, momenta / size));
        CHECK(arrows <= exact);
        CHECK(momenta <= exact_momenta * size);
    }
}

TEST_CASE("the discrete examples follow their references", "[all]")
{
    struct Following {
        const char *model, *name;
        std::vector<std::string> momenta;
    };
    const std::vector<Following> examples{{"heavy_top_discrete", "heavy_top_del_asymmetric", {"p_w1", "p_w2", "p_w3"}},
                                          {"moser_veselov", "moser_veselov_so3", {"M1", "M2", "M3"}},
                                          {"planar_body_discrete", "planar_body_se2_discrete", {"p_w", "p1", "p2"}},
                                          {"sliding_mass_discrete", "atiyah_sliding_mass", {"l1", "l2", "l3"}}};
    for (const Following& each : examples) {
        INFO(each.model);
        const json::Value file = lagen::read_discrete_case(each.name);
        const json::Value found = report_of("run", {std::string(each.model) + ".toml"});
        REQUIRE(found["rows"].size() > file["steps"].size());
        for (std::size_t k = 0; k < file["steps"].size(); ++k) {
            const ReferenceArrow expected = case_called(each.name).arrow(file["steps"][k], file["parameters"]);
            REQUIRE(expected.momenta.size() == each.momenta.size());
            for (std::size_t a = 0; a < each.momenta.size(); ++a)
                for (std::size_t column = 0; column < found["columns"].size(); ++column)
                    if (found["columns"][column].text == each.momenta[a])
                        CHECK(std::abs(long_number(found["rows"][k][column]) - expected.momenta[a]) < 1e-12L);
        }
        CHECK(std::abs(case_called(each.name).arrow(file["steps"][50], file["parameters"]).momenta[0]) > 0.01L);
    }
}

TEST_CASE("a discrete run starts from the momenta of its first arrow as well", "[run]")
{
    const std::string name = GENERATE(as<std::string>{}, "moser_veselov_so3", "verlet_pendulum");
    const DiscreteCase& each = case_called(name);
    const json::Value file = lagen::read_discrete_case(name);
    const ReferenceArrow first = each.arrow(file["steps"][0], file["parameters"]);
    const std::string by_arrow = written_file(name + std::string(".toml"), each.model + scene_text(first, "0.1", 50));
    const json::Value expected = report_of("run", {by_arrow});
    std::string initial = name == "verlet_pendulum" ? fmt::format("q = {:.25g}, ", first.coordinates.at("q")) : "";
    for (std::size_t a = 0; a < first.momenta.size(); ++a)
        initial += fmt::format("{}{} = {:.25g}", a == 0 ? "" : ", ",
                               name == "verlet_pendulum" ? "p_v_q" : "p_w" + std::to_string(a + 1), first.momenta[a]);
    const json::Value found = report_of(
        "run", {written_file(name + std::string(".toml"),
                             each.model + "[scene.default]\nstep = 0.1\nsteps = 50\ninitial = { " + initial + " }\n")});
    REQUIRE(found["rows"].size() == expected["rows"].size());
    for (std::size_t k = 0; k < found["rows"].size(); ++k)
        for (std::size_t column = 0; column < found["columns"].size(); ++column)
            CHECK(std::abs(long_number(found["rows"][k][column]) - long_number(expected["rows"][k][column])) < 1e-13L);
}

TEST_CASE("a discrete body turns by asin(h Omega) a step up to a quarter of a turn, and no step has more", "[run]")
{
    for (const auto& [speed, most] : {std::pair{0.1, 15}, {0.5, 18}, {0.9, 65}, {0.99, 248}, {0.999, 299}}) {
        INFO("h Omega = " << speed);
        const std::string momenta = fmt::format("p_w1 = 0, p_w2 = 0, p_w3 = {:.17g}", 34 * speed); // I3/h = 34
        const json::Value run = report_of("run", {written_file("body.toml", free_body_from(momenta))});
        CHECK(run["status"].text == "ok");
        // The first arrow is led to, with a look at det N on twelve points of each part of the way; the others are
        // found at once.
        const json::Value once =
            report_of("run", {written_file("body.toml", free_body_from(momenta)), "--t-end", "0.1"});
        CHECK(once["newton_iterations"].number() >= most);
        CHECK(once["newton_iterations"].number() <= most + 2);
        CHECK(run["newton_iterations"].number() <= once["newton_iterations"].number() + 2 * 49);
        CHECK(std::abs(long_number(run["rows"][50][1]) - std::sqrt(1 - speed * speed)) < 1e-11L); // cos of the angle
        CHECK(std::abs(long_number(run["rows"][50][2]) + speed) < 1e-13L);
    }
    for (const char* beyond : {"34", "34.034"})
        CHECK(
            report_of("run",
                      {written_file("body.toml", free_body_from(fmt::format("p_w1 = 0, p_w2 = 0, p_w3 = {}", beyond)))},
                      1)["status"]
                .text == "no_solution");
}

TEST_CASE("the momenta of a discrete step beyond the fold have no arrow, those before it have one", "[run]")
{
    // About the first axis F^-L = 2 J.. sin(angle)/h = I1 sin(angle)/h: no more than I1/h = 11.
    const json::Value before =
        report_of("run", {written_file("body.toml", free_body_from("p_w1 = 10.989, p_w2 = 0, p_w3 = 0"))});
    CHECK(before["status"].text == "ok");
    const long double angle = std::asin(0.999L);
    CHECK(std::abs(long_number(before["rows"][0][5]) - std::cos(angle)) <
          1e-12L); // W[2,2] on the branch of small angles
    const json::Value beyond =
        report_of("run", {written_file("body.toml", free_body_from("p_w1 = 11.011, p_w2 = 0, p_w3 = 0"))}, 1);
    CHECK(beyond["status"].text == "no_solution");
    CHECK(beyond["steps"].text == "0");
}

TEST_CASE("--branch takes another arrow with the momenta of the start, and the run stays on its branch", "[run]")
{
    const std::string model =
        written_file("body.toml", free_body_from("p_w1 = 5.5, p_w2 = 0, p_w3 = 0")); // h Omega = 1/2
    const json::Value first = report_of("run", {model}), nearest = report_of("run", {model, "--branch", "1"});
    CHECK(first["rows"].texts() == nearest["rows"].texts());
    const json::Value second = report_of("run", {model, "--branch", "2"});
    REQUIRE(second["branches"].size() == 4);
    CHECK(second["branches"][0].text == "0");
    CHECK(std::abs(long_number(second["branches"][1]) - std::sqrt(6.0L)) < 1e-14L); // 2 sqrt 2 sin(pi/3)
    REQUIRE(second["rows"].size() == 51);
    for (const std::size_t row : {0U, 1U, 50U}) {
        CHECK(std::abs(long_number(first["rows"][row][5]) - std::cos(std::asin(0.5L))) < 1e-14L);
        CHECK(std::abs(long_number(second["rows"][row][5]) + std::cos(std::asin(0.5L))) < 1e-14L); // by pi - theta
        CHECK(std::abs(long_number(second["rows"][row][10]) - 5.5L) < 1e-13L);
    }
    const json::Value missing = report_of("run", {model, "--branch", "5"}, 1);
    CHECK(missing["status"].text == "no_solution");
    CHECK(missing["rows"].size() == 0);
    CHECK(missing["branches"].texts() == second["branches"].texts());
    CHECK(missing["state"]["p_w1"].text == "5.5");
    CHECK_THAT(call({"run", model, "--branch", "5"}).err,
               Catch::Contains("\n  branch 5 is not there\n") &&
                   Catch::Contains("\n  arrows with the momenta of the start (`--branch 1` to `--branch 4`) are at the "
                                   "distances 0, 2.44949, 2.82843, 2.82843\n"));
    CHECK_THAT(
        call({"run", written_file("beyond.toml", free_body_from("p_w1 = 11.1, p_w2 = 0, p_w3 = 0")), "--branch", "1"})
            .err,
        Catch::Contains("  branch 1 is not there\n") &&
            Catch::Contains("  no arrow with the momenta of the start is found\n"));
}

TEST_CASE("a run from an arrow behind the fold goes on behind it", "[run]")
{
    const std::string model = written_file(
        "body.toml", case_called("moser_veselov_so3").model +
                         "[scene.default]\nstep = 0.1\nsteps = 100\nelement = \"exp(hat([3, 0.3, 0.1]))\"\n");
    const json::Value run = report_of("run", {model});
    CHECK(run["steps"].text == "100");
    CHECK(run["invariants"]["energy"]["max_drift"].number() < 1e-11L);
}

TEST_CASE("rows of a discrete run are at its steps, and it takes its step from the command line first", "[run]")
{
    const std::string model =
        written_file("body.toml", free_body_from("p_w1 = 1, p_w2 = 2, p_w3 = 0.5", "sample = 1\n"));
    const json::Value tenth = report_of("run", {model});
    REQUIRE(tenth["rows"].size() == 6);
    CHECK(long_number(tenth["rows"][5][0]) == 5);
    CHECK(tenth["steps"].text == "50");
    const json::Value all = report_of("run", {model, "--step", "0.05", "--t-end", "1"});
    CHECK(all["rows"].size() == 2);
    CHECK(all["steps"].text == "20");
}

TEST_CASE("a million discrete steps of the heavy top stay on their group, and keep the vertical momentum", "[long]")
{
    const DiscreteCase& each = case_called("heavy_top_del_lagrange");
    const json::Value file = lagen::read_discrete_case(each.name);
    const ReferenceArrow first = each.arrow(file["steps"][0], file["parameters"]);
    std::string text = each.model + scene_text(first, "0.1", 1'000'000);
    text += "sample = 10000\nobserve = [\"state\", \"norm(G) - 1\", \"p_w3\", \"p_w1*G[1] + p_w2*G[2] + p_w3*G[3]\", "
            "\"sqrt(trace((transpose(W)*W - identity(3))*(transpose(W)*W - identity(3))))\", \"energy\"]\n";
    const json::Value found = report_of("run", {written_file("top.toml", text), "--no-second-run"}, 0, long_runs);
    REQUIRE(found["rows"].size() == 11);
    const std::size_t columns = found["columns"].size();
    const auto at = [&](std::size_t row, std::size_t behind) {
        return long_number(found["rows"][row][columns - behind]);
    };
    long double energy = 0;
    for (std::size_t k = 0; k < 11; ++k) {
        CHECK(std::abs(at(k, 4)) < 1e-12L);           // |G| = 1
        CHECK(std::abs(at(k, 3) - at(0, 3)) < 1e-9L); // mu.G, whose rounding errors add up
        CHECK(at(k, 2) < 1e-14L);                     // W in SO(3)
        energy = std::max(energy, std::abs(at(k, 1) - at(0, 1)));
    }
    CHECK(energy > 1e-6L); // a bounded oscillation
    CHECK(energy < 1e-1L * std::abs(at(0, 1)));
}
