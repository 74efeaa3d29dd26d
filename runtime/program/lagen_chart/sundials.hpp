// SPDX-License-Identifier: MIT
/// SUNDIALS (6 or later) in a contest of `lagen chart`: CVODE's Adams methods with fixed-point iteration, values at the
/// samples by its interpolation.
#pragma once

#if __has_include(<cvode/cvode.h>) // `lagen chart` looks for it before

#include "lagen_chart/peer.hpp"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_nonlinearsolver.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

namespace lagen {

namespace chart {

template <class M>
class CvodeAdams : public Peer<M> {
  public:
    using Peer<M>::Peer;

    template <class Observer>
    PointOutcome operator()(double tolerance, Observer& observer) const
    {
        this->calls_ = 0;
        SUNContext context = nullptr;
        PointOutcome outcome;
        SUNContext_Create(nullptr, &context);
        N_Vector s = N_VNew_Serial(static_cast<sunindextype>(this->lanes), context);
        double* numbers = N_VGetArrayPointer(s);
        for (std::size_t i = 0; i < this->lanes; ++i) numbers[i] = this->start_[static_cast<Eigen::Index>(i)];
        void* memory = CVodeCreate(CV_ADAMS, context);
        CVodeInit(memory, &CvodeAdams::call, this->request_.start, s);
        CVodeSetErrFile(memory, nullptr);
        CVodeSStolerances(memory, tolerance, tolerance);
        CVodeSetUserData(memory, const_cast<CvodeAdams*>(this));
        CVodeSetMaxNumSteps(memory, static_cast<long>(this->request_.most));
        SUNNonlinearSolver solver = SUNNonlinSol_FixedPoint(s, 0, context);
        CVodeSetNonlinearSolver(memory, solver);
        double t = this->request_.start;
        for (const double time : this->request_.at) {
            outcome.good = time == t || CVode(memory, time, s, &t, CV_NORMAL) >= 0;
            if (!outcome.good) break;
            this->show(observer, time, numbers);
        }
        if (!outcome.good) outcome.status = "failed";
        long steps = 0, failed = 0;
        CVodeGetNumSteps(memory, &steps);
        CVodeGetNumErrTestFails(memory, &failed);
        outcome.steps = static_cast<std::size_t>(steps);
        outcome.rejected = static_cast<std::size_t>(failed);
        outcome.calls = this->calls_;
        CVodeFree(&memory);
        SUNNonlinSolFree(solver);
        N_VDestroy(s);
        SUNContext_Free(&context);
        return outcome;
    }

  private:
    static int call(double t, N_Vector s, N_Vector ds, void* self)
    {
        return static_cast<const CvodeAdams*>(self)->rates(t, N_VGetArrayPointer(s), N_VGetArrayPointer(ds)) ? 0 : -1;
    }
};

} // namespace chart

template <class M>
int chart_peer(int argc, char** argv)
{
    return chart::hold_contest<M, chart::CvodeAdams<M>>({"cvode_adams"}, argc, argv);
}

} // namespace lagen

#endif
