// SPDX-License-Identifier: GPL-2.0-or-later
/// Exact folding of constants within bounds, degrees of powers, heights.
#include "expression/measure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace lagen {

namespace {

constexpr long degree_ceiling =
    std::numeric_limits<long>::max() / 1024; ///< sums and products by an exponent stay in range

std::size_t bits(const mpz_class& value)
{
    return mpz_sizeinbase(value.get_mpz_t(), 2);
}
std::size_t bits(const Rational& value)
{
    return std::max(bits(value.get_num()), bits(value.get_den()));
}

/// Digits of a number for a message, at most 24 of them.
std::string shown(const Rational& value)
{
    const std::string text = value.get_str();
    return text.size() <= 24 ? text : text.substr(0, 20) + "...";
}

[[noreturn]] void constant_too_large(const SourceRange& where, const ParseLimits& limits)
{
    throw ModelError(
        fmt::format("a constant needs more than {} bits", limits.number_bits), where,
        fmt::format("constants are kept as exact fractions, whose numerators and denominators are bounded by "
                    "{} bits",
                    limits.number_bits));
}

void require_small(const Rational& value, const SourceRange& where, const ParseLimits& limits)
{
    if (bits(value) > limits.number_bits) constant_too_large(where, limits);
}

[[noreturn]] void division_by_zero(const SourceRange& where)
{
    throw ModelError("division by zero", where, "");
}

/// base^n for an integer n, refused before it is computed where it would be too large.
Rational integer_power(const Rational& base, const mpz_class& n, const SourceRange& where, const ParseLimits& limits)
{
    if (base == 0 && n < 0) division_by_zero(where);
    if (n == 0 || base == 1) return 1;
    if (base == 0) return 0;
    if (base == -1) return mpz_odd_p(n.get_mpz_t()) ? -1 : 1;
    const mpz_class size = abs(n);
    // |base| or its inverse has at least `bits - 1` factors of 2 above or below the bar.
    const mpz_class least = size * static_cast<unsigned long>(bits(base) - 1);
    if (least > static_cast<unsigned long>(limits.number_bits)) constant_too_large(where, limits);
    const unsigned long count = size.get_ui();
    mpz_class numerator, denominator;
    mpz_pow_ui(numerator.get_mpz_t(), base.get_num_mpz_t(), count);
    mpz_pow_ui(denominator.get_mpz_t(), base.get_den_mpz_t(), count);
    Rational result = n > 0 ? Rational(numerator, denominator) : Rational(denominator, numerator);
    result.canonicalize();
    require_small(result, where, limits);
    return result;
}

Measure measure_sum(const TreeNode& node, std::span<const Measure> terms, const ParseLimits& limits)
{
    Measure result{.constant = true, .factor = 0, .degree = 0};
    for (const Measure& term : terms) {
        result.degree = std::max(result.degree, term.degree);
        if (term.constant) {
            result.factor += term.factor;
            require_small(result.factor, node.where, limits);
        } else {
            result.constant = false;
        }
    }
    if (!result.constant) result.factor = 1;
    return result;
}

[[noreturn]] void degree_too_large(const char* what, const Measure& measure, const SourceRange& where,
                                   const ParseLimits& limits)
{
    throw ModelError(fmt::format("{} the total degree {}", what, measure.degree), where,
                     fmt::format("the total degree of a power or a product is at most {}", limits.degree));
}

Measure measure_product(const TreeNode& node, std::span<const Measure> factors, const ParseLimits& limits)
{
    Measure result{.constant = true, .factor = 1, .degree = 0};
    for (const Measure& factor : factors) {
        result.constant = result.constant && factor.constant;
        result.factor *= factor.factor;
        require_small(result.factor, node.where, limits);
        result.degree = std::min(result.degree + factor.degree, degree_ceiling);
    }
    if (result.degree > limits.product_degree) degree_too_large("a product reaches", result, node.where, limits);
    return result;
}

Measure measure_quotient(const TreeNode& node, const Measure& above, const Measure& below, const ParseLimits& limits)
{
    if (below.constant && below.factor == 0) division_by_zero(node.where);
    Measure result{.constant = above.constant && below.constant,
                   .factor = below.factor == 0 ? above.factor : Rational(above.factor / below.factor),
                   .degree = std::min(above.degree + below.degree, degree_ceiling)};
    require_small(result.factor, node.where, limits);
    if (result.degree > limits.product_degree) degree_too_large("a quotient reaches", result, node.where, limits);
    return result;
}

/// A power of something that is not a constant, with a constant exponent.
Measure measure_power_of_symbols(const TreeNode& node, const Measure& base, const Rational& exponent,
                                 const ParseLimits& limits)
{
    if (abs(exponent) > limits.exponent)
        throw ModelError(
            fmt::format("the exponent {} is too large", shown(exponent)), node.arguments[1]->where,
            fmt::format("the exponent of a base that is not a constant is at most {} in size", limits.exponent));
    Measure result;
    const mpz_class whole = exponent.get_num() / exponent.get_den();
    const long size = std::abs(whole.get_si()) + (exponent.get_den() == 1 ? 0 : 1);
    result.degree = std::min(base.degree, degree_ceiling / (size + 1)) * size;
    if (size > 1 && result.degree > limits.degree) degree_too_large("nested powers reach", result, node.where, limits);
    if (exponent.get_den() == 1 && base.factor != 0)
        result.factor = integer_power(base.factor, exponent.get_num(), node.where, limits);
    return result;
}

Measure measure_power(const TreeNode& node, const Measure& base, const Measure& exponent, const ParseLimits& limits)
{
    if (!exponent.constant) return {};
    if (!base.constant) return measure_power_of_symbols(node, base, exponent.factor, limits);
    if (base.factor == 0 && exponent.factor == 0) throw ModelError("0^0 is not defined", node.where, "");
    if (exponent.factor.get_den() == 1) {
        const mpz_class n = exponent.factor.get_num();
        return {.constant = true, .factor = integer_power(base.factor, n, node.where, limits), .degree = 0};
    }
    if (base.factor == 0 && exponent.factor < 0) division_by_zero(node.where);
    const Rational size = abs(exponent.factor) * static_cast<unsigned long>(bits(base.factor));
    if (size > static_cast<unsigned long>(limits.number_bits)) constant_too_large(node.where, limits);
    return {};
}

/// Everything but the height and the first function that is not smooth.
Measure measure_content(const TreeNode& node, std::span<const Measure> arguments, const ParseLimits& limits)
{
    switch (node.kind) {
    case TreeKind::number:
        require_small(node.number, node.where, limits);
        return {.constant = true, .factor = node.number, .degree = 0};
    case TreeKind::negate: {
        Measure result = arguments[0];
        result.factor = -result.factor;
        return result;
    }
    case TreeKind::add: return measure_sum(node, arguments, limits);
    case TreeKind::multiply: return measure_product(node, arguments, limits);
    case TreeKind::divide: return measure_quotient(node, arguments[0], arguments[1], limits);
    case TreeKind::power: return measure_power(node, arguments[0], arguments[1], limits);
    default: return {};
    }
}

} // namespace

Measure measure(const TreeNode& node, std::span<const Measure> arguments, const ParseLimits& limits)
{
    Measure result = measure_content(node, arguments, limits);
    result.height = 0;
    result.terms = 1;
    result.nonsmooth = nullptr;
    for (const Measure& argument : arguments) {
        result.height = std::max(result.height, argument.height);
        result.terms = std::max(result.terms, argument.terms);
        if (!result.nonsmooth) result.nonsmooth = argument.nonsmooth;
    }
    ++result.height;
    if (node.kind == TreeKind::call && !entry_of(node.function).smooth) result.nonsmooth = &node;
    if (result.height > limits.height)
        throw ModelError(fmt::format("more than {} operations stand inside one another", limits.height), node.where,
                         "regroup the expression, for instance a/b/c/d as a/(b*c*d)");
    return result;
}

} // namespace lagen
