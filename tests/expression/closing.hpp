// SPDX-License-Identifier: GPL-2.0-or-later
/// Short forms for the tests of closing, and the numbers that closed trees have.
#pragma once

#include "expression/scope.hpp"

#include <map>
#include <string>
#include <vector>

namespace lagen::test {

/// name = body, or name(parameters) = body.
[[nodiscard]] Definition definition(const std::string& name, const std::string& body,
                                    std::vector<std::string> parameters = {});

/// Symbols a, b, c, s; vectors u, v, w of 3 and p of 2; matrices A, B 3 x 3, M 2 x 2, R 2 x 3; x of n entries; size n.
[[nodiscard]] Scope array_scope(long n = 4);

/// The text of what `text` closes to: a scalar, "[a, b]" or "[[a, b], [c, d]]"; or of its error.
[[nodiscard]] std::string closed_text(const Scope& scope, const std::string& text);
/// The sentence of its error alone.
[[nodiscard]] std::string closing_error(const Scope& scope, const std::string& text);

/// Nodes of a closed tree, each shared one once, and the arguments that they have together.
struct TreeSize {
    std::size_t nodes = 0;
    std::size_t arguments = 0;
};
[[nodiscard]] TreeSize size_of(const Tree& tree);

/// The value of a closed tree where its symbols have these values.
using Point = std::map<std::string, double>;
[[nodiscard]] double value_at(const Tree& tree, const Point& point);

} // namespace lagen::test
