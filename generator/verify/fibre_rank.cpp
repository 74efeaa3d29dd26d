// SPDX-License-Identifier: GPL-2.0-or-later
#include "verify/fibre_rank.hpp"

#include "graph/calculus/determinant.hpp"
#include "verify/pivoted_minor.hpp"

#include <algorithm>

namespace lagen {

namespace {

bool contains(const std::vector<std::size_t>& places, std::size_t place)
{
    return std::ranges::find(places, place) != places.end();
}

} // namespace

FibreRank fibre_rank(Graph& graph, const std::vector<NodeId>& matrix, std::size_t rows, std::size_t columns,
                     const ZeroDecider& decider)
{
    FibreRank result;
    const std::size_t full = std::min(rows, columns);
    PivotedMinor minor; // certainly not zero at some point; it grows by a row and a column at a time
    const auto value = [&](const PivotedMinor& of) {
        return of.rows.empty() ? graph.constant(1) : determinant_of(graph, matrix, columns, of.rows, of.columns);
    };
    for (bool grown = true; grown && minor.rows.size() < full;) {
        if (minor.rows.size() >= determinant_limit) return result;
        grown = false;
        for (std::size_t a = 0; a < rows && !grown; ++a)
            for (std::size_t b = 0; b < columns && !grown; ++b) {
                if (contains(minor.rows, a) || contains(minor.columns, b)) continue;
                PivotedMinor larger = minor;
                larger.rows.push_back(a);
                larger.columns.push_back(b);
                const ProofStatus zero = decider.status(value(larger));
                if (zero == ProofStatus::undecided) return result;
                grown = zero == ProofStatus::refuted;
                if (grown) minor = std::move(larger);
            }
    }
    result.rank = minor.rows.size();
    result.surjective = *result.rank == rows;
    result.injective = *result.rank == columns;
    const NodeId found = value(minor);
    if (*result.rank > 0 && !decider.proves_nonzero(found))
        result.where.push_back(decider.decide(found).residual + " != 0");
    return result;
}

} // namespace lagen
