// SPDX-License-Identifier: GPL-2.0-or-later
/// The algebroid block of a model as sparse anchor and structure functions.
#include "geometry/algebroid.hpp"
#include "geometry/named_algebra.hpp"

namespace lagen {
namespace {

std::string list_of(const std::vector<std::string>& names)
{
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
}

void take_bracket(Algebroid& algebroid, const AlgebroidBlock& block)
{
    for (const BracketEntry& entry : block.bracket)
        algebroid.C.push_back({entry.c, entry.a, entry.b, entry.value, entry.where});
}

void take_anchor(Algebroid& algebroid, const AlgebroidBlock& block)
{
    for (const AnchorEntry& entry : block.anchor)
        algebroid.rho.push_back({entry.coordinate, entry.section, entry.value, entry.where});
}

/// C from the table of named algebras. Throws ModelError for an unknown name and for a fibre of another rank.
void take_named_algebra(Algebroid& algebroid, const AlgebroidBlock& block)
{
    const std::optional<NamedAlgebra> algebra = named_algebra(block.algebra);
    if (!algebra) {
        const std::string near = nearest_name(block.algebra, named_algebra_names());
        throw ModelError("there is no Lie algebra called \"" + block.algebra + "\" of rank at most " +
                             std::to_string(named_algebra_rank_limit),
                         block.algebra_where,
                         (near.empty() ? std::string() : "did you mean \"" + near + "\"? ") + "known are " +
                             list_of(named_algebra_names()) + " and sums A + B");
    }
    if (algebra->basis.size() != algebroid.r())
        throw ModelError("the Lie algebra " + algebra->name + " has rank " + std::to_string(algebra->basis.size()) +
                             ", but the fibre has " + std::to_string(algebroid.r()) + " coordinates",
                         block.algebra_where, "give [fibre] one coordinate for each basis element");
    for (const StructureConstant& entry : algebra->constants)
        algebroid.C.push_back(
            {entry.c, entry.a, entry.b, number(entry.value, block.algebra_where), block.algebra_where});
}

/// rho(e_a) = d/dx^{over[a]}
void take_tangent(Algebroid& algebroid, const AlgebroidBlock& block)
{
    if (block.over.size() != algebroid.r())
        throw ModelError("the tangent algebroid has " + std::to_string(block.over.size()) +
                             " moving base coordinates, but the fibre has " + std::to_string(algebroid.r()),
                         block.where, "give [fibre] one coordinate for each base coordinate that moves");
    for (std::size_t a = 0; a < block.over.size(); ++a)
        algebroid.rho.push_back({block.over[a], a, number(1, block.where), block.where});
}

} // namespace

Algebroid build_algebroid(const Model& model)
{
    const AlgebroidBlock& block = model.algebroid;
    Algebroid algebroid;
    algebroid.base = model.base.coordinates;
    algebroid.fibre = model.fibre.coordinates;
    for (const Parameter& parameter : model.parameters) algebroid.parameters.push_back(parameter.symbol.name);
    algebroid.constraints = model.base.constraints;
    algebroid.domain = model.base.domain;
    if (block.kind == AlgebroidKind::tangent) {
        take_tangent(algebroid, block);
        return algebroid;
    }
    take_anchor(algebroid, block);
    if (block.algebra.empty())
        take_bracket(algebroid, block);
    else
        take_named_algebra(algebroid, block);
    return algebroid;
}

} // namespace lagen
