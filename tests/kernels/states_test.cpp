// SPDX-License-Identifier: GPL-2.0-or-later
/// First-order states as lanes behind those of a form: their rates, and where they are left out.
#include "models.hpp"

#include "support/tolerances.hpp"

using namespace lagen;
using namespace lagen::testing;

namespace {

const std::string cart = R"toml(name = "cart"
[parameters]
m = 2
tau = "1/4"
c = "1/2"
[base]
coordinates = ["x"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "m*v_x^2/2 - x^4/4"
[forces]
v_x = "pull - c*v_x"
[states]
pull = "(lag[1] - pull)/tau"
"lag[1..2]" = "[x - lag[1], v_x - lag[2]]"
path = "sqrt(1 + v_x^2)"
[observables]
length = "2*path"
[scene.all]
initial = { x = 0, v_x = 1 }
[scene.moves]
like = "all"
observe = ["x"]
[scene.measured]
like = "all"
observe = ["length"]
[scene.stopped]
like = "moves"
events = { far = { when = "lag[2] - 3" } }
)toml";

std::vector<std::string> lanes_in(const std::string& scene, const std::string& form)
{
    const Model model = read_model_text("test.toml", cart);
    KernelRequest request;
    request.form = form;
    request.scene = scene.empty() ? nullptr : &find_scene(model, scene);
    std::vector<std::string> names;
    for (const Quantity& lane : lanes_of(kernels_of(model, request))) names.push_back(lane.name);
    return names;
}

using Names = std::vector<std::string>;

} // namespace

TEST_CASE("first-order states are the last lanes, and those that nobody looks at are left out", "[kernels]")
{
    const Names all{"x", "v_x", "pull", "lag[1]", "lag[2]", "path"};
    CHECK(lanes_in("", "lagrange") == all);
    CHECK(lanes_in("all", "lagrange") == all);
    CHECK(lanes_in("moves", "lagrange") == Names{"x", "v_x", "pull", "lag[1]"});
    CHECK(lanes_in("measured", "lagrange") == Names{"x", "v_x", "pull", "lag[1]", "path"});
    CHECK(lanes_in("stopped", "hamilton") == Names{"x", "p_v_x", "pull", "lag[1]", "lag[2]"});
}

TEST_CASE("rates of first-order states are the same in both forms, and their derivatives those of differences",
          "[kernels]")
{
    const Model model = read_model_text("test.toml", cart);
    const KernelModule lagrange = kernels_of(model);
    KernelRequest request;
    request.form = "hamilton";
    const KernelModule hamilton = kernels_of(model, request);
    Values point = random_point(lagrange, 7);
    point["p_v_x"] = point["m"] * point["v_x"];
    const std::vector<double> ds = values_of(lagrange, "rhs", point), other = values_of(hamilton, "rhs", point);
    REQUIRE(ds.size() == 6);
    CHECK(ds[1] == Approx((point["pull"] - point["c"] * point["v_x"] - std::pow(point["x"], 3)) / point["m"]));
    CHECK(ds[2] == Approx((point["lag[1]"] - point["pull"]) / point["tau"]));
    CHECK(ds[3] == Approx(point["x"] - point["lag[1]"]));
    CHECK(ds[4] == Approx(point["v_x"] - point["lag[2]"]));
    CHECK(ds[5] == Approx(std::sqrt(1 + point["v_x"] * point["v_x"])));
    for (std::size_t k = 2; k < 6; ++k) CHECK(other[k] == Approx(ds[k]).epsilon(1e-14));

    const Kernel& jacobian = find_kernel(lagrange, "jacobian");
    const std::vector<double> entries = values_of(lagrange, "jacobian", point);
    const std::vector<Quantity> lanes = lanes_of(lagrange);
    for (std::size_t k = 0; k < entries.size(); ++k) {
        const KernelEntry& entry = jacobian.outputs[0].entries[k];
        Values after = point, before = point;
        after[lanes[entry.column].name] += 1e-6;
        before[lanes[entry.column].name] -= 1e-6;
        const double slope =
            (values_of(lagrange, "rhs", after)[entry.row] - values_of(lagrange, "rhs", before)[entry.row]) / 2e-6;
        CHECK(entries[k] == Approx(slope).epsilon(1e-7));
    }
    CHECK(entries.size() == 11); // x: 1, v_x: 3, pull: 2, lag: 2 each, path: 1
}

TEST_CASE("a model with first-order states neither splits nor is of second order", "[kernels]")
{
    const KernelModule module = kernels_of_text(cart);
    CHECK(module.second_order.kind == SecondOrder::Kind::no);
    CHECK(module.second_order.obstacle == "pull is neither a coordinate nor a velocity or momentum");
    CHECK(separation_of(module).obstacle == module.second_order.obstacle);
}
