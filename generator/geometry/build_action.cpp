// SPDX-License-Identifier: GPL-2.0-or-later
/// Actions and Atiyah algebroids: rho and C from structure constants of a Lie algebra.
#include "geometry/build_workspace.hpp"

namespace lagen {

/// rho(e_a) = -(A_a x)^i d/dx^i, a homomorphism where [A_a, A_b] = C^c_ab A_c; or the anchor as given.
BlockParts build_action(BuildWorkspace& work, const AlgebroidBlock& block)
{
    BlockParts parts = build_given(block);
    Graph& graph = work.graph();
    for (std::size_t a = 0; a < block.representation.size(); ++a) {
        const ArrayValue& matrix = block.representation[a];
        for (std::size_t i = 0; i < matrix.shape.rows; ++i) {
            std::vector<NodeId> terms;
            for (std::size_t j = 0; j < matrix.shape.columns; ++j) {
                const NodeId entry = work.lower(matrix.entries[i * matrix.shape.columns + j]);
                terms.push_back(graph.multiply(entry, work.coordinate(block.base[j])));
            }
            work.append_anchor(parts, block.base[i], a, graph.negate(graph.sum(terms)), block.representation_where);
        }
    }
    return parts;
}

namespace {

/// A_i^c and c^c_ab on the graph; sections count from the first vertical one.
struct AtiyahData {
    std::size_t n, g;      ///< base coordinates; rank of the structure algebra
    std::vector<NodeId> A; ///< A[i * g + c]
    std::vector<Column> c; ///< c[a * g + b]: entries c^c_ab
    [[nodiscard]] NodeId potential(std::size_t i, std::size_t c_index) const { return A[i * g + c_index]; }
};

AtiyahData atiyah_data(BuildWorkspace& work, const AlgebroidBlock& block, const BlockParts& constants)
{
    const std::size_t n = block.base.size();
    const std::size_t g = block.fibre.size() - n;
    AtiyahData data{n, g, std::vector<NodeId>(n * g, work.graph().constant(0)), std::vector<Column>(g * g)};
    for (const ConnectionEntry& entry : block.connection)
        for (std::size_t i = 0; i < n; ++i)
            if (block.base[i] == entry.coordinate) data.A[i * g + entry.section - n] = work.lower(entry.value);
    const LoweredAlgebroid lowered = work.lowered(block, constants);
    for (std::size_t a = 0; a < g; ++a)
        for (std::size_t b = 0; b < g; ++b)
            for (const ColumnEntry& entry : lowered.C(n + a, n + b))
                data.c[a * g + b].push_back({entry.index - n, entry.value});
    return data;
}

/// F^c_ij = d_i A_j^c - d_j A_i^c - c^c_ab A_i^a A_j^b for all c
std::vector<NodeId> curvature(BuildWorkspace& work, const AlgebroidBlock& block, const AtiyahData& data, std::size_t i,
                              std::size_t j)
{
    Graph& graph = work.graph();
    std::vector<std::vector<NodeId>> terms(data.g);
    const auto partial = [&](NodeId f, std::size_t k) {
        return LoweredAlgebroid::entry(graph, work.partials(f), block.base[k]);
    };
    for (std::size_t c = 0; c < data.g; ++c) {
        terms[c].push_back(partial(data.potential(j, c), i));
        terms[c].push_back(graph.negate(partial(data.potential(i, c), j)));
    }
    for (std::size_t a = 0; a < data.g; ++a)
        for (std::size_t b = 0; b < data.g; ++b)
            for (const ColumnEntry& entry : data.c[a * data.g + b]) {
                const NodeId factors[] = {entry.value, data.potential(i, a), data.potential(j, b)};
                terms[entry.index].push_back(graph.negate(graph.product(factors)));
            }
    std::vector<NodeId> F;
    for (const std::vector<NodeId>& sum : terms) F.push_back(graph.sum(sum));
    return F;
}

} // namespace

/// Horizontal frame e_i - A_i^a e_a: rho_i = d/dx^i, [e_i, e_j] = -F^c_ij e_c, [e_i, e_b] = -A_i^a c^c_ab e_c,
/// [e_a, e_b] = c^c_ab e_c.
BlockParts build_atiyah(BuildWorkspace& work, const AlgebroidBlock& block)
{
    Graph& graph = work.graph();
    const std::size_t n = block.base.size();
    BlockParts parts;
    parts.C = structure_constants(block, n, block.fibre.size() - n);
    const AtiyahData data = atiyah_data(work, block, parts);
    for (std::size_t i = 0; i < n; ++i) parts.rho.push_back({block.base[i], i, number(1, block.where), block.where});
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = i + 1; j < n; ++j) {
            const std::vector<NodeId> F = curvature(work, block, data, i, j);
            for (std::size_t c = 0; c < data.g; ++c)
                work.append_structure(parts, n + c, i, j, graph.negate(F[c]), block.where);
        }
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t b = 0; b < data.g; ++b) {
            std::vector<std::vector<NodeId>> terms(data.g);
            for (std::size_t a = 0; a < data.g; ++a)
                for (const ColumnEntry& entry : data.c[a * data.g + b])
                    terms[entry.index].push_back(graph.multiply(data.potential(i, a), entry.value));
            for (std::size_t c = 0; c < data.g; ++c)
                work.append_structure(parts, n + c, i, n + b, graph.negate(graph.sum(terms[c])), block.where);
        }
    return parts;
}

} // namespace lagen
