// SPDX-License-Identifier: GPL-2.0-or-later
/// Blocks of model files that many tests of `verify` begin with.
#pragma once

#include <string>

namespace lagen {

/// The brackets of so(3).
inline const std::string so3_bracket = R"([algebroid.bracket]
"w1,w2" = { w3 = 1 }
"w2,w3" = { w1 = 1 }
"w3,w1" = { w2 = 1 }
)";

/// One constraint of turning_vector().
inline const std::string on_sphere = "constraints = [\"g1^2 + g2^2 + g3^2 - 1\"]\n";

/// so(3) acting on a vector of R^3; lines of [base] and of [fibre].
inline std::string turning_vector(const std::string& base = "", const std::string& fibre = "")
{
    return "\n[base]\ncoordinates = [\"g1\", \"g2\", \"g3\"]\n" + base +
           "[fibre]\ncoordinates = [\"w1\", \"w2\", \"w3\"]\n" + fibre +
           "[algebroid.anchor]\nw1 = { g2 = \"g3\", g3 = \"-g2\" }\nw2 = { g1 = \"-g3\", g3 = \"g1\" }\n"
           "w3 = { g1 = \"g2\", g2 = \"-g1\" }\n" +
           so3_bracket;
}

/// The frame y d/dx, y d/dy, whose bracket [a, b] = -a is to be added.
inline const std::string half_plane_frame = R"(
[base]
coordinates = ["x", "y"]
[fibre]
coordinates = ["a", "b"]
[algebroid.anchor]
a = { x = "y" }
b = { y = "y" }
[algebroid.bracket]
)";

} // namespace lagen
