// SPDX-License-Identifier: GPL-2.0-or-later
/// One kernel as a member function of the generated class.
#pragma once

#include "emit/module_names.hpp"
#include "emit/text_block.hpp"

#include <set>

namespace lagen {

/// The headers of the runtime that the functions printed so far need: "lagen/linear.hpp", ...
using Includes = std::set<std::string>;

void print_kernel(TextBlock& out, const KernelModule& module, const ModuleNames& names, const Kernel& kernel,
                  Includes& includes);

/// Guess, with a member an unknown that is followed along a run; nothing where there is none.
void print_guess(TextBlock& out, const KernelModule& module, const ModuleNames& names);
/// follow(): the unknowns at a state become the guess; nothing where none is followed.
void print_follow(TextBlock& out, const KernelModule& module, const ModuleNames& names);

/// solve_NAME(): the unknowns of a block at a state, by Newton's method, between its bounds where it has a bracket, in
/// closed form where they are angles.
void print_implicit(TextBlock& out, const KernelModule& module, const ModuleNames& names, const ImplicitBlock& block,
                    Includes& includes);

/// parameter_status(): the factorisations and divisors of all kernels that depend on parameters alone.
void print_parameter_status(TextBlock& out, const KernelModule& module, const ModuleNames& names, Includes& includes);

} // namespace lagen
