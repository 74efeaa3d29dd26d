// SPDX-License-Identifier: GPL-2.0-or-later
/// The [algebroid] block: its kinds, files and bases first (the fibre's default names depend on them), its entries
/// later.
#include "model/algebroid_draft.hpp"

#include "model/families.hpp"

#include <fmt/format.h>

namespace lagen {

namespace {

/// The fibres of the factors of a product are parts of the product's, under its names.
void share_out_fibre(AlgebroidBlock& block)
{
    if (block.kind != AlgebroidKind::product) return;
    auto next = block.fibre.begin();
    for (AlgebroidBlock& factor : block.of)
        for (Symbol& symbol : factor.fibre) symbol = *next++;
}

void share_out_fibres(AlgebroidBlock& block)
{
    share_out_fibre(block);
    for (AlgebroidBlock& inner : block.of) share_out_fibres(inner);
}

/// Tables that a kind cannot do without.
void require_tables(const AlgebroidDraft& draft)
{
    if (draft.kind == nullptr) return;
    const auto require = [&](AlgebroidKind kind, const char* key, const char* hint) {
        if (draft.kind->kind != kind || find_entry(*draft.table, key) != nullptr) return;
        throw ModelError(fmt::format("an algebroid of kind '{}' needs '{}'", draft.kind->name, key), draft.where, hint);
    };
    require(AlgebroidKind::subbundle, "spanned_by", "spanned_by = { a = { x = \"..\" } }, a line a section");
    require(AlgebroidKind::frame, "sections", "sections = { a = { b = \"..\" } } for e'_a = .. e_b");
    require_distribution(draft);
    for (const AlgebroidDraft& inner : draft.of) require_tables(inner);
}

} // namespace

void read_algebroid_kind(ModelReader& reader, const TomlEntry* block)
{
    if (block == nullptr && !reader.model.groupoid) {
        throw ModelError("the model has no [algebroid] block", SourceRange{reader.model.file, 0, 0},
                         "for an ordinary mechanical system: [algebroid] kind = \"tangent\"");
    }
    auto draft = std::make_shared<AlgebroidDraft>(block == nullptr
                                                      ? draft_of_groupoid(*reader.groupoid, reader.model.groupoid->kind)
                                                  : reader.is_tangent ? draft_of_tangent(*block)
                                                                      : draft_algebroid(reader, *block));
    require_tables(*draft);
    make_level_sets(reader, *draft);
    const std::size_t leaf_size = declare_inner_base(reader, *draft);
    merge_included(reader);
    reader.model.algebroid = make_block(reader, *draft, leaf_size);
    reader.draft = std::move(draft);
}

std::optional<std::vector<Symbol>> default_fibre(const ModelReader& reader)
{
    const AlgebroidBlock& block = reader.model.algebroid;
    switch (block.kind) {
    case AlgebroidKind::tangent:
    case AlgebroidKind::prolongation:
    case AlgebroidKind::product: return block.fibre;
    case AlgebroidKind::level_set:
        if (reader.draft->level_set.kept.empty()) return std::nullopt;
        return kept_velocities(coordinates_at(reader.model, reader.draft->level_set.kept), reader.model);
    default: return std::nullopt;
    }
}

void require_rank(const ModelReader& reader, const SourceRange& where)
{
    const std::size_t found = reader.model.fibre.coordinates.size();
    const std::optional<RequiredRank> rank = required_rank(reader.model.algebroid);
    if (!rank || rank->fits(found)) return;
    if (reader.model.algebroid.kind == AlgebroidKind::tangent) {
        throw ModelError(fmt::format("the number of fibre coordinates is {}, where a tangent bundle needs one a moving "
                                     "base coordinate: {}",
                                     found, rank->text()),
                         where, "fibre coordinates stand in the order of the base coordinates");
    }
    const bool nonholonomic = is_nonholonomic(reader.model);
    const bool frame = reader.model.algebroid.kind == AlgebroidKind::frame;
    const char* hint = nonholonomic ? "as many sections as the ambient algebroid has are a frame: kind = \"frame\""
                       : frame      ? "a frame has as many sections as the algebroid that it frames"
                                    : "";
    throw ModelError(
        fmt::format("the number of fibre coordinates is {}, where {} needs {}", found, rank->reason, rank->text()),
        where, hint);
}

void read_algebroid(ModelReader& reader)
{
    AlgebroidBlock& block = reader.model.algebroid;
    block.fibre = reader.model.fibre.coordinates;
    share_out_fibres(block);
    note_fibre_names(reader, *reader.draft, block, false);
    inherit_definitions(reader);
    read_entries(reader, block, *reader.draft);
    define_rates(reader);
    read_distribution(reader, block, *reader.draft);
    define_inner_velocities(reader);
    inherit_mechanics(reader);
}

} // namespace lagen
