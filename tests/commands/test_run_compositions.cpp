// SPDX-License-Identifier: GPL-2.0-or-later
/// Compositions of the steps of symmetric discrete Lagrangians: measured orders, the arrows of whole steps, momenta.
#include "scheme_models.hpp"

using namespace lagen::testing;
using namespace lagen::testing::schemes;
namespace json = lagen::json;

namespace {

/// The orders of a scheme by a composition, between steps at t = 4.
void require_composed(const SchemeModel& model, const char* scheme, const std::string& retraction,
                      const std::vector<SchemeOrder>& methods)
{
    const std::string path = scheme_file(model, scheme, retraction);
    const json::Value exact = ran({path, "--scene", "curve", "--at", "4"});
    for (const SchemeOrder& entry : methods) {
        const auto& [scheme_or_method, order, large, small] = entry;
        const char* method = scheme_or_method;
        INFO(model.name << " by " << scheme << " and " << method);
        const auto error = [&](const char* step) {
            return error_against(exact, ran({path, "--method", method, "--t-end", "4", "--step", step}));
        };
        const long double coarse = error(large), fine = error(small);
        CHECK(fine > 0);
        CHECK(std::abs(static_cast<double>(std::log2(coarse / fine)) - order) < 0.35);
    }
}

constexpr SchemeModel symmetric_top{"symmetric_top", R"toml(
[base]
coordinates = ["G[1..3]"]
constraints = ["dot(G, G) - 1"]
[fibre]
coordinates = ["w1", "w2", "w3"]
[groupoid]
kind = "action"
group = "SO(3)"
action = { G = "transpose(W)*G" }
[lagrangian]
L = "(1.2*w1^2 + 2.1*w2^2 + 2.9*w3^2)/2 - 1.7*(0.48*G[1] + 0.6*G[2] + 0.64*G[3])"
[symmetries]
vertical = { w1 = "G[1]", w2 = "G[2]", w3 = "G[3]" }
)toml",
                                    "{ G = [0.6, 0, 0.8], w1 = 0.4, w2 = 0.9, w3 = -0.3 }"};

/// Its forces have a part along the logarithm, which is undone together with those at the ends.
constexpr SchemeModel braked_body{"braked_body", R"toml(
[fibre]
coordinates = ["w1", "w2", "w3"]
[groupoid]
kind = "group"
group = "SO(3)"
[lagrangian]
L = "(1.1*w1^2 + 1.9*w2^2 + 2.6*w3^2)/2"
[forces]
w1 = "-0.3*w1 + w2*w3"
)toml",
                                  "{ w1 = 0.4, w2 = -0.3, w3 = 0.8 }"};

} // namespace

TEST_CASE("forces on a group are composed by exp, and refused by Cayley's map", "[run][all]")
{
    require_composed(braked_body, "midpoint", "exp", {{"discrete4", 4, "0.2", "0.1"}});
    const Outcome refused = call({"run", scheme_file(braked_body, "midpoint", "cayley"), "--method", "discrete4",
                                  "--step", "0.1", "--t-end", "1"});
    CHECK(refused.code == 4);
    CHECK_THAT(refused.err, Catch::Contains("with symmetric forces, f^+(g, h) = -f^-(g^-1, -h), which those of model "
                                            "'braked_body' are not: at "));
}

TEST_CASE("a composition on an action groupoid keeps momenta and Casimirs, and its arrows lead from row to row",
          "[run][all]")
{
    const std::string path = scheme_file(symmetric_top, "midpoint", "exp");
    const json::Value found = ran({path, "--method", "discrete6", "--step", "0.2", "--t-end", "20"});
    CHECK(found["method"].text == "discrete6");
    CHECK(std::abs(std::stold(found["invariants"]["momentum.vertical"]["initial"].text)) > 0.1L);
    CHECK(std::stold(found["invariants"]["momentum.vertical"]["max_drift"].text) < 1e-13L);
    CHECK_FALSE(found["invariants"].has("energy"));
    CHECK(std::stold(found["invariants"]["hamiltonian"]["initial"].text) ==
          Approx(0.5 * (1.2 * 0.16 + 2.1 * 0.81 + 2.9 * 0.09) + 1.7 * (0.48 * 0.6 + 0.64 * 0.8)).epsilon(1e-12));
    CHECK(std::stold(found["invariants"]["hamiltonian"]["max_drift"].text) < 1e-5L);
    REQUIRE(found["rows"].size() == 101);
    const auto number = [&](std::size_t row, std::size_t column) {
        return std::stold(found["rows"][row][column].text);
    };
    for (std::size_t row = 0; row + 1 < 101; ++row) {
        long double length = 0;
        for (std::size_t i = 0; i < 3; ++i) { // G_next = W^T G
            long double there = 0;
            for (std::size_t j = 0; j < 3; ++j) there += number(row, 4 + 3 * j + i) * number(row, 1 + j);
            CHECK(std::abs(there - number(row + 1, 1 + i)) < 1e-14L);
            length += there * there;
        }
        CHECK(std::abs(length - 1) < 1e-14L);
    }
}

TEST_CASE("compositions have their orders on pairs, on an action groupoid and on an Atiyah groupoid", "[all]")
{
    const std::vector<SchemeOrder> up_to_six{{"discrete4", 4, "0.1", "0.05"}, {"discrete6", 6, "0.2", "0.1"}};
    const std::vector<SchemeOrder> eight{{"discrete8", 8, "0.4", "0.2"}}, finer{{"discrete8", 8, "0.2", "0.1"}};
    const auto require_all = [&](const SchemeModel& model, const char* scheme, const char* retraction,
                                 const auto& last) {
        require_composed(model, scheme, retraction, up_to_six);
        require_composed(model, scheme, retraction, last);
    };
    for (const char* scheme : {"midpoint", "trapezoidal"}) require_all(pairs, scheme, "", eight);
    require_all(top, "midpoint", "exp", eight);
    require_all(top, "trapezoidal", "", finer);
    require_all(charged, "trapezoidal", "exp", finer);
    require_all(driven, "trapezoidal", "exp", finer);
}

TEST_CASE("compositions of Verlet's steps keep Kepler's angular momentum to rounding and his energy by their orders",
          "[all]")
{
    constexpr SchemeModel kepler{"kepler", R"toml(
[base]
coordinates = ["x", "y"]
[fibre]
coordinates = ["u", "v"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "(u^2 + v^2)/2 + 1/sqrt(x^2 + y^2)"
[invariants]
spin = "x*p_v - y*p_u"
)toml",
                                 "{ x = 0.4, y = 0, u = 0, v = 2 }"};
    const std::string path = scheme_file(kepler, "trapezoidal", "");
    for (const auto& [method, bound] : {std::pair("discrete4", 1e-6L), {"discrete6", 1e-8L}, {"discrete8", 1e-12L}}) {
        const json::Value found = ran({path, "--method", method, "--step", "0.02", "--t-end", "20"});
        CHECK(std::stold(found["invariants"]["hamiltonian"]["max_drift"].text) < bound);
        CHECK(std::stold(found["invariants"]["spin"]["max_drift"].text) < 1e-13L);
    }
}
