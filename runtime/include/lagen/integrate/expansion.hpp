// SPDX-License-Identifier: MIT
/// A model's Taylor coefficients at the beginning of a step: those of the motion, of the events and of the conditions
/// of the domain along it, and how far they hold. Of packs, those of the trajectories on its lanes.
#pragma once

#include "lagen/integrate/taylor_order.hpp"
#include "lagen/lanes/lanes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace lagen::detail {

// Parts of an interval in which a polynomial changes its sign at most once, from the signs of its Bernstein
// coefficients: as many real roots as they have variations of sign, or fewer by an even number (Descartes' rule;
// J. M. Lane, R. F. Riesenfeld, BIT 21 (1981) 112-117). Coefficients within their rounding error of 0 count for either
// sign, so that no change of sign of the polynomial is missed.

template <class Real, std::size_t size>
class RootIsolation {
  public:
    /// found(end) for the ends, ascending, of parts of (0, 1] in each of which sum_k coefficients[k] x^k, k < count,
    /// may change its sign, once where the part is longer than `width`; elsewhere it does not.
    template <class Found>
    static void isolate(std::array<Real, size> coefficients, std::size_t count, Real width, const Found& found)
    {
        Real total = Real(0);
        for (std::size_t k = 0; k < count; ++k) total += size_of(coefficients[k]);
        const Real first = size_of(coefficients[0]);
        const Real noise = Real(2 * static_cast<int>(count)) * std::numeric_limits<Real>::epsilon() * total;
        if (first > total - first + noise || total == Real(0)) return;
        RootIsolation isolation{count, noise, width};
        isolation.to_bernstein(coefficients);
        isolation.search(coefficients, Real(0), Real(1), found);
    }

  private:
    RootIsolation(std::size_t count, const Real& noise, const Real& width) : count_(count), noise_(noise), width_(width)
    {
    }

    /// b_i = sum_k binomial(i, k) / binomial(n, k) c_k.
    void to_bernstein(std::array<Real, size>& c) const
    {
        const std::size_t n = count_ - 1;
        Real binomial = Real(1);
        for (std::size_t k = 1; k <= n; ++k) {
            binomial *= Real(static_cast<int>(n - k + 1)) / Real(static_cast<int>(k));
            c[k] /= binomial;
        }
        for (std::size_t j = 0; j < n; ++j)
            for (std::size_t i = n; i > j; --i) c[i] += c[i - 1];
    }

    enum class Signs { none, one, more };

    /// Variations of sign, whatever the signs of what is within the noise.
    [[nodiscard]] Signs variations(const std::array<Real, size>& b) const
    {
        int changes = 0, last = 0;
        std::size_t unknown = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            const int sign = b[i] > noise_ ? 1 : (b[i] < -noise_ ? -1 : 0);
            if (sign == 0) {
                ++unknown;
                continue;
            }
            const bool change = last != 0 && sign != last;
            if (unknown > (change ? 1U : 0U)) return Signs::more;
            changes += change ? 1 : 0;
            last = sign;
            unknown = 0;
        }
        if (unknown > 0 || changes > 1) return Signs::more;
        return changes == 0 ? Signs::none : Signs::one;
    }

    template <class Found>
    void search(const std::array<Real, size>& b, const Real& from, const Real& to, const Found& found)
    {
        const Signs signs = variations(b);
        if (signs == Signs::none) return;
        const Real middle = (from + to) / Real(2);
        const bool divided = to - from <= width_ || !(middle > from && middle < to) || parts_ >= most_parts;
        if (signs == Signs::one || divided || is_noise(b)) {
            ++parts_;
            return found(to);
        }
        // De Casteljau: the coefficients of both halves.
        std::array<Real, size> left = b, right = b;
        for (std::size_t j = 1; j < count_; ++j) {
            for (std::size_t i = 0; i + j < count_; ++i) right[i] = (right[i] + right[i + 1]) / Real(2);
            left[j] = right[0];
        }
        search(left, from, middle, found);
        search(right, middle, to, found);
    }

    [[nodiscard]] bool is_noise(const std::array<Real, size>& b) const
    {
        for (std::size_t i = 0; i < count_; ++i)
            if (b[i] > noise_ || b[i] < -noise_) return false;
        return true;
    }

    static constexpr int most_parts = 1000; ///< more are no longer told apart

    int parts_ = 0;
    std::size_t count_;
    Real noise_;
    Real width_;
};

/// The series of `count` functions along the motion, and where they are known; of none: nothing.
template <class Scalar, int count, int order>
struct AlongMotion {
    TaylorSeries<Scalar, count, order> of{};
    typename StatusOf<Scalar>::mask known{};
};
template <class Scalar, int order>
struct AlongMotion<Scalar, 0, order> {
};

/// Time is measured in `unit`, a power of two near the length of the step before, so that no coefficient overflows or
/// vanishes, whatever the model's own unit of time is. Models whose kernels take no unit have 1.
template <class M, int highest>
class Expansion {
  public:
    using Real = typename M::Scalar;
    using Number = real_t<Real>;
    using State = typename M::State;
    using Series = TaylorSeries<Real, M::dimension, highest>;
    static constexpr bool has_unit = requires(const M& model, const Real& t, const State& s, Series& x)
    {
        model.taylor(t, s, 8, x, t);
    };
    static Number unbounded() noexcept { return std::numeric_limits<Number>::max(); }

    Series motion;
    [[no_unique_address]] AlongMotion<Real, HasEventSeries<M> ? event_count<M>() : 0, highest> events;
    [[no_unique_address]] AlongMotion<Real, HasDomainSeries<M> ? condition_count<M>() : 0, highest> domain;
    Real length = Real(0); ///< for which the series hold; `unbounded` where they are polynomials
    Real unit = Real(1);

    /// Takes the memory where a number of functions is known at run time.
    void begin([[maybe_unused]] const M& model, [[maybe_unused]] const Real& t, [[maybe_unused]] const State& s)
    {
        if constexpr (M::dimension == Eigen::Dynamic) {
            motion.resize(static_cast<std::size_t>(s.size()));
            if constexpr (HasEventSeries<M>) events.of.resize(model.events_names.size());
            if constexpr (HasDomainSeries<M>) domain.of.resize(static_cast<std::size_t>(model.domain(t, s).size()));
        }
    }

    /// Of a scalar it ends where it fails.
    status_t<Real> expand(const M& model, const Real& t, const State& s, int order,
                          const ErrorScale<Real>& scale) noexcept
    {
        auto status = in_units([&](const auto&... units) { return model.taylor(t, s, order, motion, units...); });
        if (fails(status)) return status;
        Real total = Real(0);
        for (const Real& coefficient : motion[order]) total += coefficient;
        Lanes::fail(status, total - total != Real(0), Status::non_finite);
        if (fails(status)) return status;
        const TaylorLength<Real> lengths{scale, order};
        length = lengths.of_motion(s, motion);
        if constexpr (HasEventSeries<M>)
            keep(events, lengths, in_units([&](const auto&... units) {
                     return model.event_series(t, s, order, motion, events.of, units...);
                 }));
        if constexpr (HasDomainSeries<M>)
            keep(domain, lengths, in_units([&](const auto&... units) {
                     return model.domain_series(t, s, order, motion, domain.of, units...);
                 }));
        length = select(length < Real(unbounded()), length * unit, length);
        return status;
    }

    static bool fails(const status_t<Real>& status) noexcept { return !is_pack<Real> && !Lanes::all_good(status); }

    /// The power of two below a length, for the series behind it.
    [[nodiscard]] static Number unit_near(const M& model, const Number& size) noexcept
    {
        if (!takes_unit(model) || !(size > Number(0)) || !(size < unbounded())) return Number(1);
        constexpr double most = std::min(1000, static_cast<int>(std::numeric_limits<Number>::max_exponent) - 8);
        return rough_power_of_two<Number>(std::clamp(std::floor(rough_logarithm(size)), -most, most));
    }
    /// That of the series behind this one.
    [[nodiscard]] Real next_unit(const M& model) const noexcept
    {
        return by_lanes<Real>([&model](const Number& size,
                                       const Number& now) { return size < unbounded() ? unit_near(model, size) : now; },
                              length, unit);
    }

    /// Is time measured in units? Of a compiled model its object tells.
    [[nodiscard]] static bool takes_unit([[maybe_unused]] const M& model) noexcept
    {
        if constexpr (requires { model.takes_unit(); }) return model.takes_unit();
        return has_unit;
    }

    /// found(end), for one function after another, for the ends, ascending, of parts of (0, last] in units of h in each
    /// of which the function changes its sign once at most. False where a series is not known up to there.
    template <class Functions, class Found>
    [[nodiscard]] bool isolate(const Functions& functions, const Number& h, const Number& last, int order,
                               const Found& found, int lane = 0) const
    {
        if (!lane_of(functions.known, lane)) return false;
        const Number step = last * h / lane_of(unit, lane);
        constexpr auto most = static_cast<std::size_t>(highest) + 1;
        for (std::size_t r = 0; r < functions.of[0].size(); ++r) {
            std::array<Number, most> coefficients;
            Number power = Number(1), total = Number(0);
            for (int k = 0; k <= order; ++k, power *= step)
                total += coefficients[static_cast<std::size_t>(k)] = lane_of(functions.of[k][r], lane) * power;
            if (total - total != Number(0)) return false;
            using Isolation = RootIsolation<Number, most>;
            Isolation::isolate(coefficients, static_cast<std::size_t>(order) + 1,
                               std::numeric_limits<Number>::epsilon() * Number(64),
                               [&](const Number& end) { found(Number(end * last)); });
        }
        return true;
    }

    // ---- of packs whose lanes are trajectories: lanes/abreast.hpp ----

    /// Lane `lane` becomes `own`.
    template <class Own>
    void set_lane(int lane, const Own& own, int order) noexcept
    {
        set_series(motion, lane, own.motion, order);
        if constexpr (HasEventSeries<M>) set_functions(events, lane, own.events, order);
        if constexpr (HasDomainSeries<M>) set_functions(domain, lane, own.domain, order);
        length.set(lane, own.length);
        unit.set(lane, own.unit);
    }
    /// What values inside the step of lane `lane` are made of.
    template <class Own>
    void get_lane(int lane, Own& own, int order) const noexcept
    {
        get_series(motion, lane, own.motion, order);
        if constexpr (HasEventSeries<M>) {
            get_series(events.of, lane, own.events.of, order);
            own.events.known = events.known[lane];
        }
        own.unit = unit[lane];
    }
    /// Lanes that are not `where` become those of `other`.
    template <class Where>
    void choose(const Where& where, const Expansion& other, int order) noexcept
    {
        choose_series(where, motion, other.motion, order);
        if constexpr (HasEventSeries<M>) choose_functions(where, events, other.events, order);
        if constexpr (HasDomainSeries<M>) choose_functions(where, domain, other.domain, order);
        length = select(where, length, other.length);
        unit = select(where, unit, other.unit);
    }

  private:
    using Lanes = StatusOf<Real>;

    /// call(unit), or call() where the model's kernels have none.
    template <class Call>
    [[nodiscard]] auto in_units(const Call& call) const noexcept
    {
        if constexpr (has_unit)
            return call(unit);
        else
            return call();
    }

    template <class Functions>
    void keep(Functions& functions, const TaylorLength<Real>& lengths, const status_t<Real>& status) noexcept
    {
        functions.known = is_good<Real>(status);
        length = select(functions.known, lengths.of_functions(length, functions.of), length);
    }

    template <class Of, class Own>
    static void set_series(Of& series, int lane, const Own& own, int order) noexcept
    {
        for (int k = 0; k <= order; ++k)
            for (std::size_t i = 0; i < own[k].size(); ++i) series[k][i].set(lane, own[k][i]);
    }
    template <class Of, class Own>
    static void set_functions(Of& functions, int lane, const Own& own, int order) noexcept
    {
        set_series(functions.of, lane, own.of, order);
        functions.known.lanes[lane] = own.known ? -1 : 0;
    }
    template <class Of, class Own>
    static void get_series(const Of& series, int lane, Own& own, int order) noexcept
    {
        for (int k = 0; k <= order; ++k)
            for (std::size_t i = 0; i < own[k].size(); ++i) own[k][i] = series[k][i][lane];
    }
    template <class Where, class Of>
    static void choose_series(const Where& where, Of& series, const Of& other, int order) noexcept
    {
        for (int k = 0; k <= order; ++k)
            for (std::size_t i = 0; i < series[k].size(); ++i) series[k][i] = select(where, series[k][i], other[k][i]);
    }
    template <class Where, class Of>
    static void choose_functions(const Where& where, Of& functions, const Of& other, int order) noexcept
    {
        choose_series(where, functions.of, other.of, order);
        functions.known = (where && functions.known) || (!where && other.known);
    }
};

} // namespace lagen::detail
