// SPDX-License-Identifier: GPL-2.0-or-later
/// A header whose velocities are proved to be functions of the momenta for c = 3/5 alone: which parameters it takes.
#include "quartic_body.hpp"

#include <lagen/integrate.hpp>

#include <cstdio>

namespace {

template <class Scalar>
void tell_statuses(const char* name)
{
    lagen::models::quartic_body_hamilton<Scalar> body;
    std::printf("%s %s", name, lagen::to_text(body.parameter_status()));
    body.parameters.k = Scalar(7);
    body.parameters.I_ = Scalar(3);
    std::printf(" %s", lagen::to_text(body.parameter_status()));
    body.parameters.c = Scalar(0.61);
    std::printf(" %s", lagen::to_text(body.parameter_status()));
    body.parameters.c = Scalar(-0.6);
    std::printf(" %s\n", lagen::to_text(body.parameter_status()));
}

} // namespace

int main()
{
    tell_statuses<float>("float");
    tell_statuses<double>("double");
    lagen::models::quartic_body_hamilton<double> body;
    body.parameters.c = 0.7;
    const auto start = body.state({.p_w1 = 1});
    const auto run = lagen::integrate(body, start, {0.0, 1.0}, lagen::Dop853{.tolerance = 1e-10});
    std::printf("run %s\n", lagen::to_text(run.status()));
}
