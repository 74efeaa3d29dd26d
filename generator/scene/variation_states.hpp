// SPDX-License-Identifier: GPL-2.0-or-later
/// Variations along a motion as first-order states beside it (mechanics/variations.hpp): the action with its first and
/// second variations by random sections that vanish at both ends of a scene, and a Jacobi field.
#pragma once

#include "mechanics/system.hpp"
#include "scene/run_outcome.hpp"
#include "scene/sample_times.hpp"

namespace lagen {

/// Which variations a run has.
struct VariationRequest {
    std::size_t count = 0; ///< of random variations; 0: neither these nor the action
    std::uint64_t seed = 0;
    std::vector<NamedTree> field; ///< where a Jacobi field starts: delta y^a by fibre coordinates; empty: none

    [[nodiscard]] bool any() const { return count > 0 || !field.empty(); }
};

/// Adds the states to `model`, whose `system` is given, and to the columns of its scene:
///   action, action.K.base, action.K.fibre, action.K.second of variation K = 1, 2, ..: integrals of L, of the parts
///   rho_a(L) s^a and p_a delta y^a of delta L, of delta^2 L, s^a = sum_k c_k^a sin(k pi (t - start)/(end - start)),
///   k = 1, 2, 3, with c random in [-1, 1];   action.K.squares: the integral of (end - start) times the squares of the
///   terms rho_a(L) s^a, p_a sdot^a, p_a C^a_bc y^b s^c of delta L;   sigma.NAME, delta.NAME of the Jacobi field.
/// Throws MathematicsError where the motions are no critical points of an action, and, by where it stands, for the
/// start of a field that is no fibre coordinate.
void add_variation_states(Model& model, const System& system, Scene& scene, const VariationRequest& request,
                          const SampleTimes& times);

/// Reads the variations at the end of a run out of its last state.
[[nodiscard]] std::optional<ActionReport> action_report(const RunOutcome& outcome, const VariationRequest& request);

} // namespace lagen
