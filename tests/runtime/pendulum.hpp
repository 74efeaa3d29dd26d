// SPDX-License-Identifier: GPL-2.0-or-later
/// The pendulum in double, whose runs by each method are compiled once for all files of this room: pendulum.cpp.
#pragma once

#include "lagen/integrate.hpp"
#include "support/problems.hpp"

#define LAGEN_PENDULUM_RUN(linkage, Method)                                                                            \
    linkage template lagen::Run<lagen::problems::Pendulum<double>> lagen::integrate(                                   \
        const lagen::problems::Pendulum<double>&, const lagen::problems::Pendulum<double>::State&,                     \
        lagen::Interval<double>, const lagen::Method&);                                                                \
    linkage template lagen::Run<lagen::problems::Pendulum<double>> lagen::integrate(                                   \
        const lagen::problems::Pendulum<double>&, const lagen::problems::Pendulum<double>::State&,                     \
        lagen::Interval<double>, const lagen::Method&, const lagen::Options<lagen::problems::Pendulum<double>>&);

#define LAGEN_PENDULUM_RUNS(linkage)                                                                                   \
    LAGEN_PENDULUM_RUN(linkage, Euler)                                                                                 \
    LAGEN_PENDULUM_RUN(linkage, Midpoint)                                                                              \
    LAGEN_PENDULUM_RUN(linkage, Rk4)                                                                                   \
    LAGEN_PENDULUM_RUN(linkage, LeapfrogDkd)                                                                           \
    LAGEN_PENDULUM_RUN(linkage, Yoshida6)                                                                              \
    LAGEN_PENDULUM_RUN(linkage, Dopri5)                                                                                \
    LAGEN_PENDULUM_RUN(linkage, Tsit5)                                                                                 \
    LAGEN_PENDULUM_RUN(linkage, Dop853)                                                                                \
    LAGEN_PENDULUM_RUN(linkage, Gauss2)                                                                                \
    LAGEN_PENDULUM_RUN(linkage, Gauss4)                                                                                \
    LAGEN_PENDULUM_RUN(linkage, Gauss6)                                                                                \
    LAGEN_PENDULUM_RUN(linkage, Gauss8)                                                                                \
    LAGEN_PENDULUM_RUN(linkage, Radau3Fixed)                                                                           \
    LAGEN_PENDULUM_RUN(linkage, Radau5Fixed)                                                                           \
    LAGEN_PENDULUM_RUN(linkage, Radau5)

LAGEN_PENDULUM_RUNS(extern)
