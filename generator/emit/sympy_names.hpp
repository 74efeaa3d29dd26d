// SPDX-License-Identifier: GPL-2.0-or-later
/// The Python names of everything in a module for SymPy.
#pragma once

#include "notation/equation_module.hpp"

#include <map>

namespace lagen {

struct SympyNames {
    std::vector<std::string> declared;         ///< symbols of the model, each once
    std::vector<std::string> written;          ///< what expressions have besides, as labels of leaves
    std::vector<std::string> assigned;         ///< what equations define and no expression has: E, H
    std::vector<std::string> moving;           ///< symbols whose rates stand in equations, the state first
    std::map<std::string, std::string> symbol; ///< the variable of each of the first three, and of t
    std::map<std::string, std::string> rate;   ///< the variable of the rate of each of `moving`
    std::vector<std::string> definition;       ///< the variables of the definitions
};

/// Keywords of Python and names that the module itself has gain a trailing '_'; see identifiers.
[[nodiscard]] SympyNames sympy_names(const EquationModule& module);

/// A name that bears on no other: of a section (P_w1 of P^w1), a function on sections.
[[nodiscard]] std::string sympy_name(std::string name);

} // namespace lagen
