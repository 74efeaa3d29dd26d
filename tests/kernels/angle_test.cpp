// SPDX-License-Identifier: GPL-2.0-or-later
/// Controls that are angles, and stationary controls that are followed, in kernels and in their C++.
#include "models.hpp"

#include "../support/compiled.hpp"
#include "../support/tolerances.hpp"

#include <cmath>

using namespace lagen;
using namespace lagen::testing;

namespace {

std::string plane_problem(const std::string& name, const std::string& control)
{
    return "name = \"" + name +
           "\"\n[parameters]\nk = 2\n[base]\ncoordinates = [\"x\", \"y\"]\ndomain = [\"k > 0\"]\n[fibre]\n"
           "coordinates = [\"a\", \"b\"]\nmomenta = [\"p\", \"q\"]\n[algebroid]\nkind = \"tangent\"\n[control]\n" +
           control;
}

std::vector<double> controls_of(const KernelModule& module, double p, double q)
{
    return values_of(module, "controls", {{"t", 0}, {"k", 2}, {"x", 0.5}, {"y", -0.25}, {"p", p}, {"q", q}});
}

constexpr double pi = 3.14159265358979323846;

const std::string boat =
    plane_problem("boat", "controls = [\"th\"]\nsigma = { a = \"k*cos(th) - y\", b = \"k*sin(th)\" }\ncost = 1\n");
const std::string two_angles =
    plane_problem("two_angles", "controls = [\"u\", \"w\", \"z\"]\nsigma = { a = \"cos(u) + z + x*sin(w + pi/3)\", b = "
                                "\"sin(u) + cos(w + pi/3)\" }\ncost = \"k*z^2/2\"\nguess = { u = \"4*pi + p\" }\n");
const std::string hills =
    plane_problem("hills", "controls = [\"u\", \"w\"]\nsigma = { a = \"cos(u)\", b = "
                           "\"w\" }\ncost = \"w^4/4 - w^2/2 + x*w\"\nguess = { w = \"2 + x\" }\n");

} // namespace

TEST_CASE("a heading is where its costates point", "[kernels]")
{
    const KernelModule module = kernels_of_text(boat);
    REQUIRE(module.implicit.size() == 1);
    CHECK(module.implicit[0].angles);
    CHECK(module.implicit[0].follows);
    for (const double angle : {0.0, 0.5, 2.0, -3.0}) {
        const double p = 0.7 * std::cos(angle), q = 0.7 * std::sin(angle);
        CHECK(controls_of(module, p, q)[0] == Approx(angle).epsilon(1e-14).margin(1e-14));
        const Values point = {{"t", 0}, {"k", 2}, {"x", 0.5}, {"y", -0.25}, {"p", p}, {"q", q}};
        CHECK(values_of(module, "hamiltonian", point)[0] == Approx(2 * 0.7 + 0.25 * p - 1).epsilon(1e-14));
        CHECK(values_of(module, "rhs", point)[1] == Approx(2 * std::sin(angle)).epsilon(1e-14).margin(1e-14));
    }
    CHECK_THROWS_WITH(controls_of(module, 0, 0), Catch::StartsWith("error: there are no controls: "));
}

TEST_CASE("angles stand beside controls that are solved for in other ways", "[kernels]")
{
    const KernelModule module = kernels_of_text(two_angles);
    REQUIRE(module.implicit.size() == 1); // z is q-free and linear: no search
    CHECK(module.implicit[0].name == "angles");
    const std::vector<double> found = controls_of(module, 0.3, -0.4);
    CHECK(std::cos(found[0]) == Approx(0.6).epsilon(1e-13));
    CHECK(std::sin(found[0]) == Approx(-0.8).epsilon(1e-13));
    CHECK(std::abs(found[0] - (4 * pi + 0.3)) <= pi);
    // p x sin(w + pi/3) + q cos(w + pi/3) with x = 1/2
    CHECK(found[1] + pi / 3 == Approx(std::atan2(0.15, -0.4)).epsilon(1e-13));
    CHECK(found[2] == Approx(0.15).epsilon(1e-14));
    const KernelModule both = kernels_of_text(hills);
    REQUIRE(both.implicit.size() == 2);
    CHECK(both.implicit[0].name == "angles");
    CHECK(both.implicit[1].name == "controls");
    CHECK(both.implicit[1].follows);
    const double w = controls_of(both, 1, 0.25)[1];
    CHECK(w > 0.6); // beyond the valley at 0
    CHECK(0.25 - w * w * w + w - 0.5 == Approx(0).margin(1e-13));
}

TEST_CASE("the derivative of an angle is that of atan2", "[kernels]")
{
    const KernelModule module = kernels_of_text(boat);
    const Values point = {{"t", 0}, {"k", 2}, {"x", 0.5}, {"y", -0.25}, {"p", 0.6}, {"q", 0.3}};
    const Kernel& jacobian = find_kernel(module, "jacobian");
    const std::vector<double> values = values_of(module, "jacobian", point);
    const double square = 0.6 * 0.6 + 0.3 * 0.3, sine = 0.3 / std::sqrt(square);
    bool seen = false;
    for (std::size_t k = 0; k < values.size(); ++k) {
        const KernelEntry& entry = jacobian.outputs[0].entries[k];
        if (entry.row != 0 || entry.column != 3) continue;
        seen = true; // d(2 cos th)/dq = -2 sin th * p/(p^2 + q^2)
        CHECK(values[k] == Approx(-2 * sine * 0.6 / square).epsilon(1e-13));
    }
    CHECK(seen);
}

TEST_CASE("a header has the guesses that it follows, and no other does", "[kernels]")
{
    const std::string text = print_header(kernels_of_text(boat));
    for (const char* line :
         {"#include \"lagen/controls.hpp\"", "struct Guess {", "S th = S(std::numeric_limits<real_t<S>>::quiet_NaN());",
          "return nearest_angles(b, c, z);", "[[nodiscard]] status_t<S> follow(S t, const State& s) noexcept"}) {
        INFO(line);
        CHECK(text.find(line) != std::string::npos);
    }
    CHECK(text.find("not_a_maximum") == std::string::npos); // proved: nothing to watch
    CHECK(text.find("newton") == std::string::npos);
    CHECK(print_header(kernels_of_text(hills)).find("Status::not_a_maximum") != std::string::npos);
    const std::string plain = print_header(
        kernels_of_text(plane_problem("plain", "controls = [\"u\"]\nsigma = { a = \"u\" }\ncost = \"cosh(u)\"\n")));
    for (const char* word : {"Guess", "follow", "controls.hpp"}) CHECK(plain.find(word) == std::string::npos);
}

TEST_CASE("compiled angles and followed controls agree with the interpreter in four scalars", "[kernels][compile]")
{
    std::vector<CompiledCase> cases;
    for (const std::string& text : {boat, two_angles, hills}) {
        cases.push_back({kernels_of_text(text), {}});
        // With c = 0 an angle of pi and one of -pi are as near.
        for (const double p : {0.5, text == hills ? 3.0 : -3.0})
            cases.back().points.push_back({{"t", 0.25}, {"k", 2}, {"x", 0.5}, {"y", 1.5}, {"p", p}, {"q", 0.25}});
    }
    compare_compiled("angles", "g++", cases, 400);
    if (run_shell("clang++ --version").status == 0) compare_compiled("angles", "clang++", cases, 400);
}
