// SPDX-License-Identifier: GPL-2.0-or-later
/// The interpreter over the rationals: exact, or no answer.
#include "graph/core/evaluate.hpp"
#include "graph/core/sweep.hpp"

namespace lagen {
namespace {

/// Larger numbers than this are no answer either: repeated squaring doubles the digits with every node.
constexpr std::size_t most_bits = std::size_t{1} << 20U;

struct ExactField : Arithmetic<Rational> {
    const std::map<std::string, Rational>& inputs;

    explicit ExactField(const std::map<std::string, Rational>& values) : inputs(values) {}

    bool leaf(const Graph& graph, NodeId id, Rational& value) const
    {
        if (graph.op(id) == Op::pi) return false;
        value = graph.is_constant(id) ? graph.value(id) : input_value(graph, id, inputs);
        return true;
    }

    bool operation(Op op, std::uint32_t payload, const Rational* x, Rational& value) const
    {
        auto result = exact_value(op, x, payload, most_bits);
        if (!result || bits_of(*result) > most_bits) return false;
        value = std::move(*result);
        return true;
    }
};

} // namespace

std::vector<Rational> evaluate_exactly(const Graph& graph, std::span<const NodeId> outputs,
                                       const std::map<std::string, Rational>& inputs)
{
    Sweep interpreter(graph, ExactField(inputs));
    if (!interpreter.visit(reachable(graph, outputs))) return {};
    std::vector<Rational> result;
    for (const NodeId id : outputs) result.push_back(interpreter.value(id));
    return result;
}

} // namespace lagen
