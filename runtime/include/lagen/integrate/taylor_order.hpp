// SPDX-License-Identifier: MIT
/// Order and length of the steps of Taylor's method, from the tolerance and the last coefficients [Jorba-Zou 2005], and
/// what it asks of a model.
#pragma once

#include "lagen/integrate/control.hpp"
#include "lagen/integrate/states.hpp"
#include "lagen/lanes/lanes.hpp"
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

/// How many functions there are; Eigen::Dynamic where that is known at run time.
template <class M>
constexpr int event_count() noexcept
{
    if constexpr (M::dimension == Eigen::Dynamic)
        return HasEvents<M> ? Eigen::Dynamic : 0;
    else if constexpr (requires { M::events_names; })
        return static_cast<int>(M::events_names.size());
    else
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
using SeriesAlong = TaylorSeries<typename M::Scalar, (count != 0 ? count : 1), 8>;

} // namespace detail

/// And with those of its events along the motion: `--with taylor,event_series`.
template <class M>
concept HasEventSeries = HasTaylor<M> && detail::event_count<M>()
!= 0 && requires(const M& model, typename M::Scalar t, const typename M::State& s,
                 const TaylorSeries<typename M::Scalar, M::dimension, 8>& x,
                 detail::SeriesAlong<M, detail::event_count<M>()>& e)
{
    model.event_series(t, s, 8, x, e);
};

/// And with those of the conditions of its domain, which a header with `taylor` has where they have no kinks.
template <class M>
concept HasDomainSeries = HasTaylor<M> && detail::condition_count<M>()
!= 0 && requires(const M& model, typename M::Scalar t, const typename M::State& s,
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
[[nodiscard]] Real rough_power_of_two(double x) noexcept
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

/// The lane of a pack, of a mask or of their status; of a scalar, itself.
template <class Lanes>
[[nodiscard]] auto lane_of(const Lanes& x, [[maybe_unused]] int lane) noexcept
{
    if constexpr (requires { x[lane]; })
        return x[lane];
    else
        return x;
}

template <class Lanes, class One>
void set_lane_of(Lanes& x, [[maybe_unused]] int lane, const One& value) noexcept
{
    if constexpr (requires { x.set(lane, value); })
        x.set(lane, value);
    else if constexpr (requires { x.lanes[0] = value; })
        x.lanes[static_cast<std::size_t>(lane)] = value;
    else
        x = value;
}

/// f(lane of a, ..), a lane; of a scalar, f(a, ..).
template <class Scalar, class F, class... Given>
[[nodiscard]] Scalar by_lanes(const F& f, const Given&... given) noexcept
{
    if constexpr (is_pack<Scalar>) {
        Scalar result{};
        for (int lane = 0; lane < RealOf<Scalar>::lanes; ++lane) result.set(lane, f(given[lane]...));
        return result;
    } else {
        return f(given...);
    }
}

/// How far Taylor polynomials of order p hold, in every lane of a state, or for ever: the largest number.
template <class Scalar>
struct TaylorLength {
    using Number = real_t<Scalar>;
    const ErrorScale<Scalar>& scale;
    int order;

    static Number unbounded() noexcept { return std::numeric_limits<Number>::max(); }

    /// The longest h for which these functions' polynomials, which tell where signs change, hold too: |e_k| h^k within
    /// the tolerance, relative to |e_0| + |e_1|, for the last two orders; no longer than `length`.
    template <class Functions>
    [[nodiscard]] Scalar of_functions(Scalar length, const Functions& e) const noexcept
    {
        for (std::size_t r = 0; r < e[0].size(); ++r) {
            const Scalar size = scale.of_size(size_of(e[0][r]) + size_of(e[1][r]));
            for (int k = order - 1; k <= order; ++k)
                length = by_lanes<Scalar>(
                    [k](const Number& so_far, const Number& relative) {
                        if (!(relative > Number(0)) || relative - relative != Number(0)) return so_far;
                        return std::min<Number>(so_far, rough_power_of_two<Number>(-rough_logarithm(relative) / k));
                    },
                    length, Scalar(size_of(e[k][r]) / size));
        }
        return length;
    }

    /// The longest h with |x_k| h^k within the tolerance in every lane, for two of the last four orders; without a
    /// bound where these are 0, as those of a polynomial are.
    template <class State, class Series>
    [[nodiscard]] Scalar of_motion(const State& s, Series& x) const noexcept
    {
        typename Series::SpareRow inverse(x);
        for (std::size_t i = 0; i < inverse.size(); ++i)
            inverse[i] = Scalar(1) / scale.template of<1>(s, s, static_cast<Eigen::Index>(i));
        std::array<Scalar, 4> largest{Scalar(0), Scalar(0), Scalar(0), Scalar(0)};
        for (int back = 0; back < 4 && order - back > 1; ++back) {
            Scalar& most = largest[static_cast<std::size_t>(back)];
            for (std::size_t i = 0; i < inverse.size(); ++i) {
                const Scalar size = size_of(x[order - back][i]) * inverse[i];
                most = select(most < size, size, most);
            }
        }
        return by_lanes<Scalar>([p = order](const auto&... sizes) { return from_largest(p, sizes...); }, largest[0],
                                largest[1], largest[2], largest[3]);
    }

  private:
    /// The same from the largest coefficients of orders p, p - 1, ..
    template <class... Sizes>
    static Number from_largest(int k, const Sizes&... sizes) noexcept
    {
        double steepest = -std::numeric_limits<double>::infinity();
        int found = 0;
        const auto look = [&](const Number& size) {
            if (size > Number(0) && found < 2) {
                steepest = std::max(steepest, rough_logarithm(size) * (1.0 / k));
                ++found;
            }
            --k;
        };
        (look(sizes), ...);
        return found == 0 ? unbounded() : rough_power_of_two<Number>(-steepest);
    }
};

} // namespace detail

} // namespace lagen
