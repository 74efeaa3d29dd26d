// SPDX-License-Identifier: GPL-2.0-or-later
#include "kernels/constrained_kernels.hpp"

#include "graph/calculus/differentiate.hpp"
#include "graph/unknowns/tangent_size.hpp"

namespace lagen {

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
