// SPDX-License-Identifier: GPL-2.0-or-later
/// Cutting declarations and keys at their brackets, commas and dots; what stands between is parsed as expressions.
#include "expression/parse_family.hpp"

#include <fmt/format.h>

namespace lagen {

namespace {

constexpr const char* entry_hint = "an entry is named x[3] or W[1,2]";

SourceRange whole(const Excerpt& text)
{
    return text.range(0, text.text.size());
}

/// The name before the bracket and the parts in the brackets.
struct Bracketed {
    std::string name;
    std::vector<Excerpt> parts;
};

/// Cuts at the commas outside of inner brackets. `hint` shows how it is written.
Bracketed cut(const Excerpt& text, const char* hint)
{
    const std::size_t open = text.text.find('[');
    const Excerpt name = trimmed(text, 0, std::min(open, text.text.size()));
    if (!is_identifier(name.text))
        throw ModelError(fmt::format("{} is not a name", quote(name.text)), whole(name.text.empty() ? text : name),
                         "letters, digits and '_' are allowed, and no digit first");
    Bracketed result{name.text, {}};
    std::size_t depth = 0;
    std::size_t begin = open + 1;
    for (std::size_t k = open; k < text.text.size(); ++k) {
        const char c = text.text[k];
        if (c == '[' || c == '(') ++depth;
        const bool closes = (c == ']' || c == ')') && --depth == 0;
        if (closes || (c == ',' && depth == 1)) {
            result.parts.push_back(trimmed(text, begin, k));
            begin = k + 1;
        }
        if (!closes) continue;
        const Excerpt rest = trimmed(text, k + 1, text.text.size());
        if (!rest.text.empty())
            throw ModelError(fmt::format("{} follows the brackets", quote(rest.text)), whole(rest), hint);
        if (result.parts.size() > 2)
            throw ModelError(fmt::format("{} has {} ranges or indices, where one or two are required", quote(text.text),
                                         result.parts.size()),
                             whole(text), "a family is a vector or a matrix");
        return result;
    }
    throw ModelError("'[' is never closed", text.range(open, open + 1), "every '[' needs a ']' after it");
}

/// The value of `tree` as an integer from 1 on.
std::size_t positive_integer(const Tree& tree, const Scope& scope, const char* what)
{
    const std::optional<long> value = scope.integer(tree);
    if (!value)
        throw ModelError(fmt::format("{} {} is not an integer constant", what, quote(to_text(tree))), tree->where,
                         "it is made of integers and sizes");
    if (*value < 1) throw ModelError(fmt::format("{} is {}", what, *value), tree->where, "it is 1 at least");
    return static_cast<std::size_t>(*value);
}

} // namespace

bool has_bracket(std::string_view text)
{
    return text.find('[') != std::string_view::npos;
}

FamilyDeclaration parse_family(const Excerpt& text)
{
    const char* hint = "a family is declared as x[1..n], or W[1..n,1..m]";
    Bracketed family = cut(text, hint);
    FamilyDeclaration result{std::move(family.name), {}, whole(text)};
    for (const Excerpt& range : family.parts) {
        const std::size_t dots = range.text.find("..");
        if (dots == std::string::npos)
            throw ModelError(fmt::format("{} is not a range", quote(range.text)),
                             range.text.empty() ? whole(text) : whole(range), hint);
        const Excerpt first = trimmed(range, 0, dots);
        if (first.text != "1")
            throw ModelError(fmt::format("the range {} does not start at 1", quote(range.text)), whole(range), hint);
        result.upper.push_back(parse_expression(trimmed(range, dots + 2, range.text.size())));
    }
    return result;
}

Shape close_shape(const FamilyDeclaration& family, const Scope& scope)
{
    Shape shape{Rank::vector, 1, 1};
    shape.rows = positive_integer(family.upper[0], scope, "the end of the range");
    if (family.upper.size() == 2) {
        shape.rank = Rank::matrix;
        shape.columns = positive_integer(family.upper[1], scope, "the end of the range");
    }
    if (is_too_large(shape))
        throw ModelError(fmt::format("the family {} is {}, where at most {} entries are allowed", quote(family.name),
                                     to_text(shape), most_array_entries),
                         family.where);
    return shape;
}

std::vector<std::string> running_indices(const Excerpt& text, const Scope& scope)
{
    if (!has_bracket(text.text)) return {};
    std::vector<std::string> out;
    for (const Excerpt& index : cut(text, entry_hint).parts) {
        const std::string& name = index.text;
        const bool known = scope.has_symbol(name) || scope.has_definition(name) || scope.find_family(name) != nullptr ||
                           scope.find_size(name).has_value();
        out.push_back(is_identifier(name) && !known ? name : "");
    }
    return out;
}

std::string entry_key(const Excerpt& text, const Scope& scope, const std::map<std::string, std::size_t>& running)
{
    if (!has_bracket(text.text)) return text.text;
    const Bracketed entry = cut(text, entry_hint);
    std::vector<std::size_t> indices;
    for (const Excerpt& index : entry.parts) {
        if (index.text.find("..") != std::string::npos)
            throw ModelError(fmt::format("{} is a range, where one index is required", quote(index.text)), whole(index),
                             fmt::format("one entry is {0}[1], all of them are {0} = [..]", entry.name));
        const auto value = running.find(index.text);
        indices.push_back(value != running.end() ? value->second
                                                 : positive_integer(parse_expression(index), scope, "the index"));
    }
    return fmt::format("{}[{}]", entry.name, fmt::join(indices, ","));
}

} // namespace lagen
