// SPDX-License-Identifier: GPL-2.0-or-later
/// Single values of a model file: expressions, texts, flags, counts, lists of names.
#pragma once

#include "expression/tree.hpp"
#include "model/toml_document.hpp"

#include <string>
#include <vector>

namespace lagen {

/// A string is parsed as an expression, an integer or decimal taken exactly (0.1 is 1/10, re-read from its text).
/// `what` opens the message where the value is anything else, e.g. "the parameter 'm'".
[[nodiscard]] Tree read_expression(const TomlValue& value, const std::string& what);

/// The same, and an array of them is a vector, an array of arrays a matrix (TreeKind::array).
[[nodiscard]] Tree read_array_expression(const TomlValue& value, const std::string& what);

/// Throws ModelError where an equation "a = b" or "a == b" stands in place of the expression a - b. `what` opens the
/// message, e.g. "the constraint".
void refuse_equation(const Excerpt& text, const std::string& what);

/// A string without control characters.
[[nodiscard]] std::string read_text(const TomlValue& value, const std::string& what);

[[nodiscard]] bool read_flag(const TomlValue& value, const std::string& what);

/// An integer in [least, most].
[[nodiscard]] long read_count(const TomlValue& value, const std::string& what, long least, long most);

/// An array of strings.
[[nodiscard]] std::vector<Excerpt> read_list(const TomlValue& value, const std::string& what);

/// The parts between commas, blanks trimmed; at least one (possibly empty) part.
[[nodiscard]] std::vector<Excerpt> split_at_commas(const Excerpt& text);

} // namespace lagen
