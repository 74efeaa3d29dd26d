// SPDX-License-Identifier: GPL-2.0-or-later
/// Scenes in numbers, against values computed by hand.
#include "model/read_model.hpp"
#include "scene/evaluate_scene.hpp"
#include "scene/project_start.hpp"
#include "scene/read_input_table.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

using lagen::evaluate_scene;
using lagen::Model;
using lagen::read_model_text;
using lagen::SceneValues;

namespace {

constexpr long double epsilon = std::numeric_limits<long double>::epsilon();

const std::string circle = R"(
[parameters]
radius = "2*half"
half = "1/2"
[base]
coordinates = ["x", "y"]
constraints = ["x^2 + y^2 - radius^2"]
casimirs = { square = "x^2 + y^2" }
domain = ["x > -10", "y != 7"]
[fibre]
coordinates = ["w"]
[algebroid.anchor]
w = { x = "-y", y = "x" }
)";

SceneValues values(const std::string& scene)
{
    const Model model = read_model_text("circle.toml", circle + "[scene.default]\n" + scene);
    return evaluate_scene(model, model.scenes[0]);
}

} // namespace

TEST_CASE("a scene's numbers follow parameters that follow parameters")
{
    const SceneValues found = values("parameters = { half = 5 }\ninitial = { x = \"radius*3/5\", y = 8 }\nrest = true\n"
                                     "duration = \"2*pi\"\ntolerance = 1e-9\nat = [1, \"half\"]\nstart = 0.5\n");
    CHECK(found.parameters == std::vector<lagen::NamedNumber>{{"radius", 10}, {"half", 5}});
    CHECK(found.base == std::vector<lagen::NamedNumber>{{"x", 6}, {"y", 8}});
    CHECK(found.fibre == std::vector<lagen::NamedNumber>{{"w", 0}});
    CHECK(found.momenta.empty());
    CHECK(found.casimirs == std::vector<lagen::NamedNumber>{{"square", 100}});
    CHECK(std::fabs(*found.duration - 2 * std::acos(-1.0L)) <= 4 * epsilon);
    CHECK(*found.relative == 1e-9L);
    CHECK(*found.absolute == 1e-9L);
    CHECK(found.at == std::vector<long double>{1, 5});
    CHECK(found.start == 0.5L);
}

TEST_CASE("a scene may start from momenta")
{
    const SceneValues found = values("initial = { x = 0.6, y = 0.8, p_w = 3 }\n");
    CHECK(found.fibre.empty());
    CHECK(found.momenta == std::vector<lagen::NamedNumber>{{"p_w", 3}});
}

TEST_CASE("project = true moves the start to the nearest point of the constraints")
{
    const SceneValues found = values("initial = { x = 3.0, y = 4.0, w = 1 }\nproject = true\n");
    CHECK(std::fabs(found.base[0].second - 0.6L) <= 4 * epsilon);
    CHECK(std::fabs(found.base[1].second - 0.8L) <= 4 * epsilon);
}

TEST_CASE("a start that is moved onto the constraints stays on the level of a declared Casimir")
{
    const Model model = read_model_text("bowl.toml", R"(
[base]
coordinates = ["x", "y", "z"]
constraints = ["z - x^2 - y^2"]
casimirs = { height = "z^3" }
[fibre]
coordinates = ["w"]
[algebroid.anchor]
w = { x = "-y", y = "x" }
[scene.default]
initial = { x = 3, y = 4, z = 1, w = 1 }
project = true
)");
    const SceneValues found = evaluate_scene(model, model.scenes[0]);
    CHECK(std::fabs(found.base[0].second - 0.6L) <= 4 * epsilon);
    CHECK(std::fabs(found.base[1].second - 0.8L) <= 4 * epsilon);
    CHECK(std::fabs(found.base[2].second - 1) <= 4 * epsilon);
}

TEST_CASE("a start within 1e-10 of the constraints is left as it is")
{
    const SceneValues found = values("initial = { x = 0.6, y = 0.80000000001, w = 1 }\n");
    CHECK(found.base[1].second == 0.80000000001L);
    CHECK_THROWS_WITH(values("initial = { x = 0.6, y = 0.800000001, w = 1 }\n"),
                      Catch::Contains("misses the constraint"));
}

TEST_CASE("a column u_1 of a table of inputs is the input u_1, and u[1] only where nothing else is called so")
{
    const std::string path = (std::filesystem::temp_directory_path() / "lagen_names_of_inputs.csv").string();
    const auto rows = [&](const std::string& inputs, const std::string& heading) {
        std::ofstream(path) << "t," << heading << "\n0,5\n";
        const Model model = read_model_text(
            "cart.toml", inputs +
                             "\n[base]\ncoordinates = [\"x\"]\n[fibre]\ncoordinates = [\"v\"]\n[algebroid]\n"
                             "kind = \"tangent\"\n[lagrangian]\nL = \"v^2/2\"\n[scene.default]\n"
                             "initial = { x = 0, v = 0 }\nduration = 1\ninputs = \"" +
                             path + "\"\n");
        return lagen::read_input_table(model, model.scenes[0], evaluate_scene(model, model.scenes[0]), 1.0L);
    };
    const std::string both = "[inputs]\n\"u[1..2]\" = [0, 0]\nu_1 = 0\n", family = "[inputs]\n\"u[1..2]\" = [0, 0]\n";
    using Rows = std::vector<std::vector<double>>;
    CHECK(rows(both, "u_1") == Rows{{0, 0, 0, 5}});
    CHECK(rows(both, "u_1_2") == Rows{{0, 5, 0, 0}});
    CHECK(rows(family, "u_1") == Rows{{0, 5, 0}});
    CHECK_THROWS_AS(rows("[parameters]\nu_1 = 3\n" + family, "u_1"), lagen::ModelError);
    std::filesystem::remove(path);
}
