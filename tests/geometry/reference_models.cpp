// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry/reference_models.hpp"

#include <cmath>

namespace lagen {

namespace {

const std::string pendulum = R"toml(
name = "verlet_pendulum"
[parameters]
h = 0.1
[base]
coordinates = ["q"]
[groupoid]
kind = "pair"
[definitions]
"V(s)" = "1 - cos(s)"
[discrete]
step = "h"
L = "(q_next - q)^2/(2*h) - h*(V(q) + V(q_next))/2"
)toml";

const std::string inertia = R"toml(
[definitions]
A = "diag([I1, I2, I3])"
J = "trace(A)/2*identity(3) - A"
)toml";

const std::string free_body = R"toml(
name = "moser_veselov"
[parameters]
I1 = 1.1
I2 = 2.3
I3 = 3.4
[fibre]
coordinates = ["w1", "w2", "w3"]
[groupoid]
kind = "group"
group = "SO(3)"
[discrete]
step = "h"
L = "-trace(J*W)/h"
)toml" + inertia;

const std::string planar_body = R"toml(
name = "planar_body"
[parameters]
Jz = 0.8
m1 = 1.3
m2 = 2.2
[fibre]
coordinates = ["w", "v1", "v2"]
[groupoid]
kind = "group"
group = "SE(2)"
element = "g"
[discrete]
step = "h"
L = "Jz*(1 - g[1,1])/h + (m1*g[1,3]^2 + m2*g[2,3]^2)/(2*h)"
)toml";

std::string heavy_top(const std::string& parameters)
{
    return "name = \"heavy_top\"\n[parameters]\n" + parameters + R"toml(
[base]
coordinates = ["G[1..3]"]
constraints = ["dot(G, G) - 1"]
[fibre]
coordinates = ["w1", "w2", "w3"]
[groupoid]
kind = "action"
group = "SO(3)"
element = "W"
action = { G = "transpose(W)*G" }
[discrete]
step = "h"
L = "-trace(J*W)/h - h*mgl*dot(G, e)"
)toml" + inertia;
}

const std::string sliding_mass = R"toml(
name = "sliding_mass"
[parameters]
I1 = 1.1
I2 = 1.6
I3 = 1.3
mu = 0.7
m = 0.7
k = 2.5
[base]
coordinates = ["x"]
[fibre]
coordinates = ["v", "w1", "w2", "w3"]
momenta = ["p", "l1", "l2", "l3"]
[groupoid]
kind = "atiyah"
group = "SO(3)"
[definitions]
"A(s)" = "diag([I1 + mu*s^2, I2 + mu*s^2, I3])"
"J(s)" = "trace(A(s))/2*identity(3) - A(s)"
"V(s)" = "k*(s - 1)^2/2"
[discrete]
step = "h"
L = "m*(x_next - x)^2/(2*h) + trace(J((x + x_next)/2)*(identity(3) - W))/h - h*(V(x) + V(x_next))/2"
)toml";

long double number(const json::Value& value)
{
    return std::stold(value.text);
}

void put_matrix(std::map<std::string, long double>& out, const json::Value& rows)
{
    for (std::size_t k = 0; k < 9; ++k)
        out["W[" + std::to_string(k / 3 + 1) + "," + std::to_string(k % 3 + 1) + "]"] = number(rows[k]);
}

std::vector<long double> numbers(const json::Value& values, long double divisor = 1)
{
    std::vector<long double> out;
    for (const json::Value& value : values.entries) out.push_back(number(value) / divisor);
    return out;
}

ReferenceArrow pendulum_arrow(const json::Value& step, const json::Value&)
{
    return {{{"q", number(step["q"])}, {"q_next", number(step["q_next"])}}, {number(step["p"])}};
}

ReferenceArrow free_body_arrow(const json::Value& step, const json::Value& parameters)
{
    ReferenceArrow arrow;
    put_matrix(arrow.coordinates, step["W"]);
    arrow.momenta = numbers(step["Pi"], number(parameters["h"]));
    return arrow;
}

ReferenceArrow planar_arrow(const json::Value& step, const json::Value&)
{
    const long double th = number(step["th"]), c = std::cos(th), s = std::sin(th);
    return {{{"g[1,1]", c},
             {"g[1,2]", -s},
             {"g[1,3]", number(step["a"][0])},
             {"g[2,1]", s},
             {"g[2,2]", c},
             {"g[2,3]", number(step["a"][1])},
             {"g[3,1]", 0},
             {"g[3,2]", 0},
             {"g[3,3]", 1}},
            numbers(step["mu"])};
}

ReferenceArrow heavy_top_arrow(const json::Value& step, const json::Value&)
{
    ReferenceArrow arrow;
    put_matrix(arrow.coordinates, step["W"]);
    for (std::size_t i = 0; i < 3; ++i)
        arrow.coordinates["G[" + std::to_string(i + 1) + "]"] = number(step["Gamma"][i]);
    arrow.momenta = numbers(step["mu_minus"]);
    return arrow;
}

/// mu is the vertical part; the horizontal one is not in the file.
ReferenceArrow sliding_arrow(const json::Value& step, const json::Value&)
{
    ReferenceArrow arrow;
    put_matrix(arrow.coordinates, step["W"]);
    arrow.coordinates["x"] = number(step["x"]);
    arrow.coordinates["x_next"] = number(step["x_next"]);
    arrow.momenta = numbers(step["mu"]);
    return arrow;
}

} // namespace

const std::vector<DiscreteCase>& discrete_cases()
{
    static const std::vector<DiscreteCase> cases{
        {"verlet_pendulum", pendulum, pendulum_arrow},
        {"moser_veselov_so3", free_body, free_body_arrow},
        {"planar_body_se2_discrete", planar_body, planar_arrow},
        {"heavy_top_del_lagrange",
         heavy_top("I1 = 1.5\nI2 = 1.5\nI3 = 0.9\nmgl = 2.2\nh = 0.1\n\"e[1..3]\" = [0, 0, 1]\n"), heavy_top_arrow},
        {"heavy_top_del_asymmetric",
         heavy_top("I1 = 1.2\nI2 = 2.1\nI3 = 2.9\nmgl = 1.7\nh = 0.05\n\"e[1..3]\" = [0.48, 0.6, 0.64]\n"),
         heavy_top_arrow},
        {"atiyah_sliding_mass", sliding_mass, sliding_arrow},
    };
    return cases;
}

json::Value read_discrete_case(const std::string& name)
{
    return json::read_file(std::string(LAGEN_SOURCE_DIR) + "/tests/data/discrete/" + name + ".json");
}

} // namespace lagen
