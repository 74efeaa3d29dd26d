// SPDX-License-Identifier: GPL-2.0-or-later
/// Sizes and families: one key declares, fills or observes many symbols, and the record holds them one by one.
#include "expression/parse.hpp"
#include "model/families.hpp"
#include "model/plain_names.hpp"
#include "model/read_model.hpp"
#include "scene/evaluate_scene.hpp"

#include "support/sanitized.hpp"

#include <catch2/catch.hpp>

namespace {

using lagen::Model;
using lagen::read_model_text;
using lagen::Role;
using lagen::Setting;
using lagen::to_text;
using Texts = std::vector<std::string>;

const std::string crowd = R"toml(
name = "crowd"
[sizes]
n = 3
pairs = "n*(n - 1)/2"
[parameters]
"m[1..n]" = [1, "mass", "2*mass"]
mass = 5
"c[1..pairs]" = 0.5
"W[1..2,1..n]" = [[1, 2, 3], [4, 5, "m[2]"]]
"I[1..2,1..2]" = "identity(2)"
[base]
coordinates = ["x[1..n]", "y"]
constraints = ["[x[1] - x[2], x[3]]"]
domain = ["x[1]^2 + 1 > 0"]
casimirs = { sphere = "dot(x, x)", corner = "[x[1], y]" }
[algebroid]
kind = "tangent"
[definitions]
"T(i)" = "m[i]*v_x[i]^2/2"
[lagrangian]
L = "sum(i, 1, n, T(i)) + v_y^2/2"
[observables]
place = "W*x"
speed = "norm(v_x)"
[invariants]
momentum = "[dot(m, v_x), p_v_y]"
[about]
"x[2]" = { text = "the middle one", latex = "\\xi" }
x = { text = "places", unit = "m", latex = "\\chi" }
W = { latex = "W_0" }
place = { unit = "m" }
[scene.default]
initial = { x = ["m[1]/10", "1/10", 0], y = 1, v_x = 0.25, v_y = 0 }
parameters = { "m[3]" = 7, c = [1, 2, 3] }
observe = ["x", "place", "2*x", "W", "y", "m[n]"]
[scene.other]
like = "default"
initial = { "v_x[ 2 ]" = 8 }
)toml";

Texts symbol_texts(const std::vector<lagen::Symbol>& symbols)
{
    Texts out;
    for (const lagen::Symbol& symbol : symbols) out.push_back(symbol.name);
    return out;
}

Texts tree_names(const std::vector<lagen::NamedTree>& trees)
{
    Texts out;
    for (const lagen::NamedTree& tree : trees) out.push_back(tree.name);
    return out;
}

Texts values_of(const Model& model)
{
    Texts out;
    for (const lagen::Parameter& parameter : model.parameters)
        out.push_back(parameter.symbol.name + " = " + to_text(parameter.value));
    return out;
}

Setting setting(const std::string& name, const std::string& value)
{
    return {name, lagen::whole_text("<--set " + name + ">", value)};
}

/// The message and hint of a crowd with these settings, "" where it is read.
std::string error_with(const std::vector<Setting>& settings)
{
    try {
        (void)read_model_text("crowd.toml", crowd, settings);
    } catch (const lagen::ModelError& error) {
        return error.diagnostic().message + " | " + error.diagnostic().hint;
    }
    return "";
}

} // namespace

TEST_CASE("families are flattened in the order of the file, and remembered")
{
    const Model model = read_model_text("crowd.toml", crowd);
    REQUIRE(model.sizes.size() == 2);
    CHECK((model.sizes[1].name == "pairs" && model.sizes[1].value == 3));
    CHECK(symbol_texts(model.base.coordinates) == Texts{"x[1]", "x[2]", "x[3]", "y"});
    CHECK(symbol_texts(model.fibre.coordinates) == Texts{"v_x[1]", "v_x[2]", "v_x[3]", "v_y"});
    CHECK(symbol_texts(model.fibre.momenta) == Texts{"p_v_x[1]", "p_v_x[2]", "p_v_x[3]", "p_v_y"});
    CHECK(values_of(model) == Texts{"m[1] = 1", "m[2] = mass", "m[3] = 2*mass", "mass = 5", "c[1] = 1/2", "c[2] = 1/2",
                                    "c[3] = 1/2", "W[1,1] = 1", "W[1,2] = 2", "W[1,3] = 3", "W[2,1] = 4", "W[2,2] = 5",
                                    "W[2,3] = m[2]", "I[1,1] = 1", "I[1,2] = 0", "I[2,1] = 0", "I[2,2] = 1"});
    Texts families;
    for (const lagen::Family& family : model.families)
        families.push_back(family.name + " " + to_text(family.shape) + " from " + std::to_string(family.first));
    CHECK(families == Texts{"m a vector of 3 from 0", "c a vector of 3 from 4", "W a 2 x 3 matrix from 7",
                            "I a 2 x 2 matrix from 13", "x a vector of 3 from 0", "v_x a vector of 3 from 0",
                            "p_v_x a vector of 3 from 0"});
    CHECK((model.families[0].role == Role::parameter && model.families[4].role == Role::base));
    CHECK((model.families[5].role == Role::fibre && model.families[6].role == Role::momentum));
}

TEST_CASE("expressions with families close to scalars over the entries")
{
    const Model model = read_model_text("crowd.toml", crowd);
    CHECK(to_text(model.lagrangian) == "m[1]*v_x[1]^2/2 + m[2]*v_x[2]^2/2 + m[3]*v_x[3]^2/2 + v_y^2/2");
    REQUIRE(model.base.constraints.size() == 2);
    CHECK(to_text(model.base.constraints[0]) == "x[1] - x[2]");
    CHECK(to_text(model.base.constraints[1]) == "x[3]");
    CHECK(tree_names(model.base.casimirs) == Texts{"sphere", "corner[1]", "corner[2]"});
}

TEST_CASE("an observable or invariant that is a vector is a family of columns")
{
    const Model model = read_model_text("crowd.toml", crowd);
    CHECK(tree_names(model.observables) == Texts{"place[1]", "place[2]", "speed"});
    CHECK(to_text(model.observables[1].value) == "W[2,1]*x[1] + W[2,2]*x[2] + W[2,3]*x[3]");
    CHECK(tree_names(model.invariants) == Texts{"momentum[1]", "momentum[2]"});
    CHECK(to_text(model.invariants[1].value) == "p_v_y");
}

TEST_CASE("observing a family means its entries, and a vector without a name is numbered behind its text")
{
    const Model model = read_model_text("crowd.toml", crowd);
    CHECK(tree_names(*model.scenes[0].observe) == Texts{"x[1]", "x[2]", "x[3]", "place[1]", "place[2]", "(2*x)[1]",
                                                        "(2*x)[2]", "(2*x)[3]", "W[1,1]", "W[1,2]", "W[1,3]", "W[2,1]",
                                                        "W[2,2]", "W[2,3]", "y", "m[n]"});
    CHECK(to_text((*model.scenes[0].observe)[6].value) == "2*x[2]");
    CHECK(to_text(model.scenes[0].observe->back().value) == "m[3]");
}

TEST_CASE("[about] a family reaches every entry, and an entry's own words win wherever they stand")
{
    const Model model = read_model_text("crowd.toml", crowd);
    const auto& x = model.base.coordinates;
    CHECK((x[0].text == "places" && x[0].unit == "m" && x[0].latex == "\\chi_{1}"));
    CHECK((x[1].text == "the middle one" && x[1].unit.empty() && x[1].latex == "\\xi"));
    CHECK(model.parameters[9].symbol.latex == "{W_0}_{13}");
    REQUIRE(model.notes.size() == 2);
    CHECK((model.notes[1].name == "place[2]" && model.notes[1].unit == "m"));
}

TEST_CASE("a scene gives a family its values at once, by one number, or entry by entry")
{
    const Model model = read_model_text("crowd.toml", crowd);
    const lagen::SceneValues values = lagen::evaluate_scene(model, model.scenes[0]);
    CHECK(values.base[0].second == 0.1L);
    CHECK(values.fibre[1].second == 0.25L);
    CHECK(values.parameters[1].second == 5);
    CHECK(values.parameters[2].second == 7);
    CHECK(values.parameters[6].second == 3);
    const lagen::SceneValues other = lagen::evaluate_scene(model, model.scenes[1]);
    CHECK(other.fibre[0].second == 0.25L);
    CHECK(other.fibre[1].second == 8);
}

TEST_CASE("settings reach sizes, whole families and single entries, in the order given")
{
    CHECK(values_of(read_model_text("crowd.toml", crowd,
                                    {setting("m", "[7, 8, 9]"), setting("m[ 2 ]", "mass/2")}))[1] == "m[2] = mass/2");
    const Model one = read_model_text("crowd.toml", crowd, {setting("m", "4"), setting("c[n]", "6")});
    CHECK(to_text(one.parameters[2].value) == "4");
    CHECK(to_text(one.parameters[6].value) == "6");
    CHECK(tree_names(one.scenes[0].parameters) == Texts{"c[1]", "c[2]"});
    const std::string line = "name = 'm'\n[sizes]\nn = 2\n[base]\ncoordinates = ['x[1..n]']\n[algebroid]\nkind = "
                             "'tangent'\n[lagrangian]\nL = 'dot(v_x, v_x)/n'\n";
    CHECK(to_text(read_model_text("m.toml", line, {setting("n", "2^2 - 1")}).lagrangian) ==
          "(v_x[1]^2 + v_x[2]^2 + v_x[3]^2)/3");
}

TEST_CASE("a setting that fits nothing says so")
{
    CHECK(
        error_with({setting("m", "[1, 2]")}) ==
        "the value set for parameter 'm' is a vector of 2, where a vector of 3 is required | one number stands for all "
        "entries");
    CHECK(error_with({setting("m[4]", "1")}) ==
          "the model has no parameter or size 'm[4]' to set | the entries of 'm' are m[1] to m[3]");
    CHECK(error_with({setting("W[9,1]", "1")}).find("the entries of 'W' are W[1,1] to W[") != std::string::npos);
    CHECK(error_with({setting("mass[1]", "1")}) ==
          "the model has no parameter or size 'mass[1]' to set | 'mass' has no entries");
    CHECK(
        error_with({setting("x[1]", "1")}) ==
        "'x[1]' is a base coordinate, not a parameter | where a scene starts is set by --initial x[1]=1, of `run` and "
        "`sweep`");
    CHECK(error_with({setting("temperature", "1")}) ==
          "the model has no parameter or size 'temperature' to set | known parameters and sizes: m, mass, c, W, I, n, "
          "pairs");
    CHECK(error_with({setting("n", "mass")}) == "the size 'n' names 'mass', which is no size | known sizes: n, pairs");
    CHECK(error_with({setting("n", "-1")}) == "the size 'n' is -1, where an integer from 0 to 4096 is required | ");
    CHECK(error_with({setting("m[0]", "1")}) == "the index is 0 | it is 1 at least");
}

TEST_CASE("a key names a symbol, an entry or a whole family")
{
    const Model model = read_model_text("crowd.toml", crowd);
    const std::vector<lagen::Symbol> symbols = lagen::symbols_of(model, lagen::Role::parameter);
    const auto whole = lagen::resolve_key(symbols, "W");
    REQUIRE(whole);
    CHECK(whole->shape == lagen::Shape{lagen::Rank::matrix, 2, 3});
    CHECK(whole->indices == std::vector<std::size_t>{7, 8, 9, 10, 11, 12});
    const auto entry = lagen::resolve_key(symbols, "W[ 2 , 1 ]");
    REQUIRE(entry);
    CHECK((entry->name == "W[2,1]" && entry->indices == std::vector<std::size_t>{10}));
    CHECK(lagen::resolve_key(symbols, "mass")->indices == std::vector<std::size_t>{3});
    CHECK_FALSE(lagen::resolve_key(symbols, "W[3,1]"));
    CHECK_FALSE(lagen::resolve_key(symbols, "W[1]"));
    CHECK(lagen::declared_names(symbols) == Texts{"m", "mass", "c", "W", "I"});
}

TEST_CASE("a vector in the domain is compared entry by entry, with a scalar or a vector of its shape")
{
    const auto domain_of = [](const std::string& condition) {
        const Model model =
            lagen::read_model_text("test.toml", "[parameters]\n\"m[1..2]\" = 1\n\"k[1..3]\" = 0\n[base]\n"
                                                "coordinates = [\"x[1..2]\"]\ndomain = [\"" +
                                                    condition +
                                                    "\"]\n[algebroid]\nkind = \"tangent\"\n[lagrangian]"
                                                    "\nL = \"dot(v_x, v_x)/2\"\n");
        Texts texts;
        for (const lagen::Tree& tree : model.base.domain) texts.push_back(lagen::to_text(tree));
        return texts;
    };
    CHECK(domain_of("m > 0") == Texts{"m[1] > 0", "m[2] > 0"});
    CHECK(domain_of("1 != x") == Texts{"1 != x[1]", "1 != x[2]"});
    CHECK(domain_of("x < 2*m") == Texts{"x[1] < 2*m[1]", "x[2] < 2*m[2]"});
    CHECK(domain_of("dot(x, m) < 1") == Texts{"x[1]*m[1] + x[2]*m[2] < 1"});
    CHECK_THROWS_WITH(domain_of("k > x"), Catch::StartsWith("test.toml:6:12: error: a vector of 3 is compared"));
}

TEST_CASE("a family of 4096 parameters is read in a moment, and 200 scenes that give it values as well")
{
    std::string text = "name = 'm'\n[parameters]\n'k[1..4096]' = 1\n[base]\ncoordinates = ['x']\n[algebroid]\nkind = "
                       "'tangent'\n";
    constexpr int scenes = LAGEN_SANITIZED ? 20 : 200;
    for (int k = 0; k < scenes; ++k)
        text += "[scene.s" + std::to_string(k) + "]\nparameters = { k = " + std::to_string(k) +
                " }\ninitial = { x = 0, v_x = 0 }\n";
    const Model model = read_model_text("m.toml", text);
    REQUIRE(model.scenes.size() == static_cast<std::size_t>(scenes));
    CHECK(lagen::evaluate_scene(model, model.scenes[scenes - 1]).parameters[4095].second == scenes - 1);
}

TEST_CASE("a name that is a word keeps it in files, whatever stands before it, and others get numbers", "[families]")
{
    using Texts = std::vector<std::string>;
    CHECK(lagen::plain_names({"x[1]", "W[1,2]", "a b", "2", "θ", "x_1", "momentum_", "x[1]"}) ==
          Texts{"x_1_2", "W_1_2", "a_b", "_2", "θ", "x_1", "momentum_", "x_1_3"});
    CHECK(lagen::plain_names({"x[1]"}) == Texts{"x_1"});
    CHECK(lagen::plain_names({"x[1]"}, {"x[1]", "x[2]", "x_1"}) == Texts{"x_1_2"});
    CHECK(lagen::plain_names({"W_1[1]", "W[1,1]"}, {"W[1,1]", "W_1[1]"}) == Texts{"W_1_1_2", "W_1_1"});
    CHECK(lagen::plain_names({"x_1", "x[1]"}, {"x[1]"}) == Texts{"x_1", "x_1_2"});
}

TEST_CASE("a word in a file means the name itself before any that is written so", "[families]")
{
    const std::vector<std::string> inputs{"u[1]", "u[2]", "u_1"}, families{"u[1]", "u[2]"};
    CHECK(lagen::find_plain(inputs, "u_1", inputs) == 2U);
    CHECK(lagen::find_plain(inputs, "u[1]", inputs) == 0U);
    CHECK(lagen::find_plain(inputs, "u_1_2", inputs) == 0U);
    CHECK(lagen::find_plain(families, "u_1", families) == 0U);
    CHECK_FALSE(lagen::find_plain(families, "u_1", inputs)); // a parameter u_1, say
    CHECK_FALSE(lagen::find_plain(families, "u_3", families));
}
