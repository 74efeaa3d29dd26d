// SPDX-License-Identifier: MIT
/// What the program behind `lagen sweep` keeps of a trajectory: the columns at its end and their extremes.
#pragma once

#include "lagen_run/record.hpp"

#include <cmath>
#include <limits>

namespace lagen::detail {

/// The observer of a trajectory: the columns at accepted steps and at rows.
template <class M>
class SweepRecord {
  public:
    using State = typename M::State;

    /// `absolute`: the tolerance of the method, or 0.
    SweepRecord(const M& model, const std::vector<DriveColumn>& columns, double absolute = 0)
        : model_(model), columns_(columns), columns_of_(columns), values_(columns.size(), nothing), least_(values_),
          most_(values_), small_(absolute)
    {
    }

    void operator()(double t, const State& s)
    {
        small_.see(s); // at accepted steps, as a run does: a row inside a long step is its polynomial's
        row(t, s);
    }
    void row(double t, const State& s)
    {
        model_.follow(t, s);
        std::size_t k = 0;
        columns_of_.each(columns_, *model_, t, s, [&](double x) {
            values_[k] = x;
            if (x < least_[k] || std::isnan(least_[k])) least_[k] = x;
            if (x > most_[k] || std::isnan(most_[k])) most_[k] = x;
            ++k;
        });
    }

    /// At the last step; NaN where there was none.
    [[nodiscard]] const std::vector<double>& values() const noexcept { return values_; }
    [[nodiscard]] const std::vector<double>& least() const noexcept { return least_; }
    [[nodiscard]] const std::vector<double>& most() const noexcept { return most_; }
    [[nodiscard]] const SmallLanes<State>& small_lanes() const noexcept { return small_; }

  private:
    static constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

    ObservedModel<M> model_;
    const std::vector<DriveColumn>& columns_;
    ColumnValues<M> columns_of_;
    std::vector<double> values_, least_, most_;
    SmallLanes<State> small_;
};

} // namespace lagen::detail
