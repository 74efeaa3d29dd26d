// SPDX-License-Identifier: GPL-2.0-or-later
/// Names that a model declares: symbols with what is said of them, and names that stand for expressions.
#pragma once

#include "expression/tree.hpp"

namespace lagen {

/// A declared symbol. `text`, `unit` and `latex` come from [about] and may be empty.
struct Symbol {
    std::string name;
    SourceRange where;
    std::string text;
    std::string unit;
    std::string latex;
};

/// The LaTeX symbol with something below it: in braces where it has a subscript, an exponent or a space of its own.
[[nodiscard]] inline std::string with_below(const std::string& latex, const std::string& below)
{
    const bool plain = latex.find_first_of("_^ ") == std::string::npos;
    return (plain ? latex : "{" + latex + "}") + "_{" + below + "}";
}

/// A name with a closed tree: an observable, an invariant, a Casimir, an initial value.
struct NamedTree {
    std::string name;
    Tree value;
    SourceRange where; ///< of the name
};

} // namespace lagen
