// SPDX-License-Identifier: GPL-2.0-or-later
/// Equations of three components written as one of vectors, as a paper has them: gamma' = gamma x w, I w' = I w x w +
/// ..; sums of products of components in a scalar as a . b.
#pragma once

#include "model/model.hpp"
#include "typeset/equation_set.hpp"

namespace lagen {

/// Fills `written` of the blocks where something is found, and `vectors` with what was used. The equations stay.
void write_vectors(EquationSet& equations, const Model& model);

} // namespace lagen
