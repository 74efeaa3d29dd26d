// SPDX-License-Identifier: GPL-2.0-or-later
/// Named Lie algebras against their table of brackets and against the Jacobi identity.
#include "geometry/named_algebra.hpp"

#include <catch2/catch.hpp>

#include <fstream>
#include <map>
#include <sstream>

using namespace lagen;

namespace {

/// "[1,2]=3 [1,3]=-2 ..." counted from 1.
std::string brackets(const std::string& name)
{
    const std::optional<NamedAlgebra> algebra = named_algebra(name);
    REQUIRE(algebra);
    std::ostringstream text;
    for (const StructureConstant& entry : algebra->constants)
        text << "[" << entry.a + 1 << "," << entry.b + 1 << "]=" << entry.value << "*" << entry.c + 1 << " ";
    return text.str();
}

/// The largest |C^m_bc C^v_am + cyclic| over all indices.
Rational jacobi_defect(const NamedAlgebra& algebra)
{
    const std::size_t r = algebra.basis.size();
    std::map<std::array<std::size_t, 3>, Rational> C;
    for (const StructureConstant& entry : algebra.constants) {
        C[{entry.c, entry.a, entry.b}] = entry.value;
        C[{entry.c, entry.b, entry.a}] = -entry.value;
    }
    const auto at = [&](std::size_t c, std::size_t a, std::size_t b) {
        const auto found = C.find({c, a, b});
        return found == C.end() ? Rational(0) : found->second;
    };
    Rational largest = 0;
    for (std::size_t a = 0; a < r; ++a)
        for (std::size_t b = 0; b < r; ++b)
            for (std::size_t c = 0; c < r; ++c)
                for (std::size_t v = 0; v < r; ++v) {
                    Rational sum = 0;
                    for (std::size_t m = 0; m < r; ++m)
                        sum += at(m, b, c) * at(v, a, m) + at(m, c, a) * at(v, b, m) + at(m, a, b) * at(v, c, m);
                    largest = std::max<Rational>(largest, abs(sum));
                }
    return largest;
}

/// "[e1,e2]=e3 [e1,e3]=-2e2", the form of docs/algebroids.md.
std::string printed_brackets(const NamedAlgebra& algebra)
{
    std::ostringstream text;
    for (const StructureConstant& entry : algebra.constants) {
        const Rational size = abs(entry.value);
        text << (text.tellp() > 0 ? " " : "") << "[e" << entry.a + 1 << ",e" << entry.b + 1
             << "]=" << (entry.value < 0 ? "-" : "") << (size == 1 ? "" : size.get_str()) << "e" << entry.c + 1;
    }
    return text.str();
}

} // namespace

TEST_CASE("docs/algebroids.md lists the brackets that the named algebras have")
{
    std::ifstream file(std::string(LAGEN_SOURCE_DIR) + "/docs/algebroids.md");
    std::ostringstream whole;
    whole << file.rdbuf();
    const std::string text = whole.str();
    for (const char* name : {"so(3)", "su(2)", "se(2)", "se(3)", "so(2,1)", "sl(2)", "heis(3)", "aff(1)"}) {
        INFO(name);
        const std::size_t row = text.find("\n| `" + std::string(name) + "` |");
        REQUIRE(row != std::string::npos);
        const std::string line = text.substr(row + 1, text.find('\n', row + 1) - row - 1);
        const std::string brackets = "| " + printed_brackets(*named_algebra(name)) + " |";
        CHECK(line.substr(line.size() - std::min(line.size(), brackets.size())) == brackets);
    }
}

TEST_CASE("the commutators of the matrices are the brackets of the table")
{
    CHECK(brackets("so(3)") == "[1,2]=1*3 [1,3]=-1*2 [2,3]=1*1 ");
    CHECK(brackets("su(2)") == brackets("so(3)"));
    CHECK(brackets("se(2)") == "[1,2]=1*3 [1,3]=-1*2 ");
    CHECK(brackets("so(2,1)") == "[1,2]=-1*3 [1,3]=-1*2 [2,3]=1*1 ");
    CHECK(brackets("sl(2)") == "[1,2]=2*2 [1,3]=-2*3 [2,3]=1*1 ");
    CHECK(brackets("heis(3)") == "[1,2]=1*3 ");
    CHECK(brackets("aff(1)") == "[1,2]=1*2 ");
    CHECK(brackets("R^4").empty());
    CHECK(brackets("se(3)") == "[1,2]=1*3 [1,3]=-1*2 [1,5]=1*6 [1,6]=-1*5 [2,3]=1*1 [2,4]=-1*6 [2,6]=1*4 "
                               "[3,4]=1*5 [3,5]=-1*4 ");
}

TEST_CASE("the elementary matrices of gl(2) have the brackets E_ij E_kl - E_kl E_ij")
{
    CHECK(brackets("gl(2)") == "[1,2]=1*2 [1,3]=-1*3 [2,3]=1*1 [2,3]=-1*4 [2,4]=1*2 [3,4]=-1*3 ");
}

TEST_CASE("ranks and the Jacobi identity hold in every family")
{
    const std::pair<const char*, std::size_t> cases[] = {
        {"so(3)", 3}, {"su(2)", 3},   {"so(4)", 6},       {"so(5)", 10},        {"se(2)", 3},
        {"se(3)", 6}, {"so(2,1)", 3}, {"sl(2)", 3},       {"heis(3)", 3},       {"aff(1)", 2},
        {"gl(3)", 9}, {"R^3", 3},     {"so(3) + R^2", 5}, {"se(2)+aff(1)+R", 6}};
    for (const auto& [name, rank] : cases) {
        INFO(name);
        const std::optional<NamedAlgebra> algebra = named_algebra(name);
        REQUIRE(algebra);
        CHECK(algebra->basis.size() == rank);
        CHECK(jacobi_defect(*algebra) == 0);
    }
}

TEST_CASE("a sum of algebras is block diagonal")
{
    CHECK(brackets("aff(1) + heis(3)") == "[1,2]=1*2 [3,4]=1*5 ");
    const std::optional<NamedAlgebra> sum = named_algebra("aff(1) + heis(3)");
    CHECK(sum->name == "aff(1) + heis(3)");
    CHECK(sum->size == 5);
    CHECK(sum->basis[2].front().row == 2);
}

TEST_CASE("unknown names, empty summands and huge ranks are no algebras")
{
    for (const char* name : {"", "so", "so(x)", "so(3) +", "so(1)", "so(999999)", "R^0", "R^1000", "gl(12)", "sp(4)"}) {
        INFO(name);
        CHECK_FALSE(named_algebra(name).has_value());
    }
}
