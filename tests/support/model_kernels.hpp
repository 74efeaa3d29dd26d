// SPDX-License-Identifier: GPL-2.0-or-later
/// The kernels of a model whose report is at hand.
#pragma once

#include "kernels/form_kernels.hpp"
#include "support/stages.hpp"

namespace lagen {

[[nodiscard]] inline KernelModule form_kernels(const Model& model, const Report& report,
                                               const KernelRequest& request = {})
{
    return form_kernels(model, elaborate(model), report, request);
}

} // namespace lagen
