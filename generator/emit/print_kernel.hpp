// SPDX-License-Identifier: GPL-2.0-or-later
/// One kernel as a member function of the generated class.
#pragma once

#include "emit/module_names.hpp"
#include "emit/text_block.hpp"

namespace lagen {

/// What the functions printed so far need from elsewhere.
struct KernelNeeds {
    bool linear = false;  ///< lagen/linear.hpp
    bool newton = false;  ///< lagen/newton.hpp
    bool bracket = false; ///< lagen/bracket.hpp
};

void print_kernel(TextBlock& out, const KernelModule& module, const ModuleNames& names, const Kernel& kernel,
                  KernelNeeds& needs);

/// solve_NAME(): the unknowns of a block at a state, by Newton's method, between its bounds where it has a bracket.
void print_implicit(TextBlock& out, const KernelModule& module, const ModuleNames& names, const ImplicitBlock& block,
                    KernelNeeds& needs);

/// parameter_status(): the factorisations and divisors of all kernels that depend on parameters alone.
void print_parameter_status(TextBlock& out, const KernelModule& module, const ModuleNames& names, KernelNeeds& needs);

} // namespace lagen
