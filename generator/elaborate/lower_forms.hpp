// SPDX-License-Identifier: GPL-2.0-or-later
/// [forms] on the graph of a system.
#pragma once

#include "mechanics/system.hpp"
#include "model/model.hpp"

namespace lagen {

/// Of a system whose algebroid is there.
[[nodiscard]] std::vector<FormClaim> lower_forms(System& system, Lowering& lower, const std::vector<NamedForm>& forms);

} // namespace lagen
