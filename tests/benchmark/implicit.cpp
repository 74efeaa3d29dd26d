// SPDX-License-Identifier: GPL-2.0-or-later
/// What the implicit methods do, in tables: orders, order reduction, a long run of a rigid body, van der Pol's equation
/// beside radau5.f, steps that are too long. Compiled by scripts/implicit-table; the argument is the number of steps of
/// the long runs. Answers 1 where a run that failed has changed the state of its last good step.
#include "lagen/lagen.hpp"
#include "lagen/print_status.hpp"
#include "support/problems.hpp"

#include "rigid_body.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

using namespace lagen;

namespace {

constexpr std::array fixed_names{"Gauss2", "Gauss4", "Gauss6", "Gauss8", "Radau3Fixed", "Radau5Fixed"};

/// error(method) for every method of fixed step, in the order of fixed_names.
template <class Error>
std::array<long double, fixed_names.size()> of_every_method(double step, const Error& error)
{
    return {error(Gauss2{.step = step}), error(Gauss4{.step = step}),      error(Gauss6{.step = step}),
            error(Gauss8{.step = step}), error(Radau3Fixed{.step = step}), error(Radau5Fixed{.step = step})};
}

/// Errors after `coarsest` 2^k steps over `length`, and the order between each two lines.
template <class Error>
void table_of_orders(double length, int coarsest, const Error& error)
{
    std::printf("%6s", "steps");
    for (const char* name : fixed_names) std::printf("  %-13s", name);
    std::printf("\n");
    std::array<long double, fixed_names.size()> before{};
    for (int k = 0; k < 5; ++k) {
        std::printf("%6d", coarsest << k);
        const auto now = of_every_method(length / (coarsest << k), error);
        for (std::size_t m = 0; m < now.size(); ++m) {
            std::printf("  %.2Le", now[m]);
            if (k == 0 || now[m] < 1e-17L) // rounding errors have no order
                std::printf(" %4s", "");
            else
                std::printf(" %4.2Lf", std::log2(before[m] / now[m]));
        }
        before = now;
        std::printf("\n");
    }
}

void orders()
{
    std::printf(
        "\nOrders: Kepler's problem, eccentricity 0.3, from t = 0.5 to 4.5 in long double; |error| at the end and "
        "the\norder between two lines.\n");
    using Kepler = problems::Kepler<long double>;
    table_of_orders(4, 16, [](const auto& method) {
        const auto run = integrate(Kepler{}, Kepler::exact(0.3L, 0.5L), {0.5L, 4.5L}, method);
        return (run.state - Kepler::exact(0.3L, 4.5L)).norm();
    });
}

void order_reduction()
{
    std::printf("\nOrder reduction: y' = -10^6 (y - sin(t + 1/4)) + cos(t + 1/4) [Prothero, Robinson], from 0 to 1 in "
                "long double.\n");
    using Problem = problems::ProtheroRobinson<long double>;
    table_of_orders(1, 8, [](const auto& method) {
        const auto run = integrate(Problem{}, Problem::State(Problem::exact(0)), {0.0L, 1.0L}, method);
        return std::abs(run.state[0] - Problem::exact(1));
    });
}

/// Energy and Casimir of the same body with more digits than they are looked at.
class Kept {
  public:
    using Body = models::rigid_body<double>;
    explicit Kept(const Body& body)
    {
        for (std::size_t k = 0; k < Body::parameter_names.size(); ++k) {
            Body copy = body;
            wide_.parameter(k) = copy.parameter(k);
        }
    }
    [[nodiscard]] std::array<long double, 2> at(const Body::State& s) const
    {
        const models::rigid_body<long double>::State wide = s.cast<long double>();
        return {wide_.energy(0, wide), wide_.invariants(0, wide)[0]};
    }

  private:
    models::rigid_body<long double> wide_;
};

template <class Method>
void long_run(const char* name, const Method& method, std::size_t steps)
{
    using Body = Kept::Body;
    const Body body;
    const Kept kept(body);
    const Body::State start(-1.5, 0.5, 0.35);
    const auto begin = kept.at(start);
    std::array<long double, 2> largest{}, last{};
    const auto watch = [&](double, const Body::State& s) {
        const auto now = kept.at(s);
        for (std::size_t k = 0; k < 2; ++k) {
            last[k] = std::abs(now[k] / begin[k] - 1) / std::numeric_limits<double>::epsilon();
            largest[k] = std::max(largest[k], last[k]);
        }
    };
    const auto run = integrate(body, start, {0.0, method.step * static_cast<double>(steps)}, method, {}, watch);
    const auto done = static_cast<double>(run.steps);
    std::printf("%-12s  %4g  %9.4Lg %9.4Lg  %9.4Lg %9.4Lg  %10.2f %10.4f  %8zu  %s\n", name, method.step, largest[0],
                last[0], largest[1], last[1], static_cast<double>(run.newton_iterations) / done,
                static_cast<double>(run.decompositions) / done, run.steps, to_text(run.status()));
}

void long_runs(std::size_t steps)
{
    std::printf(
        "\nLong runs: the rigid body of models/rigid_body.toml, scene default, %zu steps; relative drift in units "
        "of epsilon\n= 2.2e-16, Newton iterations and factorisations a step, steps done.\n",
        steps);
    std::printf("%-12s  %4s  %9s %9s  %9s %9s  %10s %10s  %8s  %s\n", "method", "step", "energy:", "", "Casimir:", "",
                "iterations", "factoris.", "steps", "status");
    std::printf("%-12s  %4s  %9s %9s  %9s %9s\n", "", "", "largest", "final", "largest", "final");
    for (const double step : {0.1, 0.4}) {
        long_run("Gauss2", Gauss2{.step = step}, steps);
        long_run("Gauss4", Gauss4{.step = step}, steps);
        long_run("Gauss6", Gauss6{.step = step}, steps);
        long_run("Gauss8", Gauss8{.step = step}, steps);
        // What is not compensated, and what is not symplectic, for comparison.
        long_run("Gauss4 plain", Gauss4{.step = step, .compensated = false}, steps);
        long_run("Radau5Fixed", Radau5Fixed{.step = step}, steps);
    }
}

void van_der_pol()
{
    using Problem = problems::VanDerPol<double>;
    const Radau5 method{.tolerance = 1e-4, .first_step = 1e-6};
    const auto run = integrate(Problem{}, Problem::State(2, -0.6), {0.0, 2.0}, method);
    std::printf("\nVan der Pol: epsilon = 10^-6, from (2, -0.6) to t = 2 with Radau5, tolerance 1e-4, first step 1e-6, "
                "beside\nwhat Hairer's radau5.f prints; rejected by the error or by Newton's method.\n");
    std::printf("%-10s %6s %9s %9s %6s %11s %10s  %-18s %s\n", "", "steps", "accepted", "rejected", "calls",
                "iterations", "factoris.", "x(2)", "y(2)");
    std::printf("%-10s %6zu %9zu %9zu %6zu %11zu %10zu  %.15f %.16f\n", "Radau5", run.steps + run.rejected, run.steps,
                run.rejected, run.rhs_calls, run.newton_iterations, run.decompositions, run.state[0], run.state[1]);
    std::printf("%-10s %6d %9d %9d %6d %11d %10d  %s %s\n", "radau5.f", 280, 242, 38, 2248, 668, 253,
                "1.706163410178079", "-0.8927971289301175");

    std::printf("From (2, 0), against a reference of 22 digits:\n");
    std::printf("%-10s %6s %9s %9s %6s %11s %10s  %s\n", "tolerance", "steps", "accepted", "rejected", "calls",
                "iterations", "factoris.", "|error|");
    const Problem::State reference(1.706167732170465008655, -0.892809701024816549863);
    for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
        const auto each = integrate(Problem{}, Problem::State(2, 0), {0.0, 2.0}, Radau5{.tolerance = tolerance});
        std::printf("%-10g %6zu %9zu %9zu %6zu %11zu %10zu  %.1e\n", tolerance, each.steps + each.rejected, each.steps,
                    each.rejected, each.rhs_calls, each.newton_iterations, each.decompositions,
                    (each.state - reference).norm());
    }
}

/// Is the state that of a run which ends after the last good step?
template <class Model, class Method>
bool failure(const char* problem, const char* name, const Model& model, const typename Model::State& start, double end,
             const Method& method)
{
    const auto run = integrate(model, start, {0.0, end}, method);
    const auto before = integrate(model, start, {0.0, end}, method, {.max_steps = run.steps});
    const bool kept = run.t == before.t && run.state == before.state;
    std::printf("%-20s %-11s %6g  %-16s %6zu %8g %10g  %s\n", problem, name, method.step, to_text(run.status()),
                run.steps, run.t, run.failed_at, kept ? "yes" : "NO");
    return kept;
}

bool failures()
{
    std::printf(
        "\nSteps that are far too long: the status, the steps done before, the time of the state and the end of "
        "the step\nthat failed; is the state the one before that step?\n");
    std::printf("%-20s %-11s %6s  %-16s %6s %8s %10s  %s\n", "problem", "method", "step", "status", "steps", "t",
                "failed_at", "kept");
    using Kepler = problems::Kepler<double>;
    using VanDerPol = problems::VanDerPol<double>;
    using Body = models::rigid_body<double>;
    const Kepler::State comet(1.9, 0, 0, std::sqrt(0.1 / 1.9));
    bool kept = failure("Kepler, e = 0.9", "Gauss4", Kepler{}, comet, 20, Gauss4{.step = 0.4});
    kept = failure("Kepler, e = 0.9", "Gauss8", Kepler{}, comet, 20, Gauss8{.step = 0.4}) && kept;
    kept = failure("Kepler, e = 0.9", "Radau5Fixed", Kepler{}, comet, 20, Radau5Fixed{.step = 0.4}) && kept;
    const VanDerPol::State slow(2, -0.66);
    kept = failure("van der Pol", "Gauss6", VanDerPol{}, slow, 2, Gauss6{.step = 0.1}) && kept;
    kept = failure("van der Pol", "Radau5Fixed", VanDerPol{}, slow, 2, Radau5Fixed{.step = 0.1}) && kept;
    const Body::State turning(-1.5, 0.5, 0.35);
    kept = failure("rigid body", "Gauss2", Body{}, turning, 1000, Gauss2{.step = 50}) && kept;
    kept = failure("rigid body", "Gauss6", Body{}, turning, 1000, Gauss6{.step = 50}) && kept;
    kept = failure("rigid body", "Gauss8", Body{}, turning, 1000, Gauss8{.step = 50}) && kept;
    kept = failure("rigid body", "Radau5Fixed", Body{}, turning, 1000, Radau5Fixed{.step = 50}) && kept;
    return kept;
}

} // namespace

int main(int argc, char** argv)
{
    const long steps = argc > 1 ? std::atol(argv[1]) : 1'000'000;
    if (steps < 1) {
        std::fprintf(stderr, "implicit: '%s' is no number of steps\n", argv[1]);
        return 4;
    }
    orders();
    order_reduction();
    long_runs(static_cast<std::size_t>(steps));
    van_der_pol();
    return failures() ? 0 : 1;
}
