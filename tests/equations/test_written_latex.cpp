// SPDX-License-Identifier: GPL-2.0-or-later
/// Names of families, vectors and derivatives in LaTeX: what [about] says of a family holds for it as a whole and with
/// letters for indices; no two quantities look alike.
#include "equations/written_blocks.hpp"

using namespace lagen;

namespace {

bool has(const std::string& latex, const std::string& line)
{
    INFO(latex);
    const bool found = latex.find(line) != std::string::npos;
    CHECK(found);
    return found;
}

/// A body that hangs on a sphere; `parameter` pulls it sideways.
std::string bar(const std::string& parameter)
{
    return "[parameters]\n" + parameter + R"toml( = 0.5
mgl = 1
[base]
coordinates = ["g[1..3]"]
constraints = ["dot(g, g) - 1"]
[fibre]
coordinates = ["w[1..3]"]
[algebroid]
kind = "action"
algebra = "so(3)"
[algebroid.anchor]
"w[1]" = { "g[2]" = "g[3]", "g[3]" = "-g[2]" }
"w[2]" = { "g[1]" = "-g[3]", "g[3]" = "g[1]" }
"w[3]" = { "g[1]" = "g[2]", "g[2]" = "-g[1]" }
[lagrangian]
L = "dot(w, w)/2 - mgl*g[3]*)toml" +
           parameter + R"toml("
[about]
g = { latex = "\\Gamma" }
w = { latex = "\\hat\\omega" }
)toml";
}

} // namespace

TEST_CASE("the LaTeX of a family is that of its vectors and of its entries with letters")
{
    const std::string top = print_latex(of_text(bar("c")));
    has(top, "  \\dot{\\Gamma} &= \\Gamma \\times \\hat\\omega\n");
    has(top, "  p_{\\hat\\omega} &= \\hat\\omega\n");
    has(top, "  0 &= \\Gamma \\cdot \\Gamma - 1\n");
    const std::string chain = print_latex(of_file("models/chain.toml"));
    has(chain, "  \\dot{\\alpha}_{i} &= \\omega_{i} \\qquad (i = 1, \\dots, 4)\n");
    has(chain, "\\cos\\left(\\alpha_{i} - \\alpha_{j}\\right)");
    const std::string steps = print_latex(of_file("models/heavy_top_discrete.toml"));
    has(steps, "  \\Gamma_{i,\\mathit{next}} &= \\sum_{j=1}^{3} \\Gamma_{j}\\, W_{ji} \\qquad (i = 1, \\dots, 3)\n");
    has(steps, "  p_{\\omega_1,\\mathit{next}} &= ");
}

TEST_CASE("an axis is not written where a parameter looks like one")
{
    has(print_text(of_text(bar("c"))), "  ẇ = c mgl g × e_3\n");
    const std::string text = print_text(of_text(bar("e3")));
    has(text, "  ẇ[1] = e3 mgl g[2]\n");
    CHECK(text.find("e_3") == std::string::npos);
}

TEST_CASE("entries of a Hessian have their indices below them")
{
    const Model model =
        read_model(LAGEN_SOURCE_DIR "/models/chain.toml", {{"n", whole_text("--set", "3")}}, choosers());
    const std::string latex = print_latex(kept_equations(model, "hamilton"));
    has(latex, "  W_{\\omega_{2},\\omega_{3}} &= ");
    CHECK(latex.find("]") == std::string::npos);
}

TEST_CASE("a name that ends in a mark has the mark in LaTeX")
{
    CHECK(latex_of(add({name("V_x"), name("V_x_")}), EquationSet{}) == "V_{x} + V_{x\\_}");
}

TEST_CASE("names that LaTeX would show alike are told apart, and no index has the letter of a symbol")
{
    const std::string head = "[sizes]\nn = 4\n[parameters]\n\"k[1..n]\" = 1\nk1 = 2\nkappa = 1\n"
                             "[base]\ncoordinates = [\"x[1..n]\"]\n[algebroid]\nkind = \"tangent\"\n[lagrangian]\n"
                             "L = \"sum(i, 1, n, v_x[i]^2 - k[i]*x[i]^2)/2 - k1*x[1] - kappa*x[2]\"\n";
    const std::string latex = print_latex(of_text(head));
    has(latex, "- \\mathit{k1}\\, x_{1}");
    has(latex, "\\sum_{i=1}^{4} \\frac{k_{i}\\, x_{i}^{2}}{2}");
    const std::string lettered = print_latex(of_text(head + "[about]\nkappa = { latex = \"i\" }\n"));
    has(lettered, "\\sum_{j=1}^{4}");
    CHECK(lettered.find("_{i=") == std::string::npos);
}

TEST_CASE("the derivative of a definition with a subscript of its own has it in braces")
{
    const std::string latex = print_latex(of_text(R"toml(
[parameters]
k = 1
[base]
coordinates = ["r", "z"]
domain = ["r > 0"]
[algebroid]
kind = "tangent"
[definitions]
U = "k*exp(-2*r^2*z)*(1 + r*z + r^2*sin(z)) + sqrt(1 + r^2 + z^2) + k*r*z^3"
[lagrangian]
L = "(v_r^2 + v_z^2)/2 - U + U*v_z"
[about]
U = { latex = "V_{\\mathrm{eff}}" }
)toml"));
    has(latex, "{V_{\\mathrm{eff}}}_{r}");
    CHECK(latex.find("V_{\\mathrm{eff}}_{") == std::string::npos);
}
