// SPDX-License-Identifier: MIT
/// What integrate/integrator.hpp asks of a stepper, which makes the steps of a method:
///   begin(model, t, s)                        once, at the start
///   attempt(model, t, s, h, s1)               a step of length h into s1; `error()` where adaptive
///   finish(model, t1, s1), accept()           the derivative at the end where it is needed; then the step counts
///   interpolate(model, t, s, h, s1, theta, out)   a value inside the last attempted step, before accept()
///   calls()                                   of the right-hand side so far
/// A collocation method may have polynomial(theta, out), what the polynomial of the last step has more than its
/// beginning; it answers whether there is one.
/// Adaptive ones may choose their steps themselves: after_accepted(h, error), after_rejected(h, error),
/// after_failure(h). Implicit ones count newton_iterations() and decompositions().
/// One whose lanes can be trajectories of their own (lanes/abreast.hpp) says so by `abreast`, and over packs offers
///   suits(own)                a trajectory of `own`, the stepper of it alone, can go on a lane beside the others
///   adopt(lane, own)          it begins there
///   accept(where)             the step counts in these lanes
///   hand_over(lane, own)      `own` gets what values inside the step of a lane are made of
///   hand_over_length(lane, own)   and, where it chooses lengths itself, how long the next step may be
#pragma once

#include "lagen/kernel.hpp"

#include <cstddef>

namespace lagen::detail {

/// A step that is attempted: its signed length, and whether it ends at the end.
template <class Real>
struct Attempt {
    Real h;
    bool last;
};

/// What steppers have counted, one after another.
struct Work {
    std::size_t calls = 0, newton_iterations = 0, decompositions = 0;

    template <class Stepper>
    [[nodiscard]] Work with(const Stepper& stepper) const noexcept
    {
        Work all = *this;
        all.calls += stepper.calls();
        if constexpr (requires { stepper.newton_iterations(); }) all.newton_iterations += stepper.newton_iterations();
        if constexpr (requires { stepper.decompositions(); }) all.decompositions += stepper.decompositions();
        return all;
    }
};

/// The order of values inside a step: Stepper::dense_order, a function where it is known at run time.
template <class Stepper>
[[nodiscard]] std::size_t dense_order_of([[maybe_unused]] const Stepper& stepper) noexcept
{
    if constexpr (requires { stepper.dense_order(); })
        return stepper.dense_order();
    else
        return static_cast<std::size_t>(Stepper::dense_order);
}

/// Of a method of fixed steps; a discrete motion has its own.
template <class M, class Method>
[[nodiscard]] auto step_length([[maybe_unused]] const M& model, [[maybe_unused]] const Method& method) noexcept
{
    if constexpr (DiscreteMotion<M>)
        return model.step();
    else
        return method.step;
}

template <class M, class Method, class Observer, class Asked>
class March;

template <class M, class Method, int N, class Observer>
class Abreast;

} // namespace lagen::detail
