// SPDX-License-Identifier: MIT
/// Event functions at a state, their rates along the motion, and the rounding errors of both.
#pragma once

#include "lagen/integrate/options.hpp"
#include "lagen/integrate/retract.hpp"
#include "lagen/lanes/lanes.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace lagen::detail {

/// Memory is taken at the start.
template <class M>
class EventValues {
  public:
    using Scalar = typename M::Scalar;
    using Real = real_t<Scalar>;
    using State = typename M::State;
    using Request = EventRequest<Real, State>;

    EventValues(const M& model, std::span<const Request> requests)
        : model_(model), requests_(requests), back_(requests.size()), ahead_(requests.size()), aside_(requests.size()),
          reached_(requests.size()), noise_(requests.size()), rate_noise_(requests.size())
    {
    }

    [[nodiscard]] const M& model() const noexcept { return model_; }

    void evaluate(Real t, const State& s, std::vector<Real>& values)
    {
        if constexpr (HasEvents<M> && !is_pack<Scalar>) {
            const auto all = model_.events(t, s);
            for (std::size_t r = 0; r < requests_.size(); ++r)
                values[r] =
                    requests_[r].when ? requests_[r].when(t, s) : all[static_cast<Eigen::Index>(requests_[r].index)];
        } else {
            for (std::size_t r = 0; r < requests_.size(); ++r) values[r] = requests_[r].when(t, s);
        }
    }

    [[nodiscard]] Real evaluate_one(std::size_t r, Real t, const State& s) const
    {
        if constexpr (HasEvents<M> && !is_pack<Scalar>)
            if (!requests_[r].when) return model_.events(t, s)[static_cast<Eigen::Index>(requests_[r].index)];
        return requests_[r].when(t, s);
    }

    /// The rates of the functions along the motion through s at t, in the direction of h, by differences over a part of
    /// h, or of the time in which the state changes where these are rounding errors; 0 where those are, too.
    void find_rates(Real t, const State& s, Real h, std::vector<Real>& rates)
    {
        std::fill(rates.begin(), rates.end(), Real(0));
        if constexpr (RightHandSide<M> && !is_pack<Scalar>) {
            using std::sqrt;
            const Real half = sqrt(std::numeric_limits<Real>::epsilon()), quarter = sqrt(half);
            tangent_t<M> slope;
            if constexpr (std::is_same_v<State, tangent_t<M>>) slope = s;
            std::fill(rate_noise_.begin(), rate_noise_.end(), Real(0));
            std::fill(reached_.begin(), reached_.end(), Real(0));
            if (model_.rhs(Scalar(t), s, slope) != Status::ok) return;
            find_noise(t, s, slope, quarter * h);
            find_differences(t, s, slope, quarter * h, rates);
            if constexpr (moves_by_sums<M>) {
                Real place = Real(0), speed = Real(0);
                for (Eigen::Index i = 0; i < s.size(); ++i) place += s[i] * s[i], speed += slope[i] * slope[i];
                if (speed > Real(0)) find_differences(t, s, slope, quarter * sqrt(place / speed) * sign(h), rates);
            }
        }
    }

    /// Rounding errors where rates were found last: of function r, and of its rate.
    [[nodiscard]] const Real& noise(std::size_t r) const noexcept { return noise_[r]; }
    [[nodiscard]] const Real& rate_noise(std::size_t r) const noexcept { return rate_noise_[r]; }
    /// The value a little ahead, from where its rate was found: behind a kink the rate is that of neither side.
    [[nodiscard]] const Real& reached(std::size_t r) const noexcept { return reached_[r]; }

  private:
    static Real sign(const Real& x) noexcept { return x > Real(0) ? Real(1) : x < Real(0) ? Real(-1) : Real(0); }
    static Real size_of(const Real& x) noexcept { return detail::size_of(x); }

    /// Of those that are not known yet, to fourth order: a rate that a jump makes zero is less than the third ones are.
    void find_differences(Real t, const State& s, const tangent_t<M>& slope, Real part, std::vector<Real>& rates)
    {
        const auto difference = [&](Real length) {
            evaluate(t - length, retracted(model_, s, tangent_t<M>(Scalar(-length) * slope)), back_);
            evaluate(t + length, retracted(model_, s, tangent_t<M>(Scalar(length) * slope)), ahead_);
        };
        difference(Real(2) * part);
        for (std::size_t r = 0; r < rates.size(); ++r) aside_[r] = ahead_[r] - back_[r];
        difference(part);
        for (std::size_t r = 0; r < rates.size(); ++r) {
            const Real ahead = ahead_[r];
            ahead_[r] -= back_[r];
            if (rates[r] != Real(0) || !(size_of(ahead_[r]) > noise_[r])) continue;
            reached_[r] = ahead;
            const Real twice = is_number(aside_[r]) ? aside_[r] : Real(2) * ahead_[r];
            const Real finer = Real(8) * ahead_[r] - twice, times = finer / ahead_[r];
            // At a multiple zero the two differ: no rate is known.
            if (times > Real(3) && times < Real(12)) rates[r] = finer / (Real(12) * size_of(part));
        }
    }

    /// The rounding errors of the functions and of their rates, by what they change by where each lane of s and the
    /// time change by some units of their last places, or by their own rates: up or down, in such patterns that any two
    /// of them go against each other in one, so that terms do not cancel as they do at a zero.
    void find_noise(Real t, const State& s, const tangent_t<M>& slope, Real part)
    {
        const Real unit = Real(4) * std::numeric_limits<Real>::epsilon();
        std::fill(noise_.begin(), noise_.end(), Real(0));
        evaluate(t, s, ahead_);
        const auto widen = [&](std::vector<Real>& noise, Real scale) {
            for (std::size_t r = 0; r < noise.size(); ++r)
                noise[r] = std::max<Real>(noise[r], scale * size_of(Real(back_[r] - ahead_[r])));
        };
        const Eigen::Index lanes = slope.size();
        for (Eigen::Index bit = 1; bit / 2 <= lanes; bit *= 2) {
            const auto way = [bit](Eigen::Index lane) { return Real((lane & bit) == 0 ? 1 : -1); };
            tangent_t<M> change = slope;
            for (Eigen::Index i = 0; i < lanes; ++i) change[i] *= Scalar(part * way(i));
            evaluate(t + part * way(lanes), retracted(model_, s, change), back_);
            widen(rate_noise_, unit / size_of(part));
            State near = s;
            if constexpr (moves_by_sums<M>)
                for (Eigen::Index i = 0; i < lanes; ++i) near[i] *= Scalar(Real(1) + unit * way(i));
            evaluate(t * (Real(1) + unit * way(lanes)), near, back_);
            widen(noise_, Real(1));
        }
    }

    const M& model_;
    std::span<const Request> requests_;
    std::vector<Real> back_, ahead_, aside_, reached_;
    std::vector<Real> noise_, rate_noise_;
};

} // namespace lagen::detail
