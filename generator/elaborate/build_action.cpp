// SPDX-License-Identifier: GPL-2.0-or-later
/// Actions and Atiyah algebroids: rho and C from structure constants of a Lie algebra.
#include "elaborate/build_workspace.hpp"

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

/// TM x g over the block's base: sections d/dx^i, then those of g.
Algebroid trivial_algebroid(BuildWorkspace& work, const AlgebroidBlock& block, const BlockParts& constants)
{
    Algebroid trivial = work.lowered(block, constants);
    for (std::size_t i = 0; i < block.base.size(); ++i) trivial.anchor[i] = {{block.base[i], work.graph().constant(1)}};
    return trivial;
}

/// The frame of TM x g: e_i - A_i^c e_c, then the sections e_c of g.
std::vector<Section> horizontal_frame(BuildWorkspace& work, const AlgebroidBlock& block)
{
    Graph& graph = work.graph();
    std::vector<Section> frame;
    for (std::size_t a = 0; a < block.fibre.size(); ++a) frame.push_back(basis_section(graph, a));
    for (const ConnectionEntry& entry : block.connection)
        for (std::size_t i = 0; i < block.base.size(); ++i)
            if (block.base[i] == entry.coordinate)
                frame[i] = difference(graph, frame[i], {{entry.section, work.lower(entry.value)}});
    return frame;
}

} // namespace

/// The horizontal frame of TM x g: rho_i = d/dx^i, [e_i, e_j] = -F^c_ij e_c, [e_i, e_b] = -A_i^a c^c_ab e_c,
/// [e_a, e_b] = c^c_ab e_c. Brackets are vertical, and the vertical sections those of g: their components are those in
/// TM x g.
BlockParts build_atiyah(BuildWorkspace& work, const AlgebroidBlock& block)
{
    const std::size_t n = block.base.size();
    BlockParts parts;
    parts.C = structure_constants(block, n, block.fibre.size() - n);
    const Algebroid trivial = trivial_algebroid(work, block, parts);
    const std::vector<Section> frame = horizontal_frame(work, block);
    for (std::size_t i = 0; i < n; ++i) parts.rho.push_back({block.base[i], i, number(1, block.where), block.where});
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t b = i + 1; b < frame.size(); ++b)
            for (const ColumnEntry& C : bracket(work.gradients(), trivial, frame[i], frame[b]))
                work.append_structure(parts, C.index, i, b, C.value, block.where);
    return parts;
}

} // namespace lagen
