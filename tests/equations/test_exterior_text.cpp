// SPDX-License-Identifier: GPL-2.0-or-later
/// dx^i and de^a as they are printed.
#include "elaborate/elaborate.hpp"
#include "equations/derivations.hpp"
#include "model/read_model.hpp"
#include "typeset/print_equations.hpp"

#include <catch2/catch.hpp>

#include <fmt/core.h>

using namespace lagen;

namespace {

EquationSet exterior_of(const std::string& name)
{
    const Model model = read_model(LAGEN_SOURCE_DIR "/models/" + name + ".toml", {});
    return derive_exterior(model, elaborate(model));
}

} // namespace

TEST_CASE("the exterior differential of the heavy top's algebroid as text")
{
    CHECK(print_text(exterior_of("heavy_top")) == R"(Heavy top in body coordinates

differentials of the coordinates:  dx^i = ρ^i_a e^a
  dg1 = g2 e^w3 - g3 e^w2
  dg2 = g3 e^w1 - g1 e^w3
  dg3 = g1 e^w2 - g2 e^w1

differentials of the basis forms:  de^c = -½ C^c_ab e^a∧e^b
  de^w1 = -e^w2∧e^w3
  de^w2 = e^w1∧e^w3
  de^w3 = -e^w1∧e^w2
)");
}

TEST_CASE("the exterior differential in an orthonormal frame of the half-plane as LaTeX and JSON")
{
    const EquationSet set = exterior_of("half_plane");
    const std::string latex = print_latex(set);
    CHECK(latex.find("  dx &= y\\, e^{a} \\\\\n  dy &= y\\, e^{b}\n") != std::string::npos);
    CHECK(latex.find("  de^{a} &= e^{a} \\wedge e^{b} \\\\\n  de^{b} &= 0\n") != std::string::npos);
    const std::string json = print_json(set);
    CHECK(json.find(R"({"left": {"kind": "form", "symbol": "a"}, "groups": [{"label": "", "value": "1", "basis": )"
                    R"(["a", "b"]}]})") != std::string::npos);
    CHECK(json.find(R"({"left": {"kind": "form", "symbol": "b"}, "groups": []})") != std::string::npos);
}

TEST_CASE("coefficients that are sums stand in parentheses before their basis form")
{
    CHECK(print_text(exterior_of("wong")).find("de^q3 = a x (b y + 2) e^u∧e^v + a y e^u∧e^q2") != std::string::npos);
    CHECK(print_text(exterior_of("wong")).find("(c y - a - b² x) e^u∧e^v") != std::string::npos);
}

TEST_CASE("a frame with 16 different denominators has long differentials, and takes no long time")
{
    std::string text =
        "[base]\ncoordinates = ['x1', 'x2', 'x3', 'x4']\n[fibre]\ncoordinates = ['f1', 'f2', 'f3', 'f4']\n"
        "[algebroid]\nkind = 'frame'\n[algebroid.sections]\n";
    for (int a = 1; a <= 4; ++a) {
        text += fmt::format("f{} = {{", a);
        for (int b = 1; b <= 4; ++b)
            text += fmt::format("{} e{} = '({} + x{})/({} + x{}^2)'", b == 1 ? "" : ",", b, a == b ? 5 : a + b - 4,
                                (a + b) % 4 + 1, 1 + a * b, (a + 2 * b) % 4 + 1);
        text += " }\n";
    }
    text += "[algebroid.of]\nkind = 'tangent'\nfibre = ['e1', 'e2', 'e3', 'e4']\n";
    const Model model = read_model_text("frame.toml", text);
    const EquationSet set = derive_exterior(model, elaborate(model));
    std::size_t terms = 0;
    for (const Equation& equation : set.blocks.back().equations) terms += equation.groups.size();
    CHECK(terms == 24);
}

TEST_CASE("the forms of a model stand with their differentials")
{
    const Model model =
        read_model_text("forms.toml", "[base]\ncoordinates = ['x', 'y']\n[algebroid]\nkind = 'tangent'\n"
                                      "[forms]\nf = { degree = 0, value = 'x*y' }\n"
                                      "A = { degree = 1, v_x = 'y^2', v_y = 'sin(x)' }\n"
                                      "F = { degree = 2, 'v_x,v_y' = 'x' }\n");
    const EquationSet set = derive_exterior(model, elaborate(model));
    const std::string text = print_text(set);
    CHECK(text.substr(text.find("forms of")) ==
          R"(forms of the model and their differentials:  dω = ρ_a(ω_I) e^a∧e^I + ω_I de^I
   f = x y
  df = y e^v_x + x e^v_y
   A = y² e^v_x + sin(x) e^v_y
  dA = (cos(x) - 2 y) e^v_x∧e^v_y
   F = x e^v_x∧e^v_y
  dF = 0
)");
    CHECK(print_latex(set).find("  dA &= \\left(\\cos x - 2\\, y\\right)") != std::string::npos);
    CHECK(print_json(set).find(R"({"left": {"kind": "symbol", "symbol": "F"}, "groups": [{"label": "", "value": "x", )"
                               R"("basis": ["v_x", "v_y"]}]})") != std::string::npos);
}
