// SPDX-License-Identifier: GPL-2.0-or-later
#include "graph/elimination/eliminate_pair.hpp"

#include <utility>

namespace lagen {
namespace {

/// Symmetric, of order 2.
struct Symmetric {
    NodeId uu = 0;
    NodeId uw = 0;
    NodeId ww = 0;
};

bool is_multiple_of_one(const Graph& graph, const Symmetric& H)
{
    return H.uu == H.ww && graph.is_zero(H.uw);
}

/// The ways to read +-`id` as a product f g.
std::vector<std::pair<NodeId, NodeId>> products_of(Graph& graph, NodeId id)
{
    if (graph.op(id) == Op::negate) id = graph.operands(id)[0];
    const NodeId one = graph.constant(1);
    if (graph.op(id) != Op::multiply) return {{one, id}};
    const std::span<const NodeId> operands = graph.operands(id);
    return {{operands[0], operands[1]}, {operands[1], operands[0]}};
}

/// Are these cos x and sin x, in any order?
bool make_a_circle(const Graph& graph, NodeId a, NodeId b)
{
    const bool both =
        (graph.op(a) == Op::cos && graph.op(b) == Op::sin) || (graph.op(a) == Op::sin && graph.op(b) == Op::cos);
    return both && graph.operands(a)[0] == graph.operands(b)[0];
}

/// a^2 + b^2; f^2 for (f cos x, f sin x) in any order and with any signs.
NodeId sum_of_squares(Graph& graph, NodeId a, NodeId b)
{
    for (const auto& [f, cosine] : products_of(graph, a))
        for (const auto& [g, sine] : products_of(graph, b))
            if (f == g && make_a_circle(graph, cosine, sine)) return graph.multiply(f, f);
    return graph.add(graph.multiply(a, a), graph.multiply(b, b));
}

/// (a, b) H (a, b)^T.
NodeId product(Graph& graph, const Symmetric& H, NodeId a, NodeId b)
{
    if (is_multiple_of_one(graph, H)) return graph.multiply(H.uu, sum_of_squares(graph, a, b));
    const NodeId first = graph.multiply(H.uu, graph.multiply(a, a));
    const NodeId second = graph.multiply(H.ww, graph.multiply(b, b));
    const NodeId mixed = graph.multiply(graph.multiply(graph.constant(2), H.uw), graph.multiply(a, b));
    return graph.add(graph.add(first, second), mixed);
}

NodeId determinant_of(Graph& graph, const Symmetric& H)
{
    return graph.subtract(graph.multiply(H.uu, H.ww), graph.multiply(H.uw, H.uw));
}

/// det (H + n), for H = h 1 as h (h + the weight of n times n^T n).
NodeId determinant_of(Graph& graph, const Symmetric& H, const WeightedSquare& n)
{
    if (is_multiple_of_one(graph, H)) {
        const NodeId size = sum_of_squares(graph, n.first, n.second);
        return graph.multiply(H.uu, graph.add(H.uu, weigh(graph, n, size)));
    }
    const Symmetric adjugate{H.ww, graph.negate(H.uw), H.uu};
    return graph.add(determinant_of(graph, H), weigh(graph, n, product(graph, adjugate, n.first, n.second)));
}

} // namespace

NodeId weigh(Graph& graph, const WeightedSquare& square, NodeId value)
{
    return graph.multiply(graph.multiply(square.numerator, value), square.reciprocal);
}

PairPivot pivot_of(Graph& graph, const PairMatrix& matrix, NodeId e1, NodeId e2)
{
    const Symmetric H{matrix.uu, matrix.uw, matrix.ww};
    PairPivot pivot;
    pivot.pushes = {graph.add(graph.multiply(H.uu, e1), graph.multiply(H.uw, e2)),
                    graph.add(graph.multiply(H.uw, e1), graph.multiply(H.ww, e2))};
    pivot.value = product(graph, H, e1, e2);
    if (!matrix.square) {
        pivot.determinant = determinant_of(graph, H);
        return pivot;
    }
    const WeightedSquare& n = *matrix.square;
    pivot.determinant = determinant_of(graph, H, n);
    const NodeId along = graph.add(graph.multiply(n.first, e1), graph.multiply(n.second, e2));
    const NodeId scaled = graph.multiply(along, n.numerator);
    pivot.value = graph.add(pivot.value, graph.multiply(graph.multiply(scaled, along), n.reciprocal));
    const NodeId push = graph.multiply(scaled, n.reciprocal);
    pivot.pushes[0] = graph.add(pivot.pushes[0], graph.multiply(n.first, push));
    pivot.pushes[1] = graph.add(pivot.pushes[1], graph.multiply(n.second, push));
    return pivot;
}

void add_to(Graph& graph, LinearForm::Sum& sum, std::size_t variable, NodeId coefficient)
{
    const auto [place, fresh] = sum.try_emplace(variable, coefficient);
    if (!fresh) place->second = graph.add(place->second, coefficient);
}

std::map<std::size_t, LinearForm> forms_of(Graph& graph, const SparseHessian& hessian,
                                           const std::vector<std::size_t>& terms, std::size_t y)
{
    std::map<std::size_t, LinearForm> forms;
    for (std::size_t k = terms.size(); k-- > 0;) {
        LinearForm form{{}, graph.constant(0)};
        for (const auto& [operand, coefficient] : hessian.definitions[terms[k]]) {
            if (operand == y) {
                form.slope = graph.add(form.slope, coefficient);
            } else if (const auto inner = forms.find(operand); inner != forms.end()) {
                form.slope = graph.add(form.slope, graph.multiply(coefficient, inner->second.slope));
                for (const auto& [variable, factor] : inner->second.rest)
                    add_to(graph, form.rest, variable, graph.multiply(coefficient, factor));
            } else {
                add_to(graph, form.rest, operand, coefficient);
            }
        }
        forms.emplace(terms[k], std::move(form));
    }
    return forms;
}

} // namespace lagen
