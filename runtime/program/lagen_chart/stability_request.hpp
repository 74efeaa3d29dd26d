// SPDX-License-Identifier: MIT
/// What the programs of `lagen chart --stability` are asked for in a file, and what they answer
/// (lagen_run/archive.hpp). No name of the runtime is in here.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace lagen::chart {

/// The quantity f whose change is looked at: the energy or the Hamiltonian, an invariant by its place, or the size of
/// the state, which nothing keeps.
enum class Follow { energy, invariant, size };

/// Parameters in the order of the header, and state lanes.
struct ColumnStart {
    std::vector<double> parameters, initial;

    static void each(auto& self, auto& archive) { archive(self.parameters, self.initial); }
};

/// Along the motion of a column, as far as the scene goes; stability.hpp and discrete_stability.hpp say how they are
/// found. A program leaves omega to who asks it, and answers the linear equations whose eigenvalues it is of.
struct ColumnFigures {
    double omega = 0, scale = 0, reached = 0;

    static void each(auto& self, auto& archive) { archive(self.omega, self.scale, self.reached); }
};

struct StabilityRequest {
    double start = 0, end = 0;
    Follow follow = Follow::size;
    std::size_t invariant = 0;
    std::vector<double> steps;
    std::vector<ColumnStart>
        starts; ///< of each column; of a discrete motion of each step of each column, with its step
    std::vector<ColumnFigures> figures; ///< of a discrete motion: those of the columns, where they are known
    std::size_t step = 0;               ///< of a discrete motion: the number of the parameter that is the step

    static void each(auto& self, auto& archive)
    {
        archive(self.start, self.end, self.follow, self.invariant, self.steps, self.starts, self.figures, self.step);
    }
};

/// What becomes of a run with one step.
struct StabilityCell {
    std::string outcome; ///< bounded, drifting, newton_diverged, blown_up or left_domain
    double t = 0;        ///< where it ended
    double error = 0, drift = 0;
    std::string status = "ok"; ///< of the run

    static void each(auto& self, auto& archive) { archive(self.outcome, self.t, self.error, self.drift, self.status); }
};

struct MethodFates {
    std::string name;
    std::vector<StabilityCell> cells; ///< those of the first column first
    /// Of discrete motions, of each column: the step from which on the momenta of the start have no arrow, 0 where none
    /// is met.
    std::vector<double> folds;

    static void each(auto& self, auto& archive) { archive(self.name, self.cells, self.folds); }
};

/// The linear equations along the motion of a column, of discrete motions of length `step`: matrices one after another.
struct LinearParts {
    std::size_t lanes = 0;
    double step = 0;
    std::vector<double> entries;

    static void each(auto& self, auto& archive) { archive(self.lanes, self.step, self.entries); }
};

struct StabilityAnswer {
    std::vector<ColumnFigures> columns;
    std::vector<LinearParts> linear; ///< of each column; none where the figures were given
    std::vector<MethodFates> methods;

    static void each(auto& self, auto& archive) { archive(self.columns, self.linear, self.methods); }
};

} // namespace lagen::chart
