// SPDX-License-Identifier: GPL-2.0-or-later
/// The structure equations are independent: models that break one of them alone, or hold only where the model says.
#include "verify/checking.hpp"

#include <catch2/catch.hpp>

using namespace lagen;

namespace {

/// The refuted checks alone, one a line.
std::string refuted(const std::string& text)
{
    std::string lines;
    for (const Check& check : verified_text(text).structure.checks)
        if (check.decision.status != ProofStatus::proved) lines += line_of(check) + "\n";
    return lines;
}

const std::string line_and_frame = R"toml(
[base]
coordinates = ["x", "y"]
[fibre]
coordinates = ["a", "b"]
[algebroid.anchor]
a = { x = 1 }
b = { y = "x" }
)toml";

/// T R^3 x R with [a, b] = f k, k in the kernel of the anchor.
std::string kernel_valued(const std::string& ab, const std::string& bc, const std::string& ca)
{
    return R"toml(
[base]
coordinates = ["x", "y", "z"]
[fibre]
coordinates = ["a", "b", "c", "k"]
[algebroid]
anchor = { a.x = 1, b.y = 1, c.z = 1 }
[algebroid.bracket]
"a,b" = { k = ")toml" +
           ab + "\" }\n\"b,c\" = { k = \"" + bc + "\" }\n\"c,a\" = { k = \"" + ca + "\" }\n";
}

} // namespace

TEST_CASE("Jacobi's identity on a frame does not make the anchor a morphism")
{
    // C = 0, rho_a = d/dx, rho_b = x d/dy: [d/dx, x d/dy] = d/dy.
    CHECK(refuted(line_and_frame) == "anchor(a, b, y) refuted\n");
    // [a, b] = b/x mends it where x != 0.
    CHECK(refuted(line_and_frame + "[algebroid.bracket]\n\"a,b\" = { b = \"1/x\" }\n").empty());
}

TEST_CASE("an anchor that is a morphism does not make Jacobi's identity hold")
{
    // A two-form with values in the kernel of the anchor: Jacobi says that it is closed.
    CHECK(refuted(kernel_valued("x", "y", "z")).empty());
    CHECK(refuted(kernel_valued("z", "x", "-2*y + y")) == "jacobi(a, b, c, k) refuted\n");
    CHECK(refuted(kernel_valued("z", "x", "-2*y")).empty());
    CHECK(refuted(kernel_valued("z", "x", "-2*y + y/10^15")) == "jacobi(a, b, c, k) refuted\n");
}

TEST_CASE("an algebroid that holds on a surface alone is refuted where the model does not declare the surface")
{
    const std::string base = "[base]\ncoordinates = [\"x\", \"y\"]\n";
    const std::string rest = R"toml(
[fibre]
coordinates = ["a", "b"]
[algebroid.anchor]
a = { x = "-y", y = "x" }
b = { x = "-y*(x^2 + y^2)", y = "x*(x^2 + y^2)" }
[algebroid.bracket]
"a,b" = { a = "x^2 + y^2 - 1" }
)toml";
    CHECK(refuted(base + "constraints = [\"x^2 + y^2 - 1\"]\n" + rest).empty());
    CHECK(refuted(base + rest) == "anchor(a, b, x) refuted\nanchor(a, b, y) refuted\n");
    CHECK(refuted(base + "constraints = [\"x^2 + y^2 - 2\"]\n" + rest) ==
          "anchor(a, b, x) refuted\nanchor(a, b, y) refuted\n");
}

TEST_CASE("a bracket that is right for one value of a parameter is refuted with another value")
{
    const ModelReport verified = verified_text(R"toml(
[parameters]
k = 1
[base]
coordinates = ["x", "y"]
[fibre]
coordinates = ["a", "b"]
[algebroid.anchor]
a = { x = 1 }
b = { y = "exp(x)" }
[algebroid.bracket]
"a,b" = { b = "k" }
)toml");
    REQUIRE(verified.structure.checks.back().decision.witness);
    CHECK(verified.structure.verdict == Verdict::invalid);
    CHECK(verified.structure.checks.back().decision.residual == "-k*exp(x) + exp(x)");
    const auto point = verified.structure.checks.back().decision.witness->point;
    REQUIRE(point.size() == 2);
    CHECK(point[1].first == "k");
    CHECK(point[1].second.exact != Rational(1));
}

TEST_CASE("a domain decides what a root is, and a contradictory one proves nothing")
{
    const std::string rest = R"toml(
[fibre]
coordinates = ["a", "b"]
[algebroid.anchor]
a = { x = 1 }
b = { y = "sqrt(x^2)" }
[algebroid.bracket]
"a,b" = { b = "1/x" }
)toml";
    const auto with_domain = [&](const std::string& domain) {
        return verified_text("[parameters]\nm = -1\n[base]\ncoordinates = [\"x\", \"y\"]\n" + domain + rest)
            .structure.verdict;
    };
    CHECK(with_domain("") == Verdict::valid);
    CHECK(with_domain("domain = [\"x > 0\"]\n") == Verdict::valid);
    CHECK(with_domain("domain = [\"x > 0\", \"x < 0\"]\n") == Verdict::undecided);
    CHECK(with_domain("domain = [\"x*m > 0\", \"m > 0\"]\n") == Verdict::valid);
}
