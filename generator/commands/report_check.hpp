// SPDX-License-Identifier: GPL-2.0-or-later
/// The outcome of `check` for people and for programs.
#pragma once

#include "diagnostic.hpp"
#include "emit/json.hpp"
#include "verify/verify.hpp"

namespace lagen {

/// Text: verdict, counts in all and a kind of check, regularity; then what is not proved (the first 20
/// of each status, the first of one Casimir, invariant or constraint) with its residual, witness and value, or
/// evidence, and each hint once.
[[nodiscard]] std::string report_text(const std::string& model, const Report& verified);

/// 0, 1 or 2: valid, invalid, undecided.
[[nodiscard]] ExitCode code_of(Verdict verdict);

/// Of it, counts in all and a kind of check; and what is not proved.
[[nodiscard]] std::string claims_text(const StructureReport& structure);
[[nodiscard]] std::string failures_text(const StructureReport& structure);

/// {"model", "verdict", "trivial", "checks": [...], "regularity": {...}} into `json`.
void report_json(JsonWriter& json, const std::string& model, const Report& verified);

/// The checks as a list, which follows a key.
void checks_json(JsonWriter& json, const std::vector<Check>& checks);

/// "trivial": .., "checks": [..], and "forms" where there are some, into the open object.
void structure_json(JsonWriter& json, const StructureReport& structure);

} // namespace lagen
