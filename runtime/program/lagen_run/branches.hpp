// SPDX-License-Identifier: MIT
/// Which arrow a discrete run begins with, and what else has its momenta: variational/arrows.hpp.
#pragma once

#include "lagen/integrate.hpp"
#include "lagen_run/report.hpp"

#include <optional>
#include <vector>

namespace lagen::detail {

/// A run that has no start, for this reason.
template <class M>
Run<M> no_run(const typename M::State& s, double t, Status reason)
{
    Run<M> run;
    run.t = run.failed_at = t;
    run.state = s;
    run.outcome = reason;
    return run;
}

/// Of a motion that is none from step to step: nothing.
template <class M>
class Branches {
  public:
    Branches(const M&, double, bool) {}
    [[nodiscard]] Status begin(typename M::State&, std::size_t) { return Status::ok; }
    void report(const Run<M>&, RunReport&) const {}
};

template <DiscreteMotion M>
class Branches<M> {
  public:
    using State = typename M::State;

    /// `from_arrow`: the momenta are those of the arrow, whatever they are.
    Branches(const M& model, double t, bool from_arrow) : model_(model), t_(t), from_arrow_(from_arrow) {}

    /// The start of the run into s; no_solution where it is to be that of a branch (from 1 on) which is not found,
    /// branch_lost where the inner unknowns of the arrow are not found, as of a half turn by exp.
    [[nodiscard]] Status begin(State& s, std::size_t branch)
    {
        const State given = s;
        if (from_arrow_) s = at_arrow(model_, t_, s);
        if (ArrowLanes<M>::inner > 0 && given.allFinite() && !s.allFinite()) {
            s = given;
            return Status::branch_lost;
        }
        start_ = s;
        if (branch == 0) return Status::ok;
        found_ = arrows_of_momenta(model_, t_, s);
        if (branch > found_->size()) return Status::no_solution;
        s = (*found_)[branch - 1].state;
        return Status::ok;
    }

    /// Tells `branches`.
    void report(const Run<M>& run, RunReport& report)
    {
        const bool lost = run.status() == Status::no_solution || run.status() == Status::branch_lost ||
                          run.status() == Status::newton_diverged;
        if (lost && !found_ && !from_arrow_) found_ = arrows_of_momenta(model_, t_, start_);
        if (found_) report.branches = distances(*found_);
    }

  private:
    using Arrows = std::vector<FoundArrow<M>>;

    [[nodiscard]] static std::vector<double> distances(const Arrows& arrows)
    {
        std::vector<double> list;
        for (const FoundArrow<M>& arrow : arrows) list.push_back(arrow.distance);
        return list;
    }

    const M& model_;
    double t_;
    bool from_arrow_;
    State start_ = State::Zero();
    std::optional<Arrows> found_;
};

} // namespace lagen::detail
