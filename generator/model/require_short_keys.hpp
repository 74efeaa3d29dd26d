// SPDX-License-Identifier: GPL-2.0-or-later
/// A bound on dotted keys, before the file is parsed.
#pragma once

#include "text/diagnostic.hpp"

#include <memory>

namespace lagen {

/// Throws ModelError where a dotted key or a table's heading has more than 64 parts.
void require_short_keys(const std::shared_ptr<const SourceFile>& file);

} // namespace lagen
