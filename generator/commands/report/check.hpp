// SPDX-License-Identifier: GPL-2.0-or-later
/// The outcome of `check` for people and for programs.
#pragma once

#include "text/diagnostic.hpp"
#include "text/record.hpp"
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

/// {"model", "verdict", "trivial", "checks": [...], "regularity": {...}}
[[nodiscard]] Record record_of(const std::string& model, const Report& verified);

[[nodiscard]] Record checks_record(const std::vector<Check>& checks);

/// Adds "trivial" and "checks", and "forms" where there are some.
void add_structure(Record& record, const StructureReport& structure);

} // namespace lagen
