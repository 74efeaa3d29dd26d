// SPDX-License-Identifier: GPL-2.0-or-later
/// What `check` decides of a groupoid: its action, and the algebroid that is given beside it.
#include "verify/checking.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace lagen;
using Lines = std::vector<std::string>;

namespace {

const std::string sphere = R"toml(
[base]
coordinates = ["g1", "g2", "g3"]
constraints = ["g1^2 + g2^2 + g3^2 - 1"]
[fibre]
coordinates = ["w1", "w2", "w3"]
)toml";

std::string action(const std::string& values)
{
    return "[groupoid]\nkind = \"action\"\ngroup = \"SO(3)\"\naction = { " + values + " }\n";
}

const std::string right = "g1 = \"(transpose(W)*[g1, g2, g3])[1]\", g2 = \"W[1,2]*g1 + W[2,2]*g2 + W[3,2]*g3\", g3 = "
                          "\"W[1,3]*g1 + W[2,3]*g2 + W[3,3]*g3\"";

Lines of_name(const Report& report, const std::string& name)
{
    Lines lines;
    for (const Check& check : report.structure.checks)
        if (check.name == name) lines.push_back(line_of(check));
    return lines;
}

} // namespace

TEST_CASE("a right action of rotations is proved, with the algebroid that is computed from it")
{
    const ModelReport report = verified_text(sphere + action(right));
    CHECK(report.structure.verdict == Verdict::valid);
    CHECK(of_name(report, "action") == Lines{"action(g1) proved", "action(g2) proved", "action(g3) proved"});
    CHECK(of_name(report, "algebroid_of_groupoid").empty());
    CHECK(of_name(report, "tangency").size() == 3);
}

TEST_CASE("a left action is refuted on the group, with the hint to write the inverse")
{
    const std::string left =
        "g1 = \"W[1,1]*g1 + W[1,2]*g2 + W[1,3]*g3\", g2 = \"W[2,1]*g1 + W[2,2]*g2 + W[2,3]*g3\", g3 = "
        "\"W[3,1]*g1 + W[3,2]*g2 + W[3,3]*g3\"";
    const ModelReport report = verified_text(sphere + action(left));
    CHECK(report.structure.verdict == Verdict::invalid);
    CHECK(of_name(report, "action") == Lines{"action(g1) refuted", "action(g2) refuted", "action(g3) refuted"});
    for (const Check& check : report.structure.checks) {
        if (check.name != "action") continue;
        REQUIRE(check.decision.witness.has_value());
        CHECK(check.decision.witness->value != 0);
    }
    const Lines hints = hints_of(report);
    CHECK(
        std::ranges::any_of(hints, [](const std::string& hint) { return hint.starts_with("this is a left action"); }));
}

TEST_CASE("an action that is one on the group alone is proved there")
{
    // In the plane (W^T W)^2 = 1 on rotations, and on no other matrices.
    const std::string text =
        "[base]\ncoordinates = [\"x\"]\n[fibre]\ncoordinates = [\"w\"]\n[groupoid]\nkind = "
        "\"action\"\ngroup = \"SO(2)\"\naction = { x = \"x*(W[1,1]^2 + W[2,1]^2) + W[1,2] + W[2,1]\" }\n";
    const ModelReport report = verified_text(text);
    CHECK(of_name(report, "action") == Lines{"action(x) proved"});
    CHECK(of_name(report, "unit") == Lines{});
    CHECK(report.structure.verdict == Verdict::valid);
}

TEST_CASE("an action that does not fix the points under 1 is refuted")
{
    const ModelReport report =
        verified_text("[base]\ncoordinates = [\"x\"]\n[fibre]\ncoordinates = [\"w\"]\n[groupoid]\n"
                      "kind = \"action\"\ngroup = \"R\"\naction = { x = \"2*x + W[1,2]\" }\n");
    CHECK(report.structure.verdict == Verdict::invalid);
    CHECK(of_name(report, "unit") == Lines{"unit(x) refuted"});
}

TEST_CASE("the algebroid beside a groupoid is compared with its own, entry by entry")
{
    const std::string anchor =
        "[algebroid.anchor]\nw1 = { g2 = \"g3\", g3 = \"-g2\" }\nw2 = { g1 = \"-g3\", g3 = \"g1\" }\n"
        "w3 = { g1 = \"g2\", g2 = \"-g1\" }\n";
    const std::string brackets =
        "[algebroid.bracket]\n\"w1,w2\" = { w3 = \"1\" }\n\"w2,w3\" = { w1 = \"1\" }\n\"w3,w1\" = { "
        "w2 = \"1\" }\n";
    const ModelReport same = verified_text(sphere + anchor + brackets + action(right));
    CHECK(same.structure.verdict == Verdict::valid);
    CHECK(of_name(same, "algebroid_of_groupoid").empty()); // all are zero by structure
    CHECK(same.structure.trivial >= 9);

    const std::string opposite =
        "[algebroid]\nkind = \"action\"\nalgebra = \"so(3)\"\n[algebroid.anchor]\nw1 = { g2 = "
        "\"g3\", g3 = \"-g2\" }\nw2 = { g1 = \"-g3\", g3 = \"g1\" }\nw3 = { g1 = \"2*g2\", g2 = "
        "\"-g1*(g1^2 + g2^2 + g3^2)\" }\n";
    const ModelReport other = verified_text(sphere + opposite + action(right));
    CHECK(of_name(other, "algebroid_of_groupoid") ==
          Lines{"algebroid_of_groupoid(w3, g1) refuted", "algebroid_of_groupoid(w3, g2) proved"});
    CHECK(other.structure.verdict == Verdict::invalid);
}

TEST_CASE("the curvature of an Atiyah algebroid is that of its groupoid")
{
    const std::string text =
        "[base]\ncoordinates = [\"x\", \"y\"]\n[fibre]\ncoordinates = [\"u\", \"v\", \"q\"]\n"
        "[algebroid]\nkind = \"atiyah\"\nalgebra = \"R\"\nconnection = { x = { q = \"-sin(y)\" }, y = { "
        "q = \"x^3\" } }\n[groupoid]\nkind = \"atiyah\"\ngroup = \"R\"\n";
    const ModelReport report = verified_text(text);
    CHECK(report.structure.verdict == Verdict::valid);
    const std::string wrong =
        "[base]\ncoordinates = [\"x\", \"y\"]\n[fibre]\ncoordinates = [\"u\", \"v\", \"q\"]\n"
        "[algebroid.anchor]\nu = { x = 1 }\nv = { y = 1 }\n[algebroid.bracket]\n\"u,v\" = { q = \"x\" }\n"
        "[groupoid]\nkind = \"atiyah\"\ngroup = \"R\"\n";
    CHECK(of_name(verified_text(wrong), "algebroid_of_groupoid") == Lines{"algebroid_of_groupoid(u, v, q) refuted"});
}
