// SPDX-License-Identifier: MIT
/// Boost's odeint in a contest of `lagen chart`: dopri5 with dense output, and two steppers that end at every sample.
#pragma once

#if __has_include(<boost/numeric/odeint.hpp>) // `lagen chart` looks for it before

#include "lagen_chart/peer.hpp"

#include <boost/numeric/odeint.hpp>

#include <stdexcept>

namespace lagen {

namespace chart {

template <class M>
using OdeintState = std::array<double, static_cast<std::size_t>(M::dimension)>;

template <class M>
struct OdeintDopri5 {
    static auto stepper(double tolerance)
    {
        using Stepper = boost::numeric::odeint::runge_kutta_dopri5<OdeintState<M>>;
        return boost::numeric::odeint::make_dense_output(tolerance, tolerance, Stepper());
    }
};

template <class M>
struct OdeintFehlberg78 {
    static auto stepper(double tolerance)
    {
        using Stepper = boost::numeric::odeint::runge_kutta_fehlberg78<OdeintState<M>>;
        return boost::numeric::odeint::make_controlled(tolerance, tolerance, Stepper());
    }
};

template <class M>
struct OdeintBulirschStoer {
    static auto stepper(double tolerance)
    {
        return boost::numeric::odeint::bulirsch_stoer<OdeintState<M>>(tolerance, tolerance);
    }
};

template <class M, class Family>
class Odeint : public Peer<M> {
  public:
    using Peer<M>::Peer;

    template <class Observer>
    PointOutcome operator()(double tolerance, Observer& observer) const
    {
        this->calls_ = 0;
        PointOutcome outcome;
        OdeintState<M> x;
        for (std::size_t i = 0; i < x.size(); ++i) x[i] = this->start_[static_cast<Eigen::Index>(i)];
        std::vector<double> times = this->request_.at;
        const bool begins_later = times.empty() || times.front() != this->request_.start;
        if (begins_later) times.insert(times.begin(), this->request_.start);
        const auto rates = [this](const OdeintState<M>& s, OdeintState<M>& ds, double t) {
            if (!this->rates(t, s.data(), ds.data())) throw std::runtime_error("no rates");
        };
        std::size_t rows = 0;
        const auto keep = [&](const OdeintState<M>& s, double t) {
            if (rows++ > 0 || !begins_later) this->show(observer, t, s.data());
        };
        try {
            outcome.steps = boost::numeric::odeint::integrate_times(Family::stepper(tolerance), rates, x, times.begin(),
                                                                    times.end(), this->first_step(), keep);
        } catch (const std::exception&) {
            outcome.good = false;
            outcome.status = "failed";
        }
        outcome.calls = this->calls_;
        return outcome;
    }
};

} // namespace chart

template <class M>
int chart_peer(int argc, char** argv)
{
    using namespace chart;
    return hold_contest<M, Odeint<M, OdeintDopri5<M>>, Odeint<M, OdeintFehlberg78<M>>,
                        Odeint<M, OdeintBulirschStoer<M>>>({"dopri5", "fehlberg78", "bulirsch_stoer"}, argc, argv);
}

} // namespace lagen

#endif
