// SPDX-License-Identifier: MIT
/// The observer of a run: it gives rows while the run goes on, and follows what the report tells at its end.
#pragma once

#include "lagen/integrate/options.hpp"
#include "lagen_run/figures.hpp"
#include "lagen_run/job.hpp"
#include "lagen_run/small_lanes.hpp"

#include <limits>
#include <vector>

namespace lagen::detail {

/// The value of a column, from the observables at (t, s).
template <class M>
class ColumnValues {
  public:
    explicit ColumnValues(const std::vector<DriveColumn>& columns)
    {
        for (const DriveColumn& column : columns) observes_ = observes_ || column.observable;
    }

    /// take(value) of every column.
    template <class Take>
    void each(const std::vector<DriveColumn>& columns, const M& model, double t, const typename M::State& s,
              const Take& take) const
    {
        const auto lane = [&](const DriveColumn& column) { return s[static_cast<Eigen::Index>(column.index)]; };
        if constexpr (requires { model.observables(t, s); }) {
            if (observes_) {
                const auto observables = model.observables(t, s);
                for (const DriveColumn& column : columns)
                    take(column.observable ? observables[static_cast<Eigen::Index>(column.index)] : lane(column));
                return;
            }
        }
        for (const DriveColumn& column : columns) take(lane(column));
    }

  private:
    bool observes_ = false;
};

/// row(t, s) gives a row, operator() follows what should be constant.
template <class M>
class DriveRecord {
  public:
    using State = typename M::State;

    /// `every`: rows at the start and behind every so many steps; 0 where row(t, s) is told of all of them.
    /// `absolute`: the tolerance of the method, or 0.
    DriveRecord(const M& model, std::vector<DriveColumn> columns, RowTaker out, std::size_t every = 0,
                double absolute = 0)
        : model_(model), columns_(std::move(columns)), values_(columns_), out_(std::move(out)), every_(every),
          figures_(model), small_(absolute)
    {
        line_.reserve(columns_.size() + 1);
    }

    void row(double t, const State& s)
    {
        // Rows and steps come in the order of time, so that what the model follows is continuous in the rows.
        model_.follow(t, s);
        last_time_ = t;
        line_.assign(1, t);
        values_.each(columns_, *model_, t, s, [this](double value) { line_.push_back(value); });
        out_(line_);
    }

    /// Out of line: the loop over the steps is the faster for it.
    [[gnu::noinline]] void operator()(double t, const State& s)
    {
        model_.follow(t, s);
        if (every_ > 0 && seen_++ % every_ == 0) row(t, s);
        figures_.see(*model_, t, s);
        small_.see(s);
    }

    void jump(double t, const State& from, const State& to) { figures_.jump(*model_, t, from, to); }

    [[nodiscard]] bool sums() const noexcept { return figures_.sums(); }

    /// The motion over a time h from t0 on, inside(x) its state at t0 + x h.
    template <class Inside>
    void sum(std::size_t nodes, double t0, double h, const Inside& inside) requires(HasPower<M>)
    {
        if (!follows(*model_)) return figures_.sum(nodes, *model_, t0, h, inside);
        ObservedModel<M> followed(*model_);
        figures_.sum(nodes, *followed, t0, h, [&](double x) -> const State& {
            const State& s = inside(x);
            followed.follow(t0 + x * h, s);
            return s;
        });
    }

    /// From here on the run holds this input.
    void hold_input(std::size_t k, double value) { model_.hold_input(k, value); }

    /// Of the last row; NaN before the first.
    [[nodiscard]] double last_time() const noexcept { return last_time_; }

    /// Adds what this record knows.
    void report(RunReport& report) const
    {
        figures_.report(*model_, report);
        for (Eigen::Index i = 0; i < small_.size(); ++i)
            if (small_.is_small(i)) report.below.push_back({static_cast<std::size_t>(i), small_.most(i)});
    }

  private:
    ObservedModel<M> model_;
    std::vector<DriveColumn> columns_;
    ColumnValues<M> values_;
    RowTaker out_;
    std::vector<double> line_;
    std::size_t every_ = 0, seen_ = 0;
    Figures<M> figures_;
    SmallLanes<State> small_;
    double last_time_ = std::numeric_limits<double>::quiet_NaN();
};

} // namespace lagen::detail
