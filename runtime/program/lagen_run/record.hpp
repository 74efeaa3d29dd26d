// SPDX-License-Identifier: MIT
/// What the program behind `lagen run` writes: rows while the run goes on, figures for the report at its end.
#pragma once

#include "lagen/integrate/options.hpp"
#include "lagen_run/figures.hpp"
#include "lagen_run/small_lanes.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace lagen::detail {

/// A column: state lane or entry of observables().
struct DriveColumn {
    bool observable = false;
    Eigen::Index index = 0;
};

/// Takes the rows of a run, one after another.
using RowSink = std::function<void(std::string_view)>;

/// The observer of a run: row(t, s) writes, operator() follows what should be constant.
template <class M>
class DriveRecord {
  public:
    using State = typename M::State;

    /// `every`: rows at the start and behind every so many steps; 0 where row(t, s) is told of all of them.
    /// `absolute`: the tolerance of the method, or 0.
    DriveRecord(const M& model, std::vector<DriveColumn> columns, bool binary, RowSink out, std::size_t every = 0,
                double absolute = 0)
        : model_(model), columns_(std::move(columns)), binary_(binary), out_(std::move(out)), every_(every),
          figures_(model), small_(absolute)
    {
    }

    void row(double t, const State& s)
    {
        // Rows and steps come in the order of time, so that what the model follows is continuous in the rows.
        model_.follow(t, s);
        last_time_ = t;
        line_.clear();
        write(t);
        if constexpr (requires(const M& model) { model.observables(t, s); }) {
            const auto observables = (*model_).observables(t, s);
            for (const DriveColumn& column : columns_)
                write(column.observable ? observables[column.index] : s[column.index]);
        } else {
            for (const DriveColumn& column : columns_) write(s[column.index]);
        }
        if (!binary_) line_.back() = '\n';
        out_(line_);
        ++rows_;
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

    [[nodiscard]] std::size_t rows() const noexcept { return rows_; }
    /// Of the last row; NaN before the first.
    [[nodiscard]] double last_time() const noexcept { return last_time_; }

    /// The lines of the report that this record knows.
    [[nodiscard]] std::string report() const
    {
        std::string text = figures_.report(*model_);
        for (Eigen::Index i = 0; i < small_.size(); ++i)
            if (small_.is_small(i)) text += "below=" + std::to_string(i) + ':' + number_text(small_.most(i)) + '\n';
        return text;
    }

  private:
    /// A field and a comma; native doubles have none.
    void write(double value)
    {
        if (binary_) {
            line_.append(reinterpret_cast<const char*>(&value), sizeof value);
            return;
        }
        append_number(line_, value);
        line_ += ',';
    }

    ObservedModel<M> model_;
    std::vector<DriveColumn> columns_;
    bool binary_;
    RowSink out_;
    std::string line_;
    std::size_t every_ = 0, seen_ = 0;
    Figures<M> figures_;
    SmallLanes<State> small_;
    std::size_t rows_ = 0;
    double last_time_ = std::numeric_limits<double>::quiet_NaN();
};

} // namespace lagen::detail
