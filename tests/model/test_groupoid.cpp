// SPDX-License-Identifier: GPL-2.0-or-later
/// Groupoids, discrete Lagrangians and discrete scenes: what a file says is what the record holds.
#include "model/read_model.hpp"
#include "model/scene_form.hpp"
#include "scene/evaluate_scene.hpp"

#include <catch2/catch.hpp>

using lagen::evaluate_scene;
using lagen::find_scene;
using lagen::form_of;
using lagen::GroupoidKind;
using lagen::has_value;
using lagen::Model;
using lagen::Scene;
using lagen::SceneValues;
using lagen::to_text;
using Strings = std::vector<std::string>;

namespace {

const std::string top_of_arrows = R"toml(
[sizes]
n = 3
[parameters]
h = "1/10"
mgl = 2.2
[base]
coordinates = ["G[1..n]"]
[fibre]
coordinates = ["w1", "w2", "w3"]
momenta = ["p1", "p2", "p3"]
[groupoid]
kind = "action"
group = "SO(n)"
element = "g"
action = { G = "transpose(g)*G" }
[definitions]
height = "G[3]"
turn = "trace(g)"
[discrete]
step = "h"
L = "-turn/h - h*mgl*height*cos(t)"
retraction = "exp"
[observables]
cosine = "(turn - 1)/2"
[scene.default]
initial = { G = [0.6, 0, 0.8] }
element = "cay(hat([0.02, -0.01, 2*h]))"
steps = 50
[scene.again]
like = "default"
steps = 7
[scene.momenta]
initial = { G = [0.6, 0, 0.8], p1 = 1, p2 = 2, p3 = "mgl" }
steps = 5
observe = ["state", "g[3,3]", "cosine"]
)toml";

const std::string implied_pairs = R"toml(
[base]
coordinates = ["x", "y[1..2]"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "v_x^2/2"
[discrete]
step = "tau"
scheme = "gauss:2"
[scene.default]
initial = { x = 1, y = [2, 3] }
next = { y = [2.5, 3.5], x = 1.5 }
steps = 3
)toml";

Model read_arrows(const std::string& text)
{
    return lagen::read_model_text("test.toml", "name = \"test\"\n" + text);
}

Strings symbol_list(const std::vector<lagen::Symbol>& symbols)
{
    Strings out;
    for (const lagen::Symbol& symbol : symbols) out.push_back(symbol.name);
    return out;
}

Strings column_list(const Scene& scene)
{
    Strings out;
    for (const lagen::NamedTree& column : *scene.observe) out.push_back(column.name);
    return out;
}

} // namespace

TEST_CASE("an action groupoid keeps its group, its element and its action; its algebroid is computed")
{
    const Model model = read_arrows(top_of_arrows);
    REQUIRE((model.groupoid && model.discrete));
    const lagen::GroupoidBlock& groupoid = *model.groupoid;
    CHECK(groupoid.kind == GroupoidKind::action);
    CHECK(groupoid.group == "SO(3)");
    REQUIRE(groupoid.generators.size() == 3);
    CHECK(groupoid.generators[0].shape == lagen::Shape{lagen::Rank::matrix, 3, 3});
    CHECK(to_text(groupoid.generators[0].entries[5]) == "-1");
    CHECK(symbol_list(groupoid.element).front() == "g[1,1]");
    CHECK((groupoid.element.size() == 9 && groupoid.next.empty() && groupoid.action.size() == 3));
    CHECK(to_text(groupoid.action[0]) == "g[1,1]*G[1] + g[2,1]*G[2] + g[3,1]*G[3]");
    CHECK((model.algebroid.kind == lagen::AlgebroidKind::groupoid && model.algebroid.rank == 3));
    CHECK(model.discrete->step.name == "h");
    CHECK((model.discrete->retraction == "exp" && model.discrete->scheme.empty()));
    CHECK(to_text(model.discrete->lagrangian) == "-(g[1,1] + g[2,2] + g[3,3])/h - h*mgl*G[3]*cos(t)");
}

TEST_CASE("a discrete scene holds its first arrow, and one like it changes what it says itself")
{
    const Model model = read_arrows(top_of_arrows);
    const Scene& first = find_scene(model, "default");
    CHECK(form_of(model, first) == "discrete");
    CHECK((first.element.size() == 9 && first.next.empty() && first.steps == 50));
    const Scene& again = find_scene(model, "again");
    CHECK((again.element.size() == 9 && again.steps == 7));
    const SceneValues values = evaluate_scene(model, first);
    REQUIRE(values.element.size() == 9);
    CHECK(values.element[0].first == "g[1,1]");
    CHECK(static_cast<double>(values.element[0].second) == Approx(1 - 0.02005 / 1.010125));
    CHECK((values.base.size() == 3 && values.next.empty()));
    const Scene& momenta = find_scene(model, "momenta");
    CHECK(momenta.element.empty());
    CHECK(column_list(momenta) == Strings{"G[1]", "G[2]", "G[3]", "g[1,1]", "g[1,2]", "g[1,3]", "g[2,1]", "g[2,2]",
                                          "g[2,3]", "g[3,1]", "g[3,2]", "g[3,3]", "p1", "p2", "p3", "cosine"});
    CHECK(evaluate_scene(model, momenta).momenta.size() == 3);
}

TEST_CASE("a tangent bundle with [discrete] has the pair groupoid, whose targets are named after the base")
{
    const Model model = read_arrows(implied_pairs);
    REQUIRE(model.groupoid);
    CHECK(model.groupoid->kind == GroupoidKind::pair);
    CHECK(symbol_list(model.groupoid->next) == Strings{"x_next", "y_next[1]", "y_next[2]"});
    CHECK((model.discrete->scheme == "gauss:2" && model.discrete->lagrangian == nullptr));
    CHECK(lagen::forms_of(model) == Strings{"discrete", "lagrange", "hamilton"});
    CHECK(form_of(model, find_scene(model, "")) == "discrete");
    const SceneValues values = evaluate_scene(model, find_scene(model, ""));
    REQUIRE(values.next.size() == 3);
    CHECK((values.next[0].first == "x" && values.next[0].second == 1.5L && values.next[2].second == 3.5L));
}

TEST_CASE("a tree over the coordinates of an arrow has a value in the discrete form alone")
{
    const Model model = read_arrows(top_of_arrows);
    CHECK(has_value(model, model.observables[0].value, "discrete"));
    CHECK_FALSE(has_value(model, model.observables[0].value, "lagrange"));
    CHECK(has_value(model, lagen::name("w1"), "lagrange"));
    CHECK(lagen::state_names(model, "discrete").size() == 15);
}

TEST_CASE("generators may be matrices over parameters, and of any expression")
{
    const Model model =
        read_arrows("[parameters]\nk = 2\n[fibre]\ncoordinates = [\"a\", \"b\"]\n[groupoid]\nkind = \"group\"\n"
                    "generators = [[[0, \"k\"], [0, 0]], \"diag([1, -k])\"]\n");
    CHECK(model.groupoid->group.empty());
    CHECK(to_text(model.groupoid->generators[0].entries[1]) == "k");
    CHECK(to_text(model.groupoid->generators[1].entries[3]) == "-k");
    CHECK(symbol_list(model.groupoid->element) == Strings{"W[1,1]", "W[1,2]", "W[2,1]", "W[2,2]"});
}
