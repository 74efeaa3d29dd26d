// SPDX-License-Identifier: GPL-2.0-or-later
/// Frames with dense matrices of fractions: proved by what they frame, and refuted where that is no algebroid.
#include "elaborate/build_algebroid.hpp"
#include "verify/checking.hpp"
#include "verify/construction.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace lagen;

namespace {

/// Four sections with 16 entries (c + x_i)/(d + x_j^2) of the inner table.
std::string dense_frame(const std::string& inner)
{
    std::string text =
        "[base]\ncoordinates = ['x1', 'x2', 'x3', 'x4']\n[fibre]\ncoordinates = ['f1', 'f2', 'f3', 'f4']\n"
        "[algebroid]\nkind = 'frame'\n[algebroid.sections]\n";
    for (int a = 1; a <= 4; ++a) {
        text += "f" + std::to_string(a) + " = {";
        for (int b = 1; b <= 4; ++b)
            text += std::string(b == 1 ? "" : ",") + " e" + std::to_string(b) + " = '(" +
                    std::to_string(a == b ? 5 : a + b - 4) + " + x" + std::to_string((a + b) % 4 + 1) + ")/(" +
                    std::to_string(1 + a * b) + " + x" + std::to_string((a + 2 * b) % 4 + 1) + "^2)'";
        text += " }\n";
    }
    return text + "[algebroid.of]\nfibre = ['e1', 'e2', 'e3', 'e4']\n" + inner;
}

/// so(2) + R^1 acting on a plane, and two derivations; `c` is [e1, e3]'s multiple of e4.
std::string rotations(const std::string& c)
{
    return "[algebroid.of.anchor]\ne1 = { x1 = '-x2', x2 = 'x1' }\ne2 = { x1 = 'x1', x2 = 'x2' }\n"
           "e3 = { x3 = '1' }\ne4 = { x4 = '1' }\n[algebroid.of.bracket]\n'e1,e3' = { e4 = '" +
           c + "' }\n";
}

/// A frame of TR^2 with the first section e1 * factor, and what stands before and in [base].
std::string plane_frame(const std::string& factor, const std::string& base = "")
{
    return "[base]\ncoordinates = ['x', 'y']\n" + base +
           "[fibre]\ncoordinates = ['a', 'b']\n[algebroid]\nkind = 'frame'\n[algebroid.sections]\na = { u = '" +
           factor + "', v = 'x' }\nb = { v = '1 + y^2' }\n[algebroid.of]\nkind = 'tangent'\nfibre = ['u', 'v']\n";
}

bool holds(const std::string& text)
{
    const WrittenAlgebroid algebroid = build_algebroid(read_model_text("test.toml", "name = 'test'\n" + text));
    return algebroid.construction && holds_by_construction(*algebroid.construction);
}

std::size_t constructed(const Report& verified)
{
    return static_cast<std::size_t>(
        std::count_if(verified.structure.checks.begin(), verified.structure.checks.end(),
                      [](const Check& check) { return check.decision.evidence == construction_argument; }));
}

} // namespace

TEST_CASE("a dense rational frame of TR^4 is proved by construction, and its residuals vanish at other points")
{
    const System system =
        elaborate(read_model_text("test.toml", "name = 'test'\n" + dense_frame("kind = 'tangent'\n")));
    const Report verified = verify(system);
    CHECK(verified.structure.verdict == Verdict::valid);
    CHECK(verified.structure.checks.size() == 40);
    CHECK(constructed(verified) > 30);
    CHECK(largest_structure_residual(system, 3) < 1e-60);
}

TEST_CASE("a dense frame of seven sections, too large for written brackets, is proved by construction too")
{
    std::string names, text;
    for (int a = 0; a < 7; ++a) {
        const std::string x = "x" + std::to_string(a);
        names += (a == 0 ? "'" : ", '") + x + "'";
        text += "f" + std::to_string(a) + " = {";
        for (int b = 0; b < 7; ++b)
            text += std::string(b == 0 ? "" : ",") + " e" + std::to_string(b) + " = '" + (a == b ? "8" : "1") + " + x" +
                    std::to_string((a + b) % 7) + "/(2 + " + x + "^2)'";
        text += " }\n";
    }
    const auto renamed = [&](char first) {
        std::string other = names;
        std::ranges::replace(other, 'x', first);
        return other;
    };
    const ModelReport verified =
        verified_text("[base]\ncoordinates = [" + names + "]\n[fibre]\ncoordinates = [" + renamed('f') +
                      "]\n[algebroid]\nkind = 'frame'\n[algebroid.sections]\n" + text +
                      "[algebroid.of]\nkind = 'tangent'\nfibre = [" + renamed('e') + "]\n");
    CHECK(verified.structure.verdict == Verdict::valid);
    CHECK(constructed(verified) > 200);
}

TEST_CASE("a dense rational frame of what is no algebroid is refuted, be it by 1e-15")
{
    // [e1, e3] = c e4 needs rho([e1, e3]) = [rho(e1), rho(e3)] = 0.
    CHECK(verified_text(dense_frame(rotations("0"))).structure.verdict == Verdict::valid);
    CHECK(verified_text(dense_frame(rotations("1/1000000000000000"))).structure.verdict == Verdict::invalid);
}

TEST_CASE("a construction is believed where each of its statements is shown")
{
    const WrittenAlgebroid algebroid =
        build_algebroid(read_model_text("test.toml", "name = 'test'\n" + plane_frame("1 + x*y")));
    REQUIRE(algebroid.construction);
    const Construction& construction = *algebroid.construction;
    CHECK(holds_by_construction(construction));
    REQUIRE(construction.zero.size() == algebroid.C.size()); // rewritten, so that they are other nodes
    REQUIRE(construction.nonzero.size() == 1);
    REQUIRE(construction.algebroids.size() == 1);
    const auto holds_with = [&](const auto& change) {
        Construction other = construction;
        change(other);
        return holds_by_construction(other);
    };
    const Rational little(1, 1'000'000'000'000'000);
    for (std::size_t k = 0; k < construction.zero.size(); ++k)
        CHECK_FALSE(holds_with([&](Construction& other) {
            other.zero[k] = other.graph.add(other.zero[k], other.graph.constant(little));
        }));
    CHECK_FALSE(holds_with([](Construction& other) { other.nonzero.push_back(other.graph.constant(0)); }));
    CHECK_FALSE(
        holds_with([](Construction& other) { other.analytic.push_back(other.graph.apply(Op::abs, other.x[0])); }));
    CHECK_FALSE(holds_with([](Construction& other) {
        NodeId& entry = other.algebroids[0].anchor[0][0].value;
        entry = other.graph.add(entry, other.x[1]); // [(1 + y) d/dx, d/dy] is not 0
    }));
    CHECK(holds_with([](Construction& other) {
        NodeId& entry = other.algebroids[0].anchor[0][0].value;
        entry = other.graph.add(entry, other.x[0]);
    }));
}

TEST_CASE("from one point to the whole domain a construction argues for analytic entries without constraints alone")
{
    CHECK(holds(plane_frame("1 + x*y")));
    CHECK(holds(plane_frame("x*sqrt(1 + sin(y)^2)")));
    CHECK(holds(plane_frame("y + log(x)", "domain = ['x + y > 0']\n")));
    CHECK_FALSE(holds(plane_frame("x + sqrt(x^2 + sin(y))")));
    CHECK_FALSE(holds(plane_frame("y + log(x)", "domain = ['x*y != 0']\n")));
    CHECK(holds(plane_frame("exp(1/x) + tan(y)", "domain = ['x > 0']\n")));
    // x + |x| vanishes on a half-plane, and is not zero at a point.
    CHECK_FALSE(holds(plane_frame("x + abs(x)")));
    CHECK_FALSE(holds(plane_frame("x + sqrt(x^2)")));
    CHECK_FALSE(holds(plane_frame("1 + x*y", "domain = ['x + abs(x) > 0']\n")));
    CHECK_FALSE(holds(plane_frame("1 + x*y", "casimirs = { c = '1' }\n")));
    CHECK_FALSE(holds("[base]\ncoordinates = ['x']\n[fibre]\ncoordinates = ['a']\n[algebroid]\nkind = 'tangent'\n"));
}

TEST_CASE("a prolongation of a frame holds by construction where the frame does not know the gained coordinates")
{
    const auto prolongation = [](const std::string& factor) {
        return "[base]\ncoordinates = ['x', 'a']\n[algebroid]\nkind = 'prolongation'\n[algebroid.of]\nkind = 'frame'\n"
               "fibre = ['a']\nsections = { a = { u = '" +
               factor + "' } }\n[algebroid.of.of]\nkind = 'tangent'\nfibre = ['u']\nover = ['x']\n";
    };
    CHECK(holds(prolongation("1 + x^2")));
    CHECK(verified_text(prolongation("1 + x^2")).structure.verdict == Verdict::valid);
    CHECK_FALSE(holds(prolongation("1 + a^2")));
    CHECK(verified_text(prolongation("1 + a^2")).structure.verdict == Verdict::invalid);
}
