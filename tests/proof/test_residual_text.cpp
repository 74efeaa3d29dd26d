// SPDX-License-Identifier: GPL-2.0-or-later
/// The texts of long residuals.
#include "problem.hpp"

#include <catch2/catch.hpp>

using namespace lagen;
using namespace lagen::test;

namespace {

/// Names of 40 letters: 12 of them fill more than a residual's text.
std::string long_name(int k)
{
    return std::string(38, 'a') + std::to_string(10 + k);
}

std::string residual_of(const std::string& text)
{
    std::vector<std::string> names;
    for (int k = 0; k < 12; ++k) names.push_back(long_name(k));
    return Problem({names, {}, {}, {}, {}}).decide(text).residual;
}

std::string product_of_all()
{
    std::string text = long_name(0);
    for (int k = 1; k < 12; ++k) text += "*" + long_name(k);
    return text;
}

} // namespace

TEST_CASE("a residual of one long term is cut in the term")
{
    const std::string text = residual_of(product_of_all());
    CHECK(text == product_of_all().substr(0, 397) + "...");
}

TEST_CASE("a residual of long terms shows the beginning of the first and the number of terms")
{
    const std::string text = residual_of(product_of_all() + " + 1");
    CHECK(text == product_of_all().substr(0, 383) + "... ... (2 terms)");
    CHECK(text.size() <= 400);
}

TEST_CASE("a residual of many terms shows whole terms and their number")
{
    std::string sum;
    std::string shown;
    for (int k = 0; k < 12; ++k) sum += (k == 0 ? "" : " + ") + long_name(k);
    for (int k = 0; k < 9; ++k) shown += (k == 0 ? "" : " + ") + long_name(k);
    CHECK(residual_of(sum) == shown + " ... (12 terms)");
}
