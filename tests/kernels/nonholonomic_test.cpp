// SPDX-License-Identifier: GPL-2.0-or-later
/// Nonholonomic equations against equations that have none of their parts: subbundles, and hand-written ones.
#include "models.hpp"

#include "../support/tolerances.hpp"
#include "elaborate/make_frame.hpp"

#include <cmath>

using namespace lagen;
using namespace lagen::testing;

namespace {

bool nearly_equal(double a, double b)
{
    return std::abs(a - b) <= tolerance::roundoff(64) * (1 + std::abs(b));
}

/// Both have the same rates at random points, which are not zero.
void check_same_rates(const KernelModule& a, const KernelModule& b)
{
    for (unsigned seed = 1; seed < 5; ++seed) {
        const Values point = random_point(a, seed);
        const std::vector<double> first = values_of(a, "rhs", point), second = values_of(b, "rhs", point);
        REQUIRE(first.size() == second.size());
        for (std::size_t k = 0; k < first.size(); ++k) {
            REQUIRE(second[k] != 0);
            CHECK(nearly_equal(first[k], second[k]));
        }
    }
}

/// A charge on spheres about the origin, relativistic, with gravity.
const std::string on_spheres = R"toml(
[lagrangian]
L = "-c^2*sqrt(1 - (v_x^2 + v_y^2 + v_z^2)/c^2) + y*v_x - x*v_y*z - z*x"
)toml";

} // namespace

TEST_CASE("on an involutive distribution the nonholonomic equations are those of the subbundle, for every L",
          "[kernels]")
{
    const std::string head = R"toml(
[parameters]
c = 9
[base]
coordinates = ["x", "y", "z"]
domain = ["c > 0", "y > 0"]
[fibre]
coordinates = ["a", "b"]
)toml";
    const std::string sections = R"({ a = { x = "-y", y = "x" }, b = { y = "-z", z = "y" } })";
    const std::string ambient = R"({ a = { v_x = "-y", v_y = "x" }, b = { v_y = "-z", v_z = "y" } })";
    const Model constrained =
        read_model_text("c.toml", head + "[algebroid]\nkind = \"nonholonomic\"\nsections = " + ambient +
                                      "\nof = { kind = \"tangent\" }\n" + on_spheres);
    const ModelReport report = verify(constrained);
    REQUIRE(report.mechanics.integrable);
    CHECK(report.mechanics.integrable->status == ProofStatus::proved);
    check_same_rates(
        form_kernels(constrained, report),
        kernels_of_text(head + "[algebroid]\nkind = \"subbundle\"\nspanned_by = " + sections + on_spheres));
}

TEST_CASE("a bead on a rod that turns evenly: the constraint and its drift depend on time", "[kernels]")
{
    const KernelModule module = kernels_of_text(R"toml(
[parameters]
m = 2
Om = 3
[base]
coordinates = ["x", "y"]
domain = ["m > 0"]
[fibre]
coordinates = ["u"]
[algebroid]
kind = "nonholonomic"
sections = { u = { v_x = "cos(Om*t)", v_y = "sin(Om*t)" } }
drift = { v_x = "-Om*y", v_y = "Om*x" }
of = { kind = "tangent" }
[lagrangian]
L = "m*(v_x^2 + v_y^2)/2"
)toml");
    for (unsigned seed = 1; seed < 5; ++seed) {
        const Values p = random_point(module, seed);
        const double t = p.at("t"), x = p.at("x"), y = p.at("y"), u = p.at("u"), Om = p.at("Om"), m = p.at("m");
        const double along = x * std::cos(Om * t) + y * std::sin(Om * t);
        const double across = -x * std::sin(Om * t) + y * std::cos(Om * t);
        // r'' - Om^2 r = 0 along the rod; the rod pushes with m (2 Om u - Om^2 (x . n)) n.
        CHECK(nearly_equal(values_of(module, "rhs", p)[2], Om * Om * along));
        const double push = m * (2 * Om * u - Om * Om * across);
        const std::vector<double> reaction = values_of(module, "reaction", p);
        CHECK(nearly_equal(reaction[0], -push * std::sin(Om * t)));
        CHECK(nearly_equal(reaction[1], push * std::cos(Om * t)));
        const double v_x = u * std::cos(Om * t) - Om * y, v_y = u * std::sin(Om * t) + Om * x;
        CHECK(nearly_equal(values_of(module, "energy", p)[0], m * (v_x * v_x + v_y * v_y) / 2));
        CHECK(nearly_equal(values_of(module, "power", p)[0], reaction[0] * -Om * y + reaction[1] * Om * x));
    }
}

TEST_CASE("forces, friction and first-order states of a sleigh are those of the ambient velocities", "[kernels]")
{
    const KernelModule module = kernels_of_text(R"toml(
[parameters]
m = 2
J = 3
k = 1
f = 1
[base]
coordinates = ["x", "y", "th"]
domain = ["m > 0", "J > 0"]
[fibre]
coordinates = ["u", "w"]
[algebroid]
kind = "nonholonomic"
sections = { u = { v_x = "cos(th)", v_y = "sin(th)" }, w = { v_th = 1 } }
of = { kind = "tangent" }
[lagrangian]
L = "m*(v_x^2 + v_y^2)/2 + J*v_th^2/2"
[forces]
v_x = "f + z"
[dissipation]
R = "k*(v_x^2 + v_y^2 + v_th^2)/2"
[states]
z = "v_y*u - z"
[observables]
speed = "v_x*v_x + v_y*v_y"
momentum = "p_u + 2*p_w"
)toml");
    for (unsigned seed = 1; seed < 5; ++seed) {
        const Values p = random_point(module, seed);
        const double th = p.at("th"), u = p.at("u"), w = p.at("w"), z = p.at("z");
        const std::vector<double> rates = values_of(module, "rhs", p);
        CHECK(nearly_equal(rates[3], ((p.at("f") + z) * std::cos(th) - p.at("k") * u) / p.at("m")));
        CHECK(nearly_equal(rates[4], -p.at("k") * w / p.at("J")));
        CHECK(nearly_equal(rates[5], u * std::sin(th) * u - z));
        CHECK(nearly_equal(values_of(module, "observables", p)[0], u * u));
        CHECK(nearly_equal(values_of(module, "observables", p)[1], p.at("m") * u + 2 * p.at("J") * w));
        const std::vector<double> reaction = values_of(module, "reaction", p);
        CHECK(std::abs(std::cos(th) * reaction[0] + std::sin(th) * reaction[1]) < tolerance::roundoff(16));
    }
}

TEST_CASE("constraints that are solved give the rates of sections, and the first free velocities are kept", "[kernels]")
{
    const std::string head = R"toml(
[parameters]
m = 2
J = 3
R = 0.5
[base]
coordinates = ["x", "y", "ph", "th"]
domain = ["m > 0", "J > 0"]
)toml";
    const std::string tail = R"(of = { kind = "tangent" }
[lagrangian]
L = "m*(v_x^2 + v_y^2)/2 + J*(v_ph^2 + v_th^2)/2 + x*v_th - cos(ph)*x^2"
)";
    const std::string constraints = "constraints = [\"v_x - R*cos(ph)*v_th\", \"v_y - R*sin(ph)*v_th + x*v_ph\"]\n";
    const Model solved =
        read_model_text("c.toml", head + "[algebroid]\nkind = \"nonholonomic\"\n" + constraints + tail, {}, choosers());
    REQUIRE(solved.fibre.coordinates.size() == 2);
    CHECK(solved.fibre.coordinates[0].name == "v_ph");
    CHECK(solved.fibre.coordinates[1].name == "v_th");
    const KernelModule by_constraints = kernels_of(solved);
    const KernelModule by_sections = kernels_of_text(
        head + "[fibre]\ncoordinates = [\"a\", \"b\"]\n[algebroid]\nkind = \"nonholonomic\"\n" + constraints +
        "sections = { a = { v_ph = 1, v_y = \"-x\" }, b = { v_th = 1, v_x = \"R*cos(ph)\", v_y = \"R*sin(ph)\" } }\n" +
        tail);
    for (unsigned seed = 1; seed < 5; ++seed) {
        Values point = random_point(by_constraints, seed);
        point["a"] = point["v_ph"];
        point["b"] = point["v_th"];
        const std::vector<double> first = values_of(by_constraints, "rhs", point);
        const std::vector<double> second = values_of(by_sections, "rhs", point);
        for (std::size_t k = 0; k < first.size(); ++k) CHECK(nearly_equal(first[k], second[k]));
        CHECK(values_of(by_constraints, "ambient_velocity", point)[3] == point["v_th"]);
    }
}
