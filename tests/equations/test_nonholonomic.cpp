// SPDX-License-Identifier: GPL-2.0-or-later
/// What `derive` prints of nonholonomic models.
#include "equations/derive.hpp"
#include "model/read_model.hpp"
#include "support/stages.hpp"
#include "typeset/print_equations.hpp"

#include <catch2/catch.hpp>

using namespace lagen;

namespace {

EquationSet constrained_equations(const std::string& form, const std::string& text)
{
    const Model model = read_model_text("sleigh.toml", text);
    return derive(form, model, elaborate(model), verify(model));
}

const std::string sleigh = R"toml(
[parameters]
m = 1
J = 1
a = 1
[base]
coordinates = ["x", "y", "th"]
[fibre]
coordinates = ["u", "w"]
[algebroid]
kind = "nonholonomic"
sections = { u = { v_x = "cos(th)", v_y = "sin(th)" }, w = { v_th = 1 } }
of = { kind = "tangent" }
[lagrangian]
L = "m*((v_x - a*sin(th)*v_th)^2 + (v_y + a*cos(th)*v_th)^2)/2 + J*v_th^2/2"
)toml";

} // namespace

TEST_CASE("a sleigh has sections, their bracket, equations on the constraint, and a constant energy")
{
    CHECK(print_text(constrained_equations("lagrange", sleigh)) == R"text(sleigh

Lagrangian:  L(x, Y)
  L = m ((a v_th sin(th) - v_x)² + (a v_th cos(th) + v_y)²)/2 + J v_th²/2

sections:  e_α = A_α^a e_a
  e_u = cos(th) e_v_x + sin(th) e_v_y
  e_w = e_v_th

brackets of sections:  [e_α, e_β]^a = ρ(e_α)(A_β^a) - ρ(e_β)(A_α^a) + A_α^c A_β^d C^a_cd
  [e_u, e_w] = sin(th) e_v_x - cos(th) e_v_y

ambient velocities:  Y^a = A_α^a y^α
   v_x = u cos(th)
   v_y = u sin(th)
  v_th = w

kinematics:  ẋ^i = ρ^i_a Y^a
        ẋ = u cos(th)
        ẏ = u sin(th)
  d/dt th = w

momenta:  p_α = ∂l/∂y^α,  l = L on the constraint
  p_u = m u
  p_w = m a² w + J w

equations of motion (momentum form):  ṗ_α = -P_a [e_α, Y]^a,  P_a = ∂L/∂Y^a
  ṗ_u = m a w²
  ṗ_w = -m a u w

equations of motion (acceleration form):  W_αβ ẏ^β = -P_a [e_α, Y]^a
           m u̇ = m a w²
  (m a² + J) ẇ = -m a u w

energy:  E = Y^a P_a - L
  E = m u²/2 + (m a² + J) w²/2

energy balance:  Ė = 0
  Ė = 0
)text");
}

TEST_CASE("reactions, projected brackets and the form on D* of a sleigh")
{
    const std::string reactions = print_text(constrained_equations("reaction", sleigh));
    CHECK(reactions.find("lambda_v_x = -m J u w sin(th)/(m a² + J)") != std::string::npos);
    CHECK(reactions.find("lambda_v_th = 0") != std::string::npos);
    CHECK(print_text(constrained_equations("projected", sleigh)).find("[e_u, e_w] = -(m a/(m a² + J)) e_w") !=
          std::string::npos);
    const std::string hamilton = print_text(constrained_equations("hamilton", sleigh));
    CHECK(hamilton.find("{p_u, p_w} = -m a p_w/(m a² + J)") != std::string::npos);
    CHECK(hamilton.find("J(x, p_u, p_w) = sin(th)") != std::string::npos);
    const std::string poisson = print_text(constrained_equations("poisson", sleigh));
    CHECK(hamilton.ends_with(poisson.substr(poisson.find("\n\n"))));
}

TEST_CASE("sections and their brackets are written in LaTeX and JSON")
{
    const EquationSet equations = constrained_equations("lagrange", sleigh);
    CHECK(print_latex(equations).find("[e_{u}, e_{w}] &= ") != std::string::npos);
    CHECK(print_json(equations).find("{\"kind\": \"commutator\", \"symbol\": \"u\", \"other\": \"w\"}, \"groups\": "
                                     "[{\"label\": \"\", \"value\": \"sin(th)\", \"basis\": [\"v_x\"]}") !=
          std::string::npos);
}

TEST_CASE("Jacobi's identity of almost Poisson brackets is decided, not read off a formula")
{
    // Involutive: v_z of e_u is x, written so that no expansion sees it.
    const std::string flat =
        "[base]\ncoordinates = [\"x\", \"y\", \"z\"]\n[fibre]\ncoordinates = [\"u\", \"w\"]\n[algebroid]\n"
        "kind = \"nonholonomic\"\n[algebroid.of]\nkind = \"tangent\"\n[algebroid.sections]\n"
        "u = { v_x = 1, v_z = \"sin(2*y)/2 - sin(y)*cos(y) + x\" }\nw = { v_y = 1 }\n"
        "[lagrangian]\nL = \"(v_x^2 + v_y^2 + v_z^2)/2\"\n";
    CHECK(print_text(constrained_equations("poisson", flat)).find("Jacobiator") == std::string::npos);
    const std::string moved = print_text(constrained_equations("poisson", flat + "[forces]\nv_x = 1\n"));
    CHECK(moved.find("df/dt = {h, f}") == std::string::npos);
}

TEST_CASE("where terms of third degree cancel, Hamilton's form is as without them or says what is undecided")
{
    const auto with = [&](const std::string& coefficient) {
        std::string text = sleigh;
        return text.replace(text.find("J*v_th^2/2"), 10, "J*v_th^2/2 + (" + coefficient + ")*v_th^3");
    };
    const std::string plain = print_text(constrained_equations("hamilton", sleigh));
    for (const char* zero : {"x*(y + 1) - x*y - x", "sin(x)^2 + cos(x)^2 - 1", "x^(1/3)*x^(2/3) - x"}) {
        const std::string text = print_text(constrained_equations("hamilton", with(zero)));
        const std::string brackets = text.substr(0, std::min(text.find("Jacobiator"), text.find("statements")));
        CHECK(plain.starts_with(brackets));
        CHECK((text == plain ||
               text.ends_with("  undecided  J(f, g, h) = 0\n             known: L has terms that cancel\n")));
    }
}
