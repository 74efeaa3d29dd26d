// SPDX-License-Identifier: GPL-2.0-or-later
#include "models.hpp"

using namespace lagen;
using namespace lagen::testing;

namespace {

const char* const oscillator = R"(name = "oscillator"
[base]
coordinates = ["x"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "v_x^2/2 - x^2/2"
[observables]
double_x = "2*x"
[scene.a]
initial = { x = 1, v_x = 0 }
duration = 1
observe = ["x", "energy", "double_x"]
[scene.a.events]
zero = { when = "x" }
same = { when = "v_x" }
[scene.b]
initial = { x = 1, v_x = 0 }
duration = 1
[scene.b.events]
zero = { when = "x - 1" }
same = { when = "v_x" }
)";

std::string message_of(const Model& model, const Report& verified, const KernelRequest& request)
{
    try {
        static_cast<void>(form_kernels(model, verified, request));
    } catch (const Error& error) {
        return error.what();
    }
    return "nothing thrown";
}

} // namespace

TEST_CASE("only the kernels asked for are made", "[kernels]")
{
    const Model model = read_model_text("test.toml", oscillator);
    KernelRequest request;
    request.only = {"energy", "rhs"};
    const KernelModule module = kernels_of(model, request);
    REQUIRE(module.kernels.size() == 2);
    CHECK(module.kernels[0].name == "rhs");
    CHECK(module.kernels[1].name == "energy");
    CHECK(kernels_of(model).kernels.size() == 8);
}

TEST_CASE("a kernel that does not exist is refused with the list of those that do", "[kernels]")
{
    const Model model = read_model_text("test.toml", oscillator);
    KernelRequest request;
    request.only = {"enrgy"};
    CHECK(message_of(model, verify(model), request) ==
          "error: there is no kernel 'enrgy'; there are rhs, jacobian, input_jacobian, variational, taylor, "
          "event_series, "
          "domain_series, flows, mass_matrix, momentum, inverse_dynamics, velocity, controls, energy, power, "
          "hamiltonian, lagrangian, "
          "ambient_velocity, reaction, moving_energy, cost, "
          "constraints, casimirs, domain, observables, invariants, "
          "lagrangian_hessian, hamiltonian_hessian, step, forward, arrow_equation, explicit_step, cayley_step, "
          "cayley_coordinates, "
          "algebra_matrix, in_algebra, element, algebra_element, algebra_action, algebra_bracket, events, jumps\nhint: "
          "did "
          "you mean 'energy'?");
}

TEST_CASE("a kernel that a form of the model does not have is refused with the list of those that it has", "[kernels]")
{
    const Model model = read_model_text("test.toml", oscillator);
    const ModelReport verified = verify(model);
    KernelRequest request;
    request.only = {"rhs", "velocity"};
    CHECK(message_of(model, verified, request) ==
          "error: the lagrange form of model 'oscillator' has no kernel 'velocity'; it has rhs, mass_matrix, momentum, "
          "energy, lagrangian, observables, events, jacobian, variational, taylor, event_series, "
          "lagrangian_hessian");
    request.only = {"domain"};
    request.form = "hamilton";
    CHECK(message_of(model, verified, request) ==
          "error: the hamilton form of model 'oscillator' has no kernel 'domain'; it has rhs, velocity, energy, "
          "hamiltonian, lagrangian, observables, events, jacobian, variational, taylor, event_series, flows, "
          "hamiltonian_hessian");
    request.only = {"lagrangian_hessian"};
    CHECK(message_of(model, verified, request)
              .ends_with("variational, taylor, event_series, flows, hamiltonian_hessian"));
    request.only = {"velocity", "variational"};
    CHECK(message_of(model, verified, request) == "nothing thrown");
    request.only.clear();
    request.with = {"tailor"};
    CHECK(message_of(model, verified, request).ends_with("events, jumps\nhint: did you mean 'taylor'?"));
    request.with = {"taylor"};
    const KernelModule module = kernels_of(model, request);
    CHECK(has_kernel(module, "taylor"));
    CHECK(has_kernel(module, "rhs"));
    CHECK_FALSE(has_kernel(module, "variational"));
}

TEST_CASE("conditions on parameters alone are no part of the domain kernel", "[kernels]")
{
    const KernelModule module = kernels_of(read_model_text(
        "test.toml",
        "name = \"bounded\"\n[parameters]\na = 1\nb = 3\n[base]\ncoordinates = [\"x\"]\ndomain = [\"a < b\", "
        "\"x < b\", \"a != 0\"]\n[algebroid]\nkind = \"tangent\"\n[lagrangian]\nL = \"v_x^2/2\"\n"));
    CHECK(find_kernel(module, "domain").outputs[0].entry_names == std::vector<std::string>{"x < b"});
    REQUIRE(module.parameter_conditions.size() == 2);
    std::vector<NodeId> nodes;
    for (const auto& [text, node] : module.parameter_conditions) nodes.push_back(node);
    CHECK(module.parameter_conditions[0].first == "a < b");
    CHECK(module.parameter_conditions[1].first == "a != 0");
    const std::map<std::string, double> point{{"a", -2}, {"b", 3}};
    CHECK(evaluate<double>(*module.graph, nodes, point) == std::vector<double>{5, 4});
}

TEST_CASE("conditions of the domain have series beside that of the motion, where they have no kinks", "[kernels]")
{
    const auto kernels = [](const std::string& condition, const std::vector<std::string>& with) {
        KernelRequest request;
        request.with = with;
        const Model model = read_model_text(
            "test.toml", "name = \"bounded\"\n[parameters]\nb = 3\n[base]\ncoordinates = [\"x\"]\ndomain = [\"" +
                             condition + "\"]\n[algebroid]\nkind = \"tangent\"\n[lagrangian]\nL = \"v_x^2/2\"\n");
        return kernels_of(model, request);
    };
    const KernelModule module = kernels("x^2 < b", {"taylor"});
    REQUIRE(has_kernel(module, "domain_series"));
    CHECK(find_kernel(module, "domain_series").recurrence->sums.size() == 1);
    CHECK_FALSE(has_kernel(kernels("x^2 < b", {}), "domain_series"));
    CHECK_FALSE(has_kernel(kernels("b > 0", {"taylor"}), "domain_series"));
    CHECK_FALSE(has_kernel(kernels("abs(x) < b", {"taylor"}), "domain_series"));
    CHECK_THROWS_WITH(kernels("abs(x) < b", {"domain_series"}),
                      "error: a Taylor series does not see the kinks and jumps of abs() along the motion: take another "
                      "method, such as "
                      "dop853");
}

TEST_CASE("events of all scenes are distinct, those of one scene bear their own names", "[kernels]")
{
    const Model model = read_model_text("test.toml", oscillator);
    CHECK(find_kernel(kernels_of(model), "events").outputs[0].entry_names ==
          std::vector<std::string>{"zero", "same", "b.zero"});
    KernelRequest request;
    request.scene = &model.scenes[1];
    CHECK(find_kernel(kernels_of(model, request), "events").outputs[0].entry_names ==
          std::vector<std::string>{"zero", "same"});
}

TEST_CASE("what a scene observes beyond lanes and observables joins the observables", "[kernels]")
{
    const Model model = read_model_text("test.toml", oscillator);
    KernelRequest request;
    request.scene = &model.scenes[0];
    const KernelModule module = kernels_of(model, request);
    CHECK(find_kernel(module, "observables").outputs[0].entry_names == std::vector<std::string>{"double_x", "energy"});
    CHECK(values_of(module, "observables", {{"x", 3}, {"v_x", 4}}) == std::vector<double>{6, 12.5});
}

TEST_CASE("a model without a Lagrangian or with a degenerate one has no kernels", "[kernels]")
{
    Model model = read_model_text("test.toml", oscillator);
    ModelReport verified = verify(model);
    verified.mechanics.regularity.kind = Regularity::Kind::degenerate;
    verified.mechanics.regularity.rank = 0;
    CHECK(
        message_of(model, verified, {}) ==
        "error: the Lagrangian of model 'oscillator' is degenerate: d2L/dy2 has rank 0, and the Lagrangian form "
        "needs rank 1\n"
        "hint: L is linear in the velocities, so its equations are of first order: solve them for x' = X(t, x) and run "
        "[hamiltonian] H = \"p.X\" in the place of L (docs/mechanics.md, Any first-order system)");
    model.lagrangian = nullptr;
    CHECK(message_of(model, verified, {}) ==
          "error: model 'oscillator' has no Lagrangian; the Lagrangian form needs [lagrangian] L");
}
