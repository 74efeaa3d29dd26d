// SPDX-License-Identifier: GPL-2.0-or-later
/// Kernel vectors of degenerate Lagrangians.
#include "verify/checking.hpp"

#include <catch2/catch.hpp>

using namespace lagen;
using Kernel = std::vector<std::vector<std::pair<std::string, std::string>>>;

namespace {

Kernel texts(const std::vector<std::vector<std::pair<std::string, Tree>>>& kernel)
{
    Kernel result;
    for (const auto& vector : kernel) {
        result.emplace_back();
        for (const auto& [name, component] : vector) result.back().emplace_back(name, to_text(component));
    }
    return result;
}

Regularity regularity_in_space(const std::string& lagrangian)
{
    return verified_text("[parameters]\nm = 2\n[base]\ncoordinates = [\"x\", \"y\", \"z\"]\n[fibre]\ncoordinates = "
                         "[\"u\", \"v\", \"w\"]\n[algebroid]\nkind = \"tangent\"\n[lagrangian]\nL = \"" +
                         lagrangian + "\"\n")
        .mechanics.regularity;
}

} // namespace

TEST_CASE("a coordinate without kinetic energy is a kernel vector")
{
    const Regularity result = regularity_in_space("m*(u^2 + v^2)/2 + x*w");
    CHECK(result.kind == Regularity::Kind::degenerate);
    CHECK(result.rank == 2);
    CHECK(texts(result.kernel) == Kernel{{{"w", "1"}}});
}

TEST_CASE("a square of one combination has a plane of constant kernel vectors")
{
    CHECK(texts(regularity_in_space("(u + 2*v - w)^2").kernel) ==
          Kernel{{{"u", "-2"}, {"v", "1"}}, {{"u", "1"}, {"w", "1"}}});
}

TEST_CASE("kernel vectors with parameters and functions of the base are expressions")
{
    CHECK(texts(regularity_in_space("(u + m*v)^2 + w^2").kernel) == Kernel{{{"u", "-m"}, {"v", "1"}}});
    CHECK(texts(regularity_in_space("(u*cos(x) - v*sin(y))^2/2 + w^2").kernel) ==
          Kernel{{{"u", "sin(y)/cos(x)"}, {"v", "1"}}});
}

TEST_CASE("a matrix that is singular only by an identity has its kernel proved")
{
    // W = [[1, s, 0], [s, s^2 + c^2 - 1 + s^2 - s^2 + ..]]: det = 0 by sin^2 + cos^2 = 1
    CHECK(texts(regularity_in_space("u^2/2 + sin(x)*u*v + (1 - cos(x)^2)*v^2/2 + w^2").kernel) ==
          Kernel{{{"u", "-sin(x)"}, {"v", "1"}}});
}

TEST_CASE("a Lagrangian of degree one has kernel along its velocity")
{
    // L = sqrt(u^2 + v^2): W (u, v) = 0
    const Regularity result = regularity_in_space("sqrt(u^2 + v^2) + w^2");
    CHECK(result.rank == 2);
    CHECK(texts(result.kernel) == Kernel{{{"u", "u/v"}, {"v", "1"}}});
}

TEST_CASE("a regular Lagrangian has no kernel")
{
    CHECK(regularity_in_space("u^2 + v^2 + w^2").kernel.empty());
    CHECK(regularity_in_space("u^2 + x*v^2 + w^2").kernel.empty());
}
