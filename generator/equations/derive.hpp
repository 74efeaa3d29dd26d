// SPDX-License-Identifier: GPL-2.0-or-later
/// The equations of a model in one of its forms.
#pragma once

#include "equations/kept_symbols.hpp"
#include "model/model.hpp"
#include "typeset/equation_set.hpp"
#include "verify/verify.hpp"

namespace lagen {

/// The forms that `derive` can print: form_names(), "exterior", "cartan", "poisson", "invariants", "variations", and
/// "reaction" and "projected" of nonholonomic models.
[[nodiscard]] std::vector<std::string> derivation_names();

/// `form` is one of derivation_names(); `brackets`: functions on E* by pairs, for "poisson". Throws MathematicsError
/// where the model has no equations of that form.
[[nodiscard]] EquationSet derive(const std::string& form, const Model& model, const System& system,
                                 const Report& report, const std::vector<Tree>& brackets = {},
                                 Definitions definitions = Definitions::expanded);

/// The equations with blocks also written by vectors and by indices (vector_equations.hpp, indexed_equations.hpp), as
/// text and LaTeX show them.
[[nodiscard]] EquationSet with_written_blocks(EquationSet equations, const Model& model);

} // namespace lagen
