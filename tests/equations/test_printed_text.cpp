// SPDX-License-Identifier: GPL-2.0-or-later
/// Lagrange's equations of textbook models, character by character, and the same in every process.
#include "elaborate/build_algebroid.hpp"
#include "equations/written_models.hpp"
#include "typeset/print_equations.hpp"

#include <catch2/catch.hpp>

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <set>

using namespace lagen;

namespace {

/// The lines of one block of the text, from its title to the next empty line.
std::string block(const EquationSet& set, const std::string& title)
{
    const std::string text = print_text(set) + "\n";
    const std::size_t begin = text.find("\n" + title + ":");
    REQUIRE(begin != std::string::npos);
    return text.substr(begin + 1, text.find("\n\n", begin + 1) - begin);
}

/// The titles, with the groups of the formula that occur.
std::string acceleration(const std::string& groups)
{
    return "equations of motion (acceleration form):  W_ab ẏ^b = " + groups + ",  W_ab = ∂²L/∂y^a∂y^b\n";
}

std::string momentum_form(const std::string& groups)
{
    return "equations of motion (momentum form):  ṗ_a = " + groups + "\n";
}

} // namespace

TEST_CASE("the pendulum's equations read as in a textbook")
{
    CHECK(print_text(written::derived(written::pendulum)) == "Planar pendulum\n"
                                                             "\n"
                                                             "Lagrangian:  L(x, y)\n"
                                                             "  L = m l² w²/2 + m l g cos(theta)\n"
                                                             "\n"
                                                             "kinematics:  ẋ^i = ρ^i_a y^a\n"
                                                             "  d/dt theta = w\n"
                                                             "\n"
                                                             "momenta:  p_a = ∂L/∂y^a\n"
                                                             "  p_w = m l² w\n"
                                                             "\n" +
                                                                 momentum_form("ρ_a(L)") +
                                                                 "  ṗ_w = -m l g sin(theta)\n"
                                                                 "\n" +
                                                                 acceleration("ρ_a(L)") +
                                                                 "  m l² ẇ = -m l g sin(theta)\n"
                                                                 "\n"
                                                                 "energy:  E = y^a p_a - L\n"
                                                                 "  E = m l² w²/2 - m l g cos(theta)\n");
}

TEST_CASE("Kepler's equations keep the root of the squared distance")
{
    const EquationSet set = written::derived(written::kepler);
    CHECK(block(set, "equations of motion (acceleration form)") ==
          acceleration("ρ_a(L)") + "  u̇ = -k x/(x² + y²)^(3/2)\n  v̇ = -k y/(x² + y²)^(3/2)\n");
    CHECK(block(set, "energy") == "energy:  E = y^a p_a - L\n  E = u²/2 + v²/2 - k/√(x² + y²)\n");
}

TEST_CASE("Euler's equations have differences of moments of inertia")
{
    const EquationSet set = written::derived(written::rigid_body);
    CHECK(block(set, "equations of motion (momentum form)") ==
          momentum_form("-p_c C^c_ab y^b") +
              "  ṗ_w1 = w3 p_w2 - w2 p_w3\n  ṗ_w2 = w1 p_w3 - w3 p_w1\n  ṗ_w3 = w2 p_w1 - w1 p_w2\n");
    CHECK(block(set, "equations of motion (acceleration form)") ==
          acceleration("-p_c C^c_ab y^b") +
              "  I1 ẇ1 = (I2 - I3) w2 w3\n  I2 ẇ2 = (I3 - I1) w1 w3\n  I3 ẇ3 = (I1 - I2) w1 w2\n");
    CHECK(print_text(set).find("kinematics") == std::string::npos);
}

TEST_CASE("the heavy top's equations add the moment of the weight")
{
    const EquationSet set = written::derived(written::heavy_top);
    CHECK(block(set, "kinematics") == "kinematics:  ẋ^i = ρ^i_a y^a\n"
                                      "  ġ1 = g2 w3 - g3 w2\n  ġ2 = g3 w1 - g1 w3\n  ġ3 = g1 w2 - g2 w1\n");
    CHECK(block(set, "equations of motion (acceleration form)") == acceleration("ρ_a(L) - p_c C^c_ab y^b") +
                                                                       "  I1 ẇ1 = mgl g2 + (I2 - I3) w2 w3\n"
                                                                       "  I2 ẇ2 = (I3 - I1) w1 w3 - mgl g1\n"
                                                                       "  I3 ẇ3 = (I1 - I2) w1 w2\n");
    CHECK(block(set, "energy") == "energy:  E = y^a p_a - L\n  E = I1 w1²/2 + I2 w2²/2 + I3 w3²/2 + mgl g3\n");
}

TEST_CASE("like terms of two groups are joined in the half-plane's equations")
{
    CHECK(block(written::derived(written::half_plane), "equations of motion (acceleration form)") ==
          acceleration("ρ_a(L) - (∂²L/∂y^a∂x^i) ρ^i_b y^b") + "  (1/y²) u̇ = 2 u v/y³\n  (1/y²) v̇ = (v² - u²)/y³\n");
}

TEST_CASE("time, drift and bracket stand in groups of their own")
{
    const EquationSet set = written::derived(written::driven);
    const Equation& equation = set.blocks.at(3).equations.at(1);
    REQUIRE(equation.mass.size() == 2);
    CHECK(equation.mass[0].label == "a");
    CHECK(to_text(equation.mass[0].value) == "k*cos(x)/4");
    CHECK(to_text(equation.mass[1].value) == "m");
    std::string groups;
    for (const TermGroup& group : equation.groups) groups += group.label + ": " + to_text(group.value) + "\n";
    CHECK(groups == "-(∂²L/∂y^a∂x^i) ρ^i_b y^b: k*y*a^2*sin(x)/4\n"
                    "-∂²L/∂y^a∂t: -cos(t)\n"
                    "-p_c C^c_ab y^b: -m*a^2 - k*a*b*cos(x)/4\n");
}

TEST_CASE("LaTeX has dots over symbols, subscripts and Greek letters")
{
    const std::string pendulum = print_latex(written::derived(written::pendulum));
    CHECK(pendulum.find("\\subsection*{Planar pendulum}\n") == 0);
    CHECK(pendulum.find("  m\\, l^{2}\\, \\dot{\\omega} &= -m\\, l\\, g\\, \\sin \\theta\n\\end{align*}\n") !=
          std::string::npos);
    CHECK(pendulum.find("  p_{\\omega} &= m\\, l^{2}\\, \\omega\n") != std::string::npos);
    CHECK(pendulum.find("  E &= \\frac{m\\, l^{2}\\, {\\omega}^{2}}{2} - m\\, l\\, g\\, \\cos \\theta\n") !=
          std::string::npos);
    const std::string top = print_latex(written::derived(written::heavy_top));
    CHECK(top.find("  I_{1}\\, \\dot{w}_{1} &= \\mathit{mgl}\\, g_{2} + \\left(I_{2} - I_{3}\\right)\\, w_{2}\\, w_{3} "
                   "\\\\\n") != std::string::npos);
}

TEST_CASE("one tree prints as LaTeX with fractions, roots and comparisons")
{
    const EquationSet symbols{"m", "", "lagrange", {{"a", "\\alpha_0"}}, {}};
    const Tree x = name("x");
    CHECK(latex_of(divide(name("a"), call(Function::sqrt, {x})), symbols) == "\\frac{\\alpha_0}{\\sqrt{x}}");
    CHECK(latex_of(compare(Comparison::greater, power(name("a"), number(2)), negate(number(Rational(1, 2)))),
                   symbols) == "{\\alpha_0}^{2} > -\\frac{1}{2}");
    CHECK(latex_of(multiply({add({x, number(1)}), name("v_theta2"), name("θ1")}), symbols) ==
          "\\left(x + 1\\right)\\, v_{\\theta_{2}}\\, \\theta_{1}");
}

TEST_CASE("Stumpff functions and linear systems print in mathematical notation")
{
    const Tree stumpff = call(Function::stumpff, {number(12), add({name("x"), number(1)})});
    const Tree solved = solve_component({name("a"), name("b"), number(0), name("d")}, {name("x"), number(1)}, 1);
    EquationSet set{"m", "", "lagrange", {}, {}};
    CHECK(latex_of(stumpff, set) == "c_{12}\\left(x + 1\\right)");
    CHECK(latex_of(power(stumpff, number(2)), set) == "\\left(c_{12}\\left(x + 1\\right)\\right)^{2}");
    CHECK(latex_of(solved, set) == "\\left(\\begin{pmatrix} a & b \\\\ 0 & d \\end{pmatrix}^{-1} "
                                   "\\begin{pmatrix} x \\\\ 1 \\end{pmatrix}\\right)_{2}");
    set.blocks.push_back(
        {"B", "", "", {{LeftSide::symbol, "r", {}, {{"", stumpff}}}, {LeftSide::symbol, "s", {}, {{"", solved}}}}});
    const std::string text = print_text(set);
    CHECK(text.find("r = c₁₂(x + 1)\n") != std::string::npos);
    CHECK(text.find("s = ([a, b; 0, d]⁻¹ [x; 1])₂\n") != std::string::npos);
}

TEST_CASE("a title with special characters is escaped in LaTeX")
{
    EquationSet set{"m", "50% of {x_1} & \\more^2~#$", "lagrange", {}, {}};
    CHECK(print_latex(set) == "\\subsection*{50\\% of \\{x\\_1\\} \\& \\textbackslash{}more\\textasciicircum{}2"
                              "\\textasciitilde{}\\#\\$}\n");
}

TEST_CASE("JSON names kinds, masses and groups")
{
    const std::string json = print_json(written::derived(written::pendulum));
    CHECK(
        json.find(
            R"json("model": "pendulum", "title": "Planar pendulum", "form": "lagrange", "blocks": [{"title": "kinematics",)json") !=
        std::string::npos);
    CHECK(
        json.find(
            R"json({"left": {"kind": "time_derivative", "symbol": "w", "mass": [{"symbol": "w", "value": "m*l^2"}]}, )json"
            R"json("right": "-m*l*g*sin(theta)", "groups": [{"label": "ρ_a(L)", "value": "-m*l*g*sin(theta)"}]})json") !=
        std::string::npos);
}

TEST_CASE("a long right side is broken before a sign within 120 columns")
{
    EquationSet set{"m", "", "lagrange", {}, {{"block", "", "", {}}}};
    Equation equation{LeftSide::symbol, "s", {}, {}};
    for (int k = 0; k < 40; ++k)
        equation.groups.push_back({"", multiply({name("coefficient"), name("x" + std::to_string(k))})});
    set.blocks[0].equations.push_back(equation);
    const std::string text = print_text(set);
    std::size_t lines = 0;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = text.find('\n', begin);
        CHECK(end - begin <= 120);
        begin = end + 1;
        ++lines;
    }
    CHECK(lines == 10);
    CHECK(text.find("\n      + coefficient x") != std::string::npos);
}

TEST_CASE("a model without a Lagrangian has no Lagrange equations")
{
    const Model model = read_model_text(
        "bare.toml",
        "name = \"bare\"\n[fibre]\ncoordinates = [\"a\"]\n[algebroid]\nkind = \"lie_algebra\"\nalgebra = \"R^1\"\n");
    CHECK_THROWS_WITH(derive_lagrange(model, build_algebroid(model)),
                      "error: model 'bare' has no Lagrangian; Lagrange's equations need [lagrangian] L");
}

// Hidden: what the fresh processes of the next test print.
TEST_CASE("print every written model", "[.print]")
{
    for (const char* text : {written::pendulum, written::kepler, written::rigid_body, written::heavy_top,
                             written::half_plane, written::driven}) {
        const EquationSet set = written::derived(text);
        std::cout << print_text(set) << print_latex(set) << print_json(set);
    }
}

TEST_CASE("twenty fresh processes print the same bytes")
{
    const std::string command = "'" + std::filesystem::read_symlink("/proc/self/exe").string() + "' '[.print]'";
    std::set<std::string> outputs;
    for (int run = 0; run < 20; ++run) {
        FILE* const pipe = popen(command.c_str(), "r");
        REQUIRE(pipe != nullptr);
        std::string output;
        char buffer[4096];
        for (std::size_t size = 0; (size = fread(buffer, 1, sizeof buffer, pipe)) > 0;) output.append(buffer, size);
        REQUIRE(pclose(pipe) == 0);
        outputs.insert(output);
    }
    CHECK(outputs.size() == 1);
    CHECK(outputs.begin()->find("I1 ẇ1 = mgl g2 + (I2 - I3) w2 w3") != std::string::npos);
}
