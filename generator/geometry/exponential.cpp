// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry/exponential.hpp"

#include "geometry/cayley.hpp"
#include "geometry/generator_span.hpp"
#include "graph/calculus/differentiate.hpp"

#include <numeric>

namespace lagen {

namespace {

using Matrix = std::vector<NodeId>;    ///< by rows
using Rows = std::vector<std::size_t>; ///< of a block, ascending

constexpr std::size_t most_powers = 3; ///< k

/// Classes of rows that entries of the generators couple.
std::vector<Rows> blocks_of(const Graph& graph, const GroupoidParts& parts)
{
    const std::size_t n = parts.size;
    Rows label(n);
    std::iota(label.begin(), label.end(), 0);
    for (const Matrix& E : parts.generators)
        for (std::size_t k = 0; k < E.size(); ++k) {
            const std::size_t from = label[k / n], to = label[k % n];
            if (graph.is_zero(E[k]) || from == to) continue;
            for (std::size_t& each : label)
                if (each == from) each = to;
        }
    std::vector<Rows> blocks;
    for (std::size_t name = 0; name < n; ++name) {
        Rows block;
        for (std::size_t i = 0; i < n; ++i)
            if (label[i] == name) block.push_back(i);
        if (!block.empty()) blocks.push_back(std::move(block));
    }
    return blocks;
}

/// A block A of the matrices: its powers, and the k and z of its closed form.
class ExponentialBlock {
  public:
    ExponentialBlock(Graph& graph, Matrix A, std::size_t n) : graph_(graph), n_(n), powers_{matrix_one(graph, n), A}
    {
        while (powers_.size() < most_powers + 3) powers_.push_back(matrix_product(graph, powers_.back(), A, n));
    }

    /// Finds the least k, with the number m of eigenvalues that are not 0.
    [[nodiscard]] bool has_form(const std::function<bool(NodeId)>& vanishes)
    {
        NodeId trace = graph_.constant(0);
        for (std::size_t i = 0; i < n_; ++i) trace = graph_.add(trace, powers_[2][i * (n_ + 1)]);
        const bool nilpotent = vanishes(trace);
        for (k_ = 0; k_ <= most_powers; ++k_)
            for (std::size_t m = 1; m <= (nilpotent ? 1 : n_); ++m) {
                z_ = nilpotent ? graph_.constant(0)
                               : graph_.multiply(graph_.constant(Rational(-1, static_cast<long>(m))), trace);
                if (repeats(vanishes)) return true;
            }
        return false;
    }

    /// exp(side A) - 1 with side = 1 or -1; of k = 0 the entry c_0(z) - 1 = -z c_2(z).
    [[nodiscard]] Matrix less_one(long side)
    {
        Matrix sum(n_ * n_, graph_.constant(0));
        Rational factorial = 1;
        for (std::size_t j = 1; j <= k_ + 1; ++j) {
            factorial *= static_cast<long>(j) * side;
            const NodeId sign = graph_.constant(side < 0 && j % 2 == 1 ? -1 : 1);
            const NodeId factor = j < k_ ? graph_.constant(1 / factorial)
                                         : graph_.multiply(sign, graph_.stumpff(static_cast<unsigned>(j), z_));
            add(sum, factor, powers_[j]);
        }
        if (k_ == 0) add(sum, graph_.negate(graph_.multiply(z_, graph_.stumpff(2, z_))), powers_[0]);
        return sum;
    }

  private:
    /// A^(k+2) + z A^k = 0
    [[nodiscard]] bool repeats(const std::function<bool(NodeId)>& vanishes)
    {
        for (std::size_t i = 0; i < n_ * n_; ++i)
            if (!vanishes(graph_.add(powers_[k_ + 2][i], graph_.multiply(z_, powers_[k_][i])))) return false;
        return true;
    }

    void add(Matrix& sum, NodeId factor, const Matrix& term)
    {
        for (std::size_t i = 0; i < sum.size(); ++i)
            if (!graph_.is_zero(term[i])) sum[i] = graph_.add(sum[i], graph_.multiply(factor, term[i]));
    }

    Graph& graph_;
    std::size_t n_;
    std::vector<Matrix> powers_;
    std::size_t k_ = 0;
    NodeId z_ = 0;
};

/// 1 + M
Matrix and_one(Graph& graph, const Matrix& M, std::size_t n)
{
    return one_and(graph, 1, M, n);
}

} // namespace

Exponential exponential(Graph& graph, const GroupoidParts& parts, std::vector<NodeId> s,
                        const std::function<bool(NodeId)>& vanishes)
{
    const std::size_t n = parts.size;
    const Matrix A = GeneratorSpan(graph, parts).matrix(s);
    Exponential out{std::move(s), Matrix(n * n, graph.constant(0)), Matrix(n * n, graph.constant(0)), {}};
    for (const Rows& rows : blocks_of(graph, parts)) {
        Matrix within;
        for (const std::size_t i : rows)
            for (const std::size_t j : rows) within.push_back(A[i * n + j]);
        ExponentialBlock block(graph, std::move(within), rows.size());
        if (!block.has_form(vanishes)) {
            for (const std::size_t i : rows) out.block_without.push_back(i + 1);
            return out;
        }
        const Matrix forth = block.less_one(1), back = block.less_one(-1);
        for (std::size_t i = 0; i < rows.size(); ++i)
            for (std::size_t j = 0; j < rows.size(); ++j) {
                out.less_one[rows[i] * n + rows[j]] = forth[i * rows.size() + j];
                out.inverse_less_one[rows[i] * n + rows[j]] = back[i * rows.size() + j];
            }
    }
    return out;
}

std::vector<NodeId> logarithm_conditions(Graph& graph, const GroupoidParts& parts, const Exponential& exponential)
{
    const std::size_t n = parts.size;
    const Matrix V = less_one(graph, parts.arrow.W, n); // exp(-A) W - 1 = (exp(-A) - 1)(1 + V) + V
    Matrix off = matrix_product(graph, exponential.inverse_less_one, and_one(graph, V, n), n);
    for (std::size_t k = 0; k < off.size(); ++k) off[k] = graph.add(off[k], V[k]);
    return GeneratorSpan(graph, parts).components(cayley_inverse(graph, off, n));
}

std::vector<NodeId> right_differential(Graph& graph, const GroupoidParts& parts, const Exponential& exponential)
{
    const std::size_t n = parts.size, m = exponential.s.size();
    GeneratorSpan span(graph, parts);
    const Matrix back = and_one(graph, exponential.inverse_less_one, n);
    std::vector<NodeId> D(m * m);
    for (std::size_t c = 0; c < m; ++c) {
        const std::vector<std::pair<NodeId, NodeId>> seed{{exponential.s[c], graph.constant(1)}};
        const Matrix moved = matrix_product(graph, directional(graph, exponential.less_one, seed), back, n);
        const std::vector<NodeId> column = span.components(moved);
        for (std::size_t a = 0; a < m; ++a) D[a * m + c] = column[a];
    }
    return D;
}

} // namespace lagen
