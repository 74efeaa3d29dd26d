// SPDX-License-Identifier: GPL-2.0-or-later
/// Inputs as members of a module, or inserted as a scene gives them; their Jacobian, and inverse dynamics.
#include "models.hpp"

#include "emit/print_header.hpp"
#include "support/tolerances.hpp"

using namespace lagen;
using namespace lagen::testing;

namespace {

/// An arm of two joints with torques, of which one is a vector's entry, and friction.
const std::string driven_arm = R"toml(name = "arm"
[parameters]
m = 2
k = 3
[base]
coordinates = ["a", "b"]
[fibre]
coordinates = ["w_a", "w_b"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "(3 + 2*cos(b))*w_a^2/2 + (1 + cos(b))*w_a*w_b + m*w_b^2/2 + k*cos(a)"
[inputs]
"u[1..2]" = "[m*k, 0]"
load = 1
[states]
z = "u[2] - z"
[forces]
w_a = "u[1]*cos(a) - w_a"
w_b = "load*u[2] + z"
[observables]
effort = "u[1]^2"
[scene.default]
initial = { a = 1, b = 0, w_a = 0, w_b = 0 }
inputs = { u = "[-a - w_b, t*z]" }
events = { weak = { when = "u[1] - 1" } }
)toml";

/// The same with the inputs of its scene written out.
std::string written_out()
{
    std::string text = driven_arm;
    const auto replace = [&](const std::string& from, const std::string& to) {
        for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
            text.replace(at, from.size(), to);
    };
    replace("inputs = { u = \"[-a - w_b, t*z]\" }\n", "");
    replace("[inputs]\n\"u[1..2]\" = \"[m*k, 0]\"\nload = 1\n", "");
    replace("load*u[2]", "t*z");
    replace("u[1]", "(-a - w_b)");
    replace("u[2]", "(t*z)");
    return text;
}

KernelModule module_of(const std::string& text, const std::string& form, bool scene)
{
    const Model model = read_model_text("test.toml", text);
    KernelRequest request;
    request.form = form;
    if (scene) request.scene = &find_scene(model, "default");
    return kernels_of(model, request);
}

} // namespace

TEST_CASE("a scene's inputs give the kernels of the model in which they are written out", "[kernels]")
{
    for (const std::string form : {"lagrange", "hamilton"}) {
        const KernelModule given = module_of(driven_arm, form, true), written = module_of(written_out(), form, true);
        CHECK(given.inputs.empty());
        const Values point = random_point(written, 3);
        for (const std::string kernel : {"rhs", "jacobian", "power", "events", "observables"}) {
            if (!has_kernel(written, kernel)) continue;
            CAPTURE(form, kernel);
            const std::vector<double> left = values_of(given, kernel, point), right = values_of(written, kernel, point);
            REQUIRE(left.size() == right.size());
            for (std::size_t i = 0; i < left.size(); ++i) CHECK(left[i] == Approx(right[i]).epsilon(1e-13));
        }
    }
}

TEST_CASE("a law of a nonholonomic model may use coordinates of the distribution and ambient ones", "[kernels]")
{
    const auto sleigh = [](const std::string& law) {
        return R"toml([base]
coordinates = ["x", "y", "th"]
[fibre]
coordinates = ["u", "w"]
[algebroid]
kind = "nonholonomic"
[algebroid.sections]
u = { v_x = "cos(th)", v_y = "sin(th)" }
w = { v_th = 1 }
[algebroid.of]
kind = "tangent"
[lagrangian]
L = "((v_x - sin(th)*v_th)^2 + (v_y + cos(th)*v_th)^2)/2 + v_th^2/2"
[inputs]
F = 0
[forces]
v_x = "F*cos(th)"
v_y = "F*sin(th)"
[scene.default]
initial = { x = 0, y = 0, th = 0, u = 1, w = 1 }
duration = 1
inputs = { F = )toml"
               "\"" +
               law + "\" }\n";
    };
    for (const std::string form : {"lagrange", "hamilton"}) {
        CAPTURE(form);
        const KernelModule own = module_of(sleigh("-u^3"), form, true);
        const KernelModule ambient = module_of(sleigh("-(cos(th)*v_x + sin(th)*v_y)^3"), form, true);
        const KernelModule free = module_of(sleigh("0"), form, true);
        const Values point = random_point(own, 9);
        const std::vector<double> left = values_of(own, "rhs", point), right = values_of(ambient, "rhs", point);
        REQUIRE(left.size() == right.size());
        for (std::size_t i = 0; i < left.size(); ++i) CHECK(left[i] == Approx(right[i]).epsilon(1e-13));
        CHECK(std::abs(left[3] - values_of(free, "rhs", point)[3]) > 1e-3);
    }
}

TEST_CASE("without a scene inputs are members with their defaults, and their Jacobian has a column each", "[kernels]")
{
    const KernelModule module = module_of(driven_arm, "lagrange", false);
    REQUIRE(module.inputs.size() == 3);
    CHECK(module.inputs[2].name == "load");
    const std::string header = print_header(module);
    CHECK(header.find("struct Inputs {") != std::string::npos);
    CHECK(header.find("input_names = {\"u[1]\", \"u[2]\", \"load\"}") != std::string::npos);
    const Kernel& jacobian = find_kernel(module, "input_jacobian");
    CHECK(jacobian.outputs[0].shape.rows == 5);
    CHECK(jacobian.outputs[0].shape.columns == 3);
    const Values point = random_point(module, 5);
    const std::vector<double> values = values_of(module, "input_jacobian", point);
    for (std::size_t k = 0; k < values.size(); ++k) {
        const KernelEntry& entry = jacobian.outputs[0].entries[k];
        const double h = 1e-3; // quadratic in the inputs: central differences are exact
        Values left = point, right = point;
        left[module.inputs[entry.column].name] -= h;
        right[module.inputs[entry.column].name] += h;
        const double slope =
            (values_of(module, "rhs", right)[entry.row] - values_of(module, "rhs", left)[entry.row]) / (2 * h);
        CHECK(values[k] == Approx(slope).epsilon(1e-10));
    }
}

TEST_CASE("inverse dynamics of the rates of the right-hand side are the inputs", "[kernels]")
{
    std::string text = driven_arm;
    const auto put = [&text](const std::string& from, const std::string& to) {
        text.replace(text.find(from), from.size(), to);
    };
    CHECK(!has_kernel(module_of(text, "lagrange", false), "inverse_dynamics")); // three inputs, two accelerations
    put("load = 1\n", "");
    put("load*u[2] + z", "u[1] - 2*u[2] + z");
    const KernelModule module = module_of(text, "lagrange", false);
    Values point = random_point(module, 7);
    const std::vector<double> rates = values_of(module, "rhs", point);
    point["rate of w_a"] = rates[2];
    point["rate of w_b"] = rates[3];
    const double u[] = {point["u[1]"], point["u[2]"]};
    point["u[1]"] = point["u[2]"] = 100; // what the inputs are does not matter
    const std::vector<double> found = values_of(module, "inverse_dynamics", point);
    REQUIRE(found.size() == 2);
    CHECK(found[0] == Approx(u[0]).epsilon(1e-12));
    CHECK(found[1] == Approx(u[1]).epsilon(1e-12));
    CHECK(print_header(module).find("status_t<S> inverse_dynamics(") != std::string::npos);
    CHECK(!has_kernel(module_of(text, "hamilton", false), "inverse_dynamics"));

    put("u[1] - 2*u[2]", "u[1]*u[2]");
    CHECK(!has_kernel(module_of(text, "lagrange", false), "inverse_dynamics")); // not affine
    put("u[1]*u[2]", "3*u[1]");
    CHECK(!has_kernel(module_of(text, "lagrange", false), "inverse_dynamics")); // u[2] moves nothing
}
