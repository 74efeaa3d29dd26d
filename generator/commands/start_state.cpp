// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/start_state.hpp"

#include "diagnostic.hpp"
#include "graph/evaluate.hpp"
#include "graph/solve_unknowns.hpp"
#include "kernels/lagrangian.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace lagen {

namespace {

using Values = std::map<std::string, long double>;

/// A kernel's output as a dense array by rows.
std::vector<long double> dense(const KernelModule& module, const Kernel& kernel, const Values& inputs)
{
    std::vector<NodeId> nodes;
    for (const KernelEntry& entry : kernel.output.entries) nodes.push_back(entry.node);
    const std::vector<long double> values = evaluate<long double>(*module.graph, nodes, inputs);
    std::vector<long double> array(kernel.output.rows * kernel.output.columns, 0);
    for (std::size_t k = 0; k < values.size(); ++k) {
        const KernelEntry& entry = kernel.output.entries[k];
        array[entry.row * kernel.output.columns + entry.column] = values[k];
    }
    return array;
}

[[nodiscard]] KernelModule module_of(const CheckedModel& checked, const char* form, const char* kernel)
{
    KernelRequest request;
    request.form = form;
    request.only = {kernel};
    return form_kernels(checked.model, checked.verified, request);
}

/// The equation value(z) = target for the lanes z of a form.
struct Inversion {
    const char* form;
    const char* value; ///< the kernel that is inverted
    const char* given; ///< for the message
    const char* wanted;
};

/// By Newton's method. Throws MathematicsError where the lanes are not shown to be unique, or not found.
std::vector<long double> invert(const CheckedModel& checked, const Inversion& inversion,
                                const std::vector<NamedNumber>& target, Values inputs)
{
    const auto fail = [&](const std::string& why) {
        throw MathematicsError(fmt::format("error: the {0} of the start {1}\nhint: give the {2} in `initial` instead",
                                           inversion.given, why, inversion.wanted));
    };
    const std::string& obstacle = checked.verified.regularity.legendre_obstacle;
    if (!obstacle.empty()) fail(fmt::format("are not shown to fix the {}: {}", inversion.wanted, obstacle));
    const KernelModule module = module_of(checked, inversion.form, inversion.value);
    Graph& graph = *module.graph;
    std::vector<NodeId> unknowns, residuals;
    for (const KernelEntry& entry : kernel_named(module, inversion.value).output.entries) {
        const NodeId wanted = graph.input("start of " + module.fibre[entry.row].name);
        inputs[graph.input_name(wanted)] = target[entry.row].second;
        residuals.push_back(graph.subtract(entry.node, wanted));
    }
    for (const Quantity& lane : module.fibre) unknowns.push_back(lane.input);
    const Model& model = checked.model;
    const NodeId function = Lowering(graph)(model.lagrangian ? model.lagrangian : model.hamiltonian);
    const ImplicitBlock block = gradient_block(graph, inversion.wanted, "", unknowns, residuals, function,
                                               checked.verified.regularity.newton_start);
    try {
        solve_unknowns<long double>(graph, {&block, 1}, inputs);
    } catch (const MathematicsError&) {
        fail(fmt::format("have no {} that Newton's method finds", inversion.wanted));
    }
    std::vector<long double> lanes;
    for (const Quantity& lane : module.fibre) lanes.push_back(inputs.at(lane.name));
    return lanes;
}

/// y with dL/dy = the given momenta.
std::vector<long double> velocities_of(const CheckedModel& checked, const SceneValues& values, const Values& inputs)
{
    return invert(checked, {"lagrange", "momentum", "momenta", "fibre coordinates"}, values.momenta, inputs);
}

/// mu = dL/dy at the given fibre coordinates, or mu with dH/dmu = them.
std::vector<long double> momenta_of(const CheckedModel& checked, const SceneValues& values, Values inputs)
{
    if (!checked.model.lagrangian)
        return invert(checked, {"hamilton", "velocity", "fibre coordinates", "momenta"}, values.fibre, inputs);
    const KernelModule module = module_of(checked, "lagrange", "momentum");
    for (const auto& [name, value] : values.fibre) inputs[name] = value;
    if (values.fibre.empty()) return {};
    std::vector<long double> momenta = dense(module, kernel_named(module, "momentum"), inputs);
    if (!std::ranges::all_of(momenta, [](long double mu) { return std::isfinite(mu); }))
        throw MathematicsError(
            "error: the momenta dL/dy of the start are no finite numbers\nhint: L is not defined, or "
            "not smooth, at the initial values");
    return momenta;
}

} // namespace

std::vector<long double> start_state(const CheckedModel& checked, const KernelModule& module, const SceneValues& values)
{
    Values inputs;
    std::vector<long double> state;
    for (const auto& [name, value] : values.parameters) inputs[name] = value;
    for (const auto& [name, value] : values.base) {
        inputs[name] = value;
        state.push_back(value);
    }
    inputs["t"] = values.start;
    const auto append = [&](const std::vector<long double>& lanes) {
        state.insert(state.end(), lanes.begin(), lanes.end());
        return state;
    };
    std::vector<long double> given;
    for (const auto& [name, value] : values.momenta.empty() ? values.fibre : values.momenta) given.push_back(value);
    const bool has_momenta = !values.momenta.empty();
    if (module.form == "lagrange") return append(has_momenta ? velocities_of(checked, values, inputs) : given);
    if (has_momenta || given.empty()) return append(given);
    if (module.form == "pontryagin") throw InternalError("a scene in Pontryagin's form without momenta");
    return append(momenta_of(checked, values, inputs));
}

} // namespace lagen
