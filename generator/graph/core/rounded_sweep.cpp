// SPDX-License-Identifier: GPL-2.0-or-later
#include "graph/core/rounded_sweep.hpp"

#include "graph/core/sweep.hpp"

#include <algorithm>
#include <cstdlib>
#include <numbers>

namespace lagen {

namespace {

/// `round` follows every operation.
template <class Round>
struct RoundedField : Arithmetic<double> {
    const std::vector<double>& inputs; ///< in the order of graph.inputs()
    Round round;

    RoundedField(const std::vector<double>& values, Round round_to) : inputs(values), round(round_to) {}

    [[nodiscard]] double quotient(double a, double b) const { return round(a / b); }
    void subtract_product(double& a, double f, double b) const { a = round(a - round(f * b)); }

    bool leaf(const Graph& graph, NodeId id, double& value) const
    {
        if (graph.op(id) == Op::input)
            value = inputs[static_cast<std::size_t>(std::ranges::find(graph.inputs(), id) - graph.inputs().begin())];
        else
            value = round(graph.op(id) == Op::pi ? std::numbers::pi : graph.value(id).get_d());
        return true;
    }

    bool operation(Op op, std::uint32_t payload, const double* x, double& value) const
    {
        const auto n = static_cast<std::int32_t>(payload);
        value = op == Op::power ? power(x[0], n) : round(operator_of(op).value.in_double(x, n));
        return true;
    }

    /// By squaring, rounded as it goes: otherwise a power would be better than its product.
    [[nodiscard]] double power(double x, std::int32_t n) const
    {
        double result = 1;
        for (std::int64_t rest = std::abs(std::int64_t{n}); rest != 0; rest /= 2, x = round(x * x))
            if (rest % 2 != 0) result = round(result * x);
        return n < 0 ? round(1 / result) : result;
    }
};

template <class Round>
std::vector<double> sweep_with(const Graph& graph, const std::vector<NodeId>& nodes, const std::vector<double>& inputs,
                               Round round)
{
    Sweep walk(graph, RoundedField(inputs, round));
    walk.visit(nodes);
    return std::move(walk).values();
}

} // namespace

double to_24_bits(double x)
{
    const double scaled = x * 536870913.0; // 2^29 + 1
    return scaled - (scaled - x);
}

std::vector<double> sweep(const Graph& graph, const std::vector<NodeId>& nodes, const std::vector<double>& inputs,
                          bool rounded)
{
    if (rounded) return sweep_with(graph, nodes, inputs, [](double x) { return to_24_bits(x); });
    return sweep_with(graph, nodes, inputs, [](double x) { return x; });
}

} // namespace lagen
