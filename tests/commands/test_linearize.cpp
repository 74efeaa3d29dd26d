// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen linearize`: equilibria, slopes, modes and gains against formulas and against finite differences.
#include "program.hpp"

#include "graph/core/evaluate.hpp"
#include "pipeline.hpp"
#include "support/golden.hpp"
#include "support/json.hpp"
#include "support/tolerances.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

using namespace lagen::testing;
namespace json = lagen::json;

namespace {

double matrix_entry(const json::Value& matrix, std::size_t row, std::size_t column)
{
    return static_cast<double>(matrix[row][column].number());
}

std::vector<std::string> texts(const json::Value& list)
{
    std::vector<std::string> out;
    for (const json::Value& each : list.entries) out.push_back(each.text);
    return out;
}

/// A and B against central differences of the kernel `rhs` that `lagen generate` prints.
void compare_with_differences(const std::string& model, const std::vector<std::string>& more = {})
{
    std::vector<std::string> arguments{model};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const json::Value found = report_of("linearize", arguments);
    const lagen::CheckedModel checked = lagen::load(models_folder() + "/" + model, {}, false);
    lagen::KernelRequest request;
    request.form = found["form"].text;
    request.only = {"rhs"};
    const lagen::KernelModule module = lagen::form_kernels(checked.model, checked.system, checked.report, request);
    std::map<std::string, double> at{{"t", 0.0}};
    for (std::size_t k = 0; k < module.parameters.size(); ++k) {
        const lagen::NodeId value[] = {module.parameter_defaults[k]};
        at[module.parameters[k].name] = lagen::evaluate<double>(*module.graph, value, {})[0];
    }
    for (std::size_t k = 0; k < found["equilibrium"].size(); ++k)
        at[found["equilibrium"].keys[k]] = static_cast<double>(found["equilibrium"][k].number());
    const std::vector<lagen::NodeId> rhs = nodes_of(lagen::kernel_named(module, "rhs"));
    for (const double rate : lagen::evaluate<double>(*module.graph, rhs, at)) CHECK(std::abs(rate) < 1e-12);
    for (const auto& [matrix, names] : {std::pair("A", "states"), std::pair("B", "inputs")}) {
        const std::vector<std::string> columns = texts(found[names]);
        for (std::size_t j = 0; j < columns.size(); ++j) {
            const double h = 1e-5;
            std::map<std::string, double> less = at, more_of_it = at;
            less[columns[j]] -= h;
            more_of_it[columns[j]] += h;
            const std::vector<double> before = lagen::evaluate<double>(*module.graph, rhs, less);
            const std::vector<double> behind = lagen::evaluate<double>(*module.graph, rhs, more_of_it);
            REQUIRE(found[matrix].size() == before.size());
            for (std::size_t i = 0; i < before.size(); ++i) {
                CAPTURE(model, matrix, i, columns[j]);
                CHECK(matrix_entry(found[matrix], i, j) ==
                      Approx((behind[i] - before[i]) / (2 * h)).epsilon(1e-8).margin(1e-8));
            }
        }
    }
}

json::Value linearised_text(const std::string& text, const std::vector<std::string>& more = {})
{
    const std::string path = written_file("model.toml", text);
    std::vector<std::string> arguments{path};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return report_of("linearize", arguments);
}

/// A body that hangs at a point: attitudes R as a matrix without a word of R^T R = 1.
std::string hanging_body(const std::string& start)
{
    return "[base]\ncoordinates = [\"R[1..3,1..3]\"]\n[fibre]\ncoordinates = [\"w[1..3]\"]\n[algebroid]\nkind = "
           "\"action\"\nalgebra = \"so(3)\"\nanchor = { R = \"R*hat(w)\" }\n[lagrangian]\nL = \"dot(w, "
           "diag([1,2,2.5])*w)/2 - 2*R[3,3]\"\n[scene.default]\ninitial = { R = \"" +
           start + "\", w = [0,0,0] }\n";
}

/// The eigenvalues with their multiplicities, "-2 x4"; those below the axis are left out. They add up.
std::vector<std::string> multiplicities(const json::Value& found)
{
    std::vector<std::string> out;
    long double sum = 0;
    for (const json::Value& mode : found["modes"].entries) {
        sum += mode["multiplicity"].number();
        const json::Value& lambda = mode["eigenvalue"];
        if (lambda[1].number() < 0) continue;
        out.push_back(lambda[0].text + (lambda[1].number() > 0 ? " + " + lambda[1].text + "i" : "") + " x" +
                      mode["multiplicity"].text);
    }
    CHECK(sum == static_cast<long double>(found["states"].size()));
    CHECK(found["eigenvalues"].size() == found["states"].size());
    return out;
}

} // namespace

TEST_CASE("an attitude without declared Casimirs stays a rotation, and has the frequencies of one")
{
    for (const std::string start : {"exp(hat([3,0.05,0.02]))", "exp(hat([0.4,-0.1,2]))*exp(hat([2.5,0.2,0]))"}) {
        const json::Value found = linearised_text(hanging_body(start));
        CHECK(found["certified"].text == "true");
        CHECK(found["leaf"].text == "kept");
        CHECK(found["equilibrium"]["R[3,3]"].text == "-1");
        for (int i = 1; i <= 3; ++i)
            for (int j = 1; j <= 3; ++j) {
                long double product = 0;
                for (int k = 1; k <= 3; ++k)
                    product += found["equilibrium"]["R[" + std::to_string(k) + "," + std::to_string(i) + "]"].number() *
                               found["equilibrium"]["R[" + std::to_string(k) + "," + std::to_string(j) + "]"].number();
                CHECK(std::abs(product - (i == j ? 1 : 0)) < 1e-15L);
            }
        // sqrt(2/2) and sqrt(2/1); turning about the vertical, and six directions off the leaf, are 0
        CHECK(multiplicities(found).front() == "0 x8");
        REQUIRE(found["modes"].size() == 5);
        std::vector<long double> frequencies;
        for (const json::Value& mode : found["modes"].entries) frequencies.push_back(mode["frequency"].number());
        std::ranges::sort(frequencies);
        CHECK(frequencies[1] == Approx(1).epsilon(1e-15));
        CHECK(frequencies[4] == Approx(std::sqrt(2.0)).epsilon(1e-15));
    }
}

TEST_CASE("a vector without declared Casimirs keeps its length, and a place beside an attitude its frame")
{
    const json::Value top = linearised_text(
        "[base]\ncoordinates = [\"g[1..3]\"]\n[fibre]\ncoordinates = [\"w[1..3]\"]\n[algebroid]\nkind = \"action\"\n"
        "algebra = \"so(3)\"\nanchor = { g = \"cross(g, w)\" }\n[lagrangian]\nL = \"dot(w, w)/2 + g[3]\"\n[forces]\n"
        "w = \"-w\"\n[scene.default]\ninitial = { g = [1.2, 0.3, 1.6], w = [0, 0, 0] }\n");
    CHECK(top["equilibrium"]["g[3]"].number() == Approx(std::sqrt(1.44 + 0.09 + 2.56)).epsilon(1e-15));
    CHECK(top["certified"].text == "true");
    // The quadrotor over the origin, where its law holds it.
    const json::Value hovering = report_of("linearize", {LAGEN_SOURCE_DIR "/docs/cookbook/quadrotor.toml"});
    const auto entry = [&](const char* name) { return hovering["equilibrium"][name].number(); }; // turned about e3
    CHECK(entry("R[3,3]") == Approx(1).epsilon(1e-12));
    CHECK(entry("R[1,1]") * entry("R[2,2]") - entry("R[1,2]") * entry("R[2,1]") == Approx(1).epsilon(1e-12));
    for (const char* name : {"x[1]", "x[2]", "x[3]", "w[3]"})
        CHECK(std::abs(hovering["equilibrium"][name].number()) < 1e-12L);
    CHECK(hovering["leaf"].text == "kept");
}

TEST_CASE("a start that is moved onto constraints stays on the levels of Casimirs that nobody declared")
{
    const std::string path = written_file("bowl.toml", R"-([base]
coordinates = ["x", "y", "z"]
constraints = ["z - x^2 - y^2"]
[fibre]
coordinates = ["w"]
[algebroid.anchor]
w = { x = "-y", y = "x" }
[lagrangian]
L = "w^2/2"
[scene.default]
initial = { x = 3, y = 4, z = 1, w = 0 }
project = true
duration = 1
at = [0]
)-");
    const json::Value row = finished_run({path})["rows"][0];
    for (const auto& [column, wanted] : {std::pair{1U, 0.6L}, std::pair{2U, 0.8L}, std::pair{3U, 1.0L}})
        CHECK(std::abs(row[column].number() - wanted) < 1e-15L);
    const json::Value found = report_of("linearize", {path});
    CHECK(found["equilibrium"]["z"].number() == 1);
}

TEST_CASE("drag by the length of a velocity is linearised at rest, and a rub is refused by its name")
{
    const std::string folder = fresh_folder();
    const auto kite = [&](const std::string& force_x, const std::string& force_y) {
        write_text(folder + "/kite.toml", fmt::format(R"-([parameters]
d = 0.7
[base]
coordinates = ["x", "y"]
[fibre]
coordinates = ["v", "w"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "(v^2 + w^2)/2 - x^2 - y^2/2"
[forces]
v = "{}"
w = "{}"
[scene.default]
initial = {{ x = 0.1, y = 0, v = 0, w = 0 }}
duration = 1
)-",
                                                      force_x, force_y));
        return folder + "/kite.toml";
    };
    for (const auto& [x, y] : {std::pair{"-d*v*sqrt(v^2 + w^2)", "-d*w*sqrt(v^2 + w^2)"},
                               std::pair{"-d*v*norm([v, w])^(1/2)", "-d*w*norm([v, w])^(1/2)"},
                               std::pair{"-d*abs(v)*v", "-d*w*abs(w)^0.3"}}) {
        const json::Value found = report_of("linearize", {kite(x, y)});
        INFO(x);
        CHECK(found["certified"].text == "true");
        for (const std::size_t row : {2U, 3U})
            for (const std::size_t column : {0U, 1U, 2U, 3U})
                CHECK(matrix_entry(found["A"], row, column) == (row != column + 2 ? 0 : row == 2 ? -2 : -1));
    }
    const Outcome rub = call({"linearize", kite("-d*v/sqrt(v^2 + w^2 + 1) - 2*abs(w)", "0")});
    CHECK(rub.code == 1);
    CHECK_THAT(rub.err, Catch::Contains("the rates have no derivatives that are known to be continuous: abs(w) has"));
}

TEST_CASE("modes add up to the states: lags in a row, hidden instability, chains of integrators")
{
    const auto servo = [](const std::string& L, const std::string& states, const std::string& force) {
        return "[inputs]\nu = 0\n[base]\ncoordinates = [\"x\"]\n[fibre]\ncoordinates = [\"v\"]\n[algebroid]\nkind = "
               "\"tangent\"\n[lagrangian]\nL = \"v^2/2" +
               L + "\"\n[states]\n" + states + "[forces]\nv = \"u" + force +
               "\"\n[scene.default]\ninitial = { x = 0, v = 0 }\n";
    };
    using Lines = std::vector<std::string>;
    CHECK(multiplicities(linearised_text(servo(" - 2*x^2", "f = \"2*(x - f)\"\ng = \"2*(f - g)\"\ne = \"x - 0.1*e\"\n",
                                               " - 4*v + 4*g"))) != Lines{});
    CHECK(multiplicities(linearised_text(servo(" - 2*x^2", "f = \"2*(u - f)\"\ng = \"2*(f - g)\"\ne = \"x - 0.1*e\"\n",
                                               " - 4*v + 4*g"))) == Lines{"-2 x4", "-0.1 x1"});
    CHECK(multiplicities(linearised_text(servo(" - 49*x^2/2",
                                               "a = \"7*(x + a)\"\nb = \"7*(a + b)\"\nc = \"7*(b + c)\"\n"
                                               "q = \"c\"\n",
                                               " + 14*v"))) == Lines{"0 x1", "7 x5"});
    CHECK(multiplicities(linearised_text(servo("", "i = \"x\"\nj = \"i\"\nk = \"j\"\n", ""))) == Lines{"0 x5"});
    // Two equal oscillators, one driving the other: +-3i twice each.
    CHECK(multiplicities(linearised_text(servo(" - 9*x^2/2", "p = \"q\"\nq = \"x - 9*p\"\n", ""))) ==
          Lines{"0 + 3i x2"});
}

TEST_CASE("a cart and pole without friction has the eigenvalues of its formula, up and down")
{
    const double M = 1, m = 0.3, l = 0.5, g = 9.81, root = std::sqrt((M + m) * g / (M * l));
    for (const bool up : {true, false}) {
        const json::Value found = report_of("linearize", {"cart_pole.toml", "--set", "c=0", "--initial",
                                                          up ? "th=2.8" : "th=0.4", "--initial", "x=0.7"});
        CHECK(found["certified"].text == "true");
        CHECK(static_cast<double>(found["equilibrium"]["th"].number()) == (up ? std::acos(-1.0) : 0));
        CHECK(found["equilibrium"]["u"].text == "0");
        CHECK(found["residual"].number() < 1e-14);
        std::vector<double> real, imaginary;
        for (const json::Value& each : found["eigenvalues"].entries) {
            real.push_back(static_cast<double>(each[0].number()));
            imaginary.push_back(static_cast<double>(each[1].number()));
        }
        CHECK(std::ranges::is_sorted(real));
        const std::vector<double>& moving = up ? real : imaginary;
        const std::vector<double>& still = up ? imaginary : real;
        CHECK(std::ranges::all_of(still, [](double each) { return each == 0; }));
        CHECK(*std::ranges::max_element(moving) == Approx(root).epsilon(1e-15));
        CHECK(*std::ranges::min_element(moving) == Approx(-root).epsilon(1e-15));
        CHECK(std::ranges::count(moving, 0.0) == static_cast<std::ptrdiff_t>(moving.size()) - 2);
    }
}

TEST_CASE("A and B are the finite differences of the right-hand side that is generated")
{
    for (const char* model : {"cart_pole.toml", "double_pendulum.toml", "held_top.toml", "chaplygin_sleigh.toml",
                              "cartesian_pendulum.toml", "kirchhoff.toml"})
        compare_with_differences(model);
    compare_with_differences("held_top.toml", {"--scene", "momenta"});
    compare_with_differences("double_pendulum.toml", {"--form", "hamilton"});
}

TEST_CASE("the double integrator is controllable, with the gain [1, sqrt(3)]")
{
    const json::Value found = report_of("linearize", {"integrator.toml", "--lqr", "Q=1;R=1"});
    CHECK(texts(found["equilibrium"]) == std::vector<std::string>{"0.2", "0", "0"}); // x stays
    CHECK(texts(found["A"][0]) == std::vector<std::string>{"0", "1"});
    CHECK(texts(found["A"][1]) == std::vector<std::string>{"0", "0"});
    CHECK(texts(found["B"][1]) == std::vector<std::string>{"1"});
    CHECK(found["controllable"].text == "true");
    CHECK(found["modes"].size() == 1);
    CHECK(found["modes"][0]["multiplicity"].text == "2");
    CHECK(matrix_entry(found["gain"], 0, 0) == Approx(1).epsilon(1e-14));
    CHECK(matrix_entry(found["gain"], 0, 1) == Approx(std::sqrt(3.0)).epsilon(1e-14));
    CHECK(found["riccati_residual"].number() < 1e-15);
    const json::Value weighed = report_of("linearize", {"integrator.toml", "--lqr", "R=[[4]]; Q = [4, 2*2*2/2]"});
    CHECK(matrix_entry(weighed["gain"], 0, 1) == Approx(std::sqrt(3.0)).epsilon(1e-14));
    CHECK(report_of("linearize", {"integrator.toml"})["gain"].kind == json::Kind::null);
}

TEST_CASE("inputs are held at what the scene gives at its start")
{
    const json::Value found = report_of("linearize", {"integrator.toml", "--scene", "drawn"});
    CHECK(found["equilibrium"]["u"].text == "3");
    CHECK(found["equilibrium"]["x"].text == "1.5");
    CHECK(found["inputs_moved"].text == "false");
    CHECK(matrix_entry(found["A"], 1, 0) == -2);
    CHECK(found["eigenvalues"][1][1].number() == Approx(std::sqrt(2.0)).epsilon(1e-15));
}

TEST_CASE("inputs made of parameters are exactly what these make them: a quadrotor hovers at m g/2")
{
    const std::string path = written_file("quadrotor.toml", R"toml([parameters]
m = 0.5
g = 9.81
[base]
coordinates = ["y", "z", "phi"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "m*(v_y^2 + v_z^2)/2 + 0.01*v_phi^2/2 - m*g*z"
[inputs]
"f[1..2]" = "m*g/2"
[forces]
v_y = "-(f[1] + f[2])*sin(phi)"
v_z = "(f[1] + f[2])*cos(phi)"
v_phi = "0.2*(f[1] - f[2])"
[scene.default]
initial = { z = 1, y = 0, phi = 0.1, v_y = 0, v_z = 0, v_phi = 0 }
duration = 1
)toml");
    const json::Value found = report_of("linearize", {path});
    CHECK(found["inputs_moved"].text == "false");
    CHECK(found["certified"].text == "true");
    CHECK(found["equilibrium"]["phi"].text == "0");
    CHECK(found["equilibrium"]["f[1]"].text == "2.4525");
    CHECK(matrix_entry(found["A"], 3, 2) == Approx(-9.81));
}

TEST_CASE("where they have no equilibrium they move as little as possible, and the text says so")
{
    const json::Value found = report_of("linearize", {"loaded.toml"});
    CHECK(found["inputs_moved"].text == "true");
    CHECK(found["certified"].text == "true");
    CHECK(texts(found["equilibrium"]) == std::vector<std::string>{"1", "0", "2", "4"}); // 10 (1, 2)/5
    CHECK(call({"linearize", "loaded.toml"}).out.find("none was found with the inputs that the scene gives") !=
          std::string::npos);
}

TEST_CASE("inputs far from any equilibrium are first brought to rest at the state of the start")
{
    const std::string folder = fresh_folder();
    write_text(folder + "/held.toml", R"toml([inputs]
u = 0
[base]
coordinates = ["th"]
[fibre]
coordinates = ["w"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "w^2/2 + 9.81*cos(th)"
[forces]
w = "u"
[scene.default]
initial = { th = 2, w = 0 }
inputs = { u = 30 }
)toml");
    const json::Value found = report_of("linearize", {folder + "/held.toml"});
    CHECK(found["certified"].text == "true");
    CHECK(found["inputs_moved"].text == "true");
    CHECK(found["equilibrium"]["th"].text == "2");
    CHECK(found["equilibrium"]["u"].number() == Approx(9.81 * std::sin(2.0)).epsilon(1e-15));
}

TEST_CASE("one force does not reach the difference of equal oscillators")
{
    const json::Value found = report_of("linearize", {"two_masses.toml"});
    CHECK(found["controllable"].text == "false");
    REQUIRE(found["uncontrollable"].size() == 2);
    CHECK(matrix_entry(found["uncontrollable"], 1, 1) == Approx(1).epsilon(1e-15));
    CHECK(report_of("linearize", {"two_masses.toml", "--set", "apart=1/2"})["controllable"].text == "true");
}

TEST_CASE("on the sphere a top is controllable, though not off it, and its gain holds it")
{
    for (const char* scene : {"default", "momenta"}) {
        const json::Value found = report_of("linearize", {"held_top.toml", "--scene", scene, "--lqr", "Q=1;R=1"});
        CHECK(found["certified"].text == "true");
        CHECK(found["equilibrium"]["g3"].text == "1");
        CHECK(found["controllable"].text == "true");
        CHECK(found["eigenvalues"].size() == 6);
        CHECK(found["closed_loop"].size() == 5);
        for (const json::Value& each : found["closed_loop"].entries) CHECK(each[0].number() < -0.1L);
        // Each of two axes is g' = w, w' = 4 g + T up to signs: P has the closed form of two equations.
        const double k = 4 + std::sqrt(17.0), kw = std::sqrt(1 + 2 * k);
        CHECK(std::abs(matrix_entry(found["gain"], 0, 1)) == Approx(k).epsilon(1e-12));
        CHECK(matrix_entry(found["gain"], 0, 3) == Approx(kw).epsilon(1e-12));
        CHECK(std::abs(matrix_entry(found["gain"], 0, 2)) < 1e-12);
    }
}

TEST_CASE("what is linearised is written for a reader")
{
    const Outcome outcome = call({"linearize", "integrator.toml", "--lqr", "Q=1;R=1"});
    CHECK(outcome.code == 0);
    CHECK(outcome.out.starts_with(
        R"(integrator, scene default, lagrange form: an equilibrium, certified: at exactly these numbers
  x = 0.2, v = 0
  u = 0: as the scene gives at its start
  0.1 from the start

A, rows and columns x, v
  0  1
  0  0

B, rows x, v, columns u
  0
  1

  eigenvalue  times  frequency  damping  reached  mode
           0      2          0               yes  x 1
  controllable: the inputs reach every mode

K of u = u0 - K (s - s0), rows u, columns x, v
  1  1.73205
  eigenvalues of A - B K: -0.866025 +- 0.5i
)"));
}

TEST_CASE("the gain in docs/linearize.md and tests/examples/test_balance.cpp is the one that is printed")
{
    const Outcome outcome = call({"linearize", "cart_pole.toml", "--lqr", "Q=1;R=1/10"});
    CHECK(outcome.out.find("  -7.9648  55.4051  -8.54931  12.22  -3.16228\n") != std::string::npos);
}
