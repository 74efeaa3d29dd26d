// SPDX-License-Identifier: GPL-2.0-or-later
/// A generated right-hand side beside the hand-written one, each called through a function that is not inlined and
/// inlined into RK4. Compiled by scripts/benchmark with -D MODEL=heavy_top and both folders on the include path.
///   pair compare          the largest difference, relative to the largest entry
///   pair count KIND N     N right-hand sides of one KIND (called_generated, called_handwritten, rk4_generated,
///                         rk4_handwritten) inside a function of that name, for callgrind
///   pair time             ns a right-hand side of each kind: least of interleaved rounds
#include "model_header.hpp"

#include MODEL_HEADER_IN(generated, MODEL)
#include MODEL_HEADER_IN(handwritten, MODEL)

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

using Generated = lagen::models::MODEL<double>;
using Handwritten = handwritten::MODEL;
using State = Handwritten::State;
static_assert(Generated::dimension == Handwritten::dimension);

/// Makes the compiler believe that `value` is read and written here.
template <class T>
void escape(T& value)
{
    asm volatile("" : : "g"(&value) : "memory");
}

/// n steps of the classical method of order 4; the right-hand side is inlined four times.
template <class M>
[[gnu::always_inline]] inline void rk4(const M& model, State& s, double h, long steps)
{
    State k1, k2, k3, k4, x;
    for (long k = 0; k < steps; ++k) {
        const double t = h * static_cast<double>(k);
        (void)model.rhs(t, s, k1);
        x = s + h / 2 * k1;
        (void)model.rhs(t + h / 2, x, k2);
        x = s + h / 2 * k2;
        (void)model.rhs(t + h / 2, x, k3);
        x = s + h * k3;
        (void)model.rhs(t + h, x, k4);
        s += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
}

} // namespace

// Names that callgrind finds.
extern "C" {
[[gnu::noinline]] lagen::Status called_generated(const Generated& model, const State& s, State& ds)
{
    return model.rhs(0, s, ds);
}
[[gnu::noinline]] lagen::Status called_handwritten(const Handwritten& model, const State& s, State& ds)
{
    return model.rhs(0, s, ds);
}
[[gnu::noinline]] void rk4_generated(const Generated& model, State& s, double h, long steps)
{
    rk4(model, s, h, steps);
}
[[gnu::noinline]] void rk4_handwritten(const Handwritten& model, State& s, double h, long steps)
{
    rk4(model, s, h, steps);
}
}

namespace {

/// A start that no symmetry makes special.
State start()
{
    State s;
    for (int k = 0; k < State::RowsAtCompileTime; ++k) s[k] = 0.3 + 0.17 * k;
    return s;
}

constexpr std::array kinds{"called_generated", "called_handwritten", "rk4_generated", "rk4_handwritten"};

/// `count` right-hand sides (a multiple of 4) of one kind.
void work(std::size_t kind, const Generated& generated, const Handwritten& handwritten, long count)
{
    State s = start();
    State ds = s;
    if (kind == 0)
        for (long k = 0; k < count; ++k) escape(s), (void)called_generated(generated, s, ds), escape(ds);
    if (kind == 1)
        for (long k = 0; k < count; ++k) escape(s), (void)called_handwritten(handwritten, s, ds), escape(ds);
    if (kind == 2) rk4_generated(generated, s, 1e-4, count / 4);
    if (kind == 3) rk4_handwritten(handwritten, s, 1e-4, count / 4);
    escape(s);
}

double nanoseconds(std::size_t kind, const Generated& generated, const Handwritten& handwritten)
{
    constexpr long count = 40000;
    const auto begin = std::chrono::steady_clock::now();
    work(kind, generated, handwritten, count);
    const std::chrono::duration<double, std::nano> taken = std::chrono::steady_clock::now() - begin;
    return taken.count() / static_cast<double>(count);
}

int compare(const Generated& generated, const Handwritten& handwritten)
{
    const State s = start();
    State a, b;
    (void)generated.rhs(0, s, a);
    (void)handwritten.rhs(0, s, b);
    const double error = (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
    std::printf("%.2g\n", error);
    return error < 1e-13 ? 0 : 1;
}

} // namespace

int main(int argc, char** argv)
{
    Generated generated;
    Handwritten handwritten;
    escape(generated);
    escape(handwritten);
    if (argc == 2 && std::strcmp(argv[1], "compare") == 0) return compare(generated, handwritten);
    if (argc == 4 && std::strcmp(argv[1], "count") == 0) {
        for (std::size_t kind = 0; kind < kinds.size(); ++kind)
            if (std::strcmp(argv[2], kinds[kind]) == 0) work(kind, generated, handwritten, std::atol(argv[3]));
        return 0;
    }
    std::array<double, kinds.size()> best{};
    best.fill(1e9);
    for (int round = 0; round < 40; ++round)
        for (std::size_t kind = 0; kind < kinds.size(); ++kind)
            best[kind] = std::min(best[kind], nanoseconds(kind, generated, handwritten));
    for (const double value : best) std::printf("%.2f ", value);
    std::printf("\n");
    return 0;
}
