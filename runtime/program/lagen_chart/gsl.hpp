// SPDX-License-Identifier: MIT
/// The GNU Scientific Library in a contest of `lagen chart`: its explicit pairs, which end at every sample.
#pragma once

#if __has_include(<gsl/gsl_odeiv2.h>) // `lagen chart` looks for it before

#include "lagen_chart/peer.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

namespace lagen {

namespace chart {

struct GslRk8pd {
    static const gsl_odeiv2_step_type* type() { return gsl_odeiv2_step_rk8pd; }
};

struct GslRkf45 {
    static const gsl_odeiv2_step_type* type() { return gsl_odeiv2_step_rkf45; }
};

template <class M, class Type>
class Gsl : public Peer<M> {
  public:
    using Peer<M>::Peer;

    template <class Observer>
    PointOutcome operator()(double tolerance, Observer& observer) const
    {
        this->calls_ = 0;
        gsl_set_error_handler_off();
        gsl_odeiv2_system system{&Gsl::call, nullptr, this->lanes, const_cast<Gsl*>(this)};
        gsl_odeiv2_driver* driver =
            gsl_odeiv2_driver_alloc_y_new(&system, Type::type(), this->first_step(), tolerance, tolerance);
        std::array<double, Peer<M>::lanes> s;
        for (std::size_t i = 0; i < s.size(); ++i) s[i] = this->start_[static_cast<Eigen::Index>(i)];
        double t = this->request_.start;
        PointOutcome outcome;
        for (const double time : this->request_.at) {
            outcome.good =
                driver != nullptr && (time == t || gsl_odeiv2_driver_apply(driver, &t, time, s.data()) == GSL_SUCCESS);
            if (!outcome.good) break;
            this->show(observer, time, s.data());
        }
        if (!outcome.good) outcome.status = "failed";
        if (driver != nullptr) {
            outcome.steps = driver->e->count;
            outcome.rejected = driver->e->failed_steps;
            gsl_odeiv2_driver_free(driver);
        }
        outcome.calls = this->calls_;
        return outcome;
    }

  private:
    static int call(double t, const double* s, double* ds, void* self)
    {
        return static_cast<const Gsl*>(self)->rates(t, s, ds) ? GSL_SUCCESS : GSL_EBADFUNC;
    }
};

} // namespace chart

template <class M>
int chart_peer(int argc, char** argv)
{
    using namespace chart;
    return hold_contest<M, Gsl<M, GslRk8pd>, Gsl<M, GslRkf45>>({"rk8pd", "rkf45"}, argc, argv);
}

} // namespace lagen

#endif
