// SPDX-License-Identifier: GPL-2.0-or-later
/// A system on its way to the least one, and the rules that make it smaller. A rule first *restricts* to a set that
/// motions do not leave and that holds the start, or *projects* onto lanes whose rates are free of the others.
///
/// How a rule is added: a file with a function that answers true where it made the system smaller, and a row in the
/// table of rules.cpp.
#pragma once

#include "least/lane_system.hpp"
#include "least/prover.hpp"

#include <span>

namespace lagen {

/// What a rule did to one lane.
struct LeastStep {
    std::string rule; ///< kept, constant, momentum, watched, differences or own_equation
    std::string lane;
    std::optional<NodeId> value = {};   ///< of the lane, over the lanes that are left and constants
    std::vector<NodeId> relations = {}; ///< parameters that have the scene's value alone
    std::string conserved = {};         ///< of momentum: the name of the function
};

/// An input that has one value all along.
struct StartConstant {
    NodeId input = 0;
    std::optional<NodeId> value =
        {};                ///< at the start, over parameters; nothing where the start is no closed expression
    std::string name = {}; ///< of the conserved function, or of the lane
};

/// Copies share the graph and nothing else.
struct Reduction {
    LaneSystem system;
    Prover prover;
    std::vector<LeastStep> steps;
    std::vector<StartConstant> constants;
    std::vector<NodeId> left_out; ///< lanes that nothing watched depends on
    std::vector<NodeId> written;  ///< the rates of the lanes, over these and the lanes that `definitions` give
    Replacements definitions;     ///< lanes that a conserved function gives, each over the lanes and those behind it
    std::vector<std::string> not_followed; ///< conserved functions that are no functions of what is left

    explicit Reduction(LaneSystem given);

    [[nodiscard]] Graph& graph() const { return *system.graph; }
    [[nodiscard]] std::string name_of(NodeId lane) const { return graph().input_name(lane); }
    /// Puts values in the place of lanes in all functions, which are lanes no more; false, and nothing changes, where
    /// that makes something undefined. `holds`: the lanes have these values along the motion, so that what is known of
    /// them is known of the values; else nothing depends on these lanes.
    [[nodiscard]] bool replace(const Replacements& values, bool holds);
    /// The same of one lane that has this value, which stays a name in `written`.
    [[nodiscard]] bool define(NodeId lane, NodeId value);
    /// Lanes that are constants from now on.
    void hold(const std::vector<NodeId>& lanes);
    /// The functions of what is watched, and of the walls: what the motion must give.
    [[nodiscard]] std::vector<NodeId> wanted() const;
    /// True where no jump changes this function.
    [[nodiscard]] bool survives_jumps(NodeId function);
    /// The derivative of a function along the motion.
    [[nodiscard]] NodeId rate_of(NodeId function) const;
    /// A function at the start, over parameters; nothing where it is no closed expression there.
    [[nodiscard]] std::optional<NodeId> at_start(NodeId function) const;
    /// Leaves lanes out of what is known of each lane.
    void erase(const std::vector<NodeId>& lanes);
};

struct LeastRule {
    const char* name;
    bool (*apply)(Reduction& reduction);
};
/// In the order in which they are tried, again and again until none of them makes the system smaller.
[[nodiscard]] std::span<const LeastRule> least_rules();

// The rules, a file each.

/// kept: the set where lanes with an exact start keep it, or are equal and opposite to others.
[[nodiscard]] bool keep_invariant_set(Reduction& reduction);
/// constant: a lane whose rate is 0 becomes a constant of the start.
[[nodiscard]] bool hold_constants(Reduction& reduction);
/// watched: lanes that neither what is watched nor the rates of what is kept depend on are left out.
[[nodiscard]] bool leave_out_unwatched(Reduction& reduction);
/// momentum: a conserved function F that is affine in a lane gives that lane.
[[nodiscard]] bool solve_by_conserved(Reduction& reduction);
/// differences: linear functions of the lanes whose rates depend on them alone.
[[nodiscard]] bool lump_lanes(Reduction& reduction);
/// own_equation: the one watched function h has h'' = F(h; constants).
[[nodiscard]] bool find_own_equation(Reduction& reduction);

} // namespace lagen
