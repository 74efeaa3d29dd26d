// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/form_expression.hpp"

#include "expression/find_part.hpp"
#include "model/families.hpp"
#include "model/table_reader.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace lagen {

namespace {

using Kind = FormExpression::Kind;

constexpr std::size_t most_components = 5000; ///< of one form; a wedge product makes products of pairs of them

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

} // namespace

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

FormExpression read_form_expression(const ModelReader& reader, const Tree& tree, const std::string& what)
{
    return FormReader(reader, what).read(tree);
}

} // namespace lagen
