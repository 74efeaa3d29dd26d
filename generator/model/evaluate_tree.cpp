// SPDX-License-Identifier: GPL-2.0-or-later
/// Forward-mode evaluation of trees. Closed trees are at most 2000 levels deep (Scope::close), so plain recursion is
/// safe.
#include "model/evaluate_tree.hpp"

#include "expression/evaluate_stumpff.hpp"
#include "expression/linear_algebra.hpp"

#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numbers>

namespace lagen {

namespace {

Dual operator+(Dual a, Dual b)
{
    return {a.value + b.value, a.derivative + b.derivative};
}
Dual operator*(Dual a, Dual b)
{
    return {a.value * b.value, a.derivative * b.value + a.value * b.derivative};
}
Dual operator/(Dual a, Dual b)
{
    const long double quotient = a.value / b.value;
    return {quotient, (a.derivative - quotient * b.derivative) / b.value};
}

/// f(a), with f'(a) given; a constant argument stays constant where f' is infinite.
Dual chain(long double value, long double slope, Dual a)
{
    return {value, a.derivative == 0 ? 0.0L : slope * a.derivative};
}

Dual integer_power(Dual base, long exponent)
{
    Dual result{1, 0};
    Dual square = base;
    for (unsigned long n = exponent < 0 ? 0UL - static_cast<unsigned long>(exponent)
                                        : static_cast<unsigned long>(exponent);
         n != 0; n >>= 1U) {
        if (n & 1U) result = result * square;
        if (n > 1) square = square * square;
    }
    return exponent < 0 ? Dual{1, 0} / result : result;
}

Dual real_power(Dual a, Dual b)
{
    if (b.derivative == 0 && b.value == std::trunc(b.value) && std::fabs(b.value) < 1e9L) {
        return integer_power(a, static_cast<long>(b.value));
    }
    const long double value = std::pow(a.value, b.value);
    long double slope = 0;
    if (a.derivative != 0) slope += b.value * std::pow(a.value, b.value - 1) * a.derivative;
    if (b.derivative != 0) slope += value * std::log(a.value) * b.derivative;
    return {value, slope};
}

/// c_k' = (k c_{k+2} - c_{k+1}) / 2.
Dual stumpff_function(long double order, Dual z)
{
    const auto k = static_cast<unsigned>(order);
    const long double slope = (order * evaluate_stumpff(k + 2, z.value) - evaluate_stumpff(k + 1, z.value)) / 2;
    return chain(evaluate_stumpff(k, z.value), slope, z);
}

/// Of values with derivatives; the values choose the pivots.
struct DualArithmetic {
    using Number = Dual;
    [[nodiscard]] bool is_better_pivot(Dual a, Dual than) const { return std::fabs(a.value) > std::fabs(than.value); }
    [[nodiscard]] bool is_pivot(Dual a) const { return std::fabs(a.value) > 0; }
    [[nodiscard]] Dual quotient(Dual a, Dual b) const { return a / b; }
    void subtract_product(Dual& a, Dual f, Dual b) const { a = a + Dual{-1, 0} * f * b; }
    [[nodiscard]] std::vector<Dual> no_solution(std::size_t n) const
    {
        constexpr long double nan = std::numeric_limits<long double>::quiet_NaN();
        return std::vector<Dual>(n, Dual{nan, nan});
    }
};

/// Component `row` of A^-1 b; `a` holds the n*n entries of A by rows, then b. Not a number where A is singular.
Dual solve_system(const std::vector<Dual>& a, std::size_t row)
{
    const std::size_t n = solve_order(a.size());
    const auto middle = a.begin() + static_cast<std::ptrdiff_t>(n * n);
    const Factorisation<Dual> factors = factorise(std::vector<Dual>(a.begin(), middle), n, DualArithmetic{});
    return substitute(factors, std::vector<Dual>(middle, a.end()), DualArithmetic{})[row];
}

Dual call_function(Function function, const std::vector<Dual>& args)
{
    const Dual a = args[0];
    const long double x = a.value;
    switch (function) {
    case Function::sin: return chain(std::sin(x), std::cos(x), a);
    case Function::cos: return chain(std::cos(x), -std::sin(x), a);
    case Function::tan: return chain(std::tan(x), 1 + std::tan(x) * std::tan(x), a);
    case Function::asin: return chain(std::asin(x), 1 / std::sqrt(1 - x * x), a);
    case Function::acos: return chain(std::acos(x), -1 / std::sqrt(1 - x * x), a);
    case Function::atan: return chain(std::atan(x), 1 / (1 + x * x), a);
    case Function::atan2: {
        const long double z = args[1].value;
        const long double square = x * x + z * z;
        return {std::atan2(x, z), (a.derivative * z - x * args[1].derivative) / square};
    }
    case Function::sinh: return chain(std::sinh(x), std::cosh(x), a);
    case Function::cosh: return chain(std::cosh(x), std::sinh(x), a);
    case Function::tanh: return chain(std::tanh(x), 1 - std::tanh(x) * std::tanh(x), a);
    case Function::exp: return chain(std::exp(x), std::exp(x), a);
    case Function::log: return chain(std::log(x), 1 / x, a);
    case Function::sqrt: return chain(std::sqrt(x), 1 / (2 * std::sqrt(x)), a);
    case Function::abs: return x < 0 ? Dual{-x, -a.derivative} : a;
    case Function::minimum: return args[1].value < x ? args[1] : a;
    case Function::maximum: return args[1].value > x ? args[1] : a;
    case Function::stumpff: return stumpff_function(x, args[1]);
    case Function::sign: return {x > 0 ? 1.0L : x < 0 ? -1.0L : x, 0};
    case Function::select: return x != 0 ? args[1] : args[2];
    case Function::erf: return chain(std::erf(x), 2 * std::numbers::inv_sqrtpi_v<long double> * std::exp(-x * x), a);
    case Function::dot:
    case Function::cross:
    case Function::norm:
    case Function::trace:
    case Function::transpose:
    case Function::det:
    case Function::inverse:
    case Function::diag:
    case Function::identity:
    case Function::hat:
    case Function::vee:
    case Function::cay: break; // gone after closing
    }
    throw InternalError("a function without a value");
}

bool holds(Comparison comparison, long double a, long double b)
{
    switch (comparison) {
    case Comparison::less: return a < b;
    case Comparison::less_equal: return a <= b;
    case Comparison::greater: return a > b;
    case Comparison::greater_equal: return a >= b;
    case Comparison::equal: return a == b;
    case Comparison::not_equal: return a != b;
    }
    return false;
}

class Evaluation {
  public:
    explicit Evaluation(const Values& values) : values_(values) {}

    Dual operator()(const Tree& tree)
    {
        const auto known = done_.find(tree.get());
        if (known != done_.end()) return known->second;
        std::vector<Dual> args;
        for (const Tree& argument : tree->arguments) args.push_back((*this)(argument));
        const Dual value = combine(*tree, args);
        done_.emplace(tree.get(), value);
        return value;
    }

  private:
    [[nodiscard]] Dual combine(const TreeNode& node, const std::vector<Dual>& args) const
    {
        switch (node.kind) {
        case TreeKind::number: return {to_long_double(node.number), 0};
        case TreeKind::pi: return {std::numbers::pi_v<long double>, 0};
        case TreeKind::name: return value_of(node);
        case TreeKind::negate: return {-args[0].value, -args[0].derivative};
        case TreeKind::add: {
            Dual sum;
            for (const Dual& term : args) sum = sum + term;
            return sum;
        }
        case TreeKind::multiply: {
            Dual product{1, 0};
            for (const Dual& factor : args) product = product * factor;
            return product;
        }
        case TreeKind::divide: return args[0] / args[1];
        case TreeKind::power: return real_power(args[0], args[1]);
        case TreeKind::call: return call_function(node.function, args);
        case TreeKind::solve: return solve_system(args, node.number.get_num().get_ui());
        case TreeKind::compare: return {holds(node.comparison, args[0].value, args[1].value) ? 1.0L : 0.0L, 0};
        default: break;
        }
        throw InternalError(fmt::format("the tree of '{}' is not closed", node.name));
    }

    [[nodiscard]] Dual value_of(const TreeNode& node) const
    {
        const auto place = values_.find(node.name);
        if (place != values_.end()) return place->second;
        throw ModelError(fmt::format("'{}' has no value here", node.name), node.where);
    }

    const Values& values_;
    std::map<const TreeNode*, Dual> done_;
};

} // namespace

Dual evaluate(const Tree& tree, const Values& values)
{
    return Evaluation(values)(tree);
}

long double to_long_double(const Rational& number)
{
    // Scaled integer quotient with 65 bits or more, then one rounding: num/den 2^shift lies in [2^65, 2^67).
    if (number == 0) return 0;
    const mpz_class numerator = abs(number.get_num());
    const long size = static_cast<long>(mpz_sizeinbase(numerator.get_mpz_t(), 2)) -
                      static_cast<long>(mpz_sizeinbase(number.get_den_mpz_t(), 2));
    const long shift = 66 - size;
    mpz_class scaled = numerator;
    mpz_class divisor = number.get_den();
    if (shift > 0) scaled <<= static_cast<unsigned long>(shift);
    if (shift < 0) divisor <<= static_cast<unsigned long>(-shift);
    mpz_class quotient = scaled / divisor;
    const bool inexact = quotient * divisor != scaled;
    // Keep 64 bits plus a half bit and a sticky bit, so that the sum below rounds once and to nearest.
    const unsigned long extra = mpz_sizeinbase(quotient.get_mpz_t(), 2) - 64;
    mpz_class high = quotient >> extra;
    const mpz_class low = quotient - (high << extra);
    const mpz_class half = mpz_class(1) << (extra - 1);
    const bool odd = mpz_odd_p(high.get_mpz_t()) != 0;
    if (low > half || (low == half && (inexact || odd))) high += 1;
    const mpz_class top = high >> 32U;
    const mpz_class bottom = high - (top << 32U);
    const long double mantissa =
        std::ldexp(static_cast<long double>(top.get_ui()), 32) + static_cast<long double>(bottom.get_ui());
    const long double magnitude = std::ldexp(mantissa, static_cast<int>(static_cast<long>(extra) - shift));
    return number < 0 ? -magnitude : magnitude;
}

} // namespace lagen
