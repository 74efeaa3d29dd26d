// SPDX-License-Identifier: GPL-2.0-or-later
/// Every kind of method on a header, for scripts/headers: no compiler warns of what a user includes and instantiates.
#include "cart_pole.hpp"
#include "heavy_top.hpp"
#include "heisenberg.hpp"
#include "kepler_discrete.hpp"
#include "pendulum.hpp"

#include <lagen/ensemble.hpp>
#include <lagen/lagen.hpp>
#include <lagen/ode.hpp>

namespace lagen {

template <class M, class... Methods>
int integrate_all(const M& model, typename M::State s, const Methods&... methods)
{
    using S = typename M::Scalar;
    const auto succeeds = [&](const auto& method) {
        Integrator integrator(model, s, S(0), method);
        if (integrator.advance_to(S(1)) == Status::ok) s = integrator.at(S(1));
        return static_cast<bool>(integrate(model, s, {S(0), S(1)}, method, {.dense = true}));
    };
    return (0 + ... + static_cast<int>(succeeds(methods)));
}

int integrate_pendulum(const models::pendulum<double>& model)
{
    return integrate_all(model, {1, 0}, Rk4{.step = 0.1}, Dopri5{}, Verner76{}, Rkn64{}, Rkng54{}, Gauss4{.step = 0.1},
                         Gauss8{.step = 0.1}, Radau5{}, LeapfrogKdk{.step = 0.1}, KahanLi8{.step = 0.1});
}

int integrate_top(const models::heavy_top<float>& model)
{
    return integrate_all(model, models::heavy_top<float>::State::Ones(), Dop853{}, Rkmk4{.step = 0.1},
                         GaussLie4{.step = 0.1}, CrouchGrossman3{.step = 0.1});
}

int integrate_discretely(const models::kepler_discrete_discrete<double>& model)
{
    return integrate_all(model, models::kepler_discrete_discrete<double>::State::Ones(), Discrete{}, Discrete4{});
}

template <class M>
void integrate_abreast(const M& model)
{
    ensemble(
        model, 4, [](std::size_t, M&) { return typename M::State(M::State::Ones()); }, {0, 1}, Dop853{},
        [](std::size_t, const Run<M>&) {});
}

void integrate_ensembles()
{
    integrate_abreast(models::cart_pole<double>{});
    integrate_abreast(models::heisenberg<float>{});
}

Status integrate_lambda()
{
    const auto decay = ode<1>([](double, const auto& x, auto& dx) { dx[0] = -x[0]; });
    return integrate(decay, Eigen::Matrix<double, 1, 1>(1), {0.0, 1.0}, Tsit5{}).status();
}

} // namespace lagen
