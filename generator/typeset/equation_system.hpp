// SPDX-License-Identifier: GPL-2.0-or-later
/// The system whose equations an EquationSet has, for a program that computes with them.
#pragma once

#include "expression/symbol.hpp"

#include <string>
#include <utility>
#include <vector>

namespace lagen {

/// rho^i_a with the indices {x^i, y^a}, or C^c_ab with {y^c, y^a, y^b}.
struct StructureEntry {
    std::vector<std::string> indices;
    Tree value;
};

struct EquationSystem {
    std::vector<NamedTree> parameters; ///< and inputs, with their defaults, each over earlier ones
    /// The symbols that play one part: "base", "fibre", "momenta", ..; one may play two.
    std::vector<std::pair<std::string, std::vector<std::string>>> parts;
    std::vector<NamedTree> definitions;    ///< the scalar ones
    std::vector<NamedTree> functions = {}; ///< "lagrangian", "hamiltonian", as they are written
    std::vector<Tree> constraints = {};    ///< M is their common zero set
    std::vector<StructureEntry> rho = {};  ///< those that are not zero, of the ambient algebroid where there is one
    std::vector<StructureEntry> C = {};    ///< likewise, of (a, b) or (b, a), or of both where both are given
};

} // namespace lagen
