// SPDX-License-Identifier: GPL-2.0-or-later
/// Does another form of some outputs lose digits? Both are evaluated with a significand of 24 bits, and in double, at
/// states where sums of the original nearly cancel: there (a - b)^2 keeps its digits and a^2 - 2 a b + b^2 has none.
/// The states, and so the verdicts, are the same on every machine. One sum at a time is brought near zero: that the
/// terms of (a - b) + c were added in another order is not seen, as that loses digits only where two sums are small at
/// once.
#pragma once

#include "graph/core/graph.hpp"

#include <vector>

namespace lagen {

/// Remembers how well `outputs` do as they are written.
class RoundingProbe {
  public:
    RoundingProbe(const Graph& graph, std::span<const NodeId> outputs);

    /// For every output: does `form` (one node an output, in the same graph) keep its digits? It does where nowhere its
    /// relative error, the largest of a group of neighbouring states, is more than `allowed_loss` times that of the
    /// original.
    [[nodiscard]] std::vector<bool> keeps_digits(std::span<const NodeId> form) const;

    /// Factor between errors from which on a form is refused. At the distance 1e-3 that is looked at, forms of one
    /// class differ by factors up to about 15, by luck; a form that loses a cancellation is worse by 1000.
    static constexpr double allowed_loss = 32;

  private:
    using State = std::vector<double>; ///< a value for every input of the graph, in their order

    /// States around one cancellation, with what is known of the outputs there.
    struct Group {
        std::vector<State> states;
        std::vector<std::vector<double>> exact; ///< [state][output], in double
        std::vector<double> worst;              ///< [output]: largest relative error of the original; NaN: no verdict
    };

    void choose_groups(const std::vector<NodeId>& nodes);
    void add_group(std::vector<State> states);
    [[nodiscard]] std::vector<double> worst_errors(const Group& group, std::span<const NodeId> form,
                                                   const std::vector<NodeId>& nodes) const;

    const Graph& graph_;
    std::vector<NodeId> outputs_;
    std::vector<NodeId> nodes_; ///< reachable from the outputs
    std::vector<Group> groups_;
};

} // namespace lagen
