// SPDX-License-Identifier: GPL-2.0-or-later
/// The fibre coordinates of inner frames as functions of the model's own, w_b = y^a A_a^b, and the ambient velocities
/// of subbundles, v_x = rho^x_a y^a: definitions that L, forces, observables and invariants may use.
#include "model/algebroid_draft.hpp"

#include "model/families.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace lagen {

namespace {

std::vector<Tree> sums_of(const std::vector<std::vector<Tree>>& terms)
{
    std::vector<Tree> out;
    for (const std::vector<Tree>& each : terms) out.push_back(sum_of(each));
    return out;
}

std::vector<Tree> names_as_trees(const std::vector<Symbol>& symbols)
{
    std::vector<Tree> out;
    for (const Symbol& symbol : symbols) out.push_back(name(symbol.name, symbol.where));
    return out;
}

/// The symbols, group by group, become definitions with these values.
void define_velocities(ModelReader& reader, const std::vector<Symbol>& symbols, const std::vector<Tree>& values)
{
    for (const SymbolGroup& group : group_symbols(symbols)) {
        const auto first = values.begin() + static_cast<std::ptrdiff_t>(group.first);
        const std::vector<Tree> entries(first, first + static_cast<std::ptrdiff_t>(group.shape.size()));
        const SourceRange& where = symbols[group.first].where;
        reader.names.declare(group.name, Role::velocity, where);
        reader.model.scope.define(Definition{group.name, {}, array_tree(group.shape, entries), where});
    }
}

/// v_x = rho^x_a y^a for the base coordinates of a subbundle.
std::vector<Tree> ambient_values(const Model& model, const AlgebroidBlock& block, const std::vector<Tree>& y)
{
    std::vector<std::vector<Tree>> terms(model.base.coordinates.size());
    for (const AnchorEntry& entry : block.anchor)
        terms[entry.coordinate].push_back(product_of(entry.value, y[entry.section]));
    std::vector<std::vector<Tree>> own;
    for (const std::size_t i : block.base) own.push_back(terms[i]);
    return sums_of(own);
}

/// The velocities that a level set keeps are coordinates of its fibre already.
void define_ambient(ModelReader& reader, const AlgebroidBlock& block, const std::vector<Tree>& values)
{
    const std::vector<Symbol> all = velocities_of(coordinates_of(reader.model, block));
    std::vector<Symbol> symbols;
    std::vector<Tree> own;
    for (std::size_t k = 0; k < all.size(); ++k) {
        const bool kept =
            block.kind == AlgebroidKind::level_set && index_of(block.fibre, all[k].name) < block.fibre.size();
        if (kept) continue;
        symbols.push_back(all[k]);
        own.push_back(values[k]);
    }
    define_velocities(reader, symbols, own);
}

/// Notes the values that a file's fibre coordinates have in this model.
void note_values(IncludedModel& included, const std::vector<Tree>& y)
{
    const std::vector<Symbol>& own = included.model.fibre.coordinates;
    for (std::size_t a = 0; a < own.size(); ++a) included.velocities.insert_or_assign(own[a].name, y[a]);
}

void define_below(ModelReader& reader, const AlgebroidDraft* draft, const AlgebroidBlock& block,
                  const std::vector<Tree>& y, bool named)
{
    if (draft != nullptr && !draft->kind) {
        if (named) note_values(reader.included[draft->included], y);
        draft = nullptr;
    }
    const auto inner = [&](std::size_t k) {
        return draft != nullptr && k < draft->of.size() ? &draft->of[k] : nullptr;
    };
    switch (block.kind) {
    case AlgebroidKind::level_set:
    case AlgebroidKind::subbundle:
        if (named) define_ambient(reader, block, ambient_values(reader.model, block, y));
        return;
    case AlgebroidKind::frame: {
        std::vector<Tree> w;
        if (named) {
            w = inner_fibre_values(block, y);
            define_velocities(reader, block.of[0].fibre, w);
        }
        return define_below(reader, inner(0), block.of[0], w, named);
    }
    case AlgebroidKind::nonholonomic:
        return define_below(reader, inner(0), block.of[0], names_as_trees(block.of[0].fibre), named);
    case AlgebroidKind::prolongation: {
        const std::vector<Tree> w = names_as_trees(block.of[0].fibre);
        return define_below(reader, inner(0), block.of[0], w, named && !block.dual);
    }
    case AlgebroidKind::product: {
        auto first = y.begin();
        for (std::size_t k = 0; k < block.of.size(); ++k) {
            const auto rank = static_cast<std::ptrdiff_t>(named ? block.of[k].fibre.size() : 0);
            define_below(reader, inner(k), block.of[k], {first, first + rank}, named);
            first += rank;
        }
        return;
    }
    default: return;
    }
}

void append_velocity_names(std::vector<std::string>& names, const Model& model, const AlgebroidBlock& block)
{
    if (block.kind == AlgebroidKind::subbundle || block.kind == AlgebroidKind::level_set)
        for (const std::string& each : declared_names(velocities_of(coordinates_of(model, block))))
            names.push_back(each);
    for (const AlgebroidBlock& inner : block.of) {
        for (const std::string& each : declared_names(inner.fibre)) names.push_back(each);
        append_velocity_names(names, model, inner);
    }
}

} // namespace

std::vector<Tree> inner_fibre_values(const AlgebroidBlock& block, const std::vector<Tree>& y)
{
    std::vector<std::vector<Tree>> terms(block.of[0].fibre.size());
    for (const SectionEntry& entry : block.sections)
        terms[entry.inner].push_back(product_of(entry.value, y[entry.section]));
    return sums_of(terms);
}

Tree product_of(const Tree& value, const Tree& y)
{
    const bool negative = value->kind == TreeKind::negate && value->arguments[0]->kind == TreeKind::number;
    if (value->kind == TreeKind::number && value->number == 1) return y;
    if (negative && value->arguments[0]->number == 1) return negate(y);
    return multiply({value, y});
}

Tree sum_of(const std::vector<Tree>& terms)
{
    if (terms.empty()) return number(0);
    return terms.size() == 1 ? terms[0] : add(terms);
}

Tree array_tree(const Shape& shape, const std::vector<Tree>& entries)
{
    if (shape.rank == Rank::scalar) return entries.at(0);
    auto rows = std::make_shared<TreeNode>();
    rows->kind = TreeKind::array;
    rows->where = entries.empty() ? SourceRange{} : entries[0]->where;
    rows->arguments = entries;
    if (shape.rank == Rank::vector) return rows;
    rows->arguments.clear();
    for (std::size_t i = 0; i < shape.rows; ++i) {
        const auto first = entries.begin() + static_cast<std::ptrdiff_t>(i * shape.columns);
        const std::vector<Tree> row(first, first + static_cast<std::ptrdiff_t>(shape.columns));
        rows->arguments.push_back(array_tree({Rank::vector, shape.columns, 1}, row));
    }
    return rows;
}

std::vector<std::string> velocity_names(const Model& model)
{
    std::vector<std::string> names;
    append_velocity_names(names, model, model.algebroid);
    return names;
}

void define_inner_velocities(ModelReader& reader)
{
    const AlgebroidBlock& block = reader.model.algebroid;
    define_below(reader, reader.draft.get(), block, names_as_trees(block.fibre), true);
}

} // namespace lagen
