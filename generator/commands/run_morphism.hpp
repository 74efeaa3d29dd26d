// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen run` of a morphism file: a scene of the source, the same motion in the target, and how far they are apart.
#pragma once

#include "commands/line/options.hpp"

#include <memory>

namespace lagen {

/// `file` has a [morphism] block.
[[nodiscard]] ExitCode run_morphism(const Options& options, const std::shared_ptr<const SourceFile>& file);

} // namespace lagen
