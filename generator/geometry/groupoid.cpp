// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry/groupoid.hpp"

#include "graph/calculus/differentiate.hpp"

namespace lagen {

namespace {

void append_nodes(std::vector<NodeId>& list, const std::vector<NodeId>& more)
{
    list.insert(list.end(), more.begin(), more.end());
}

/// The invariant fields, section by section.
class InvariantFields {
  public:
    InvariantFields(Graph& graph, const Groupoid& groupoid)
        : graph_(graph), groupoid_(groupoid), next_(groupoid.n()), W_(next_ + groupoid.arrow.next.size())
    {
        for (const std::vector<NodeId>& E : groupoid.generators) {
            WE_.push_back(matrix_product(graph, groupoid.arrow.W, E, groupoid.size));
            EW_.push_back(matrix_product(graph, E, groupoid.arrow.W, groupoid.size));
        }
    }

    /// (0, d_i, -A_i^c(x_next) W E_c) and (-d_i, 0, -A_i^c(x) E_c W)
    [[nodiscard]] std::pair<VectorField, VectorField> horizontal(std::size_t i)
    {
        VectorField left{{next_ + i, graph_.constant(1)}}, right{{i, graph_.constant(-1)}};
        if (groupoid_.connection.empty()) return {left, right};
        const std::vector<NodeId>& here = groupoid_.connection[i];
        std::vector<std::pair<NodeId, NodeId>> moved;
        for (std::size_t k = 0; k < groupoid_.n(); ++k)
            moved.emplace_back(groupoid_.arrow.x[k], groupoid_.arrow.next[k]);
        append_combination(left, substitute(graph_, here, moved), WE_);
        append_combination(right, here, EW_);
        return {left, right};
    }

    /// (0, 0, W E_c) and (-rho_c(x), 0, E_c W)
    [[nodiscard]] std::pair<VectorField, VectorField> vertical(std::size_t c)
    {
        VectorField left, right;
        append_matrix(left, WE_[c]);
        if (!groupoid_.action.empty()) {
            const std::vector<NodeId> rho = moved_by(groupoid_.generators[c]);
            for (std::size_t i = 0; i < rho.size(); ++i)
                if (!graph_.is_zero(rho[i])) right.push_back({i, graph_.negate(rho[i])});
        }
        append_matrix(right, EW_[c]);
        return {left, right};
    }

  private:
    /// d/ds x.(1 + s E) at s = 0
    [[nodiscard]] std::vector<NodeId> moved_by(const std::vector<NodeId>& E)
    {
        std::vector<std::pair<NodeId, NodeId>> seeds, one;
        const std::vector<NodeId> unit = matrix_one(graph_, groupoid_.size);
        for (std::size_t k = 0; k < E.size(); ++k) {
            seeds.emplace_back(groupoid_.arrow.W[k], E[k]);
            one.emplace_back(groupoid_.arrow.W[k], unit[k]);
        }
        return substitute(graph_, directional(graph_, groupoid_.action, seeds), one);
    }

    void append_matrix(VectorField& field, const std::vector<NodeId>& matrix) const
    {
        for (std::size_t k = 0; k < matrix.size(); ++k)
            if (!graph_.is_zero(matrix[k])) field.push_back({W_ + k, matrix[k]});
    }

    /// -A^c M_c
    void append_combination(VectorField& field, const std::vector<NodeId>& A,
                            const std::vector<std::vector<NodeId>>& matrices)
    {
        std::vector<NodeId> sum(groupoid_.arrow.W.size(), graph_.constant(0));
        for (std::size_t c = 0; c < A.size(); ++c)
            for (std::size_t k = 0; k < sum.size(); ++k)
                sum[k] = graph_.subtract(sum[k], graph_.multiply(A[c], matrices[c][k]));
        append_matrix(field, sum);
    }

    Graph& graph_;
    const Groupoid& groupoid_;
    std::size_t next_, W_; ///< where these coordinates start
    std::vector<std::vector<NodeId>> WE_, EW_;
};

} // namespace

std::vector<NodeId> Groupoid::coordinates() const
{
    std::vector<NodeId> all = arrow.x;
    append_nodes(all, arrow.next);
    append_nodes(all, arrow.W);
    return all;
}

Groupoid make_groupoid(Graph& graph, GroupoidParts parts)
{
    Groupoid groupoid;
    static_cast<GroupoidParts&>(groupoid) = std::move(parts);
    InvariantFields fields(graph, groupoid);
    const auto add = [&](std::pair<VectorField, VectorField> both) {
        groupoid.left.push_back(std::move(both.first));
        groupoid.right.push_back(std::move(both.second));
    };
    for (std::size_t i = 0; i < groupoid.horizontal(); ++i) add(fields.horizontal(i));
    for (std::size_t c = 0; c < groupoid.generators.size(); ++c) add(fields.vertical(c));
    return groupoid;
}

std::vector<NodeId> source(const Arrow& g)
{
    return g.x;
}

std::vector<NodeId> target(Graph& graph, const Groupoid& groupoid, const Arrow& g)
{
    if (!g.next.empty()) return g.next;
    return groupoid.action.empty() ? g.x : at(graph, groupoid, groupoid.action, g);
}

Arrow product(Graph& graph, const Groupoid& groupoid, const Arrow& g, const Arrow& h)
{
    return {g.x, h.next, matrix_product(graph, g.W, h.W, groupoid.size)};
}

Arrow identity(Graph& graph, const Groupoid& groupoid, const std::vector<NodeId>& x)
{
    return {x, groupoid.arrow.next.empty() ? std::vector<NodeId>{} : x, matrix_one(graph, groupoid.size)};
}

Arrow inverse(Graph& graph, const Groupoid& groupoid, const Arrow& g)
{
    const std::vector<NodeId> one = matrix_one(graph, groupoid.size);
    return {target(graph, groupoid, g), g.next.empty() ? std::vector<NodeId>{} : g.x,
            matrix_quotient(graph, g.W, one, groupoid.size)};
}

std::vector<NodeId> at(Graph& graph, const Groupoid& groupoid, std::span<const NodeId> functions, const Arrow& g)
{
    const std::vector<NodeId> coordinates = groupoid.coordinates();
    std::vector<NodeId> values = g.x;
    append_nodes(values, g.next);
    append_nodes(values, g.W);
    std::vector<std::pair<NodeId, NodeId>> replacements;
    for (std::size_t k = 0; k < coordinates.size(); ++k) replacements.emplace_back(coordinates[k], values[k]);
    return substitute(graph, functions, replacements);
}

std::vector<NodeId> matrix_product(Graph& graph, const std::vector<NodeId>& a, const std::vector<NodeId>& b,
                                   std::size_t n)
{
    std::vector<NodeId> out(n * n, graph.constant(0));
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < n; ++k)
            for (std::size_t j = 0; j < n && !graph.is_zero(a[i * n + k]); ++j)
                if (!graph.is_zero(b[k * n + j]))
                    out[i * n + j] = graph.add(out[i * n + j], graph.multiply(a[i * n + k], b[k * n + j]));
    return out;
}

std::vector<std::pair<NodeId, NodeId>> constant_entries(Graph& graph, const GroupoidParts& parts,
                                                        const std::vector<NodeId>& W)
{
    const std::size_t n = parts.size;
    std::vector<bool> reached(n * n, false); // by products of any length: the closure of the entries that occur
    for (const std::vector<NodeId>& E : parts.generators)
        for (std::size_t k = 0; k < n * n; ++k)
            if (!graph.is_zero(E[k])) reached[k] = true;
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n && reached[i * n + k]; ++j)
                if (reached[k * n + j]) reached[i * n + j] = true;
    std::vector<std::pair<NodeId, NodeId>> constant;
    for (std::size_t k = 0; k < W.size(); ++k)
        if (!reached[k]) constant.emplace_back(W[k], graph.constant(k % (n + 1) == 0 ? 1 : 0));
    return constant;
}

std::vector<NodeId> matrix_one(Graph& graph, std::size_t n)
{
    std::vector<NodeId> out(n * n, graph.constant(0));
    for (std::size_t k = 0; k < n; ++k) out[k * (n + 1)] = graph.constant(1);
    return out;
}

namespace {

/// By cofactors, n <= 3.
std::vector<NodeId> matrix_inverse(Graph& graph, const std::vector<NodeId>& a, std::size_t n)
{
    const auto minor = [&](std::size_t i, std::size_t j) { // of the rows and columns behind i and j, in cyclic order
        const auto at = [&](std::size_t row, std::size_t column) { return a[(i + row) % n * n + (j + column) % n]; };
        if (n == 1) return graph.constant(1);
        if (n == 2) return (i + j) % 2 == 0 ? at(1, 1) : graph.negate(at(1, 1));
        return graph.subtract(graph.multiply(at(1, 1), at(2, 2)), graph.multiply(at(1, 2), at(2, 1)));
    };
    NodeId determinant = graph.constant(0);
    for (std::size_t j = 0; j < n; ++j) determinant = graph.add(determinant, graph.multiply(a[j], minor(0, j)));
    std::vector<NodeId> inverse(n * n);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) inverse[j * n + i] = graph.divide(minor(i, j), determinant);
    return inverse;
}

} // namespace

std::vector<NodeId> matrix_quotient(Graph& graph, const std::vector<NodeId>& a, const std::vector<NodeId>& b,
                                    std::size_t n)
{
    if (n == 0) return {};
    if (n <= 3) return matrix_product(graph, matrix_inverse(graph, a, n), b, n);
    std::vector<std::vector<NodeId>> columns(n, std::vector<NodeId>(n));
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) columns[j][i] = b[i * n + j];
    const std::vector<std::vector<NodeId>> solved = graph.solve(a, columns, MatrixStructure::general);
    std::vector<NodeId> out;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) out.push_back(solved[j][i]);
    return out;
}

std::vector<NodeId> element_quotient(Graph& graph, const GroupoidParts& parts, const std::vector<NodeId>& W,
                                     const std::vector<NodeId>& b)
{
    const std::size_t n = parts.size;
    for (const std::vector<NodeId>& E : parts.generators)
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j <= i; ++j)
                if (!graph.is_zero(graph.add(E[i * n + j], E[j * n + i]))) return matrix_quotient(graph, W, b, n);
    std::vector<NodeId> transposed(n * n);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) transposed[j * n + i] = W[i * n + j];
    return matrix_product(graph, transposed, b, n);
}

} // namespace lagen
