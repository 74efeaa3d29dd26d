// SPDX-License-Identifier: MIT
/// What is known of a run at its end, besides its rows.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace lagen::detail {

inline constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// A crossing that was found, in the order of the run.
struct FoundCrossing {
    std::string name;
    double t = 0;
    std::vector<double> state, after; ///< `after`: behind all jumps of that instant, where it jumps

    static void each(auto& self, auto& archive) { archive(self.name, self.t, self.state, self.after); }
};

/// How a function moved that should be constant, or 0 where it is a constraint: over the steps that figures.hpp names.
struct Drift {
    std::string name;
    double initial = not_known;
    double most = not_known, t = not_known;      ///< the largest |f(t) - f(t_0)|, of a constraint |f(t)|, and its time
    double slope = not_known, error = not_known; ///< of slope.hpp
    /// Where it moved by more than 1e-3 of |f|: the size of figures.hpp, and when it first moved by 1e-3 of that.
    double size = not_known, moved_at = not_known;

    static void each(auto& self, auto& archive)
    {
        archive(self.name, self.initial, self.most, self.t, self.slope, self.error, self.size, self.moved_at);
    }
};

/// A lane that moved and never exceeded the absolute tolerance, and the largest |s_i|.
struct SmallLane {
    std::size_t lane = 0;
    double most = 0;

    static void each(auto& self, auto& archive) { archive(self.lane, self.most); }
};

struct RunReport {
    std::string status;           ///< as to_text(Status)
    double t = not_known;         ///< of the last good state
    double failed_at = not_known; ///< when the run met what ended it; t where nothing failed
    std::size_t steps = 0, rejected = 0, rhs_calls = 0;
    std::size_t newton = 0, decompositions = 0; ///< of implicit methods
    double seconds = 0;
    std::vector<FoundCrossing> events;
    std::vector<std::string> starts_on; ///< events on or beyond whose zero the run starts, which do not happen there
    std::vector<Drift> invariants;      ///< the energy or the Hamiltonian is the first, where there is one
    std::vector<Drift> casimirs, constraints;
    std::vector<Drift> balance;     ///< one of the energy less the work, where forces or time change the energy
    double work = not_known;        ///< the integral of their power
    std::optional<double> manifold; ///< the largest distance, to first order, from where the constraints hold
    double manifold_t = not_known;
    std::vector<SmallLane> below;
    /// Distances of the arrows that are found with the momenta of a discrete start: with a branch asked for, and where
    /// no step leads on from momenta.
    std::optional<std::vector<double>> branches;
    std::vector<double> state; ///< the last good one

    static void each(auto& self, auto& archive)
    {
        archive(self.status, self.t, self.failed_at, self.steps, self.rejected, self.rhs_calls, self.newton,
                self.decompositions, self.seconds, self.events, self.starts_on, self.invariants, self.casimirs,
                self.constraints, self.balance, self.work, self.manifold, self.manifold_t, self.below, self.branches,
                self.state);
    }
};

} // namespace lagen::detail
