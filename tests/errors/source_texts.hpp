// SPDX-License-Identifier: GPL-2.0-or-later
/// The string literals of a C++ file, read by a small lexer: enough to know what text a function is called with.
#pragma once

#include <string>
#include <vector>

namespace lagen::errors {

/// Adjacent literals are one. Escapes \" \\ \n are decoded, others kept as they stand.
struct SourceText {
    std::string text;
    std::vector<std::string> calls; ///< names before the parentheses that are open here, the outermost first
};

/// The literals of `source` in order, those of comments and preprocessor lines left out.
[[nodiscard]] std::vector<SourceText> string_literals(const std::string& source);

/// `format` cut at each {..}; {{ and }} are braces.
[[nodiscard]] std::vector<std::string> fixed_parts(const std::string& format);

/// Could fmt::format (or a sum of strings) have made a passage of `example` from a format with these fixed parts? They
/// must stand in `example` in their order.
[[nodiscard]] bool is_made_from(const std::string& example, const std::vector<std::string>& parts);

/// Words of two letters and more outside of {..}.
[[nodiscard]] std::size_t word_count(const std::string& format);

} // namespace lagen::errors
