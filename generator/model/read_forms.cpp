// SPDX-License-Identifier: GPL-2.0-or-later
/// [forms]: E-forms by their components, and what is claimed of them: expressions in forms, that is names of forms,
/// d(A), wedge(A, B, ..), i(s, A), sums, and products with functions. A section s is the name of a fibre coordinate,
/// for the basis section e_s, or a vector of r components.
#include "expression/find_part.hpp"
#include "model/complaints.hpp"
#include "model/families.hpp"
#include "model/read_values.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace lagen {

namespace {

using Kind = FormExpression::Kind;

constexpr std::size_t most_components = 5000; ///< of one form; a wedge product makes products of pairs of them

/// Throws ModelError where a form of this degree has more components than can be looked at one by one.
void require_few_components(std::size_t degree, std::size_t rank, const std::string& what, const SourceRange& where)
{
    std::size_t count = 1;
    for (std::size_t k = 0; k < std::min(degree, rank - std::min(degree, rank)); ++k) {
        count = count * (rank - k) / (k + 1);
        if (count > most_components)
            throw complain::too_many(fmt::format("{} of degree {}", what, degree), count, "components", most_components,
                                     where);
    }
}

/// An operation makes forms of forms, of so many arguments.
struct Operation {
    std::string_view name;
    std::size_t least, most;
    const char* hint;
};

constexpr Operation operations[] = {
    {"d", 1, 1, "d(A) is the exterior differential of a form or of a function"},
    {"wedge", 2, 1'000'000, "wedge(A, B)"},
    {"i", 2, 2, "i(s, A) is the contraction of the form A with the section s"},
};

FormExpression form_of_parts(Kind kind, std::size_t degree, std::vector<FormExpression> parts)
{
    FormExpression form;
    form.kind = kind;
    form.degree = degree;
    form.parts = std::move(parts);
    return form;
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
                FormExpression result = form_of_parts(Kind::form, reader_.model.forms[*form].degree, {});
                result.form = *form;
                return result;
            }
            return function(tree);
        case TreeKind::negate: {
            FormExpression part = read(tree->arguments[0]);
            return form_of_parts(Kind::negative, part.degree, {std::move(part)});
        }
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

    /// d(..), wedge(..) and i(..) of forms, not what the model calls so; null for anything else.
    [[nodiscard]] const Operation* operation_of(const Tree& tree) const
    {
        const auto* const found = std::ranges::find(operations, tree->name, &Operation::name);
        const bool is_one = tree->kind == TreeKind::apply && found != std::end(operations) &&
                            !reader_.model.scope.has_definition(tree->name);
        return is_one ? found : nullptr;
    }

    void require_function(const Tree& tree, const std::string& what) const
    {
        const Tree form = PartSearch()(tree, [&](const Tree& part) {
            return operation_of(part) != nullptr || (part->kind == TreeKind::name && form_called(part->name));
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
        result.function = reader_.scalar(tree, Role::parameter | Role::base, what_);
        return result;
    }

    [[nodiscard]] FormExpression sum(const Tree& tree) const
    {
        std::vector<FormExpression> parts = read_all(tree);
        const std::size_t degree = parts.front().degree;
        for (std::size_t k = 0; k < parts.size(); ++k)
            if (parts[k].degree != degree)
                throw ModelError(fmt::format("{} adds forms of the degrees {} and {}", what_, degree, parts[k].degree),
                                 tree->arguments[k]->where);
        return form_of_parts(Kind::sum, degree, std::move(parts));
    }

    /// A product of functions and one form is one, too.
    [[nodiscard]] FormExpression wedge(const Tree& tree) const
    {
        std::vector<FormExpression> parts = read_all(tree);
        std::size_t degree = 0;
        for (const FormExpression& part : parts) degree += part.degree;
        return form_of_parts(Kind::wedge, degree, std::move(parts));
    }

    /// A wedge product, where one factor at most is no function.
    [[nodiscard]] FormExpression product(const Tree& tree) const
    {
        FormExpression result = wedge(tree);
        bool has_form = false;
        for (std::size_t k = 0; k < result.parts.size(); ++k) {
            if (has_form && result.parts[k].degree > 0)
                throw ModelError(fmt::format("{} multiplies two forms", what_), tree->arguments[k]->where,
                                 "the product of forms is wedge(A, B)");
            has_form = has_form || result.parts[k].degree > 0;
        }
        return result;
    }

    [[nodiscard]] std::vector<FormExpression> read_all(const Tree& tree) const
    {
        std::vector<FormExpression> parts;
        for (const Tree& argument : tree->arguments) parts.push_back(read(argument));
        return parts;
    }

    [[nodiscard]] FormExpression quotient(const Tree& tree) const
    {
        FormExpression above = read(tree->arguments[0]);
        if (above.degree == 0 && above.kind == Kind::function) return function(tree);
        const std::size_t degree = above.degree;
        FormExpression below = function(divide(number(1, tree->where), tree->arguments[1]));
        return form_of_parts(Kind::wedge, degree, {std::move(below), std::move(above)});
    }

    [[nodiscard]] FormExpression application(const Tree& tree) const
    {
        const std::size_t count = tree->arguments.size();
        const Operation* operation = operation_of(tree);
        if (operation == nullptr) return function(tree); // of the model
        if (count < operation->least || count > operation->most)
            throw ModelError(
                fmt::format("{} has {}(..) with {} argument{}", what_, tree->name, count, count == 1 ? "" : "s"),
                tree->where, operation->hint);
        if (tree->name == "wedge") return wedge(tree);
        FormExpression part = read(tree->arguments.back());
        if (tree->name == "d") return form_of_parts(Kind::differential, part.degree + 1, {std::move(part)});
        if (part.degree == 0)
            throw ModelError(fmt::format("{} contracts a function with a section", what_), tree->arguments[1]->where,
                             "i(s, A) needs a form of degree 1 or more");
        FormExpression result = form_of_parts(Kind::contraction, part.degree - 1, {std::move(part)});
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
        const ArrayValue value = reader_.close(tree, Role::parameter | Role::base, what);
        if (value.shape.rank == Rank::scalar)
            throw complain::is_not(what, "one number or function",
                                   fmt::format("a vector of {} components", fibre.size()), tree->where,
                                   "i(w, A) has the name of a fibre coordinate, i([f, g, ..], A) all components");
        return fit_values(value, {Rank::vector, fibre.size(), 1}, what, tree->where);
    }

    const ModelReader& reader_;
    const std::string& what_;
};

/// The fibre coordinates of a key "a,b", as many as the degree and all different.
std::vector<std::size_t> read_indices(const ModelReader& reader, const NamedForm& form, const Item& item,
                                      const std::string& title)
{
    const std::vector<Symbol>& fibre = reader.model.fibre.coordinates;
    std::vector<std::size_t> indices;
    for (const Excerpt& side : split_at_commas(item.key())) {
        const std::size_t index = require_entry(fibre, side, title, "fibre coordinate", &reader.model.scope);
        if (std::ranges::find(indices, index) != indices.end())
            throw complain::names_twice(item.title(), fibre[index].name, item.where(), "e ^ e = 0; leave it out");
        indices.push_back(index);
    }
    if (indices.size() != form.degree)
        throw complain::wrong_number("indices of " + item.title(), indices.size(), title, form.degree, item.where(),
                                     "as many as its degree");
    return indices;
}

NamedForm read_form(const ModelReader& reader, const Item& block)
{
    NamedForm form;
    form.name = block.name();
    form.where = block.where();
    const std::size_t r = reader.model.fibre.coordinates.size();
    const Item degree = block.at("degree");
    if (degree.value().integer > static_cast<long>(r))
        throw complain::is_not(degree.title(), degree.value().integer, fmt::format("an integer from 0 to {}", r),
                               degree.value().where);
    form.degree = static_cast<std::size_t>(degree.value().integer);
    require_few_components(form.degree, r, block.title(), degree.value().where);
    std::set<std::vector<std::size_t>> seen;
    for (const Item& item : block.items()) {
        if (!item.row().path.ends_with('*')) continue; // the degree, or a claim
        std::vector<std::size_t> indices;
        if (form.degree > 0)
            indices = read_indices(reader, form, item, block.title());
        else if (item.name() != "value")
            throw complain::takes_no(block.title() + " of degree 0", item.name(), item.where(),
                                     "a form of degree 0 is a function: value = \"..\"");
        std::vector<std::size_t> sorted = indices;
        std::ranges::sort(sorted);
        if (!seen.insert(sorted).second)
            throw complain::twice(item.title(), item.where(),
                                  "one order of the indices gives the others, up to a sign");
        form.components.push_back({std::move(indices), reader.scalar(item)});
    }
    if (const Item closed = block.at("closed")) {
        form.closed = closed.value().boolean;
        if (!form.closed)
            throw complain::is_not(closed.title(), "false", "true", closed.value().where,
                                   "leave it out: without a claim `check` says whether the form is closed");
        require_few_components(form.degree + 1, r, "d of " + block.title(), closed.value().where);
    }
    return form;
}

} // namespace

void read_forms(ModelReader& reader)
{
    const Item block = reader.at("forms");
    std::vector<NamedForm>& forms = reader.model.forms;
    for (const Item& item : block.items()) forms.push_back(read_form(reader, item));
    for (NamedForm& form : forms) { // a claim may name any form, in whatever order they stand
        const Item equals = block.at(form.name).at("equals");
        if (!equals) continue;
        FormExpression expression =
            FormReader(reader, equals.title()).read(read_expression(equals.value(), equals.title()));
        if (expression.degree != form.degree)
            throw complain::is_not(fmt::format("the degree of {}", equals.title()), expression.degree,
                                   fmt::format("the degree of the form ({})", form.degree), equals.value().where);
        form.equals = std::move(expression);
    }
}

} // namespace lagen
