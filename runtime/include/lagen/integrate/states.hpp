// SPDX-License-Identifier: MIT
/// Whole states: inside the domain or not, lanes of packs that failed, and no state at all.
#pragma once

#include "lagen/integrate/retract.hpp"
#include "lagen/kernel.hpp"

#include <algorithm>
#include <limits>

namespace lagen::detail {

/// left_domain where one of the model's strict inequalities fails, a lane.
template <class M>
[[gnu::always_inline]] inline status_t<typename M::Scalar>
domain_status([[maybe_unused]] const M& model, [[maybe_unused]] const step_time_t<M>& t,
              [[maybe_unused]] const typename M::State& s) noexcept
{
    using Scalar = typename M::Scalar;
    auto status = StatusOf<Scalar>::good();
    if constexpr (HasDomain<M>) {
        const auto values = model.domain(Scalar(t), s);
        for (Eigen::Index i = 0; i < values.size(); ++i)
            StatusOf<Scalar>::fail(status, !(values[i] > Scalar(0)), Status::left_domain);
    }
    return status;
}

/// Where a status is good, a lane.
template <class Scalar>
[[nodiscard]] typename StatusOf<Scalar>::mask is_good(const status_t<Scalar>& status) noexcept
{
    if constexpr (is_pack<Scalar>) {
        typename StatusOf<Scalar>::mask good = Scalar(0) <= Scalar(0);
        if (StatusOf<Scalar>::all_good(status)) [[likely]]
            return good;
        for (int lane = 0; lane < RealOf<Scalar>::lanes; ++lane) good.lanes[lane] = status[lane] == Status::ok ? -1 : 0;
        return good;
    } else {
        return status == Status::ok;
    }
}

/// Failures of lanes are kept in `lanes`; a failure of every lane is one of the step.
template <class Scalar>
Status settle(status_t<Scalar>& lanes, const status_t<Scalar>& status) noexcept
{
    lanes = StatusOf<Scalar>::first(lanes, status);
    if constexpr (is_pack<Scalar>) {
        const auto& all = lanes.lanes;
        return std::find(all.begin(), all.end(), Status::ok) == all.end() ? all.front() : Status::ok;
    } else {
        return status;
    }
}

/// Lanes of a pack that failed keep the state `from`.
template <class Scalar, class State>
void freeze([[maybe_unused]] const status_t<Scalar>& lanes, [[maybe_unused]] const State& from,
            [[maybe_unused]] State& to) noexcept
{
    if constexpr (is_pack<Scalar>) {
        if (StatusOf<Scalar>::all_good(lanes)) return;
        for (int lane = 0; lane < RealOf<Scalar>::lanes; ++lane)
            if (lanes[lane] != Status::ok)
                for (Eigen::Index i = 0; i < to.size(); ++i) to[i].set(lane, from[i][lane]);
    }
}

/// A column of NaN like s; of a state that is no column, s itself.
template <class Scalar, class State>
[[nodiscard]] State no_state(const State& s)
{
    if constexpr (requires { State::Constant(s.size(), Scalar(0)); })
        return State::Constant(s.size(), Scalar(std::numeric_limits<real_t<Scalar>>::quiet_NaN()));
    else
        return s;
}

} // namespace lagen::detail
