// SPDX-License-Identifier: GPL-2.0-or-later
#include "../support/compiled.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/core/operators.hpp"
#include "graph/unknowns/tangent_size.hpp"
#include "hand_built.hpp"

#include <random>

using namespace lagen;
using namespace lagen::testing;

namespace {

/// Seeded values of every input; the diagonals a_ii of solve modules dominate.
std::vector<Point> points_of(const KernelModule& module, unsigned seed, std::size_t count)
{
    std::mt19937 random(seed);
    const auto next = [&] { return -1 + 2 * static_cast<double>(random()) / 4294967295.0; };
    std::vector<Point> points(count);
    for (Point& point : points)
        for (const NodeId input : module.graph->inputs()) {
            const std::string& name = module.graph->input_name(input);
            const bool diagonal = name.size() == 4 && name[0] == 'a' && name[1] == name[3];
            point[name] = diagonal ? 4 + next() : next() + (name == "l" || name == "m" ? 2 : 0);
        }
    return points;
}

CompiledCase sampled(KernelModule module, unsigned seed)
{
    std::vector<Point> points = points_of(module, seed, 3);
    return {std::move(module), std::move(points)};
}

/// Every operator once.
KernelModule operators_module()
{
    KernelModule module = empty_module("operators");
    Graph& g = *module.graph;
    module.parameters = {declare(g, "I"), declare(g, "y0")};
    module.parameter_defaults = {g.apply(Op::sqrt, g.constant(2)), g.divide(g.pi(), g.constant(3))};
    base_of(module) = {declare(g, "class"), declare(g, "θ"), declare(g, "energy")};
    const NodeId a = base_of(module)[0].input;
    const NodeId b = base_of(module)[1].input;
    const NodeId c = g.add(g.power(base_of(module)[2].input, 2), g.constant(Rational(1, 10)));
    std::vector<NodeId> values;
    for (const Operator& row : operator_table()) {
        if (row.kind != OpKind::function || row.arity != 1 || row.op == Op::stumpff) continue;
        const bool bounded = row.op == Op::asin || row.op == Op::acos;
        const bool positive = row.op == Op::log || row.op == Op::sqrt;
        values.push_back(g.apply(row.op, positive ? c : bounded ? g.divide(a, g.constant(2)) : a));
    }
    values.push_back(g.apply(Op::atan2, a, b));
    values.push_back(g.stumpff(3, g.subtract(g.multiply(g.constant(9), a), b)));
    for (const unsigned k : {4U, 1U, 2U}) values.push_back(g.stumpff(k, g.multiply(a, b)));
    values.push_back(g.apply(Op::real_power, c, a));
    values.push_back(g.apply(Op::real_power, c, g.constant(Rational(-5, 2))));
    for (const int exponent : {-7, -3, -1, 4, 5, 13, 64}) values.push_back(g.power(c, exponent));
    values.push_back(g.apply(Op::minimum, a, b));
    values.push_back(g.apply(Op::maximum, a, g.multiply(b, c)));
    for (const Operator& row : operator_table())
        if (row.kind == OpKind::comparison)
            values.push_back(g.select(g.apply(row.op, a, b), c, g.apply(row.op, a, g.constant(0))));
    values.push_back(g.multiply(g.pi(), g.subtract(a, g.multiply(g.constant(Rational(-1, 7)), g.subtract(b, c)))));
    values.push_back(g.subtract(module.parameters[0].input, g.multiply(module.parameters[1].input, module.time)));
    module.kernels = {vector_kernel(module, "values_of", values),
                      scalar_kernel(module, "energy", g.negate(g.multiply(g.negate(a), c)))};
    return module;
}

/// Operations that come in batches: angles of two levels, roots and reciprocals.
KernelModule batches_module()
{
    KernelModule module = empty_module("batches");
    Graph& g = *module.graph;
    for (const char* name : {"x", "y", "z", "sines", "roots"}) base_of(module).push_back(declare(g, name));
    std::vector<NodeId> values;
    std::vector<NodeId> sums;
    for (std::size_t k = 0; k < base_of(module).size(); ++k) {
        const NodeId x = base_of(module)[k].input;
        const NodeId y = base_of(module)[(k + 1) % base_of(module).size()].input;
        const NodeId inner = g.add(g.apply(Op::sin, x), g.apply(Op::cos, g.multiply(g.constant(100), y)));
        const NodeId square = g.add(g.power(x, 2), g.add(g.power(y, 2), g.constant(Rational(1, 100))));
        const NodeId cube = g.divide(g.constant(1), g.multiply(square, g.apply(Op::sqrt, square)));
        values.push_back(g.multiply(cube, g.apply(Op::cos, inner)));
        sums.push_back(g.add(cube, g.apply(Op::sin, inner)));
    }
    values.push_back(g.apply(Op::sqrt, g.power(g.sum(sums), 2)));
    module.kernels = {vector_kernel(module, "values_of", values), scalar_kernel(module, "total", g.sum(sums))};
    return module;
}

/// A Jacobian by columns, more of them than a register has lanes for: of choices (one of them constant), of systems
/// that are solved in each of the three ways, one of whose right sides stands still, and a row without entries.
KernelModule columns_module()
{
    KernelModule module = empty_module("columns_of");
    Graph& g = *module.graph;
    module.parameters = {declare(g, "p")};
    module.parameter_defaults = {g.constant(2)};
    std::vector<NodeId> x;
    for (int k = 0; k < 9; ++k) {
        base_of(module).push_back(declare(g, "x" + std::to_string(k)));
        x.push_back(base_of(module).back().input);
    }
    const NodeId p = module.parameters[0].input;
    const auto shifted = [&](NodeId a) { return g.add(g.constant(4), a); };
    std::vector<NodeId> rates{x[1], g.constant(3),
                              g.apply(Op::maximum, x[0], g.divide(x[6], g.add(p, g.power(x[1], 2)))),
                              g.select(g.apply(Op::less, x[0], x[2]), g.multiply(p, g.power(x[3], 2)), g.constant(1)),
                              g.select(g.apply(Op::less, x[0], x[2]), g.multiply(g.apply(Op::sin, x[3]), x[4]), x[5])};
    const std::vector<NodeId> matrix{shifted(x[0]), x[1], x[2], x[1], shifted(x[3]), p, x[2], p, shifted(x[4])};
    for (const auto structure : {MatrixStructure::general, MatrixStructure::positive_definite})
        rates.push_back(
            g.sum(g.solve(matrix, std::vector<NodeId>{x[5], g.constant(1), g.multiply(x[5], x[6])}, structure)));
    const std::vector<NodeId> pair{shifted(x[7]), p, p, shifted(x[8])};
    const std::vector<NodeId> two =
        g.solve(pair, std::vector<NodeId>{p, g.multiply(x[7], rates[4])}, MatrixStructure::general);
    rates.insert(rates.end(), two.begin(), two.end());
    const std::vector<NodeId> constant{p, g.constant(1), g.pi(),    g.constant(1), shifted(p), p,
                                       p, g.constant(2), shifted(p)};
    rates.push_back(
        g.sum(g.solve(constant, std::vector<NodeId>{g.multiply(g.pi(), x[8]), p, p}, MatrixStructure::general)));

    std::vector<std::pair<NodeId, NodeId>> seeds;
    std::vector<NodeId> directions;
    for (const NodeId lane : x) {
        directions.push_back(g.input("tangent of " + g.input_name(lane)));
        seeds.emplace_back(lane, directions.back());
    }
    const std::vector<NodeId> tangents = directional(g, rates, seeds);
    const InputSets sets(g, tangents, directions);
    Kernel kernel{
        .name = "jacobian", .inputs = point_inputs(module), .outputs = {{"values", {2, rates.size(), 9}, {}}}};
    kernel.outputs[0].sparse = true;
    for (std::size_t row = 0; row < rates.size(); ++row)
        for (std::size_t column = 0; column < 9; ++column)
            if (sets.holds(tangents[row], column)) kernel.outputs[0].entries.push_back({row, column, tangents[row]});
    kernel.directions = std::move(directions);
    module.kernels = {std::move(kernel)};
    return module;
}

std::vector<CompiledCase> all_cases()
{
    const std::vector<std::vector<bool>> arrow{
        {true, true, true, true}, {true, true, false, false}, {true, false, true, false}, {true, false, false, true}};
    const auto full = [](std::size_t n) { return std::vector<std::vector<bool>>(n, std::vector<bool>(n, true)); };
    return {sampled(product_module(), 1),
            sampled(pendulum_module(), 2),
            sampled(operators_module(), 3),
            sampled(batches_module(), 9),
            sampled(columns_module(), 10),
            sampled(solve_module("arrowhead", arrow, MatrixStructure::positive_definite), 4),
            sampled(solve_module("definite", full(5), MatrixStructure::positive_definite), 5),
            sampled(solve_module("pivoted", full(4), MatrixStructure::general), 6),
            sampled(solve_module("pivoted_symmetric", full(3), MatrixStructure::symmetric), 7),
            sampled(solve_module("closed_form", full(2), MatrixStructure::positive_definite), 8)};
}

} // namespace

TEST_CASE("g++ compiles generated headers without a warning and they agree with the interpreter", "[emit][compile]")
{
    compare_compiled("emit", "g++", all_cases(), 200);
}

TEST_CASE("clang++ compiles generated headers without a warning and they agree with the interpreter", "[emit][compile]")
{
    if (run_shell("clang++ --version").status != 0) {
        WARN("no clang++ on this machine");
        return;
    }
    compare_compiled("emit", "clang++", all_cases(), 200);
}
