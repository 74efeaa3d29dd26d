// SPDX-License-Identifier: MIT
/// How a state moves: s1 = retract(s, delta). For a vector that is s + delta; a state that is an element of a group
/// moves along the group. A model says how in one of two ways, the first of which that stands is taken:
///   State M::retract(const State& s, const Tangent& delta)   a member function, const or static
///   State retract(const State& s, const Tangent& delta)      a function found beside the type of its State
/// with retract(s, 0) = s and unit derivative there, noexcept, finite where both are. `Tangent` is an Eigen column,
/// that of the rates which `rhs` writes; where the model does not name it, it is M::State. The explicit Runge-Kutta
/// methods take such states; of a Lie group they then compute in the chart delta -> retract(s, delta) around the
/// beginning of the step with the differential of that chart left out, so that the state stays on the group whatever
/// the order is.
#pragma once

#include "lagen/kernel.hpp"

namespace lagen {

namespace detail {

template <class M>
concept RetractsItself = requires(const M& model, const typename M::State& s, const tangent_t<M>& delta)
{
    requires std::same_as<decltype(model.retract(s, delta)), typename M::State>;
};

template <class M>
concept StateRetracts = requires(const typename M::State& s, const tangent_t<M>& delta)
{
    requires std::same_as<decltype(retract(s, delta)), typename M::State>;
};

} // namespace detail

/// A model some of whose lanes are matrices of groups: `stay_on_groups(s0, s1)` puts those of s1, which a step or its
/// interpolation reached from s0, onto their groups.
template <class M>
concept StaysOnGroups = requires(const M& model, const typename M::State& s0, typename M::State& s1)
{
    model.stay_on_groups(s0, s1);
};

/// True of a model whose states are vectors: they move by sums.
template <class M>
inline constexpr bool moves_by_sums = !detail::RetractsItself<M> && !detail::StateRetracts<M>;

namespace detail {

/// The state `delta` away from s.
template <class M>
[[nodiscard]] typename M::State retracted(const M& model, const typename M::State& s,
                                          const tangent_t<M>& delta) noexcept
{
    if constexpr (RetractsItself<M>)
        return model.retract(s, delta);
    else if constexpr (StateRetracts<M>)
        return retract(s, delta);
    else
        return s + delta;
}

} // namespace detail

} // namespace lagen

namespace lagen::detail {

/// The place theta on the chord from a to b; of states without sums the nearer end.
template <class M, class State, class Real>
void go_straight(const State& a, const State& b, const Real& theta, State& out) noexcept
{
    if constexpr (moves_by_sums<M>)
        out = a + theta * (b - a);
    else
        out = theta < Real(0.5) ? a : b;
}

} // namespace lagen::detail
