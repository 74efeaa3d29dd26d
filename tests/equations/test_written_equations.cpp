// SPDX-License-Identifier: GPL-2.0-or-later
/// Equations by vectors and by indices say what their components say: in numbers on every model, and some as exact
/// texts.
#include "equations/written_blocks.hpp"
#include "typeset/print_equations_terms.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>

using namespace lagen;

namespace {

/// A body in R^3 with a full matrix of inertia, and vectors that are multiplied twice.
const std::string body = R"toml(
[parameters]
"J[1..3,1..3]" = [[2, "1/10", 0], ["1/10", 3, "1/5"], [0, "1/5", 4]]
m = 1.5
k = 0.3
[base]
coordinates = ["x[1..3]"]
[fibre]
coordinates = ["w[1..3]", "v[1..3]"]
[algebroid]
kind = "general"
[algebroid.anchor]
"v[1]" = { "x[1]" = 1 }
"v[2]" = { "x[2]" = 1 }
"v[3]" = { "x[3]" = 1 }
[algebroid.bracket]
"w[1],w[2]" = { "w[3]" = 1 }
"w[2],w[3]" = { "w[1]" = 1 }
"w[3],w[1]" = { "w[2]" = 1 }
[lagrangian]
L = "dot(w, J*w)/2 + m*dot(v, v)/2 + k/sqrt(dot(x, x))"
)toml";

} // namespace

TEST_CASE("equations by vectors and indices are equal to their components")
{
    for (const char* name : {"heavy_top", "kirchhoff", "lagrange_top", "heavy_top_matrix", "attitude", "gyrostat"}) {
        INFO(name);
        CHECK(checked_blocks(of_file(std::string("models/") + name + ".toml")) >= 2);
    }
}

TEST_CASE("equations by vectors and indices are equal to their components in every model", "[all]")
{
    std::size_t blocks = 0;
    for (const auto& entry : std::filesystem::directory_iterator(LAGEN_SOURCE_DIR "/models")) {
        if (entry.path().extension() != ".toml") continue;
        INFO(entry.path().filename());
        const Model model = read_model(entry.path().string(), {}, choosers());
        const System system = elaborate(model);
        const Report report = verify(system);
        for (const char* form : {"lagrange", "hamilton", "pontryagin", "discrete"}) {
            INFO(form);
            try {
                blocks += checked_blocks(
                    with_written_blocks(derive(form, model, system, report, {}, Definitions::kept), model));
            } catch (const MathematicsError&) { // the model has no such form
            }
        }
    }
    CHECK(blocks > 80);
}

TEST_CASE("the heavy top and Kirchhoff's body are written as in a book")
{
    const EquationSet top = of_file("models/heavy_top.toml");
    CHECK(block_text(top, "kinematics") == "  ġ = g × w\n");
    CHECK(block_text(top, "momenta") == "  p_w = I w\n");
    CHECK(block_text(top, "equations of motion (momentum form)") == "  ṗ_w = p_w × w + mgl g × e\n");
    CHECK(block_text(top, "equations of motion (acceleration form)") == "  I ẇ = I w × w + mgl g × e\n");
    CHECK(block_text(top, "energy") == "  E = w · I w/2 + mgl e · g\n");
    CHECK(print_text(top).ends_with("where:\n"
                                    "    I = diag(I1, I2, I3)\n"
                                    "    e = [e1, e2, e3]\n"
                                    "    g = [g1, g2, g3]\n"
                                    "    w = [w1, w2, w3]\n"
                                    "  p_w = [p_w1, p_w2, p_w3]\n"));
    CHECK(print_latex(top).find("  I\\, \\dot{\\omega} &= I\\, \\omega \\times \\omega + mgl\\, \\gamma \\times e\n") !=
          std::string::npos);
    const EquationSet fluid = of_file("models/kirchhoff.toml");
    CHECK(block_text(fluid, "equations of motion (momentum form)") == "  ṗ_w = p_w × w + p_v × v\n  ṗ_v = p_v × w\n");
}

TEST_CASE("rows of a matrix are vectors, and a basis vector stands for an axis")
{
    const EquationSet matrix = of_file("models/heavy_top_matrix.toml");
    CHECK(block_text(matrix, "kinematics") == "  Ṙ[i,:] = R[i,:] × w   (i = 1..3)\n");
    CHECK(block_text(matrix, "equations of motion (momentum form)") == "  ṗ_w = p_w × w + mgl R[3,:] × e\n");
    const EquationSet top = of_file("models/lagrange_top.toml");
    CHECK(block_text(top, "equations of motion (momentum form)") == "  ṗ_w = p_w × w + mgl g × e_3\n");
    CHECK(print_text(top).find("\n  e_3 = [0, 0, 1]\n") != std::string::npos);
}

TEST_CASE("families are written once, in LaTeX too")
{
    const EquationSet set = of_file("models/outer_solar_system.toml");
    CHECK(block_text(set, "equations of motion (acceleration form)") ==
          "  m[i] V̇[i,:] = -potential_Q[i,:]   (i = 1..6)\n");
    CHECK(print_latex(set).find("p_{V_{i:}} &= m_{i}\\, V_{i:} \\qquad (i = 1, \\dots, 6)") != std::string::npos);
    const EquationSet chain = of_text(R"toml(
[sizes]
n = 6
[parameters]
"k[1..n]" = 1
[base]
coordinates = ["x[1..n]"]
[fibre]
coordinates = ["v[1..n]"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "sum(i, 1, n, v[i]^2)/2 - sum(i, 1, n-1, k[i]*(x[i+1] - x[i])^2)/2"
)toml");
    CHECK(checked_blocks(chain) == 6);
    CHECK(block_text(chain, "kinematics") == "  ẋ[i] = v[i]   (i = 1..6)\n");
    CHECK(block_text(chain, "equations of motion (acceleration form)") ==
          "  v̇[1] = k[1] (x[2] - x[1])\n"
          "  v̇[i] = k[i-1] (x[i-1] - x[i]) + k[i] (x[i+1] - x[i])   (i = 2..5)\n"
          "  v̇[6] = k[5] (x[5] - x[6])\n");
}

TEST_CASE("a definition with an entry that is 0, and one with a sign in front, stand in vectors by name")
{
    const EquationSet rotor = of_file("docs/cookbook/quadrotor.toml");
    CHECK(checked_blocks(rotor) >= 6);
    CHECK(block_text(rotor, "equations of motion (acceleration form)") ==
          "  J ẇ = J w × w - kR tilt - kw w\n  m v̇ = m v × w - m g R[3,:] + thrust e_3\n");
}

TEST_CASE("full matrices stand beside their transposes")
{
    const EquationSet set = of_text(body);
    CHECK(checked_blocks(set) == 6);
    CHECK(block_text(set, "kinematics") == "  ẋ = v\n");
    CHECK(block_text(set, "momenta") == "  p_w = J w/2 + Jᵀ w/2\n  p_v = m v\n");
    CHECK(block_text(set, "equations of motion (momentum form)") ==
          "  ṗ_w = p_w × w\n  ṗ_v = -k x/(x[1]² + x[2]² + x[3]²)^(3/2)\n");
    CHECK(block_text(set, "equations of motion (acceleration form)") ==
          "  (J/2) ẇ + (Jᵀ/2) ẇ = J w × w/2 + Jᵀ w × w/2\n"
          "                 m v̇ = -k x/(x[1]² + x[2]² + x[3]²)^(3/2)\n");
    CHECK(print_latex(set).find("\\frac{J^{\\mathsf{T}}\\, w}{2}") != std::string::npos);
}

TEST_CASE("joint angles are no vector of space, and a declared name keeps its meaning")
{
    const EquationSet arm = of_text(R"toml(
[parameters]
g = 9.81
"tau[1..3]" = 0
[base]
coordinates = ["q[1..3]"]
[fibre]
coordinates = ["v[1..3]"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "dot(v, v)/2 + g*cos(q[1]) + q[1]*q[2]*q[3]"
)toml");
    CHECK(block_text(arm, "equations of motion (acceleration form)") ==
          "  v̇[1] = q[2] q[3] - g sin(q[1])\n  v̇[2] = q[1] q[3]\n  v̇[3] = q[1] q[2]\n");
    const EquationSet taken = of_text(R"toml(
[parameters]
g = 9.81
I1 = 1
I2 = 2
I3 = 3
[base]
coordinates = ["g1", "g2", "g3"]
casimirs = { n = "g1^2 + g2^2 + g3^2" }
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
L = "(I1*w1^2 + I2*w2^2 + I3*w3^2)/2 - g*g3"
)toml");
    CHECK(block_text(taken, "kinematics") == "  ġ1 = g2 w3 - g3 w2\n  ġ2 = g3 w1 - g1 w3\n  ġ3 = g1 w2 - g2 w1\n");
}

TEST_CASE("no vector is called like the time, the energy or another symbol")
{
    const EquationSet set = of_text(R"toml(
[base]
coordinates = ["t1", "t2", "t3", "E1", "E2", "E3"]
[fibre]
coordinates = ["u1", "u2", "u3", "v1", "v2", "v3"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "(u1^2 + u2^2 + u3^2 + v1^2 + v2^2 + v3^2)/2 - (t1*E1 + t2*E2 + t3*E3)"
)toml");
    CHECK(block_text(set, "kinematics") == "  ṫ1 = u1\n  ṫ2 = u2\n  ṫ3 = u3\n  Ė1 = v1\n  Ė2 = v2\n  Ė3 = v3\n");
    CHECK(block_text(set, "energy") == "  E = u · u/2 + v · v/2 + t1 E1 + t2 E2 + t3 E3\n");
}
