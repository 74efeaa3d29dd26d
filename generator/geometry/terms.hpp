// SPDX-License-Identifier: GPL-2.0-or-later
/// Terms of several sums at once, each under the free index that it belongs to.
#pragma once

#include "graph/core/graph.hpp"

#include <map>

namespace lagen {

template <class Index>
class Terms {
  public:
    void add(const Index& free, NodeId term) { terms_[free].push_back(term); }

    /// One sum for each free index that occurs, its terms in the order in which they came. A sum may be the constant 0,
    /// where its terms cancel.
    [[nodiscard]] std::map<Index, NodeId> sums(Graph& graph) const
    {
        std::map<Index, NodeId> result;
        for (const auto& [free, terms] : terms_) result.emplace(free, graph.sum(terms));
        return result;
    }

  private:
    std::map<Index, std::vector<NodeId>> terms_;
};

} // namespace lagen
