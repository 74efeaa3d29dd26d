// SPDX-License-Identifier: GPL-2.0-or-later
/// Names of axes and curves, from [about].
#pragma once

#include "model/model.hpp"

#include <string>
#include <vector>

namespace lagen {

/// Pixels that a text takes, rather more than less.
[[nodiscard]] int text_width(const std::string& text);
/// `text`, its end cut off for dots where it is broader than so many pixels.
[[nodiscard]] std::string shortened(const std::string& text, int width);

/// "\\omega_1" as "ω₁"; empty where a part of it has no character.
[[nodiscard]] std::string characters_of_latex(const std::string& latex);

/// What stands for a coordinate of a curve: a symbol of the model with what [about] says, or an expression as it is
/// written.
[[nodiscard]] Symbol symbol_of(const Model& model, const std::string& name);

/// "θ [rad]": its LaTeX in characters, else its name; with its unit.
[[nodiscard]] std::string short_label(const Symbol& symbol);

/// The label of an axis `width` pixels long on which these stand, and the unit if it is that of all: "angle θ [rad]",
/// "x[1], x[2] [m]", a family by its name. Texts where there is room for one and `texts` asks for them; where there is
/// too little, no unit.
[[nodiscard]] std::string axis_label(const std::vector<Symbol>& symbols, int width, bool texts);

/// "base coordinates [m]": with the unit that all have.
[[nodiscard]] std::string panel_label(const std::string& text, const std::vector<Symbol>& symbols);

/// One legend a curve; `curves` has the symbols of the coordinates of each. It names the coordinates that differ from
/// curve to curve, with units where the axis has none for all. Empty for a curve alone.
[[nodiscard]] std::vector<std::string> legends_of(const std::vector<std::vector<Symbol>>& curves);

} // namespace lagen
