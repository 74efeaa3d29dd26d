// SPDX-License-Identifier: GPL-2.0-or-later
/// Optimal control problems: from the costate of the reference their extremals reach the prescribed end.
#include "examples/follow.hpp"

#include "attitude.hpp"
#include "double_integrator.hpp"
#include "half_plane_control.hpp"
#include "heisenberg_control.hpp"
#include "pointing.hpp"
#include "unicycle.hpp"

using namespace lagen;

namespace {

const ReferenceCase& control_case(const std::string& name)
{
    static const std::vector<ReferenceCase> cases = read_control_cases();
    const auto found =
        std::find_if(cases.begin(), cases.end(), [&](const ReferenceCase& each) { return each.name == name; });
    REQUIRE(found != cases.end());
    return *found;
}

/// State, controls and Hamiltonian at the samples of the case, by DOP853 at 1e-13.
template <class Model>
void follow_extremal(const std::string& name)
{
    CAPTURE(name);
    using State = typename Model::State;
    const ReferenceCase& known = control_case(name);
    const Model model = examples::with_parameters<Model>(known, {});
    std::vector<double> times;
    for (const ReferenceSample& sample : known.samples) times.push_back(examples::decimal(sample.t));
    REQUIRE(times.size() > 2);
    const State start = examples::state_of<State>(known.samples[0].state);
    const auto run = integrate(model, start, {times.front(), times.back()}, Dop853{.tolerance = 1e-13}, {.at = times});
    REQUIRE(run.status() == Status::ok);
    for (std::size_t k = 0; k < times.size(); ++k) {
        const State expected = examples::state_of<State>(known.samples[k].state);
        CHECK(examples::relative_error(run.states[k], expected) < 1e-11);
        const auto controls = model.controls(times[k], expected);
        for (std::size_t A = 0; A < known.controls.size(); ++A) {
            const double u = examples::decimal(known.samples[k].controls[A]);
            CHECK(std::abs(controls[static_cast<Eigen::Index>(A)] - u) <= 1e-13 * std::max(1.0, std::abs(u)));
        }
        CHECK(std::abs(model.hamiltonian(times[k], expected) - examples::decimal(known.hamiltonian)) < 1e-11);
    }
}

} // namespace

TEST_CASE("extremals follow the reference to the end that belongs to their costate")
{
    follow_extremal<models::attitude_pontryagin<double>>("attitude_full");
    follow_extremal<models::pointing_pontryagin<double>>("attitude_reduced");
    follow_extremal<models::unicycle_pontryagin<double>>("unicycle");
    follow_extremal<models::heisenberg_control_pontryagin<double>>("heisenberg");
    follow_extremal<models::half_plane_control_pontryagin<double>>("half_plane_control");
    follow_extremal<models::double_integrator_pontryagin<double>>("double_integrator");
}

TEST_CASE("with a bounded force the double integrator reaches its end from the costate in closed form")
{
    using Cart = models::double_integrator_pontryagin<double>;
    Cart cart;
    cart.parameters.u_max = 5;
    const double s = std::sqrt(0.15); // half of the time that the force takes from bound to bound
    Cart::State start;
    start << 0, 0, 5 / s, 2.5 / s;
    const std::vector<double> times = {0.0, 0.05, 0.5, 1.0};
    const auto run = integrate(cart, start, {0.0, 1.0}, Dop853{.tolerance = 1e-12}, {.at = times});
    REQUIRE(run.status() == Status::ok);
    CHECK(cart.controls(0.05, run.states[1])[0] == 5);
    CHECK(std::abs(run.states[1][0] - 5 * 0.05 * 0.05 / 2) < 1e-12);
    CHECK(std::abs(run.states[2][0] - 0.5) < 1e-9);
    CHECK(std::abs(run.states[3][0] - 1) < 1e-9);
    CHECK(std::abs(run.states[3][1]) < 1e-9);
    CHECK(cart.controls(1.0, run.states[3])[0] == -5);
}
