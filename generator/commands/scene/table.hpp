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

/// Names of columns as identifiers, all different: x[1] is x_1, W[1,1] is W_1_1; one that was there before gets a
/// number.
[[nodiscard]] std::vector<std::string> csv_names(const std::vector<std::string>& names);

/// RFC 4180: a heading of `csv_names`, then the rows, CRLF line ends.
[[nodiscard]] std::string to_csv(const Table& table);

} // namespace lagen
