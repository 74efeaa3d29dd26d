// SPDX-License-Identifier: GPL-2.0-or-later
/// sin(a - b) = sin a cos b - cos a sin b and cos(a - b) = cos a cos b + sin a sin b (and of a + b), where a and b
/// stand under a sine or cosine already: two calls of the library instead of three.
///
/// Accuracy. Near a = b the sine keeps its absolute error, of a rounding of its two products, but not its relative one:
/// what is computed is the sine at angles that are wrong in their last digit, no more than the state is anyway. Over
/// 10^6 seeded pairs, near a = b and a - b = pi/2 included, the error stays below 1.5 epsilon of 1 and below 2 epsilon
/// of |a| + |b| (tests/graph/add_angles_test.cpp). Sums, products and linear systems pass that on unharmed. A quotient
/// or a function may blow it up (1 / sin(a - b) for close neighbours, log(1 - cos(a - b))): below those the angle stays
/// whole.
#include "graph/calculus/differentiate.hpp"
#include "graph/core/operators.hpp"
#include "graph/simplify/form.hpp"

#include <map>

namespace lagen {
namespace {

constexpr NodeId none = static_cast<NodeId>(-1);

/// The nodes of the sine and cosine of one angle.
struct Pair {
    NodeId sine = none;
    NodeId cosine = none;
    bool exposed = false; ///< below a quotient or a function
};

using Pairs = std::map<NodeId, Pair>; ///< by angle

/// Does the k-th operand of `node` reach its value through sums, products and linear systems alone?
bool passes_errors_on(const Graph& graph, NodeId node, std::size_t k)
{
    switch (kind_of(graph.op(node))) {
    case OpKind::leaf:
    case OpKind::sum:
    case OpKind::product:
    case OpKind::system: return true;
    case OpKind::quotient: return k == 0;
    case OpKind::power: return domain_of(graph, node) == Sense::always;
    case OpKind::function:
    case OpKind::comparison:
    case OpKind::choice: break;
    }
    return false;
}

/// By node: is it an operand, at any depth, of a quotient or a function?
std::vector<bool> exposed_nodes(const Graph& graph, const std::vector<NodeId>& nodes)
{
    std::vector<bool> exposed(graph.size(), false);
    for (std::size_t k = nodes.size(); k-- > 0;) {
        const auto operands = graph.operands(nodes[k]);
        for (std::size_t i = 0; i < operands.size(); ++i)
            if (exposed[nodes[k]] || !passes_errors_on(graph, nodes[k], i)) exposed[operands[i]] = true;
    }
    return exposed;
}

Pairs pairs_of(const Graph& graph, const std::vector<NodeId>& nodes)
{
    const std::vector<bool> exposed = exposed_nodes(graph, nodes);
    Pairs pairs;
    for (const NodeId id : nodes) {
        if (graph.op(id) != Op::sin && graph.op(id) != Op::cos) continue;
        Pair& pair = pairs[graph.operands(id)[0]];
        (graph.op(id) == Op::sin ? pair.sine : pair.cosine) = id;
        pair.exposed = pair.exposed || exposed[id];
    }
    return pairs;
}

} // namespace

std::vector<NodeId> add_angles(Graph& graph, std::span<const NodeId> outputs)
{
    const Pairs pairs = pairs_of(graph, reachable(graph, outputs));
    std::map<NodeId, NodeId> replaced; // ascending, as substitute() wants: a + b before (a + b) + c
    const auto now = [&](Op op, NodeId angle) {
        const NodeId node = graph.apply(op, angle);
        const auto found = replaced.find(node);
        return found == replaced.end() ? node : found->second;
    };
    for (const auto& [angle, pair] : pairs) {
        const bool minus = graph.op(angle) == Op::subtract;
        if (pair.exposed || (!minus && graph.op(angle) != Op::add)) continue;
        const NodeId a = graph.operands(angle)[0];
        const NodeId b = graph.operands(angle)[1];
        if (!pairs.contains(a) || !pairs.contains(b)) continue;
        const NodeId sin_a = now(Op::sin, a);
        const NodeId cos_a = now(Op::cos, a);
        const NodeId sin_b = now(Op::sin, b);
        const NodeId cos_b = now(Op::cos, b);
        const NodeId sin_cos = graph.multiply(sin_a, cos_b);
        const NodeId cos_sin = graph.multiply(cos_a, sin_b);
        const NodeId cos_cos = graph.multiply(cos_a, cos_b);
        const NodeId sin_sin = graph.multiply(sin_a, sin_b);
        if (pair.sine != none)
            replaced[pair.sine] = minus ? graph.subtract(sin_cos, cos_sin) : graph.add(sin_cos, cos_sin);
        if (pair.cosine != none)
            replaced[pair.cosine] = minus ? graph.add(cos_cos, sin_sin) : graph.subtract(cos_cos, sin_sin);
    }
    const std::vector<std::pair<NodeId, NodeId>> replacements(replaced.begin(), replaced.end());
    return substitute(graph, outputs, replacements);
}

} // namespace lagen
