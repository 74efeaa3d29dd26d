// SPDX-License-Identifier: GPL-2.0-or-later
/// What `check` says of a nonholonomic model beside its verdict.
#pragma once

#include "text/record.hpp"
#include "verify/verify.hpp"

namespace lagen {

/// Empty for other models.
[[nodiscard]] std::string nonholonomic_text(const MechanicsReport& mechanics);
/// Adds "integrable" and "conserved"; nothing for other models.
void add_nonholonomic(Record& record, const MechanicsReport& mechanics);

} // namespace lagen
