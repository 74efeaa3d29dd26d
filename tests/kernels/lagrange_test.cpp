// SPDX-License-Identifier: GPL-2.0-or-later
#include "models.hpp"

#include "../support/tolerances.hpp"

#include <cmath>

using namespace lagen;
using namespace lagen::testing;

namespace {

const char* const heavy_top = R"(name = "top"
[parameters]
I1 = 1
I2 = 2
I3 = 3
mgl = "49/10"
k = "2*mgl"
[base]
coordinates = ["g1", "g2", "g3"]
constraints = ["g1^2 + g2^2 + g3^2 - 1"]
domain = ["g3 > -2", "g1 < 3", "g2 != 5"]
[fibre]
coordinates = ["w1", "w2", "w3"]
[algebroid.anchor]
w1 = { g2 = "g3", g3 = "-g2" }
w2 = { g1 = "-g3", g3 = "g1" }
w3 = { g1 = "g2", g2 = "-g1" }
[algebroid.bracket]
"w1,w2" = { w3 = "1" }
"w2,w3" = { w1 = "1" }
"w3,w1" = { w2 = "1" }
[lagrangian]
L = "(I1*w1^2 + I2*w2^2 + I3*w3^2)/2 - mgl*g3"
[observables]
p3 = "p_w3"
total = "energy + 2*lagrangian"
[invariants]
area = "g1*p_w1 + g2*p_w2 + g3*p_w3"
[scene.default]
initial = { g1 = 0, g2 = 0.6, g3 = 0.8, w1 = 0.1, w2 = 0, w3 = 5 }
duration = 1
[scene.default.events]
over = { when = "g3 - p_w3" }
)";

/// I w' = (I w) x w + mgl g x e3, g' = g x w, by hand.
std::vector<double> top_by_hand(const Values& p)
{
    const auto at = [&](const char* name) { return p.at(name); };
    const double g1 = at("g1"), g2 = at("g2"), g3 = at("g3"), w1 = at("w1"), w2 = at("w2"), w3 = at("w3");
    const double I1 = at("I1"), I2 = at("I2"), I3 = at("I3"), mgl = at("mgl");
    return {g2 * w3 - g3 * w2,
            g3 * w1 - g1 * w3,
            g1 * w2 - g2 * w1,
            ((I2 - I3) * w2 * w3 + mgl * g2) / I1,
            ((I3 - I1) * w3 * w1 - mgl * g1) / I2,
            (I1 - I2) * w1 * w2 / I3};
}

} // namespace

TEST_CASE("the heavy top moves by Euler's and Poisson's equations", "[kernels]")
{
    const KernelModule module = kernels_of_text(heavy_top);
    for (unsigned seed = 1; seed < 4; ++seed) {
        const Values point = random_point(module, seed);
        const std::vector<double> hand = top_by_hand(point);
        const std::vector<double> values = values_of(module, "rhs", point);
        REQUIRE(values.size() == hand.size());
        for (std::size_t k = 0; k < hand.size(); ++k) {
            REQUIRE(hand[k] != 0);
            CHECK(std::abs(values[k] - hand[k]) <= tolerance::roundoff(16) * (1 + std::abs(hand[k])));
        }
    }
}

TEST_CASE("momenta, energy and lagrangian are names in observables, invariants and events", "[kernels]")
{
    const KernelModule module = kernels_of_text(heavy_top);
    const Values p = random_point(module, 7);
    const double kinetic = (p.at("I1") * p.at("w1") * p.at("w1") + p.at("I2") * p.at("w2") * p.at("w2") +
                            p.at("I3") * p.at("w3") * p.at("w3")) /
                           2;
    const double potential = p.at("mgl") * p.at("g3");
    const auto close = [](double a, double b) {
        return std::abs(a - b) <= tolerance::roundoff(32) * (1 + std::abs(b));
    };
    CHECK(close(values_of(module, "energy", p)[0], kinetic + potential));
    CHECK(close(values_of(module, "lagrangian", p)[0], kinetic - potential));
    CHECK(find_kernel(module, "observables").outputs[0].entry_names == std::vector<std::string>{"p3", "total"});
    CHECK(close(values_of(module, "observables", p)[0], p.at("I3") * p.at("w3")));
    CHECK(close(values_of(module, "observables", p)[1], 3 * kinetic - potential));
    CHECK(close(values_of(module, "events", p)[0], p.at("g3") - p.at("I3") * p.at("w3")));
    CHECK(find_kernel(module, "invariants").outputs[0].entry_names == std::vector<std::string>{"area"});
}

TEST_CASE("a domain becomes values that are positive inside", "[kernels]")
{
    const KernelModule module = kernels_of_text(heavy_top);
    Values p = random_point(module, 7);
    p["g1"] = 1;
    p["g2"] = 2;
    p["g3"] = 0.5;
    CHECK(values_of(module, "domain", p) == std::vector<double>{2.5, 2, 9});
    CHECK(find_kernel(module, "domain").outputs[0].entry_names ==
          std::vector<std::string>{"g3 > -2", "g1 < 3", "g2 != 5"});
    CHECK(values_of(module, "constraints", p) == std::vector<double>{4.25});
}

TEST_CASE("the mass matrix of the heavy top is its three moments, the divisors of the right-hand side", "[kernels]")
{
    const KernelModule module = kernels_of_text(heavy_top);
    const Kernel& mass = find_kernel(module, "mass_matrix");
    REQUIRE(mass.outputs[0].entries.size() == 3);
    for (std::size_t a = 0; a < 3; ++a) {
        CHECK(mass.outputs[0].entries[a].row == a);
        CHECK(mass.outputs[0].entries[a].column == a);
    }
    CHECK(values_of(module, "mass_matrix", {{"I1", 2}, {"I2", 3}, {"I3", 5}}) == std::vector<double>{2, 3, 5});
    CHECK(find_kernel(module, "rhs").checks->pivots == nodes_of(mass));
    CHECK(module.parameter_defaults.size() == 5);
    CHECK(evaluate<double>(*module.graph, module.parameter_defaults, {}) == std::vector<double>{1, 2, 3, 4.9, 9.8});
}

TEST_CASE("a bracket listed as [b, a] is the negative of [a, b]", "[kernels]")
{
    const KernelModule module = kernels_of_text(heavy_top);
    std::string text = heavy_top;
    const std::string listed = "\"w1,w2\" = { w3 = \"1\" }";
    text.replace(text.find(listed), listed.size(), "\"w2,w1\" = { w3 = \"-1\" }");
    const KernelModule other = kernels_of_text(text);
    const Values p = random_point(module, 3);
    const std::vector<double> a = values_of(module, "rhs", p);
    const std::vector<double> b = values_of(other, "rhs", p);
    for (std::size_t k = 0; k < a.size(); ++k) CHECK(a[k] == Approx(b[k]).epsilon(1e-15));
    CHECK(a[3] != 0);
}

TEST_CASE("a hyperregular Lagrangian whose first pivot is zero has accelerations", "[kernels]")
{
    const KernelModule module = kernels_of_text(R"(name = "hyperbolic"
[base]
coordinates = ["x1", "x2"]
[fibre]
coordinates = ["v1", "v2"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "v1*v2 - x1^2 - 3*x1*x2"
)");
    // d/dt v2 = -2 x1 - 3 x2, d/dt v1 = -3 x1
    CHECK(values_of(module, "rhs", {{"t", 0}, {"x1", 1}, {"x2", 2}, {"v1", 5}, {"v2", 7}}) ==
          std::vector<double>{5, 7, -3, -8});
}

TEST_CASE("explicit time in the Lagrangian enters through the momenta", "[kernels]")
{
    const KernelModule module = kernels_of_text(R"(name = "swelling"
[base]
coordinates = ["x"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "exp(t)*v_x^2/2"
)");
    // d/dt (e^t v) = 0: v' = -v
    const std::vector<double> ds = values_of(module, "rhs", {{"t", 0.3}, {"x", 1}, {"v_x", 2}});
    CHECK(ds[0] == 2);
    CHECK(std::abs(ds[1] + 2) <= tolerance::roundoff(4));
    CHECK(find_kernel(module, "rhs").checks->pivots.size() == 1);
}
