// SPDX-License-Identifier: GPL-2.0-or-later
/// Groupoids, and the algebroids that are computed from them.
#include "elaborate/build_groupoid.hpp"

#include "elaborate/bind_parameters.hpp"
#include "elaborate/build_workspace.hpp"
#include "geometry/algebroid_of.hpp"
#include "geometry/generator_span.hpp"
#include "graph/core/evaluate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace lagen {
namespace {

std::vector<NodeId> declared_inputs(Graph& graph, const std::vector<Symbol>& symbols)
{
    std::vector<NodeId> nodes;
    for (const Symbol& symbol : symbols) nodes.push_back(graph.input(symbol.name));
    return nodes;
}

/// The entries of the generators for the parameter values of the file.
std::vector<std::vector<long double>> generator_numbers(const Model& model)
{
    Graph graph;
    Lowering lower(graph, parameter_values(graph, model));
    std::vector<std::vector<long double>> out;
    for (const ArrayValue& matrix : model.groupoid->generators) {
        std::vector<NodeId> entries;
        for (const Tree& entry : matrix.entries) entries.push_back(lower(entry));
        out.push_back(evaluate<long double>(graph, entries, {}));
    }
    return out;
}

/// The fields W E_c have n entries a nonzero column of E_c, and n terms a nonzero entry: each entry is differentiated.
void require_bounded_fields(const Model& model, const std::vector<std::vector<long double>>& matrices)
{
    constexpr std::size_t most_products = 300'000'000;
    const std::size_t n = model.groupoid->generators.empty() ? 0 : model.groupoid->generators[0].shape.rows;
    std::size_t entries = 0, columns = 0;
    for (const std::vector<long double>& E : matrices) {
        std::set<std::size_t> of_matrix;
        for (std::size_t k = 0; k < E.size(); ++k)
            if (E[k] != 0) {
                ++entries;
                of_matrix.insert(k % n);
            }
        columns += of_matrix.size();
    }
    if (entries == 0 || n * n * columns <= most_products / entries) return;
    throw ModelError(fmt::format("the generators are {0} x {0} matrices with {1} entries that are not zero in {2} "
                                 "columns: {0}^2*{1}*{2} is more than {3}",
                                 n, entries, columns, most_products),
                     model.groupoid->group_where, "generators of a smaller group, or sparser ones, are computed with");
}

/// One entry a generator, found by elimination with the largest pivots: on these entries they are independent.
std::vector<std::size_t> independent_rows(const Model& model)
{
    constexpr long double negligible = 1e-12L;
    std::vector<std::vector<long double>> matrices = generator_numbers(model);
    require_bounded_fields(model, matrices);
    std::vector<std::size_t> rows;
    for (std::size_t c = 0; c < matrices.size(); ++c) {
        std::size_t row = 0;
        for (std::size_t k = 0; k < matrices[c].size(); ++k)
            if (std::abs(matrices[c][k]) > std::abs(matrices[c][row])) row = k;
        if (!(std::abs(matrices[c][row]) > negligible))
            throw ModelError(fmt::format("the generator number {} is a combination of those before it", c + 1),
                             model.groupoid->group_where,
                             "generators are linearly independent, for the parameter values of the file too");
        rows.push_back(row);
        for (std::size_t d = c + 1; d < matrices.size(); ++d) {
            const long double factor = matrices[d][row] / matrices[c][row];
            for (std::size_t k = 0; k < matrices[d].size(); ++k) matrices[d][k] -= factor * matrices[c][k];
        }
    }
    return rows;
}

/// A_i^c of an Atiyah algebroid; empty where it has none.
std::vector<std::vector<NodeId>> connection_of(Graph& graph, Lowering& lower, const Model& model)
{
    const AlgebroidBlock& block = model.algebroid;
    const std::size_t n = model.base.coordinates.size();
    if (model.groupoid->kind != GroupoidKind::atiyah || block.kind != AlgebroidKind::atiyah || block.connection.empty())
        return {};
    std::vector<std::vector<NodeId>> A(n, std::vector<NodeId>(model.groupoid->generators.size(), graph.constant(0)));
    for (const ConnectionEntry& entry : block.connection) A[entry.coordinate][entry.section - n] = lower(entry.value);
    return A;
}

} // namespace

Groupoid lower_groupoid(Graph& graph, Lowering& lower, const Model& model)
{
    const GroupoidBlock& block = *model.groupoid;
    GroupoidParts parts;
    parts.arrow.x = declared_inputs(graph, model.base.coordinates);
    parts.arrow.next = declared_inputs(graph, block.next);
    parts.arrow.W = declared_inputs(graph, block.element);
    parts.size = block.generators.empty() ? 0 : block.generators[0].shape.rows;
    for (const Tree& tree : block.action) parts.action.push_back(lower(tree));
    for (const ArrayValue& matrix : block.generators) {
        std::vector<NodeId>& E = parts.generators.emplace_back();
        for (const Tree& entry : matrix.entries) E.push_back(lower(entry));
    }
    parts.rows = independent_rows(model);
    parts.connection = connection_of(graph, lower, model);
    return make_groupoid(graph, std::move(parts));
}

bool has_cayley_map(const Model& model)
{
    if (!model.groupoid->group.empty()) return true;  // each of the groups with a name
    constexpr std::size_t most_entries = 100'000'000; // of the products E_a E_b E_c
    const std::size_t m = model.groupoid->generators.size();
    if (m == 0 || m * m * m * model.groupoid->generators[0].shape.size() > most_entries) return false;
    BuildWorkspace work(model);
    Lowering lower(work.graph());
    const Groupoid groupoid = lower_groupoid(work.graph(), lower, model);
    return std::ranges::all_of(GeneratorSpan(work.graph(), groupoid).triples_outside(),
                               [&](NodeId value) { return work.decide(value).status == ProofStatus::proved; });
}

Exponential closed_exponential(Graph& graph, const System& system, std::vector<NodeId> s)
{
    ProofSetting setting;
    setting.variables = s;
    setting.parameters = system.parameters;
    const auto vanishes = [&](NodeId node) { // a decider knows the nodes that there are when it is made
        return graph.is_zero(node) || ZeroDecider(graph, setting).status(node) == ProofStatus::proved;
    };
    return exponential(graph, *system.groupoid, std::move(s), vanishes);
}

void require_groupoid(const Model& model)
{
    if (!model.groupoid->group.empty() || model.groupoid->generators.empty()) return;
    BuildWorkspace work(model);
    Lowering lower(work.graph());
    const Groupoid groupoid = lower_groupoid(work.graph(), lower, model);
    const AlgebroidOfGroupoid computed = algebroid_of(work.graph(), groupoid, std::vector<NodeId>(groupoid.r(), 0));
    for (const OpenEntry& entry : computed.open) {
        const Decision decision = work.decide(entry.value);
        if (decision.status == ProofStatus::proved) continue;
        const std::size_t first = groupoid.horizontal();
        throw ModelError(fmt::format("the commutator of the generators number {} and {} is {}", entry.a - first + 1,
                                     entry.b - first + 1,
                                     decision.status == ProofStatus::refuted
                                         ? "no combination of the generators"
                                         : "not shown to be a combination of the generators"),
                         model.groupoid->group_where,
                         "generators span a Lie algebra: [E_a, E_b] = C^c_ab E_c; add what their commutators miss");
    }
}

/// The algebroid of the model's groupoid.
BlockParts build_of_groupoid(BuildWorkspace& work, const AlgebroidBlock& block)
{
    require_groupoid(work.model());
    Graph& graph = work.graph();
    Lowering lower(graph);
    const Groupoid groupoid = lower_groupoid(graph, lower, work.model());
    const Algebroid computed = algebroid_of(graph, groupoid, std::vector<NodeId>(groupoid.r(), 0)).algebroid;
    BlockParts parts;
    for (std::size_t a = 0; a < computed.r(); ++a)
        for (const ColumnEntry& entry : computed.anchor[a])
            work.append_anchor(parts, entry.index, a, entry.value, block.where);
    for (std::size_t a = 0; a < computed.r(); ++a)
        for (std::size_t b = a + 1; b < computed.r(); ++b)
            for (const ColumnEntry& entry : computed.C(a, b))
                work.append_structure(parts, entry.index, a, b, entry.value, block.where);
    return parts;
}

} // namespace lagen
