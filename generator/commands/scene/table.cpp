// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/scene/table.hpp"

#include "model/plain_names.hpp"

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

std::string to_csv(const Table& table, const std::vector<std::string>& known)
{
    std::string text;
    for (const std::string& column : plain_names(table.columns, known)) text += (text.empty() ? "" : ",") + column;
    text += "\r\n";
    text.reserve(text.size() + table.rows.size() + table.count);
    for (const std::string_view line : table.lines()) text.append(line).append("\r\n");
    return text;
}

} // namespace lagen
