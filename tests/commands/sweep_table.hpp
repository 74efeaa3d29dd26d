// SPDX-License-Identifier: GPL-2.0-or-later
/// Tables of CSV without quoted fields.
#pragma once

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

namespace lagen::testing {

struct CsvTable {
    std::vector<std::string> heading;
    std::vector<std::vector<std::string>> rows;

    [[nodiscard]] const std::string& at(std::size_t row, const std::string& column) const
    {
        const auto found = std::find(heading.begin(), heading.end(), column);
        INFO(column);
        REQUIRE(found != heading.end());
        return rows.at(row).at(static_cast<std::size_t>(found - heading.begin()));
    }
};

/// Lines that end with CRLF.
inline CsvTable read_csv(const std::string& text)
{
    CsvTable table;
    for (std::size_t begin = 0, end = 0; (end = text.find("\r\n", begin)) != std::string::npos; begin = end + 2) {
        std::vector<std::string> fields(1);
        for (const char c : text.substr(begin, end - begin))
            if (c == ',')
                fields.emplace_back();
            else
                fields.back() += c;
        if (table.heading.empty())
            table.heading = fields;
        else
            table.rows.push_back(fields);
    }
    return table;
}

/// NaN for an empty field.
inline double number_of(const std::string& field)
{
    return field.empty() ? std::numeric_limits<double>::quiet_NaN() : std::strtod(field.c_str(), nullptr);
}

} // namespace lagen::testing
