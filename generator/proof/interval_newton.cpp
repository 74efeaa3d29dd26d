// SPDX-License-Identifier: GPL-2.0-or-later
#include "proof/interval_newton.hpp"

#include <cmath>

namespace lagen::proof {

Ball widened(const Ball& ball, long exponent)
{
    Ball out = ball;
    mag_set_ui_2exp_si(arb_radref(out.get()), 1, -exponent);
    return out;
}

double radius_of(const Ball& ball)
{
    return mag_get_d(arb_radref(ball.get()));
}

RefinedRoot refined_root(const std::function<NewtonEquations(const std::vector<Ball>&)>& equations,
                         const std::vector<Ball>& start, std::size_t watched, slong bits)
{
    std::vector<Ball> u = start;
    for (int step = 0; step < 12; ++step) {
        const NewtonEquations at = equations(u);
        const auto change = solved(at.slope, at.value, bits);
        if (!change) return {start};
        for (std::size_t k = 0; k < u.size(); ++k) {
            arb_sub(u[k].get(), u[k].get(), change->at(k, 0).get(), bits);
            mag_zero(arb_radref(u[k].get()));
        }
    }
    for (std::size_t k = 0; k < watched; ++k)
        if (!(std::fabs(u[k].middle() - start[k].middle()) < 1e-3 * (1 + std::fabs(u[k].middle())))) return {start};
    for (const long exponent : {160L, 120L, 80L, 40L}) {
        std::vector<Ball> box;
        for (const Ball& each : u) box.push_back(widened(each, exponent));
        const auto change = solved(equations(box).slope, equations(u).value, bits);
        if (!change) continue;
        std::vector<Ball> inside = u;
        bool contained = true;
        for (std::size_t k = 0; k < u.size(); ++k) {
            arb_sub(inside[k].get(), u[k].get(), change->at(k, 0).get(), bits);
            contained = contained && arb_contains_interior(box[k].get(), inside[k].get()) != 0;
        }
        if (contained) return {inside, true};
    }
    return {u};
}

} // namespace lagen::proof
