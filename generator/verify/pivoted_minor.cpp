// SPDX-License-Identifier: GPL-2.0-or-later
#include "verify/pivoted_minor.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lagen {

std::optional<PivotedMinor> guess_minor(std::vector<long double> N, std::size_t m, std::size_t first)
{
    constexpr long double negligible = 1e-12L;
    PivotedMinor minor;
    std::vector<std::size_t> open(m), columns(m);
    std::iota(open.begin(), open.end(), 0);
    std::iota(columns.begin(), columns.end(), 0);
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

NodeId product_of_pivots(Graph& graph, std::vector<NodeId> N, std::size_t m, const PivotedMinor& minor)
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
