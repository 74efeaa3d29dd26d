// SPDX-License-Identifier: GPL-2.0-or-later
#include "text/record.hpp"

#include <fmt/format.h>

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

} // namespace lagen
