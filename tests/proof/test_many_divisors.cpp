// SPDX-License-Identifier: GPL-2.0-or-later
/// Sums over many different divisors.
#include "problem.hpp"

#include <catch2/catch.hpp>

using namespace lagen;
using namespace lagen::test;

namespace {

/// d/dt of sum m_i v_i, one component, for n bodies in a plane: sum_ij m_i m_j (x_j - x_i)/r_ij^3.
std::string force_sum(int n, const std::string& power)
{
    std::string sum = "0";
    for (int i = 1; i <= n; ++i)
        for (int j = 1; j <= n; ++j) {
            if (i == j) continue;
            const std::string a = std::to_string(i), b = std::to_string(j);
            sum += " + m" + a + "*m" + b + "*(x" + b + " - x" + a + ")/((x" + b + " - x" + a + ")^2 + (y" + b + " - y" +
                   a + ")^2)^" + power;
        }
    return sum;
}

} // namespace

TEST_CASE("the internal forces of seven bodies in a plane cancel, and a changed mass is noticed")
{
    Statement statement;
    for (int k = 1; k <= 7; ++k) {
        statement.variables.push_back("x" + std::to_string(k));
        statement.variables.push_back("y" + std::to_string(k));
        statement.parameters.push_back("m" + std::to_string(k));
    }
    Problem problem(statement);
    const std::string sum = force_sum(7, "(3/2)");
    CHECK(to_text(problem.decide(sum).status) == std::string("proved"));
    CHECK(to_text(problem.decide(sum + " + (x1 - x2)/10^12").status) == std::string("refuted"));
}
