// SPDX-License-Identifier: GPL-2.0-or-later
/// What a model declares by name: symbols with what is said of them, and names that stand for expressions.
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

/// A name with a closed tree: an observable, an invariant, a Casimir, an initial value.
struct NamedTree {
    std::string name;
    Tree value;
    SourceRange where; ///< of the name
};

} // namespace lagen
