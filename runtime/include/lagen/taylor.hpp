// SPDX-License-Identifier: MIT
/// Taylor's method: the Taylor polynomial of the motion at the beginning of a step, by the recurrences of the generated
/// kernel `taylor`; order and step from the tolerance [Jorba-Zou 2005]. The polynomial is the dense output.
///   auto run = lagen::integrate(top, s, {0.0, 10.0}, lagen::Taylor{.tolerance = 1e-15});
#pragma once

#include "lagen/integrate/control.hpp"
#include "lagen/integrate/expansion.hpp"
#include "lagen/integrate/states.hpp"
#include "lagen/integrate/taylor_polynomial.hpp"
#include "lagen/run.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace lagen {

/// See integrate/stepper.hpp for what is asked of a stepper.
template <class M>
class TaylorStepper {
    static_assert(HasTaylor<M>,
                  "Taylor's method needs the recurrences of the model: lagen generate MODEL --with taylor");
    static_assert(!is_pack<typename M::Scalar> || detail::NamesTime<M>,
                  "adaptive methods choose one step for one trajectory: use a fixed-step method with packs, or "
                  "lagen::ensemble");

  public:
    using Scalar = typename M::Scalar;
    using Real = Scalar;
    using Number = real_t<Real>;
    using State = typename M::State;
    static constexpr bool adaptive = true;
    static constexpr bool abreast = true;
    static constexpr int highest_order = detail::highest_taylor_order<Number>;
    static constexpr int dense_order = highest_order;
    static constexpr int error_order = highest_order;
    static constexpr double beta_share = 0;
    static constexpr bool foresees = true; ///< its lengths come from the state alone, not from the last step

    template <class Method>
    explicit TaylorStepper(const Method& method) noexcept
        : control_(method.control()), scale_(control_), asked_(method.order), order_(order_of(known_sums))
    {
    }

    Status begin(const M& model, Real t, const State& s) noexcept
    {
        for (Expansion& each : expansions_) each.begin(model, t, s);
        if constexpr (M::dimension == Eigen::Dynamic) {
            lost_.resize(static_cast<std::size_t>(s.size()));
            begins_ = {t, s};
            inside_ = s;
            order_ = order_of(model.taylor_sums());
        }
        std::ranges::fill(lost_, Real(0));
        kept_ = lost_;
        here().unit = first_unit(model, t, s);
        const Status status = expand(model, t, s, here());
        if (status == Status::ok || here().unit == Real(1)) return status;
        here().unit = Real(1);
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
    status_t<Scalar> attempt(const M& model, Real t, const State& s, Real h, State& s1) noexcept
    {
        Series& x = here().motion;
        const Real step = h / here().unit;
        if constexpr (HasDomain<M>) begins_.first = t, begins_.second = s;
        leaves_at_ = Real(0);
        typename Series::SpareRow slope(x);
        detail::polynomial_sums<true>(x, order_, step)
            .each([&]<class Part>(Part part, const auto& move, const auto& sloping) __attribute__((always_inline)) {
                using Register = typename Part::Register;
                const Register change = step * move + part.load(kept_);
                const Register from = part.load(s), end = from + change;
                const Register moved = end - from; // exact whichever of the two is larger [Knuth 1997, 4.2.2]
                part.store(s1, end);
                part.store(lost_, (from - (end - moved)) + (change - moved));
                part.store(slope, sloping);
            });
        next().unit = here().next_unit(model);
        auto status = expand(model, t + h, s1, next());
        if (Expansion::fails(status)) return status;
        status = Lanes::first(status, detail::check_finite(s1));
        if (Expansion::fails(status)) return status;
        error_ = Real(0);
        const Real epsilon = Real(std::numeric_limits<Number>::epsilon()), change_of_unit = h / next().unit;
        for (std::size_t i = 0; i < slope.size(); ++i) {
            const auto lane = static_cast<Eigen::Index>(i);
            const Real rate = change_of_unit * next().motion[1][i];
            const Real bound = scale_.template of<1>(s, s1, lane) +
                               Real(4) * epsilon * (detail::size_of(s1[lane]) + detail::size_of(rate));
            const Real defect = detail::size_of(step * slope[i] - rate) / (Real(16) * Real(order_ + 1) * bound);
            error_ = select(error_ == error_ && !(defect <= error_), defect, error_);
        }
        return status;
    }

    [[nodiscard]] Real error() const noexcept { return error_; }

    /// A step is long: it is looked at where the conditions of the domain change their signs inside it, or, where their
    /// series are not known, at equal parts.
    status_t<Scalar> finish([[maybe_unused]] const M& model, [[maybe_unused]] Real t1,
                            [[maybe_unused]] const State& s1) noexcept
    {
        auto status = Lanes::good();
        if constexpr (HasDomain<M>) {
            constexpr int parts = 16;
            std::array<bool, trajectories> known{}, unknown{};
            for (int lane = 0; lane < static_cast<int>(trajectories); ++lane) {
                bool& here_known = known[static_cast<std::size_t>(lane)];
                std::array<bool, trajectories> alone{};
                alone[static_cast<std::size_t>(lane)] = true;
                if constexpr (HasDomainSeries<M>)
                    here_known = here().isolate(
                        here().domain, Number(detail::lane_of(Real(t1 - begins_.first), lane)), Number(1), order_,
                        [&](const Number& theta) { look(model, t1, s1, theta, alone, status); }, lane);
                unknown[static_cast<std::size_t>(lane)] = !here_known;
            }
            if (std::ranges::find(unknown, true) != unknown.end())
                for (int k = 1; k < parts; ++k) look(model, t1, s1, Number(k) / Number(parts), unknown, status);
            for (int lane = 0; lane < static_cast<int>(trajectories); ++lane) {
                const bool left = detail::lane_of(leaves_at_, lane) > Number(0);
                const Status found = detail::lane_of(status, lane);
                detail::set_lane_of(status, lane,
                                    !left ? Status::ok : (found == Status::ok ? Status::left_domain : found));
            }
        }
        return status;
    }

    void accept() noexcept
    {
        now_ = 1 - now_;
        kept_ = lost_;
    }

    /// As long as the series at its beginning allows; without a bound, ten times as long as the last one.
    [[nodiscard]] Real after_accepted(Real h, Real) noexcept
    {
        return select(next().length < Real(unbounded()), next().length, Real(Real(10) * h));
    }
    [[nodiscard]] Real after_rejected(Real h, Real error) noexcept
    {
        const Real factor = detail::rough_power_of_two<Real>(-detail::rough_logarithm(error) / order_) * Real(0.9);
        return h * std::clamp<Real>(factor, Real(0.1), Real(0.9));
    }
    /// Just beyond the boundary that a step crosses, where it is known: the march then finds the crossing, as that of a
    /// step that ends outside.
    [[nodiscard]] Real after_failure(Real h) noexcept
    {
        const bool known = leaves_at_ > Real(0) && leaves_at_ < Real(0.98);
        return h * (known ? leaves_at_ : Real(0.5));
    }

    [[nodiscard]] auto derivative() const noexcept
    {
        const auto& slopes = here().motion[1];
        return Eigen::Map<const State>(slopes.data(), static_cast<Eigen::Index>(slopes.size())) / here().unit;
    }

    /// The polynomial.
    status_t<Scalar> interpolate(const M&, Real, const State& s, Real h, const State&, Real theta, State& out) noexcept
    {
        const Series& x = here().motion;
        const Real step = theta * h / here().unit;
        detail::polynomial_sums<false>(x, order_, step)
            .each([&]<class Part>(Part part, const auto& move, const auto&) __attribute__((always_inline)) {
                part.store(out, part.load(s) + (step * move + part.load(kept_)));
            });
        return detail::check_finite(out);
    }

    /// The ends of parts of the step, (0, last] in units of h, in each of which no event changes its sign twice:
    /// the roots of the events' own Taylor polynomials are isolated. False where there are none.
    template <class Found>
    bool split(Real h, Real last, const Found& found) const
    {
        if constexpr (HasEventSeries<M>) return here().isolate(here().events, h, last, order_, found);
        return false;
    }

    /// A series counts as one call.
    [[nodiscard]] std::size_t calls() const noexcept { return calls_; }
    [[nodiscard]] int order() const noexcept { return order_; }

    // ---- of packs whose lanes are trajectories: lanes/abreast.hpp ----

    /// Can a trajectory of `own` go on a lane beside the others?
    template <class One>
    [[nodiscard]] bool suits(const TaylorStepper<One>& own) const noexcept requires(is_pack<Scalar>)
    {
        return own.order_ == order_;
    }

    /// Lane `lane` begins as `own`, the stepper of its trajectory, has begun.
    template <class One>
    void adopt(int lane, const TaylorStepper<One>& own) noexcept requires(is_pack<Scalar>)
    {
        scale_.set_lane(lane, own.scale_);
        here().set_lane(lane, own.here(), order_);
        for (std::size_t i = 0; i < kept_.size(); ++i) kept_[i].set(lane, own.kept_[i]);
        phases_[static_cast<std::size_t>(lane)] = own.phases_[0];
    }

    /// What values inside the last step of lane `lane` are made of, and what the length of the next one follows from.
    template <class One>
    void hand_over(int lane, TaylorStepper<One>& own) const noexcept requires(is_pack<Scalar>)
    {
        here().get_lane(lane, own.here(), order_);
        for (std::size_t i = 0; i < kept_.size(); ++i) own.kept_[i] = kept_[i][lane];
    }
    template <class One>
    void hand_over_length(int lane, TaylorStepper<One>& own) const noexcept requires(is_pack<Scalar>)
    {
        own.next().length = expansions_[1 - now_].length[lane];
        own.leaves_at_ = leaves_at_[lane];
    }

    /// The step counts in these lanes.
    void accept(const typename StatusOf<Scalar>::mask& where) noexcept requires(is_pack<Scalar>)
    {
        for (std::size_t i = 0; i < kept_.size(); ++i) kept_[i] = select(where, lost_[i], kept_[i]);
        now_ = 1 - now_;
        if (!all(where)) here().choose(where, next(), order_);
    }

  private:
    template <class>
    friend class TaylorStepper;
    using Lanes = StatusOf<Scalar>;
    static constexpr auto trajectories = static_cast<std::size_t>(RealOf<Scalar>::lanes); ///< abreast
    using Expansion = detail::Expansion<M, highest_order>;
    using Series = typename Expansion::Series;
    using Row = typename Series::Row;
    static constexpr int known_sums = [] {
        if constexpr (requires { std::integral_constant<int, M::taylor_sums>(); }) return M::taylor_sums;
        return 0; // a compiled model tells it at run time
    }();
    static Number unbounded() noexcept { return Expansion::unbounded(); }

    /// Of a model with so many sums a series.
    [[nodiscard]] int order_of(int sums) const noexcept
    {
        if (asked_ > 0) return std::clamp(asked_, 2, highest_order);
        const double tolerance = control_.relative_tolerance();
        const double logarithm = -std::log(tolerance > 0 ? tolerance : control_.absolute_tolerance());
        if (!std::isfinite(logarithm)) return highest_order; // integrate refuses such tolerances
        return std::clamp(detail::taylor_order<Number>(logarithm, sums), 3, highest_order);
    }

    [[nodiscard]] Expansion& here() noexcept { return expansions_[now_]; }
    [[nodiscard]] const Expansion& here() const noexcept { return expansions_[now_]; }
    [[nodiscard]] Expansion& next() noexcept { return expansions_[1 - now_]; }

    /// The size of the state over that of its rate, for a first series.
    [[nodiscard]] Real first_unit(const M& model, const Real& t, const State& s) noexcept
    {
        if constexpr (Expansion::has_unit) {
            if (!Expansion::takes_unit(model)) return Real(1);
            State rate = s;
            ++calls_;
            if (model.rhs(t, s, rate) != Status::ok) return Real(1);
            Real size = Real(0), speed = Real(0);
            for (Eigen::Index lane = 0; lane < s.size(); ++lane)
                size += detail::size_of(s[lane]), speed += detail::size_of(rate[lane]);
            return Expansion::unit_near(model, size / speed);
        }
        return Real(1);
    }

    /// Steps are as long as a series holds, less a fifth, with which the first term left out is a thousandth of the
    /// tolerance: at 1e-16 a million of them add up to less than the rounding errors do. Less up to a 64th more, which
    /// changes from series to series: steps that the state alone chooses lock to closed orbits, the same few states
    /// come back, and their rounding errors do not cancel.
    status_t<Scalar> expand(const M& model, const Real& t, const State& s, Expansion& at) noexcept
    {
        ++calls_;
        Real share = Real(1);
        for (std::size_t lane = 0; lane < trajectories; ++lane) {
            phases_[lane] += 0x9E3779B9U; // 2^32 times the golden ratio: its multiples fill the circle evenly
            const double part = 0.8 * (1 - 0x1p-38 * static_cast<double>(phases_[lane]));
            detail::set_lane_of(share, static_cast<int>(lane), Number(part));
        }
        const auto status = at.expand(model, t, s, order_, scale_);
        if (!Expansion::fails(status)) at.length = select(at.length < Real(unbounded()), at.length * share, at.length);
        return status;
    }

    /// Where, of these lanes, the last step is outside the domain at theta, before any place that is known.
    void look(const M& model, const Real& t1, const State& s1, const Number& theta,
              std::array<bool, trajectories> which, status_t<Scalar>& status) noexcept requires HasDomain<M>
    {
        for (std::size_t lane = 0; lane < trajectories; ++lane) {
            const Number leaves = detail::lane_of(leaves_at_, static_cast<int>(lane));
            which[lane] = which[lane] && theta < Number(1) && !(leaves > Number(0) && !(theta < leaves));
        }
        if (std::ranges::find(which, true) == which.end()) return;
        const auto& [t, s] = begins_;
        inside_ = s1;
        auto there = interpolate(model, t, s, t1 - t, s1, Real(theta), inside_);
        if (!Expansion::fails(there))
            there = Lanes::first(there, detail::domain_status(model, t + Real(theta) * (t1 - t), inside_));
        for (int lane = 0; lane < static_cast<int>(trajectories); ++lane) {
            if (!which[static_cast<std::size_t>(lane)]) continue;
            const Status found = detail::lane_of(there, lane);
            detail::set_lane_of(status, lane, found);
            if (found != Status::ok) detail::set_lane_of(leaves_at_, lane, theta);
        }
    }

    std::array<Expansion, 2> expansions_; ///< at the beginning of the step, and at its end
    Row kept_, lost_;
    std::pair<Real, State> begins_; ///< the last step that was tried, where the model has a domain
    State inside_;                  ///< at a place inside it
    StepControl control_;
    detail::ErrorScale<Real> scale_;
    Real error_ = Real(0);
    Real leaves_at_ = Real(0); ///< the part of the last step behind which it is outside the domain, if one was found
    int asked_;                ///< the order that the method names; 0 where it names none
    int order_;
    std::array<std::uint32_t, trajectories> phases_{}; ///< of each trajectory
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
