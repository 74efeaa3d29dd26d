// SPDX-License-Identifier: MIT
/// A model of a user's own function: `lagen::ode<2>([](double t, const auto& s, auto& ds) { .. })`, and of second order
/// `lagen::second_order_ode<3>([](double t, const auto& x, auto& a) { .. })`.
#pragma once

#include "lagen/kernel.hpp"

#include <type_traits>
#include <utility>

namespace lagen {

namespace detail {

/// What f answers; good where that is nothing.
template <class S, class F, class... Arguments>
[[nodiscard]] status_t<S> answer_of(const F& f, Arguments&&... arguments) noexcept
{
    using Answer = std::invoke_result_t<const F&, Arguments...>;
    static_assert(std::is_void_v<Answer> || std::is_same_v<Answer, status_t<S>>,
                  "lagen::ode<N>(f): f answers nothing or a lagen::Status (of a pack: its status)");
    if constexpr (std::is_void_v<Answer>) {
        f(std::forward<Arguments>(arguments)...);
        return StatusOf<S>::good();
    } else {
        return f(std::forward<Arguments>(arguments)...);
    }
}

} // namespace detail

/// ds/dt = f(t, s) of N lanes. What f has captured are its parameters; a copy of it is kept.
template <int N, class S, class F>
class Ode {
  public:
    using Scalar = S;
    static constexpr int dimension = N;
    using State = Eigen::Matrix<S, N, 1>;

    explicit Ode(F f) : f_(std::move(f)) {}

    /// f writes every lane of ds. Where it answers a status, that is the status of the call. It must not throw.
    [[nodiscard]] status_t<S> rhs(S t, const State& s, State& ds) const noexcept
    {
        static_assert(std::is_invocable_v<const F&, S, const State&, State&>,
                      "lagen::ode<N>(f): f(t, s, ds) with t a scalar, s a const State and ds a State to write is "
                      "required, and f must be callable where it is const (no mutable lambda)");
        return detail::answer_of<S>(f_, t, s, ds);
    }

  private:
    F f_;
};

/// The model of ds/dt = f(t, s): f is called as f(t, s, ds) with Eigen columns s and ds of N lanes of `S`, and answers
/// nothing or a Status. A generic lambda serves every scalar: ode<2, float>(f), ode<2, Pack<double, 4>>(f).
template <int N, class S = double, class F>
[[nodiscard]] Ode<N, S, F> ode(F f)
{
    static_assert(N > 0, "lagen::ode<N>: a state has at least one lane");
    return Ode<N, S, F>(std::move(f));
}

/// x' = v, v' = f of N positions x; the state is (x, v).
template <int N, class S, class F>
class SecondOrderOde {
  public:
    using Scalar = S;
    static constexpr int dimension = 2 * N, base_dimension = N, fibre_dimension = N;
    using State = Eigen::Matrix<S, 2 * N, 1>;
    using Half = Eigen::Matrix<S, N, 1>;
    static constexpr bool is_velocity_free = std::is_invocable_v<const F&, S, const Half&, Half&>;
    static constexpr SecondOrder second_order = is_velocity_free ? SecondOrder::velocity_free : SecondOrder::general;

    explicit SecondOrderOde(F f) : f_(std::move(f)) {}

    /// f writes every acceleration, and answers nothing or a Status. It must not throw.
    [[nodiscard]] status_t<S> rhs(S t, const State& s, State& ds) const noexcept
    {
        const Half x = s.template head<N>(), v = s.template tail<N>();
        Half a;
        const status_t<S> status = [&] {
            if constexpr (is_velocity_free)
                return detail::answer_of<S>(f_, t, x, a);
            else
                return detail::answer_of<S>(f_, t, x, v, a);
        }();
        ds.template head<N>() = v;
        ds.template tail<N>() = a;
        return status;
    }

  private:
    F f_;
};

/// The model of x'' = f(t, x), f called as f(t, x, a), or of x'' = f(t, x, x'), called as f(t, x, v, a), with Eigen
/// columns of N lanes of `S`, of which it writes a. Every method integrates it, those of Nystrom too.
template <int N, class S = double, class F>
[[nodiscard]] SecondOrderOde<N, S, F> second_order_ode(F f)
{
    static_assert(N > 0, "lagen::second_order_ode<N>: there is at least one position");
    return SecondOrderOde<N, S, F>(std::move(f));
}

} // namespace lagen
