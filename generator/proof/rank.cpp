// SPDX-License-Identifier: GPL-2.0-or-later
#include "proof/rank.hpp"

#include <algorithm>
#include <cmath>

namespace lagen {

namespace {

bool contains(const Places& places, std::size_t place)
{
    return std::ranges::find(places, place) != places.end();
}

} // namespace

NodeId FunctionMatrix::value(const Minor& minor) const
{
    return minor.rows.empty() ? graph_.constant(1)
                              : determinant_of(graph_, entries_, columns_, minor.rows, minor.columns);
}

/// A row all of whose minors with those before are zero is a combination of these, and need not be looked at again.
std::optional<Minor> FunctionMatrix::largest_minor(const ZeroDecider& decider, bool everywhere) const
{
    Minor found;
    for (std::size_t row = 0; row < rows_; ++row) {
        std::optional<Minor> best;
        for (std::size_t column = 0; column < columns_; ++column) {
            if (contains(found.columns, column)) continue;
            if (found.rows.size() == determinant_limit) return std::nullopt;
            Minor larger = found;
            larger.rows.push_back(row);
            larger.columns.push_back(column);
            const NodeId minor = value(larger);
            const ProofStatus zero = decider.status(minor);
            if (zero == ProofStatus::undecided) return std::nullopt;
            if (zero == ProofStatus::proved) continue;
            const bool is_last = !everywhere || decider.proves_nonzero(minor);
            if (is_last || !best) best = std::move(larger);
            if (is_last) break;
        }
        if (best) found = std::move(*best);
    }
    return found;
}

std::vector<NodeId> FunctionMatrix::kernel_vector(const Minor& minor, std::size_t j, bool divided) const
{
    std::vector<NodeId> k(columns_, graph_.constant(0));
    k[j] = graph_.constant(1);
    if (minor.rows.empty()) return k;
    std::vector<NodeId> right;
    for (const std::size_t row : minor.rows) right.push_back(graph_.negate(entries_[row * columns_ + j]));
    const CramersRule rule{graph_, entries_, columns_, minor.rows, minor.columns, std::move(right)};
    if (!divided) k[j] = rule.divisor;
    for (std::size_t q = 0; q < minor.columns.size(); ++q) k[minor.columns[q]] = divided ? rule(q) : rule.numerator(q);
    return k;
}

bool FunctionMatrix::maps_to_zero(const std::vector<NodeId>& k, const ZeroDecider& decider) const
{
    for (std::size_t row = 0; row < rows_; ++row) {
        std::vector<NodeId> terms;
        for (std::size_t b = 0; b < columns_; ++b) terms.push_back(graph_.multiply(entries_[row * columns_ + b], k[b]));
        if (decider.status(graph_.sum(terms)) != ProofStatus::proved) return false;
    }
    return true;
}

GenericRank generic_rank(Graph& graph, const std::vector<NodeId>& matrix, std::size_t rows, std::size_t columns,
                         const ZeroDecider& decider)
{
    GenericRank result;
    const FunctionMatrix functions(graph, matrix, rows, columns);
    const std::optional<Minor> minor = functions.largest_minor(decider);
    if (!minor) return result;
    result.rank = minor->rows.size();
    result.surjective = *result.rank == rows;
    result.injective = *result.rank == columns;
    const NodeId found = functions.value(*minor);
    if (*result.rank > 0 && !decider.proves_nonzero(found))
        result.where.push_back(decider.decide(found).residual + " != 0");
    return result;
}

std::optional<Minor> guess_minor(std::vector<long double> N, std::size_t m, std::size_t first)
{
    constexpr long double negligible = 1e-12L;
    Minor minor;
    Places open = first_places(m), columns = first_places(m);
    long double size = 0;
    for (const long double entry : N) {
        if (!std::isfinite(entry)) return {};
        size = std::max(size, std::abs(entry));
    }
    const auto eliminate = [&](std::size_t begin, std::size_t end) {
        std::size_t p = begin, q = 0;
        long double pivot = 0;
        for (const std::size_t i : open)
            for (const std::size_t j : columns)
                if (i >= begin && i < end && std::abs(N[i * m + j]) > std::abs(pivot))
                    p = i, q = j, pivot = N[i * m + j];
        if (std::abs(pivot) <= negligible * size) return false;
        std::erase(open, p);
        std::erase(columns, q);
        for (const std::size_t i : open) {
            const long double factor = N[i * m + q] / pivot;
            for (const std::size_t j : columns) N[i * m + j] -= factor * N[p * m + j];
        }
        minor.rows.push_back(p);
        minor.columns.push_back(q);
        return true;
    };
    while (eliminate(first, m)) {
    }
    while (eliminate(0, first)) {
    }
    return minor;
}

NodeId product_of_pivots(Graph& graph, std::vector<NodeId> N, std::size_t m, const Minor& minor)
{
    std::vector<NodeId> pivots;
    for (std::size_t k = 0; k < minor.rows.size(); ++k) {
        const NodeId pivot = N[minor.rows[k] * m + minor.columns[k]];
        if (graph.is_zero(pivot)) return pivot;
        pivots.push_back(pivot);
        for (std::size_t i = k + 1; i < minor.rows.size(); ++i) {
            const std::size_t row = minor.rows[i] * m;
            const NodeId factor = graph.divide(N[row + minor.columns[k]], pivot);
            for (std::size_t j = k + 1; j < minor.columns.size(); ++j) {
                NodeId& entry = N[row + minor.columns[j]];
                entry = graph.subtract(entry, graph.multiply(factor, N[minor.rows[k] * m + minor.columns[j]]));
            }
        }
    }
    return graph.product(pivots);
}

} // namespace lagen
