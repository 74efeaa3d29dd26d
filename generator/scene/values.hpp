// SPDX-License-Identifier: GPL-2.0-or-later
/// Numbers out of the closed trees of a scene, in long double.
#pragma once

#include "graph/core/graph.hpp"

#include <map>
#include <optional>
#include <string>
#include <unordered_map>

namespace lagen {

/// Numbers by name.
using Values = std::map<std::string, long double>;

/// Trees in numbers; each is lowered once, however often it is evaluated.
class TreeValues {
  public:
    /// The value of `tree` with names bound to `values`. A comparison has the value 1 or 0. Undefined operations give
    /// nan or infinities, as in IEEE arithmetic. Throws ModelError where a divisor is the constant 0.
    [[nodiscard]] long double operator()(const Tree& tree, const Values& values);

  private:
    struct Lowered {
        Graph graph;
        NodeId root;
    };
    std::unordered_map<Tree, Lowered> lowered_; ///< looked up, never iterated
};

/// The value of a tree without names, where that is rational.
[[nodiscard]] std::optional<Rational> exact_value(const Tree& tree);

} // namespace lagen
