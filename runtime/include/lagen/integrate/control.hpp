// SPDX-License-Identifier: MIT
/// Step control of the adaptive methods, as in Hairer's codes: the scaled error norm, the PI controller and the first
/// step.
#pragma once

#include "lagen/lanes/lanes.hpp"
#include "lagen/lanes/pack.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

namespace lagen::detail {

// Powers of numbers x >= +0, of which lengths of steps are made: within 1.2e-4 x^y of x^y, |y| <= 1, so long as that
// is a normal number, and growing with x but for its last two bits. Of float and double, the bits do not depend on the
// library, nor on whether a number is alone or a lane of a pack, nor, without fused multiplication, on the machine;
// other scalars call their own pow.

/// Whole numbers of the size of doubles, a lane.
template <class Real>
struct IntegersOf {
    using type = std::int64_t;
};
template <int N>
struct IntegersOf<Pack<double, N>> {
    using type = typename Mask<double, N>::Vector;
};

/// Of double and packs of it. No sum has two products, so that a compiler that contracts has one way to do it.
template <class Real>
struct StepPower {
    using Integer = typename IntegersOf<Real>::type;
    static constexpr double to_integer = 0x1.8p52; ///< its lowest bits are those of a whole number that is added

    /// x = 2^e m with m within sqrt(1/2) .. sqrt(2); log2 x = e + 2/ln 2 artanh((m - 1)/(m + 1)), whose series ends
    /// with an error of 9e-5. Of 0: -1023.
    [[nodiscard]] [[gnu::always_inline]] static inline Real logarithm(const Real& x) noexcept
    {
        Integer bits;
        std::memcpy(&bits, &x, sizeof bits);
        const Integer exponent = (bits - 0x3fe6a09e667f3bcd) >> 52;
        const Integer whole = exponent + std::bit_cast<std::int64_t>(to_integer), part = bits - (exponent << 52);
        Real e, m;
        std::memcpy(&e, &whole, sizeof e);
        std::memcpy(&m, &part, sizeof m);
        const Real s = (m - 1.0) / (m + 1.0), z = s * s;
        return s * (z * 0.96179669392597560 + 2.8853900817779268) + (e - to_integer);
    }

    /// 2^z = 2^n 2^f, |f| <= 1/2, whose series ends with a relative error of 6e-5. What is left out of both series is
    /// larger at their upper ends than at their lower ones, so that they grow from piece to piece.
    [[nodiscard]] [[gnu::always_inline]] static inline Real exponential(const Real& z) noexcept
    {
        const Real shifted = z + to_integer;
        const Real f = z - (shifted - to_integer), square = f * f;
        const Real low = f * 0.69314718055994531 + 1.0;
        const Real middle = f * 0.055504108664821580 + 0.24022650695910071;
        Real value = square * (square * 0.0096181291076284772 + middle) + low;
        Integer bits, whole;
        std::memcpy(&bits, &value, sizeof bits);
        std::memcpy(&whole, &shifted, sizeof whole);
        bits += whole << 52;
        std::memcpy(&value, &bits, sizeof value);
        return value;
    }
};

/// log2 x, and 2^x, of float and double and packs of them.
template <class Real>
struct StepPowerOf {
    static constexpr bool is_own = std::is_same_v<Real, double> || std::is_same_v<Real, float>;
    using Power = StepPower<double>;
    [[nodiscard]] static double widened(const Real& x) noexcept { return static_cast<double>(x); }
    [[nodiscard]] static Real narrowed(double x) noexcept { return static_cast<Real>(x); }
};
template <class T, int N>
struct StepPowerOf<Pack<T, N>> {
    static constexpr bool is_own = true;
    using Wide = Pack<double, N>;
    using Power = StepPower<Wide>;
    [[nodiscard]] static Wide widened(const Pack<T, N>& x) noexcept
    {
        return Wide::of(__builtin_convertvector(x.lanes, typename Wide::Vector));
    }
    [[nodiscard]] static Pack<T, N> narrowed(const Wide& x) noexcept
    {
        return Pack<T, N>::of(__builtin_convertvector(x.lanes, typename Pack<T, N>::Vector));
    }
};

/// x^y.
template <class Real>
[[nodiscard]] Real step_power(const Real& x, const Real& y) noexcept
{
    if constexpr (StepPowerOf<Real>::is_own) {
        using Of = StepPowerOf<Real>;
        return Of::narrowed(Of::Power::exponential(Of::widened(y) * Of::Power::logarithm(Of::widened(x))));
    } else {
        using std::pow;
        return Real(pow(x, y));
    }
}

/// x^y and max(x, 1e-4)^z, by one logarithm.
template <class Real>
struct TwoPowers {
    Real of_all, of_large;

    TwoPowers(const Real& x, const Real& y, const Real& z) noexcept
    {
        if constexpr (StepPowerOf<Real>::is_own) {
            using Of = StepPowerOf<Real>;
            const auto logarithm = Of::Power::logarithm(Of::widened(x));
            const std::decay_t<decltype(logarithm)> least(-13.287712379549449);
            of_all = Of::narrowed(Of::Power::exponential(Of::widened(y) * logarithm));
            of_large =
                Of::narrowed(Of::Power::exponential(Of::widened(z) * select(logarithm < least, least, logarithm)));
        } else {
            const Real least = Real(1e-4);
            of_all = step_power(x, y);
            of_large = step_power(x < least ? least : x, z);
        }
    }
};

} // namespace lagen::detail

namespace lagen {

/// The numbers of step control: see AdaptiveMethod.
struct StepControl {
    double tolerance = 1e-9;
    double relative = -1;
    double absolute = -1;
    double first_step = 0;
    double max_step = 0;
    double safety = 0.9;
    double shrink = 0.2; ///< a new step is at least this fraction of the old one
    double grow = 10;    ///< and at most this multiple
    double beta = 0.04;  ///< PI control [Gustafsson 1991]; zero: the classical control

    [[nodiscard]] constexpr double relative_tolerance() const noexcept { return relative < 0 ? tolerance : relative; }
    [[nodiscard]] constexpr double absolute_tolerance() const noexcept { return absolute < 0 ? tolerance : absolute; }
    /// Tolerances finite, not negative, not both zero; caps not negative; factors in their ranges.
    [[nodiscard]] constexpr bool is_valid() const noexcept
    {
        const double r = relative_tolerance();
        const double a = absolute_tolerance();
        constexpr double large = std::numeric_limits<double>::max();
        return r >= 0 && a >= 0 && r + a > 0 && r <= large && a <= large && first_step >= 0 && max_step >= 0 &&
               safety > 0 && safety < 1 && shrink > 0 && shrink < 1 && grow > 1 && beta >= 0 && beta <= 0.2;
    }
};

/// What a user writes: `Dop853{.tolerance = 1e-10}`. `tolerance` sets both tolerances; `relative` and `absolute`
/// override it where they are not negative. Zero `first_step` chooses one, zero `max_step` sets no cap. The other
/// numbers are those of Hairer's codes.
template <class Family>
struct AdaptiveMethod {
    double tolerance = Family::defaults.tolerance;
    double relative = Family::defaults.relative;
    double absolute = Family::defaults.absolute;
    double first_step = Family::defaults.first_step;
    double max_step = Family::defaults.max_step;
    double safety = Family::defaults.safety;
    double shrink = Family::defaults.shrink;
    double grow = Family::defaults.grow;
    double beta = Family::defaults.beta;

    [[nodiscard]] constexpr StepControl control() const noexcept
    {
        return {tolerance, relative, absolute, first_step, max_step, safety, shrink, grow, beta};
    }

    template <class M>
    using Stepper = typename Family::template Stepper<M>;
};

namespace detail {

/// What an error is measured in: atol + rtol max(|s|, |s1|), a lane.
template <class Real>
class ErrorScale {
  public:
    /// No scale is 0, so that an error of 0 is none; every other one is too large for it.
    explicit ErrorScale(const StepControl& control) noexcept
        : relative_(static_cast<Number>(control.relative_tolerance())),
          absolute_(
              std::max<Number>(static_cast<Number>(control.absolute_tolerance()), std::numeric_limits<Number>::min()))
    {
    }

    template <int width, class State>
    [[nodiscard]] [[gnu::always_inline]] Slice<State, width> of(const State& s, const State& s1,
                                                                Eigen::Index lane) const noexcept
    {
        using Size = Slice<State, width>;
        const Size before = size_of(load<width>(s, lane)), after = size_of(load<width>(s1, lane));
        return absolute_ + relative_ * larger_of(before, after);
    }

    [[nodiscard]] Real of_size(const Real& size) const noexcept { return absolute_ + relative_ * size; }

    /// Of a pack: lane `lane` is measured as `own` measures.
    void set_lane(int lane, const ErrorScale<real_t<Real>>& own) noexcept requires(is_pack<Real>)
    {
        relative_.set(lane, own.relative_);
        absolute_.set(lane, own.absolute_);
    }

  private:
    template <class>
    friend class ErrorScale;
    using Number = real_t<Real>;

    Real relative_, absolute_;
};

/// sum over lanes of (e / scale)^2.
template <class State>
typename State::Scalar squared_error(const ErrorScale<typename State::Scalar>& scale, const State& s, const State& s1,
                                     const State& e) noexcept
{
    using Real = typename State::Scalar;
    Real sum = Real(0);
    for_lanes(s, [&]<int width>(Width<width>, Eigen::Index lane) {
        const Slice<State, width> ratio = load<width>(e, lane) / scale.template of<width>(s, s1, lane);
        sum = sum_with(sum, Slice<State, width>(ratio * ratio));
    });
    return sum;
}

/// True where to round a state of this size, by a quarter of an epsilon, is a larger error than is allowed.
template <class State>
bool is_below_rounding(const StepControl& control, const State& s) noexcept
{
    using Real = typename State::Scalar;
    const Real quarter = std::numeric_limits<Real>::epsilon() / Real(4);
    return squared_error(ErrorScale<Real>(control), s, s, s) * quarter * quarter > static_cast<Real>(s.size());
}

/// The number of a scalar that carries derivatives (`x.value()`), any other scalar itself: lengths of steps are chosen
/// by numbers.
template <class Real>
[[nodiscard]] auto plain_number(const Real& x) noexcept
{
    if constexpr (requires { x.value(); })
        return x.value();
    else
        return x;
}

/// x^exponent to the scalar's last digit.
template <class Real>
[[nodiscard]] Real power_of_number(const Real& x, const Real& exponent) noexcept
{
    using std::pow;
    return Real(pow(plain_number(x), plain_number(exponent)));
}

/// x^exponent to the few digits that the length of a step needs.
template <class Real>
[[nodiscard]] Real rough_power(const Real& x, const Real& exponent) noexcept
{
    return Real(step_power(plain_number(x), plain_number(exponent)));
}

/// Of an error: error^(1/q - share beta), and max(error, 1e-4)^beta, which the step behind the next one asks for.
template <class Real>
struct ErrorPowers {
    Real proportional, integral;
};

/// Proportional-integral control of the step [Hairer, Norsett, Wanner II.4; Hairer, Wanner IV.2]. Of a pack, that of
/// the trajectories on its lanes.
template <class Real>
class Controller {
    using Where = typename StatusOf<Real>::mask;

  public:
    /// `share` of beta is taken from the integral exponent: 0.75 in dopri5.f, 0.2 in dop853.f.
    Controller(const StepControl& control, int error_order, Real share) noexcept
        : integral_(static_cast<real_t<Real>>(control.beta)),
          proportional_(Real(1) / Real(error_order) - integral_ * share),
          safety_(static_cast<real_t<Real>>(control.safety)),
          most_(Real(1) / static_cast<real_t<Real>>(control.shrink)),
          least_(Real(1) / static_cast<real_t<Real>>(control.grow)), last_(powers(Real(0)).integral * safety_)
    {
    }

    [[nodiscard]] ErrorPowers<Real> powers(const Real& error) const noexcept
    {
        if (!remembers()) return {rough_power(error, proportional_), Real(1)};
        const TwoPowers<decltype(plain_number(error))> both(plain_number(error), plain_number(proportional_),
                                                            plain_number(integral_));
        return {Real(both.of_all), Real(both.of_large)};
    }

    /// The step after an accepted one with scaled error `error` <= 1.
    [[nodiscard]] Real after_accepted(const Real& h, const Real& error) noexcept
    {
        return after_accepted(h, powers(error));
    }
    [[nodiscard]] Real after_accepted(const Real& h, const ErrorPowers<Real>& error) noexcept
    {
        const Real next = length_after(h, error);
        last_ = error.integral * safety_;
        rejected_ = Where{};
        return next;
    }
    /// The same before it counts.
    [[nodiscard]] Real length_after(const Real& h, const ErrorPowers<Real>& error) const noexcept
    {
        Real factor = error.proportional / last_;
        factor = select(factor < least_, least_, Real(select(factor > most_, most_, factor)));
        factor = select(rejected_ && factor < Real(1), Real(1), factor);
        return h / factor;
    }

    [[nodiscard]] Real after_rejected(const Real& h, const Real& error) noexcept
    {
        return after_rejected(h, powers(error));
    }
    [[nodiscard]] Real after_rejected(const Real& h, const ErrorPowers<Real>& error) noexcept
    {
        const Real factor = error.proportional / safety_;
        rejected_ = Real(0) <= Real(0);
        return h / Real(select(factor > most_, most_, factor));
    }

    /// A step that could not be evaluated is halved.
    [[nodiscard]] Real after_failure(const Real& h) noexcept
    {
        rejected_ = Real(0) <= Real(0);
        return h / Real(2);
    }

    // ---- of packs whose lanes are trajectories: lanes/abreast.hpp ----

    /// The step counts in these lanes.
    void accept(const Where& where, const ErrorPowers<Real>& error) noexcept requires(is_pack<Real>)
    {
        last_ = select(where, Real(error.integral * safety_), last_);
        rejected_ = rejected_ && !where;
    }
    void set_lane(int lane, const Controller<real_t<Real>>& own) noexcept requires(is_pack<Real>)
    {
        integral_.set(lane, own.integral_);
        proportional_.set(lane, own.proportional_);
        safety_.set(lane, own.safety_);
        most_.set(lane, own.most_);
        least_.set(lane, own.least_);
        last_.set(lane, own.last_);
        rejected_.lanes[lane] = own.rejected_ ? -1 : 0;
    }
    /// What changes from step to step.
    void get_lane(int lane, Controller<real_t<Real>>& own) const noexcept requires(is_pack<Real>)
    {
        own.last_ = last_[lane];
        own.rejected_ = rejected_[lane];
    }

  private:
    template <class>
    friend class Controller;

    /// Is there an integral part? Without it the powers of last errors are 1.
    [[nodiscard]] bool remembers() const noexcept
    {
        if constexpr (is_pack<Real>)
            return any(integral_ != Real(0));
        else
            return integral_ != Real(0);
    }

    Real integral_, proportional_; ///< exponents
    Real safety_, most_, least_;
    Real last_; ///< power of the error of the last accepted step, times `safety_`
    Where rejected_{};
};

/// A first step from the sizes of s, f and a difference of f [Hairer, Norsett, Wanner II.4, algorithm of hinit], signed
/// like `length` and no longer, and not within the rounding of t. One call of the right-hand side, at x = s + h f; `x`
/// and `f1` are scratch.
template <class M>
typename M::Scalar first_step(const M& model, const StepControl& control, int order, typename M::Scalar t,
                              typename M::Scalar length, const typename M::State& s, const typename M::State& f,
                              typename M::State& x, typename M::State& f1) noexcept
{
    using Real = typename M::Scalar;
    using std::abs;
    using std::sqrt;
    const Real n = static_cast<Real>(s.size());
    const ErrorScale<Real> scale(control);
    const Real size = sqrt(squared_error(scale, s, s, s) / n);
    const Real slope = sqrt(squared_error(scale, s, s, f) / n);
    const Real cap = abs(length);
    Real h = size < Real(1e-5) || slope < Real(1e-5) ? Real(1e-6) : Real(0.01) * size / slope;
    if (!(h < cap)) h = cap;
    const Real sign = length < Real(0) ? Real(-1) : Real(1);
    for (Eigen::Index lane = 0; lane < s.size(); ++lane) x[lane] = s[lane] + sign * h * f[lane];
    const bool good = model.rhs(t + sign * h, x, f1) == Status::ok;
    for (Eigen::Index lane = 0; lane < s.size(); ++lane) x[lane] = f1[lane] - f[lane];
    const Real bend = good ? sqrt(squared_error(scale, s, s, x) / n) / h : Real(0);
    Real steepest = bend < slope ? slope : bend;
    const Real ratio = Real(0.01) / steepest; // 0 or no number where errors are measured in the smallest number
    Real h1 = steepest <= Real(1e-15) ? (Real(1e-6) < h * Real(1e-3) ? h * Real(1e-3) : Real(1e-6))
              : ratio > Real(0)       ? rough_power<Real>(ratio, Real(1) / Real(order))
                                      : ratio;
    Real chosen = Real(100) * h < h1 ? Real(100) * h : h1;
    const Real rounding(plain_number(Real(32)) * std::numeric_limits<Real>::epsilon() * abs(plain_number(t)));
    if (chosen < rounding) chosen = rounding;
    if (!(chosen < cap)) chosen = cap;
    return sign * (chosen > Real(0) ? chosen : h);
}

} // namespace detail

} // namespace lagen
