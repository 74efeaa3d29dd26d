// SPDX-License-Identifier: MIT
/// A model's Taylor coefficients at the beginning of a step: those of the motion, of the events and of the conditions
/// of the domain along it, and how far they hold.
#pragma once

#include "lagen/integrate/control.hpp"
#include "lagen/integrate/isolate_roots.hpp"
#include "lagen/integrate/lanes.hpp"
#include "lagen/series.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>

namespace lagen {

/// A model with Taylor coefficients: `lagen generate MODEL --with taylor`.
template <class M>
concept HasTaylor = requires(const M& model, typename M::Scalar t, const typename M::State& s,
                             TaylorSeries<typename M::Scalar, M::dimension, 8>& x)
{
    {
        model.taylor(t, s, 8, x)
        } -> std::same_as<status_t<typename M::Scalar>>;
};

namespace detail {

template <class M>
constexpr int event_count() noexcept
{
    if constexpr (requires { M::events_names; }) return static_cast<int>(M::events_names.size());
    return 0;
}

template <class M>
constexpr int condition_count() noexcept
{
    if constexpr (HasDomain<M>) {
        using Scalar = typename M::Scalar;
        using State = typename M::State;
        using Values = decltype(std::declval<const M&>().domain(std::declval<Scalar>(), std::declval<const State&>()));
        return static_cast<int>(std::decay_t<Values>::SizeAtCompileTime);
    }
    return 0;
}

template <class M, int count>
using SeriesAlong = TaylorSeries<typename M::Scalar, (count > 0 ? count : 1), 8>;

} // namespace detail

/// And with those of its events along the motion: `--with taylor,event_series`.
template <class M>
concept HasEventSeries = HasTaylor<M> && detail::event_count<M>()
> 0 && requires(const M& model, typename M::Scalar t, const typename M::State& s,
                const TaylorSeries<typename M::Scalar, M::dimension, 8>& x,
                detail::SeriesAlong<M, detail::event_count<M>()>& e)
{
    model.event_series(t, s, 8, x, e);
};

/// And with those of the conditions of its domain, which a header with `taylor` has where they have no kinks.
template <class M>
concept HasDomainSeries = HasTaylor<M> && detail::condition_count<M>()
> 0 && requires(const M& model, typename M::Scalar t, const typename M::State& s,
                const TaylorSeries<typename M::Scalar, M::dimension, 8>& x,
                detail::SeriesAlong<M, detail::condition_count<M>()>& e)
{
    model.domain_series(t, s, 8, x, e);
};

namespace detail {

/// log2(x) within 0.09 of a positive number, from its exponent.
template <class Real>
[[nodiscard]] double rough_logarithm(const Real& x) noexcept
{
    if constexpr (std::is_same_v<Real, float> || std::is_same_v<Real, double>) {
        const auto bits = std::bit_cast<std::int64_t>(static_cast<double>(x));
        return static_cast<double>(bits) * 0x1p-52 - 1023.0;
    } else {
        using std::log;
        return static_cast<double>(log(plain_number(x))) * 1.4426950408889634;
    }
}

/// 2^x, within 6 %, as the inverse of rough_logarithm.
template <class Real>
[[nodiscard]] Real rough_power(double x) noexcept
{
    if (x < -1000) return Real(0);
    if (x > 1000) x = 1000;
    return static_cast<Real>(std::bit_cast<double>(static_cast<std::int64_t>((x + 1023.0) * 0x1p52)));
}

/// The order for L = -ln(tolerance), where a coefficient takes so many sums. A step is as long as e^(-L/p). Its work
/// grows like p^2 where products of scalars are all that takes time, and p = L/2 + 1 is cheapest [Jorba-Zou 2005,
/// section 3.1]; with eight products at a time it grows little faster than p while there are few sums. Measured, by
/// powers of ten from 1e-6 to 1e-15: least at 16, 20, 24, 28 for a heavy top (9 sums), a rigid body and a double
/// pendulum, within 5 % from one less to four more; near 10, 14, 17, 20 for seven bodies in the plane (126 sums).
template <class Real>
[[nodiscard]] constexpr int taylor_order(double logarithm, int sums) noexcept
{
    constexpr bool in_registers = std::is_floating_point_v<Real> && sizeof(Real) <= 8;
    const double wanted = !in_registers ? 1 + logarithm / 2 : (sums <= 32 ? 7 + 0.6 * logarithm : 3 + 0.5 * logarithm);
    const int whole = static_cast<int>(wanted);
    return whole + (whole < wanted ? 1 : 0);
}

/// For a tolerance that is the scalar's epsilon.
template <class Real>
inline constexpr int highest_taylor_order = taylor_order<Real>(0.69314718055994531 * std::numeric_limits<Real>::digits,
                                                               0);

/// The series of `count` functions along the motion, where they are known; of none: nothing.
template <class Real, int count, int order>
struct AlongMotion {
    TaylorSeries<Real, count, order> of{};
    bool known = false;
};
template <class Real, int order>
struct AlongMotion<Real, 0, order> {
};

/// Time is measured in `unit`, a power of two near the length of the step before, so that no coefficient overflows or
/// vanishes, whatever the model's own unit of time is. Models whose kernels take no unit have 1.
template <class M, int highest>
class Expansion {
  public:
    using Real = typename M::Scalar;
    using State = typename M::State;
    using Series = TaylorSeries<Real, M::dimension, highest>;
    static constexpr bool has_unit = requires(const M& model, const Real& t, const State& s, Series& x)
    {
        model.taylor(t, s, 8, x, t);
    };
    static Real unbounded() noexcept { return std::numeric_limits<Real>::max(); }

    Series motion;
    [[no_unique_address]] AlongMotion<Real, HasEventSeries<M> ? event_count<M>() : 0, highest> events;
    [[no_unique_address]] AlongMotion<Real, HasDomainSeries<M> ? condition_count<M>() : 0, highest> domain;
    Real length = Real(0); ///< for which the series hold; `unbounded` where they are polynomials
    Real unit = Real(1);

    Status expand(const M& model, const Real& t, const State& s, int order, const ErrorScale<Real>& scale) noexcept
    {
        Status status = Status::ok;
        if constexpr (has_unit)
            status = model.taylor(t, s, order, motion, unit);
        else
            status = model.taylor(t, s, order, motion);
        if (status != Status::ok) return status;
        Real total = Real(0);
        for (const Real& coefficient : motion[order]) total += coefficient;
        if (total - total != Real(0)) return Status::non_finite;
        length = length_of_motion(s, order, scale);
        if constexpr (HasEventSeries<M>) {
            if constexpr (has_unit)
                status = model.event_series(t, s, order, motion, events.of, unit);
            else
                status = model.event_series(t, s, order, motion, events.of);
            keep(status, events, order, scale);
        }
        if constexpr (HasDomainSeries<M>) {
            if constexpr (has_unit)
                status = model.domain_series(t, s, order, motion, domain.of, unit);
            else
                status = model.domain_series(t, s, order, motion, domain.of);
            keep(status, domain, order, scale);
        }
        if (length < unbounded()) length *= unit;
        return Status::ok;
    }

    /// The power of two below a length, for the series behind it.
    [[nodiscard]] static Real unit_near(const Real& size) noexcept
    {
        if (!has_unit || !(size > Real(0)) || !(size < unbounded())) return Real(1);
        constexpr double most = std::min(1000, static_cast<int>(std::numeric_limits<Real>::max_exponent) - 8);
        return rough_power<Real>(std::clamp(std::floor(rough_logarithm(size)), -most, most));
    }

    /// found(end), for one function after another, for the ends, ascending, of parts of (0, last] in units of h in each
    /// of which the function changes its sign once at most. False where a series is not known up to there.
    template <class Functions, class Found>
    [[nodiscard]] bool isolate(const Functions& functions, const Real& h, const Real& last, int order,
                               const Found& found) const
    {
        if (!functions.known) return false;
        const Real step = last * h / unit;
        for (std::size_t r = 0; r < functions.of[0].size(); ++r) {
            std::array<Real, highest + 1> coefficients;
            Real power = Real(1), total = Real(0);
            for (int k = 0; k <= order; ++k, power *= step)
                total += coefficients[static_cast<std::size_t>(k)] = functions.of[k][r] * power;
            if (total - total != Real(0)) return false;
            using Isolation = RootIsolation<Real, highest + 1>;
            Isolation::isolate(coefficients, static_cast<std::size_t>(order) + 1,
                               std::numeric_limits<Real>::epsilon() * Real(64),
                               [&](const Real& end) { found(Real(end * last)); });
        }
        return true;
    }

  private:
    static constexpr auto lanes = static_cast<std::size_t>(M::dimension);

    template <class Functions>
    void keep(Status status, Functions& functions, int order, const ErrorScale<Real>& scale) noexcept
    {
        functions.known = status == Status::ok;
        if (functions.known) length = std::min<Real>(length, length_of_functions(functions.of, order, scale));
    }

    /// The longest h for which the polynomials, which tell where signs change, hold too: |e_k| h^k within the
    /// tolerance, relative to |e_0| + |e_1|, for the last two orders.
    template <class Functions>
    [[nodiscard]] static Real length_of_functions(const Functions& e, int order, const ErrorScale<Real>& scale) noexcept
    {
        Real longest = unbounded();
        for (std::size_t r = 0; r < e[0].size(); ++r) {
            const Real allowed = scale.of_size(size_of(e[0][r]) + size_of(e[1][r]));
            for (int k = order - 1; k <= order; ++k) {
                const Real size = size_of(e[k][r]) / allowed;
                if (!(size > Real(0)) || size - size != Real(0)) continue;
                longest = std::min<Real>(longest, rough_power<Real>(-rough_logarithm(size) / k));
            }
        }
        return longest;
    }

    /// The longest h with |x_k| h^k within the tolerance in every lane, for two of the last four orders; without a
    /// bound where these are 0, as those of a polynomial are.
    [[nodiscard]] Real length_of_motion(const State& s, int order, const ErrorScale<Real>& scale) const noexcept
    {
        std::array<Real, lanes> shares;
        for (std::size_t i = 0; i < lanes; ++i)
            shares[i] = Real(1) / scale.template of<1>(s, s, static_cast<Eigen::Index>(i));
        double steepest = -std::numeric_limits<double>::infinity();
        int found = 0;
        for (int k = order; k > std::max(1, order - 4) && found < 2; --k) {
            Real largest = Real(0);
            for (std::size_t i = 0; i < lanes; ++i)
                largest = std::max<Real>(largest, size_of(motion[k][i]) * shares[i]);
            if (!(largest > Real(0))) continue;
            steepest = std::max(steepest, rough_logarithm(largest) / k);
            ++found;
        }
        return found == 0 ? unbounded() : rough_power<Real>(-steepest);
    }
};

} // namespace detail

} // namespace lagen
