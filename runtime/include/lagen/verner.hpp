// SPDX-License-Identifier: MIT
/// `lagen::Verner98{.tolerance = 1e-12}`: Verner's "most efficient" pairs 6(5), 7(6), 8(7) and 9(8) with his
/// interpolants [Numerical Algorithms 53 (2010) 383]; the sources of each are in its table of coefficients.
///             calls a step   and where a value inside it is asked for   order of that value
///   Verner65        8                         1                                 5
///   Verner76       10                         2                                 6
///   Verner87       13                         3                                 7
///   Verner98       16                         4                                 8
/// Of his two interpolants these are the ones of lower order: inside a step their error is about what the embedded
/// formula estimates (Kepler's problem: 0.04 to 2 times it), which is what the tolerance speaks of. Those of full order
/// take two to three times as many calls.
/// Classical step control with safety 0.8, as Dop853: over Kepler's problem, Henon-Heiles, a pendulum near its
/// separatrix and a forced elastic pendulum equal errors cost 4 to 12 % less than with 0.9 and beta = 0.04, which fewer
/// steps reject. The coefficients have 40 digits: `__float128` and wider scalars get the accuracy that they ask for.
#pragma once

#include "lagen/integrate/embedded.hpp"
#include "lagen/integrate/verner65_coefficients.hpp"
#include "lagen/integrate/verner76_coefficients.hpp"
#include "lagen/integrate/verner87_coefficients.hpp"
#include "lagen/integrate/verner98_coefficients.hpp"
#include "lagen/run.hpp"

namespace lagen {

template <class Tableau>
struct VernerFamily {
    static constexpr StepControl defaults{.safety = 0.8, .beta = 0};
    template <class M>
    using Stepper = EmbeddedStepper<Tableau, M>;
};

using Verner65 = AdaptiveMethod<VernerFamily<tableau::Verner65>>;
using Verner76 = AdaptiveMethod<VernerFamily<tableau::Verner76>>;
using Verner87 = AdaptiveMethod<VernerFamily<tableau::Verner87>>;
using Verner98 = AdaptiveMethod<VernerFamily<tableau::Verner98>>;

} // namespace lagen
