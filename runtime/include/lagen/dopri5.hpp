// SPDX-License-Identifier: MIT
/// `lagen::Dopri5{.tolerance = 1e-8}`: the pair 5(4) of Dormand and Prince [J. Comput. Appl. Math. 6 (1980) 19], with
/// the dense output of order 4 of Hairer's dopri5.f (Shampine's).
#pragma once

#include "lagen/integrate/embedded.hpp"
#include "lagen/run.hpp"

namespace lagen {

namespace tableau {

struct Dopri5 {
    static constexpr std::size_t stages = 7, dense_stages = 7, end = 6;
    static constexpr int order = 5, embedded_order = 4, dense_order = 4;
    // clang-format off
    static constexpr std::array<Fraction, 21> a{{
        {1, 5},
        {3, 40}, {9, 40},
        {44, 45}, {-56, 15}, {32, 9},
        {19372, 6561}, {-25360, 2187}, {64448, 6561}, {-212, 729},
        {9017, 3168}, {-355, 33}, {46732, 5247}, {49, 176}, {-5103, 18656},
        {35, 384}, {0, 1}, {500, 1113}, {125, 192}, {-2187, 6784}, {11, 84},
    }};
    static constexpr std::array<Fraction, 7> b{{{35, 384}, {0, 1}, {500, 1113}, {125, 192}, {-2187, 6784}, {11, 84}, {0, 1}}};
    static constexpr std::array<Fraction, 7> c{{{0, 1}, {1, 5}, {3, 10}, {4, 5}, {8, 9}, {1, 1}, {1, 1}}};
    static constexpr std::array<Fraction, 7> error{{
        {71, 57600}, {0, 1}, {-71, 16695}, {71, 1920}, {-17253, 339200}, {22, 525}, {-1, 40}}};
    static constexpr std::array<Fraction, 7> d{{
        {-12715105075, 11282082432}, {0, 1}, {87487479700, 32700410799}, {-10690763975, 1880347072},
        {701980252875, 199316789632}, {-1453857185, 822651844}, {69997945, 29380423}}};
    // clang-format on

    /// w = theta (b + (1 - theta) ((e_1 - b) + theta ((2 b - e_1 - e_7) + (1 - theta) d))), e_k the k-th unit vector.
    template <class Real>
    static void dense(Real theta, std::array<Real, stages>& weights) noexcept
    {
        const Real rest = Real(1) - theta;
        for (std::size_t i = 0; i < stages; ++i) {
            const Real bi = b[i].template as<Real>();
            const Real first = i == 0 ? Real(1) : Real(0);
            const Real last = i == stages - 1 ? Real(1) : Real(0);
            const Real inner = (Real(2) * bi - first - last) + rest * d[i].template as<Real>();
            weights[i] = theta * (bi + rest * ((first - bi) + theta * inner));
        }
    }
};

} // namespace tableau

/// Order 5(4); Hairer's controller with beta = 0.04.
struct Dopri5Family {
    static constexpr StepControl defaults{};
    template <class M>
    using Stepper = EmbeddedStepper<tableau::Dopri5, M>;
};

using Dopri5 = AdaptiveMethod<Dopri5Family>;

} // namespace lagen
