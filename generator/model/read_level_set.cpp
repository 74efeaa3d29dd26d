// SPDX-License-Identifier: GPL-2.0-or-later
/// kind = "level_set": the tangent space of the base constraints. Which sections span it is found by who knows
/// geometry; which coordinates they are the velocities of, the names of the fibre say: "v_x" keeps x.
#include "model/algebroid_draft.hpp"

#include "model/families.hpp"
#include "model/plain_names.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace lagen {

namespace {

/// The names that the file gives to the fibre; empty where it gives none.
std::vector<Symbol> names_of_fibre(const ModelReader& reader, const AlgebroidDraft& draft)
{
    if (!draft.outermost || reader.fibre == nullptr) return draft.fibre;
    const TomlEntry* entry = find_entry(reader.fibre->value, "coordinates");
    return entry != nullptr ? read_names(reader, *entry, "'coordinates' of [fibre]") : std::vector<Symbol>{};
}

/// The coordinates whose velocities these are; empty where all names are others.
std::vector<std::size_t> kept_by(const std::vector<Symbol>& names, const Model& model)
{
    const std::vector<Symbol>& coordinates = model.base.coordinates;
    const std::vector<Symbol> velocities = kept_velocities(coordinates, model);
    std::vector<std::size_t> kept;
    const Symbol* other = nullptr;
    for (const Symbol& name : names) {
        const std::size_t place = index_of(velocities, name.name);
        if (std::ranges::find(kept, place) != kept.end())
            throw ModelError(fmt::format("[fibre] names '{}' twice", name.name), name.where);
        if (place == coordinates.size())
            other = &name;
        else
            kept.push_back(place);
    }
    if (other != nullptr && !kept.empty())
        throw ModelError(fmt::format("the fibre of the level set has '{}', the velocity of '{}', beside '{}', which is "
                                     "the velocity of no base coordinate",
                                     velocities[kept[0]].name, coordinates[kept[0]].name, other->name),
                         other->where, "the velocities of the coordinates that are kept, or names of your own alone");
    return kept;
}

void make_level_set(ModelReader& reader, AlgebroidDraft& draft)
{
    const std::vector<Symbol> names = names_of_fibre(reader, draft);
    LevelSetRequest request;
    request.where = names.empty() ? draft.where : names.front().where;
    request.kept = kept_by(names, reader.model);
    if (!names.empty()) request.sections = names.size();
    draft.level_set = frame_of_level_set(reader, request);
    reader.own_constraints = draft.level_set.constraints;
    if (names.empty() && !draft.outermost)
        draft.fibre = kept_velocities(coordinates_at(reader.model, draft.level_set.kept), reader.model);
}

} // namespace

std::vector<Symbol> kept_velocities(const std::vector<Symbol>& coordinates, const Model& model)
{
    const std::vector<std::string> words = plain_names(names_of(coordinates), names_of(model.base.coordinates));
    std::vector<Symbol> out;
    for (std::size_t k = 0; k < words.size(); ++k)
        out.push_back(Symbol{"v_" + words[k], coordinates[k].where, {}, {}, {}});
    return out;
}

void make_level_sets(ModelReader& reader, AlgebroidDraft& draft)
{
    if (draft.kind != nullptr && draft.kind->kind == AlgebroidKind::level_set) make_level_set(reader, draft);
    for (AlgebroidDraft& inner : draft.of) make_level_sets(reader, inner);
}

} // namespace lagen
