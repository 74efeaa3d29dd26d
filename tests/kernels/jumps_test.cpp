// SPDX-License-Identifier: GPL-2.0-or-later
/// Jumps of events as maps of the state: simultaneous, in Hamilton's form by Legendre's transform, and by name.
#include "models.hpp"

#include "support/tolerances.hpp"

using namespace lagen;
using namespace lagen::testing;

namespace {

const std::string bead = R"toml(name = "bead"
[parameters]
m = 2
e = 0.5
[base]
coordinates = ["q", "r"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "m*(1 + q^2)*v_q^2/2 + v_r^2/2"
[states]
hits = 0
path = "v_q"
[scene.a]
initial = { q = 1, r = 0, v_q = -1, v_r = 0 }
[scene.a.events]
wall = { when = "q", jump = { q = "r", r = "q", v_q = "-e*v_q", hits = "hits + 1" } }
mark = { when = "r" }
[scene.b]
like = "a"
form = "hamilton"
[scene.b.events]
wall = { when = "q", jump = { p_v_q = "-p_v_q" } }
[scene.c]
like = "a"
observe = ["q"]
)toml";

KernelModule bead_kernels(const std::string& scene, const std::string& form)
{
    const Model model = read_model_text("test.toml", bead);
    KernelRequest request;
    request.form = form;
    request.scene = scene.empty() ? nullptr : &find_scene(model, scene);
    return kernels_of(model, request);
}

/// The entries of the column of the first jump, in the order of the lanes.
std::vector<double> lanes_behind(const KernelModule& module, const Values& point)
{
    const KernelOutput& output = find_kernel(module, "jumps").outputs[0];
    const std::vector<double> entries = values_of(module, "jumps", point);
    std::vector<double> lanes(output.shape.rows, 0);
    for (std::size_t k = 0; k < entries.size(); ++k)
        if (output.entries[k].column == 0) lanes[output.entries[k].row] = entries[k];
    return lanes;
}

} // namespace

TEST_CASE("a jump sets what it names, all at once, and leaves the rest", "[kernels]")
{
    const Values point{{"m", 2}, {"e", 0.5}, {"q", 0.25}, {"r", 3}, {"v_q", -4}, {"v_r", 5}, {"hits", 6}, {"path", 7}};
    CHECK(lanes_behind(bead_kernels("a", "lagrange"), point) == std::vector<double>{3, 0.25, 2, 5, 7, 7});
    const KernelModule few = bead_kernels("c", "lagrange"); // nobody looks at the states, but the jump does at one
    CHECK(few.groups.size() >= 2);
    CHECK(lanes_behind(few, point) == std::vector<double>{3, 0.25, 2, 5, 7});
}

TEST_CASE("a jump of fibre coordinates gives momenta at the point behind it", "[kernels]")
{
    // p = m (1 + q^2) v_q: before the jump v_q = p/(m (1 + 1/16)), behind it q is r = 3
    const double v = -4, p = 2 * (1 + 0.0625) * v;
    const Values point{{"m", 2},     {"e", 0.5},   {"q", 0.25}, {"r", 3},
                       {"p_v_q", p}, {"p_v_r", 5}, {"hits", 6}, {"path", 7}};
    const std::vector<double> lanes = lanes_behind(bead_kernels("a", "hamilton"), point);
    REQUIRE(lanes.size() == 6);
    CHECK(lanes[0] == 3);
    CHECK(lanes[1] == 0.25);
    CHECK(std::abs(lanes[2] - 2 * (1 + 9) * (-0.5 * v)) < 40 * tolerance::roundoff(64));
    CHECK(lanes[3] == 5);
    CHECK(lanes[4] == 7);
    CHECK(lanes_behind(bead_kernels("b", "hamilton"), point) == std::vector<double>{0.25, 3, -p, 5, 6, 7});
}

TEST_CASE("jumps bear the names of their events, different ones of one name that of the scene in front", "[kernels]")
{
    const auto names = [](const KernelModule& module) { return find_kernel(module, "jumps").outputs[0].entry_names; };
    CHECK(names(bead_kernels("", "hamilton")) == std::vector<std::string>{"wall", "b.wall"});
    CHECK(names(bead_kernels("", "lagrange")) == std::vector<std::string>{"wall"});
    CHECK(names(bead_kernels("a", "hamilton")) == std::vector<std::string>{"wall"});
    const std::string text = bead.substr(0, bead.find("[scene.a]"));
    CHECK_FALSE(has_kernel(kernels_of(read_model_text("test.toml", text), {}), "jumps"));
}
