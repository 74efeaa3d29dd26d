// SPDX-License-Identifier: GPL-2.0-or-later
/// [forms]: E-forms by their components, and what is claimed of them.
#include "expression/find_part.hpp"
#include "model/algebroid_draft.hpp"
#include "model/families.hpp"
#include "model/model_reader.hpp"
#include "model/read_values.hpp"
#include "model/table_reader.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace lagen {

namespace {

// Expressions in forms: names of forms, d(A), wedge(A, B, ..), i(s, A), sums, and products with functions.

using Kind = FormExpression::Kind;

constexpr std::size_t most_components = 5000; ///< of one form; a wedge product makes products of pairs of them

/// Throws ModelError where a form of this degree has more components than can be looked at one by one.
void require_few_components(std::size_t degree, std::size_t rank, const std::string& what, const SourceRange& where)
{
    std::size_t count = 1;
    for (std::size_t k = 0; k < std::min(degree, rank - std::min(degree, rank)); ++k) {
        count = count * (rank - k) / (k + 1);
        if (count > most_components)
            throw ModelError(fmt::format("{} has degree {} over {} fibre coordinates, which is more than {} components",
                                         what, degree, rank, most_components),
                             where);
    }
}

class FormReader {
  public:
    FormReader(const ModelReader& reader, const std::string& what) : reader_(reader), what_(what) {}

    [[nodiscard]] FormExpression read(const Tree& tree) const
    {
        FormExpression result = read_any(tree);
        require_few_components(result.degree, reader_.model.fibre.coordinates.size(), "a part of " + what_,
                               tree->where);
        return result;
    }

  private:
    [[nodiscard]] FormExpression read_any(const Tree& tree) const
    {
        switch (tree->kind) {
        case TreeKind::name:
            if (const auto form = form_called(tree->name)) {
                FormExpression result;
                result.kind = Kind::form;
                result.form = *form;
                result.degree = reader_.model.forms[*form].degree;
                return result;
            }
            return function(tree);
        case TreeKind::negate: return unary(Kind::negative, read(tree->arguments[0]));
        case TreeKind::add: return sum(tree);
        case TreeKind::multiply: return product(tree);
        case TreeKind::divide: return quotient(tree);
        case TreeKind::apply: return application(tree);
        default: return function(tree);
        }
    }

    [[nodiscard]] std::optional<std::size_t> form_called(const std::string& name) const
    {
        const std::vector<NamedForm>& forms = reader_.model.forms;
        const auto found = std::ranges::find(forms, name, &NamedForm::name);
        if (found == forms.end()) return std::nullopt;
        return static_cast<std::size_t>(found - forms.begin());
    }

    /// d(..), wedge(..) and i(..) of forms, not what the model calls so.
    [[nodiscard]] bool is_operation(const Tree& tree) const
    {
        return tree->kind == TreeKind::apply && (tree->name == "d" || tree->name == "wedge" || tree->name == "i") &&
               !reader_.model.scope.has_definition(tree->name);
    }

    void require_function(const Tree& tree, const std::string& what) const
    {
        const Tree form = PartSearch()(tree, [&](const Tree& part) {
            return is_operation(part) || (part->kind == TreeKind::name && form_called(part->name));
        });
        if (form == nullptr) return;
        throw ModelError(fmt::format("{} has the form '{}' where a function is required", what, to_text(form)),
                         form->where,
                         "forms are added, multiplied by functions, and stand in d(A), wedge(A, B) and i(w, A)");
    }

    [[nodiscard]] FormExpression function(const Tree& tree) const
    {
        require_function(tree, what_);
        FormExpression result;
        result.function = reader_.close(tree, {Role::parameter, Role::base}, what_);
        return result;
    }

    [[nodiscard]] static FormExpression unary(Kind kind, FormExpression part)
    {
        FormExpression result;
        result.kind = kind;
        result.degree = part.degree + (kind == Kind::differential ? 1 : 0);
        result.parts.push_back(std::move(part));
        return result;
    }

    [[nodiscard]] FormExpression sum(const Tree& tree) const
    {
        FormExpression result;
        result.kind = Kind::sum;
        for (const Tree& term : tree->arguments) {
            result.parts.push_back(read(term));
            if (result.parts.back().degree != result.parts.front().degree)
                throw ModelError(fmt::format("{} adds forms of the degrees {} and {}", what_,
                                             result.parts.front().degree, result.parts.back().degree),
                                 term->where);
        }
        result.degree = result.parts.front().degree;
        return result;
    }

    /// A wedge product, where one factor at most is no function.
    [[nodiscard]] FormExpression product(const Tree& tree) const
    {
        FormExpression result;
        result.kind = Kind::wedge;
        for (const Tree& factor : tree->arguments) {
            result.parts.push_back(read(factor));
            if (result.degree > 0 && result.parts.back().degree > 0)
                throw ModelError(fmt::format("{} multiplies two forms", what_), factor->where,
                                 "the product of forms is wedge(A, B)");
            result.degree += result.parts.back().degree;
        }
        return result;
    }

    [[nodiscard]] FormExpression quotient(const Tree& tree) const
    {
        FormExpression above = read(tree->arguments[0]);
        if (above.degree == 0 && above.kind == Kind::function) return function(tree);
        FormExpression result;
        result.kind = Kind::wedge;
        result.degree = above.degree;
        result.parts.push_back(function(divide(number(1, tree->where), tree->arguments[1])));
        result.parts.push_back(std::move(above));
        return result;
    }

    void require_arguments(const Tree& tree, bool right, const char* form) const
    {
        if (!right)
            throw ModelError(fmt::format("{} has {}(..) with {} argument{}", what_, tree->name, tree->arguments.size(),
                                         tree->arguments.size() == 1 ? "" : "s"),
                             tree->where, form);
    }

    [[nodiscard]] FormExpression application(const Tree& tree) const
    {
        const std::size_t count = tree->arguments.size();
        if (reader_.model.scope.has_definition(tree->name)) return function(tree); // of the model
        if (tree->name == "d") {
            require_arguments(tree, count == 1, "d(A) is the exterior differential of a form or of a function");
            return unary(Kind::differential, read(tree->arguments[0]));
        }
        if (tree->name == "wedge") {
            require_arguments(tree, count >= 2, "wedge(A, B)");
            FormExpression result;
            result.kind = Kind::wedge;
            for (const Tree& factor : tree->arguments) {
                result.parts.push_back(read(factor));
                result.degree += result.parts.back().degree;
            }
            return result;
        }
        if (tree->name != "i") return function(tree);
        require_arguments(tree, count == 2, "i(s, A) is the contraction of the form A with the section s");
        FormExpression part = read(tree->arguments[1]);
        if (part.degree == 0)
            throw ModelError(fmt::format("{} contracts a function with a section", what_), tree->arguments[1]->where,
                             "i(s, A) needs a form of degree 1 or more");
        FormExpression result = unary(Kind::contraction, std::move(part));
        --result.degree;
        result.section = section(tree->arguments[0]);
        return result;
    }

    [[nodiscard]] std::vector<Tree> section(const Tree& tree) const
    {
        const std::vector<Symbol>& fibre = reader_.model.fibre.coordinates;
        std::vector<Tree> components(fibre.size(), number(0, tree->where));
        const auto basis = tree->kind == TreeKind::name || tree->kind == TreeKind::index
                               ? resolve_key(fibre, to_text(tree))
                               : std::nullopt;
        if (basis && basis->shape.rank == Rank::scalar) {
            components[basis->indices[0]] = number(1, tree->where);
            return components;
        }
        const std::string what = "the section of " + what_;
        require_function(tree, what);
        const ArrayValue value = reader_.close_array(tree, {Role::parameter, Role::base}, what);
        if (value.shape.rank == Rank::scalar)
            throw ModelError(
                fmt::format("{} is one number or function, where {} components are required", what, fibre.size()),
                tree->where, "i(w, A) has the name of a fibre coordinate, i([f, g, ..], A) all components");
        return fit_values(value, {Rank::vector, fibre.size(), 1}, what, tree->where);
    }

    const ModelReader& reader_;
    const std::string& what_;
};

/// Once the forms of the model are read. A section s is the name of a fibre coordinate, for the basis section e_s, or a
/// vector of r components. `what` opens messages. Throws ModelError: a sum of different degrees, a product of two
/// forms, i of a function, an unknown name, a wrong number of arguments.
FormExpression read_form_expression(const ModelReader& reader, const Tree& tree, const std::string& what)
{
    return FormReader(reader, what).read(tree);
}

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
