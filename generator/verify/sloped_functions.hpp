// SPDX-License-Identifier: GPL-2.0-or-later
/// Functions on a graph with all their first derivatives, in balls. A derivative is taken along one unit vector after
/// the other, so that it is no longer than the functions are.
#pragma once

#include "proof/interval_newton.hpp"

namespace lagen {

class SlopedFunctions {
  public:
    /// Over the inputs z alone. The graph lives longer.
    SlopedFunctions(Graph& graph, std::vector<NodeId> functions, const std::vector<NodeId>& z);

    /// The functions, k x 1, and their slopes, k x n. The slope of |x| is sign(x), all of [-1, 1] where x may be 0.
    [[nodiscard]] proof::NewtonEquations at(const std::vector<proof::Ball>& z, slong bits) const;

  private:
    std::size_t count_;
    std::vector<NodeId> z_, along_;
    std::optional<proof::Evaluation> values_;
};

} // namespace lagen
