// SPDX-License-Identifier: GPL-2.0-or-later
/// The rows of a run: kept as the text that the scene's program printed, so that no digit is lost or invented.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace lagen {

struct Table {
    std::vector<std::string> columns; ///< "t", then states and observables
    std::string rows;                 ///< CSV lines without the heading, '\n' after each
    std::size_t count = 0;            ///< of rows

    /// The lines of `rows`.
    [[nodiscard]] std::vector<std::string_view> lines() const;
};

/// The fields of one CSV line of numbers; an empty one stands for what is no finite number.
[[nodiscard]] std::vector<std::string_view> fields(std::string_view line);

/// RFC 4180: a heading, plain_names(columns, known), then the rows, CRLF line ends. `known`: the names of the model.
[[nodiscard]] std::string to_csv(const Table& table, const std::vector<std::string>& known);

} // namespace lagen
