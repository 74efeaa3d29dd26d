// SPDX-License-Identifier: GPL-2.0-or-later
/// Functions of a motion as they are written in `observe` and in the curves of a picture.
#pragma once

#include "model/families.hpp"

namespace lagen {

/// The columns that `text` names: one column, or one an entry where it is a vector or a matrix. `scope` is
/// Model::columns. Throws ModelError as closing does.
[[nodiscard]] std::vector<NamedTree> observed_columns(const Model& model, const Scope& scope, const Excerpt& text);

/// "x:y" and "x:y:z". Vectors of n entries make n curves, and a scalar beside them stands in each. Throws ModelError:
/// another number of coordinates, vectors of different lengths, and as `observed_columns` does.
[[nodiscard]] std::vector<PlotCurve> read_curve(const Model& model, const Scope& scope, const Excerpt& text);

/// Puts `curves` into a panel of their own. Throws ModelError where some lie in the plane and some in space, and where
/// the plot has more than 1000 curves.
void add_panel(Plot& plot, std::vector<PlotCurve> curves);

/// The picture of a block [scene.NAME.plot], on top of `plot` (empty, or the picture that it is like).
[[nodiscard]] Plot read_plot(const ModelReader& reader, Plot plot, const Item& block);

/// True where the curves of a panel lie in space.
[[nodiscard]] bool is_in_space(const std::vector<PlotCurve>& panel);

/// The coordinates of all curves of the scene's picture, `t` apart.
[[nodiscard]] std::vector<NamedTree> plot_coordinates(const Scene& scene);

} // namespace lagen
