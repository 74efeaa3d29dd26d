// SPDX-License-Identifier: GPL-2.0-or-later
/// The answer of a command, as a tree of named values, and its JSON.
#pragma once

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lagen {

/// Members stand in the order in which they were added.
using Record = nlohmann::ordered_json;

/// JSON (RFC 8259) in one line. Numbers are the shortest decimals that are read back as they were, as fmt prints them;
/// what is no finite number is null.
[[nodiscard]] std::string to_json(const Record& record);

/// The text of an object with one member more, whose value is JSON already: long tables are not kept as trees.
[[nodiscard]] std::string with_member(std::string object, std::string_view name, std::string_view json);

/// A line of a report for people: "  LABEL          VALUE", where an empty label goes on with the one above.
[[nodiscard]] std::string labelled(std::string_view label, std::string_view value);

/// A value for people: numbers with 12 digits or by a format of fmt (".3g"), texts as they are, lists "1, 2", objects
/// "x = 1, y = 2", what is not there "".
[[nodiscard]] std::string value_text(const Record& value, std::string_view format = ".12g");

/// Cells in columns with two blanks between them: each flush left where `flush` has a '<' for its column, else right.
/// Its last letter is that of all columns behind.
[[nodiscard]] std::string in_columns(const std::vector<std::vector<std::string>>& rows, std::string_view flush = ">",
                                     std::string_view indent = "  ");

/// "1 row", "2 rows".
[[nodiscard]] std::string count_text(std::size_t count, std::string_view noun);

/// "-0.5", "0.1 +- 2i": a conjugate pair by one of it.
[[nodiscard]] std::string complex_text(double real, double imaginary);

/// `text` with such a value in the place of each {NAME} or {NAME:FORMAT}, a member of `record`.
[[nodiscard]] std::string filled(std::string_view text, const Record& record);

template <class Value>
[[nodiscard]] Record or_null(const std::optional<Value>& value)
{
    return value ? Record(*value) : Record();
}

/// Adds the member, unless the text or the list is empty.
template <class Value>
void add_unless_empty(Record& object, const char* name, const Value& value)
{
    if (!value.empty()) object[name] = value;
}

/// A list with `convert` of each item.
template <class Items, class Convert>
[[nodiscard]] Record list_of(const Items& items, Convert convert)
{
    Record list = Record::array();
    for (const auto& item : items) list.push_back(convert(item));
    return list;
}

/// An object with a member a pair of name and value.
template <class Pairs, class Convert>
[[nodiscard]] Record object_of(const Pairs& pairs, Convert convert)
{
    Record object = Record::object();
    for (const auto& [name, value] : pairs) object.push_back({name, convert(value)});
    return object;
}

} // namespace lagen
