// SPDX-License-Identifier: GPL-2.0-or-later
/// [forms]: E-forms by their components, and what is claimed of them.
#include "model/algebroid_draft.hpp"
#include "model/families.hpp"
#include "model/form_expression.hpp"
#include "model/read_values.hpp"
#include "model/table_reader.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace lagen {

namespace {

constexpr const char* example = "for example A = { degree = 1, a = \"x\" }, F = { degree = 2, \"a,b\" = \"x\" }";

bool is_claim(const std::string& key)
{
    return key == "degree" || key == "closed" || key == "equals";
}

/// The fibre coordinates of a key "a,b", as many as the degree and all different.
std::vector<std::size_t> read_indices(const ModelReader& reader, const NamedForm& form, const TomlEntry& entry)
{
    const std::string title = fmt::format("the form '{}'", form.name);
    const std::vector<Symbol>& fibre = reader.model.fibre.coordinates;
    std::vector<std::size_t> indices;
    for (const Excerpt& side : sides_of(entry.key)) {
        const ResolvedKey key = require_key(fibre, side, title, "fibre coordinate", &reader.model.scope);
        if (key.shape.rank != Rank::scalar)
            throw ModelError(
                fmt::format("{} names the family '{}', where one fibre coordinate is required", title, key.name),
                side.range(0, side.text.size()));
        if (std::ranges::find(indices, key.indices[0]) != indices.end())
            throw ModelError(fmt::format("the component '{}' of {} names '{}' twice", entry.name(), title, key.name),
                             entry.where(), "e ^ e = 0; leave it out");
        indices.push_back(key.indices[0]);
    }
    if (indices.size() != form.degree)
        throw ModelError(fmt::format("the component '{}' of {} has {} {}, where a form of degree {} needs {}",
                                     entry.name(), title, indices.size(), indices.size() == 1 ? "index" : "indices",
                                     form.degree, form.degree),
                         entry.where(), example);
    return indices;
}

Tree read_component(const ModelReader& reader, const TomlEntry& entry, const std::string& what)
{
    return reader.close(read_expression(entry.value, what), {Role::parameter, Role::base}, what);
}

void read_components(const ModelReader& reader, NamedForm& form, const TomlEntry& block)
{
    std::set<std::vector<std::size_t>> seen;
    for (const TomlEntry& entry : block.value.entries) {
        if (is_claim(entry.name())) continue;
        const std::string what = fmt::format("the component '{}' of the form '{}'", entry.name(), form.name);
        std::vector<std::size_t> indices;
        if (form.degree > 0)
            indices = read_indices(reader, form, entry);
        else if (entry.name() != "value")
            throw ModelError(fmt::format("the form '{}' of degree 0 has the key '{}'", form.name, entry.name()),
                             entry.where(), "a form of degree 0 is a function: value = \"..\"");
        std::vector<std::size_t> sorted = indices;
        std::ranges::sort(sorted);
        if (!seen.insert(sorted).second)
            throw ModelError(fmt::format("{} is given twice", what), entry.where(),
                             "one order of the indices gives the others, up to a sign");
        form.components.push_back({std::move(indices), read_component(reader, entry, what)});
    }
}

NamedForm read_form(const ModelReader& reader, const TomlEntry& block)
{
    NamedForm form;
    form.name = block.name();
    form.where = block.where();
    const TableReader table(block.value, fmt::format("the form '{}'", form.name), example);
    const std::size_t r = reader.model.fibre.coordinates.size();
    const auto entry = [&](const char* key) { return find_entry(block.value, key); };
    const TomlEntry* degree = entry("degree");
    if (degree == nullptr)
        throw ModelError(fmt::format("the form '{}' has no degree", form.name), block.where(), example);
    form.degree = static_cast<std::size_t>(
        read_count(degree->value, fmt::format("the degree of the form '{}'", form.name), 0, static_cast<long>(r)));
    require_few_components(form.degree, r, fmt::format("the form '{}'", form.name), degree->value.where);
    read_components(reader, form, block);
    if (const TomlEntry* closed = entry("closed")) {
        form.closed = read_flag(closed->value, fmt::format("'closed' of the form '{}'", form.name));
        if (!form.closed)
            throw ModelError(fmt::format("the form '{}' claims closed = false", form.name), closed->value.where,
                             "leave it out: without a claim `check` says whether the form is closed");
        require_few_components(form.degree + 1, r, fmt::format("d of the form '{}'", form.name), closed->value.where);
    }
    return form;
}

} // namespace

void declare_forms(ModelReader& reader, const TomlEntry* block)
{
    if (block == nullptr) return;
    refuse_nonholonomic(reader, *block);
    const TableReader table(block->value, "[forms]", example);
    for (const TomlEntry& entry : block->value.entries) reader.names.declare(entry.name(), Role::form, entry.where());
}

void read_forms(ModelReader& reader, const TomlEntry* block)
{
    if (block == nullptr) return;
    for (const TomlEntry& entry : block->value.entries) reader.model.forms.push_back(read_form(reader, entry));
    // A claim may name any form, in whatever order they stand.
    for (std::size_t k = 0; k < reader.model.forms.size(); ++k) {
        NamedForm& form = reader.model.forms[k];
        const TomlEntry* equals = find_entry(block->value.entries[k].value, "equals");
        if (equals == nullptr) continue;
        const std::string what = fmt::format("'equals' of the form '{}'", form.name);
        FormExpression expression = read_form_expression(reader, read_expression(equals->value, what), what);
        if (expression.degree != form.degree)
            throw ModelError(
                fmt::format("{} has degree {}, where the form has degree {}", what, expression.degree, form.degree),
                equals->value.where);
        form.equals = std::move(expression);
    }
}

} // namespace lagen
