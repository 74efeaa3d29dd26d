// SPDX-License-Identifier: GPL-2.0-or-later
/// Sylvester's criterion, part by part or block by block, and the elimination of the fibre coordinates.
#include "verify/definiteness.hpp"

#include "algebroid/section.hpp"
#include "proof/rational_matrix.hpp"
#include "verify/convex_parts.hpp"

#include <algorithm>
#include <map>

namespace lagen {
namespace {

/// Whether a matrix has one entry, which is nowhere negative.
bool is_nonnegative_number(const std::vector<NodeId>& entries, const ZeroDecider& decider)
{
    return entries.size() == 1 && decider.proves_nonnegative(entries[0]);
}

/// The functions of the definite parts; nothing where a part may be negative, or there are none.
std::optional<std::vector<NodeId>> definite_functions(Graph& graph, const FibreHessian& hessian,
                                                      const ZeroDecider& decider)
{
    const std::vector<ConvexPart> parts = convex_parts(graph, hessian.lagrangian, hessian.y);
    if (parts.empty()) return {};
    std::map<std::vector<NodeId>, bool> known; // many squares have the same factor
    std::vector<NodeId> functions;
    for (const auto& [f, c] : parts) {
        const auto [at, first] = known.emplace(c, false);
        if (first) at->second = proves_matrix_definite(graph, c, f.size(), decider);
        if (at->second)
            functions.insert(functions.end(), f.begin(), f.end());
        else if (!is_nonnegative_number(c, decider))
            return {};
    }
    return functions;
}

/// The one entry of a row whose coordinate is still open; null where there are none or several.
const ColumnEntry* only_open(const Column& row, const std::vector<bool>& closed)
{
    const ColumnEntry* only = nullptr;
    for (const ColumnEntry& entry : row) {
        if (closed[entry.index]) continue;
        if (only != nullptr) return nullptr;
        only = &entry;
    }
    return only;
}

/// Whether the sum of the squares is positive: one that is a number makes it so, whatever the others are.
bool have_positive_squares(Graph& graph, const std::vector<NodeId>& slopes, const ZeroDecider& decider)
{
    std::vector<NodeId> squares;
    for (const NodeId slope : slopes) {
        if (graph.is_constant(slope) && !graph.is_zero(slope)) return true;
        squares.push_back(graph.power(slope, 2));
    }
    return decider.proves_positive(graph.sum(squares));
}

} // namespace

std::vector<Rational> numbers_of(const Graph& graph, const std::vector<NodeId>& nodes)
{
    std::vector<Rational> numbers;
    for (const NodeId node : nodes) {
        if (!graph.is_constant(node)) return {};
        numbers.push_back(graph.value(node));
    }
    return numbers;
}

bool proves_matrix_definite(Graph& graph, const std::vector<NodeId>& entries, std::size_t m, const ZeroDecider& decider)
{
    if (const std::vector<Rational> numbers = numbers_of(graph, entries); !numbers.empty())
        return is_positive_definite(numbers, m);
    if (m > determinant_limit) return false;
    std::vector<std::size_t> first;
    for (std::size_t k = 0; k < m; ++k) {
        first.push_back(k);
        if (!decider.proves_positive(determinant_of(graph, entries, m, first, first))) return false;
    }
    return true;
}

bool proves_semidefinite(Graph& graph, const FibreHessian& hessian, const ZeroDecider& decider)
{
    return definite_functions(graph, hessian, decider).has_value() ||
           std::ranges::all_of(hessian.blocks, [&](const std::vector<std::size_t>& block) {
               const std::vector<NodeId> entries = hessian.submatrix(block);
               return is_nonnegative_number(entries, decider) ||
                      proves_matrix_definite(graph, entries, block.size(), decider);
           });
}

bool proves_definite_by_parts(Graph& graph, const FibreHessian& hessian, const ZeroDecider& decider)
{
    const std::size_t r = hessian.y.size();
    const auto functions = definite_functions(graph, hessian, decider);
    if (!functions) return false;
    BaseGradient slopes_of(graph, hessian.y);
    std::vector<Column> rows; // df
    for (const NodeId f : *functions) rows.push_back(slopes_of.of(f));
    std::vector<bool> closed(r, false);
    for (std::size_t count = 0; count < r;) {
        std::map<std::size_t, std::vector<NodeId>> entries;
        for (const Column& row : rows)
            if (const ColumnEntry* entry = only_open(row, closed)) entries[entry->index].push_back(entry->value);
        bool progress = false;
        for (const auto& [a, slopes] : entries) {
            if (!have_positive_squares(graph, slopes, decider)) continue;
            closed[a] = progress = true;
            ++count;
        }
        if (!progress) return false;
    }
    return true;
}

bool proves_definite(Graph& graph, const FibreHessian& hessian, const ZeroDecider& decider)
{
    return proves_definite_by_parts(graph, hessian, decider) ||
           std::ranges::all_of(hessian.blocks, [&](const std::vector<std::size_t>& block) {
               return proves_matrix_definite(graph, hessian.submatrix(block), block.size(), decider);
           });
}

} // namespace lagen
