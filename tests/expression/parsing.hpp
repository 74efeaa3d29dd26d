// SPDX-License-Identifier: GPL-2.0-or-later
/// Short forms for the tests of expressions.
#pragma once

#include "expression/parse.hpp"
#include "expression/scope.hpp"

#include <string>

namespace lagen::test {

inline Tree parse(const std::string& text)
{
    return parse_expression(whole_text("e", text));
}

/// The full structure of a tree, every operation in brackets: (add x (negate y)).
std::string structure(const Tree& tree);

/// The text of the ModelError that parsing causes; "accepted" where there is none.
std::string error_of(const std::string& text);
std::string error_of_comparison(const std::string& text);
/// Its sentence alone.
std::string sentence_of(const std::string& text);

} // namespace lagen::test
