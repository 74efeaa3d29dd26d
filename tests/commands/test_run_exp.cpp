// SPDX-License-Identifier: GPL-2.0-or-later
/// Schemes with retraction = "exp": a free rotor, the free body against an iteration by hand, rotations by more than
/// pi in a step, and measured orders on groups, action and Atiyah groupoids.
#include "scheme_models.hpp"

#include <array>

using namespace lagen::testing;
using namespace lagen::testing::schemes;
namespace json = lagen::json;

namespace {

using Vector = std::array<double, 3>;

constexpr SchemeModel body{"body", R"toml(
[fibre]
coordinates = ["w1", "w2", "w3"]
[groupoid]
kind = "group"
group = "SO(3)"
[lagrangian]
L = "(1.2*w1^2 + 2.1*w2^2 + 2.9*w3^2)/2"
)toml",
                           "{ w1 = 0.4, w2 = 0.9, w3 = -0.3 }"};

constexpr SchemeModel rotor{"rotor", R"toml(
[fibre]
coordinates = ["w"]
[groupoid]
kind = "group"
group = "SO(2)"
[lagrangian]
L = "1.7*w^2/2"
)toml",
                            "{ w = 1.3 }"};

constexpr SchemeModel planar{"planar", R"toml(
[fibre]
coordinates = ["w", "u", "v"]
[groupoid]
kind = "group"
group = "SE(2)"
[lagrangian]
L = "(1.3*w^2 + 2*u^2 + 2.9*v^2)/2 + 0.3*w*u"
)toml",
                             "{ w = 0.9, u = 0.5, v = -0.4 }"};

constexpr SchemeModel rigid{"rigid", R"toml(
[fibre]
coordinates = ["a", "b", "c", "u", "v", "w"]
[groupoid]
kind = "group"
group = "SE(3)"
[lagrangian]
L = "(1.3*a^2 + 1.7*b^2 + 2.2*c^2 + 2*u^2 + 2.9*v^2 + 2.5*w^2)/2 + 0.3*a*u"
)toml",
                            "{ a = 0.9, b = 0.2, c = -0.4, u = 0.5, v = -0.4, w = 0.3 }"};

Vector operator+(const Vector& a, const Vector& b)
{
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

Vector operator*(double s, const Vector& a)
{
    return {s * a[0], s * a[1], s * a[2]};
}

Vector cross(const Vector& a, const Vector& b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double inner(const Vector& a, const Vector& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double distance(const Vector& a, const Vector& b)
{
    const Vector d = a + -1.0 * b;
    return std::sqrt(inner(d, d));
}

/// mu = dexp^-T(xi) I xi/h
Vector momentum(const Vector& xi, double h)
{
    const double a = std::sqrt(inner(xi, xi)), f = 1 / (a * a) - (1 + std::cos(a)) / (2 * a * std::sin(a));
    const Vector p{1.2 * xi[0] / h, 2.1 * xi[1] / h, 2.9 * xi[2] / h};
    return p + 0.5 * cross(xi, p) + f * cross(xi, cross(xi, p));
}

/// xi of these momenta, by Newton's method with differences from xi = h I^-1 mu.
Vector solved(const Vector& mu, double h)
{
    Vector xi{h * mu[0] / 1.2, h * mu[1] / 2.1, h * mu[2] / 2.9};
    for (int k = 0; k < 20; ++k) {
        std::array<Vector, 3> c;
        for (std::size_t b = 0; b < 3; ++b) {
            Vector step{};
            step[b] = 1e-6;
            c[b] = 5e5 * (momentum(xi + step, h) + -1.0 * momentum(xi + -1.0 * step, h));
        }
        const Vector off = momentum(xi, h) + -1.0 * mu;
        const double det = inner(c[0], cross(c[1], c[2]));
        for (std::size_t b = 0; b < 3; ++b) xi[b] -= inner(off, cross(c[(b + 1) % 3], c[(b + 2) % 3])) / det;
    }
    return xi;
}

/// exp(-xi^) v
Vector turned_back(const Vector& xi, const Vector& v)
{
    const double a = std::sqrt(inner(xi, xi)), s = std::sin(a / 2) / a;
    const Vector once = cross(xi, v);
    return v + -std::sin(a) / a * once + 2 * s * s * cross(xi, once);
}

} // namespace

TEST_CASE("a free rotor with exp turns by h w in a step, at rotations by more than pi too", "[run]")
{
    const std::string path = scheme_file(rotor, "midpoint", "exp");
    for (const double h : {0.1, 1.7, 2.9}) {
        const json::Value found = ran({path, "--step", fmt::format("{}", h), "--t-end", fmt::format("{}", 5 * h)});
        CHECK(std::abs(entry(found, "W[1,1]") - std::cos(1.3L * h)) < 4e-15L);
        CHECK(std::abs(entry(found, "W[2,1]") - std::sin(1.3L * h)) < 4e-15L);
        CHECK(std::abs(entry(found, "p_w") - 1.7L * 1.3L) < 1e-15L);
    }
}

TEST_CASE("the midpoint with exp on SO(3) makes the steps of dexp^-1 by hand, and keeps the momentum in space",
          "[run][all]")
{
    const double h = 0.6;
    const std::string path = scheme_file(body, "midpoint", "exp");
    const json::Value found = ran({path, "--step", "0.6", "--t-end", "6"});
    Vector mu{0.48, 1.89, -0.87};
    const double size = std::sqrt(inner(mu, mu));
    REQUIRE(found["rows"].size() == 11);
    for (const json::Value& row : found["rows"].entries) {
        const Vector xi = solved(mu, h);
        for (std::size_t i = 0; i < 3; ++i) { // rows of W are W^T e_i
            Vector unit{}, here;
            unit[i] = 1;
            for (std::size_t j = 0; j < 3; ++j) here[j] = std::stod(row[1 + 3 * i + j].text);
            CHECK(distance(here, turned_back(xi, unit)) < 1e-13);
        }
        Vector there;
        for (std::size_t a = 0; a < 3; ++a) there[a] = std::stod(row[10 + a].text);
        CHECK(distance(there, mu) < 1e-13);
        CHECK(std::abs(std::sqrt(inner(there, there)) - size) < 1e-14);
        mu = turned_back(xi, mu);
    }
}

TEST_CASE("an arrow that exp reaches within pi starts a motion on its branch, and a half turn is refused", "[run]")
{
    const std::string path = scheme_file(body, "midpoint", "exp");
    const auto append = [&](const char* name, const char* element) {
        std::ofstream(path, std::ios::app)
            << fmt::format("[scene.{}]\nelement = {}\nstep = 1\nsteps = 1\n", name, element);
    };
    append("short", "\"exp(hat([0.4, -0.9, 0.3]))\"");
    append("long", "\"exp(hat([0, 3.1, 0]))\"");
    append("far", "\"exp(hat([0.4, 2.7, -0.3]))\""); // behind the fold: det N has the other sign
    append("half", "[[-1, 0, 0], [0, 1, 0], [0, 0, -1]]");
    const auto start = [&](const char* scene) {
        const json::Value found = ran({path, "--scene", scene});
        REQUIRE(found["rows"].size() == 2);
        Vector mu;
        for (std::size_t a = 0; a < 3; ++a) mu[a] = std::stod(found["rows"][0][10 + a].text);
        return mu;
    };
    CHECK(distance(start("short"), momentum({0.4, -0.9, 0.3}, 1)) < 1e-14);
    CHECK(distance(start("long"), {0, 2.1 * 3.1, 0}) < 1e-13);
    CHECK(distance(start("far"), momentum({0.4, 2.7, -0.3}, 1)) < 1e-12);
    const Outcome refused = call({"run", path, "--scene", "half"});
    CHECK(refused.code == 3);
    CHECK(refused.err.find("error: the element of scene 'half' is a half turn, or nearly one") != std::string::npos);
}

TEST_CASE("every scheme with exp has its order on groups, on an action groupoid and on an Atiyah groupoid", "[all]")
{
    const std::vector<SchemeOrder> up_to_six{{"midpoint", 2}, {"trapezoidal", 2}, {"gauss:2", 4},
                                             {"gauss:3", 6},  {"lobatto:3", 4},   {"lobatto:4", 6}};
    for (const SchemeModel* model : {&planar, &top, &charged, &driven}) require_orders(*model, up_to_six, "exp");
    require_orders(rigid, {{"midpoint", 2}, {"gauss:2", 4}}, "exp");
    require_orders(top, {{"left", 1}}, "exp");
}
