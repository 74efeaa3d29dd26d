// SPDX-License-Identifier: GPL-2.0-or-later
/// What a model file says is what the record holds: order, exactness, defaults, positions.
#include "expression/parse.hpp"
#include "model/read_model.hpp"

#include <catch2/catch.hpp>

using lagen::Model;
using lagen::read_model_text;
using lagen::to_text;

namespace {

std::vector<std::string> names(const std::vector<lagen::Symbol>& symbols)
{
    std::vector<std::string> out;
    for (const lagen::Symbol& symbol : symbols) out.push_back(symbol.name);
    return out;
}

using Strings = std::vector<std::string>;

const std::string top = R"toml(
title = "Heavy top in body coordinates"
[parameters]
zeta = 1
alpha = 2
mgl = "zeta*alpha*beta"
beta = 0.1
[base]
coordinates = ["g1", "g2", "g3"]
constraints = ["g1^2 + g2^2 + g3^2 - 1"]
casimirs    = { a = "g1^2+g2^2+g3^2" }
domain      = ["g3 > -2"]
[fibre]
coordinates = ["w1", "w2", "w3"]
momenta     = ["p1", "p2", "p3"]
[algebroid.anchor]
w3 = { g1 = "g2", g2 = "-g1" }
w1 = { g2 = "g3", g3 = "-g2" }
[algebroid.bracket]
"w3 ,  w1" = { w2 = "1" }
"w1,w2" = { w3 = "1" }
"w2,w1" = { w3 = "-1" }
"w1,w3" = { w3 = "2" }
[definitions]
T = "(zeta*w1^2 + alpha*w2^2 + w3^2)/2"
"V(q)" = "mgl*q"
[lagrangian]
L = "T - V(g3) + 0*a"
[observables]
height = "g3"
twice = "2*height + p1 + max(g1, 0)"
[invariants]
area = "w1*g1"
[about]
mgl = { unit = "N m", text = "weight", latex = "mgl" }
height = { unit = "m" }
[scene.second]
like = "first"
initial = { g3 = 1 }
duration = 3
[scene.first]
initial = { g1 = 0, g2 = 0.6, g3 = 0.8, w1 = "alpha/10" }
rest = true
project = true
sample = 0.5
parameters = { beta = 3 }
method = "dop853"
observe = ["state", "height", "energy", "lagrangian", "w1^2"]
[scene.first.events]
low = { when = "g3 - min(area, p2)", direction = "falling", stop = true, count = 3 }
)toml";

} // namespace

TEST_CASE("names keep the order of the file")
{
    const Model model = read_model_text("heavy_top.toml", top);
    CHECK(model.name == "heavy_top");
    CHECK(lagen::symbol_names(model) == Strings{"zeta", "alpha", "mgl", "beta", "g1", "g2", "g3", "w1", "w2", "w3"});
    CHECK(names(model.fibre.momenta) == Strings{"p1", "p2", "p3"});
    REQUIRE(model.algebroid.anchor.size() == 4);
    CHECK(model.algebroid.anchor[0].section == 2);
    CHECK(model.algebroid.anchor[0].coordinate == 0);
    CHECK(to_text(model.algebroid.anchor[3].value) == "-g2");
    CHECK(model.definitions[0].name == "T");
    CHECK(model.definitions[1].parameters == Strings{"q"});
    REQUIRE(model.scenes.size() == 2);
    CHECK(model.scenes[0].name == "second");
}

TEST_CASE("both orders of a bracket pair and a pair of equals are all recorded")
{
    const Model model = read_model_text("heavy_top.toml", top);
    const auto& bracket = model.algebroid.bracket;
    REQUIRE(bracket.size() == 4);
    CHECK((bracket[0].a == 2 && bracket[0].b == 0 && bracket[0].c == 1));
    CHECK((bracket[2].a == 1 && bracket[2].b == 0 && to_text(bracket[2].value) == "-1"));
    CHECK((bracket[3].a == 0 && bracket[3].b == 2 && bracket[3].c == 2));
}

TEST_CASE("decimals, bare or quoted, are exact")
{
    const Model model = read_model_text("m.toml", "[parameters]\na = 0.1\nb = '0.1'\nc = -1_0.25e1\nd = 0x10\n[base]\n"
                                                  "coordinates = ['q']\n[algebroid]\nkind = 'tangent'\n");
    CHECK(model.parameters[0].value->number == lagen::Rational(1, 10));
    CHECK(model.parameters[1].value->number == lagen::Rational(1, 10));
    CHECK(to_text(model.parameters[2].value) == "-205/2");
    CHECK(model.parameters[3].value->number == 16);
}

TEST_CASE("a tangent algebroid names its fibre and its momenta by default")
{
    const Model model =
        read_model_text("m.toml", "[base]\ncoordinates = ['q', 'k', 'θ']\n[algebroid]\nkind = 'tangent'\n"
                                  "over = ['q', 'θ']\n");
    CHECK(names(model.fibre.coordinates) == Strings{"v_q", "v_θ"});
    CHECK(names(model.fibre.momenta) == Strings{"p_v_q", "p_v_θ"});
    CHECK(model.algebroid.over == std::vector<std::size_t>{0, 2});
}

TEST_CASE("expressions are closed: definitions, functions and Casimirs are expanded")
{
    const Model model = read_model_text("heavy_top.toml", top);
    CHECK(to_text(model.lagrangian) == "(zeta*w1^2 + alpha*w2^2 + w3^2)/2 - mgl*g3 + 0*(g1^2 + g2^2 + g3^2)");
    CHECK(to_text(model.observables[1].value) == "2*g3 + p1 + max(g1, 0)");
    CHECK(to_text(model.base.constraints[0]) == "g1^2 + g2^2 + g3^2 - 1");
    CHECK(to_text(model.base.domain[0]) == "g3 > -2");
    CHECK(model.base.casimirs[0].name == "a");
}

TEST_CASE("a scene that is like another starts as its copy")
{
    const Model model = read_model_text("heavy_top.toml", top);
    const lagen::Scene& scene = lagen::find_scene(model, "second");
    REQUIRE(scene.initial.size() == 6); // two are at rest
    CHECK(to_text(scene.initial[2].value) == "1");
    CHECK(to_text(scene.initial[3].value) == "alpha/10");
    CHECK(to_text(scene.initial[5].value) == "0");
    CHECK(scene.rest);
    CHECK(scene.project);
    CHECK(scene.method == "dop853");
    CHECK(to_text(scene.duration) == "3");
    CHECK(scene.sampling.kind == lagen::Sampling::Kind::interval);
    CHECK(scene.parameters[0].name == "beta");
    REQUIRE(scene.events.size() == 1);
    CHECK(scene.events[0].direction == lagen::Direction::falling);
    CHECK(scene.events[0].stop);
    CHECK(scene.events[0].count == 3);
    CHECK(to_text(scene.events[0].when) == "g3 - min(w1*g1, p2)");
    CHECK_FALSE(lagen::find_scene(model, "first").duration);
}

TEST_CASE("observed columns are states, observables, built-in quantities and expressions, in the order asked for")
{
    const Model model = read_model_text("heavy_top.toml", top);
    const auto& observe = *lagen::find_scene(model, "first").observe;
    REQUIRE(observe.size() == 10);
    CHECK(observe[0].name == "g1");
    CHECK(observe[5].name == "w3");
    CHECK((observe[6].name == "height" && to_text(observe[6].value) == "g3"));
    CHECK((observe[7].name == "energy" && to_text(observe[7].value) == "energy"));
    CHECK((observe[8].name == "lagrangian" && lagen::same_tree(observe[8].value, model.lagrangian)));
    CHECK((observe[9].name == "w1^2" && to_text(observe[9].value) == "w1^2"));
}

TEST_CASE("[about] reaches symbols, and what is no symbol is noted")
{
    const Model model = read_model_text("heavy_top.toml", top);
    CHECK(model.parameters[2].symbol.unit == "N m");
    CHECK(model.parameters[2].symbol.text == "weight");
    REQUIRE(model.notes.size() == 1);
    CHECK((model.notes[0].name == "height" && model.notes[0].unit == "m"));
}

TEST_CASE("without a name the default scene is found, else the first")
{
    const Model model = read_model_text("heavy_top.toml", top);
    CHECK(lagen::find_scene(model, "").name == "second");
    CHECK_THROWS_WITH(lagen::find_scene(model, "secnd"), Catch::Contains("did you mean 'second'?"));
}

TEST_CASE("a setting replaces a parameter in the file and in every scene")
{
    const Model model = read_model_text("m.toml", top, {{"beta", lagen::whole_text("<--set>", "alpha/4")}});
    CHECK(to_text(model.parameters[3].value) == "alpha/4");
    CHECK(to_text(model.parameters[2].value) == "zeta*alpha*beta");
    CHECK(lagen::find_scene(model, "first").parameters.empty());
}

TEST_CASE("dotted keys, inline tables and sub-tables say the same")
{
    const std::string head = "[base]\ncoordinates = ['x']\n[fibre]\ncoordinates = ['a']\n";
    for (const char* anchor : {"[algebroid.anchor]\na = { x = 'x^2' }\n", "[algebroid.anchor.a]\nx = 'x^2'\n",
                               "[algebroid]\nanchor.a.x = 'x^2'\n", "[algebroid]\nanchor = { a = { x = 'x^2' } }\n"}) {
        const Model model = read_model_text("m.toml", head + anchor);
        REQUIRE(model.algebroid.anchor.size() == 1);
        CHECK(to_text(model.algebroid.anchor[0].value) == "x^2");
    }
}

TEST_CASE("positions inside strings count the characters of the file, escapes included")
{
    const std::string text =
        "[base]\ncoordinates = [\"q\"]\n[algebroid]\nkind = \"tangent\"\n[lagrangian]\nL = \"v_q^2/2 \\u002d θ*q\"\n";
    try {
        (void)read_model_text("m.toml", text);
        FAIL("θ is unknown");
    } catch (const lagen::ModelError& error) {
        const lagen::SourceRange where = error.diagnostic().where;
        CHECK(text.substr(where.begin, where.end - where.begin) == "θ");
    }
}

TEST_CASE("a byte order mark and line ends of two characters change nothing")
{
    const Model model =
        read_model_text("m.toml", "\xEF\xBB\xBF[base]\r\ncoordinates = [\"x\"]\r\n[algebroid]\r\nkind = \"tangent\"\r\n"
                                  "[lagrangian]\r\nL = '''\r\nv_x^2/2\r\n - x'''\r\n");
    CHECK(to_text(model.lagrangian) == "v_x^2/2 - x");
    CHECK(model.base.coordinates[0].where.begin == 27);
}

TEST_CASE("invariants and observables may use momenta, energy and each other; unused definitions are read too")
{
    const std::string head =
        "[base]\ncoordinates = ['q']\n[fibre]\ncoordinates = ['v']\n[algebroid]\nkind = 'tangent'\n";
    const Model model = read_model_text("m.toml", head + "[invariants]\nspin = 'p_v + energy'\n[observables]\n"
                                                         "double = '2*spin'\n[definitions]\nkinetic = 'p_v^2/2'\n");
    CHECK(to_text(model.invariants[0].value) == "p_v + energy");
    CHECK(to_text(model.observables[0].value) == "2*(p_v + energy)");
    CHECK_THROWS_WITH(read_model_text("m.toml", head + "[definitions]\nunused = 'w'\n"),
                      Catch::Contains("m.toml:8:11: error: unknown symbol 'w'"));
    CHECK_THROWS_WITH(
        read_model_text("m.toml", head + "[definitions]\nkinetic = 'p_v^2/2'\n[lagrangian]\nL = 'kinetic'\n"),
        Catch::Contains("unknown symbol 'p_v'"));
}

TEST_CASE("expressions from outside may use momenta, energy, observables and invariants by name")
{
    const lagen::Model model = lagen::read_model_text("m.toml", R"(name = "m"
[base]
coordinates = ["x"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "v_x^2/2 - x"
[observables]
height = "2*x"
[invariants]
twice = "2*energy"
)");
    const auto closed = [&](const std::string& text) {
        return lagen::to_text(model.observer.close(lagen::parse_expression(lagen::whole_text("e", text))));
    };
    CHECK(closed("twice - height*p_v_x") == "2*energy - 2*x*p_v_x");
    CHECK(closed("lagrangian + t") == "v_x^2/2 - x + t");
    CHECK_THROWS_AS(model.scope.close(lagen::parse_expression(lagen::whole_text("e", "energy"))), lagen::ModelError);
}
