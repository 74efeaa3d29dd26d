// SPDX-License-Identifier: GPL-2.0-or-later
/// MorphismFile -> SystemMorphism: both models elaborated, the map lowered onto the source's graph.
#pragma once

#include "mechanics/morphism.hpp"
#include "model/morphism.hpp"

namespace lagen {

/// Of a file with a source and a target, no composition. Throws ModelError as `elaborate` does.
[[nodiscard]] SystemMorphism elaborate(const MorphismFile& file);

/// Of any file: the map of a composition is that of all stages.
[[nodiscard]] SystemMorphism elaborate_whole(const MorphismFile& file);

} // namespace lagen
