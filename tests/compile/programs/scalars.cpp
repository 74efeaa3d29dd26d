// SPDX-License-Identifier: GPL-2.0-or-later
/// Three generated headers in every kind of scalar (scalars.hpp prints a line of each). Then one step of RK4 in 50
/// digits: its error must be of order h^5 far below double's rounding.
#include "scalars.hpp"

#include "lagen/integrate.hpp"
#include "support/problems.hpp"

#include "double_pendulum.hpp"
#include "heavy_top.hpp"
#include "heisenberg.hpp"

namespace {

/// Error of one step of RK4 of length 2^-k on Kepler's problem, e = 0.3.
template <class S>
double step_error(int k)
{
    using K = lagen::problems::Kepler<S>;
    S h(1);
    for (int i = 0; i < k; ++i) h /= 2;
    const S begin(0.5), end = begin + h;
    const S e = S(3) / S(10);
    const auto run = lagen::integrate(K{}, K::exact(e, begin), {begin, end}, lagen::Rk4{.step = std::ldexp(1.0, -k)});
    if (!run) std::printf("failed\n");
    const typename K::State exact = K::exact(e, end);
    S worst(0);
    for (Eigen::Index i = 0; i < 4; ++i) {
        const S error = abs(run.state[i] - exact[i]);
        if (error > worst) worst = error;
    }
    return static_cast<double>(worst);
}

} // namespace

int main()
{
    using namespace lagen::models;
    compare<double_pendulum>("double_pendulum");
    compare<heavy_top>("heavy_top");
    compare<heisenberg>("heisenberg");
    for (const int k : {19, 20, 21}) std::printf("%.17g %.17g\n", step_error<Plain50>(k), step_error<Lazy50>(k));
}
