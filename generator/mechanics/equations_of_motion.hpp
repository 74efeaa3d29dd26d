// SPDX-License-Identifier: GPL-2.0-or-later
/// Rates of functions along the equations of motion of a model, whichever form they have.
#pragma once

#include "mechanics/system.hpp"

namespace lagen {

/// A node, and what it is called where it is too long to be read.
struct NamedNode {
    NodeId node;
    std::string name;
};

/// A rate, or why there is none.
struct Rate {
    std::optional<NodeId> value = {};
    std::string obstacle = {};
    bool for_every_control = false; ///< `value` contains controls that are not solved for, for the reason `obstacle`:
                                    ///< it is the rate where it vanishes for all of them, and says nothing otherwise
    std::vector<NamedNode> divisors = {}; ///< determinants that must not vanish for `value` to be the rate
};

class EquationsOfMotion {
  public:
    virtual ~EquationsOfMotion() = default;

    /// What the names that a system does not declare stand for, to lower claims with; nodes may be stand-ins, which
    /// `rate` and `in_states` know.
    [[nodiscard]] virtual Binding names() const = 0;

    /// df/dt of a node that may contain stand-ins; the result is free of them.
    [[nodiscard]] virtual Rate rate(NodeId f) = 0;

    /// f without stand-ins.
    [[nodiscard]] virtual NodeId in_states(NodeId f) = 0;
};

} // namespace lagen
