// SPDX-License-Identifier: GPL-2.0-or-later
/// Linear lumping: e = B s with rational B, so that what is wanted and B f are functions of e. The rows of B span the
/// least space that holds the differentials of what is wanted and is mapped to itself by the transposed Jacobian of the
/// rates; it is guessed at random points, and proved by d(B f)/dn = 0 for n in the kernel of B.
/// [Wei and Kuo 1969; Ovchinnikov, Perez Verona, Pogudin and Tribastone 2021]
#include "graph/calculus/differentiate.hpp"
#include "graph/core/evaluate.hpp"
#include "least/rational_span.hpp"
#include "least/reduction.hpp"

#include <algorithm>

namespace lagen {

namespace {

RationalSpan lumped_span(Reduction& reduction)
{
    Graph& graph = reduction.graph();
    const LaneSystem& system = reduction.system;
    const std::size_t n = system.lanes.size();
    const std::vector<NodeId> first = joined_rows(jacobian(graph, reduction.wanted(), system.lanes));
    const std::vector<NodeId> slopes = joined_rows(jacobian(graph, system.rates, system.lanes));
    RationalSpan span(n);
    std::vector<std::vector<long double>> open;
    const auto add = [&](std::vector<long double> row) {
        if (span.add(row)) open.push_back(std::move(row));
    };
    std::vector<std::vector<long double>> jacobians;
    for (const NamedNumbers& point : reduction.prover.points()) {
        const std::vector<long double> rows = evaluate<long double>(graph, first, point);
        for (std::size_t k = 0; k < rows.size(); k += n)
            add({rows.begin() + static_cast<std::ptrdiff_t>(k), rows.begin() + static_cast<std::ptrdiff_t>(k + n)});
        jacobians.push_back(evaluate<long double>(graph, slopes, point));
    }
    while (!open.empty() && span.dimension() < n) {
        const std::vector<long double> row = std::move(open.back());
        open.pop_back();
        for (const std::vector<long double>& J : jacobians) {
            std::vector<long double> next(n);
            for (std::size_t i = 0; i < n; ++i)
                for (std::size_t j = 0; j < n; ++j) next[j] += row[i] * J[i * n + j];
            add(std::move(next));
        }
    }
    return span;
}

NodeId combination(Graph& graph, const std::vector<Rational>& row, const std::vector<NodeId>& nodes)
{
    NodeId sum = graph.constant(0);
    for (std::size_t i = 0; i < row.size(); ++i)
        if (row[i] != 0) sum = graph.add(sum, graph.multiply(graph.constant(row[i]), nodes[i]));
    return sum;
}

/// B s at the start; nothing where a lane has no exact one.
std::optional<NodeId> start_of(Graph& graph, const std::vector<Rational>& row,
                               const std::vector<std::optional<NodeId>>& start)
{
    std::vector<NodeId> exact;
    for (std::size_t i = 0; i < row.size(); ++i) {
        if (row[i] != 0 && !start[i]) return std::nullopt;
        exact.push_back(start[i].value_or(graph.constant(0)));
    }
    return combination(graph, row, exact);
}

/// "x2 - x1": the lane that leads stands last where its sign is negative.
std::string name_of_row(const Reduction& reduction, const std::vector<Rational>& row)
{
    std::string name;
    for (std::size_t i = 0; i < row.size(); ++i) {
        if (row[i] == 0) continue;
        const Rational size = abs(row[i]);
        const std::string term = (size == 1 ? "" : size.get_str() + "*") + reduction.name_of(reduction.system.lanes[i]);
        name += name.empty() ? (row[i] < 0 ? "-" : "") + term : (row[i] < 0 ? " - " : " + ") + term;
    }
    return name;
}

} // namespace

bool lump_lanes(Reduction& reduction)
{
    Graph& graph = reduction.graph();
    const LaneSystem& system = reduction.system;
    if (!system.jumps.empty() || reduction.prover.points().empty()) return false;
    const RationalSpan span = lumped_span(reduction);
    const std::vector<std::vector<Rational>> rows = span.rows(), kernel = span.kernel();
    if (kernel.empty() || rows.size() + kernel.size() != system.lanes.size()) return false;
    std::vector<NodeId> functions = reduction.wanted(), rates;
    for (const std::vector<Rational>& row : rows) rates.push_back(combination(graph, row, system.rates));
    functions.insert(functions.end(), rates.begin(), rates.end());
    std::vector<NodeId> needed;
    for (const std::vector<Rational>& direction : kernel) {
        Replacements along;
        for (std::size_t i = 0; i < direction.size(); ++i)
            if (direction[i] != 0) along.emplace_back(system.lanes[i], graph.constant(direction[i]));
        const auto more = reduction.prover.unchanging(functions, along);
        if (!more) return false;
        needed.insert(needed.end(), more->begin(), more->end());
    }

    Reduction next = reduction;
    next.prover.bind(needed);
    std::vector<NodeId> lanes;
    std::vector<std::optional<NodeId>> starts;
    Replacements led, others; // s_pivot = e - (the others), and the others, which count for nothing
    std::vector<NodeId> added;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        lanes.push_back(graph.input(name_of_row(reduction, rows[k])));
        starts.push_back(start_of(graph, rows[k], system.start));
        std::vector<Rational> rest = rows[k];
        rest[span.pivots()[k]] = 0;
        const NodeId pivot = system.lanes[span.pivots()[k]];
        if (lanes[k] == pivot) continue; // a lane by itself
        added.push_back(lanes[k]);
        led.emplace_back(pivot, graph.subtract(lanes[k], combination(graph, rest, system.lanes)));
    }
    for (std::size_t i = 0; i < system.lanes.size(); ++i)
        if (std::ranges::find(span.pivots(), i) == span.pivots().end())
            others.emplace_back(system.lanes[i], graph.constant(0));
    const auto moved = substitute_where_defined(graph, rates, led);
    if (!moved || !next.prover.restrict_to({}, {}, added) || !next.replace(led, true)) return false;
    const auto projected = substitute_where_defined(graph, *moved, others);
    if (!projected || !next.replace(others, false)) return false;
    next.system.lanes = lanes;
    next.system.rates = next.written = *projected;
    next.definitions.clear();
    next.system.start = starts;
    for (std::size_t k = 0; k < rows.size(); ++k)
        if (std::ranges::find(added, lanes[k]) != added.end())
            next.steps.push_back({.rule = "differences", .lane = reduction.name_of(lanes[k]), .relations = needed});
    reduction = std::move(next);
    return true;
}

} // namespace lagen
