// SPDX-License-Identifier: GPL-2.0-or-later
/// The pieces of README, compiled; tests/compile/readme_test.cpp looks for its lines here.
#include "heavy_top.hpp"

#include <lagen/integrate.hpp>

#include <cstdio>

using Top = lagen::models::heavy_top<double>;

namespace {

const Top top;
const Top::State s = Top::state({.g1 = 0.6, .g3 = 0.8}, {.w1 = 0.9, .w2 = -0.4, .w3 = 1.6});

} // namespace

int main()
{
    // clang-format off
    lagen::Integrator integrator(top, s, 0.0, lagen::Dop853{.tolerance = 1e-10});
    lagen::Status status = integrator.step();                          // a step of the method, as long as it likes
    const Top::State middle = integrator.at((integrator.t_before() + integrator.t()) / 2);   // inside the last step
    if (status == lagen::Status::ok) status = integrator.advance_to(1.0);   // steps to exactly t = 1; then t(), state()

    const auto dense = lagen::integrate(top, s, {0.0, 1.0}, lagen::Dop853{.tolerance = 1e-10}, {.dense = true});
    const Top::State quarter = dense.solution(0.25);                   // any time from 0 to dense.t

    const double mu = 5.0;                                             // what a lambda captures are its parameters
    const auto van_der_pol = lagen::ode<2>([=](double, const auto& x, auto& dx) {
        dx[0] = x[1];
        dx[1] = mu * (1 - x[0] * x[0]) * x[1] - x[0];
    });
    const auto cycle = lagen::integrate(van_der_pol, Eigen::Vector2d(2, 0), {0.0, 20.0}, lagen::Tsit5{.tolerance = 1e-8});
    // clang-format on
    std::printf("readme stepping %s %.17g %.17g %.17g\n", lagen::to_text(status), integrator.t(), middle[0],
                integrator.state()[0]);
    const auto direct = lagen::integrate(top, s, {0.0, 0.25}, lagen::Dop853{.tolerance = 1e-12});
    std::printf("readme dense %s %.17g %.17g\n", lagen::to_text(dense.status()), (quarter - direct.state).norm(),
                dense.state[0]);
    const auto finer =
        lagen::integrate(van_der_pol, Eigen::Vector2d(2, 0), {0.0, 20.0}, lagen::Dop853{.tolerance = 1e-12});
    std::printf("readme lambda %s %.17g %.17g\n", lagen::to_text(cycle.status()), cycle.state[0],
                (cycle.state - finer.state).norm());
}
