// SPDX-License-Identifier: GPL-2.0-or-later
/// Kernel modules built without a model, for the tests of the header printer.
#pragma once

#include "graph/kernel.hpp"

namespace lagen::testing {

inline Quantity declare(Graph& graph, const std::string& name, const std::string& text = {},
                        const std::string& unit = {})
{
    return {name, text, unit, graph.input(name)};
}

/// An empty module with time.
inline KernelModule empty_module(const std::string& name)
{
    KernelModule module;
    module.name = module.model = name;
    module.form = "lagrange";
    module.hash = "0123456789abcdef";
    module.regenerate = "lagen generate " + name + ".toml";
    module.graph = std::make_shared<Graph>();
    module.time = module.graph->input("t");
    module.groups = {{"Base", "base", "Base coordinates, the first lanes of State.", {}},
                     {"Fibre", "fibre", "The other lanes of State.", {}}};
    return module;
}

inline std::vector<Quantity>& base_of(KernelModule& module)
{
    return module.groups[0].lanes;
}

inline std::vector<Quantity>& fibre_of(KernelModule& module)
{
    return module.groups[1].lanes;
}

/// A kernel at (t, s) of one output.
inline Kernel scalar_kernel(const KernelModule& module, const std::string& name, NodeId value)
{
    return {.name = name, .inputs = point_inputs(module), .outputs = {{name, {}, {{0, 0, value}}}}};
}

inline Kernel vector_kernel(const KernelModule& module, const std::string& name, const std::vector<NodeId>& values)
{
    KernelOutput output{name, {1, values.size(), 1}, {}};
    for (std::size_t k = 0; k < values.size(); ++k) output.entries.push_back({k, 0, values[k]});
    return {.name = name, .inputs = point_inputs(module), .outputs = {output}};
}

/// A right-hand side: it answers a status.
inline Kernel rate_kernel(const KernelModule& module, const std::string& name, const std::vector<NodeId>& rates)
{
    Kernel kernel = vector_kernel(module, name, rates);
    kernel.outputs[0].name = "ds";
    kernel.outputs[0].role = ArrayRole::tangent;
    kernel.checks.emplace();
    return kernel;
}

/// sin(x) y: no mechanics at all.
inline KernelModule product_module()
{
    KernelModule module = empty_module("product");
    Graph& graph = *module.graph;
    module.title = "Sine times y";
    base_of(module) = {declare(graph, "x"), declare(graph, "y")};
    module.kernels = {scalar_kernel(
        module, "f", graph.multiply(graph.apply(Op::sin, base_of(module)[0].input), base_of(module)[1].input))};
    return module;
}

/// A pendulum by hand: thdd = -(g / l) sin(th), with a divisor made of parameters and both functions of one angle.
inline KernelModule pendulum_module()
{
    KernelModule module = empty_module("pendulum");
    Graph& graph = *module.graph;
    module.title = "Planar pendulum";
    module.equations = {"θ̇ = v", "m l² v̇ = −m g l sin θ"};
    module.parameters = {declare(graph, "m", "mass", "kg"), declare(graph, "l", "length", "m"),
                         declare(graph, "g", "gravity", "m/s^2")};
    module.parameter_defaults = {graph.constant(1), graph.constant(Rational(1, 2)), graph.constant(Rational(981, 100))};
    base_of(module) = {declare(graph, "th", "angle from the lowest point", "rad")};
    fibre_of(module) = {declare(graph, "v", "angular velocity", "rad/s")};
    const NodeId m = module.parameters[0].input;
    const NodeId l = module.parameters[1].input;
    const NodeId g = module.parameters[2].input;
    const NodeId th = base_of(module)[0].input;
    const NodeId v = fibre_of(module)[0].input;
    const NodeId inertia = graph.multiply(m, graph.power(l, 2));
    const NodeId weight = graph.multiply(graph.multiply(m, g), l);
    const NodeId torque = graph.negate(graph.multiply(weight, graph.apply(Op::sin, th)));
    Kernel rhs = rate_kernel(module, "rhs", {v, graph.divide(torque, inertia)});
    rhs.documentation = {"The equations of motion, ds = (thdot, vdot)."};
    rhs.checks->pivots = {inertia};
    const NodeId kinetic = graph.divide(graph.multiply(inertia, graph.power(v, 2)), graph.constant(2));
    const NodeId potential = graph.negate(graph.multiply(weight, graph.apply(Op::cos, th)));
    module.kernels = {rhs, scalar_kernel(module, "energy", graph.add(kinetic, potential))};
    Kernel tip = vector_kernel(
        module, "tip", {graph.multiply(l, graph.apply(Op::sin, th)), graph.multiply(l, graph.apply(Op::cos, th))});
    tip.outputs[0].entry_names = {"tip x", "tip y"};
    module.kernels.push_back(tip);
    return module;
}

/// z = A^-1 b for an n x n matrix of state lanes a_ij (symmetric: lower triangle) and b_i, as a right-hand side of the
/// n lanes b; the others stand still. Entries where `pattern` is false are zero.
inline KernelModule solve_module(const std::string& name, const std::vector<std::vector<bool>>& pattern,
                                 MatrixStructure structure)
{
    KernelModule module = empty_module(name);
    Graph& graph = *module.graph;
    const std::size_t n = pattern.size();
    std::vector<NodeId> matrix(n * n, graph.constant(0));
    std::vector<NodeId> right(n);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) {
            const bool mirrored = structure != MatrixStructure::general && j > i;
            if (mirrored || !pattern[i][j]) continue;
            base_of(module).push_back(declare(graph, "a" + std::to_string(i) + "_" + std::to_string(j)));
            matrix[i * n + j] = base_of(module).back().input;
            if (structure != MatrixStructure::general) matrix[j * n + i] = base_of(module).back().input;
        }
    for (std::size_t i = 0; i < n; ++i) {
        fibre_of(module).push_back(declare(graph, "b" + std::to_string(i)));
        right[i] = fibre_of(module).back().input;
    }
    const std::vector<NodeId> z = graph.solve(matrix, right, structure);
    std::vector<NodeId> lanes(base_of(module).size(), graph.constant(0));
    lanes.insert(lanes.end(), z.begin(), z.end());
    module.kernels = {rate_kernel(module, "rhs", lanes)};
    return module;
}

} // namespace lagen::testing
