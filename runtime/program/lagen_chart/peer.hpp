// SPDX-License-Identifier: MIT
/// What the entrants of other libraries share: the same right-hand side by pointers, with its calls counted and
/// bounded.
#pragma once

#include "lagen_chart/contest.hpp"

#include <vector>

namespace lagen::chart {

template <class M>
class Peer {
  public:
    using State = typename M::State;
    static constexpr std::size_t lanes = static_cast<std::size_t>(M::dimension);

    Peer(const M& model, const State& start, const Request& request) : model_(model), start_(start), request_(request)
    {
        // What depends on the parameters alone is computed once, as integrate() does.
        if constexpr (HasParameterStatus<M>) static_cast<void>(model_.parameter_status());
    }

    [[nodiscard]] double steps_of(double) const { return 0; }

  protected:
    /// False where the model fails, or where too many calls were made.
    [[nodiscard]] bool rates(double t, const double* s, double* ds) const
    {
        State state, rate;
        for (std::size_t i = 0; i < lanes; ++i) state[static_cast<Eigen::Index>(i)] = s[i];
        if (++calls_ > 20 * request_.most || model_.rhs(t, state, rate) != Status::ok) return false;
        for (std::size_t i = 0; i < lanes; ++i) ds[i] = rate[static_cast<Eigen::Index>(i)];
        return true;
    }

    template <class Observer>
    static void show(Observer& observer, double t, const double* s)
    {
        State state;
        for (std::size_t i = 0; i < lanes; ++i) state[static_cast<Eigen::Index>(i)] = s[i];
        observer.row(t, state);
        if constexpr (requires { observer(t, state); }) observer(t, state);
    }

    /// A first step for those that ask for one, in the direction of the run.
    [[nodiscard]] double first_step() const { return (request_.end - request_.start) / 1000; }

    M model_;
    State start_;
    const Request& request_;
    mutable std::size_t calls_ = 0;
};

} // namespace lagen::chart
