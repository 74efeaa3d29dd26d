// SPDX-License-Identifier: GPL-2.0-or-later
/// Definitions that stay symbols in derived equations: with what the symbols stand for, each equation has the values of
/// the one that is written out.
#include "elaborate/make_frame.hpp"
#include "equations/numbers.hpp"
#include "model/read_model.hpp"
#include "support/dice.hpp"
#include "support/json.hpp"
#include "support/model_equations.hpp"
#include "text/alphabet.hpp"
#include "typeset/print_equations.hpp"
#include "typeset/print_equations_terms.hpp"

#include <catch2/catch.hpp>

#include <filesystem>

using namespace lagen;
using lagen::testing::Dice;

namespace {

struct Elaborated {
    Model model;
    System system;
    Report report;

    [[nodiscard]] EquationSet operator()(const std::string& form, Definitions definitions) const
    {
        EquationSet equations = derive(form, model, system, report, {}, definitions);
        return definitions == Definitions::kept ? with_written_blocks(std::move(equations), model) : equations;
    }
};

Elaborated load(Model model)
{
    System system = elaborate(model);
    Report report = verify(system);
    return {std::move(model), std::move(system), std::move(report)};
}

Elaborated load(const std::string& path)
{
    return load(read_model(LAGEN_SOURCE_DIR "/" + path, {}, choosers()));
}

Elaborated load_text(const std::string& text)
{
    return load(read_model_text("test.toml", text));
}

const std::string cat = "tests/data/models/falling_cat_two_angles.toml";

/// The names in the trees of `set` that its `where` does not explain.
std::set<std::string> open_names(const EquationSet& set)
{
    std::set<std::string> names;
    const auto take = [&](const Tree& tree) {
        for (std::string& each : names_in(tree)) names.insert(std::move(each));
    };
    for (const EquationBlock& block : set.blocks)
        for (const Equation& equation : block.equations)
            for (const auto* groups : {&equation.mass, &equation.groups})
                for (const TermGroup& group : *groups) take(group.value);
    for (const WhereEntry& entry : set.where) take(entry.value);
    for (const WhereEntry& entry : set.where) names.erase(entry.symbol);
    return names;
}

/// Adds what the list says to the values.
void resolve(const EquationSet& set, Values& values)
{
    std::vector<WhereEntry> left = set.where;
    while (!left.empty()) {
        std::vector<WhereEntry> later;
        for (const WhereEntry& entry : left) {
            const double value = Numbers(values)(entry.value);
            if (std::isnan(value))
                later.push_back(entry);
            else
                values[entry.symbol] = value;
        }
        REQUIRE(later.size() < left.size());
        left = std::move(later);
    }
}

/// What each equation says, by its block and left side: the right side, and the entries of its mass matrix.
std::map<std::string, double> values_of(const EquationSet& set, const Values& values)
{
    std::map<std::string, double> result;
    Numbers number(values);
    for (const EquationBlock& block : set.blocks) {
        std::size_t k = 0;
        for (const Equation& equation : block.equations) {
            const bool bracket = equation.left == LeftSide::bracket || equation.left == LeftSide::commutator;
            std::string name = block.title + ": " + (bracket ? "" : std::to_string(k++)) + " " + equation.symbol + " " +
                               equation.other;
            for (const std::string& each : equation.arguments) name += " " + each;
            for (const TermGroup& group : equation.groups) {
                std::string part = name;
                for (const std::string& each : group.basis) part += "^" + each;
                result[part] += number(group.value);
            }
            for (const TermGroup& mass : equation.mass) result[name + " d/dt " + mass.label] += number(mass.value);
        }
    }
    return result;
}

/// Both forms at random points; what one of them leaves out is zero.
void check_same(const Elaborated& derived, const std::string& form, std::size_t& symbols)
{
    INFO(derived.model.name << " " << form);
    const EquationSet flat = derived(form, Definitions::expanded);
    const EquationSet kept = derived(form, Definitions::kept);
    CHECK(flat.where.empty());
    symbols += kept.where.size();
    std::set<std::string> names = open_names(flat);
    names.merge(open_names(kept));
    Dice dice(7);
    for (int point = 0; point < 3; ++point) {
        Values values;
        for (const std::string& name : names) values[name] = 0.3 + static_cast<double>(dice.below(800)) / 1000;
        const std::map<std::string, double> wanted = values_of(flat, values);
        resolve(kept, values);
        std::map<std::string, double> found = values_of(kept, values);
        for (const auto& [name, value] : wanted) found.try_emplace(name, 0);
        for (const auto& [name, value] : found) {
            INFO(name << " at point " << point);
            const auto known = wanted.find(name);
            CHECK(value == Approx(known == wanted.end() ? 0 : known->second).epsilon(1e-9).margin(1e-9));
        }
    }
}

/// A body on an arm with a moment of inertia that depends on the angle.
const std::string arm = R"toml(
name = "arm"
[parameters]
J = 1
m = 2
a = 3
l = 1
[base]
coordinates = ["x"]
[fibre]
coordinates = ["u", "w"]
[algebroid]
kind = "atiyah"
algebra = "R^1"
[definitions]
I = "J + m*(a + l*cos(x))^2"
V = "m*a*cos(x)"
T = "m*l^2*u^2/2 + I*w^2/2"
[lagrangian]
L = "T - V"
[about]
x = { latex = "\\theta" }
u = { latex = "\\dot\\theta" }
)toml";

/// A vector that depends on points.
const std::string spring = R"toml(
name = "spring"
[parameters]
k = 1
c = 2
[base]
coordinates = ["x", "y", "th"]
[fibre]
coordinates = ["u", "v", "w"]
[algebroid]
kind = "tangent"
[definitions]
X = "[x*cos(th) - y*sin(th), x*sin(th) + y*cos(th)]"
[lagrangian]
L = "(u^2 + v^2 + w^2)/2 - k*((X[1] - c)^2 + X[2]^4)/2"
)toml";

/// A connection by definitions on a group that does not commute, and forces that are not smooth.
const std::string turning = R"toml(
name = "turning"
[parameters]
J = 1
m = 2
[base]
coordinates = ["x", "y"]
[fibre]
coordinates = ["u", "v", "a", "b", "c"]
[algebroid]
kind = "atiyah"
algebra = "so(3)"
[algebroid.connection]
x = { a = "A/D", c = "x*y" }
y = { b = "A*D", c = "sin(x)" }
[definitions]
A = "x*sin(y) + y^2*cos(x) + m"
D = "J + m*x^2 + m*y^2*cos(x) + A"
rate = "u*A + v*D + a"
[lagrangian]
L = "(u^2 + v^2)/2 + D*(a^2 + b^2 + c^2)/2 + m*rate^2/2 - A*cos(t)"
[forces]
u = "-max(rate, 0)*A - D*u"
[dissipation]
R = "D*(u^2 + a^2)/2"
)toml";

/// A control problem whose cost and sigma have definitions.
const std::string steered = R"toml(
name = "steered"
[parameters]
k = 2
[base]
coordinates = ["x", "y"]
[algebroid]
kind = "tangent"
[definitions]
D = "1 + k*x^2 + cos(y)^2 + x*sin(y)"
V = "D^2*x + exp(-x^2 - y^2)*D"
[control]
controls = ["p", "q"]
sigma = { v_x = "p*D + y", v_y = "q - V" }
cost = "(D*p^2 + q^2)/2 + V*x"
)toml";

/// A blade on a bowl whose height is a definition: sections, L and forces use it.
const std::string blade_on_bowl = R"toml(
name = "blade_on_bowl"
[parameters]
m = 1.5
J = 0.7
k = 2
[base]
coordinates = ["x", "y", "th"]
domain = ["m > 0", "J > 0"]
[fibre]
coordinates = ["u", "w"]
[definitions]
height = "(x^2 + y^2)/(1 + exp(-x*y)) + x*sin(y)"
slope = "cos(th)*diff(height, x) + sin(th)*diff(height, y)"
I = "J + m*height^2 + k*sin(x)^2*cos(y)"
[algebroid]
kind = "nonholonomic"
[algebroid.sections]
u = { v_x = "cos(th)", v_y = "sin(th)" }
w = { v_th = 1, v_x = "-height*sin(th)", v_y = "height*cos(th)" }
[algebroid.of]
kind = "tangent"
[lagrangian]
L = "m*(v_x^2 + v_y^2 + (slope*v_x)^2)/2 + I*v_th^2/2 - k*height"
[forces]
v_th = "-k*v_th"
)toml";

} // namespace

namespace {

void check_forms(const std::string& path, std::size_t& symbols)
{
    for (const std::string form : {"lagrange", "hamilton", "poisson"}) {
        const Elaborated derived = load(path);
        if (derived.system.distribution && form == "poisson") continue;
        if (derived.report.mechanics.regularity.kind == Regularity::Kind::degenerate && form == "hamilton") continue;
        check_same(derived, form, symbols);
    }
}

} // namespace

TEST_CASE("definitions as symbols leave the equations of cats and a linkage their values", "[all]")
{
    std::size_t symbols = 0;
    for (const std::string& path :
         {std::string("models/four_bar.toml"), std::string("docs/cookbook/falling_cat.toml"), cat})
        check_forms(path, symbols);
    CHECK(symbols > 10);
}

TEST_CASE("definitions as symbols leave every equation its values, in all forms")
{
    std::size_t symbols = 0;
    for (const char* path :
         {"tests/data/models/arenstorf.toml", "models/heavy_top_euler.toml", "models/heavy_top_quaternion.toml",
          "models/heavy_top.toml", "models/sliding_mass.toml", "models/hyperboloids.toml", "models/turntable_ball.toml",
          "models/spherical_pendulum.toml", "models/kepler.toml"})
        check_forms(path, symbols);
    CHECK(symbols > 5);
    for (const std::string& text : {arm, spring, turning}) {
        const std::size_t before = symbols;
        check_same(load_text(text), "lagrange", symbols);
        CHECK(symbols > before);
        check_same(load_text(text), "hamilton", symbols);
    }
    check_same(load_text(turning), "poisson", symbols);
    const std::size_t before = symbols;
    check_same(load_text(steered), "pontryagin", symbols);
    CHECK(symbols > before);
}

TEST_CASE("nonholonomic forms keep definitions as symbols")
{
    for (const std::string form : {"lagrange", "hamilton", "poisson", "reaction", "projected"}) {
        std::size_t symbols = 0;
        check_same(load_text(blade_on_bowl), form, symbols);
        CHECK(symbols > 0);
    }
}

TEST_CASE("a short derivation with a definition reads as in a paper")
{
    const Elaborated derived = load_text(arm);
    const EquationSet set = derived("lagrange", Definitions::kept);
    CHECK(print_text(set) == R"(arm

Lagrangian:  L(x, y)
  L = m l² u²/2 + I w²/2 - m a cos(x)

kinematics:  ẋ^i = ρ^i_a y^a
  ẋ = u

momenta:  p_a = ∂L/∂y^a
  p_u = m l² u
  p_w = I w

equations of motion (momentum form):  ṗ_a = ρ_a(L)
  ṗ_u = m a sin(x) + I_x w²/2
  ṗ_w = 0

equations of motion (acceleration form):  W_ab ẏ^b = ρ_a(L) - (∂²L/∂y^a∂x^i) ρ^i_b y^b,  W_ab = ∂²L/∂y^a∂y^b
  m l² u̇ = m a sin(x) + I_x w²/2
     I ẇ = -I_x u w

energy:  E = y^a p_a - L
  E = m a cos(x) + m l² u²/2 + I w²/2

where:
    I = J + m (a + l cos(x))²
  I_x = -2 m l sin(x) (a + l cos(x))
)");
    const std::string latex = print_latex(set);
    CHECK(latex.find(
              "  m\\, l^{2}\\, \\ddot\\theta &= m\\, a\\, \\sin \\theta + \\frac{I_{\\theta}\\, w^{2}}{2} \\\\\n") !=
          std::string::npos);
    CHECK(latex.find("  p_{\\theta} &= m\\, l^{2}\\, \\dot\\theta \\\\\n") != std::string::npos);
    CHECK(latex.find(R"(\paragraph{where}
\begin{align*}
  I &= J + m\, \left(a + l\, \cos \theta\right)^{2} \\
  I_{\theta} &= -2\, m\, l\, \sin\left(\theta\right)\, \left(a + l\, \cos \theta\right)
\end{align*}
)") != std::string::npos);
    CHECK(print_json(set).find(R"json("where": [{"symbol": "I", "value": "J + m*(a + l*cos(x))^2"}, )json"
                               R"json({"symbol": "I_x", "value": "-2*m*l*sin(x)*(a + l*cos(x))"}]})json") !=
          std::string::npos);
}

TEST_CASE("vectors are shown as vectors, and entry by entry in JSON")
{
    const EquationSet set = load_text(spring)("lagrange", Definitions::kept);
    CHECK(print_text(set).find("  u̇ = k (c - X[1]) cos(th) - 2 k X[2]³ sin(th)\n") != std::string::npos);
    CHECK(print_text(set).ends_with("\nwhere:\n  X = [x cos(th) - y sin(th), x sin(th) + y cos(th)]\n"));
    CHECK(print_latex(set).find("  X &= (x\\, \\cos \\mathit{th} - y\\, \\sin \\mathit{th}, x\\, \\sin \\mathit{th} + "
                                "y\\, \\cos \\mathit{th})\n") != std::string::npos);
    CHECK(print_json(set).find(
              R"json("where": [{"symbol": "X[1]", "value": "x*cos(th) - y*sin(th)"}, {"symbol": "X[2]")json") !=
          std::string::npos);
}

TEST_CASE("a falling cat with two angles fits on two pages")
{
    const Elaborated derived = load(cat);
    for (const std::string form : {"lagrange", "hamilton", "poisson"}) {
        INFO(form);
        const EquationSet set = derived(form, Definitions::kept);
        CHECK(print_text(set).size() < 5'000);
        CHECK(print_latex(set).size() < 12'000);
        CHECK(print_json(set).size() < 12'000);
        std::istringstream lines(print_text(set));
        for (std::string line; std::getline(lines, line);) CHECK(columns_of(line) <= 120);
    }
    const std::string text = print_text(derived("lagrange", Definitions::kept));
    CHECK(text.find("\n   p_w = I w\n") != std::string::npos);
    CHECK(text.find("\n  I ẇ = -I_s1 u1 w - I_s2 u2 w\n") != std::string::npos);
    CHECK(print_text(derived("hamilton", Definitions::kept)).find("\n   w = p_w/I\n") != std::string::npos);
}

TEST_CASE("names that are used once are written out, and names of the model are not taken")
{
    // T and V stand in the energy alone.
    CHECK(load("models/heavy_top.toml")("lagrange", Definitions::kept).where.empty());
    // I_x is a parameter.
    std::string taken = arm;
    taken.replace(taken.find("J = 1"), 5, "J = 1\nI_x = 1");
    const std::string text = print_text(load_text(taken)("lagrange", Definitions::kept));
    CHECK(text.find("     I ẇ = -I_x_ u w\n") != std::string::npos);
}

TEST_CASE("places of joints are written out where sines and cosines leave little of them")
{
    const Elaborated derived = load_text(R"toml(
[parameters]
m1 = 1
m2 = 1
l1 = 1
l2 = 0.8
g = 9.81
[base]
coordinates = ["q1", "q2"]
[algebroid]
kind = "tangent"
[definitions]
P1 = "[l1*cos(q1), l1*sin(q1)]"
P2 = "P1 + [l2*cos(q1 + q2), l2*sin(q1 + q2)]"
[lagrangian]
L = "m1*dot(Dt(P1), Dt(P1))/2 + m2*dot(Dt(P2), Dt(P2))/2 - m1*g*P1[2] - m2*g*P2[2]"
)toml");
    const std::string text = print_text(derived("lagrange", Definitions::kept));
    INFO(text);
    CHECK(text.find("  ṗ_v_q1 = -m2 l2 g cos(q1 + q2) - l1 g (m1 + m2) cos(q1)\n") != std::string::npos);
    CHECK(text.find("P2") == std::string::npos);
    const EquationSet hamilton = derived("hamilton", Definitions::kept);
    const std::string where = print_text(hamilton);
    CHECK(where.find("  W_v_q1_v_q2 = m2 l2 (l1 cos(q2) + l2)\n") != std::string::npos); // other names stay
}
