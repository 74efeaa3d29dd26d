// SPDX-License-Identifier: GPL-2.0-or-later
/// The intervals of linear stability of every method and scheme. scripts/stability-table writes this file:
/// tests/stability computes them exactly, from the coefficients that the runtime steps with, and rounds once.
#pragma once

#include "scene/linear_limits.hpp"

#include <array>

namespace lagen {

inline constexpr std::array linear_limits{
    LinearLimits{"Euler", 0, 2, 1, false, false},
    LinearLimits{"Midpoint", 0, 2, 2, false, false},
    LinearLimits{"Heun", 0, 2, 2, false, false},
    LinearLimits{"Ralston", 0, 2, 2, false, false},
    LinearLimits{"Kutta3", 1.7320508075688772, 2.5127453266183286, 3, false, false},
    LinearLimits{"Rk4", 2.82842712474619, 2.7852935634052813, 4, false, false},
    LinearLimits{"Rk38", 2.82842712474619, 2.7852935634052813, 4, false, false},
    LinearLimits{"Dopri5", 0.9971890086325299, 3.306567892634946, 6, false, false},
    LinearLimits{"Tsit5", 0.4779788688827525, 3.506846993804929, 6, false, false},
    LinearLimits{"Dop853", 5.960359811702779, 6.393651522851065, 12, false, false},
    LinearLimits{"Verner65", 2.5841995676074587, 4.855274314489582, 8, false, false},
    LinearLimits{"Verner76", 0, 4.640024335337547, 10, false, false},
    LinearLimits{"Verner87", 0, 5.864113239352325, 13, false, false},
    LinearLimits{"Verner98", 2.7569651249245197, 4.47617272256191, 16, false, false},
    LinearLimits{"Rkn64", 0, std::nullopt, 5, false, false},
    LinearLimits{"Rkn86", 3.1402541625390064, std::nullopt, 8, false, false},
    LinearLimits{"Rkn1210", 3.1415925817546397, std::nullopt, 17, false, false},
    LinearLimits{"Rkng54", 2.405321021621443e-20, 3.354298623976591, 6, false, false},
    LinearLimits{"Gauss2", no_limit, no_limit, 0, true, false},
    LinearLimits{"Gauss4", no_limit, no_limit, 0, true, false},
    LinearLimits{"Gauss6", no_limit, no_limit, 0, true, false},
    LinearLimits{"Gauss8", no_limit, no_limit, 0, true, false},
    LinearLimits{"Gauss12", no_limit, no_limit, 0, true, false},
    LinearLimits{"Gauss16", no_limit, no_limit, 0, true, false},
    LinearLimits{"Radau5", no_limit, no_limit, 0, true, true},
    LinearLimits{"Radau3Fixed", no_limit, no_limit, 0, true, true},
    LinearLimits{"Radau5Fixed", no_limit, no_limit, 0, true, true},
    LinearLimits{"LeapfrogDkd", 2, std::nullopt, 1, false, false},
    LinearLimits{"LeapfrogKdk", 2, std::nullopt, 1, false, false},
    LinearLimits{"McLachlan4", 3.0389488778951153, std::nullopt, 4, false, false},
    LinearLimits{"BlanesMoan4", 3.1328233983908746, std::nullopt, 6, false, false},
    LinearLimits{"Srkn4", 3.1634650665581847, std::nullopt, 6, false, false},
    LinearLimits{"Yoshida6", 2.269057996397659, std::nullopt, 7, false, false},
    LinearLimits{"BlanesMoan6", 3.1342475220889936, std::nullopt, 10, false, false},
    LinearLimits{"Srkn6", 3.140925082605238, std::nullopt, 14, false, false},
    LinearLimits{"KahanLi8", 3.0964386800007317, std::nullopt, 17, false, false},
    LinearLimits{"Sofroniou10", 3.141081862896623, std::nullopt, 35, false, false},
    LinearLimits{"taylor:4", 2.82842712474619, 2.7852935634052813, 0, false, false},
    LinearLimits{"taylor:10", 0, 5.069518410986888, 0, false, false},
    LinearLimits{"taylor:20", 3.2903095150035693, 8.821432632618247, 0, false, false},
    LinearLimits{"taylor:30", 0, 12.551728180588768, 0, false, false},
    LinearLimits{"midpoint", no_limit, std::nullopt, 0, false, false},
    LinearLimits{"left", 2, std::nullopt, 0, false, false},
    LinearLimits{"trapezoidal", 2, std::nullopt, 0, false, false},
    LinearLimits{"gauss:1", no_limit, std::nullopt, 0, false, false},
    LinearLimits{"gauss:2", no_limit, std::nullopt, 0, false, false},
    LinearLimits{"gauss:3", no_limit, std::nullopt, 0, false, false},
    LinearLimits{"gauss:4", no_limit, std::nullopt, 0, false, false},
    LinearLimits{"lobatto:2", 2, std::nullopt, 0, false, false},
    LinearLimits{"lobatto:3", 2.82842712474619, std::nullopt, 0, false, false},
    LinearLimits{"lobatto:4", 3.112717648164217, std::nullopt, 0, false, false},
    LinearLimits{"lobatto:5", 3.1404451008309424, std::nullopt, 0, false, false},
};

} // namespace lagen
