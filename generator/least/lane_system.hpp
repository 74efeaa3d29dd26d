// SPDX-License-Identifier: GPL-2.0-or-later
/// A motion as its lanes: what the rules of the least model work on. Of lanes s with s' = f(t, s; parameters) it knows
/// what a scene watches, where it starts, what happens at its events and where its domain ends. It is plain data that
/// a test may build by hand.
#pragma once

#include "mechanics/equations_of_motion.hpp"
#include "proof/decide.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lagen {

struct LaneSystem {
    std::shared_ptr<Graph> graph;
    NodeId time = 0;
    std::optional<NodeId> start_time = {};    ///< over parameters; nothing: 0
    std::vector<NodeId> lanes;                ///< inputs, the entries of the state
    std::vector<NodeId> rates;                ///< of each
    std::vector<std::optional<NodeId>> start; ///< of each, over parameters; nothing where it is no closed expression
    std::vector<NamedNode> watched;           ///< columns, events, what laws of inputs read: functions of t and lanes
    std::vector<NodeId> walls;                ///< comparisons on lanes that hold while the motion goes on
    std::vector<std::vector<NodeId>> jumps;   ///< the state behind each event that jumps, a node a lane
    std::vector<NamedNode> candidates;        ///< functions that may be conserved, a proof will tell
    Replacements values;                      ///< of the parameters in this scene, free of inputs
    ProofSetting setting;                     ///< lanes and parameters, and what holds of them
    std::string obstacle;                     ///< why nothing can be left out, where that is so
};

} // namespace lagen
