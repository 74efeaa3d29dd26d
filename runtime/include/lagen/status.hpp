// SPDX-License-Identifier: MIT
/// What a step or a kernel answers instead of throwing.
#pragma once

#include "lagen/requirements.hpp"

#include <cstdint>

namespace lagen {

/// Outcome of a kernel, a step or a run. Names as `lagen run` prints them.
enum class Status : std::uint8_t {
    ok = 0,
    singular_mass_matrix, ///< a factorisation met a (numerically) singular matrix
    newton_diverged,
    left_domain, ///< a strict inequality of the model's domain was violated
    step_too_small,
    non_finite, ///< a state or a derivative is not a number or infinite
    too_many_steps,
    stopped_by_event, ///< not a failure: an event with stop = true
    interrupted,
    invalid_input,    ///< a step, tolerance or interval that makes no sense (not positive, not finite)
    not_separable,    ///< a partitioned method was asked for, but the equations are not what it splits
    not_a_maximum,    ///< the controls that are followed are no maximum of H: d2H/du2 is not negative definite
    singular_control, ///< H does not depend on a control: it has no maximum to be found at
    no_solution,      ///< the equation of a discrete step has none: its momenta lie behind a fold
    branch_lost,      ///< no way leads from a discrete step to the next one on its branch of solutions
    zeno,             ///< jumps follow each other ever faster: infinitely many of them up to a time
};

/// True where the computation may go on or ended as asked.
[[nodiscard]] constexpr bool is_success(Status status) noexcept
{
    return status == Status::ok || status == Status::stopped_by_event;
}

[[nodiscard]] constexpr const char* to_text(Status status) noexcept
{
    switch (status) {
    case Status::ok: return "ok";
    case Status::singular_mass_matrix: return "singular_mass_matrix";
    case Status::newton_diverged: return "newton_diverged";
    case Status::left_domain: return "left_domain";
    case Status::step_too_small: return "step_too_small";
    case Status::non_finite: return "non_finite";
    case Status::too_many_steps: return "too_many_steps";
    case Status::stopped_by_event: return "stopped_by_event";
    case Status::interrupted: return "interrupted";
    case Status::invalid_input: return "invalid_input";
    case Status::not_separable: return "not_separable";
    case Status::not_a_maximum: return "not_a_maximum";
    case Status::singular_control: return "singular_control";
    case Status::no_solution: return "no_solution";
    case Status::branch_lost: return "branch_lost";
    case Status::zeno: return "zeno";
    }
    return "unknown";
}

} // namespace lagen
