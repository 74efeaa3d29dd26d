// SPDX-License-Identifier: GPL-2.0-or-later
/// Expressions and statements in C++, with the fewest parentheses, in exactly their order of evaluation.
#pragma once

#include "emit/print_literal.hpp"
#include "emit/statement.hpp"

namespace lagen {

[[nodiscard]] Spelling spell(const Expression& expression);

/// The lines of a statement, but for loads and stores, which depend on the function that it stands in. Checks are told
/// to a variable `status`, values for later parts stand in an array `work`.
[[nodiscard]] std::vector<std::string> spell(const Statement& statement);

/// The declarations by which the body calls functions of one argument or two: `using std::sin;`, sorted by function.
[[nodiscard]] std::vector<std::string> using_declarations(const Body& body);

/// The headers of the runtime whose functions the body calls: "lagen/roots.hpp", ...
[[nodiscard]] std::set<std::string> includes_of(const Body& body);

} // namespace lagen
