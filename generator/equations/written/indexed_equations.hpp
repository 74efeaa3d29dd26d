// SPDX-License-Identifier: GPL-2.0-or-later
/// Equations that are the same but for an index of families, written once: x[i]' = v[i], i = 1 .. 7.
#pragma once

#include "model/model.hpp"
#include "typeset/equation_set.hpp"

namespace lagen {

/// Joins three equations or more one behind the other, also of those written by vectors; fills `written` of the blocks
/// where some are joined. The equations stay. Letters i and j stand for the indices, or others that no name of
/// `equations` and no size of `model` is.
void write_by_index(EquationSet& equations, const Model& model);

} // namespace lagen
