// SPDX-License-Identifier: GPL-2.0-or-later
/// Names of axes and curves, from [about].
#pragma once

#include "model/model.hpp"

#include <string>
#include <vector>

namespace lagen {

/// "\\omega_1" as "ω₁"; empty where a part of it has no character.
[[nodiscard]] std::string characters_of_latex(const std::string& latex);

/// What stands for a coordinate of a curve: a symbol of the model with what [about] says, or an expression as it is
/// written.
[[nodiscard]] Symbol symbol_of(const Model& model, const std::string& name);

/// "θ [rad]": its LaTeX in characters, else its name; with its unit.
[[nodiscard]] std::string short_label(const Symbol& symbol);

/// The label of an axis on which these stand, and the unit if it is that of all: "angle, θ [rad]", "x[1], x[2] [m]", a
/// family by its name. A text where there is room for it.
[[nodiscard]] std::string axis_label(const std::vector<Symbol>& symbols);
/// "base coordinates [m]": with the unit that all have.
[[nodiscard]] std::string panel_label(const std::string& text, const std::vector<Symbol>& symbols);

/// One legend a curve; `curves` has the symbols of the coordinates of each. It names the coordinates that differ from
/// curve to curve, with units where the axis has none for all. Empty for a curve alone.
[[nodiscard]] std::vector<std::string> legends_of(const std::vector<std::vector<Symbol>>& curves);

} // namespace lagen
