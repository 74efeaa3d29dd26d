// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/scene/table.hpp"

#include <algorithm>
#include <cctype>

namespace lagen {

namespace {

/// The pieces of `text` between separators, the last one included.
std::vector<std::string_view> pieces(std::string_view text, char separator)
{
    std::vector<std::string_view> list;
    for (std::size_t begin = 0, end = 0; end != std::string_view::npos; begin = end + 1) {
        end = text.find(separator, begin);
        list.push_back(text.substr(begin, end == std::string_view::npos ? end : end - begin));
    }
    return list;
}

} // namespace

std::vector<std::string_view> Table::lines() const
{
    std::vector<std::string_view> list = pieces(rows, '\n');
    if (list.back().empty()) list.pop_back(); // every line ends
    return list;
}

std::vector<std::string_view> fields(std::string_view line)
{
    return pieces(line, ',');
}

std::vector<std::string> csv_names(const std::vector<std::string>& names)
{
    std::vector<std::string> found;
    for (const std::string& name : names) {
        std::string plain;
        for (const char c : name) {
            const auto byte = static_cast<unsigned char>(c);
            const bool letter = byte >= 0x80 || c == '_' || std::isalnum(byte) != 0;
            if (letter || (!plain.empty() && plain.back() != '_')) plain += letter ? c : '_';
        }
        if (!plain.empty() && plain.back() == '_' && !name.ends_with('_')) plain.pop_back();
        if (plain.empty() || std::isdigit(static_cast<unsigned char>(plain[0])) != 0) plain = '_' + plain;
        std::string fresh = plain;
        for (int k = 2; std::find(found.begin(), found.end(), fresh) != found.end(); ++k)
            fresh = plain + '_' + std::to_string(k);
        found.push_back(fresh);
    }
    return found;
}

std::string to_csv(const Table& table)
{
    std::string text;
    for (const std::string& column : csv_names(table.columns)) text += (text.empty() ? "" : ",") + column;
    text += "\r\n";
    text.reserve(text.size() + table.rows.size() + table.count);
    for (const std::string_view line : table.lines()) text.append(line).append("\r\n");
    return text;
}

} // namespace lagen
