// SPDX-License-Identifier: GPL-2.0-or-later
/// Hamilton's and Pontryagin's forms against equations written by hand, and what they refuse.
#include "models.hpp"

#include "../support/compiled.hpp"
#include "../support/tolerances.hpp"

#include <cmath>
#include <random>

using namespace lagen;
using namespace lagen::testing;

namespace {

KernelModule module_of(const std::string& text, const std::string& form, std::vector<std::string> only = {})
{
    KernelRequest request;
    request.form = form;
    request.only = std::move(only);
    return kernels_of(read_model_text("test.toml", text), request);
}

std::string refusal(const std::string& text, const std::string& form)
{
    try {
        static_cast<void>(module_of(text, form));
        return "";
    } catch (const MathematicsError& error) {
        return error.what();
    }
}

void check_close(const std::vector<double>& found, const std::vector<double>& expected)
{
    REQUIRE(found.size() == expected.size());
    for (std::size_t k = 0; k < found.size(); ++k)
        CHECK(std::abs(found[k] - expected[k]) <= tolerance::roundoff(64) * (1 + std::abs(expected[k])));
}

const std::string body = R"toml(name = "body"
[parameters]
I1 = 1
I2 = 2
I3 = 3
[fibre]
coordinates = ["w1", "w2", "w3"]
momenta = ["m1", "m2", "m3"]
[algebroid]
kind = "lie_algebra"
algebra = "so(3)"
)toml";

/// m sqrt(1 - u^2): p = m u / sqrt(1 - u^2).
const std::string particle = R"toml(name = "particle"
[parameters]
m = 2
[base]
coordinates = ["x"]
domain = ["m > 0"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "-m*sqrt(1 - v_x^2) - x^2/2"
[forces]
v_x = "-v_x*exp(-t)"
)toml";

std::string control(const std::string& block)
{
    return "name = \"problem\"\n[base]\ncoordinates = [\"x\", \"v\"]\n[fibre]\ncoordinates = [\"a\", \"b\"]\n"
           "momenta = [\"px\", \"pv\"]\n[algebroid]\nkind = \"tangent\"\n[control]\n" +
           block;
}

} // namespace

TEST_CASE("a Hamiltonian that is given moves by the Lie-Poisson equations", "[kernels]")
{
    const KernelModule module =
        module_of(body + "[hamiltonian]\nH = \"m1^2/(2*I1) + m2^2/(2*I2) + m3^2/(2*I3)\"\n", "");
    CHECK(module.name == "body_hamilton");
    const Values point{{"t", 0}, {"I1", 1}, {"I2", 2}, {"I3", 3}, {"m1", 0.5}, {"m2", -1.5}, {"m3", 2}};
    // m' = m x w, w = m / I
    check_close(values_of(module, "rhs", point),
                {-1.5 * 2 / 3 + 2 * 0.75, 2 * 0.5 - 0.5 * 2 / 3, 0.5 * -0.75 + 1.5 * 0.5});
    check_close(values_of(module, "velocity", point), {0.5, -0.75, 2.0 / 3});
    check_close(values_of(module, "hamiltonian", point), {0.125 + 0.5625 + 2.0 / 3});
}

TEST_CASE("velocities that are no linear functions of the momenta are solved for", "[kernels]")
{
    const KernelModule module = module_of(particle, "hamilton");
    REQUIRE(module.implicit.size() == 1);
    for (const double p : {0.0, 1e-9, 0.5, -3.0, 40.0, -900.0}) {
        INFO(p);
        const double v = p / std::sqrt(4 + p * p);
        const double energy = std::sqrt(4 + p * p) + 0.125;
        const Values point{{"t", 0.25}, {"m", 2}, {"x", 0.5}, {"p_v_x", p}};
        check_close(values_of(module, "velocity", point), {v});
        check_close(values_of(module, "rhs", point), {v, -0.5 - v * std::exp(-0.25)});
        check_close(values_of(module, "power", point), {-v * v * std::exp(-0.25)});
        // Cancellation in mu v - L: the energy loses what sqrt(1 - v^2) loses.
        CHECK(std::abs(values_of(module, "energy", point)[0] - energy) <= 1e-9 * energy);
    }
}

TEST_CASE("velocities of a convex Lagrangian have the momenta that were given", "[kernels]")
{
    // p = (u + 2 u^3 + 2 u v^2, v + 2 v^3 + 2 v u^2) + (sinh(u), 0)
    const KernelModule module =
        module_of("name = \"convex\"\n[base]\ncoordinates = [\"x\", \"y\"]\n[fibre]\n"
                  "coordinates = [\"u\", \"v\"]\nmomenta = [\"p\", \"q\"]\n[algebroid]\nkind = "
                  "\"tangent\"\n[lagrangian]\nL = \"(u^2 + v^2)/2 + (u^2 + v^2)^2/2 + cosh(u) - x*y\"\n",
                  "hamilton");
    REQUIRE(module.implicit.size() == 1);
    CHECK(module.implicit[0].structure == MatrixStructure::positive_definite);
    for (const auto& [u, v] : {std::pair{0.0, 0.0}, {0.5, -1.5}, {-3.0, 2.0}, {1e-6, 4.0}}) {
        const double p = u + 2 * u * (u * u + v * v) + std::sinh(u), q = v + 2 * v * (u * u + v * v);
        check_close(values_of(module, "velocity", {{"t", 0}, {"x", 0.5}, {"y", 2}, {"p", p}, {"q", q}}), {u, v});
    }
}

TEST_CASE("velocities that are all positive are found from a positive one", "[kernels]")
{
    // p = log(v) + 1
    const KernelModule module = module_of("name = \"entropy\"\n[base]\ncoordinates = [\"x\"]\n[algebroid]\nkind = "
                                          "\"tangent\"\n[lagrangian]\nL = \"v_x*log(v_x) - x\"\n",
                                          "hamilton");
    for (const double p : {-4.0, 0.0, 1.0, 3.5, 9.0})
        check_close(values_of(module, "velocity", {{"t", 0}, {"x", 0.5}, {"p_v_x", p}}), {std::exp(p - 1)});
}

/// Of a particle on the line with this L and these lines of the base.
KernelModule on_line(const std::string& lagrangian, const std::string& domain = "")
{
    return module_of("name = \"line\"\n[parameters]\nn = -1\n[base]\ncoordinates = [\"x\"]\n" + domain +
                         "[algebroid]\nkind = \"tangent\"\n[lagrangian]\nL = \"" + lagrangian + "\"\n",
                     "hamilton");
}

double velocity_on_line(const KernelModule& module, double p)
{
    return values_of(module, "velocity", {{"t", 0}, {"n", -1}, {"x", 0}, {"p_v_x", p}})[0];
}

TEST_CASE("velocities lie where L is defined, also where its roots cancel in dL/dy", "[kernels]")
{
    // p = (1 - v)^-2 and (1 - v)^-2, which v = 1.5 and v = 2 solve too; p = -3 (1 - v)^2
    CHECK(velocity_on_line(on_line("(1 - v_x)^(-3/2)*sqrt(1 - v_x)"), 4) == 0.5);
    CHECK(velocity_on_line(on_line("(1 - v_x)^n", "domain = [\"n < 0\"]\n"), 4) == 0.5);
    CHECK(std::abs(velocity_on_line(on_line("sqrt(1 - v_x)*(1 - v_x)^(5/2)"), -3.0 / 4) - 0.5) <= 1e-16);
    CHECK_THROWS_WITH(velocity_on_line(on_line("(1 - v_x)^(-3/2)*sqrt(1 - v_x)"), -1),
                      "error: Newton's method finds no velocity: y with dL/dy^a = mu_a (the Legendre transform).");
}

TEST_CASE("velocities are found where terms of dL/dy cancel, overflow, or have no slope at their end", "[kernels]")
{
    const KernelModule exponential = on_line("exp(v_x) - v_x"); // p = exp(v) - 1
    for (const double p : {1e-4, 1e-8, 1e-10, 1e-13, 1e-16})
        CHECK(std::abs(velocity_on_line(exponential, p) - p) <= p * p + 3e-16);
    for (const double p : {1e3, 1e9, 1e15})
        CHECK(std::abs(velocity_on_line(exponential, p) / std::log1p(p) - 1) <= 1e-15);
    // In a frame that moves with half the speed of light, and with nearly that speed.
    for (const double u : {0.5, 0.9999}) {
        const KernelModule frame = on_line("-sqrt(1 - (v_x + " + std::to_string(u) + ")^2)");
        for (const double v : {0.0, 1e-12, -1e-9, 1e-6}) {
            const double gamma = 1 / std::sqrt(1 - (u + v) * (u + v));
            CHECK(std::abs(velocity_on_line(frame, (u + v) * gamma) - v) <= 1e-15);
        }
    }
    // Cancellation inside functions, and at the zero of a power.
    const KernelModule inside = on_line("cosh(v_x + 1000000.1 - 1000000)");
    for (const double p : {0.10016675, 0.1001668, 0.10017, 0.5, 100.0})
        CHECK(std::abs(velocity_on_line(inside, p) - (std::asinh(p) - 0.1)) <= 1e-9);
    // Conditions at 0, and sets that move away from it.
    const KernelModule power = on_line("v_x^2/2 + v_x^n", "domain = [\"n > 2\"]\n");
    for (const double v : {0.06169, 0.3903, 10.835})
        CHECK(std::abs(values_of(power, "velocity",
                                 {{"t", 0}, {"n", 2.5}, {"x", 0}, {"p_v_x", v + 2.5 * std::pow(v, 1.5)}})[0] -
                       v) <= 1e-14 * v);
    const KernelModule light = on_line("-sqrt(1 - (v_x + x)^2)"), entropy = on_line("(v_x - x)*log(v_x - x)");
    for (const double x : {-7.0, 0.0, 5.0})
        for (const double p : {-3.0, 0.0, 1.0}) {
            const auto at = [&](const KernelModule& module) {
                return values_of(module, "velocity", {{"t", 0}, {"n", -1}, {"x", x}, {"p_v_x", p}})[0];
            };
            CHECK(std::abs(at(light) - (p / std::sqrt(1 + p * p) - x)) <= 4e-15);
            CHECK(std::abs(at(entropy) - (x + std::exp(p - 1))) <= 4e-15);
        }
    const KernelModule arc = on_line("v_x*asin(v_x) + sqrt(1 - v_x^2)"); // p = asin(v)
    for (const double p : {-1.5, 1e-20, 1.0, 1.57}) CHECK(std::abs(velocity_on_line(arc, p) - std::sin(p)) <= 4e-16);
}

TEST_CASE("the velocity of a particle in a moving frame is found in every direction", "[kernels]")
{
    const KernelModule frame =
        module_of("name = \"frame\"\n[base]\ncoordinates = [\"x\", \"y\"]\n[algebroid]\nkind = \"tangent\"\n"
                  "[lagrangian]\nL = \"-sqrt(1 - (v_x + 1/2)^2 - v_y^2)\"\n",
                  "hamilton");
    const KernelModule quadratic =
        module_of("name = \"quadratic\"\n[base]\ncoordinates = [\"x\", \"y\"]\n[algebroid]\nkind = "
                  "\"tangent\"\n[lagrangian]\nL = \"-sqrt(1 - v_x^2 - v_y^2) + v_x^2/2\"\n",
                  "hamilton");
    for (const double size : {1.0, 10.0, 100.0, 1e4})
        for (int k = 0; k < 36; ++k) {
            const double p = size * std::cos(k * std::acos(-1) / 18), q = size * std::sin(k * std::acos(-1) / 18);
            const Values point{{"t", 0}, {"x", 0}, {"y", 0}, {"p_v_x", p}, {"p_v_y", q}};
            const double energy = std::sqrt(1 + size * size);
            const std::vector<double> v = values_of(frame, "velocity", point);
            CHECK(std::abs(v[0] - (p / energy - 0.5)) <= 1e-14);
            CHECK(std::abs(v[1] - q / energy) <= 1e-14);
            const std::vector<double> u = values_of(quadratic, "velocity", point);
            if (size > 100) continue;
            const double gamma = 1 / std::sqrt(1 - u[0] * u[0] - u[1] * u[1]);
            CHECK(std::abs(u[0] * (gamma + 1) - p) <= 1e-15 * gamma * gamma * gamma);
            CHECK(std::abs(u[1] * gamma - q) <= 1e-15 * gamma * gamma * gamma);
        }
    const std::vector<double> v =
        values_of(quadratic, "velocity", {{"t", 0}, {"x", 0}, {"y", 0}, {"p_v_x", 100}, {"p_v_y", 300}});
    CHECK(std::abs(v[0] - 0.31533) <= 5e-6);
    CHECK(std::abs(v[1] - 0.94898) <= 5e-6);
}

TEST_CASE("the velocity of a particle in a frame near the speed of light is found in every direction", "[kernels]")
{
    // From y = 0, where the speed is 0.92: beside a singularity that lies in the way of half the directions.
    const KernelModule frame =
        module_of("name = \"frame\"\n[base]\ncoordinates = [\"x\", \"y\", \"z\"]\n[algebroid]\nkind = "
                  "\"tangent\"\n[lagrangian]\nL = \"-1.3*sqrt(1 - (v_x + 0.6)^2 - (v_y - 0.7)^2 - v_z^2)\"\n",
                  "hamilton");
    std::mt19937 dice(8);
    std::normal_distribution<double> normal;
    for (int k = 0; k < 300; ++k) {
        const double size = std::pow(10, -3 + 6 * (k % 10) / 9.0);
        const double p = size * normal(dice), q = size * normal(dice), r = size * normal(dice);
        INFO(p << " " << q << " " << r);
        const std::vector<double> v = values_of(
            frame, "velocity", {{"t", 0}, {"x", 0}, {"y", 0}, {"z", 0}, {"p_v_x", p}, {"p_v_y", q}, {"p_v_z", r}});
        const double energy = std::sqrt(1.3 * 1.3 + p * p + q * q + r * r);
        CHECK(std::abs(v[0] - (p / energy - 0.6)) <= 1e-14);
        CHECK(std::abs(v[1] - (q / energy + 0.7)) <= 1e-14);
        CHECK(std::abs(v[2] - r / energy) <= 1e-14);
    }
}

TEST_CASE("a Lagrangian whose momenta do not fix the velocities has no Hamiltonian form", "[kernels]")
{
    const std::string wells = "name = \"wells\"\n[base]\ncoordinates = [\"x\"]\n[algebroid]\nkind = \"tangent\"\n"
                              "[lagrangian]\nL = \"v_x^4/4 - v_x^2/2\"\n";
    const std::string start = "error: the momenta dL/dy of model 'wells' are not shown to fix the velocities, as its "
                              "Hamiltonian form needs: ";
    const std::string end = "\nhint: give [hamiltonian] H, or conditions on x and parameters in [base] domain under "
                            "which d2L/dy2 is definite";
    CHECK(refusal(wells, "hamilton") == start + "d2L/dy2 is not shown to be definite" + end);
    CHECK(refusal(wells, "lagrange").empty());
    CHECK(refusal(wells + "[hamiltonian]\nH = \"p_v_x^2/2\"\n", "hamilton").empty());
    const std::string pole = "name = \"wells\"\n[base]\ncoordinates = [\"x\"]\n[algebroid]\nkind = \"tangent\"\n"
                             "[lagrangian]\nL = \"1/v_x\"\n";
    CHECK(refusal(pole, "hamilton") ==
          start + "v_x is not shown to be nonzero, and L is smooth only where it is" + end);
}

TEST_CASE("compiled Newton iterations agree with the interpreter in four scalars", "[kernels][compile]")
{
    std::vector<CompiledCase> cases;
    const KernelModule particles =
        module_of(particle, "hamilton", {"rhs", "velocity", "energy", "jacobian", "hamiltonian_hessian"});
    cases.push_back({particles, {}});
    for (const double p : {0.0, 0.5, -3.0})
        cases.back().points.push_back({{"t", 0.25}, {"m", 2}, {"x", 0.5}, {"p_v_x", p}});
    const KernelModule steering = module_of(
        control("controls = [\"u\"]\nsigma = { a = \"v\", b = \"u\" }\ncost = \"exp(u) - u + x^2/2\"\n"), "pontryagin");
    REQUIRE(steering.implicit.size() == 1);
    cases.push_back({steering, {{{"t", 0}, {"x", 1}, {"v", 2}, {"px", 0.5}, {"pv", 3}}}});
    const std::pair<const char*, std::vector<double>> lines[] = {{"(1 - v_x)^(-3/2)*sqrt(1 - v_x)", {0.25, 4}},
                                                                 {"exp(v_x) - v_x", {1e12, -0.5, 3}},
                                                                 {"v_x*asin(v_x) + sqrt(1 - v_x^2)", {1, -1.5}}};
    for (std::size_t k = 0; k < std::size(lines); ++k) {
        KernelModule module = on_line(lines[k].first);
        module.name += std::to_string(k);
        cases.push_back({module, {}});
        for (const double p : lines[k].second)
            cases.back().points.push_back({{"t", 0}, {"n", -1}, {"x", 0}, {"p_v_x", p}});
    }
    compare_compiled("newton", "g++", cases, 200);
    if (run_shell("clang++ --version").status == 0) compare_compiled("newton", "clang++", cases, 200);
}

TEST_CASE("the variational equations are the Jacobian times a vector", "[kernels]")
{
    for (const auto& [text, form] : {std::pair{particle, "hamilton"}, {particle, "lagrange"}}) {
        const KernelModule module = module_of(text, form, {"rhs", "jacobian", "variational"});
        Values point{{"t", 0.25}, {"m", 2}, {"x", 0.5}, {"p_v_x", 0.75}, {"v_x", 0.6}};
        const std::vector<double> v{0.3, -1.25};
        for (std::size_t k = 0; k < 2; ++k)
            point[module.graph->input_name(find_kernel(module, "variational").inputs[2].entries[k].input)] = v[k];
        std::vector<double> expected(2, 0.0);
        const Kernel& jacobian = find_kernel(module, "jacobian");
        const std::vector<double> values = values_of(module, "jacobian", point);
        for (std::size_t k = 0; k < values.size(); ++k)
            expected[jacobian.outputs[0].entries[k].row] += values[k] * v[jacobian.outputs[0].entries[k].column];
        check_close(values_of(module, "variational", point), expected);
        CHECK(std::abs(expected[1]) > 0.05);
    }
}

TEST_CASE("controls solve dH/du = 0 and stay within their bounds", "[kernels]")
{
    const std::string problem =
        control("controls = [\"u\"]\nsigma = { a = \"v\", b = \"u\" }\ncost = \"u^2/2\"\nbounds = { u = [-1, 2] }\n");
    const KernelModule module = module_of(problem, "");
    CHECK(module.name == "problem_pontryagin");
    for (const double pv : {-3.0, -0.5, 1.5, 7.0}) {
        const double u = std::min(std::max(pv, -1.0), 2.0);
        const Values point{{"t", 0}, {"x", 1}, {"v", 2}, {"px", 0.5}, {"pv", pv}};
        check_close(values_of(module, "controls", point), {u});
        check_close(values_of(module, "rhs", point), {2, u, 0, -0.5});
        check_close(values_of(module, "hamiltonian", point), {0.5 * 2 + pv * u - u * u / 2});
    }
    const KernelModule implicit = module_of(
        control(
            "controls = [\"u\"]\nsigma = { a = \"v\", b = \"u\" }\ncost = \"exp(u) - u\"\nbounds = { u = [-3, 1] }\n"),
        "");
    for (const double pv : {-0.5, 0.5, 9.0})
        check_close(values_of(implicit, "controls", {{"t", 0}, {"x", 1}, {"v", 2}, {"px", 0.5}, {"pv", pv}}),
                    {std::min(std::log(1 + pv), 1.0)});
}

TEST_CASE("forms that a model does not have are refused with the reason", "[kernels]")
{
    CHECK(refusal(body, "lagrange") ==
          "error: model 'body' has no Lagrangian; the Lagrangian form needs [lagrangian] L");
    CHECK(refusal(body, "hamilton") ==
          "error: model 'body' has no Lagrangian; the Hamiltonian form needs [lagrangian] L or [hamiltonian] H");
    CHECK(refusal(body + "[lagrangian]\nL = \"w1^2/2 + w2^2\"\n", "hamilton") ==
          "error: the Lagrangian of model 'body' is degenerate: d2L/dy2 has rank 2, and the Hamiltonian form needs "
          "rank 3\n"
          "hint: the velocities cannot be solved for; give every fibre coordinate a kinetic term");
    CHECK(refusal(body, "pontryagin") == "error: model 'body' is no control problem; the Pontryagin form needs "
                                         "[control] with controls, sigma and cost");
    CHECK(
        refusal(control("controls = [\"u\"]\nsigma = { a = \"v\", b = \"u\" }\ncost = \"x^2\"\n"), "pontryagin") ==
        "error: the controls of model 'problem' are not solved for: H is affine in the control u: dH/du = 0 does not "
        "determine it; without two bounds H has a maximum only where dH/du = pv is 0 (a singular control)\nhint: give "
        "the cost a term in which u is strictly convex");
    const std::string bounded = "error: the controls of model 'problem' are not solved for: with bounds on controls H "
                                "must be separable, smooth "
                                "and strictly concave in them, or dH/du = 0 and the bounds do not give its maximum: ";
    const std::string hint = "\nhint: without bounds dH/du = 0 is solved as it is";
    CHECK(refusal(control("controls = [\"u\", \"w\"]\nsigma = { a = \"u\", b = \"w\" }\ncost = \"u^2 + u*w + w^2\"\n"
                          "bounds = { u = [0, 1] }\n"),
                  "pontryagin") == bounded + "d2H/dudw is not zero" + hint);
    CHECK(refusal(control("controls = [\"u\"]\nsigma = { a = \"v\", b = \"u\" }\ncost = \"x*u^2\"\n"
                          "bounds = { u = [0, 1] }\n"),
                  "pontryagin") == bounded + "d2H/du2 < 0 was not proved for all admissible u" + hint);
}
