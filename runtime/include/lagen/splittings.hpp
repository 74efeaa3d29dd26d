// SPDX-License-Identifier: MIT
/// Partitioned (splitting) methods with a fixed step, `lagen::KahanLi8{.step = 0.1}`, for separable systems
///   xdot = f(y, t),   ydot = g(x, t),
/// where x are the base lanes, which are the first ones, and y the others: compositions of drifts x += a h f(y) and
/// kicks y += b h g(x) in turn. Symplectic where x and y are canonical coordinates. Drifts have their own clock, which
/// the kicks move, and kicks one that the drifts move: both are exact flows then, and the order is full where f and g
/// depend on time.
///
/// A splitting is a type with the members `order`; `weights` of drifts and kicks in turn; `kick_first`; `affine`: its
/// order needs f(y) = M y + c with constants M and c. (The kick and the drift as vector fields B and A have
/// [B, [B, A]] = -2 g'(x) M g(x) d/dy then, which commutes with B: [B, [B, [B, A]]] = 0 is what methods of Nystrom's
/// kind rest on.)
///
/// Of a model that `HasFlows` they compose these instead (FlowStepper).
///
/// Separability is the caller's to know (`lagen run` proves it): a probe at the start refuses a right-hand side that
/// plainly is not of this form, and can miss one that is only nearly so.
///
/// Where the method is `compensated`, the rounding error of the sum s1 = s + .. enters the next step [Kahan 1965], so
/// that errors grow as Brouwer's law says.
#pragma once

#include "lagen/integrate/retract.hpp"
#include "lagen/integrate/sizes.hpp"
#include "lagen/integrate/splitting_coefficients.hpp"
#include "lagen/integrate/tableau.hpp"
#include "lagen/lanes/lanes.hpp"
#include "lagen/run.hpp"

#include <utility>

namespace lagen {

// Splitting methods on a model that is a sum of parts with exact flows (`HasFlows`, lagen/kernel.hpp).
//
// With the weights w_0, w_1, .. of drifts and kicks in turn, a_0 = w_0 and a_k = w_k - a_(k-1), a step of parts
// P_1 .. P_N is
// P_1(w_0)   P_2 .. P_(N-1) (a_0)   P_N(w_1)   P_(N-1) .. P_2 (a_1)   P_1(w_2)   ..,
// that is, P_1 .. P_N and its adjoint P_N .. P_1 for the times a_0, a_1, .. in turn. It has the order that the
// splitting has for two parts, whatever these are [R. I. McLachlan, SIAM Journal on Scientific Computing 16 (1995)
// 151]; what rests on an affine x' has none, and splits x and y.

namespace splitting {

/// a - b to twice the digits of a double.
constexpr Coefficient difference(const Coefficient& a, const Coefficient& b) noexcept
{
    const double sum = a.head - b.head, turned = sum - a.head;
    const double lost = (a.head - (sum - turned)) - (b.head + turned);
    const double tail = lost + (a.tail - b.tail) + (a.rest - b.rest), head = sum + tail;
    return {head, (sum - head) + tail, 0};
}

/// a_0, a_1, ..: of a palindrome a palindrome.
template <class Splitting>
constexpr auto times_of_sweeps() noexcept
{
    constexpr auto& w = Splitting::weights;
    std::array<Coefficient, w.size() - 1> a{};
    for (std::size_t k = 0; k < a.size(); ++k) a[k] = k == 0 ? w[0] : difference(w[k], a[k - 1]);
    for (std::size_t k = 0; k < a.size() / 2; ++k) a[a.size() - 1 - k] = a[k];
    return a;
}

} // namespace splitting

/// The stepper: see integrate/integrator.hpp for what is asked of it. It is a Poisson map where each flow is, and
/// compensates its sums as that of two parts does (splittings.hpp).
template <class Splitting, class M>
class FlowStepper {
    static_assert(HasFlows<M> && moves_by_sums<M>, "flows add increments to a vector");
    static_assert(!Splitting::affine, "its order rests on an affine x'");

  public:
    using Scalar = typename M::Scalar;
    using Real = real_t<Scalar>;
    using State = typename M::State;
    static constexpr bool adaptive = false;
    static constexpr int order = Splitting::order;
    static constexpr int dense_order = Splitting::order;

    template <class Method>
    explicit FlowStepper(const Method& method) noexcept : compensated_(method.compensated)
    {
    }

    status_t<Scalar> begin(const M&, Real, const State& s) noexcept
    {
        lost_ = next_lost_ = moved_ = increment_ = State::Zero(s.size());
        return StatusOf<Scalar>::good();
    }

    status_t<Scalar> attempt(const M& model, Real t, const State& s, Real h, State& s1) noexcept
    {
        const auto status = move(model, t, s, h, s1);
        detail::keep_lost(s, s1, moved_, next_lost_);
        return StatusOf<Scalar>::first(status, detail::check_finite(s1));
    }

    void accept() noexcept
    {
        if (compensated_) lost_ = next_lost_;
    }

    /// The state at t + theta h, 0 <= theta <= 1: a step of length theta h.
    status_t<Scalar> interpolate(const M& model, Real t, const State& s, Real h, const State&, Real theta,
                                 State& out) noexcept
    {
        const auto status = move(model, t, s, theta * h, out);
        return StatusOf<Scalar>::first(status, detail::check_finite(out));
    }

    /// How often the first part moved: the kick, where there is one.
    [[nodiscard]] std::size_t calls() const noexcept { return calls_; }

  private:
    static constexpr auto parts = static_cast<std::size_t>(M::flows);
    static constexpr std::size_t count = Splitting::weights.size();
    static constexpr auto sweeps = splitting::times_of_sweeps<Splitting>();

    /// Where a step is so far.
    struct Way {
        const M& model;
        Real clock; ///< of part 0, which the last part moves: no other one knows of time
        const State& s;
        State& s1;
        status_t<Scalar> status;
    };

    /// P_(place + 1) for the time h.
    template <std::size_t place>
    void flow(Way& way, const Real& h) noexcept
    {
        constexpr std::size_t part = Splitting::kick_first ? place : parts - 1 - place;
        const auto status =
            way.model.template flow<static_cast<int>(part)>(Scalar(way.clock), way.s1, Scalar(h), increment_);
        way.status = StatusOf<Scalar>::first(way.status, status);
        if constexpr (part == 0) ++calls_;
        if constexpr (part + 1 == parts) way.clock += h;
        detail::for_lanes(way.s, [&]<int width>(detail::Width<width>, Eigen::Index lane) {
            using detail::load;
            const detail::Slice<State, width> sum =
                load<width>(moved_, lane) + detail::load_fresh<width>(increment_, lane);
            detail::store(moved_, lane, sum);
            detail::store(way.s1, lane, load<width>(way.s, lane) + sum);
        });
    }

    /// P_2 .. P_(N-1), or from the last of them to the first.
    template <bool forwards, std::size_t... inner>
    void sweep(Way& way, const Real& h, std::index_sequence<inner...>) noexcept
    {
        (flow < forwards ? inner + 1 : sizeof...(inner) - inner > (way, h), ...);
    }

    /// s1 = s - lost_ + moved_ by all flows.
    status_t<Scalar> move(const M& model, Real t, const State& s, Real h, State& s1) noexcept
    {
        Way way{model, t, s, s1, StatusOf<Scalar>::good()};
        s1 = s;
        moved_ = -lost_;
        if constexpr (parts == 1) {
            flow<0>(way, h);
        } else {
            constexpr auto inner = std::make_index_sequence<parts - 2>();
            const auto length = [&h](const Coefficient& weight) { return Real(weight.template as<Real>() * h); };
            for (std::size_t k = 0; k + 1 < count; k += 2) {
                flow<0>(way, length(Splitting::weights[k]));
                sweep<true>(way, length(sweeps[k]), inner);
                flow<parts - 1>(way, length(Splitting::weights[k + 1]));
                if (k + 2 < count) sweep<false>(way, length(sweeps[k + 1]), inner);
                if (!is_pack<Scalar> && !StatusOf<Scalar>::all_good(way.status)) return way.status;
            }
            if constexpr (count % 2 == 1) flow<0>(way, length(Splitting::weights[count - 1]));
        }
        return way.status;
    }

    State lost_, next_lost_; ///< of the sums, before and behind a step
    State moved_;            ///< since the beginning of the step
    State increment_;
    std::size_t calls_ = 0;
    bool compensated_;
};

namespace splitting {

/// Stoermer-Verlet, drift-kick-drift.
struct LeapfrogDkd {
    static constexpr int order = 2;
    static constexpr bool kick_first = false, affine = false;
    static constexpr auto weights = mirrored<2>({{{0.5}, {1}}});
};

/// Stoermer-Verlet, kick-drift-kick.
struct LeapfrogKdk {
    static constexpr int order = 2;
    static constexpr bool kick_first = true, affine = false;
    static constexpr auto weights = LeapfrogDkd::weights;
};

} // namespace splitting

/// The stepper of a splitting method: see integrate/stepper.hpp for what is asked of it.
template <class Splitting, class M>
class SplittingStepper {
    static constexpr std::size_t base = detail::base_size<M>;
    static constexpr std::size_t rest = base == detail::sized_later ? base : detail::size_of_state<M> - base;
    static_assert(base > 0 && rest > 0, "a partitioned method needs a model with base and fibre lanes");
    static_assert(moves_by_sums<M>, "a partitioned method moves base and fibre lanes by sums");

  public:
    using Scalar = typename M::Scalar;
    using Real = real_t<Scalar>;
    using State = typename M::State;
    static constexpr bool adaptive = false;
    static constexpr int order = Splitting::order;
    static constexpr int dense_order = Splitting::order;

    template <class Method>
    explicit SplittingStepper(const Method& method) noexcept : compensated_(method.compensated)
    {
    }

    /// Probes the form of the right-hand side: xdot must not change with x, nor ydot with y, by more than 1e-6
    /// relative, nor the change of xdot along y where the method needs that. Where the displaced points cannot be
    /// evaluated the probe says nothing.
    status_t<Scalar> begin(const M& model, Real t, const State& s) noexcept
    {
        if constexpr (base == detail::sized_later) {
            base_ = detail::Size<base>(static_cast<std::size_t>(model.base_lanes()));
            rest_ = detail::Size<rest>(static_cast<std::size_t>(s.size() - model.base_lanes()));
            if (base_ == 0 || rest_ == 0) return Status::not_separable;
            second_order_ = model.order_of_system() != SecondOrder::no;
        }
        lost_ = State::Zero(s.size());
        next_lost_ = moved_ = rates_ = first_ = last_ = lost_;
        const auto status = model.rhs(Scalar(t), s, first_);
        ++calls_;
        if (!StatusOf<Scalar>::all_good(status)) return status;
        State change = lost_, change_of_two = lost_;
        auto verdict = StatusOf<Scalar>::good();
        if (probe(model, t, s, Lanes<false>(), 1, change)) refuse(verdict, change, Lanes<false>());
        if (!probe(model, t, s, Lanes<true>(), 1, change)) return verdict;
        refuse(verdict, change, Lanes<true>());
        if (Splitting::affine && probe(model, t, s, Lanes<true>(), 2, change_of_two))
            refuse(verdict, State(change_of_two - change - change), Lanes<false>());
        return verdict;
    }

    status_t<Scalar> attempt(const M& model, Real t, const State& s, Real h, State& s1) noexcept
    {
        const auto status = move(model, t, s, h, s1, last_);
        detail::keep_lost(s, s1, moved_, next_lost_);
        return StatusOf<Scalar>::first(status, detail::check_finite(s1));
    }

    void accept() noexcept
    {
        if (compensated_) lost_ = next_lost_;
        if constexpr (joins) first_ = last_;
    }

    /// The state at t + theta h, 0 <= theta <= 1: a step of length theta h.
    status_t<Scalar> interpolate(const M& model, Real t, const State& s, Real h, const State&, Real theta,
                                 State& out) noexcept
    {
        const auto status = move(model, t, s, theta * h, out, rates_);
        return StatusOf<Scalar>::first(status, detail::check_finite(out));
    }

    [[nodiscard]] std::size_t calls() const noexcept { return calls_; }

  private:
    static constexpr std::size_t count = Splitting::weights.size();
    /// A step ends with rates that the next one begins with: those of its last kick, or of its last drift.
    static constexpr bool joins = count % 2 == 1;

    /// The lanes that a kick moves, or a drift: so many from `begin` on.
    template <bool kick>
    struct Lanes {
    };
    template <bool kick>
    [[nodiscard]] Eigen::Index begin_of(Lanes<kick>) const noexcept
    {
        return kick ? static_cast<Eigen::Index>(base_) : 0;
    }
    template <bool kick>
    [[nodiscard]] Eigen::Index size_of(Lanes<kick>) const noexcept
    {
        return static_cast<Eigen::Index>(kick ? std::size_t(rest_) : std::size_t(base_));
    }

    [[nodiscard]] bool is_second_order() const noexcept
    {
        if constexpr (base == detail::sized_later)
            return second_order_;
        else
            return second_order<M> != SecondOrder::no;
    }

    /// s1 = s - lost_ + moved_ by all drifts and kicks; `last` has the rates of the last one.
    status_t<Scalar> move(const M& model, Real t, const State& s, Real h, State& s1, State& last) noexcept
    {
        auto status = StatusOf<Scalar>::good();
        std::array<Real, 2> clocks{t, t}; // of drifts and of kicks
        s1 = s;
        moved_ = -lost_;
        const auto substep = [&]<bool kick>(std::size_t k, Lanes<kick> lanes) {
            const Real length = Splitting::weights[k].template as<Real>() * h;
            if (!kick && is_second_order()) {
                go(s, length, lanes, static_cast<Eigen::Index>(base_), s1, s1);
            } else if (joins && k == 0) {
                go(s, length, lanes, 0, first_, s1);
            } else {
                State& rates = joins && k + 1 == count ? last : rates_;
                status = StatusOf<Scalar>::first(status, model.rhs(Scalar(clocks[kick]), s1, rates));
                ++calls_;
                go(s, length, lanes, 0, rates, s1);
            }
            clocks[!kick] += length;
        };
        constexpr bool kick_first = Splitting::kick_first;
        for (std::size_t k = 0; k + 1 < count; k += 2) {
            substep(k, Lanes<kick_first>());
            substep(k + 1, Lanes<!kick_first>());
            if (!is_pack<Scalar> && !StatusOf<Scalar>::all_good(status)) return status;
        }
        if constexpr (joins) substep(count - 1, Lanes<kick_first>());
        return status;
    }

    /// Moves these lanes by length * rates, whose lanes stand `shift` behind them.
    template <bool kick>
    [[gnu::always_inline]] void go(const State& s, const Real& length, Lanes<kick> lanes, Eigen::Index shift,
                                   const State& rates, State& s1) noexcept
    {
        constexpr auto size = static_cast<Eigen::Index>(kick ? rest : base); // sized_later is Eigen::Dynamic
        detail::for_first_lanes<State, size>(size_of(lanes), [&]<int width>(detail::Width<width>, Eigen::Index place) {
            using detail::load;
            const Eigen::Index lane = begin_of(lanes) + place;
            const detail::Slice<State, width> sum =
                load<width>(moved_, lane) + length * detail::load_fresh<width>(rates, lane + shift);
            detail::store(moved_, lane, sum);
            detail::store(s1, lane, load<width>(s, lane) + sum);
        });
    }

    /// What the rates have more than at s where these lanes are displaced `times` times; false where there are none.
    template <bool kick>
    bool probe(const M& model, Real t, const State& s, Lanes<kick> lanes, int times, State& change) noexcept
    {
        State moved = s;
        const Eigen::Index begin = begin_of(lanes), end = begin + size_of(lanes);
        for (Eigen::Index lane = begin; lane < end; ++lane)
            moved[lane] += Scalar(Real(times) / Real(64)) * (Scalar(1) + s[lane] * s[lane]);
        ++calls_;
        if (!StatusOf<Scalar>::all_good(model.rhs(Scalar(t), moved, rates_))) return false;
        change = rates_ - first_;
        return true;
    }

    template <bool kick>
    void refuse(status_t<Scalar>& verdict, const State& change, Lanes<kick> lanes) const noexcept
    {
        const Eigen::Index begin = begin_of(lanes), end = begin + size_of(lanes);
        for (Eigen::Index lane = begin; lane < end; ++lane) {
            const Scalar size = Scalar(1) + first_[lane] * first_[lane];
            StatusOf<Scalar>::fail(verdict, change[lane] * change[lane] > Scalar(Real(1e-12)) * size,
                                   Status::not_separable);
        }
    }

    State lost_, next_lost_; ///< of the sums, before and behind a step
    State moved_;            ///< since the beginning of the step
    State rates_, first_, last_;
    std::size_t calls_ = 0;
    [[no_unique_address]] detail::Size<base> base_{};
    [[no_unique_address]] detail::Size<rest> rest_{};
    bool second_order_ = false; ///< of a model whose lanes are known at run time
    bool compensated_;
};

/// A splitting method with a fixed positive `step`; `compensated` carries the rounding errors of the sums along.
template <class Splitting>
struct SplittingMethod {
    double step = 0;
    bool compensated = true;
    static constexpr bool is_symmetric = splitting::is_palindrome(Splitting::weights);

    template <class M>
    using Stepper = std::conditional_t<HasFlows<M> && !Splitting::affine, FlowStepper<Splitting, M>,
                                       SplittingStepper<Splitting, M>>;
};

using LeapfrogDkd = SplittingMethod<splitting::LeapfrogDkd>;
using LeapfrogKdk = SplittingMethod<splitting::LeapfrogKdk>;
using McLachlan4 = SplittingMethod<splitting::McLachlan4>;
using BlanesMoan4 = SplittingMethod<splitting::BlanesMoan4>;
using Srkn4 = SplittingMethod<splitting::Srkn4>;
using Yoshida6 = SplittingMethod<splitting::Yoshida6>;
using BlanesMoan6 = SplittingMethod<splitting::BlanesMoan6>;
using Srkn6 = SplittingMethod<splitting::Srkn6>;
using KahanLi8 = SplittingMethod<splitting::KahanLi8>;
using Sofroniou10 = SplittingMethod<splitting::Sofroniou10>;

} // namespace lagen
