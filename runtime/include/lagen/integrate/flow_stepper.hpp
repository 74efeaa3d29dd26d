// SPDX-License-Identifier: MIT
/// Splitting methods on a model that is a sum of parts with exact flows (`HasFlows`, lagen/kernel.hpp).
///
/// With the weights w_0, w_1, .. of drifts and kicks in turn, a_0 = w_0 and a_k = w_k - a_(k-1), a step of parts
/// P_1 .. P_N is
///   P_1(w_0)   P_2 .. P_(N-1) (a_0)   P_N(w_1)   P_(N-1) .. P_2 (a_1)   P_1(w_2)   ..,
/// that is, P_1 .. P_N and its adjoint P_N .. P_1 for the times a_0, a_1, .. in turn. It has the order that the
/// splitting has for two parts, whatever these are [R. I. McLachlan, SIAM Journal on Scientific Computing 16 (1995)
/// 151]; what rests on an affine x' has none, and splits x and y.
#pragma once

#include "lagen/integrate/retract.hpp"
#include "lagen/integrate/tableau.hpp"
#include "lagen/lanes/lanes.hpp"

#include <utility>

namespace lagen {

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

} // namespace lagen
