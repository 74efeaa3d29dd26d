// SPDX-License-Identifier: GPL-2.0-or-later
/// Small models with forces, Hamiltonians and controls, as the tests of printed equations read them.
#pragma once

#include "elaborate/build_algebroid.hpp"
#include "equations/derivations.hpp"
#include "model/read_model.hpp"
#include "support/model_equations.hpp"

namespace lagen::written {

/// Friction that is not smooth, a Rayleigh function and a drive.
inline const char* const slide = R"toml(
name = "slide"
[parameters]
m = 2
c = 3
[base]
coordinates = ["x"]
[fibre]
coordinates = ["v"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "m*v^2/2 + x*cos(t)"
[forces]
v = "-c*sign(v)*max(v^2, 1)"
[dissipation]
R = "m*v^4/4"
)toml";

/// A Hamiltonian with explicit time, on a Lie algebra, and no Lagrangian.
inline const char* const rotor = R"toml(
name = "rotor"
[parameters]
I1 = 1
I2 = 2
I3 = 3
[fibre]
coordinates = ["w1", "w2", "w3"]
momenta = ["M1", "M2", "M3"]
[algebroid]
kind = "lie_algebra"
algebra = "so(3)"
[hamiltonian]
H = "(M1^2/I1 + M2^2/I2 + M3^2/I3)/2 + cos(t)*M3"
)toml";

/// W depends on the angles and couples the velocities.
inline const char* const double_pendulum = R"toml(
name = "double_pendulum"
[base]
coordinates = ["a", "b"]
[fibre]
coordinates = ["u", "v"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "u^2 + v^2/2 + u*v*cos(a - b) + 2*cos(a) + cos(b)"
)toml";

/// Not quadratic in the velocity.
inline const char* const relativistic = R"toml(
name = "relativistic"
[base]
coordinates = ["x"]
[fibre]
coordinates = ["v"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "-sqrt(1 - v^2) - x^2/2 + x*sin(t)"
)toml";

inline const char* const degenerate = R"toml(
name = "degenerate"
[base]
coordinates = ["x", "y"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "(v_x + v_y)^2/2 - x^2"
)toml";

inline const char* const unicycle = R"toml(
name = "unicycle"
[parameters]
kap = "1/2"
[base]
coordinates = ["x", "y", "h"]
domain = ["kap > 0"]
[fibre]
coordinates = ["y1", "y2", "y3"]
momenta = ["mu1", "mu2", "mu3"]
[algebroid.anchor]
y1 = { x = "cos(h)", y = "sin(h)" }
y2 = { h = 1 }
y3 = { x = "-sin(h)", y = "cos(h)" }
[algebroid.bracket]
"y1,y2" = { y3 = -1 }
"y2,y3" = { y1 = -1 }
[control]
controls = ["u1", "u2"]
sigma = { y1 = "u1", y2 = "u2" }
cost = "(u1^2 + kap*u2^2)/2"
)toml";

/// dH/du is not affine in u, and time stands in the cost.
inline const char* const quartic = R"toml(
name = "quartic"
[base]
coordinates = ["x"]
[fibre]
momenta = ["p"]
[algebroid]
kind = "tangent"
[control]
controls = ["u"]
sigma = { v_x = "u - x" }
cost = "u^4/4 + t*x^2"
)toml";

/// One control between bounds, one without.
inline const char* const bounded = R"toml(
name = "bounded"
[parameters]
top = 3
[base]
coordinates = ["x", "v"]
[fibre]
coordinates = ["a", "b"]
momenta = ["p", "q"]
[algebroid]
kind = "tangent"
[control]
controls = ["u", "w"]
sigma = { a = "v + w", b = "u" }
cost = "u^2/2 + w^2"
bounds = { u = ["-top", "top"] }
)toml";

/// H is convex in u, so that it is largest at a bound.
inline const char* const convex = R"toml(
name = "convex"
[base]
coordinates = ["x"]
[fibre]
momenta = ["p"]
[algebroid]
kind = "tangent"
[control]
controls = ["u"]
sigma = { v_x = "u" }
cost = "-u^2/2"
bounds = { u = [-1, 1] }
)toml";

inline Model read(const char* text)
{
    return read_model_text("written.toml", text);
}

inline EquationSet hamilton(const char* text)
{
    const Model model = read(text);
    return derive_hamilton(model, build_algebroid(model));
}

inline EquationSet lagrange(const char* text)
{
    const Model model = read(text);
    return derive_lagrange(model, build_algebroid(model));
}

inline EquationSet pontryagin(const char* text)
{
    const Model model = read(text);
    return derive("pontryagin", model, verify(model));
}

} // namespace lagen::written
