// SPDX-License-Identifier: GPL-2.0-or-later
/// What `check` says of a nonholonomic model beside its verdict.
#pragma once

#include "emit/json.hpp"
#include "verify/verify.hpp"

namespace lagen {

/// Empty for other models.
[[nodiscard]] std::string nonholonomic_text(const MechanicsReport& mechanics);
/// The keys "integrable" and "conserved"; none for other models.
void nonholonomic_json(JsonWriter& json, const MechanicsReport& mechanics);

} // namespace lagen
