// SPDX-License-Identifier: GPL-2.0-or-later
/// The observability rank of what is wanted: d h, d h', d h'', .. by the lanes, with the constants of the start held.
#include "graph/calculus/differentiate.hpp"
#include "graph/core/evaluate.hpp"
#include "least/least_model.hpp"
#include "proof/ball_matrix.hpp"
#include "verify/judge.hpp"

#include <algorithm>
#include <cmath>

namespace lagen {

namespace {

constexpr std::size_t most_nodes = 30000; ///< of a derivative that is still taken

/// Places of a minor of some rows: elimination with the largest entry that is left.
struct Minor {
    std::vector<std::size_t> rows, columns;
};

Minor independent(std::vector<std::vector<long double>> rows, std::size_t n)
{
    Minor minor;
    while (minor.rows.size() < std::min(rows.size(), n)) {
        std::size_t r = 0, c = 0;
        for (std::size_t i = 0; i < rows.size(); ++i)
            for (std::size_t j = 0; j < n; ++j)
                if (std::abs(rows[i][j]) > std::abs(rows[r][c])) r = i, c = j;
        if (!(std::abs(rows[r][c]) > 1e-9L)) break;
        minor.rows.push_back(r);
        minor.columns.push_back(c);
        const std::vector<long double> pivot = rows[r];
        for (std::vector<long double>& row : rows) {
            const long double factor = row[c] / pivot[c];
            for (std::size_t j = 0; j < n; ++j) row[j] -= factor * pivot[j];
        }
        std::ranges::fill(rows[r], 0.0L);
    }
    return minor;
}

} // namespace

CertifiedRank certified_rank(Reduction& reduction)
{
    Graph& graph = reduction.graph();
    const LaneSystem& system = reduction.system;
    const std::size_t n = system.lanes.size();
    const std::optional<NamedPoint> point = reduction.prover.sample_point();
    if (!point || n == 0) return {};
    NamedNumbers numbers = reduction.prover.parameter_numbers();
    for (const auto& [name, value] : *point) numbers[name] = static_cast<long double>(to_double(value));
    Replacements seeds = replacements(system.lanes, reduction.prover.with_relations(system.rates));
    seeds.emplace_back(system.time, graph.constant(1));
    std::vector<NodeId> functions = reduction.prover.with_relations(reduction.wanted()), covectors;
    std::vector<std::vector<long double>> rows;
    Minor minor;
    for (std::size_t order = 0; order < n; ++order) {
        for (const NodeId function : functions) {
            const std::vector<NodeId> covector = gradient(graph, function, system.lanes);
            std::vector<long double> row = evaluate<long double>(graph, covector, numbers);
            long double size = 0;
            for (const long double each : row) size = std::max(size, std::abs(each));
            if (!std::isfinite(size) || size == 0) continue;
            for (long double& each : row) each /= size;
            rows.push_back(std::move(row));
            covectors.insert(covectors.end(), covector.begin(), covector.end());
        }
        Minor larger = independent(rows, n);
        const bool grows = larger.rows.size() > minor.rows.size();
        minor = std::move(larger);
        if (!grows || minor.rows.size() == n || reachable(graph, functions).size() > most_nodes) break;
        functions = directional(graph, functions, seeds);
    }
    const std::size_t r = minor.rows.size();
    std::vector<NodeId> entries;
    for (const std::size_t row : minor.rows)
        for (const std::size_t column : minor.columns) entries.push_back(covectors[row * n + column]);
    const std::vector<proof::Ball> balls = WitnessPoint(graph, *point).enclose(entries);
    proof::BallMatrix matrix(r, r);
    matrix.entries = balls;
    if (!proof::solved(matrix, proof::BallMatrix::identity(r), 256)) return {};
    return {r, *point};
}

} // namespace lagen
