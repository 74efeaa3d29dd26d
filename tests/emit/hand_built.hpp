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
    return module;
}

inline Kernel scalar_kernel(const std::string& name, NodeId value)
{
    Kernel kernel;
    kernel.name = name;
    kernel.output = {name, 1, 1, {{0, 0, value}}};
    return kernel;
}

inline Kernel vector_kernel(const std::string& name, const std::vector<NodeId>& values,
                            KernelShape shape = KernelShape::vector)
{
    Kernel kernel;
    kernel.name = name;
    kernel.shape = shape;
    kernel.output.name = shape == KernelShape::right_hand_side ? "ds" : name;
    kernel.output.rows = values.size();
    for (std::size_t k = 0; k < values.size(); ++k) kernel.output.entries.push_back({k, 0, values[k]});
    return kernel;
}

/// sin(x) y: no mechanics at all.
inline KernelModule product_module()
{
    KernelModule module = empty_module("product");
    Graph& graph = *module.graph;
    module.title = "Sine times y";
    module.base = {declare(graph, "x"), declare(graph, "y")};
    module.kernels = {
        scalar_kernel("f", graph.multiply(graph.apply(Op::sin, module.base[0].input), module.base[1].input))};
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
    module.base = {declare(graph, "th", "angle from the lowest point", "rad")};
    module.fibre = {declare(graph, "v", "angular velocity", "rad/s")};
    const NodeId m = module.parameters[0].input;
    const NodeId l = module.parameters[1].input;
    const NodeId g = module.parameters[2].input;
    const NodeId th = module.base[0].input;
    const NodeId v = module.fibre[0].input;
    const NodeId inertia = graph.multiply(m, graph.power(l, 2));
    const NodeId weight = graph.multiply(graph.multiply(m, g), l);
    const NodeId torque = graph.negate(graph.multiply(weight, graph.apply(Op::sin, th)));
    Kernel rhs = vector_kernel("rhs", {v, graph.divide(torque, inertia)}, KernelShape::right_hand_side);
    rhs.documentation = {"The equations of motion, ds = (thdot, vdot)."};
    rhs.pivots = {inertia};
    const NodeId kinetic = graph.divide(graph.multiply(inertia, graph.power(v, 2)), graph.constant(2));
    const NodeId potential = graph.negate(graph.multiply(weight, graph.apply(Op::cos, th)));
    module.kernels = {rhs, scalar_kernel("energy", graph.add(kinetic, potential))};
    Kernel tip = vector_kernel(
        "tip", {graph.multiply(l, graph.apply(Op::sin, th)), graph.multiply(l, graph.apply(Op::cos, th))});
    tip.entry_names = {"tip x", "tip y"};
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
            module.base.push_back(declare(graph, "a" + std::to_string(i) + "_" + std::to_string(j)));
            matrix[i * n + j] = module.base.back().input;
            if (structure != MatrixStructure::general) matrix[j * n + i] = module.base.back().input;
        }
    for (std::size_t i = 0; i < n; ++i) {
        module.fibre.push_back(declare(graph, "b" + std::to_string(i)));
        right[i] = module.fibre.back().input;
    }
    const std::vector<NodeId> z = graph.solve(matrix, right, structure);
    std::vector<NodeId> lanes(module.base.size(), graph.constant(0));
    lanes.insert(lanes.end(), z.begin(), z.end());
    module.kernels = {vector_kernel("rhs", lanes, KernelShape::right_hand_side)};
    return module;
}

} // namespace lagen::testing
