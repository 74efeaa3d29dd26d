// SPDX-License-Identifier: GPL-2.0-or-later
/// The models of the house: they read, every scene starts on its constraints and in its domain, everything has a unit.
#include "model/read_model.hpp"
#include "scene/evaluate_scene.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <limits>

namespace fs = std::filesystem;

namespace {

constexpr long double machine_epsilon = std::numeric_limits<long double>::epsilon();

lagen::Model house_model(const std::string& name)
{
    return lagen::read_model((fs::path(LAGEN_SOURCE_DIR) / "models" / (name + ".toml")).string());
}

const std::vector<std::string> textbook = {"pendulum",     "double_pendulum", "kepler",     "rigid_body", "heavy_top",
                                           "lagrange_top", "henon_heiles",    "half_plane", "duffing",    "heisenberg"};

} // namespace

TEST_CASE("the ten textbook models read, and each of their scenes has numbers")
{
    for (const std::string& name : textbook) {
        const lagen::Model model = house_model(name);
        INFO(name);
        CHECK(model.name == name);
        CHECK(!model.title.empty());
        CHECK(model.lagrangian);
        REQUIRE(model.scenes.size() >= 2);
        CHECK(model.scenes[0].name == "default");
        for (const lagen::Scene& scene : model.scenes) {
            INFO(scene.name);
            const lagen::SceneValues start = lagen::evaluate_scene(model, scene);
            CHECK(start.base.size() == model.base.coordinates.size());
            CHECK(start.fibre.size() + start.momenta.size() == model.fibre.coordinates.size());
            CHECK(start.duration.value_or(0) > 0);
        }
    }
}

TEST_CASE("every symbol of a textbook model has a unit and a text")
{
    for (const std::string& name : textbook) {
        const lagen::Model model = house_model(name);
        std::vector<lagen::Symbol> symbols = model.base.coordinates;
        symbols.insert(symbols.end(), model.fibre.coordinates.begin(), model.fibre.coordinates.end());
        for (const lagen::Parameter& parameter : model.parameters) symbols.push_back(parameter.symbol);
        for (const lagen::Symbol& symbol : symbols) {
            INFO(name << ": " << symbol.name);
            CHECK(!symbol.unit.empty());
            CHECK(!symbol.text.empty());
        }
    }
}

TEST_CASE("Kepler's scenes start at perihelion and at aphelion of the same ellipse")
{
    const lagen::Model model = house_model("kepler");
    const lagen::SceneValues near = lagen::evaluate_scene(model, lagen::find_scene(model, "default"));
    CHECK(std::fabs(near.base[0].second - 0.4L) <= machine_epsilon);
    CHECK(std::fabs(near.fibre[1].second - 2) <= 4 * machine_epsilon);
    const lagen::SceneValues far = lagen::evaluate_scene(model, lagen::find_scene(model, "infall"));
    CHECK(std::fabs(far.base[0].second + 1.6L) <= 2 * machine_epsilon);
    CHECK(std::fabs(far.fibre[1].second + 0.5L) <= 2 * machine_epsilon);
}
