// SPDX-License-Identifier: GPL-2.0-or-later
/// Casimirs that an expression uses by name, back as names: the labels of leaves are constants of the motion, and
/// equations read better with them.
#pragma once

#include "model/model.hpp"

namespace lagen {

/// `tree` with every expansion of a Casimir that was written by its name replaced by that name.
[[nodiscard]] Tree label_casimirs(const Tree& tree, const std::vector<NamedTree>& casimirs);

} // namespace lagen
