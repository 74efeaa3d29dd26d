// SPDX-License-Identifier: GPL-2.0-or-later
/// An EquationSet for a program that computes with it: beside the equations what they are about.
#pragma once

#include "expression/symbol.hpp"
#include "notation/equation_set.hpp"

#include <array>
#include <map>

namespace lagen {

/// Symbols that play one part: base, fibre, ..
struct ModuleSymbols {
    std::string name; ///< "base"
    std::string text; ///< what they are, for a comment
    std::vector<std::string> symbols;
};

/// Blocks are numbers of `equations.blocks`. What has no rates (the form "poisson") has neither `state` nor any block.
struct EquationModule {
    EquationSet equations;
    std::vector<NamedTree> parameters;              ///< with their defaults, each over earlier ones
    std::vector<ModuleSymbols> groups;              ///< base, fibre, momenta, ..; a symbol may stand in two
    std::vector<std::string> state;                 ///< what the equations move, in the order of a run
    std::vector<std::string> velocities;            ///< those of them whose rates the mass matrix determines
    std::vector<std::size_t> rates;                 ///< blocks with an equation for each rate of the others
    std::vector<std::size_t> auxiliary;             ///< blocks that define what else the rates are written in
    std::size_t accelerations = 0;                  ///< the block mass * rates = force, where there are `velocities`
    std::vector<NamedTree> definitions;             ///< those that the functions use, each over earlier ones
    std::vector<NamedTree> functions;               ///< "lagrangian", "hamiltonian", as they are written
    std::vector<Tree> constraints;                  ///< M is their common zero set
    std::size_t rank = 0;                           ///< r
    std::map<std::array<std::size_t, 2>, Tree> rho; ///< rho(i, a), shape (n, r): the entries that are given
    std::map<std::array<std::size_t, 3>, Tree> C;   ///< C(c, a, b), shape (r, r, r), of both orders of a, b
};

} // namespace lagen
