// SPDX-License-Identifier: GPL-2.0-or-later
/// The outcome of `check` for people and for programs.
#pragma once

#include "emit/json.hpp"
#include "geometry/verify.hpp"

namespace lagen {

/// Text: verdict, a count a kind of check, every refutation with its residual, witness and value, regularity.
[[nodiscard]] std::string report_text(const std::string& model, const VerifiedAlgebroid& verified);

/// {"model", "verdict", "trivial", "checks": [...], "regularity": {...}} into `json`.
void report_json(JsonWriter& json, const std::string& model, const VerifiedAlgebroid& verified);

} // namespace lagen
