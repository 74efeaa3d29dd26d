// SPDX-License-Identifier: GPL-2.0-or-later
/// The rows of a run.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lagen {

struct Table {
    std::vector<std::string> columns; ///< "t", then states and observables
    std::vector<double> numbers;      ///< row after row

    /// The number of whole rows.
    [[nodiscard]] std::size_t count() const { return columns.empty() ? 0 : numbers.size() / columns.size(); }
    [[nodiscard]] std::span<const double> row(std::size_t k) const
    {
        return std::span(numbers).subspan(k * columns.size(), columns.size());
    }
    /// The last time; NaN where there is none.
    [[nodiscard]] double last_time() const;
};

/// |a - b|_2 over the columns behind t that are numbers in both.
[[nodiscard]] double row_distance(std::span<const double> a, std::span<const double> b);
/// |a|_2 over the columns behind t that are numbers.
[[nodiscard]] double row_size(std::span<const double> a);

/// RFC 4180: a heading, plain_names(columns, known), then the rows, CRLF line ends; numbers are the shortest decimals
/// that read back as they are, what is no finite number is an empty field. `known`: the names of the model.
[[nodiscard]] std::string to_csv(const Table& table, const std::vector<std::string>& known);

// The worth of the state of a run: its rows w beside the rows w' of a second, finer run of the same motion.

struct StateAccuracy {
    double estimate = 0;                 ///< the largest |w - w'|_2 of a row, divided by the largest |w'|_2
    std::optional<double> holds_until{}; ///< t of the first row where |w - w'|_2 exceeds 1e-2 of the largest |w'|_2
};

/// Rows are compared up to the first that only one of the tables has: both have the same times, unless they are
/// compared `by_number` (those of an event are). Entries that are no finite number in one of them are left out. Nothing
/// where there is no row behind the first to compare.
[[nodiscard]] std::optional<StateAccuracy> accuracy_of(const Table& run, const Table& second, bool by_number);

} // namespace lagen
