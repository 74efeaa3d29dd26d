// SPDX-License-Identifier: MIT
/// What the programs of `lagen chart --stability` are asked for in a file, and what they answer
/// (lagen_run/archive.hpp). No name of the runtime is in here.
#pragma once

#include <algorithm>
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
    bool linear = true; ///< are the linear equations of columns wanted?
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
        archive(self.linear, self.start, self.end, self.follow, self.invariant, self.steps, self.starts, self.figures,
                self.step);
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

/// The linear equations along the motion of a column, of discrete motions of length `step`: matrices one after another,
/// at steps as far apart as it takes to keep no more than `most` of them.
struct LinearParts {
    std::size_t lanes = 0, most = 0;
    double step = 0;
    std::vector<double> entries;

    /// Is the next step one of them? Where there are as many as there may be every second one goes.
    [[nodiscard]] bool wants_next()
    {
        const std::size_t size = lanes * lanes;
        if (most == 0 || seen_++ % every_ != 0) return false;
        if (entries.size() < most * size) return true;
        for (std::size_t k = 0; 2 * k * size < entries.size(); ++k)
            std::copy_n(&entries[2 * k * size], size, &entries[k * size]);
        entries.resize((most + 1) / 2 * size);
        every_ *= 2;
        return (seen_ - 1) % every_ == 0;
    }

    static void each(auto& self, auto& archive) { archive(self.lanes, self.step, self.entries); }

  private:
    std::size_t seen_ = 0, every_ = 1;
};

/// Of each of so many columns of a model with so many lanes: together they are no more than 32 MB.
[[nodiscard]] inline std::size_t most_matrices(std::size_t columns, std::size_t lanes)
{
    return std::clamp<std::size_t>(4'000'000 / std::max<std::size_t>(1, columns * lanes * lanes), 2, 4000);
}

struct StabilityAnswer {
    std::vector<ColumnFigures> columns;
    std::vector<LinearParts> linear; ///< of each column; none where the figures were given
    std::vector<MethodFates> methods;

    static void each(auto& self, auto& archive) { archive(self.columns, self.linear, self.methods); }
};

} // namespace lagen::chart
