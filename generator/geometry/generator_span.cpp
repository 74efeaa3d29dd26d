// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry/generator_span.hpp"

#include "expression/linear_algebra.hpp"

#include <algorithm>

namespace lagen {

namespace {

/// The inverse of an m x m matrix, exact where its entries are numbers.
std::vector<NodeId> inverse_of(Graph& graph, const std::vector<NodeId>& matrix, std::size_t m)
{
    if (!std::ranges::all_of(matrix, [&](NodeId node) { return graph.is_constant(node); }))
        return matrix_quotient(graph, matrix, matrix_one(graph, m), m);
    std::vector<Rational> numbers;
    for (const NodeId node : matrix) numbers.push_back(graph.value(node));
    const Factorisation<Rational> factors = factorise(std::move(numbers), m);
    if (!factors.regular) throw InternalError("generators are dependent on the entries that are to tell them apart");
    std::vector<NodeId> out(m * m);
    for (std::size_t j = 0; j < m; ++j) {
        std::vector<Rational> one(m);
        one[j] = 1;
        const std::vector<Rational> column = substitute(factors, one);
        for (std::size_t i = 0; i < m; ++i) out[i * m + j] = graph.constant(column[i]);
    }
    return out;
}

} // namespace

GeneratorSpan::GeneratorSpan(Graph& graph, const GroupoidParts& parts)
    : graph_(graph), parts_(parts), m_(parts.generators.size())
{
    std::vector<NodeId> matrix;
    for (const std::size_t row : parts.rows)
        for (const std::vector<NodeId>& E : parts.generators) matrix.push_back(E[row]);
    inverse_ = inverse_of(graph, matrix, m_);
}

std::vector<NodeId> GeneratorSpan::components(const std::vector<NodeId>& Z)
{
    std::vector<NodeId> f(m_, graph_.constant(0));
    for (std::size_t k = 0; k < m_; ++k) {
        const NodeId entry = Z[parts_.rows[k]];
        for (std::size_t c = 0; c < m_ && !graph_.is_zero(entry); ++c)
            if (const NodeId factor = inverse_[c * m_ + k]; !graph_.is_zero(factor))
                f[c] = graph_.add(f[c], graph_.multiply(factor, entry));
    }
    return f;
}

std::vector<NodeId> GeneratorSpan::matrix(std::span<const NodeId> f)
{
    std::vector<NodeId> sum(parts_.size * parts_.size, graph_.constant(0));
    for (std::size_t c = 0; c < m_; ++c)
        for (std::size_t k = 0; k < sum.size(); ++k)
            if (const NodeId entry = parts_.generators[c][k]; !graph_.is_zero(entry))
                sum[k] = graph_.add(sum[k], graph_.multiply(f[c], entry));
    return sum;
}

std::vector<NodeId> GeneratorSpan::outside(std::vector<NodeId> Z, const std::vector<NodeId>& f)
{
    for (std::size_t c = 0; c < m_; ++c)
        for (std::size_t k = 0; k < Z.size() && !graph_.is_zero(f[c]); ++k)
            if (const NodeId entry = parts_.generators[c][k]; !graph_.is_zero(entry))
                Z[k] = graph_.subtract(Z[k], graph_.multiply(f[c], entry));
    return Z;
}

std::vector<NodeId> GeneratorSpan::triples_outside()
{
    std::vector<NodeId> open;
    const auto times = [&](const std::vector<NodeId>& a, const std::vector<NodeId>& b) {
        return matrix_product(graph_, a, b, parts_.size);
    };
    for (std::size_t a = 0; a < m_; ++a)
        for (std::size_t b = 0; b < m_; ++b) {
            const std::vector<NodeId> ab = times(parts_.generators[a], parts_.generators[b]);
            const std::vector<NodeId> ba = times(parts_.generators[b], parts_.generators[a]);
            for (std::size_t c = a; c < m_; ++c) {
                std::vector<NodeId> Z = times(ab, parts_.generators[c]);
                const std::vector<NodeId> other = times(parts_.generators[c], ba);
                for (std::size_t k = 0; k < Z.size(); ++k) Z[k] = graph_.add(Z[k], other[k]);
                for (const NodeId value : outside(Z, components(Z)))
                    if (!graph_.is_zero(value)) open.push_back(value);
            }
        }
    return open;
}

} // namespace lagen
