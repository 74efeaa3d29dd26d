// SPDX-License-Identifier: GPL-2.0-or-later
/// The integrators that `run` knows, as the runtime's headers define them.
#pragma once

#include "graph/kernel.hpp"

#include <span>
#include <string>

namespace lagen {

/// The method of a motion in continuous time where neither its scene nor the command line says one.
inline constexpr const char* standard_method = "dop853";

/// How a method steps.
enum class MethodKind {
    explicit_stages,
    implicit_stages,
    series,    ///< needs the kernels of Taylor coefficients
    splitting, ///< for xdot = f(y), ydot = g(x), or a sum of exact flows
    group,     ///< along the orbits of a group that moves lanes of the state
    poisson,   ///< for Lie-Poisson systems, all lanes of which a group moves
    discrete,  ///< of discrete Lagrangians alone, which take no other one
};

struct MethodEntry {
    const char* name;  ///< as in scenes and --method
    const char* type;  ///< the runtime's type
    const char* order; ///< "5(4)"
    bool adaptive;     ///< takes a tolerance; else a step (of a discrete Lagrangian its own)
    MethodKind kind;
    const char* text;                                 ///< one line, with the source
    const char* keeps = "";                           ///< what long runs keep
    SecondOrder::Kind system = SecondOrder::Kind::no; ///< for x'' = f(t, x, x') or f(t, x) only
    bool affine = false;                              ///< of splittings: xdot has to be affine in y
    bool symmetric = true;                            ///< of splittings: a step back undoes one
    const char* scheme = "";                          ///< of variational methods: what makes the discrete L of L
    bool composes = false;                            ///< of discrete Lagrangians: steps of one that is symmetric
};

[[nodiscard]] std::span<const MethodEntry> method_table();
[[nodiscard]] const MethodEntry* find_method(const std::string& name); ///< nullptr where there is none
/// The method that was meant: one of a name like it, or what other programs call so; empty where there is none.
[[nodiscard]] std::string nearest_method(const std::string& name);
/// What to write instead, for a message.
[[nodiscard]] std::string hint_for_method(const std::string& name);
/// What a method asks of the equations, "x'' = f(t, x)"; empty where it takes all.
[[nodiscard]] std::string system_of(const MethodEntry& method);
/// Whether its steps may have a time scale (`lagen::Reversible`).
[[nodiscard]] bool is_symmetric_splitting(const MethodEntry& method);
/// Several trajectories at a time, on the lanes of packs (lagen/lanes/abreast.hpp)?
[[nodiscard]] bool goes_abreast(const MethodEntry& method);
/// Every method name, in the order of the table.
[[nodiscard]] std::span<const std::string> method_names();

} // namespace lagen
