// SPDX-License-Identifier: GPL-2.0-or-later
/// Lagrange's equations of a model whose families run to one size n, for every n, from derivations at small ones.
///
/// A function f_n that is made of sums over letters 1 <= i, j, .. <= n, of which at most K stand in one product, with
/// no condition on letters but their order, is f_n = sum_T g_T over the sets T of at most K indices, where g_T depends
/// on the families at T alone and on T through its order alone. The same holds of its partial derivatives. Two such
/// functions that are equal for n = 1 .. K + 1 have the same g_T and are equal for all n (inclusion and exclusion).
#pragma once

#include "model/model.hpp"
#include "typeset/equation_set.hpp"

#include <functional>
#include <optional>

namespace lagen {

/// `derive_at` gives Lagrange's equations at a size, with all definitions written out and blocks written by indices.
/// Nothing where L is none of these functions, or the equations at the smallest size that shows all indices are not
/// written so, or other sizes do not agree with them. The equations that come have `written` blocks alone.
[[nodiscard]] std::optional<EquationSet>
equations_of_every_size(const Model& model, const std::function<EquationSet(long size)>& derive_at);

} // namespace lagen
