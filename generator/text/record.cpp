// SPDX-License-Identifier: GPL-2.0-or-later
#include "text/record.hpp"

#include "text/comma_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lagen {

namespace {

void append(std::string& text, const Record& record);

/// As the library prints it; bytes that are no UTF-8 become U+FFFD.
std::string dumped(const Record& record)
{
    return record.dump(-1, ' ', false, Record::error_handler_t::replace);
}

/// Entries between brackets, each printed by `print`.
template <class Print>
void append_entries(std::string& text, const Record& record, char open, char close, Print print)
{
    text += open;
    bool first = true;
    for (auto entry = record.begin(); entry != record.end(); ++entry) {
        if (!first) text += ", ";
        first = false;
        print(entry);
    }
    text += close;
}

void append(std::string& text, const Record& record)
{
    if (record.is_object()) {
        append_entries(text, record, '{', '}', [&](const auto& member) {
            text += dumped(member.key()) + ": ";
            append(text, *member);
        });
    } else if (record.is_array()) {
        append_entries(text, record, '[', ']', [&](const auto& entry) { append(text, *entry); });
    } else if (record.is_number_float()) {
        const auto number = record.get<double>();
        text += std::isfinite(number) ? fmt::format("{}", number) : "null";
    } else {
        text += dumped(record);
    }
}

} // namespace

std::string to_json(const Record& record)
{
    std::string text;
    append(text, record);
    return text;
}

std::string with_member(std::string object, std::string_view name, std::string_view json)
{
    object.pop_back();
    return fmt::format("{}{}{}: {}}}", object, object.size() > 1 ? ", " : "", dumped(name), json);
}

std::string labelled(std::string_view label, std::string_view value)
{
    return fmt::format("  {:<15} {}\n", label, value);
}

std::string value_text(const Record& value, std::string_view format)
{
    if (value.is_null()) return "";
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number_float()) {
        const auto number = value.get<double>();
        return fmt::format(fmt::runtime(fmt::format("{{:{}}}", format)), number == 0 ? 0 : number); // no -0
    }
    if (value.is_object())
        return comma_list(value.items(), [&](const auto& each) {
            return fmt::format("{} = {}", each.key(), value_text(each.value(), format));
        });
    return value.is_array() ? comma_list(value, [&](const Record& each) { return value_text(each, format); })
                            : value.dump();
}

std::string in_columns(const std::vector<std::vector<std::string>>& rows, std::string_view flush,
                       std::string_view indent)
{
    std::vector<std::size_t> widths;
    for (const auto& row : rows) {
        widths.resize(std::max(widths.size(), row.size()), 0);
        for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], row[k].size());
    }
    std::string text;
    for (const auto& row : rows) {
        for (std::size_t k = 0; k < row.size(); ++k) {
            const std::string blanks(widths[k] - row[k].size(), ' ');
            text.append(k == 0 ? indent : "  ");
            text += flush[std::min(k, flush.size() - 1)] == '<' ? row[k] + blanks : blanks + row[k];
        }
        text.erase(text.find_last_not_of(' ') + 1);
        text += "\n";
    }
    return text;
}

std::string count_text(std::size_t count, std::string_view noun)
{
    return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string complex_text(double real, double imaginary)
{
    if (imaginary == 0) return value_text(real, ".6g");
    return fmt::format("{}{:.6g}i", real == 0 ? "+-" : value_text(real, ".6g") + " +- ", std::fabs(imaginary));
}

std::string filled(std::string_view text, const Record& record)
{
    std::string out;
    for (std::size_t begin = 0, at = 0;; begin = at + 1) {
        at = text.find('{', begin);
        out += text.substr(begin, at - begin);
        if (at == std::string_view::npos) return out;
        const std::size_t end = text.find('}', at), colon = std::min(text.find(':', at), end);
        const auto member = record.find(std::string(text.substr(at + 1, colon - at - 1)));
        if (member != record.end())
            out += colon == end ? value_text(*member) : value_text(*member, text.substr(colon + 1, end - colon - 1));
        at = end;
    }
}

} // namespace lagen
