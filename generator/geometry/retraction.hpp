// SPDX-License-Identifier: GPL-2.0-or-later
/// Curves W = tau(xi) in a group, tau Cayley's map or exp, by the components of xi over the generators; both are the
/// same along a line through 1, up to its parameter.
///   cay^-1 d cay = (1 + X/2)^-1 X' (1 - X/2)^-1,      exp^-1 d exp = exp(-X) d/ds exp(X + s X')
#pragma once

#include "geometry/exponential.hpp"
#include "geometry/generator_span.hpp"

namespace lagen {

class Retraction {
  public:
    /// Cayley's map; exp where `exponential` is not null. Keeps references to all three.
    Retraction(Graph& graph, const GroupoidParts& parts, const Exponential* exponential);

    /// tau(xi) by rows.
    [[nodiscard]] std::vector<NodeId> element(std::span<const NodeId> xi);
    /// The components of W^-1 W' where xi moves along `slope`.
    [[nodiscard]] std::vector<NodeId> body_velocity(std::span<const NodeId> xi, std::span<const NodeId> slope);

  private:
    [[nodiscard]] std::vector<NodeId> transposed(const std::vector<NodeId>& X) const;

    Graph& graph_;
    const GroupoidParts& parts_;
    const Exponential* exponential_;
    GeneratorSpan span_;
    std::vector<NodeId> rates_, velocity_; ///< of exp: inputs s', and the components over s and s'
};

} // namespace lagen
