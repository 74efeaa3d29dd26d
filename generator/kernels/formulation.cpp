// SPDX-License-Identifier: GPL-2.0-or-later
#include "kernels/formulation.hpp"

#include "graph/calculus/differentiate.hpp"
#include "graph/unknowns/tangent_size.hpp"
#include "kernels/kernel_table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

Formulation formulation(Graph& graph, const Model& model, const System& system, const Report& report, FormKind kind,
                        const FormulationRequest& request)
{
    switch (kind) {
    case FormKind::lagrange: return lagrange_form(graph, system, report, request);
    case FormKind::hamilton: return hamilton_form(graph, system, report, request);
    case FormKind::pontryagin: return pontryagin_form(graph, model, system, report, request);
    case FormKind::discrete: return discrete_form(graph, model, system, report, request);
    case FormKind::first_order: return first_order_form(graph, system, request);
    }
    throw InternalError("a form without kernels");
}

Formulation first_order_form(Graph& graph, const System& system, const FormulationRequest& request)
{
    if (system.rates.empty())
        throw MathematicsError("model '" + system.name + "' has no [rates]; the form of first order needs them",
                               "[algebroid] kind = \"first_order\"");
    Formulation form = empty_form(system, FormKind::first_order, {}, request);
    form.derivative = system.rates;
    form.documentation = {"The rates of the model, ds = xdot(t, s). s and ds may be the same object."};
    bind_system(graph, system, form);
    append_state_rates(graph, system, form);
    return form;
}

Formulation empty_form(const System& system, FormKind form, std::vector<NodeId> lanes,
                       const FormulationRequest& request)
{
    Formulation result;
    result.form = &entry_of(form);
    result.time = system.time;
    result.parameters = system.parameters;
    result.x = system.algebroid.x;
    result.lanes = std::move(lanes);
    result.inputs = system.inputs;
    result.given_inputs = request.inputs;
    for (const std::size_t k : request.states) result.states.push_back(system.states[k]);
    return result;
}

void set_motion(Graph& graph, const System& system, const PhaseSystem& phase, Formulation& form)
{
    form.derivative = phase.xdot;
    form.derivative.insert(form.derivative.end(), phase.mudot.begin(), phase.mudot.end());
    form.binding = phase_names(system, phase, phase.hamiltonian);
    bind_system(graph, system, form);
    append_state_rates(graph, system, form);
}

void append_state_rates(Graph& graph, const System& system, Formulation& form)
{
    Lowering lower(graph, form.binding);
    for (const NodeId state : form.states) {
        const auto place = std::ranges::find(system.states, state) - system.states.begin();
        form.derivative.push_back(lower(system.written.states[static_cast<std::size_t>(place)].value));
    }
}

void bind_system(Graph& graph, const System& system, Formulation& form)
{
    form.binding["t"] = system.time;
    for (const std::vector<NodeId>* inputs : {&system.parameters, &system.algebroid.x, &system.states, &system.inputs})
        for (const NodeId input : *inputs) form.binding[system.graph.input_name(input)] = input;
    Lowering lower(graph, form.binding);
    for (const NamedTree& input : form.given_inputs) form.binding[input.name] = lower(input.value);
}

MatrixStructure mass_structure(const Regularity& regularity)
{
    return regularity.positive_definite && !regularity.for_given_parameters ? MatrixStructure::positive_definite
                                                                            : MatrixStructure::symmetric;
}

void require_regular_lagrangian(const System& system, const Regularity& regularity, const char* form)
{
    if (!system.lagrangian)
        throw MathematicsError(fmt::format("model '{}' has no Lagrangian; the {} form needs [lagrangian] L{}",
                                           system.name, form,
                                           form == std::string("Hamiltonian") ? " or [hamiltonian] H" : ""));
    if (regularity.kind == Regularity::Kind::degenerate)
        throw MathematicsError(
            fmt::format(
                "the Lagrangian of model '{}' is degenerate{}: d2L/dy2 has rank {}, and the {} form needs rank {}",
                system.name, system.distribution ? " on the constraint" : "", regularity.rank, form,
                system.velocities().size()),
            regularity.rank == 0 && !system.distribution
                ? "L is linear in the velocities, so its equations are of first order: solve them for x' = X(t, x) and "
                  "run [hamiltonian] H = \"p.X\" in the place of L (docs/mechanics.md, Any first-order system)"
                : "the velocities cannot be solved for; give every fibre coordinate a kinetic term");
}

std::vector<NodeId> single_blocks(const Graph& graph, const std::vector<NodeId>& W, std::size_t r)
{
    std::vector<NodeId> pivots;
    for (std::size_t a = 0; a < r; ++a)
        for (std::size_t b = 0; b < r; ++b) {
            if (graph.is_zero(W[a * r + b])) continue;
            std::size_t others = 0;
            for (std::size_t k = 0; k < r; ++k) {
                if (k != b && !graph.is_zero(W[a * r + k])) ++others;
                if (k != a && !graph.is_zero(W[k * r + b])) ++others;
            }
            const NodeId pivot = W[a * r + b];
            if (others == 0 && !graph.is_constant(pivot) && std::ranges::find(pivots, pivot) == pivots.end())
                pivots.push_back(pivot);
        }
    return pivots;
}

KernelOutput column(std::string name, const std::vector<NodeId>& values)
{
    KernelOutput output{std::move(name), {1, values.size(), 1}, {}};
    for (std::size_t k = 0; k < values.size(); ++k) output.entries.push_back({k, 0, values[k]});
    return output;
}

KernelOutput matrix(const Graph& graph, std::string name, std::size_t rows, std::size_t columns,
                    const std::vector<NodeId>& values)
{
    KernelOutput output{std::move(name), {2, rows, columns}, {}};
    for (std::size_t k = 0; k < values.size(); ++k)
        if (!graph.is_zero(values[k])) output.entries.push_back({k / columns, k % columns, values[k]});
    return output;
}

KernelOutput entries_along(const Graph& graph, std::string name, const std::vector<NodeId>& rows,
                           const std::vector<NodeId>& directions)
{
    KernelOutput output{std::move(name), {2, rows.size(), directions.size()}, {}};
    const InputSets sets(graph, rows, directions);
    for (std::size_t row = 0; row < rows.size(); ++row)
        for (std::size_t column = 0; column < directions.size(); ++column)
            if (sets.holds(rows[row], column)) output.entries.push_back({row, column, rows[row]});
    return output;
}

std::vector<NodeId> state_of(const Formulation& form)
{
    std::vector<NodeId> lanes = form.x;
    lanes.insert(lanes.end(), form.lanes.begin(), form.lanes.end());
    lanes.insert(lanes.end(), form.states.begin(), form.states.end());
    return lanes;
}

Kernel table_kernel(const Formulation& form, const std::string& name, KernelOutput output)
{
    const KernelRow& row = kernel_row(name, form.form->kind);
    output.shape.rank = row.output.rank;
    output.role = row.output.role;
    output.sparse = row.output.sparse;
    Kernel kernel{.name = name, .inputs = {}, .outputs = {}};
    kernel.documentation = {fmt::format(fmt::runtime(row.documentation), output.shape.rows, output.shape.columns)};
    kernel.outputs.push_back(std::move(output));
    if (row.output.checked) kernel.checks.emplace();
    return kernel;
}

Kernel scalar_kernel(const Formulation& form, const std::string& name, NodeId value)
{
    return table_kernel(form, name, column("value", {value}));
}

Kernel hessian_kernel(Graph& graph, const Formulation& form, const std::string& name, const std::vector<NodeId>& first)
{
    const std::vector<NodeId> state = state_of(form);
    const std::vector<NodeId> hessian = joined_rows(jacobian_through(graph, first, state, form.implicit));
    return table_kernel(form, name, matrix(graph, "H", state.size(), state.size(), hessian));
}

namespace {

/// The rates of the lanes and of time along the motion.
Replacements rates_of(Graph& graph, const Formulation& form)
{
    Replacements seeds = replacements(form.x, form.derivative);
    for (std::size_t a = 0; a < form.lanes.size(); ++a)
        seeds.emplace_back(form.lanes[a], form.derivative[form.x.size() + a]);
    seeds.emplace_back(form.time, graph.constant(1));
    return seeds_through(graph, form.implicit, std::move(seeds));
}

Kernel checked_column(const Formulation& form, const char* name, const std::vector<NodeId>& values)
{
    Kernel kernel = table_kernel(form, name, column("out", values));
    kernel.checks->pivots = form.pivots;
    return kernel;
}

} // namespace

void add_minor(const Graph& graph, const System& system, Formulation& form)
{
    if (!system.distribution || !system.distribution->minor) return;
    const NodeId minor = *system.distribution->minor;
    if (!graph.is_constant(minor)) form.pivots.push_back(minor);
}

void add_constrained(Graph& graph, const System& system, const ConstrainedNodes& nodes, Formulation& form)
{
    const Replacements rates = rates_of(graph, form);
    const std::vector<NodeId> lambda = reaction(graph, system, nodes, rates);
    for (std::size_t a = 0; a < lambda.size(); ++a)
        form.binding["reaction." + system.graph.input_name(system.algebroid.y[a])] = lambda[a];
    form.kernels.push_back(table_kernel(form, "ambient_velocity", column("out", nodes.hull.Y)));
    form.kernels.push_back(checked_column(form, "reaction", lambda));
    form.kernels.back().checks->failures = form.failures;
    if (!nodes.hull.has_drift()) return;
    form.kernels.push_back(scalar_kernel(form, "moving_energy", moving_energy(graph, nodes)));
    const NodeId energy[] = {constrained_energy(graph, nodes)};
    const NodeId power = directional(graph, energy, rates)[0];
    if (graph.is_zero(power)) return;
    form.kernels.push_back(scalar_kernel(form, "power", power));
    form.kernels.back().documentation = {"dE/dt = Q_a Y^a + lambda_a b^a - dL/dt along the motion."};
}

} // namespace lagen
