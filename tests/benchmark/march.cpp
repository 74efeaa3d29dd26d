// SPDX-License-Identifier: GPL-2.0-or-later
/// What a step costs: `integrate` beside plain loops of the same methods (tests/benchmark/plain), on generated models.
/// Compiled by scripts/march-table with -D MODEL=heavy_top, -D METHOD=Rk4 and, for the plain loop, -D PLAIN, so that a
/// program holds one loop alone and the compiler inlines what it would inline in a user's program.
///   march N        about N steps inside a function `marched`, for callgrind; prints accepted and rejected steps, calls
///   of
///                  the right-hand side, Newton iterations and the end
///   march N rhs    N right-hand sides, of Taylor's method N series, inside a function `marched_calls`
#include "model_header.hpp"

#include "plain/dop853.hpp"
#include "plain/gauss4.hpp"
#include "plain/rk4.hpp"
#include "plain/rkn86.hpp"
#include "plain/taylor.hpp"

#include MODEL_HEADER(MODEL)

#include "lagen/integrate.hpp"

#include <cstdio>
#include <cstdlib>

namespace {

using Model = lagen::models::MODEL<double>;
using State = Model::State;

constexpr double fixed_step = 1.0 / 128, tolerance = 1e-10;

struct Cost {
    std::size_t accepted = 0, rejected = 0, calls = 0, iterations = 0;
};

template <class M>
Cost cost_of(const lagen::Run<M>& run)
{
    return {run.steps, run.rejected, run.rhs_calls, run.newton_iterations};
}

struct Rk4 {
    [[maybe_unused]] static constexpr double length = fixed_step;
    static Cost by_lagen(const Model& model, State& s, double end)
    {
        const auto run = lagen::integrate(model, s, {0.0, end}, lagen::Rk4{.step = fixed_step});
        s = run.state;
        return cost_of(run);
    }
    static Cost by_loop(const Model& model, State& s, double end)
    {
        const long n = static_cast<long>(end / fixed_step);
        plain::rk4(model, s, fixed_step, n);
        const auto steps = static_cast<std::size_t>(n);
        return {steps, 0, 4 * steps, 0};
    }
};

struct Dop853 {
    [[maybe_unused]] static constexpr double length = 0.3; // about
    static Cost by_lagen(const Model& model, State& s, double end)
    {
        const auto run =
            lagen::integrate(model, s, {0.0, end}, lagen::Dop853{.tolerance = tolerance, .first_step = 0.1});
        s = run.state;
        return cost_of(run);
    }
    static Cost by_loop(const Model& model, State& s, double end)
    {
        plain::Dop853<Model> method;
        const plain::Steps steps = method.run(model, s, end, 0.1, tolerance);
        const auto accepted = static_cast<std::size_t>(steps.accepted);
        const auto rejected = static_cast<std::size_t>(steps.rejected);
        return {accepted, rejected, 1 + 12 * accepted + 11 * rejected, 0};
    }
};

/// Of models x'' = f(t, x) alone.
struct Rkn86 {
    [[maybe_unused]] static constexpr double length = 0.3; // about
    template <class M>
    static Cost by_lagen(const M& model, State& s, double end)
    {
        const auto run =
            lagen::integrate(model, s, {0.0, end}, lagen::Rkn86{.tolerance = tolerance, .first_step = 0.1});
        s = run.state;
        return cost_of(run);
    }
    template <class M>
    static Cost by_loop(const M& model, State& s, double end)
    {
        plain::Rkn86<M> method;
        const plain::Steps steps = method.run(model, s, end, 0.1, tolerance);
        const auto accepted = static_cast<std::size_t>(steps.accepted);
        const auto rejected = static_cast<std::size_t>(steps.rejected);
        return {accepted, rejected, 1 + 8 * (accepted + rejected), 0};
    }
};

/// Without a plain loop: beside Dop853 it shows what a stage costs.
struct Verner98 {
    [[maybe_unused]] static constexpr double length = 0.3; // about
    static Cost by_lagen(const Model& model, State& s, double end)
    {
        const auto run =
            lagen::integrate(model, s, {0.0, end}, lagen::Verner98{.tolerance = tolerance, .first_step = 0.1});
        s = run.state;
        return cost_of(run);
    }
    static Cost by_loop(const Model& model, State& s, double end) { return Dop853::by_loop(model, s, end); }
};

struct Gauss4 {
    [[maybe_unused]] static constexpr double length = fixed_step;
    static Cost by_lagen(const Model& model, State& s, double end)
    {
        const auto run = lagen::integrate(model, s, {0.0, end}, lagen::Gauss4{.step = fixed_step});
        s = run.state;
        return cost_of(run);
    }
    static Cost by_loop(const Model& model, State& s, double end)
    {
        const long n = static_cast<long>(end / fixed_step);
        plain::Gauss4<Model> method;
        method.run(model, s, fixed_step, n);
        const auto iterations = static_cast<std::size_t>(method.iterations);
        return {static_cast<std::size_t>(n), 0, 2 * iterations, iterations};
    }
};

/// Of headers with the kernel `taylor`. A call is a series.
struct Taylor {
    [[maybe_unused]] static constexpr double length = 0.5; // about
    static constexpr int order = 20;
    template <class M>
    static Cost by_lagen(const M& model, State& s, double end)
    {
        const auto run = lagen::integrate(model, s, {0.0, end},
                                          lagen::Taylor{.tolerance = 1e-12, .first_step = 0.1, .order = order});
        s = run.state;
        return cost_of(run);
    }
    template <class M>
    static Cost by_loop(const M& model, State& s, double end)
    {
        plain::Taylor<M, order> method;
        const auto steps = static_cast<std::size_t>(method.run(model, s, end, 1e-12));
        return {steps, 0, steps, 0};
    }
    template <class M>
    static void call(const M& model, const State& s)
    {
        lagen::TaylorSeries<double, M::dimension, order> x;
        (void)model.taylor(0, s, order, x);
        asm volatile("" : : "g"(&s), "g"(&x) : "memory");
    }
};

// Names that callgrind finds.
[[gnu::noinline]] Cost marched(const Model& model, State& s, double end)
{
#ifdef PLAIN
    return METHOD::by_loop(model, s, end);
#else
    return METHOD::by_lagen(model, s, end);
#endif
}

/// Of the right-hand side, or of the series of a method that has a call of its own.
template <class Method>
void call(const Model& model, const State& s, State& ds)
{
    if constexpr (requires { Method::call(model, s); }) {
        Method::call(model, s);
    } else {
        (void)model.rhs(0, s, ds);
        asm volatile("" : : "g"(&s), "g"(&ds) : "memory");
    }
}

[[gnu::noinline]] void marched_calls(const Model& model, State& s, long n)
{
    State ds;
    for (long k = 0; k < n; ++k) call<METHOD>(model, s, ds);
}

} // namespace

int main(int argc, char** argv)
{
    if (argc < 2) return 4;
    const long steps = std::atol(argv[1]);
    const Model model;
    State s;
    for (int i = 0; i < Model::dimension; ++i) s[i] = 1.0 / (i + 1); // a start of no symmetry
    if (argc > 2) {
        marched_calls(model, s, steps);
        std::printf("%ld 0 0 0\n", steps);
        return 0;
    }
    const Cost cost = marched(model, s, METHOD::length * static_cast<double>(steps));
    std::printf("%zu %zu %zu %zu", cost.accepted, cost.rejected, cost.calls, cost.iterations);
    for (int i = 0; i < Model::dimension; ++i) std::printf(" %.17g", s[i]);
    std::printf("\n");
}
