// SPDX-License-Identifier: GPL-2.0-or-later
/// Scenes with known least models (tests/data/scenes): as many states as there must be, and the motion of the whole
/// system in what is watched. Both systems move by the same classical steps in extended precision.
#include "graph/core/evaluate.hpp"
#include "least/least_model.hpp"
#include "model/scene_form.hpp"
#include "pipeline.hpp"
#include "support/json.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>

using namespace lagen;

namespace {

using Numbers = std::vector<long double>;
using Named = std::map<std::string, long double>;

long double value_of(const Graph& graph, NodeId node, const Named& inputs)
{
    return evaluate<long double>(graph, std::vector{node}, inputs)[0];
}

long double start_time(const Graph& graph, const LaneSystem& system, const Named& inputs)
{
    return system.start_time ? value_of(graph, *system.start_time, inputs) : 0;
}

/// The watched functions at the end of a short motion.
Numbers watched_at_end(const Graph& graph, const LaneSystem& system, Named inputs, long double length)
{
    constexpr int steps = 64;
    Numbers s;
    for (const auto& start : system.start) s.push_back(value_of(graph, start.value(), inputs));
    const auto put = [&](const Numbers& state, long double t) {
        for (std::size_t i = 0; i < state.size(); ++i) inputs[graph.input_name(system.lanes[i])] = state[i];
        inputs[graph.input_name(system.time)] = t;
    };
    const long double h = length / steps, start = start_time(graph, system, inputs);
    for (int step = 0; step < steps; ++step) {
        const long double t = start + h * step;
        Numbers sum = s, place = s, k;
        for (const auto& [c, b] : {std::pair{0.0L, 1.0L}, {0.5L, 2.0L}, {0.5L, 2.0L}, {1.0L, 1.0L}}) {
            for (std::size_t i = 0; i < s.size(); ++i) place[i] = k.empty() ? s[i] : s[i] + c * h * k[i];
            put(place, t + c * h);
            k = evaluate<long double>(graph, system.rates, inputs);
            for (std::size_t i = 0; i < s.size(); ++i) sum[i] += h * b * k[i] / 6;
        }
        s = sum;
    }
    put(s, start + length);
    Numbers out;
    for (const NamedNode& each : system.watched) out.push_back(value_of(graph, each.node, inputs));
    return out;
}

/// A tenth of the time in which the fastest lane changes by its size.
long double short_time(const Graph& graph, const LaneSystem& system, Named inputs)
{
    for (std::size_t i = 0; i < system.lanes.size(); ++i)
        inputs[graph.input_name(system.lanes[i])] = value_of(graph, system.start[i].value(), inputs);
    inputs[graph.input_name(system.time)] = start_time(graph, system, inputs);
    const Numbers rates = evaluate<long double>(graph, system.rates, inputs);
    long double fastest = 1;
    for (std::size_t i = 0; i < rates.size(); ++i)
        fastest = std::max(fastest, std::abs(rates[i]) / (1 + std::abs(inputs[graph.input_name(system.lanes[i])])));
    return 0.1L / fastest;
}

void check_motion(const LeastModel& least)
{
    const Graph& graph = *least.full.graph;
    Named inputs;
    for (const auto& [parameter, value] : least.full.values)
        inputs[graph.input_name(parameter)] = value_of(graph, value, {});
    const long double length = short_time(graph, least.full, inputs);
    const Numbers whole = watched_at_end(graph, least.full, inputs, length);
    for (const StartConstant& constant : least.reduction.constants)
        inputs[graph.input_name(constant.input)] = value_of(graph, constant.value.value(), inputs);
    const Numbers part = watched_at_end(graph, least.reduction.system, inputs, length);
    REQUIRE(part.size() == whole.size());
    for (std::size_t k = 0; k < part.size(); ++k) {
        INFO(least.full.watched[k].name);
        CHECK(std::abs(part[k] - whole[k]) <= 1e-9L * (1 + std::abs(whole[k])));
    }
}

LeastModel least_of(const CheckedModel& checked, const std::string& name)
{
    const Scene& written = find_scene(checked.model, name);
    const Scene scene = in_form(checked.model, written, form_of(checked.model, written));
    return least_model(lane_system(checked.model, checked.system, checked.report, scene));
}

} // namespace

TEST_CASE("least models have as many states as there must be, certified, and move as the whole does")
{
    std::size_t scenes = 0, smaller = 0;
    for (const auto& file : std::filesystem::directory_iterator(LAGEN_SOURCE_DIR "/tests/data/scenes")) {
        if (file.path().extension() != ".json") continue;
        const json::Value truth = json::read_file(file.path().string());
        std::filesystem::path path = file.path();
        const CheckedModel checked = load(path.replace_extension(".toml").string(), {}, false);
        const Model& model = checked.model;
        for (std::size_t k = 0; k < truth["scenes"].size(); ++k) {
            const json::Value& due = truth["scenes"][k];
            const std::string& name = truth["scenes"].keys[k];
            INFO(model.name << ", scene " << name);
            const LeastModel least = least_of(checked, name);
            const std::size_t count = least.reduction.system.lanes.size();
            CHECK(least.full.lanes.size() == std::stoul(due["full_states"].text));
            std::vector<std::string> right{due["least_states"].text};
            if (due.has("also_right"))
                for (const std::string& each : due["also_right"].texts()) right.push_back(each);
            CHECK(std::ranges::find(right, std::to_string(count)) != right.end());
            CHECK(least.rank.rank == count);
            check_motion(least);
            ++scenes;
            if (count < least.full.lanes.size()) ++smaller;
        }
    }
    CHECK(scenes == 41);
    CHECK(smaller == 30); // of 31: with a mass of 1e-30 the total momentum is not seen, and 12 states are right too
}

TEST_CASE("what looks like less and is not stays")
{
    struct Trap {
        const char* model;
        const char* scene;
        std::size_t states;
    };
    for (const auto& [name, scene, states] :
         {Trap{"parameter_of_another", "default", 2},
          Trap{"parameter_of_another", "s", 4},       // k = c - 1, and c is the scene's
          Trap{"conserved_with_time", "default", 2},  // y + z - t from t = 2 on
          Trap{"wall_that_is_crossed", "default", 3}, // x > 0 as x^2 > 0, which x^2 touches only
          Trap{"energy_that_jumps", "default", 6},    // with atan2 in the potential
          Trap{"stand_in_undefined", "default", 3}}) {
        INFO(name << ", scene " << scene);
        const CheckedModel checked =
            load(std::string(LAGEN_SOURCE_DIR "/tests/data/scenes/traps/") + name + ".toml", {}, false);
        const LeastModel least = least_of(checked, scene);
        CHECK(least.reduction.system.lanes.size() == states);
        check_motion(least);
    }
}
