// SPDX-License-Identifier: GPL-2.0-or-later
/// `--over step=a:b:n[,p=a:b:n]`: what a stability chart is drawn over.
#pragma once

#include "model/model.hpp"
#include "scene/values.hpp"

#include <optional>
#include <string>
#include <vector>

namespace lagen {

struct StabilityAxis {
    std::string name; ///< "step", a parameter, or "initial.x"
    std::vector<double> values;
    std::string heading{}; ///< the name in files
};

/// x of "initial.x"; nothing of another name.
[[nodiscard]] std::optional<std::string> initial_name(const std::string& name);

/// One axis or two, the first of steps. Throws UsageError where it is not such a list, ModelError where an end is no
/// number, or the scene has no parameter and no initial value of that name.
[[nodiscard]] std::vector<StabilityAxis> stability_axes(const std::string& over, const Model& model,
                                                        const Scene& scene);

/// A column of the chart gives these values to parameters and to the start.
struct ColumnPlace {
    Values parameters, initial;
};
/// By the values of the second axis; one column that sets nothing where there is none.
[[nodiscard]] std::vector<ColumnPlace> column_places(const std::vector<StabilityAxis>& axes);

} // namespace lagen
