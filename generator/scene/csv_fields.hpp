// SPDX-License-Identifier: GPL-2.0-or-later
/// The fields of a line of CSV (RFC 4180).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace lagen {

/// A field with the place of its text in its line.
struct CsvField {
    std::string text;
    std::size_t begin = 0, end = 0;
};

/// Blanks and quotes around them are taken away.
[[nodiscard]] std::vector<CsvField> csv_fields(const std::string& line);

} // namespace lagen
