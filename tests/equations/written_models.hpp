// SPDX-License-Identifier: GPL-2.0-or-later
/// Five textbook models, as the tests of printed equations read them.
#pragma once

#include "elaborate/build_algebroid.hpp"
#include "equations/derivations.hpp"
#include "model/read_model.hpp"

namespace lagen::written {

inline const char* const pendulum = R"toml(
name = "pendulum"
title = "Planar pendulum"
[parameters]
m = 1
l = 2
g = "981/100"
[base]
coordinates = ["theta"]
[fibre]
coordinates = ["w"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "m*l^2*w^2/2 + m*g*l*cos(theta)"
[about]
w = { latex = "\\omega" }
)toml";

inline const char* const kepler = R"toml(
name = "kepler"
title = "Kepler problem"
[parameters]
k = 1
[base]
coordinates = ["x", "y"]
[fibre]
coordinates = ["u", "v"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "(u^2 + v^2)/2 + k/sqrt(x^2 + y^2)"
)toml";

inline const char* const rigid_body = R"toml(
name = "rigid_body"
title = "Free rigid body"
[parameters]
I1 = 1
I2 = 2
I3 = 3
[fibre]
coordinates = ["w1", "w2", "w3"]
[algebroid]
kind = "lie_algebra"
algebra = "so(3)"
[lagrangian]
L = "(I1*w1^2 + I2*w2^2 + I3*w3^2)/2"
)toml";

inline const char* const heavy_top = R"toml(
name = "heavy_top"
title = "Heavy top"
[parameters]
I1 = 1
I2 = 2
I3 = 3
mgl = "49/10"
[base]
coordinates = ["g1", "g2", "g3"]
[fibre]
coordinates = ["w1", "w2", "w3"]
[algebroid]
kind = "action"
algebra = "so(3)"
[algebroid.anchor]
w1 = { g2 = "g3", g3 = "-g2" }
w2 = { g1 = "-g3", g3 = "g1" }
w3 = { g1 = "g2", g2 = "-g1" }
[lagrangian]
L = "(I1*w1^2 + I2*w2^2 + I3*w3^2)/2 - mgl*g3"
)toml";

inline const char* const half_plane = R"toml(
name = "half_plane"
title = "Geodesics of the half-plane"
[base]
coordinates = ["x", "y"]
domain = ["y > 0"]
[fibre]
coordinates = ["u", "v"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "(u^2 + v^2)/(2*y^2)"
)toml";

/// A Lagrangian with explicit time, a gyroscopic coupling and a coupled mass matrix: every group of the formula occurs.
inline const char* const driven = R"toml(
name = "driven"
[parameters]
m = 1
k = 3
[base]
coordinates = ["x", "y"]
[fibre]
coordinates = ["a", "b"]
[algebroid.anchor]
a = { x = "y" }
b = { y = "y" }
[algebroid.bracket]
"a,b" = { a = -1 }
[lagrangian]
L = "m*(a^2 + b^2)/2 + k*a*b*cos(x)/4 + b*sin(t) - k*x^2/2"
)toml";

inline EquationSet derived(const char* text)
{
    const Model model = read_model_text("written.toml", text);
    return derive_lagrange(model, build_algebroid(model));
}

} // namespace lagen::written
