// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/print_literal.hpp"

#include "text/alphabet.hpp"

#include <fmt/format.h>
#include <mpfr.h>

#include <cmath>

namespace lagen {

namespace {

/// The shortest decimal that reads back as the same double, with a point so that C++ takes it for a double.
std::string print_double(double value)
{
    std::string text = fmt::format("{}", value);
    if (text.find_first_of(".e") == std::string::npos) text += ".0";
    return text;
}

bool fits_53_bits(const mpz_class& value)
{
    return mpz_sizeinbase(value.get_mpz_t(), 2) <= 53;
}

std::string print_integer(const mpz_class& value)
{
    if (mpz_sizeinbase(value.get_mpz_t(), 2) <= 31) return fmt::format("S({})", value.get_str());
    return fmt::format("S({})", print_double(value.get_d()));
}

Spelling print_two_doubles(const Rational& value)
{
    const double high = nearest_double(value);
    if (!std::isfinite(high) || high == 0) { // beyond the range of double: a double times a power of ten, twice at most
        const bool large = high != 0;
        mpz_class scale;
        mpz_ui_pow_ui(scale.get_mpz_t(), 10, 300);
        const Rational scaled = large ? Rational(value / scale) : Rational(value * scale);
        return {print_two_doubles(scaled).text + (large ? " * S(1e+300)" : " * S(1e-300)"), 2};
    }
    const double low = nearest_double(value - Rational(high));
    if (low == 0) return {fmt::format("S({})", print_double(high)), 5};
    return {fmt::format("(S({}) {} S({}))", print_double(high), low < 0 ? '-' : '+', print_double(std::abs(low))), 5};
}

} // namespace

double nearest_double(const Rational& value)
{
    mpfr_t number;
    mpfr_init2(number, 53);
    mpfr_set_q(number, value.get_mpq_t(), MPFR_RNDN);
    const double result = mpfr_get_d(number, MPFR_RNDN);
    mpfr_clear(number);
    return result;
}

Spelling print_literal(const Rational& value)
{
    const mpz_class& p = value.get_num();
    const mpz_class& q = value.get_den();
    if (!fits_53_bits(p) || !fits_53_bits(q)) return print_two_doubles(value);
    if (q == 1) return {print_integer(p), 5};
    if (mpz_popcount(q.get_mpz_t()) == 1 && q <= 1024) return {fmt::format("S({})", print_double(value.get_d())), 5};
    return {fmt::format("{} / {}", print_integer(p), print_integer(q)), 2};
}

Spelling print_pi()
{
    return {"arithmetic::pi<S>()", 5};
}

std::string plain_text(std::string_view text)
{
    std::string result;
    for (const char c : text) {
        const bool control = static_cast<unsigned char>(c) < 0x20U || c == 0x7f;
        const char kept = control ? ' ' : c == '\\' ? '/' : c;
        const char last = result.empty() ? '\0' : result.back();
        if ((last == '?' && kept == '?') || (last == '*' && kept == '/')) result += ' ';
        result += kept;
    }
    while (!result.empty() && result.back() == ' ') result.pop_back();
    return result;
}

std::string comment_text(std::string_view text)
{
    constexpr std::size_t longest = 200; // bytes
    return plain_text(whole_characters(text, longest)) + (text.size() > longest ? "..." : "");
}

std::string string_literal(std::string_view text)
{
    std::string result = "\"";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\')
            result += {'\\', c};
        else if (byte < 0x20U || byte == 0x7fU || c == '?') // '?' could start a trigraph
            result += fmt::format("\\{:03o}", static_cast<unsigned>(byte));
        else
            result += c;
    }
    return result + '"';
}

} // namespace lagen
