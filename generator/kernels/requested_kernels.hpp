// SPDX-License-Identifier: GPL-2.0-or-later
/// Kernels by name: those that there are, those that a request asks for, those that a form of a model has.
#pragma once

#include "kernels/form_kernels.hpp"

namespace lagen {

/// Every kernel that some form of some model has.
[[nodiscard]] const std::vector<std::string>& kernel_names();

/// Whether `only` asks for the kernel `name`; an empty list asks for all but the variational equations and Hessians.
[[nodiscard]] bool is_requested(const std::vector<std::string>& only, const std::string& name);

/// Throws a usage Error where `only` has a name that no kernel has.
void refuse_unknown(const std::vector<std::string>& only);

/// Throws a usage Error with the kernels of this form of the model where `module` lacks one that was asked for: it
/// belongs to another form, or the model has nothing of its kind.
void require_requested(const KernelModule& module, const Model& model, const System& system, const Report& report,
                       const KernelRequest& request);

} // namespace lagen
