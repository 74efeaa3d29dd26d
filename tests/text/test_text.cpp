// SPDX-License-Identifier: GPL-2.0-or-later
/// UTF-8 and the search for the name that was meant.
#include "text/activity.hpp"
#include "text/diagnostic.hpp"

#include <catch2/catch.hpp>

using namespace lagen;

namespace {

std::string nearest(std::string_view unknown, const std::vector<std::string>& known)
{
    return nearest_name(unknown, known);
}

} // namespace

TEST_CASE("UTF-8 of one to four bytes is decoded")
{
    CHECK(decode_utf8("a", 0).value == U'a');
    CHECK(decode_utf8("xθ", 1).value == U'θ');
    CHECK(decode_utf8("ℝ", 0).length == 3);
    CHECK(decode_utf8("\U0001D70C", 0).value == 0x1D70C);
    CHECK(decode_utf8("\U0001D70C", 0).length == 4);
}

TEST_CASE("truncated, overlong, surrogate and too large sequences are not UTF-8")
{
    for (const std::string text : {"\x80", "\xC0\x80", "\xC1\xBF", "\xE0\x80\x80", "\xED\xA0\x80", "\xF4\x90\x80\x80",
                                   "\xF5\x80\x80\x80", "\xCE",
                                   "\xCE"
                                   "a",
                                   "\xE2\x84"}) {
        INFO(text);
        CHECK(decode_utf8(text, 0).length == 0);
        CHECK(find_invalid_utf8("θ" + text) == 2);
    }
    CHECK(find_invalid_utf8("θ = 1") == std::string_view::npos);
    CHECK(decode_utf8("a", 1).length == 0);
}

TEST_CASE("the nearest name is the one with the fewest slips")
{
    CHECK(nearest("g4", {"g1", "g3"}) == "g1"); // a tie goes to the earlier one
    CHECK(nearest("omgea", {"alpha", "omega"}) == "omega");
    CHECK(nearest("lenght", {"length", "weight"}) == "length");
    CHECK(nearest("Mgl", {"m", "mgl"}) == "mgl");
    CHECK(nearest("om", {"m", "Om"}) == "Om"); // a capital is the least of slips
    CHECK(nearest("X", {"y", "x"}) == "x");
    CHECK(nearest("θ1", {"φ2", "θ"}) == "θ");
}

TEST_CASE("a name that shares nothing is not proposed")
{
    CHECK(nearest("x", {"y", "z"}).empty());
    CHECK(nearest("omega", {"gamma", "mass"}).empty());
    CHECK(nearest("ab", {"cd"}).empty());
    CHECK(nearest("anything", {}).empty());
    CHECK(nearest(std::string(100000, 'a'), {std::string(100000, 'b')}).empty());
}

TEST_CASE("the name that was refused is never proposed")
{
    CHECK(nearest("x", {"x"}).empty());
    CHECK(nearest("mass", {"mass", "m"}).empty());
    CHECK(nearest("mass", {"mass", "masses"}) == "masses");
    CHECK(nearest("mas", {"mas", "mass"}) == "mass");
}

TEST_CASE("stages that last are told from the outside in, with what is done of each")
{
    CHECK(lagen::activities_text().empty());
    {
        const lagen::Activity whole("deciding top");
        lagen::Activity part("equations", 3);
        CHECK(lagen::activities_text() == "deciding top: equations");
        part.next();
        part.next();
        CHECK(lagen::activities_text() == "deciding top: equations, 2 of 3");
    }
    CHECK(lagen::activities_text().empty());
}

TEST_CASE("what is counted is told one by one")
{
    std::vector<std::string> told;
    lagen::counted("lifts", 2, [&](std::size_t) { told.push_back(lagen::activities_text()); });
    CHECK(told == std::vector<std::string>{"lifts, 1 of 2", "lifts, 2 of 2"});
    CHECK(lagen::activities_text().empty());
}
