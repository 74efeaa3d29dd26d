// SPDX-License-Identifier: GPL-2.0-or-later
/// The [algebroid] block: its kinds, files and bases first (the fibre's default names depend on them), its entries
/// later. From drafts to blocks: sections and base coordinates get their numbers, blocks of files theirs in this model.
#include "model/algebroid_draft.hpp"

#include "expression/rewrite.hpp"
#include "model/complaints.hpp"
#include "model/families.hpp"
#include "model/plain_names.hpp"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <numeric>

namespace lagen {

namespace {

constexpr std::size_t deepest_nesting = 16;

AlgebroidDraft draft_file(ModelReader& reader, const TomlValue& of)
{
    AlgebroidDraft draft;
    draft.included = include_model(reader, of);
    const Model& model = reader.included[draft.included].model;
    if (is_nonholonomic(model))
        throw ModelError(fmt::format("the model '{}' is nonholonomic: its constraint is no Lie algebroid", model.name),
                         of.where, "give the ambient algebroid of its file");
    draft.title = model.file->name;
    draft.where = of.where;
    return draft;
}

void draft_inner(ModelReader& reader, AlgebroidDraft& draft, const Item& of, std::size_t depth)
{
    if (!of) return;
    const bool product = draft.kind == AlgebroidKind::product;
    if (depth >= deepest_nesting)
        throw ModelError(fmt::format("algebroids are nested more than {} deep", deepest_nesting), of.where());
    if (product ? !of.is(TomlKind::array) || of.value().items.empty() : of.is(TomlKind::array))
        throw complain::is_not(of.title(),
                               of.value().items.empty() && of.is(TomlKind::array) ? "an empty array"
                                                                                  : kind_text(of.value().kind),
                               product ? "a list of files" : "the name of a file or a table", of.value().where);
    if (of.is(TomlKind::string))
        draft.of.push_back(draft_file(reader, of.value()));
    else if (of.is(TomlKind::table))
        draft.of.push_back(draft_table(reader, of, depth + 1));
    for (const TomlValue& item : of.value().items) draft.of.push_back(draft_file(reader, item));
}

} // namespace

AlgebroidDraft draft_table(ModelReader& reader, const Item& table, std::size_t depth)
{
    AlgebroidDraft draft;
    draft.table = table;
    draft.title = table.title();
    draft.where = table.where();
    draft.outermost = depth == 0;
    const Item kind = table.at("kind");
    draft.kind = static_cast<AlgebroidKind>(place_of_kind("algebroid", kind ? kind.text() : "general"));
    if (depth > 0 && draft.kind == AlgebroidKind::nonholonomic)
        throw ModelError(fmt::format("{} is nonholonomic: its constraint is no Lie algebroid", draft.title),
                         draft.where, "give all constraints in [algebroid]");
    draft.fibre = read_names(reader, table.at("fibre"));
    draft.momenta = read_names(reader, table.at("momenta"));
    draft.dual = table.at("bundle") && table.at("bundle").text() == "E*";
    if (draft.kind == AlgebroidKind::nonholonomic && table.at("drift") && !table.at("sections"))
        throw complain::beside("'drift'", "'constraints' alone", table.at("drift").where(),
                               "the constraints say what the drift is; 'sections' leave it open");
    draft_inner(reader, draft, table.at("of"), depth);
    return draft;
}

namespace {

/// The names that the file gives to the fibre; empty where it gives none.
std::vector<Symbol> names_of_fibre(const ModelReader& reader, const AlgebroidDraft& draft)
{
    return draft.outermost ? read_names(reader, reader.at("fibre").at("coordinates")) : draft.fibre;
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
        if (std::ranges::find(kept, place) != kept.end()) throw complain::names_twice("[fibre]", name.name, name.where);
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
    if (draft.kind == AlgebroidKind::level_set) make_level_set(reader, draft);
    for (AlgebroidDraft& inner : draft.of) make_level_sets(reader, inner);
}

namespace {

using Places = std::vector<std::size_t>;

/// Numbers of the file's base coordinates become numbers of the model's.
void move_block(AlgebroidBlock& block, const Places& base)
{
    const auto move = [&](std::size_t& i) { i = base.at(i); };
    for (std::size_t& i : block.base) move(i);
    for (std::size_t& i : block.over) move(i);
    for (AnchorEntry& entry : block.anchor) move(entry.coordinate);
    for (ConnectionEntry& entry : block.connection) move(entry.coordinate);
    for (AlgebroidBlock& inner : block.of) move_block(inner, base);
}

/// New names in the entries of a block.
void rename_block(AlgebroidBlock& block, const std::map<std::string, Tree>& names)
{
    const auto rename = [&](Tree& value) { value = replace_names(value, names); };
    for (AnchorEntry& entry : block.anchor) rename(entry.value);
    for (BracketEntry& entry : block.bracket) rename(entry.value);
    for (SectionEntry& entry : block.sections) rename(entry.value);
    for (ConnectionEntry& entry : block.connection) rename(entry.value);
    for (ArrayValue& matrix : block.representation)
        for (Tree& entry : matrix.entries) rename(entry);
    for (AlgebroidBlock& inner : block.of) rename_block(inner, names);
}

AlgebroidBlock block_of_file(const ModelReader& reader, const AlgebroidDraft& draft)
{
    const IncludedModel& included = reader.included[draft.included];
    AlgebroidBlock block = included.model.algebroid;
    block.fibre = included.model.fibre.coordinates;
    block.where = draft.where;
    move_block(block, included.base);
    if (!included.renamed.empty()) rename_block(block, included.renamed);
    return block;
}

/// Throws ModelError where the fibre has not as many coordinates as the kind requires.
void require_fibre_of_kind(const AlgebroidBlock& block, std::size_t found, const std::string& things,
                           const SourceRange& where)
{
    const std::optional<RequiredRank> rank = required_rank(block);
    if (!rank || rank->fits(found)) return;
    const char* hint = block.kind == AlgebroidKind::tangent ? "one a moving base coordinate, in the order of those"
                       : block.kind == AlgebroidKind::nonholonomic
                           ? "as many sections as the ambient algebroid has are a frame: kind = \"frame\""
                       : block.kind == AlgebroidKind::frame
                           ? "a frame has as many sections as the algebroid that it frames"
                           : "";
    throw complain::wrong_number(things, found, rank->reason, rank->text(), where, hint);
}

Places first_places(std::size_t count)
{
    Places out(count);
    std::iota(out.begin(), out.end(), std::size_t{0});
    return out;
}

} // namespace

std::string with_sizes(const std::string& algebra, const std::vector<Size>& sizes)
{
    const auto in_name = [&](std::size_t k) {
        return k < algebra.size() && (std::isalnum(static_cast<unsigned char>(algebra[k])) != 0 || algebra[k] == '_');
    };
    std::string out;
    for (std::size_t k = 0; k < algebra.size();) {
        std::size_t end = k;
        while (in_name(end)) ++end;
        const std::string word = algebra.substr(k, std::max<std::size_t>(end - k, 1));
        const auto size = std::find_if(sizes.begin(), sizes.end(), [&](const Size& each) { return each.name == word; });
        const bool stands_for_number = k > 0 && (algebra[k - 1] == '(' || algebra[k - 1] == '^');
        out += size != sizes.end() && stands_for_number ? std::to_string(size->value) : word;
        k += word.size();
    }
    return out;
}

AlgebroidBlock make_block(const ModelReader& reader, const AlgebroidDraft& draft, std::size_t leaf_size)
{
    if (!draft.kind) return block_of_file(reader, draft);
    const std::vector<Symbol>& all = reader.model.base.coordinates;
    const std::vector<Symbol> leaf_base(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(leaf_size));
    const DraftSpace space = space_of(reader, draft, leaf_base);
    AlgebroidBlock block;
    block.kind = *draft.kind;
    block.fibre = space.fibre;
    block.base = first_places(space.base.size());
    block.dual = draft.dual;
    block.where = draft.where;
    for (const AlgebroidDraft& inner : draft.of) block.of.push_back(make_block(reader, inner, leaf_size));
    if (block.kind == AlgebroidKind::tangent) block.over = read_over(draft.table.at("over"), space.base);
    block.anchor = draft.level_set.anchor;
    if (block.kind == AlgebroidKind::groupoid) block.rank = rank_of(*reader.model.groupoid, space.base.size());
    if (const Item algebra = draft.table.at("algebra")) {
        block.algebra = with_sizes(algebra.text(), reader.model.sizes);
        block.algebra_where = algebra.value().where;
    }
    if (!draft.outermost)
        require_fibre_of_kind(block, block.fibre.size(), "fibre coordinates of " + draft.title, block.where);
    return block;
}

bool RequiredRank::fits(std::size_t rank) const
{
    return at_least ? rank >= least : at_most ? rank <= least : rank == least;
}

std::string RequiredRank::text() const
{
    return at_least || at_most ? fmt::format("at {} {}", at_least ? "least" : "most", least) : std::to_string(least);
}

std::optional<RequiredRank> required_rank(const AlgebroidBlock& block)
{
    const auto inner_rank = [&](std::size_t k) { return block.of.at(k).fibre.size(); };
    switch (block.kind) {
    case AlgebroidKind::tangent: return RequiredRank{block.over.size(), false, "a tangent bundle"};
    case AlgebroidKind::atiyah: return RequiredRank{block.base.size(), true, "an Atiyah algebroid"};
    case AlgebroidKind::frame: return RequiredRank{inner_rank(0), false, "a frame of the inner algebroid"};
    case AlgebroidKind::prolongation: return RequiredRank{2 * inner_rank(0), false, "the prolongation"};
    case AlgebroidKind::groupoid: return RequiredRank{block.rank, false, "the groupoid"};
    case AlgebroidKind::nonholonomic:
        return RequiredRank{inner_rank(0) == 0 ? 0 : inner_rank(0) - 1, false, "a nonholonomic constraint", true};
    case AlgebroidKind::product: {
        std::size_t rank = 0;
        for (const AlgebroidBlock& factor : block.of) rank += factor.fibre.size();
        return RequiredRank{rank, false, "the product"};
    }
    default: return std::nullopt;
    }
}

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

} // namespace

void read_algebroid_kind(ModelReader& reader)
{
    const Item block = reader.at("algebroid");
    const std::optional<GroupoidBlock>& groupoid = reader.model.groupoid;
    if (!block && !groupoid)
        throw ModelError("the model has no [algebroid] block", SourceRange{reader.model.file, 0, 0},
                         "for an ordinary mechanical system: [algebroid] kind = \"tangent\"");
    auto draft = std::make_shared<AlgebroidDraft>();
    if (block && !reader.is_tangent) {
        *draft = draft_table(reader, block, 0);
    } else {
        draft->title = block ? "[algebroid]" : "[groupoid]";
        draft->where = block ? block.where() : groupoid->where;
        draft->kind = block || groupoid->kind == GroupoidKind::pair ? AlgebroidKind::tangent : AlgebroidKind::groupoid;
        draft->outermost = true;
    }
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
    require_fibre_of_kind(reader.model.algebroid, reader.model.fibre.coordinates.size(), "fibre coordinates", where);
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
