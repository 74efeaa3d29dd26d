// SPDX-License-Identifier: GPL-2.0-or-later
/// The [algebroid] block: its kinds, files and bases first (the fibre's default names depend on them), its entries
/// later. From drafts to blocks: sections and base coordinates get their numbers, blocks of files theirs in this model.
/// Base and fibre coordinates of nested algebroids: which the model's [base] declares, which come from files, and which
/// prolongations add.
#include "expression/rewrite.hpp"
#include "model/algebroid_draft.hpp"
#include "model/complaints.hpp"
#include "model/families.hpp"
#include "model/plain_names.hpp"
#include "text/comma_list.hpp"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <numeric>

namespace lagen {

namespace {

/// The coordinates of a draft's total space.
struct DraftSpace {
    std::vector<Symbol> base, fibre, momenta;
};

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

/// Reads kinds and files of a table and of the tables and files inside it; `depth` 0: the outermost. Throws ModelError.
AlgebroidDraft draft_table(ModelReader& reader, const Item& table, std::size_t depth)
{
    AlgebroidDraft draft;
    draft.table = table;
    draft.title = table.title();
    draft.where = table.where();
    draft.outermost = depth == 0;
    const Item kind = table.at("kind"), of = table.at("of");
    draft.kind = static_cast<AlgebroidKind>(place_of_kind("algebroid", kind ? kind.text() : "general"));
    if (depth > 0 && draft.kind == AlgebroidKind::nonholonomic)
        throw ModelError(fmt::format("{} is nonholonomic: its constraint is no Lie algebroid", draft.title),
                         draft.where, "give all constraints in [algebroid]");
    draft.fibre = read_names(reader, table.at("fibre"));
    draft.momenta = read_names(reader, table.at("momenta"));
    draft.dual = table.at("bundle") && table.at("bundle").text() == "E*";
    if (!of) return draft;
    if (depth >= deepest_nesting)
        throw ModelError(fmt::format("algebroids are nested more than {} deep", deepest_nesting), of.where());
    const bool product = draft.kind == AlgebroidKind::product, none = of.value().items.empty();
    if (product ? none : of.is(TomlKind::array))
        throw complain::is_not(of.title(),
                               none && of.is(TomlKind::array) ? "an empty array" : kind_text(of.value().kind),
                               product ? "a list of files" : "the name of a file or a table", of.value().where);
    if (of.is(TomlKind::string)) draft.of.push_back(draft_file(reader, of.value()));
    if (of.is(TomlKind::table)) draft.of.push_back(draft_table(reader, of, depth + 1));
    for (const TomlValue& item : of.value().items) draft.of.push_back(draft_file(reader, item));
    return draft;
}

/// The names that the file gives to the fibre; empty where it gives none.
std::vector<Symbol> names_of_fibre(const ModelReader& reader, const AlgebroidDraft& draft)
{
    return draft.outermost ? read_names(reader, reader.at("fibre").at("coordinates")) : draft.fibre;
}

/// "v_x" for each of these coordinates of the model; for x[1,2], whose family need not be whole, "v_x_1_2".
std::vector<Symbol> kept_velocities(const std::vector<Symbol>& coordinates, const Model& model)
{
    const std::vector<std::string> words = plain_names(names_of(coordinates), names_of(model.base.coordinates));
    std::vector<Symbol> out;
    for (std::size_t k = 0; k < words.size(); ++k)
        out.push_back(Symbol{"v_" + words[k], coordinates[k].where, {}, {}, {}});
    return out;
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
    if (names.empty())
        draft.fibre = kept_velocities(entries_at(reader.model.base.coordinates, draft.level_set.kept), reader.model);
}

/// Has the frames of level sets made, and names the fibre of one that leaves it out. Throws ModelError.
void make_level_sets(ModelReader& reader, AlgebroidDraft& draft)
{
    if (draft.kind == AlgebroidKind::level_set) make_level_set(reader, draft);
    for (AlgebroidDraft& inner : draft.of) make_level_sets(reader, inner);
}

/// Numbers of the file's base coordinates become numbers of the model's, and its names those that the model has.
void adapt(AlgebroidBlock& block, const IncludedModel& file)
{
    const auto move = [&](std::size_t& i) { i = file.base.at(i); };
    const auto rename = [&](Tree& value) {
        if (!file.renamed.empty()) value = replace_names(value, file.renamed);
    };
    std::ranges::for_each(block.base, move);
    std::ranges::for_each(block.over, move);
    for (AnchorEntry& entry : block.anchor) move(entry.coordinate), rename(entry.value);
    for (ConnectionEntry& entry : block.connection) move(entry.coordinate), rename(entry.value);
    for (BracketEntry& entry : block.bracket) rename(entry.value);
    for (SectionEntry& entry : block.sections) rename(entry.value);
    for (ArrayValue& matrix : block.representation) std::ranges::for_each(matrix.entries, rename);
    for (AlgebroidBlock& inner : block.of) adapt(inner, file);
}

AlgebroidBlock block_of_file(const ModelReader& reader, const AlgebroidDraft& draft)
{
    const IncludedModel& included = reader.included[draft.included];
    AlgebroidBlock block = included.model.algebroid;
    block.fibre = included.model.fibre.coordinates;
    block.where = draft.where;
    adapt(block, included);
    return block;
}

/// How many sections the kind of a block asks for.
struct RequiredRank {
    const char* who = "";
    std::size_t least = 0, most = 0;
    const char* hint = "";
};

std::optional<RequiredRank> required_rank(const AlgebroidBlock& block)
{
    std::size_t inner = 0;
    for (const AlgebroidBlock& each : block.of) inner += each.fibre.size();
    const auto exactly = [](const char* who, std::size_t rank, const char* hint = "") {
        return RequiredRank{who, rank, rank, hint};
    };
    switch (block.kind) {
    case AlgebroidKind::tangent:
        return exactly("a tangent bundle", block.over.size(), "one a moving base coordinate, in the order of those");
    case AlgebroidKind::atiyah: return RequiredRank{"an Atiyah algebroid", block.base.size(), std::string::npos};
    case AlgebroidKind::frame:
        return exactly("a frame of the inner algebroid", inner,
                       "a frame has as many sections as the algebroid that it frames");
    case AlgebroidKind::prolongation: return exactly("the prolongation", 2 * inner);
    case AlgebroidKind::groupoid: return exactly("the groupoid", block.rank);
    case AlgebroidKind::nonholonomic:
        return RequiredRank{"a nonholonomic constraint", 0, inner == 0 ? 0 : inner - 1,
                            "as many sections as the ambient algebroid has are a frame: kind = \"frame\""};
    case AlgebroidKind::product: return exactly("the product", inner);
    case AlgebroidKind::first_order: return exactly("a system of first order", 0);
    default: return std::nullopt;
    }
}

/// Throws ModelError where the fibre has not as many coordinates as the kind requires.
void require_fibre_of_kind(const AlgebroidBlock& block, std::size_t found, const std::string& things,
                           const SourceRange& where)
{
    const std::optional<RequiredRank> rank = required_rank(block);
    if (!rank || (rank->least <= found && found <= rank->most)) return;
    const std::string wanted = rank->most == std::string::npos ? fmt::format("at least {}", rank->least)
                               : rank->least == rank->most     ? std::to_string(rank->most)
                                                               : fmt::format("at most {}", rank->most);
    throw complain::wrong_number(things, found, rank->who, wanted, where, rank->hint);
}

/// The fibres of the factors of a product are parts of the product's, under its names.
void share_out_fibres(AlgebroidBlock& block)
{
    auto next = block.fibre.begin();
    for (AlgebroidBlock& inner : block.of) {
        for (Symbol& symbol : inner.fibre)
            if (block.kind == AlgebroidKind::product) symbol = *next++;
        share_out_fibres(inner);
    }
}

std::vector<Symbol> with_prefix(const char* prefix, const std::vector<Symbol>& symbols)
{
    return with_names(symbols, [&](const std::string& name) { return prefix + name; });
}

void append(std::vector<Symbol>& list, const std::vector<Symbol>& more)
{
    list.insert(list.end(), more.begin(), more.end());
}

/// The models of the files that a leaf is made of: its own, or those of its factors; none of a table.
std::vector<IncludedModel*> files_of(ModelReader& reader, const AlgebroidDraft& leaf)
{
    std::vector<IncludedModel*> files;
    if (!leaf.kind) files.push_back(&reader.included[leaf.included]);
    for (const AlgebroidDraft& factor : leaf.of) files.push_back(&reader.included[factor.included]);
    return files;
}

/// Coordinates that `over` of a tangent table names, as places in `base`; all where it is left out.
std::vector<std::size_t> read_over(const Item& over, const std::vector<Symbol>& base)
{
    std::vector<std::size_t> out(over ? 0 : base.size());
    std::iota(out.begin(), out.end(), std::size_t{0});
    for (const Excerpt& name : over.texts())
        for (const std::size_t i : require_key(base, name, "'over'", "base coordinate").indices) {
            if (std::ranges::find(out, i) != out.end())
                throw complain::names_twice("'over'", base[i].name, place_of(name));
            out.push_back(i);
        }
    return out;
}

/// Fibre of a table that leaves it out.
std::vector<Symbol> standard_fibre(const AlgebroidDraft& draft, const std::vector<Symbol>& base,
                                   const std::vector<Symbol>& inner_fibre)
{
    switch (*draft.kind) {
    case AlgebroidKind::tangent: {
        std::vector<Symbol> moving;
        for (const std::size_t i : read_over(draft.table.at("over"), base)) moving.push_back(base[i]);
        return velocities_of(moving);
    }
    case AlgebroidKind::prolongation: {
        std::vector<Symbol> fibre = with_prefix("X_", inner_fibre);
        append(fibre, with_prefix(draft.dual ? "P_" : "V_", inner_fibre));
        return fibre;
    }
    default: break;
    }
    if (draft.outermost) return {};
    throw complain::missing(draft.title, {"fibre"}, draft.where,
                            "fibre = [\"y1\", \"y2\"], one a section of the inner frame");
}

/// The space of a draft whose leaf has this base; fibres left out get the names of their kind.
DraftSpace space_of(const ModelReader& reader, const AlgebroidDraft& draft, const std::vector<Symbol>& leaf_base)
{
    if (!draft.kind) {
        const Model& model = reader.included[draft.included].model;
        return {leaf_base, model.fibre.coordinates, model.fibre.momenta};
    }
    DraftSpace space{leaf_base, draft.fibre, draft.momenta};
    std::vector<Symbol> inner_fibre;
    if (*draft.kind == AlgebroidKind::product) {
        for (const AlgebroidDraft& factor : draft.of) {
            const Fibre& fibre = reader.included[factor.included].model.fibre;
            if (draft.fibre.empty()) append(space.fibre, fibre.coordinates);
            if (draft.fibre.empty() && draft.momenta.empty()) append(space.momenta, fibre.momenta);
        }
    } else if (!draft.of.empty()) {
        const DraftSpace inner = space_of(reader, draft.of[0], leaf_base);
        space.base = inner.base;
        inner_fibre = inner.fibre;
        if (*draft.kind == AlgebroidKind::prolongation) append(space.base, draft.dual ? inner.momenta : inner.fibre);
    }
    if (space.fibre.empty()) space.fibre = standard_fibre(draft, space.base, inner_fibre);
    if (space.momenta.empty()) space.momenta = with_prefix("p_", space.fibre);
    if (space.momenta.size() != space.fibre.size())
        throw complain::wrong_number("momenta of " + draft.title, space.momenta.size(), "the fibre", space.fibre.size(),
                                     draft.where);
    return space;
}

bool same_names(const Symbol& a, const Symbol& b)
{
    return a.name == b.name;
}

/// Clashing coordinates of factors are told as such, not as a second declaration.
void require_distinct(const std::vector<IncludedModel*>& factors, std::size_t count)
{
    std::map<std::string, const IncludedModel*> owners;
    for (const IncludedModel* factor : factors)
        for (const Symbol& coordinate : factor->model.base.coordinates)
            if (const auto [at, fresh] = owners.emplace(coordinate.name, factor); !fresh)
                throw ModelError(fmt::format("'{}' is a base coordinate of both {} and {}", coordinate.name,
                                             at->second->model.file->name, factor->model.file->name),
                                 factor->of->where,
                                 fmt::format("rename them: [base] coordinates = [..], all {} in order", count));
}

/// The leaf has its base from [base], where the coordinates that prolongations add may be listed or not.
std::size_t declare_added(ModelReader& reader, const AlgebroidDraft& draft)
{
    const std::vector<Symbol> given = reader.model.base.coordinates;
    const std::vector<Symbol> all = space_of(reader, draft, given).base;
    const std::size_t added = all.size() - given.size();
    if (added > 0 && given.size() >= added) {
        const std::vector<Symbol> head = part_of(given, 0, given.size() - added);
        if (std::ranges::equal(space_of(reader, draft, head).base, given, same_names)) return head.size();
    }
    declare_symbols(reader, part_of(all, given.size(), added), Role::base);
    return given.size();
}

/// The innermost draft of frames and prolongations: a file, a product, or a table whose base is the model's own.
const AlgebroidDraft& leaf_of(const AlgebroidDraft& draft)
{
    const AlgebroidDraft* leaf = &draft;
    while (leaf->kind && leaf->kind != AlgebroidKind::product && !leaf->of.empty()) leaf = &leaf->of[0];
    return *leaf;
}

/// Declares the base coordinates that [base] leaves to files and prolongations, and checks those that it gives. The
/// number of coordinates of the leaf, which come first; those of prolongations follow, the innermost first.
std::size_t declare_inner_base(ModelReader& reader, const AlgebroidDraft& draft)
{
    const AlgebroidDraft& leaf = leaf_of(draft);
    const bool product = leaf.kind == AlgebroidKind::product;
    if (leaf.kind && !product) return declare_added(reader, draft);
    const std::vector<Symbol> given = reader.model.base.coordinates;
    const std::vector<IncludedModel*> files = files_of(reader, leaf);
    std::vector<Symbol> head;
    for (const IncludedModel* file : files) append(head, file->model.base.coordinates);
    const std::vector<Symbol> all = space_of(reader, draft, head).base;
    const std::size_t places = given.empty() ? 0 : given.size() == all.size() ? all.size() : head.size();
    bool fits = given.size() == places;
    for (std::size_t i = product ? head.size() : 0; fits && i < places; ++i) fits = same_names(given[i], all[i]);
    if (!fits)
        throw complain::wrong_number("base coordinates", given.size(), draft.title,
                                     fmt::format("{}: {}", all.size(), comma_list(declared_names(all))),
                                     given.front().where, "leave [base] coordinates out, or give exactly these");
    if (given.empty() && product) require_distinct(files, head.size());
    declare_symbols(reader, part_of(all, places, all.size() - places), Role::base);
    std::size_t next = 0; // the place of a file's coordinate among the model's
    for (IncludedModel* file : files)
        for (const Symbol& coordinate : file->model.base.coordinates) {
            const std::string& own = reader.model.base.coordinates[next].name;
            if (own != coordinate.name) file->renamed.emplace(coordinate.name, name(own));
            file->base.push_back(next++);
        }
    return head.size();
}

/// The record of the draft and of everything inside it; the leaf's base are the first coordinates of the model.
AlgebroidBlock make_block(const ModelReader& reader, const AlgebroidDraft& draft, std::size_t leaf_size)
{
    if (!draft.kind) return block_of_file(reader, draft);
    const DraftSpace space = space_of(reader, draft, part_of(reader.model.base.coordinates, 0, leaf_size));
    AlgebroidBlock block;
    block.kind = *draft.kind;
    block.fibre = space.fibre;
    block.base.resize(space.base.size());
    std::iota(block.base.begin(), block.base.end(), std::size_t{0});
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
        const auto size = std::ranges::find(sizes, word, &Size::name);
        const bool stands_for_number = k > 0 && (algebra[k - 1] == '(' || algebra[k - 1] == '^');
        out += size != sizes.end() && stands_for_number ? std::to_string(size->value) : word;
        k += word.size();
    }
    return out;
}

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
    using enum AlgebroidKind;
    const bool standard = block.kind == tangent || block.kind == prolongation || block.kind == product;
    return standard || (block.kind == level_set && !block.fibre.empty()) ? std::optional(block.fibre) : std::nullopt;
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

std::vector<Symbol> velocities_of(const std::vector<Symbol>& coordinates)
{
    return with_prefix("v_", coordinates);
}

std::vector<Symbol> coordinates_of(const Model& model, const AlgebroidBlock& block)
{
    return entries_at(model.base.coordinates, block.base);
}

} // namespace lagen
