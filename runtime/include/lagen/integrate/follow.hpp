// SPDX-License-Identifier: MIT
/// Why a step failed whose model follows something: because the step was too long, or because what it follows ends.
#pragma once

#include "lagen/integrate/states.hpp"

#include <cmath>
#include <limits>

namespace lagen::detail {

/// Does it search for something, and follow what it found? Follows is true of every compiled model.
template <class M>
[[nodiscard]] bool follows([[maybe_unused]] const M& model) noexcept
{
    if constexpr (requires { model.follows(); }) return model.follows();
    return Follows<M>;
}

/// `status`, where it is good and that of the domain at (t, s) too, joined with that of following.
template <Follows M>
[[nodiscard]] status_t<typename M::Scalar> followed(M& model, const status_t<typename M::Scalar>& status,
                                                    real_t<typename M::Scalar> t, const typename M::State& s) noexcept
{
    using Scalar = typename M::Scalar;
    using Lanes = StatusOf<Scalar>;
    if (!is_pack<Scalar> && !Lanes::all_good(Lanes::first(status, domain_status(model, t, s)))) return status;
    return Lanes::first(status, model.follow(Scalar(t), s));
}

/// What a step of length h from (t, s) that ended with `reason` failed of. Where a search failed, the model is followed
/// along the tangent of the motion in steps as short as need be: not_a_maximum where they lead to no end of the step,
/// since a maximum that is one can be followed as far as d2H/du2 is regular; else `reason`.
template <class M>
[[nodiscard]] Status loss_of_maximum(Status reason, const M&, real_t<typename M::Scalar>, const typename M::State&,
                                     real_t<typename M::Scalar>) noexcept
{
    return reason;
}

template <Follows M>
requires(!is_pack<typename M::Scalar>) [[nodiscard]] Status
    loss_of_maximum(Status reason, const M& model, real_t<typename M::Scalar> t, const typename M::State& s,
                    real_t<typename M::Scalar> h) noexcept
{
    using Scalar = typename M::Scalar;
    using Real = real_t<Scalar>;
    using std::sqrt;
    if (!follows(model)) return reason;
    tangent_t<M> rate;
    if constexpr (std::is_same_v<typename M::State, tangent_t<M>>) rate = s;
    if (reason != Status::newton_diverged || model.rhs(Scalar(t), s, rate) != Status::ok) return reason;
    M ahead = model;
    const Real shortest = sqrt(std::numeric_limits<Real>::epsilon());
    Real done = Real(0);
    for (Real part = Real(1); part > shortest;) {
        const Real next = done + part < Real(1) ? done + part : Real(1);
        const typename M::State there = retracted(model, s, tangent_t<M>((next * h) * rate));
        const Status status = ahead.follow(Scalar(t + next * h), there);
        if (status != Status::ok && status != Status::newton_diverged && status != Status::not_a_maximum) return reason;
        if (status != Status::ok) {
            part /= Real(2);
            continue;
        }
        if (next >= Real(1)) return reason;
        done = next;
    }
    return Status::not_a_maximum;
}

} // namespace lagen::detail
