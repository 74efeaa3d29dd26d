// SPDX-License-Identifier: GPL-2.0-or-later
/// What `lagen linearize` found, in text and in JSON.
#pragma once

#include "analysis/equilibrium.hpp"
#include "linear/regulator.hpp"

#include <string>

namespace lagen {

struct LinearReport {
    std::string model, scene, form;
    std::vector<std::string> states, inputs, following;
    MotionPoint start;
    Equilibrium equilibrium;
    linear::LinearSystem system;
    std::vector<linear::Mode> modes; ///< of A, by real, then by imaginary parts
    std::optional<linear::Regulator> regulator;
};

[[nodiscard]] std::string linear_text(const LinearReport& report);
[[nodiscard]] std::string linear_json(const LinearReport& report);

/// "-0.5", "0.1 +- 2i": a pair by one of it
[[nodiscard]] std::string eigenvalue_text(linear::Eigenvalue lambda);

} // namespace lagen
