// SPDX-License-Identifier: MIT
/// `lagen::integrate`: initial-value problems, by the method of any header that includes this one.
///   auto run = lagen::integrate(top, s, {0.0, 10.0}, lagen::Dop853{.tolerance = 1e-10});
///   if (!run) std::puts(lagen::to_text(run.status()));
#pragma once

#include "lagen/integrate/integrator.hpp"
#include "lagen/integrate/march.hpp"
#include "lagen/integrate/options.hpp"

#include <type_traits>

namespace lagen {

/// Integrates ds/dt = model.rhs(t, s) from span.start to span.end, which may lie before it.
/// @param model   RightHandSide, or DiscreteMotion for the method Discrete; its optional parts `domain`, `events` and
/// `parameter_status` are used where they are
/// @param s       initial state
/// @param method  Rk4{.step = h}, Dop853{.tolerance = e}, Yoshida6{.step = h}, ...; the last fixed step is shortened to
/// end on time
/// @param options rows at given times, events, caps: `{.at = times, .max_steps = 1000}`
/// @param observer called as observer(t, s) at the start and after every accepted step; where it has row(t, s), rows go
/// there
///                 instead of into the result
/// @return the last good state, what was counted and found, and a status. Statuses: ok, stopped_by_event, non_finite,
///         step_too_small, too_many_steps, left_domain, interrupted, invalid_input, not_separable, newton_diverged,
///         not_a_maximum, and what the model answers (singular_mass_matrix, singular_control). On failure the state is
///         the one after the last accepted step; on left_domain the last point found inside. Values inside a step come
///         from the method's dense output, or from a shorter step of the same method, so the sequence of steps does not
///         depend on the rows.
template <Motion M, class Method, class Observer>
Run<M> integrate(const M& model, const std::type_identity_t<typename M::State>& s,
                 std::type_identity_t<Interval<real_t<typename M::Scalar>>> span, const Method& method,
                 const std::type_identity_t<Options<M>>& options, Observer&& observer)
{
    return detail::March<M, Method, std::remove_reference_t<Observer>, Options<M>>(model, s, span, method, options,
                                                                                   observer)
        .run();
}

namespace detail {

/// An observer that is told of nothing.
struct Nobody {};

} // namespace detail

template <Motion M, class Method>
Run<M> integrate(const M& model, const std::type_identity_t<typename M::State>& s,
                 std::type_identity_t<Interval<real_t<typename M::Scalar>>> span, const Method& method,
                 const std::type_identity_t<Options<M>>& options)
{
    detail::Nobody nobody;
    return integrate(model, s, span, method, options, nobody);
}

/// A run that asks for its end alone: events, rows and dense output are not even compiled.
template <Motion M, class Method>
Run<M> integrate(const M& model, const std::type_identity_t<typename M::State>& s,
                 std::type_identity_t<Interval<real_t<typename M::Scalar>>> span, const Method& method)
{
    detail::Nobody nobody;
    const detail::NoOptions<M> none;
    return detail::March<M, Method, detail::Nobody, detail::NoOptions<M>>(model, s, span, method, none, nobody).run();
}

} // namespace lagen
