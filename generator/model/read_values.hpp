// SPDX-License-Identifier: GPL-2.0-or-later
/// Files, and single values of a model file, whose kinds are right already: expressions, texts, lists of names.
#pragma once

#include "expression/tree.hpp"
#include "model/toml_document.hpp"

#include <string>
#include <vector>

namespace lagen {

/// The whole content of the file. Throws ModelError: it does not exist, is a folder, cannot be opened or read, or holds
/// more than 16 MiB (pipes are read too, and bounded alike).
[[nodiscard]] std::string read_file(const std::string& path);

/// The file that a value names, by a path relative to the file that the value stands in; messages point at the value,
/// which they call `what`.
[[nodiscard]] std::shared_ptr<const SourceFile> file_named(const TomlValue& value, const std::string& what);

/// A string is parsed as an expression, an integer or decimal taken exactly (0.1 is 1/10, re-read from its text).
/// `what` opens the message where the value is anything else, e.g. "the parameter 'm'".
[[nodiscard]] Tree read_expression(const TomlValue& value, const std::string& what);

/// The same, and an array of them is a vector, an array of arrays a matrix (TreeKind::array).
[[nodiscard]] Tree read_array_expression(const TomlValue& value, const std::string& what);

/// Throws ModelError where an equation "a = b" or "a == b" stands in place of the expression a - b. `what` opens the
/// message, e.g. "the constraint".
void refuse_equation(const Excerpt& text, const std::string& what);

/// Throws ModelError where a control character stands in the text.
void require_printable(const Excerpt& text, const std::string& what);

/// The parts between commas (or another separator) outside of brackets, blanks trimmed; at least one (possibly empty)
/// part: "a", "W[1,2]" of "a, W[1,2]".
[[nodiscard]] std::vector<Excerpt> split_at_commas(const Excerpt& text, char comma = ',');

} // namespace lagen
