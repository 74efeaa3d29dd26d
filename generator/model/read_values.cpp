// SPDX-License-Identifier: GPL-2.0-or-later
/// Values, with their types insisted on.
#include "model/read_values.hpp"

#include "expression/parse.hpp"
#include "model/source_positions.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace lagen {

namespace {

[[noreturn]] void refuse_type(const TomlValue& value, const std::string& what, const char* wanted,
                              const char* hint = "")
{
    throw ModelError(fmt::format("{} is {}, where {} is required", what, kind_text(value.kind), wanted), value.where,
                     hint);
}

/// A decimal literal of TOML: sign, digits with '_' between them, point, exponent.
Tree read_decimal(const TomlValue& value, const std::string& what)
{
    if (!value.finite) {
        throw ModelError(fmt::format("{} is '{}', where a finite number is required", what, value.text.text),
                         value.where);
    }
    Excerpt plain{value.text.file, {}, {}};
    bool negative = false;
    for (std::size_t k = 0; k < value.text.text.size(); ++k) {
        const char c = value.text.text[k];
        if (c == '_') continue;
        if (k == 0 && (c == '+' || c == '-')) {
            negative = c == '-';
            continue;
        }
        plain.text.push_back(c);
        plain.origin.push_back(value.text.origin[k]);
    }
    plain.origin.push_back(value.text.origin.back());
    const Tree magnitude = parse_expression(plain);
    if (!negative) return magnitude;
    auto node = std::make_shared<TreeNode>(*negate(magnitude));
    node->where = value.where;
    return node;
}

} // namespace

Tree read_expression(const TomlValue& value, const std::string& what)
{
    switch (value.kind) {
    case TomlKind::string: return parse_expression(value.text);
    case TomlKind::integer: return number(Rational(value.integer), value.where);
    case TomlKind::decimal: return read_decimal(value, what);
    default: refuse_type(value, what, "a number or an expression string");
    }
}

Tree read_array_expression(const TomlValue& value, const std::string& what)
{
    if (value.kind != TomlKind::array) return read_expression(value, what);
    auto out = std::make_shared<TreeNode>();
    out->kind = TreeKind::array;
    out->where = value.where;
    for (const TomlValue& row : value.items) {
        if (row.kind != TomlKind::array) {
            out->arguments.push_back(read_expression(row, "an entry of " + what));
            continue;
        }
        auto entries = std::make_shared<TreeNode>();
        entries->kind = TreeKind::array;
        entries->where = row.where;
        for (const TomlValue& entry : row.items)
            entries->arguments.push_back(read_expression(entry, "an entry of " + what));
        out->arguments.push_back(std::move(entries));
    }
    return out;
}

void refuse_equation(const Excerpt& text, const std::string& what)
{
    const std::size_t sign = text.text.find('=');
    if (sign == std::string::npos || text.text.find_first_of("<>!") != std::string::npos) return;
    const std::size_t behind = text.text.find_first_not_of('=', sign);
    const Excerpt left = trimmed(text, 0, sign);
    const Excerpt right = trimmed(text, std::min(behind, text.text.size()), text.text.size());
    const bool single = right.text.find_first_of("+- ") == std::string::npos;
    std::string difference = left.text;
    if (right.text != "0") difference += single ? " - " + right.text : fmt::format(" - ({})", right.text);
    throw ModelError(
        fmt::format("{} '{}' is an equation, where an expression that is zero is required", what, text.text),
        text.range(0, text.text.size()), fmt::format("write \"{}\"", difference));
}

std::string read_text(const TomlValue& value, const std::string& what)
{
    if (value.kind != TomlKind::string) refuse_type(value, what, "a string");
    const std::size_t at = first_control_character(value.text.text);
    if (at != value.text.text.size()) {
        const CodePoint point = decode_utf8(value.text.text, at);
        throw ModelError(
            fmt::format("{} contains the control character U+{:04X}; printable characters on one line are required",
                        what, static_cast<unsigned>(point.value)),
            value.text.range(at, at + point.length));
    }
    return value.text.text;
}

bool read_flag(const TomlValue& value, const std::string& what)
{
    if (value.kind != TomlKind::boolean) refuse_type(value, what, "true or false");
    return value.boolean;
}

long read_count(const TomlValue& value, const std::string& what, long least, long most)
{
    if (value.kind != TomlKind::integer) refuse_type(value, what, "an integer");
    if (value.integer < least || value.integer > most) {
        throw ModelError(
            fmt::format("{} is {}, where an integer from {} to {} is required", what, value.integer, least, most),
            value.where);
    }
    return value.integer;
}

std::vector<Excerpt> read_list(const TomlValue& value, const std::string& what)
{
    if (value.kind != TomlKind::array)
        refuse_type(value, what, "an array of strings", "one entry is written [\"..\"], several [\"..\", \"..\"]");
    std::vector<Excerpt> out;
    for (const TomlValue& item : value.items) {
        if (item.kind != TomlKind::string) refuse_type(item, "an entry of " + what, "a string");
        out.push_back(item.text);
    }
    return out;
}

std::vector<Excerpt> split_at_commas(const Excerpt& text)
{
    std::vector<Excerpt> out;
    std::size_t begin = 0;
    while (true) {
        const std::size_t comma = text.text.find(',', begin);
        out.push_back(trimmed(text, begin, std::min(comma, text.text.size())));
        if (comma == std::string::npos) return out;
        begin = comma + 1;
    }
}

} // namespace lagen
