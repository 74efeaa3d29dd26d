// SPDX-License-Identifier: GPL-2.0-or-later
/// The CSV file of a scene's inputs: a heading with t and names of inputs in any order, then rows of numbers. The
/// values of a row hold from its time to that of the next, those of the last one for ever.
#pragma once

#include "scene/evaluate_scene.hpp"

namespace lagen {

/// Where the table of a scene that has one lies.
[[nodiscard]] std::string input_table_path(const Model& model, const Scene& scene);

/// Rows t, u_1, u_2, .. of all inputs, in order of declaration; those without a column have their defaults in `values`.
/// A path that is not absolute begins at the folder of the model file. Throws ModelError at its place in the table: no
/// column t, a column that is no input or stands twice, a cell that is no finite number, a row of another length, times
/// that do not increase, no rows; and where the scene is before the first row, from `start` or at its end `end`.
[[nodiscard]] std::vector<std::vector<double>> read_input_table(const Model& model, const Scene& scene,
                                                                const SceneValues& values, long double end);

} // namespace lagen
