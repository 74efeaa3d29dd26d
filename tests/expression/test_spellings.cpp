// SPDX-License-Identifier: GPL-2.0-or-later
/// What other languages and keyboards write, and what is said of it.
#include "closing.hpp"
#include "parsing.hpp"

#include <catch2/catch.hpp>

#include <utility>

using namespace lagen;
using namespace lagen::test;

namespace {

std::string hint_of(const std::string& message)
{
    const std::size_t at = message.find("hint: ");
    return at == std::string::npos ? "" : message.substr(at + 6);
}

} // namespace

TEST_CASE("every sign that looks like an operator is answered with the operator")
{
    const std::pair<const char*, const char*> signs[] = {
        {"−", "the minus sign is written '-'"},
        {"–", "the minus sign is written '-'"},
        {"×", "a product is written '*'"},
        {"·", "a product is written '*'"},
        {"⋅", "a product is written '*'"},
        {"÷", "a quotient is written '/'"},
        {"²", "a square is written '^2'"},
        {"³", "a cube is written '^3'"},
        {"√", "a square root is written 'sqrt(x)'"},
        {"≤", "'less or equal' is written '<='"},
        {"≥", "'greater or equal' is written '>='"},
        {"≠", "'not equal' is written '!='"},
        {"=", "equality is written '=='"},
        {"!", "'not equal' is written '!='"},
        {"{", "terms are grouped with '(' and ')', and vectors are written [a, b]"},
        {"}", "terms are grouped with '(' and ')', and vectors are written [a, b]"},
        {"|", "an absolute value is written 'abs(x)'"},
        {"'", "a derivative has no sign of its own: give it a name"},
    };
    for (const auto& [sign, hint] : signs) CHECK(hint_of(error_of("x " + std::string(sign) + " x")) == hint);
}

TEST_CASE("every name of another language is answered with this language's own")
{
    const std::pair<const char*, const char*> names[] = {
        {"π", "the constant is written pi"},
        {"PI", "the constant is written pi"},
        {"M_PI", "the constant is written pi"},
        {"e", "the exponential function is written exp(x)"},
        {"ln(w)", "the natural logarithm is written log(x)"},
        {"log10(w)", "log is the natural logarithm: log(x)/log(10)"},
        {"log2(w)", "log is the natural logarithm: log(x)/log(2)"},
        {"pow(w, 2)", "a power is written x^y"},
        {"cbrt(w)", "a cube root is written x^(1/3)"},
        {"hypot(w, w)", "this is written sqrt(x^2 + y^2)"},
        {"arcsin(w)", "did you mean 'asin'?"},
        {"arccos(w)", "did you mean 'acos'?"},
        {"arctan(w)", "did you mean 'atan'?"},
        {"arctan2(w, w)", "did you mean 'atan2'?"},
        {"fabs(w)", "did you mean 'abs'?"},
        {"sgn(w)", "did you mean 'sign'?"},
        {"sec(w)", "this is written 1/cos(x)"},
        {"csc(w)", "this is written 1/sin(x)"},
        {"cot(w)", "this is written cos(x)/sin(x)"},
        {"coth(w)", "this is written cosh(x)/sinh(x)"},
        {"asinh(w)", "this is written log(x + sqrt(x^2 + 1))"},
        {"acosh(w)", "this is written log(x + sqrt(x^2 - 1))"},
        {"atanh(w)", "this is written log((1 + x)/(1 - x))/2"},
        {"inf", "infinity is no number: the open end of a control's bounds is \"-inf\" below and \"inf\" above"},
        {"infinity", "infinity is no number: the open end of a control's bounds is \"-inf\" below and \"inf\" above"},
    };
    Scope scope;
    scope.declare("w", {});
    for (const auto& [name, hint] : names) {
        INFO(name);
        CHECK(hint_of(closed_text(scope, name)) == hint);
    }
}
