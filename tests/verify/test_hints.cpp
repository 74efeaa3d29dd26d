// SPDX-License-Identifier: GPL-2.0-or-later
/// Hints of refuted algebroids: the one sign or the one entry that mends them, in the words of the file.
#include "verify/algebroid_texts.hpp"
#include "verify/checking.hpp"

#include <catch2/catch.hpp>

using namespace lagen;
using Hints = std::vector<std::string>;

namespace {

Hints hints_of(const std::string& text)
{
    return hints_of(verified_text(text));
}

/// `text` with one passage replaced, which must be there.
std::string with(std::string text, const std::string& passage, const std::string& by)
{
    const std::size_t at = text.find(passage);
    REQUIRE(at != std::string::npos);
    return text.replace(at, passage.size(), by);
}

const std::string top = turning_vector();
const std::string top_on_sphere = turning_vector(on_sphere);

/// so(4) in the basis of pairs i < j, as a user would write it.
const std::string so4 = R"(
[fibre]
coordinates = ["e1", "e2", "e3", "e4", "e5", "e6"]
[algebroid]
kind = "lie_algebra"
[algebroid.bracket]
"e1,e2" = { e4 = -1 }
"e1,e3" = { e5 = -1 }
"e1,e4" = { e2 = 1 }
"e1,e5" = { e3 = 1 }
"e2,e3" = { e6 = -1 }
"e2,e4" = { e1 = -1 }
"e2,e6" = { e3 = 1 }
"e3,e5" = { e1 = -1 }
"e3,e6" = { e2 = -1 }
"e4,e5" = { e6 = -1 }
"e4,e6" = { e5 = 1 }
"e5,e6" = { e4 = -1 }
)";

} // namespace

TEST_CASE("the models that the hints start from are valid")
{
    CHECK(verified_text(half_plane_frame + "\"a,b\" = { a = -1 }\n").structure.verdict == Verdict::valid);
    CHECK(verified_text(top).structure.verdict == Verdict::valid);
    CHECK(verified_text(top_on_sphere).structure.verdict == Verdict::valid);
    CHECK(verified_text(so4).structure.verdict == Verdict::valid);
}

TEST_CASE("a flipped sign of a bracket entry is named in the order of the file")
{
    CHECK(hints_of(with(top, "w2 = 1 }", "w2 = -1 }")) ==
          Hints{"all equations of the algebroid hold with the opposite sign of component w2 of [w3, w1]"});
    CHECK(hints_of(with(so4, "e2 = 1 }", "e2 = -1 }")) ==
          Hints{"all equations of the algebroid hold with the opposite sign of component e2 of [e1, e4]"});
}

TEST_CASE("a flipped sign of an anchor entry is named")
{
    const Hints hint{"all equations of the algebroid hold with the opposite sign of component g3 of the anchor of w1"};
    CHECK(hints_of(with(top, "\"-g2\"", "\"g2\"")) == hint);
    CHECK(hints_of(with(top_on_sphere, "\"-g2\"", "\"g2\"")) == hint);
}

TEST_CASE("where two signs would mend a model both are named")
{
    CHECK(hints_of(half_plane_frame + "\"b,a\" = { a = -1 }\n") ==
          Hints{"all equations of the algebroid hold with the opposite sign of component a of [b, a], or with the "
                "opposite sign of component y of the anchor of b"});
}

TEST_CASE("a bracket given in the wrong order is named")
{
    // [a, b] = b - a on the line: rho_a = d/dx, rho_b = d/dx + exp(x) d/dx.
    const std::string text = R"toml(
[base]
coordinates = ["x"]
[fibre]
coordinates = ["a", "b"]
[algebroid.anchor]
a = { x = 1 }
b = { x = "1 + exp(x)" }
[algebroid.bracket]
)toml";
    CHECK(verified_text(text + "\"a,b\" = { a = -1, b = 1 }\n").structure.verdict == Verdict::valid);
    CHECK(hints_of(text + "\"b,a\" = { a = -1, b = 1 }\n") ==
          Hints{"all equations of the algebroid hold with the opposite sign of [b, a], as if its sections were given "
                "in the wrong order"});
}

TEST_CASE("where the anchor determines a component the hint says its value and what is given")
{
    CHECK(hints_of(half_plane_frame + "\"a,b\" = { a = -2 }\n") ==
          Hints{"[a, b] needs component a = -1, given is -2; with it all equations of the algebroid hold"});
    CHECK(hints_of(half_plane_frame) ==
          Hints{"[a, b] needs component a = -1, given is none; with it all equations of the algebroid hold"});
    CHECK(hints_of(with(top, "w2 = 1 }", "w2 = \"1.000000000000001\" }")) ==
          Hints{"[w3, w1] needs component w2 = 1, given is 1.000000000000001; with it all equations of the algebroid "
                "hold"});
}

TEST_CASE("a bracket that must be constant is not asked to depend on the base")
{
    // rho_a = d/dx, rho_b = x d/dy: [a, b] = b/x, which no action of a Lie algebra has.
    const std::string text = "[base]\ncoordinates = [\"x\", \"y\"]\n[fibre]\ncoordinates = [\"a\", \"b\"]\n";
    const std::string anchor = "[algebroid.anchor]\na = { x = 1 }\nb = { y = \"x\" }\n";
    CHECK(hints_of(text + anchor) ==
          Hints{"[a, b] needs component b = 1/x, given is none; with it all equations of the algebroid hold"});
    CHECK(hints_of(text + "[algebroid]\nkind = \"action\"\n" + anchor + "[algebroid.bracket]\n").empty());
}

TEST_CASE("where one product of a matrix with its transpose is refuted the other one is named")
{
    const auto turned = [](const char* claim, const char* anchor) {
        return hints_of(std::string("[base]\ncoordinates = [\"R[1..3,1..3]\", \"x\"]\n") + "casimirs = { orth = \"" +
                        claim +
                        "\" }\n[fibre]\ncoordinates = [\"w[1..3]\"]\n[algebroid]\nkind = \"action\"\nalgebra = "
                        "\"so(3)\"\nanchor = { R = \"" +
                        anchor + "\" }\n");
    };
    const std::string kept = " is constant along all motions of the algebroid: rho(e) of each of its entries is 0 for "
                             "each section e";
    CHECK(turned("transpose(R)*R", "R*hat(w)") == Hints{"R*transpose(R)" + kept});
    CHECK(turned("R*transpose(R)", "-hat(w)*R") == Hints{"transpose(R)*R" + kept});
    CHECK(turned("R*transpose(R)", "R*hat(w)").empty());
}
