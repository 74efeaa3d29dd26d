// SPDX-License-Identifier: GPL-2.0-or-later
/// The meaning that a person may have had for xdot, dx or p_x: the rate of a base coordinate is a fibre coordinate, or
/// what the anchor makes of several, and momenta are named after fibre coordinates.
#pragma once

#include "model/model.hpp"

namespace lagen {

struct ModelReader;

/// xdot^i = rho^i_a y^a of a base coordinate, or of a family of them.
struct CoordinateRate {
    std::string coordinate;
    std::string rate;     ///< "v_x", or "g3*w2 - g2*w3"
    bool is_name = false; ///< `rate` is a fibre coordinate, a family of them or a definition
    std::string momentum; ///< of that fibre coordinate; empty where it is none of the model's
};

/// Defines what Dt(X) needs in the model's scope: the rates of t, of the parameters and of the base coordinates, closed
/// over the fibre coordinates (of a nonholonomic model over those of its ambient algebroid). Once the entries of the
/// algebroid are read. The anchor of a groupoid's action is not known here, and then neither are these.
void define_rates(ModelReader& reader);

/// The rates that are short enough to be told. The entries of the model's algebroid must have been read.
[[nodiscard]] std::vector<CoordinateRate> coordinate_rates(const Model& model);

/// The hint for `name` where it is a usual name of a rate, such as xdot; empty where it is none.
[[nodiscard]] std::string hint_for_rate(const std::string& name, const std::vector<CoordinateRate>& rates);

/// The hint for `name` in a function of momenta, where it is a usual name of a rate or of its momentum, such as p_x.
[[nodiscard]] std::string hint_for_momentum(const std::string& name, const std::vector<CoordinateRate>& rates);

/// The same where both are legal.
void explain_rates(Scope& scope, const std::vector<CoordinateRate>& rates);

} // namespace lagen
