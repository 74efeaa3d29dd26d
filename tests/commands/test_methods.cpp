// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen methods`: every name is a type of the runtime that integrates.
#include "program.hpp"

#include "support/golden.hpp"
#include "support/json.hpp"

#include "commands/scene/methods.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <map>

using namespace lagen::testing;
namespace json = lagen::json;

namespace {

bool takes_oscillator(const lagen::MethodEntry& entry)
{
    using enum lagen::MethodKind;
    return entry.kind != discrete && entry.kind != group && entry.kind != poisson;
}

} // namespace

TEST_CASE("lagen methods names every integrator of the interface")
{
    const json::Value list = json::parse(call({"methods", "--format", "json"}).out);
    std::vector<std::string> names;
    for (const json::Value& entry : list.entries) names.push_back(entry["name"].text);
    for (const char* name : {"euler",        "midpoint",     "rk4",         "dopri5",     "tsit5",
                             "dop853",       "verner65",     "verner76",    "verner87",   "verner98",
                             "rkn64",        "rkn86",        "rkn1210",     "rkng54",     "gauss12",
                             "gauss16",      "blanesmoan4",  "blanesmoan6", "srkn6",      "kahanli8",
                             "sofroniou10",  "rkmk4",        "rkmk_dop853", "gauss_lie4", "crouch_grossman3",
                             "lie_poisson2", "lie_poisson4", "discrete4",   "discrete6",  "discrete8"})
        CHECK(std::count(names.begin(), names.end(), name) == 1);
    CHECK(list.size() == lagen::method_table().size());
    CHECK(list[0].keys ==
          std::vector<std::string>{"name", "order", "adaptive", "separable_only", "text", "keeps", "system"});
    const std::string text = call({"methods"}).out;
    CHECK(std::count(text.begin(), text.end(), '\n') == static_cast<std::ptrdiff_t>(list.size()));
    CHECK(text.find("\ndop853           order 8(5,3)  tolerance ") != std::string::npos);
    CHECK(text.find("\nrkn1210          order 12(10)  tolerance ") != std::string::npos);
    std::map<std::string, std::string> systems, kept;
    for (const json::Value& entry : list.entries) {
        systems[entry["name"].text] = entry["system"].text;
        kept[entry["name"].text] = entry["keeps"].text;
    }
    CHECK(systems["verner98"].empty());
    CHECK(systems["rkn64"] == "x'' = f(t, x)");
    CHECK(systems["rkng54"] == "x'' = f(t, x, x')");
    CHECK(systems["yoshida6"] == "x' = f(y), y' = g(x) or a sum of exact flows");
    CHECK(systems["srkn6"] == "x' = M y + c, y' = g(x)");
    CHECK(kept["gauss4"] == "symplectic");
    CHECK(kept["mclachlan4"] == "symplectic");
    CHECK(kept["kahanli8"] == "symplectic");
    CHECK(kept["rkn64"].empty());
    CHECK(systems["rkmk_dop853"] == "states that a group moves linearly");
    CHECK(kept["rkmk_dop853"] == "group, orbits, Casimirs");
    CHECK(systems["lie_poisson4"] == "Lie-Poisson systems");
    CHECK(kept["lie_poisson4"] == "Poisson, group, orbits, Casimirs");
    CHECK(systems["discrete8"] == "discrete Lagrangians of order 2 with L(g, h) = -L(g^-1, -h)");
    CHECK(kept["discrete8"] == "symplectic or Poisson, momenta, the group");
}

TEST_CASE("lagen methods --stability tells how long the steps of every method may be")
{
    const json::Value list = json::parse(call({"methods", "--stability", "--format", "json"}).out);
    std::map<std::string, const json::Value*> by_name;
    for (const json::Value& entry : list.entries) {
        CHECK(entry.keys ==
              std::vector<std::string>{"name", "order", "calls", "imaginary", "real", "a_stable", "l_stable"});
        by_name[entry["name"].text] = &entry;
    }
    CHECK(by_name.size() == 47); // those on groups have the limits of the methods that they are made of
    const auto number = [&](const char* method, const char* key) {
        return std::strtod((*by_name.at(method))[key].text.c_str(), nullptr);
    };
    CHECK(number("rk4", "imaginary") == Approx(2.8284271247461903).epsilon(1e-15));
    CHECK(number("rk4", "real") == Approx(2.785293563405282).epsilon(1e-13));
    CHECK(number("leapfrog_kdk", "imaginary") == Approx(2).epsilon(1e-15));
    CHECK(number("lobatto:3", "imaginary") == Approx(std::sqrt(8.0)).epsilon(1e-15));
    for (const char* method : {"gauss4", "variational2", "variational8"})
        CHECK((*by_name.at(method))["imaginary"].text == "unbounded");
    CHECK((*by_name.at("variational4"))["real"].kind == json::Kind::null);
    CHECK((*by_name.at("kahanli8"))["real"].kind == json::Kind::null);
    CHECK((*by_name.at("radau5"))["calls"].kind == json::Kind::null);
    const std::string text = call({"methods", "--stability"}).out;
    for (const char* line : {"\nrk4           4            4    2.828427    0.707    2.785294\n",
                             "\ndopri5        5(4)         6    0.997189    0.166    3.306568\n",
                             "\nkahanli8      8           17    3.096439    0.182           -\n",
                             "\ngauss6        6            -   unbounded        -   unbounded  A-stable\n",
                             "\nradau5        5(3)         -   unbounded        -   unbounded  A-stable, L-stable\n"})
        CHECK(text.find(line) != std::string::npos);
}

TEST_CASE("every method's type integrates the generated oscillator to its accuracy", "[run]")
{
    const std::string folder = fresh_folder();
    REQUIRE(call({"generate", models_folder() + "/oscillator.toml", "--with", "taylor", "-o", "oscillator.hpp"},
                 {.folder = folder})
                .code == 0);
    std::string calls;
    for (const lagen::MethodEntry& entry : lagen::method_table())
        if (takes_oscillator(entry))
            calls += std::string("    show(lagen::") + entry.type +
                     (entry.adaptive ? "{.tolerance = 1e-8}" : "{.step = 0x1p-9}") + ", " +
                     std::to_string(std::atoi(entry.order)) + ");\n";
    write_text(folder + "/main.cpp", R"(#include "oscillator.hpp"
#include "lagen/integrate.hpp"
#include <cstdio>
template <class Method> void show(const Method& method, int order)
{
    using Model = lagen::models::oscillator<double>;
    const auto run = lagen::integrate(Model{}, Model::state({.x = 1}, {.v = 0}), {0.0, 1.0}, method);
    const double error = std::abs(run.state[0] - std::cos(1.0)) + std::abs(run.state[1] + std::sin(1.0));
    const double allowed = std::max(1e-7, 2 * std::pow(0x1p-9, order));
    std::puts(run && run.t == 1.0 && error <= allowed ? "good" : "bad");
}
int main()
{
)" + calls + "}\n");
    const Shell build =
        run_shell("c++ -std=c++20 -O0 -I" LAGEN_SOURCE_DIR "/runtime/include $(pkg-config --cflags eigen3) -I" +
                  folder + " " + folder + "/main.cpp -o " + folder + "/main");
    INFO(build.output);
    REQUIRE(build.status == 0);
    std::string expected;
    for (const lagen::MethodEntry& entry : lagen::method_table())
        if (takes_oscillator(entry)) expected += "good\n";
    CHECK(run_shell(folder + "/main").output == expected);
}
