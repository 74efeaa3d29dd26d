// SPDX-License-Identifier: GPL-2.0-or-later
/// Controls that maximise H between bounds, against the largest of many values of H.
#include "models.hpp"

#include "../support/compiled.hpp"
#include "../support/tolerances.hpp"

#include <cmath>
#include <functional>

using namespace lagen;
using namespace lagen::testing;

namespace {

std::string line_problem(const std::string& cost, const std::string& bounds, const std::string& name = "line")
{
    return "name = \"" + name +
           "\"\n[base]\ncoordinates = [\"x\"]\n[fibre]\ncoordinates = [\"v\"]\nmomenta = [\"p\"]\n"
           "[algebroid]\nkind = \"tangent\"\n[control]\ncontrols = [\"u\"]\nsigma = { v = \"u\" }\ncost = \"" +
           cost + "\"\n" + (bounds.empty() ? "" : "bounds = { u = " + bounds + " }\n");
}

/// Where p u - cost(u) is largest on [lower, upper]: the best of many points, then of many around it.
double largest_at(const std::function<double(double)>& H, double lower, double upper)
{
    constexpr int points = 2000;
    double best = lower;
    for (int round = 0; round < 4; ++round) {
        const double width = (upper - lower) / points;
        for (int k = 0; k <= points; ++k) {
            const double u = std::min(lower + k * width, upper);
            if (H(u) > H(best)) best = u;
        }
        lower = std::max(lower, best - width);
        upper = std::min(upper, best + width);
    }
    return best;
}

struct BoundedCase {
    const char* cost;
    const char* bounds;
    double lower, upper; ///< between which the maximum is looked for
    std::function<double(double)> value;
    std::vector<double> costates;
};

const std::vector<BoundedCase>& bounded_cases()
{
    constexpr double far = 60;
    static const std::vector<BoundedCase> cases = {
        {"-log(cos(u))", "[-1.5, 1.5]", -1.5, 1.5, [](double u) { return -std::log(std::cos(u)); }, {4, -4, 0.3, 99}},
        {"u^2/2 + 1/u^2", "[0.5, 20]", 0.5, 20, [](double u) { return u * u / 2 + 1 / (u * u); }, {-2, -99, 3, 25}},
        {"sqrt(1 + u^2)", "[-1, 1]", -1, 1, [](double u) { return std::sqrt(1 + u * u); }, {2, -2, 0.5}},
        {"sqrt(1 + u^2)", "[-10, 10]", -10, 10, [](double u) { return std::sqrt(1 + u * u); }, {0.98, -0.5, 0.999}},
        {"exp(u)", "[-1, 1]", -1, 1, [](double u) { return std::exp(u); }, {-1, 0.1, 1.5, 9}},
        {"exp(u) - u", "[\"-inf\", 1]", -far, 1, [](double u) { return std::exp(u) - u; }, {-0.5, 0.5, 9}},
        {"exp(u)", "[-1, \"inf\"]", -1, far, [](double u) { return std::exp(u); }, {-3, 1, 50}},
        {"u^4/4 + u^2/2", "[-1, inf]", -1, far, [](double u) { return u * u * u * u / 4 + u * u / 2; }, {-9, 0.5, 70}},
        {"u^2/2", "[-inf, 0.25]", -far, 0.25, [](double u) { return u * u / 2; }, {-9, 0.5}}};
    return cases;
}

double control_of(const KernelModule& module, double p)
{
    return values_of(module, "controls", {{"t", 0}, {"x", 0.5}, {"p", p}}).front();
}

} // namespace

TEST_CASE("a bounded control is where H is largest between its bounds", "[kernels]")
{
    for (const BoundedCase& each : bounded_cases()) {
        INFO(each.cost << " on " << each.bounds);
        const KernelModule module = kernels_of_text(line_problem(each.cost, each.bounds));
        for (const double p : each.costates) {
            INFO(p);
            const auto H = [&](double u) { return p * u - each.value(u); };
            const double sampled = largest_at(H, each.lower, each.upper);
            const double u = control_of(module, p);
            // H is flat at its maximum: the sampled place is known to the root of its rounding.
            CHECK(std::abs(u - sampled) <= 1e-6 * std::max(1.0, std::abs(sampled)));
            CHECK(H(u) >= H(sampled) - tolerance::roundoff(8) * (1 + std::abs(H(sampled))));
            CHECK(values_of(module, "rhs", {{"t", 0}, {"x", 0.5}, {"p", p}})[0] == u);
        }
    }
    CHECK(control_of(kernels_of_text(line_problem("-log(cos(u))", "[-1.5, 1.5]")), 4) ==
          Approx(std::atan(4)).epsilon(tolerance::roundoff(8)));
    CHECK(control_of(kernels_of_text(line_problem("exp(u)", "[-1, 1]")), -1) == -1);
    CHECK(control_of(kernels_of_text(line_problem("sqrt(1 + u^2)", "[-1, 1]")), 2) == 1);
}

TEST_CASE("bounds may lie where the Hamiltonian cannot be computed", "[kernels]")
{
    for (const char* bounds : {"[-1000, 1000]", "[-1e200, 1e200]", "[0, \"inf\"]"})
        CHECK(control_of(kernels_of_text(line_problem("log(cosh(u))", bounds)), 0.5) ==
              Approx(std::atanh(0.5)).epsilon(tolerance::roundoff(8)));
    const KernelModule flat = kernels_of_text(line_problem("sqrt(1 + u^2)", "[-1e200, 1e200]"));
    for (const double p : {0.0, -0.6, 0.96})
        CHECK(control_of(flat, p) == Approx(p / std::sqrt(1 - p * p)).epsilon(tolerance::roundoff(64)));
    CHECK_THROWS_WITH(control_of(flat, 1.5),
                      "error: no controls were found: u with dH/du = 0, each between its bounds, or the bound next to "
                      "it.");
}

TEST_CASE("a concave Hamiltonian without bounds has its control found where Newton's steps from 0 have none",
          "[kernels]")
{
    const KernelModule quartic = kernels_of_text(line_problem("u^4/4", ""));
    for (const double p : {0.0, 1e-6, 0.3, -8.0, 1e9})
        CHECK(control_of(quartic, p) == Approx(std::cbrt(p)).epsilon(tolerance::roundoff(8)));
    const KernelModule flat = kernels_of_text(line_problem("sqrt(1 + u^2)", ""));
    for (const double p : {0.0, -0.6, 0.96})
        CHECK(control_of(flat, p) == Approx(p / std::sqrt(1 - p * p)).epsilon(tolerance::roundoff(64)));
    CHECK_THROWS_WITH(control_of(flat, 1.5), "error: no controls were found: u with dH/du = 0.");
}

TEST_CASE("a control is where H is defined, also where what must be positive cancels in dH/du", "[kernels]")
{
    const KernelModule roots = kernels_of_text(line_problem("(1 - u)^(3/2)*(1 - u)^(1/2)", ""));
    CHECK(control_of(roots, -3) == Approx(-0.5).epsilon(tolerance::roundoff(8)));
    CHECK_THROWS_WITH(control_of(roots, 3), "error: Newton's method finds no controls: u with dH/du = 0.");
    const KernelModule angles = kernels_of_text(line_problem("u^2/2 + acos(u) + asin(u)", ""));
    CHECK(control_of(angles, 0.75) == Approx(0.75).epsilon(tolerance::roundoff(8)));
    CHECK_THROWS_WITH(control_of(angles, 3), "error: Newton's method finds no controls: u with dH/du = 0.");
}

TEST_CASE("a cost with a barrier has its control found inside", "[kernels]")
{
    const KernelModule barrier = kernels_of_text(line_problem("-log(1 - u^2)", ""));
    REQUIRE(barrier.implicit.size() == 1);
    CHECK_FALSE(barrier.implicit[0].bracket);
    CHECK(find_kernel(barrier, "controls").documentation == std::vector<std::string>{"The controls that maximise H."});
    const KernelModule entropy = kernels_of_text(line_problem("u*log(u)", ""));
    for (const double p : {-1e6, -3.0, 1e-9, 0.5, 40.0, 1e8}) {
        INFO(p);
        CHECK(control_of(barrier, p) == Approx(p / (1 + std::hypot(1, p))).epsilon(tolerance::roundoff(8)));
        if (std::abs(p) < 100)
            CHECK(control_of(entropy, p) == Approx(std::exp(p - 1)).epsilon(tolerance::roundoff(64)));
    }
    CHECK_THROWS_WITH(control_of(kernels_of_text(line_problem("-sqrt(1 - u)", "")), -1),
                      "error: Newton's method finds no controls: u with dH/du = 0.");
}

TEST_CASE("barriers that move with the state have their control found inside at every state", "[kernels]")
{
    const auto at = [](const KernelModule& module, double x, double p) {
        return values_of(module, "controls", {{"t", 0}, {"x", x}, {"p", p}})[0];
    };
    const auto problem = [](const std::string& cost) {
        return kernels_of_text("name = \"moving\"\n[base]\ncoordinates = [\"x\"]\n[fibre]\ncoordinates = [\"v\"]\n"
                               "momenta = [\"p\"]\n[algebroid]\nkind = \"tangent\"\n[control]\ncontrols = [\"u\"]\n"
                               "sigma = { v = \"u\" }\ncost = \"" +
                               cost + "\"\n");
    };
    const KernelModule between = problem("-log(u - x) - log(x + 1 - u)");
    const KernelModule vanishing = problem("u^2/2 + u^4 - log(2 + x*u)");
    const KernelModule quadratic = problem("u^2/2 - sqrt(1 - (x*u - 1/2)^2)");
    for (const double x : {0.0, 0.3, -3.0, 100.0}) {
        CHECK(at(between, x, 0) == Approx(x + 0.5).epsilon(1e-12).margin(1e-12));
        const double u = at(between, x, 3);
        CHECK(1 / (u - x) - 1 / (x + 1 - u) + 3 == Approx(0).margin(1e-9));
    }
    for (const double x : {0.0, 1e-60, 1e-6}) CHECK(at(vanishing, x, 1) == Approx(0.5).epsilon(1e-5));
    CHECK(at(quadratic, 0, -3) == Approx(-3).epsilon(1e-12));
}

TEST_CASE("separate controls are bounded each by itself", "[kernels]")
{
    const KernelModule module = kernels_of_text(
        "name = \"pair\"\n[parameters]\ntop = 2\n[base]\ncoordinates = [\"x\", \"y\"]\n[fibre]\ncoordinates = "
        "[\"a\", \"b\"]\nmomenta = [\"p\", \"q\"]\n[algebroid]\nkind = \"tangent\"\n[control]\ncontrols = [\"u\", "
        "\"w\", \"z\"]\nsigma = { a = \"u + z\", b = \"w\" }\ncost = \"cosh(u) + w^2/2 + exp(z)\"\n"
        "bounds = { u = [-1, \"top\"], z = [-3, \"inf\"] }\n");
    REQUIRE(module.implicit.size() == 1);
    for (const double p : {-7.0, -0.5, 0.25, 3.0, 90.0}) {
        INFO(p);
        const std::vector<double> found =
            values_of(module, "controls", {{"t", 0}, {"top", 2}, {"x", 1}, {"y", 1}, {"p", p}, {"q", -0.75}});
        CHECK(found[0] == Approx(std::clamp(std::asinh(p), -1.0, 2.0)).epsilon(tolerance::roundoff(8)));
        CHECK(found[1] == Approx(-0.75).epsilon(tolerance::roundoff(4)));
        CHECK(found[2] == Approx(p > 0 ? std::max(std::log(p), -3.0) : -3.0).epsilon(tolerance::roundoff(8)));
    }
}

TEST_CASE("bounds over parameters are conditions of parameter_status()", "[kernels]")
{
    const auto conditions = [](const std::string& cost, const std::string& bounds) {
        const std::string text = line_problem(cost, bounds);
        const std::size_t at = text.find("[base]");
        return kernels_of_text(text.substr(0, at) + "[parameters]\nlo = -1\nhi = 2\n" + text.substr(at));
    };
    const auto value = [](const KernelModule& module, double lo, double hi) {
        const NodeId node[] = {module.parameter_conditions.at(0).second};
        return evaluate<double>(*module.graph, node, {{"lo", lo}, {"hi", hi}})[0];
    };
    const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
    for (const char* cost : {"u^2/2", "cosh(u)"}) {
        const KernelModule both = conditions(cost, "[\"lo\", \"hi\"]");
        REQUIRE(both.parameter_conditions.size() == 1);
        CHECK(both.parameter_conditions[0].first == "lo < hi");
        CHECK(value(both, -1, 2) > 0);
        CHECK(value(both, -infinity, 2) > 0);
        CHECK_FALSE(value(both, 2, 2) > 0);
        CHECK_FALSE(value(both, 3, 2) > 0);
        CHECK_FALSE(value(both, nan, 2) > 0);
        const KernelModule one = conditions(cost, "[\"lo\", \"inf\"]");
        REQUIRE(one.parameter_conditions.size() == 1);
        CHECK(one.parameter_conditions[0].first == "lo is finite");
        CHECK(value(one, -1, 0) > 0);
        CHECK_FALSE(value(one, nan, 0) > 0);
        CHECK_FALSE(value(one, infinity, 0) > 0);
        CHECK(conditions(cost, "[-1, 2]").parameter_conditions.empty());
    }
}

TEST_CASE("derivatives through bounded controls are those of the root inside, and none at a bound", "[kernels]")
{
    KernelRequest request;
    request.only = {"rhs", "jacobian"};
    const KernelModule module =
        kernels_of(read_model_text("test.toml", line_problem("cosh(u)*(2 + cos(x))", "[-1, 1]")), request);
    const auto rate = [&](double x, double p) { return values_of(module, "rhs", {{"t", 0}, {"x", x}, {"p", p}}); };
    for (const double p : {-20.0, -1.5, 0.3, 2.0, 20.0}) {
        INFO(p);
        const double x = 0.5, step = 1e-5;
        const std::vector<double> values = values_of(module, "jacobian", {{"t", 0}, {"x", x}, {"p", p}});
        const Kernel& jacobian = find_kernel(module, "jacobian");
        for (std::size_t k = 0; k < values.size(); ++k) {
            const KernelEntry& entry = jacobian.outputs[0].entries[k];
            const std::vector<double> up = entry.column == 0 ? rate(x + step, p) : rate(x, p + step);
            const std::vector<double> down = entry.column == 0 ? rate(x - step, p) : rate(x, p - step);
            CHECK(std::abs(values[k] - (up[entry.row] - down[entry.row]) / (2 * step)) <=
                  tolerance::difference * (1 + std::abs(values[k])));
            if (std::abs(p) > 10 && entry.row == 0) CHECK(values[k] == 0);
        }
    }
}

TEST_CASE("compiled brackets agree with the interpreter in four scalars", "[kernels][compile]")
{
    KernelRequest request;
    request.only = {"rhs", "controls", "hamiltonian", "jacobian"};
    std::vector<CompiledCase> cases;
    struct Case {
        const char *cost, *bounds;
        std::vector<double> costates;
    };
    for (const Case& each : {Case{"-log(cos(u)) + x^2/2", "[-1.5, 1.5]", {-4, 0.5, 2}},
                             Case{"exp(u) + x^2/2", "[-1, \"inf\"]", {-4, 0.5, 2}},
                             Case{"log(cosh(u)) + x^2/2", "[-1000, 1000]", {-0.9, 0, 0.5}}}) {
        const std::string name = "line" + std::to_string(cases.size());
        cases.push_back(
            {kernels_of(read_model_text("test.toml", line_problem(each.cost, each.bounds, name)), request), {}});
        for (const double p : each.costates) cases.back().points.push_back({{"t", 0}, {"x", 0.5}, {"p", p}});
    }
    compare_compiled("bracket", "g++", cases, 200);
    if (run_shell("clang++ --version").status == 0) compare_compiled("bracket", "clang++", cases, 200);
}

TEST_CASE("what is not proved to be a maximum says so in the header", "[kernels]")
{
    const KernelModule stationary = kernels_of_text(line_problem("-cos(u)", ""));
    CHECK(find_kernel(stationary, "controls").documentation == std::vector<std::string>{stationary_controls});
    const std::string text = print_header(stationary);
    CHECK(text.find("/// Stationary controls: dH/du = 0; that H is largest there is not proved.") != std::string::npos);
    CHECK(text.find("maximise") == std::string::npos);
    const std::string proved = print_header(kernels_of_text(line_problem("cosh(u)", "")));
    CHECK(proved.find("/// The controls that maximise H.") != std::string::npos);
    CHECK(proved.find("Stationary") == std::string::npos);
}
