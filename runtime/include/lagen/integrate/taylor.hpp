// SPDX-License-Identifier: MIT
/// Taylor's method: the Taylor polynomial of the motion at the beginning of a step, by the recurrences of the generated
/// kernel `taylor`; order and step from the tolerance [Jorba-Zou 2005]. The polynomial is the dense output.
///   auto run = lagen::integrate(top, s, {0.0, 10.0}, lagen::Taylor{.tolerance = 1e-15});
#pragma once

#include "lagen/integrate/control.hpp"
#include "lagen/integrate/isolate_roots.hpp"
#include "lagen/integrate/lanes.hpp"
#include "lagen/integrate/states.hpp"
#include "lagen/series.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace lagen {

/// A model with Taylor coefficients: `lagen generate MODEL --with taylor`.
template <class M>
concept HasTaylor = requires(const M& model, typename M::Scalar t, const typename M::State& s,
                             TaylorSeries<typename M::Scalar, M::dimension, 8>& x)
{
    {
        model.taylor(t, s, 8, x)
    }
    noexcept->std::same_as<status_t<typename M::Scalar>>;
};

/// And with those of its events along the motion: `--with taylor,event_series`.
template <class M>
concept HasEventSeries = HasTaylor<M> && requires(const M& model, typename M::Scalar t, const typename M::State& s,
                                                  const TaylorSeries<typename M::Scalar, M::dimension, 8>& x)
{
    M::events_names;
    requires requires(TaylorSeries<typename M::Scalar, static_cast<int>(M::events_names.size()), 8> & e)
    {
        model.event_series(t, s, 8, x, e);
    };
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

/// Of a model without events: nothing.
template <class M, int order>
struct EventSeries {
};

template <HasEventSeries M, int order>
struct EventSeries<M, order> {
    TaylorSeries<typename M::Scalar, static_cast<int>(M::events_names.size()), order> of{};
    bool known = false;
};

/// For a tolerance that is the scalar's epsilon.
template <class Real>
inline constexpr int highest_taylor_order = taylor_order<Real>(0.69314718055994531 * std::numeric_limits<Real>::digits,
                                                               0);

} // namespace detail

/// See integrate/integrator.hpp for what is asked of a stepper.
template <class M>
class TaylorStepper {
    static_assert(HasTaylor<M>,
                  "Taylor's method needs the recurrences of the model: lagen generate MODEL --with taylor");
    static_assert(!is_pack<typename M::Scalar>,
                  "adaptive methods choose one step for one trajectory: use a fixed-step method with packs");

  public:
    using Scalar = typename M::Scalar;
    using Real = Scalar;
    using State = typename M::State;
    static constexpr bool adaptive = true;
    static constexpr int highest_order = detail::highest_taylor_order<Real>;
    static constexpr int dense_order = highest_order;
    static constexpr int error_order = highest_order;
    static constexpr double beta_share = 0;
    static constexpr bool foresees = true; ///< its lengths come from the state alone, not from the last step

    template <class Method>
    explicit TaylorStepper(const Method& method) noexcept
        : control_(method.control()), scale_(control_), order_(order_of(method))
    {
    }

    Status begin(const M& model, Real t, const State& s) noexcept
    {
        lost_.fill(Real(0));
        kept_ = lost_;
        return expand(model, t, s, here());
    }

    [[nodiscard]] Real first_step(const M&, Real, Real length, const State&) noexcept
    {
        const Real size = detail::size_of(length), wanted = here().length < unbounded() ? here().length : Real(1);
        const Real first = wanted < size ? wanted : size;
        return length < Real(0) ? Real(-first) : first;
    }

    /// s1 = s + sum_{k>0} x_k h^k, the lost digits of the last sum among them [Kahan 1965]; then the series there. The
    /// error is that of the polynomial in the equation at the end, against 16 tolerances, which shows a step beyond its
    /// radius of convergence:
    ///   h |P'(h) - f(P(h))| / (p + 1).
    /// Equations with kinks are refused by the generator: a kink that is crossed twice in a step leaves no trace there.
    Status attempt(const M& model, Real t, const State& s, Real h, State& s1) noexcept
    {
        const Series& x = here().motion;
        if constexpr (HasDomain<M>) begins_ = {t, s};
        Row move = x[order_], slope;
        for (std::size_t i = 0; i < lanes; ++i) slope[i] = Real(order_) * x[order_][i];
        for (int k = order_ - 1; k > 0; --k)
            for (std::size_t i = 0; i < lanes; ++i) {
                move[i] = x[k][i] + h * move[i];
                slope[i] = Real(k) * x[k][i] + h * slope[i];
            }
        for (std::size_t i = 0; i < lanes; ++i) {
            const auto lane = static_cast<Eigen::Index>(i);
            const Real change = h * move[i] + kept_[i];
            const Real from = s[lane];
            s1[lane] = from + change;
            const Real moved = s1[lane] - from; // exact whichever of the two is larger [Knuth 1997, 4.2.2]
            lost_[i] = (from - (s1[lane] - moved)) + (change - moved);
        }
        const Status status = expand(model, t + h, s1, next());
        if (status != Status::ok) return status;
        if (const Status finite = detail::check_finite(s1); finite != Status::ok) return finite;
        error_ = Real(0);
        const Real epsilon = std::numeric_limits<Real>::epsilon();
        for (std::size_t i = 0; i < lanes; ++i) {
            const auto lane = static_cast<Eigen::Index>(i);
            const Real rate = next().motion[1][i];
            const Real bound = scale_.template of<1>(s, s1, lane) +
                               Real(4) * epsilon * (detail::size_of(s1[lane]) + detail::size_of(h * rate));
            const Real defect = detail::size_of(h * (slope[i] - rate)) / (Real(16) * Real(order_ + 1) * bound);
            if (error_ == error_ && !(defect <= error_)) error_ = defect;
        }
        return Status::ok;
    }

    [[nodiscard]] Real error() const noexcept { return error_; }

    /// A step is long: the domain is looked at inside it too, at equal parts.
    Status finish(const M& model, Real t1, const State& s1) noexcept
    {
        if constexpr (HasDomain<M>) {
            constexpr int parts = 16;
            const auto& [t, s] = begins_;
            State inside = s1;
            for (int k = 1; k < parts; ++k) {
                const Real theta = Real(k) / Real(parts);
                const Status status = interpolate(model, t, s, t1 - t, s1, theta, inside);
                if (status != Status::ok) return status;
                const Status domain = detail::domain_status(model, t + theta * (t1 - t), inside);
                if (domain != Status::ok) return domain;
            }
        }
        return Status::ok;
    }

    void accept() noexcept
    {
        now_ = 1 - now_;
        kept_ = lost_;
    }

    /// As long as the series at its beginning allows; without a bound, ten times as long as the last one.
    [[nodiscard]] Real after_accepted(Real h, Real) noexcept
    {
        return next().length < unbounded() ? next().length : Real(10) * h;
    }
    [[nodiscard]] Real after_rejected(Real h, Real error) noexcept
    {
        const Real factor = detail::rough_power<Real>(-detail::rough_logarithm(error) / order_) * Real(0.9);
        return h * std::clamp<Real>(factor, Real(0.1), Real(0.9));
    }
    [[nodiscard]] Real after_failure(Real h) noexcept { return h / Real(2); }

    [[nodiscard]] State derivative() const noexcept
    {
        State rate;
        for (std::size_t i = 0; i < lanes; ++i) rate[static_cast<Eigen::Index>(i)] = here().motion[1][i];
        return rate;
    }

    /// The polynomial.
    Status interpolate(const M&, Real, const State& s, Real h, const State&, Real theta, State& out) noexcept
    {
        const Series& x = here().motion;
        const Real step = theta * h;
        Row move = x[order_];
        for (int k = order_ - 1; k > 0; --k)
            for (std::size_t i = 0; i < lanes; ++i) move[i] = x[k][i] + step * move[i];
        for (std::size_t i = 0; i < lanes; ++i) {
            const auto lane = static_cast<Eigen::Index>(i);
            out[lane] = s[lane] + (step * move[i] + kept_[i]);
        }
        return detail::check_finite(out);
    }

    /// The ends of parts of the step, (0, last] in units of h, in each of which no event changes its sign twice:
    /// the roots of the events' own Taylor polynomials are isolated. False where there are none.
    template <class Found>
    bool split(Real h, Real last, const Found& found) const
    {
        if constexpr (HasEventSeries<M>) {
            if (!here().events.known) return false;
            const auto& e = here().events.of;
            constexpr auto events = M::events_names.size();
            const Real length = last * h;
            for (std::size_t r = 0; r < events; ++r) {
                std::array<Real, highest_order + 1> coefficients;
                Real power = Real(1), total = Real(0);
                for (int k = 0; k <= order_; ++k, power *= length)
                    total += coefficients[static_cast<std::size_t>(k)] = e[k][r] * power;
                if (total - total != Real(0)) return false; // no series here
                using Isolation = detail::RootIsolation<Real, highest_order + 1>;
                Isolation::isolate(coefficients, static_cast<std::size_t>(order_) + 1,
                                   std::numeric_limits<Real>::epsilon() * Real(64),
                                   [&](const Real& end) { found(end * last); });
            }
            return true;
        }
        return false;
    }

    /// A series counts as one call.
    [[nodiscard]] std::size_t calls() const noexcept { return calls_; }
    [[nodiscard]] int order() const noexcept { return order_; }

  private:
    static constexpr auto lanes = static_cast<std::size_t>(M::dimension);
    using Series = TaylorSeries<Real, M::dimension, highest_order>;
    using Row = typename Series::Row;
    static Real unbounded() noexcept { return std::numeric_limits<Real>::max(); }

    template <class Method>
    static int order_of(const Method& method) noexcept
    {
        if (method.order > 0) return std::clamp(method.order, 2, highest_order);
        const StepControl control = method.control();
        const double tolerance = control.relative_tolerance();
        const double logarithm = -std::log(tolerance > 0 ? tolerance : control.absolute_tolerance());
        if (!std::isfinite(logarithm)) return highest_order; // integrate refuses such tolerances
        int sums = 0;
        if constexpr (requires { M::taylor_sums; }) sums = M::taylor_sums;
        return std::clamp(detail::taylor_order<Real>(logarithm, sums), 3, highest_order);
    }

    /// The motion's series and those of its events, and how far they hold.
    struct Expansion {
        Series motion;
        [[no_unique_address]] detail::EventSeries<M, highest_order> events;
        Real length = Real(0);
    };
    [[nodiscard]] Expansion& here() noexcept { return expansions_[now_]; }
    [[nodiscard]] const Expansion& here() const noexcept { return expansions_[now_]; }
    [[nodiscard]] Expansion& next() noexcept { return expansions_[1 - now_]; }

    Status expand(const M& model, Real t, const State& s, Expansion& at) noexcept
    {
        ++calls_;
        const Status status = model.taylor(t, s, order_, at.motion);
        if (status != Status::ok) return status;
        Real total = Real(0);
        for (const Real& coefficient : at.motion[order_]) total += coefficient;
        if (total - total != Real(0)) return Status::non_finite;
        at.length = length_of(s, at.motion);
        if constexpr (HasEventSeries<M>) {
            at.events.known = model.event_series(t, s, order_, at.motion, at.events.of) == Status::ok;
            if (at.events.known) at.length = std::min(at.length, length_of_events(at.events.of));
        }
        if (at.length < unbounded()) at.length *= Real(0.8);
        return Status::ok;
    }

    /// The longest h for which the events' polynomials, which tell where they happen, hold too: |e_k| h^k within the
    /// tolerance, relative to |e_0| + |e_1|, for the last two orders.
    template <class Events>
    [[nodiscard]] Real length_of_events(const Events& e) const noexcept
    {
        Real length = unbounded();
        for (std::size_t r = 0; r < M::events_names.size(); ++r) {
            const Real scale = scale_.of_size(detail::size_of(e[0][r]) + detail::size_of(e[1][r]));
            for (int k = order_ - 1; k <= order_; ++k) {
                const Real size = detail::size_of(e[k][r]) / scale;
                if (!(size > Real(0)) || size - size != Real(0)) continue;
                length = std::min(length, detail::rough_power<Real>(-detail::rough_logarithm(size) / k));
            }
        }
        return length;
    }

    /// The longest h with |x_k| h^k within the tolerance in every lane, for two of the last four orders; without a
    /// bound where these are 0, as those of a polynomial are.
    [[nodiscard]] Real length_of(const State& s, const Series& x) const noexcept
    {
        Row scale;
        for (std::size_t i = 0; i < lanes; ++i)
            scale[i] = Real(1) / scale_.template of<1>(s, s, static_cast<Eigen::Index>(i));
        double steepest = -std::numeric_limits<double>::infinity();
        int found = 0;
        for (int k = order_; k > std::max(1, order_ - 4) && found < 2; --k) {
            Real largest = Real(0);
            for (std::size_t i = 0; i < lanes; ++i)
                largest = std::max<Real>(largest, detail::size_of(x[k][i]) * scale[i]);
            if (!(largest > Real(0))) continue;
            steepest = std::max(steepest, detail::rough_logarithm(largest) / k);
            ++found;
        }
        return found == 0 ? unbounded() : detail::rough_power<Real>(-steepest);
    }

    std::array<Expansion, 2> expansions_; ///< at the beginning of the step, and at its end
    Row kept_, lost_;
    std::pair<Real, State> begins_; ///< the last step that was tried, where the model has a domain
    StepControl control_;
    detail::ErrorScale<Real> scale_;
    Real error_ = Real(0);
    int order_;
    std::size_t now_ = 0;
    std::size_t calls_ = 0;
};

/// Order and step from the tolerance; `order` fixes the order, and the tolerance the step alone. The order goes up to
/// what the digits of the scalar are worth: 30 for double, 41 for __float128, 60 for 50 digits.
struct Taylor {
    double tolerance = 1e-15;
    double relative = -1;
    double absolute = -1;
    double first_step = 0;
    double max_step = 0;
    int order = 0;

    [[nodiscard]] constexpr StepControl control() const noexcept
    {
        return {.tolerance = tolerance,
                .relative = relative,
                .absolute = absolute,
                .first_step = first_step,
                .max_step = max_step};
    }

    template <class M>
    using Stepper = TaylorStepper<M>;
};

} // namespace lagen
