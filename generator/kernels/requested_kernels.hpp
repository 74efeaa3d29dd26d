// SPDX-License-Identifier: GPL-2.0-or-later
/// Kernels by name: those that there are, those that a request asks for, those that a form of a model has.
#pragma once

#include "kernels/form_kernels.hpp"
#include "model/scene_form.hpp"

namespace lagen {

/// Every kernel that some form of some model has.
[[nodiscard]] const std::vector<std::string>& kernel_names();

/// True where the request asks for the kernel `name` of this form: an empty `only` asks for all that are not made on
/// request alone.
[[nodiscard]] bool is_requested(const KernelRequest& request, FormKind form, const std::string& name);

/// Throws a usage Error where the request has a name that no kernel has.
void refuse_unknown(const KernelRequest& request);

/// Throws a usage Error with the kernels of this form of the model where `module` lacks one that was asked for: it
/// belongs to another form, or the model has nothing of its kind.
void require_requested(const KernelModule& module, const Model& model, const System& system, const Report& report,
                       const KernelRequest& request);

} // namespace lagen
