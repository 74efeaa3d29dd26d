// SPDX-License-Identifier: GPL-2.0-or-later
/// Hamilton's and Pontryagin's equations, forces and energy balances, character by character.
#include "equations/form_models.hpp"
#include "equations/numbers.hpp"
#include "equations/written_models.hpp"
#include "support/model_equations.hpp"
#include "typeset/print_equations.hpp"

#include <catch2/catch.hpp>

using namespace lagen;

namespace {

/// A block of the text without its title: one equation a line.
std::string text_of_block(const EquationSet& set, const std::string& title)
{
    const std::string text = print_text(set) + "\n";
    const std::size_t begin = text.find("\n" + title + ":");
    REQUIRE(begin != std::string::npos);
    const std::size_t first = text.find('\n', begin + 1) + 1;
    return text.substr(first, text.find("\n\n", begin + 1) - first + 1);
}

std::string formula(const EquationSet& set, const std::string& title)
{
    return block_of(set, title).formula;
}

bool has_block(const EquationSet& set, const std::string& title)
{
    return print_text(set).find("\n" + title + ":") != std::string::npos;
}

} // namespace

TEST_CASE("the heavy top's Hamiltonian form is that of the textbook, with its Poisson brackets")
{
    const std::string text = print_text(written::hamilton(written::heavy_top));
    CHECK(text == "Heavy top\n"
                  "\n"
                  "Hamiltonian (the Legendre transform of L):  H = μ_a y^a - L\n"
                  "  H = p_w1²/(2 I1) + p_w2²/(2 I2) + p_w3²/(2 I3) + mgl g3\n"
                  "\n"
                  "velocities:  y^a = ∂H/∂μ_a\n"
                  "  w1 = p_w1/I1\n"
                  "  w2 = p_w2/I2\n"
                  "  w3 = p_w3/I3\n"
                  "\n"
                  "kinematics:  ẋ^i = ρ^i_a ∂H/∂μ_a\n"
                  "  ġ1 = g2 p_w3/I3 - g3 p_w2/I2\n"
                  "  ġ2 = g3 p_w1/I1 - g1 p_w3/I3\n"
                  "  ġ3 = g1 p_w2/I2 - g2 p_w1/I1\n"
                  "\n"
                  "equations of motion:  μ̇_a = -ρ_a(H) - μ_c C^c_ab ∂H/∂μ_b\n"
                  "  ṗ_w1 = mgl g2 + (1/I3 - 1/I2) p_w2 p_w3\n"
                  "  ṗ_w2 = (1/I1 - 1/I3) p_w1 p_w3 - mgl g1\n"
                  "  ṗ_w3 = (1/I2 - 1/I1) p_w1 p_w2\n"
                  "\n"
                  "Poisson brackets:  {μ_a, x^j} = ρ^j_a,  {μ_a, μ_b} = C^c_ab μ_c;  Ḟ = {H, F}\n"
                  "    {p_w1, g2} = g3\n"
                  "    {p_w1, g3} = -g2\n"
                  "    {p_w2, g1} = -g3\n"
                  "    {p_w2, g3} = g1\n"
                  "    {p_w3, g1} = g2\n"
                  "    {p_w3, g2} = -g1\n"
                  "  {p_w1, p_w2} = p_w3\n"
                  "  {p_w1, p_w3} = -p_w2\n"
                  "  {p_w2, p_w3} = p_w1\n");
}

TEST_CASE("a Hamiltonian of the model's own is taken as it is, with its dependence on time in the balance")
{
    const EquationSet set = written::hamilton(written::rotor);
    CHECK(text_of_block(set, "Hamiltonian") == "  H = M1²/(2 I1) + M2²/(2 I2) + M3²/(2 I3) + M3 cos(t)\n");
    CHECK(text_of_block(set, "velocities") == "  w1 = M1/I1\n  w2 = M2/I2\n  w3 = M3/I3 + cos(t)\n");
    CHECK(text_of_block(set, "equations of motion") == "  Ṁ1 = M2 (M3/I3 + cos(t) - M3/I2)\n"
                                                       "  Ṁ2 = M1 (M3/I1 - M3/I3 - cos(t))\n"
                                                       "  Ṁ3 = M1 M2/I2 - M1 M2/I1\n");
    CHECK(formula(set, "energy balance") == "Ḣ = ∂H/∂t");
    CHECK(text_of_block(set, "energy balance") == "  Ḣ = -M3 sin(t)\n");
    CHECK_FALSE(has_block(set, "kinematics"));
}

TEST_CASE("coupled velocities have a formula, and the equations of motion are written in them")
{
    const EquationSet set = written::hamilton(written::double_pendulum);
    CHECK(text_of_block(set, "velocities") == "  u = (p_v cos(a - b) - p_u)/(cos²(a - b) - 2)\n"
                                              "  v = (p_u cos(a - b) - 2 p_v)/(cos²(a - b) - 2)\n");
    CHECK(formula(set, "kinematics") == "ẋ^i = ρ^i_a y^a");
    CHECK(text_of_block(set, "kinematics") == "  ȧ = u\n  ḃ = v\n");
    CHECK(formula(set, "equations of motion") == "μ̇_a = ρ_a(L)");
    CHECK(text_of_block(set, "equations of motion") == "  ṗ_u = -u v sin(a - b) - 2 sin(a)\n"
                                                       "  ṗ_v = u v sin(a - b) - sin(b)\n");
}

TEST_CASE("a Lagrangian that is not quadratic leaves the velocities implicit")
{
    const EquationSet set = written::hamilton(written::relativistic);
    CHECK(formula(set, "velocities") == "y(x, μ) solves μ_a = ∂L/∂y^a");
    CHECK(text_of_block(set, "velocities") == "  p_v = v/√(1 - v²)\n");
    CHECK(text_of_block(set, "Hamiltonian (the Legendre transform of L, at the velocities below)") ==
          "  H = x²/2 - x sin(t) + v p_v + √(1 - v²)\n");
    CHECK(text_of_block(set, "equations of motion") == "  ṗ_v = sin(t) - x\n");
    CHECK(formula(set, "energy balance") == "Ḣ = -∂L/∂t");
    CHECK(text_of_block(set, "energy balance") == "  Ḣ = -x cos(t)\n");
}

TEST_CASE("forces stand in both forms, rough ones as they are written, and work in the balance of energy")
{
    const EquationSet lagrange = written::lagrange(written::slide);
    CHECK(formula(lagrange, "equations of motion (momentum form)") == "ṗ_a = ρ_a(L) + Q_a");
    const Equation& motion = block_of(lagrange, "equations of motion (acceleration form)").equations.at(0);
    REQUIRE(motion.groups.size() == 2);
    CHECK(motion.groups[1].label == "Q_a");
    CHECK(to_text(motion.groups[1].value) == "-m*v^3 - c*max(v^2, 1)*sign(v)");
    CHECK(formula(lagrange, "energy balance") == "Ė = Q_a y^a - ∂L/∂t");
    CHECK(text_of_block(lagrange, "energy balance") == "  Ė = x sin(t) - m v⁴ - c v max(v², 1) sign(v)\n");
    const EquationSet hamilton = written::hamilton(written::slide);
    CHECK(formula(hamilton, "equations of motion") == "μ̇_a = -ρ_a(H) + Q_a");
    CHECK(text_of_block(hamilton, "equations of motion") ==
          "  ṗ_v = cos(t) - p_v³/m² - c max((p_v/m)², 1) sign(p_v/m)\n");
    CHECK(formula(hamilton, "energy balance") == "Ḣ = ∂H/∂t + Q_a y^a");
}

TEST_CASE("a conservative system has no balance of energy")
{
    CHECK_FALSE(has_block(written::lagrange(written::heavy_top), "energy balance"));
    CHECK_FALSE(has_block(written::hamilton(written::heavy_top), "energy balance"));
    CHECK_FALSE(has_block(written::pontryagin(written::unicycle), "energy balance"));
}

TEST_CASE("the unicycle's extremals have controls, a maximal Hamiltonian and the coadjoint motion of se(2)")
{
    CHECK(print_text(written::pontryagin(written::unicycle)) == "unicycle\n"
                                                                "\n"
                                                                "Hamiltonian:  H = μ_a σ^a - cost\n"
                                                                "  H = mu1 u1 + mu2 u2 - kap u2²/2 - u1²/2\n"
                                                                "\n"
                                                                "section of the controls:  y^a = σ^a(x, u)\n"
                                                                "  y1 = u1\n"
                                                                "  y2 = u2\n"
                                                                "  y3 = 0\n"
                                                                "\n"
                                                                "condition for the controls:  0 = ∂H/∂u^A\n"
                                                                "  0 = mu1 - u1\n"
                                                                "  0 = mu2 - kap u2\n"
                                                                "\n"
                                                                "optimal controls:  u(x, μ)\n"
                                                                "  u1 = mu1\n"
                                                                "  u2 = mu2/kap\n"
                                                                "\n"
                                                                "maximal Hamiltonian:  H_max(x, μ) = H(x, μ, u(x, μ))\n"
                                                                "  H_max = mu2²/(2 kap) + mu1²/2\n"
                                                                "\n"
                                                                "kinematics:  ẋ^i = ρ^i_a σ^a\n"
                                                                "  ẋ = u1 cos(h)\n"
                                                                "  ẏ = u1 sin(h)\n"
                                                                "  ḣ = u2\n"
                                                                "\n"
                                                                "equations of motion:  μ̇_a = -μ_c C^c_ab σ^b\n"
                                                                "  d/dt mu1 = mu3 u2\n"
                                                                "  d/dt mu2 = -mu3 u1\n"
                                                                "  d/dt mu3 = -mu1 u2\n");
}

TEST_CASE("controls that have no formula are left to their condition")
{
    const EquationSet set = written::pontryagin(written::quartic);
    CHECK(text_of_block(set, "condition for the controls") == "  0 = p - u³\n");
    CHECK_FALSE(has_block(set, "optimal controls"));
    CHECK_FALSE(has_block(set, "maximal Hamiltonian"));
    CHECK(text_of_block(set, "equations of motion") == "  ṗ = 2 t x + p\n");
    CHECK(text_of_block(set, "energy balance") == "  Ḣ = -x²\n");
}

TEST_CASE("conditions for the controls may be undefined at u = 0")
{
    const std::string start =
        "name = \"positive\"\n[parameters]\na = 1\n[base]\ncoordinates = [\"x\"]\n[fibre]\nmomenta = "
        "[\"p\"]\n[algebroid]\nkind = \"tangent\"\n[control]\ncontrols = [\"u\"]\nsigma = { v_x = "
        "\"u - x\" }\ncost = ";
    for (const auto& [cost, condition] :
         {std::pair{"\"u*log(u) - u + x^2/4\"", "p - log(u)"}, std::pair{"\"u - log(u)\"", "p + 1/u - 1"},
          std::pair{"\"u - sqrt(u)\"", "p + 1/(2 √u) - 1"}, std::pair{"\"u + 1/u\"", "p + 1/u² - 1"}}) {
        const EquationSet set = written::pontryagin((start + cost + "\n").c_str());
        CHECK(text_of_block(set, "condition for the controls") == "  0 = " + std::string(condition) + "\n");
        CHECK_FALSE(has_block(set, "optimal controls"));
    }
}

TEST_CASE("bounds cut the control, and there is no formula for the maximal Hamiltonian")
{
    const EquationSet set = written::pontryagin(written::bounded);
    CHECK(formula(set, "condition for the controls") == "0 = ∂H/∂u^A, or u^A at a bound where H is largest");
    CHECK(text_of_block(set, "optimal controls") == "  u = min(max(q, -top), top)\n  w = p/2\n");
    CHECK_FALSE(has_block(set, "maximal Hamiltonian"));
    const EquationSet convex = written::pontryagin(written::convex);
    CHECK_FALSE(has_block(convex, "optimal controls"));
    CHECK(text_of_block(convex, "bounds of the controls") == "  u ≥ -1\n  u ≤ 1\n");
    CHECK_FALSE(has_block(set, "bounds of the controls"));
}

TEST_CASE("controls of which no maximum is proved are called stationary, and a refuted maximum has no equations")
{
    const std::string start =
        "name = \"swing\"\n[parameters]\nk = 1\n[base]\ncoordinates = [\"x\"]\n[fibre]\nmomenta = "
        "[\"p\"]\n[algebroid]\nkind = \"tangent\"\n[control]\ncontrols = [\"u\"]\nsigma = { v_x = "
        "\"u\" }\n";
    const EquationSet set = written::pontryagin((start + "cost = \"k*u^2/2\"\n").c_str());
    CHECK(text_of_block(set, "stationary controls") == "  u = p/k\n");
    CHECK(formula(set, "stationary controls") == "u(x, μ) with ∂H/∂u^A = 0; that H is largest there is not proved");
    CHECK_FALSE(has_block(set, "optimal controls"));
    CHECK_FALSE(has_block(set, "maximal Hamiltonian"));
    CHECK_THROWS_WITH(
        written::pontryagin((start + "cost = \"-u^2/2\"\n").c_str()),
        "error: the controls of model 'swing' are not solved for: H has no maximum in the control 'u': "
        "d2H/du2 > 0\nhint: H = mu_a sigma^a - cost is maximised: a cost is to be convex in the controls");
}

TEST_CASE("angles print in closed form, beside the other controls, and H with them")
{
    const std::string start = "name = \"boat\"\n[parameters]\nV = 1\n[base]\ncoordinates = [\"x\", \"y\"]\n"
                              "[fibre]\nmomenta = [\"p\", \"q\"]\n[algebroid]\nkind = \"tangent\"\n[control]\n";
    const EquationSet set = written::pontryagin(
        (start + "controls = [\"w\", \"th\"]\nsigma = { v_x = \"V*cos(th) - y + w\", v_y = \"V*sin(th)\" }\n"
                 "cost = \"w^2/2\"\n")
            .c_str());
    CHECK(formula(set, "optimal angles") ==
          "H = a + b cos u + c sin u is largest at u = atan2(c, b), up to whole turns");
    CHECK(text_of_block(set, "optimal angles") == "  th = atan2(V q, V p)\n");
    CHECK(text_of_block(set, "optimal controls") == "  w = p\n");
    CHECK(text_of_block(set, "maximal Hamiltonian") == "  H_max = p²/2 + √(V² p² + V² q²) - y p\n");
    // Of the other control no formula is known.
    const EquationSet open = written::pontryagin(
        (start + "controls = [\"w\", \"th\"]\nsigma = { v_x = \"cos(th) + w\", v_y = \"sin(th)\" }\n"
                 "cost = \"cosh(w)\"\n")
            .c_str());
    CHECK(text_of_block(open, "optimal angles") == "  th = atan2(q, p)\n");
    CHECK_FALSE(has_block(open, "optimal controls"));
    CHECK_FALSE(has_block(open, "maximal Hamiltonian"));
}

TEST_CASE("brackets of functions print in LaTeX and JSON")
{
    const EquationSet set = written::hamilton(written::rotor);
    CHECK(print_latex(set).find("  \\{M_{1}, M_{3}\\} &= -M_{2} \\\\\n") != std::string::npos);
    CHECK(print_json(set).find(
              R"json({"left": {"kind": "bracket", "symbol": "M1", "other": "M3"}, "right": "-M2")json") !=
          std::string::npos);
}

TEST_CASE("a degenerate Lagrangian shows the kernel of W, and has no Hamiltonian form")
{
    const Model model = written::read(written::degenerate);
    const ModelReport verified = verify(model);
    CHECK(text_of_block(derive("lagrange", model, verified), "L is degenerate: kernel of W") ==
          "  k_v_x = -1\n  k_v_y = 1\n");
    CHECK_THROWS_WITH(
        derive("hamilton", model, verified),
        "error: the Lagrangian of model 'degenerate' is degenerate: its momenta p_a = dL/dy^a have rank 1 "
        "of 2, so that it has no Hamiltonian form; Hamilton's equations need [hamiltonian] H");
}

TEST_CASE("a form that the model does not have says what it needs")
{
    CHECK_THROWS_WITH(written::pontryagin(written::rotor),
                      "error: model 'rotor' has no controls; Pontryagin's equations need [control] controls, sigma and "
                      "cost");
    CHECK_THROWS_WITH(written::lagrange(written::rotor),
                      "error: model 'rotor' has no Lagrangian; Lagrange's equations need [lagrangian] L");
    CHECK_THROWS_WITH(written::hamilton(written::unicycle),
                      "error: model 'unicycle' has neither a Hamiltonian nor a Lagrangian; Hamilton's equations need "
                      "[hamiltonian] H or [lagrangian] L");
}
