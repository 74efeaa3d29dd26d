// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/csv_fields.hpp"

#include <algorithm>

namespace lagen {

std::vector<CsvField> csv_fields(const std::string& line)
{
    std::vector<CsvField> list;
    for (std::size_t at = 0; at <= line.size(); ++at) {
        CsvField field;
        while (at < line.size() && line[at] == ' ') ++at;
        field.begin = at;
        if (at < line.size() && line[at] == '"') {
            for (++at; at < line.size(); ++at) {
                if (line[at] == '"' && (at + 1 == line.size() || line[++at] != '"')) break;
                field.text += line[at];
            }
            at = std::min(line.find(',', at), line.size());
            field.end = at;
        } else {
            at = std::min(line.find(',', at), line.size());
            field.end = at;
            while (field.end > field.begin && line[field.end - 1] == ' ') --field.end;
            field.text = line.substr(field.begin, field.end - field.begin);
        }
        list.push_back(std::move(field));
    }
    return list;
}

} // namespace lagen
