// SPDX-License-Identifier: GPL-2.0-or-later
/// The algebroid block of a model as sparse anchor and structure functions.
#include "elaborate/build_algebroid.hpp"

#include "elaborate/build_workspace.hpp"
#include "geometry/named_algebra.hpp"
#include "model/complaints.hpp"
#include "text/comma_list.hpp"

#include <algorithm>
#include <set>

namespace lagen {
namespace {

/// The Lie algebra that was meant by "SO(5)", "so5" or "R3", or nearly by another name; empty where none is near.
std::string algebra_meant(std::string name)
{
    const std::size_t letters = std::min(name.find_first_of("0123456789"), name.size());
    const std::string digits = name.substr(letters);
    const std::string space = name.substr(0, letters) + "^" + digits;
    const std::string wanted = name;
    for (char& c : name)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    for (const std::string& candidate : {name, name.substr(0, letters) + "(" + digits + ")", space})
        if (named_algebra(candidate)) return candidate;
    return nearest_name(wanted, named_algebra_names());
}

std::vector<StructureValue> named_constants(const AlgebroidBlock& block, std::size_t first, std::size_t rank)
{
    const std::optional<NamedAlgebra> algebra = named_algebra(block.algebra);
    if (!algebra) {
        const std::string near = algebra_meant(block.algebra);
        throw ModelError("there is no Lie algebra called \"" + block.algebra + "\" of rank at most " +
                             std::to_string(named_algebra_rank_limit),
                         block.algebra_where,
                         (near.empty() ? std::string() : "did you mean \"" + near + "\"? ") + "known are " +
                             comma_list(named_algebra_names()) + ", the last three with any number, and sums A + B");
    }
    if (algebra->basis.size() != rank) {
        const bool atiyah = block.kind == AlgebroidKind::atiyah;
        throw ModelError("the Lie algebra " + algebra->name + " has rank " + std::to_string(algebra->basis.size()) +
                             ", where the number of" + (atiyah ? " vertical" : "") + " fibre coordinates is " +
                             std::to_string(rank),
                         block.algebra_where, "give [fibre] one coordinate for each basis element");
    }
    std::vector<StructureValue> constants;
    for (const StructureConstant& entry : algebra->constants)
        constants.push_back({entry.c + first, entry.a + first, entry.b + first,
                             number(entry.value, block.algebra_where), block.algebra_where});
    return constants;
}

/// rho(e_a) = d/dx^{over[a]}
BlockParts build_tangent(const AlgebroidBlock& block)
{
    if (block.over.size() != block.fibre.size())
        throw ModelError("the tangent algebroid has " + std::to_string(block.over.size()) +
                             " moving base coordinates, but the fibre has " + std::to_string(block.fibre.size()),
                         block.where, "give [fibre] one coordinate for each base coordinate that moves");
    BlockParts parts;
    for (std::size_t a = 0; a < block.over.size(); ++a)
        parts.rho.push_back({block.over[a], a, number(1, block.where), block.where});
    return parts;
}

/// Sections of the factors one after another; sections of different factors commute.
BlockParts build_product(BuildWorkspace& work, const AlgebroidBlock& block)
{
    BlockParts parts;
    std::size_t first = 0;
    std::set<std::size_t> base;
    for (const AlgebroidBlock& factor : block.of) {
        const BlockParts inner = build_block(work, factor);
        work.require_own_base(factor, inner);
        for (const std::size_t i : factor.base)
            if (!base.insert(i).second) work.forget_construction();
        for (AnchorValue entry : inner.rho) {
            entry.a += first;
            parts.rho.push_back(std::move(entry));
        }
        for (const StructureValue& entry : inner.C)
            parts.C.push_back({entry.c + first, entry.a + first, entry.b + first, entry.value, entry.where});
        first += factor.fibre.size();
    }
    return parts;
}

} // namespace

std::vector<StructureValue> structure_constants(const AlgebroidBlock& block, std::size_t first, std::size_t rank)
{
    if (!block.algebra.empty()) return named_constants(block, first, rank);
    std::vector<StructureValue> constants;
    for (const BracketEntry& entry : block.bracket)
        constants.push_back({entry.c, entry.a, entry.b, entry.value, entry.where});
    return constants;
}

BlockParts build_given(const AlgebroidBlock& block)
{
    BlockParts parts;
    for (const AnchorEntry& entry : block.anchor)
        parts.rho.push_back({entry.coordinate, entry.section, entry.value, entry.where});
    parts.C = structure_constants(block, 0, block.fibre.size());
    return parts;
}

namespace {

/// What is made of no other algebroid.
BlockParts build_leaf(BuildWorkspace& work, const AlgebroidBlock& block)
{
    switch (block.kind) {
    case AlgebroidKind::tangent: return build_tangent(block);
    case AlgebroidKind::action: return build_action(work, block);
    case AlgebroidKind::subbundle: return build_subbundle(work, block);
    case AlgebroidKind::atiyah: return build_atiyah(work, block);
    case AlgebroidKind::groupoid: return build_of_groupoid(work, block);
    default: return build_given(block);
    }
}

} // namespace

BlockParts build_block(BuildWorkspace& work, const AlgebroidBlock& block)
{
    if (block.kind == AlgebroidKind::frame) return build_frame(work, block, build_block(work, block.of.at(0)));
    if (block.kind == AlgebroidKind::product) return build_product(work, block);
    if (block.kind == AlgebroidKind::prolongation) {
        const BlockParts inner = build_block(work, block.of.at(0));
        work.require_own_base(block.of[0], inner);
        return build_prolongation(block, inner);
    }
    BlockParts parts = build_leaf(work, block);
    work.rest_on(block, parts);
    return parts;
}

WrittenAlgebroid build_algebroid(const Model& model)
{
    AlgebroidBlock block = is_nonholonomic(model) ? model.algebroid.of[0] : model.algebroid;
    block.fibre = ambient_fibre(model);
    BuildWorkspace work(model);
    BlockParts parts = build_block(work, block);
    WrittenAlgebroid algebroid;
    algebroid.base = model.base.coordinates;
    algebroid.fibre = ambient_fibre(model);
    for (const Parameter& parameter : model.parameters)
        if (!parameter.bound) algebroid.parameters.push_back(parameter.symbol.name);
    algebroid.rho = std::move(parts.rho);
    algebroid.C = std::move(parts.C);
    algebroid.constraints = model.base.constraints;
    algebroid.domain = model.base.domain;
    algebroid.construction = work.take_construction();
    return algebroid;
}

Algebroid lower_algebroid(Graph& graph, Lowering& lower, const WrittenAlgebroid& written)
{
    std::vector<NodeId> x, y;
    for (const Symbol& symbol : written.base) x.push_back(graph.input(symbol.name));
    AlgebroidBuilder builder(graph, std::move(x), written.r());
    for (const AnchorValue& entry : written.rho) builder.add_anchor(entry.i, entry.a, lower(entry.value));
    for (const StructureValue& entry : written.C) builder.add_bracket(entry.c, entry.a, entry.b, lower(entry.value));
    for (const Symbol& symbol : written.fibre) y.push_back(graph.input(symbol.name));
    return builder.finish(std::move(y));
}

// Actions and Atiyah algebroids: rho and C from structure constants of a Lie algebra.

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
