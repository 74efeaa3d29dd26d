// SPDX-License-Identifier: GPL-2.0-or-later
/// A morphism file with both its models decided, for people and for programs.
#pragma once

#include "model/morphism.hpp"
#include "text/record.hpp"
#include "verify/verify_morphism.hpp"

namespace lagen {

/// Of a composition the map is that of all stages, source and target are those of the first and of the last.
struct VerifiedMorphism {
    std::string name, source_name, target_name;
    MorphismReport map;
    Report source, target;
    std::vector<VerifiedMorphism> stages;
};
[[nodiscard]] VerifiedMorphism verify_morphism(const MorphismFile& file);

/// The worst of the map, of both models and of all stages.
[[nodiscard]] Verdict verdict_of(const VerifiedMorphism& verified);

/// Warns on standard error of what is not proved of the map and of its stages; a refuted one throws MathematicsError
/// unless `unchecked`. Both models apart, of which the commands that run or print them say it; `file` is for the hint.
void warn_of_morphism(const VerifiedMorphism& verified, const std::string& file, bool unchecked);

[[nodiscard]] std::string morphism_text(const VerifiedMorphism& verified);
/// {"model", "verdict", "trivial", "checks", "rank", "follows", "source": report, "target": report}, and "stages".
[[nodiscard]] Record record_of(const VerifiedMorphism& verified);

} // namespace lagen
