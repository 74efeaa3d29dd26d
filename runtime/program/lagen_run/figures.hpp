// SPDX-License-Identifier: MIT
/// What is followed along a run because the equations keep it, or because it tells of the motion. At every accepted
/// step: how far energy (or Pontryagin's Hamiltonian), the energy less the work of its power, invariants and base
/// constraints (whose values should be 0) moved. At the steps that slope.hpp takes, which are so few of a long run that
/// they cost nothing: Casimirs, slopes, and the distance from where the constraints hold. What a function gains in a
/// jump is no part of how far it moved.
///
/// The size of a function f is sum_i |s_i df/ds_i| at the start, or |f| where that is larger; where both are 0, it is
/// |s| |df/ds|. It is computed only where f moved by more than 1e-3 of |f|.
#pragma once

#include "lagen/integrate/collocation.hpp"
#include "lagen/kernel.hpp"
#include "lagen_run/model_parts.hpp"
#include "lagen_run/report.hpp"
#include "lagen_run/slope.hpp"

#include <algorithm>
#include <vector>

namespace lagen::detail {

template <class M>
class Figures {
  public:
    using State = typename M::State;

    /// Of the functions that the model has; memory is taken here.
    explicit Figures(const M& model)
        : follows_energy_(has_energy(model) || has_hamiltonian(model)), balances_(follows_energy_ && has_power(model)),
          constraints_(constraints_of(model).size()),
          watched_(constraints_ + invariants_of(model).size() + (follows_energy_ ? 1 : 0) + (balances_ ? 1 : 0)),
          count_(watched_ + casimirs_of(model).size())
    {
        for (Values* values : {&initial_, &most_t_, &size_, &moved_at_}) values->assign(count_, nothing);
        for (Values* values : {&reference_, &most_, &allowed_, &seen_}) values->assign(count_, 0.0);
        for (Values* values : {&nodes_, &weights_}) values->reserve(most_nodes);
        means_.begin(count_);
    }

    void see(const M& model, double t, const State& s)
    {
        if (!begun_) [[unlikely]]
            begin(model, t, s);
        // Values of a compiled model stand until the next ones are asked for, which `watch` may do.
        std::size_t next = 0;
        visit_watched(model, t, s, work_, [&](double value) { seen_[next++] = value; });
        for (std::size_t k = 0; k < watched_; ++k) watch(model, k, t, seen_[k]);
        if (means_.wants()) look(model, t, s);
    }

    /// Is there a balance of energy and work, which asks for `sum`?
    [[nodiscard]] bool sums() const noexcept { return balances_; }

    /// The motion over a time h from t0 on, inside(x) its state at t0 + x h: the work of the power, by Gauss' formula
    /// with so many nodes. It is asked for only where `sums` says so.
    template <class Inside>
    void sum(std::size_t nodes, const M& model, double t0, double h, const Inside& inside) requires(HasPower<M>)
    {
        if (nodes_.size() != nodes) {
            nodes_.resize(nodes);
            weights_.resize(nodes);
            legendre_nodes<double>(nodes_, weights_);
        }
        for (std::size_t i = 0; i < nodes; ++i) {
            const double x = (1 + nodes_[i]) / 2;
            work_ += h * weights_[i] * static_cast<double>(model.power(t0 + x * h, inside(x)));
        }
        sums_ = true;
    }

    /// A jump at t from a state to another one.
    void jump(const M& model, double t, const State& from, const State& to)
    {
        const Values before = all_values(model, t, from), after = all_values(model, t, to);
        for (std::size_t k = 0; k < count_; ++k)
            if (k + constraints_ < watched_ || k >= watched_) reference_[k] += after[k] - before[k];
    }

    /// Nothing of a run that did not begin.
    void report(const M& model, RunReport& report) const
    {
        if (!begun_) return;
        std::size_t k = 0;
        const auto next = [&](const char* name) -> Drift {
            const Slope slope = means_.slope(k);
            const Drift drift{name,        initial_[k], most_[k], most_t_[k],
                              slope.value, slope.error, size_[k], moved_at_[k]};
            ++k;
            return drift;
        };
        if (follows_energy_) report.invariants.push_back(next(has_energy(model) ? "energy" : "hamiltonian"));
        if (balances_) {
            if (const Drift followed = next("energy less work"); sums_)
                report.balance.push_back(followed), report.work = work_;
        }
        for (const char* name : invariants_of(model)) report.invariants.push_back(next(name));
        for (const char* name : constraints_of(model)) report.constraints.push_back(next(name));
        for (const char* name : casimirs_of(model)) report.casimirs.push_back(next(name));
        if (constraints_ > 0) report.manifold = distance_from_manifold(model), report.manifold_t = off_t_;
    }

  private:
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    static constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
    static constexpr double part = 1e-3; ///< of a function's size: what moves more is lost

    /// The place of the energy less the work, behind the energy.
    static constexpr std::size_t balance = 1;
    /// More than half the highest order of dense output, of Gauss' formula.
    static constexpr std::size_t most_nodes = 64;
    using Values = std::vector<double>;

    static void visit_column(const auto& column, const auto& take)
    {
        for (Eigen::Index i = 0; i < column.size(); ++i) take(static_cast<double>(column[i]));
    }

    static double energy_of(const M& model, double t, const State& s)
    {
        if constexpr (HasEnergy<M>)
            if (has_energy(model)) return static_cast<double>(model.energy(t, s));
        if constexpr (HasHamiltonian<M>) return static_cast<double>(model.hamiltonian(t, s));
        return nothing;
    }

    void visit_watched(const M& model, double t, const State& s, double work, const auto& take) const
    {
        if (follows_energy_) {
            const double energy = energy_of(model, t, s);
            take(energy);
            if (balances_) take(energy - work);
        }
        if constexpr (HasInvariants<M>) visit_column(model.invariants(t, s), take);
        if constexpr (HasConstraints<M>)
            if (constraints_ > 0) visit_column(model.constraints(t, s), take);
    }

    [[nodiscard]] Values all_values(const M& model, double t, const State& s) const
    {
        Values values;
        values.reserve(count_);
        const auto put = [&](double value) { values.push_back(value); };
        visit_watched(model, t, s, 0, put);
        if constexpr (HasCasimirs<M>) visit_column(model.casimirs(t, s), put);
        return values;
    }

    [[gnu::noinline]] void begin(const M& model, double t, const State& s)
    {
        begun_ = true;
        start_ = t;
        start_state_ = s;
        initial_ = reference_ = all_values(model, t, s);
        for (std::size_t k = watched_ - constraints_; k < watched_; ++k) reference_[k] = 0;
        for (std::size_t k = 0; k < count_; ++k) allowed_[k] = part * std::abs(reference_[k]);
        std::ranges::fill(most_t_, t);
    }

    /// Function k has this value at t.
    void watch(const M& model, std::size_t k, double t, double value)
    {
        const double distance = std::abs(value - reference_[k]);
        if (distance <= most_[k] || most_[k] == infinity) return;
        most_[k] = distance;
        most_t_[k] = t;
        // What a balance may have lost is a part of what came and went, too.
        if (balances_ && k == balance && distance <= part * most_[0]) return;
        if (!(distance <= allowed_[k])) lose(model, k, t);
    }

    /// Function k may have moved by more than `part` of its size, which is computed once.
    [[gnu::noinline]] void lose(const M& model, std::size_t k, double t)
    {
        // What is no finite number is a drift without bound.
        if (std::isnan(most_[k])) most_[k] = infinity;
        if (std::isnan(size_[k])) {
            size_[k] = size_of(model, k);
            allowed_[k] = size_[k] > 0 ? part * size_[k] : infinity;
            if (most_[k] <= allowed_[k]) return;
        }
        moved_at_[k] = t;
        allowed_[k] = infinity;
    }

    /// What is watched was seen.
    [[gnu::noinline]] void look(const M& model, double t, const State& s)
    {
        Values& values = seen_;
        std::size_t next = watched_;
        if constexpr (HasCasimirs<M>)
            if (count_ > watched_) visit_column(model.casimirs(t, s), [&](double value) { values[next++] = value; });
        for (std::size_t k = watched_; k < count_; ++k) watch(model, k, t, values[k]);
        for (std::size_t k = 0; k < count_; ++k) values[k] -= reference_[k];
        means_.see(t - start_, values);
        if (constraints_ > 0) {
            double square = 0;
            for (std::size_t k = watched_ - constraints_; k < watched_; ++k) square += values[k] * values[k];
            if (!(square <= off_)) off_ = square, off_t_ = t, off_state_ = s;
        }
    }

    /// df_k/ds_i times `length`, by central differences at (t, s); 0 where that is no finite number.
    [[nodiscard]] double change(const M& model, std::size_t k, double t, const State& s, Eigen::Index i,
                                double length) const
    {
        constexpr double step = 6e-6; // the third root of epsilon
        State left = s, right = s;
        left[i] -= step * length;
        right[i] += step * length;
        const double width = right[i] - left[i];
        const double value = (all_values(model, t, right)[k] - all_values(model, t, left)[k]) / width * length;
        return std::isfinite(value) ? value : 0;
    }

    [[nodiscard]] double size_of(const M& model, std::size_t k) const
    {
        double by_lanes = 0, squares = 0, length = 0;
        for (Eigen::Index i = 0; i < start_state_.size(); ++i) length += start_state_[i] * start_state_[i];
        length = std::sqrt(length);
        for (Eigen::Index i = 0; i < start_state_.size(); ++i) {
            const double lane = std::abs(start_state_[i]);
            by_lanes += std::abs(change(model, k, start_, start_state_, i, lane));
            const double whole = change(model, k, start_, start_state_, i, length);
            squares += whole * whole;
        }
        const double size = std::max(std::abs(reference_[k]), by_lanes);
        return size > 0 ? size : std::sqrt(squares);
    }

    /// |J^T (J J^T)^-1 c|, the way to where the constraints hold to first order, from the state where |c| was largest.
    [[nodiscard]] double distance_from_manifold(const M& model) const
    {
        const Values values = all_values(model, off_t_, off_state_);
        const Eigen::Index lanes = off_state_.size();
        const auto number = static_cast<Eigen::Index>(constraints_);
        Eigen::MatrixXd rows(number, lanes); // orthonormal in the end, with what belongs to them on the right
        Eigen::VectorXd right(number);
        double square = 0;
        for (Eigen::Index c = 0; c < number; ++c) {
            const std::size_t k = watched_ - constraints_ + static_cast<std::size_t>(c);
            for (Eigen::Index i = 0; i < lanes; ++i) {
                const double lane = std::max(std::abs(off_state_[i]), 1e-3);
                rows(c, i) = change(model, k, off_t_, off_state_, i, lane) / lane;
            }
            right[c] = values[k];
            const double whole = rows.row(c).norm();
            for (Eigen::Index d = 0; d < c; ++d) {
                const double along = rows.row(c).dot(rows.row(d));
                rows.row(c) -= along * rows.row(d);
                right[c] -= along * right[d];
            }
            const double length = rows.row(c).norm();
            if (!(length > 1e-8 * whole)) return nothing; // dependent here: there is no such way
            rows.row(c) /= length;
            right[c] /= length;
            square += right[c] * right[c];
        }
        return std::sqrt(square);
    }

    bool follows_energy_, balances_;            ///< the energy or the Hamiltonian; and there is a power
    std::size_t constraints_, watched_, count_; ///< the last of those that are watched; looked at at every step; all
    bool begun_ = false, sums_ = false;
    double start_ = 0, work_ = 0;
    State start_state_;
    Values initial_, reference_, most_, most_t_, allowed_, size_, moved_at_, seen_;
    Values nodes_, weights_; ///< of the integral
    BatchMeans means_;
    double off_ = -1, off_t_ = nothing; ///< the largest sum of squares of the constraints, and where it was
    State off_state_;
};

} // namespace lagen::detail
