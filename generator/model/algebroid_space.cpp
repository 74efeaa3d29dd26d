// SPDX-License-Identifier: GPL-2.0-or-later
/// Base and fibre coordinates of nested algebroids: which the model's [base] declares, which come from files, and which
/// prolongations add.
#include "model/algebroid_draft.hpp"

#include "model/complaints.hpp"
#include "model/families.hpp"
#include "text/comma_list.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace lagen {

namespace {

std::vector<Symbol> with_prefix(const char* prefix, const std::vector<Symbol>& symbols)
{
    std::vector<Symbol> out;
    for (const Symbol& symbol : symbols) out.push_back(Symbol{prefix + symbol.name, symbol.where, {}, {}, {}});
    return out;
}

void append(std::vector<Symbol>& list, const std::vector<Symbol>& more)
{
    list.insert(list.end(), more.begin(), more.end());
}

/// Fibre and momenta of a product, one factor after another.
DraftSpace product_space(const ModelReader& reader, const AlgebroidDraft& draft)
{
    DraftSpace space;
    for (const AlgebroidDraft& factor : draft.of) {
        const Model& model = reader.included[factor.included].model;
        append(space.fibre, model.fibre.coordinates);
        append(space.momenta, model.fibre.momenta);
    }
    return space;
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

std::string names_text(const std::vector<Symbol>& symbols)
{
    return comma_list(declared_names(symbols));
}

bool same_names(const Symbol& a, const Symbol& b)
{
    return a.name == b.name;
}

/// Coordinates of the leaf: of its file or files, those of the model's [base] where it has none of its own.
std::vector<Symbol> leaf_base(ModelReader& reader, const AlgebroidDraft& leaf)
{
    std::vector<Symbol> base;
    if (!leaf.kind) return reader.included[leaf.included].model.base.coordinates;
    for (const AlgebroidDraft& factor : leaf.of) append(base, reader.included[factor.included].model.base.coordinates);
    return base;
}

/// The places of the leaf's coordinates among the model's, for each included file.
void place_included(ModelReader& reader, const AlgebroidDraft& leaf, const std::vector<Symbol>& given)
{
    std::size_t next = 0;
    const auto place = [&](const AlgebroidDraft& file) {
        IncludedModel& included = reader.included[file.included];
        for (const Symbol& coordinate : included.model.base.coordinates) {
            included.base.push_back(next);
            if (given[next].name != coordinate.name) included.renamed.emplace(coordinate.name, name(given[next].name));
            ++next;
        }
    };
    if (!leaf.kind) return place(leaf);
    for (const AlgebroidDraft& factor : leaf.of) place(factor);
}

/// Clashing coordinates of factors are told as such, not as a second declaration.
void require_distinct(const ModelReader& reader, const AlgebroidDraft& leaf, const std::vector<Symbol>& base)
{
    std::map<std::string, const AlgebroidDraft*> owners;
    for (const AlgebroidDraft& factor : leaf.of) {
        for (const Symbol& coordinate : reader.included[factor.included].model.base.coordinates) {
            const auto [at, fresh] = owners.emplace(coordinate.name, &factor);
            if (fresh) continue;
            throw ModelError(fmt::format("'{}' is a base coordinate of both {} and {}", coordinate.name,
                                         at->second->title, factor.title),
                             factor.where,
                             fmt::format("rename them: [base] coordinates = [..], all {} in order", base.size()));
        }
    }
}

} // namespace

std::vector<Symbol> velocities_of(const std::vector<Symbol>& coordinates)
{
    return with_prefix("v_", coordinates);
}

std::vector<Symbol> coordinates_at(const Model& model, const std::vector<std::size_t>& places)
{
    std::vector<Symbol> out;
    for (const std::size_t i : places) out.push_back(model.base.coordinates[i]);
    return out;
}

std::vector<Symbol> coordinates_of(const Model& model, const AlgebroidBlock& block)
{
    return coordinates_at(model, block.base);
}

const AlgebroidDraft& leaf_of(const AlgebroidDraft& draft)
{
    const AlgebroidDraft* leaf = &draft;
    while (leaf->kind && leaf->kind != AlgebroidKind::product && !leaf->of.empty()) leaf = &leaf->of[0];
    return *leaf;
}

std::vector<std::size_t> read_over(const Item& over, const std::vector<Symbol>& base)
{
    std::vector<std::size_t> out;
    if (!over) {
        for (std::size_t i = 0; i < base.size(); ++i) out.push_back(i);
        return out;
    }
    for (const Excerpt& name : over.texts())
        for (const std::size_t i : require_key(base, name, "'over'", "base coordinate").indices) {
            if (std::ranges::find(out, i) != out.end())
                throw complain::names_twice("'over'", base[i].name, name.range(0, name.text.size()));
            out.push_back(i);
        }
    return out;
}

DraftSpace space_of(const ModelReader& reader, const AlgebroidDraft& draft, const std::vector<Symbol>& leaf_base)
{
    if (!draft.kind) {
        const Model& model = reader.included[draft.included].model;
        return {leaf_base, model.fibre.coordinates, model.fibre.momenta};
    }
    DraftSpace space{leaf_base, draft.fibre, draft.momenta};
    std::vector<Symbol> inner_fibre;
    if (*draft.kind == AlgebroidKind::product) {
        const DraftSpace factors = product_space(reader, draft);
        if (space.fibre.empty()) space.fibre = factors.fibre;
        if (space.momenta.empty() && draft.fibre.empty()) space.momenta = factors.momenta;
    } else if (!draft.of.empty()) {
        const DraftSpace inner = space_of(reader, draft.of[0], leaf_base);
        space.base = inner.base;
        inner_fibre = inner.fibre;
        if (*draft.kind == AlgebroidKind::prolongation) append(space.base, draft.dual ? inner.momenta : inner.fibre);
    }
    if (space.fibre.empty()) space.fibre = standard_fibre(draft, space.base, inner_fibre);
    if (space.momenta.empty()) space.momenta = with_prefix("p_", space.fibre);
    if (space.momenta.size() != space.fibre.size()) {
        throw complain::wrong_number("momenta of " + draft.title, space.momenta.size(), "the fibre", space.fibre.size(),
                                     draft.where);
    }
    return space;
}

namespace {

/// The leaf has its base from [base], where the coordinates that prolongations add may be listed or not.
std::size_t declare_added(ModelReader& reader, const AlgebroidDraft& draft)
{
    const std::vector<Symbol> given = reader.model.base.coordinates;
    const std::vector<Symbol> all = space_of(reader, draft, given).base;
    const std::size_t added = all.size() - given.size();
    if (added > 0 && given.size() >= added) {
        const std::vector<Symbol> head(given.begin(), given.end() - static_cast<std::ptrdiff_t>(added));
        if (std::ranges::equal(space_of(reader, draft, head).base, given, same_names)) return head.size();
    }
    declare_symbols(reader, {all.begin() + static_cast<std::ptrdiff_t>(given.size()), all.end()}, Role::base);
    return given.size();
}

} // namespace

std::size_t declare_inner_base(ModelReader& reader, const AlgebroidDraft& draft)
{
    const AlgebroidDraft& leaf = leaf_of(draft);
    const bool product = leaf.kind == AlgebroidKind::product;
    if (leaf.kind && !product) return declare_added(reader, draft);
    const std::vector<Symbol> given = reader.model.base.coordinates;
    const std::vector<Symbol> head = leaf_base(reader, leaf);
    const std::vector<Symbol> all = space_of(reader, draft, head).base;
    const std::size_t places = given.empty() ? 0 : given.size() == all.size() ? all.size() : head.size();
    bool fits = given.size() == places;
    for (std::size_t i = product ? head.size() : 0; fits && i < places; ++i) fits = same_names(given[i], all[i]);
    if (!fits) {
        throw complain::wrong_number("base coordinates", given.size(), draft.title,
                                     fmt::format("{}: {}", all.size(), names_text(all)), given.front().where,
                                     "leave [base] coordinates out, or give exactly these");
    }
    if (given.empty() && product) require_distinct(reader, leaf, head);
    declare_symbols(reader, {all.begin() + static_cast<std::ptrdiff_t>(places), all.end()}, Role::base);
    place_included(reader, leaf, reader.model.base.coordinates);
    return head.size();
}

} // namespace lagen
