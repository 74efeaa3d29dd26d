// SPDX-License-Identifier: GPL-2.0-or-later
/// A scene in numbers: what a run starts from.
#pragma once

#include "model/model.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lagen {

using NamedNumber = std::pair<std::string, long double>;

struct SceneValues {
    std::vector<NamedNumber>
        parameters;                 ///< every parameter that is not bound, in order of declaration, with the scene's values
    std::vector<NamedNumber> base;  ///< every base coordinate, in order; on the constraints
    std::vector<NamedNumber> fibre; ///< every fibre coordinate, in order; empty where the scene gives momenta
    std::vector<NamedNumber> momenta;  ///< every momentum, in order; empty where the scene gives fibre coordinates
    std::vector<NamedNumber> casimirs; ///< the declared Casimirs at the start
    long double start = 0;
    std::optional<long double> duration, step;
    std::optional<long double> relative, absolute; ///< `tolerance` fills both
    std::optional<long double> interval;           ///< of `sample`
    std::vector<long double> at;                   ///< of `at`
};

/// Evaluates every tree of the scene in long double. Throws ModelError: a value that is not finite, a step, tolerance
/// or sampling interval that is not positive, a start outside the domain, and a start off a constraint h by more than
/// 1e-10 relative to its terms, |h| > 1e-10 max(sum |terms of h|, sum_i |x^i dh/dx^i|). With `project` the start is
/// first moved by Newton steps of least length, dx = -J^T (J J^T)^-1 h, in the base coordinates.
[[nodiscard]] SceneValues evaluate_scene(const Model& model, const Scene& scene);

} // namespace lagen
