// SPDX-License-Identifier: GPL-2.0-or-later
/// Whether the equations are x'' = f(t, x, x') or x'' = f(t, x), decided on their graph.
#include "models.hpp"

#include "emit/print_header.hpp"

using namespace lagen;
using namespace lagen::testing;

namespace {

using Kind = SecondOrder::Kind;

/// Two coordinates q, x on a tangent bundle with rates u, v.
KernelModule plane(const std::string& lagrangian, const std::string& more = "", const std::string& form = "")
{
    const std::string text = R"(name = "plane"
[parameters]
m = 2
k = 3
[base]
coordinates = ["q", "x"]
[fibre]
coordinates = ["u", "v"]
[algebroid]
kind = "tangent"
)" + more + "[lagrangian]\nL = \"" +
                             lagrangian + "\"\n";
    KernelRequest request;
    request.form = form;
    return kernels_of(read_model_text("test.toml", text), request);
}

void check(const KernelModule& module, Kind kind, const std::string& obstacle)
{
    CHECK(module.second_order.kind == kind);
    CHECK(module.second_order.obstacle == obstacle);
    const std::string line = kind == Kind::general ? "SecondOrder::general;" : "SecondOrder::velocity_free;";
    CHECK((print_header(module).find(line) != std::string::npos) == (kind != Kind::no));
}

} // namespace

TEST_CASE("accelerations that a potential and the time make are free of rates", "[kernels]")
{
    check(plane("m*(u^2 + v^2)/2 - k*q^2*x"), Kind::velocity_free, "");
    check(plane("m*(u^2 + v^2)/2 - q*x*cos(t)"), Kind::velocity_free, "");
    check(plane("m*(u^2 + v^2)/2 + u*v/3 - q^4 - x^2"), Kind::velocity_free, "");
    check(plane("m*(u^2 + v^2)/2 - q^2", "[forces]\nv = \"t^2*q\"\n"), Kind::velocity_free, "");
    // Terms with rates that cancel do not count.
    check(plane("m*(u^2 + v^2)/2 + q*v + x*u - q^2"), Kind::velocity_free, "");
}

TEST_CASE("a rate in an acceleration is found, and named", "[kernels]")
{
    check(plane("m*(u^2 + v^2)/2 - q^2", "[forces]\nv = \"-k*u\"\n"), Kind::general, "v' depends on u");
    check(plane("(1 + x^2)*u^2/2 + v^2/2"), Kind::general, "u' depends on u");
    check(plane("m*(u^2 + v^2)/2 + q*v"), Kind::general, "u' depends on v");
}

TEST_CASE("rates that are no velocities are no system of second order", "[kernels]")
{
    check(plane("m*(u^2 + v^2)/2 - q^2", "", "hamilton"), Kind::no, "q' is not p_u");
    check(plane("(u^2 + v^2)/2 - q^2", "", "hamilton"), Kind::velocity_free, "");
    const auto lie_algebra = kernels_of_text("name = \"body\"\n[fibre]\ncoordinates = [\"a\", \"b\", \"c\"]\n"
                                             "[algebroid]\nkind = \"lie_algebra\"\nalgebra = \"so(3)\"\n"
                                             "[lagrangian]\nL = \"a^2 + 2*b^2 + 3*c^2\"\n");
    check(lie_algebra, Kind::no, "the numbers of base coordinates and of other lanes are 0 and 3");
}

namespace {

void check_split(const KernelModule& module, Separation::Kind kind, const std::string& obstacle)
{
    const Separation found = separation_of(module);
    CHECK(found.kind == kind);
    CHECK(found.obstacle == obstacle);
}

} // namespace

TEST_CASE("constant mass matrices split into drifts that are affine in the rates, and kicks", "[kernels]")
{
    using Split = Separation::Kind;
    check_split(plane("m*(u^2 + v^2)/2 + u*v/3 - k*q^4*x - q*sin(t)"), Split::affine, "");
    check_split(plane("m*(u^2 + v^2)/2 + u*v/3 - q^4 - x^2", "", "hamilton"), Split::affine, "");
    check_split(plane("m*(u^2 + v^2)/2 + t*u - k*q*x", "", "hamilton"), Split::separable, "q' depends on t");
}

TEST_CASE("what does not split names a rate and what it depends on", "[kernels]")
{
    using Split = Separation::Kind;
    check_split(plane("m*(1 + x^2)*u^2/2 + v^2/2"), Split::no, "u' depends on u");
    check_split(plane("m*(1 + x^2)*u^2/2 + v^2/2", "", "hamilton"), Split::no, "q' depends on x");
    check_split(plane("m*(u^2 + v^2)/2 + q*v"), Split::no, "u' depends on v");
}
