// SPDX-License-Identifier: GPL-2.0-or-later
/// Rational functions of x, y, z, k, sin z and cos z, for an oracle that shares no code with the project: sums,
/// products, partial derivatives, exact values, and a text that a model can hold. sin z and cos z are variables of
/// their own (s, c) with ds/dz = c and dc/dz = -s; what vanishes at random points with s^2 + c^2 = 1 vanishes.
#pragma once

#include <gmpxx.h>

#include <array>
#include <map>
#include <string>

namespace lagen::oracle {

enum Variable { x, y, z, k, s, c };
inline constexpr std::size_t variable_count = 6;
using Exponents = std::array<unsigned, variable_count>;
using Point = std::array<mpq_class, variable_count>;

/// Coefficients by exponents; no zero ones.
class Polynomial {
  public:
    Polynomial() = default;
    Polynomial(const mpq_class& number) { add_term({}, number); } // NOLINT: numbers are polynomials
    Polynomial(int number) : Polynomial(mpq_class(number)) {}     // NOLINT
    static Polynomial of(Variable variable)
    {
        Exponents exponents{};
        exponents[variable] = 1;
        Polynomial result;
        result.add_term(exponents, 1);
        return result;
    }

    void add_term(const Exponents& exponents, const mpq_class& coefficient)
    {
        mpq_class& sum = terms_[exponents];
        sum += coefficient;
        if (sum == 0) terms_.erase(exponents);
    }
    [[nodiscard]] bool is_zero() const { return terms_.empty(); }
    [[nodiscard]] mpq_class at(const Point& point) const
    {
        mpq_class sum;
        for (const auto& [exponents, coefficient] : terms_) {
            mpq_class term = coefficient;
            for (std::size_t v = 0; v < variable_count; ++v)
                for (unsigned n = 0; n < exponents[v]; ++n) term *= point[v];
            sum += term;
        }
        return sum;
    }
    [[nodiscard]] Polynomial derivative(Variable variable) const
    {
        Polynomial result;
        for (const auto& [exponents, coefficient] : terms_) {
            lower(result, exponents, coefficient, variable, variable_count);
            if (variable == z) {
                lower(result, exponents, coefficient, s, c);
                lower(result, exponents, -coefficient, c, s);
            }
        }
        return result;
    }
    [[nodiscard]] std::string text() const
    {
        static constexpr const char* names[] = {"x", "y", "z", "k", "sin(z)", "cos(z)"};
        std::string sum;
        for (const auto& [exponents, coefficient] : terms_) {
            std::string term = "(" + coefficient.get_str() + ")";
            for (std::size_t v = 0; v < variable_count; ++v)
                if (exponents[v] > 0) term += std::string("*") + names[v] + "^" + std::to_string(exponents[v]);
            sum += (sum.empty() ? "" : " + ") + term;
        }
        return sum.empty() ? "0" : sum;
    }

    friend Polynomial operator+(Polynomial a, const Polynomial& b)
    {
        for (const auto& [exponents, coefficient] : b.terms_) a.add_term(exponents, coefficient);
        return a;
    }
    friend Polynomial operator*(const Polynomial& a, const Polynomial& b)
    {
        Polynomial result;
        for (const auto& [left, p] : a.terms_)
            for (const auto& [right, q] : b.terms_) {
                Exponents sum = left;
                for (std::size_t v = 0; v < variable_count; ++v) sum[v] += right[v];
                result.add_term(sum, p * q);
            }
        return result;
    }
    friend Polynomial operator-(const Polynomial& a, const Polynomial& b) { return a + Polynomial(-1) * b; }

  private:
    /// result += exponent * (the term with one power of `variable` replaced by `instead`, where there is one)
    static void lower(Polynomial& result, Exponents exponents, const mpq_class& coefficient, std::size_t variable,
                      std::size_t instead)
    {
        const unsigned n = exponents[variable];
        if (n == 0) return;
        --exponents[variable];
        if (instead < variable_count) ++exponents[instead];
        result.add_term(exponents, coefficient * n);
    }

    std::map<Exponents, mpq_class> terms_;
};

/// numerator / denominator, nothing cancelled.
struct Quotient {
    Polynomial numerator, denominator = 1;

    Quotient() = default;
    Quotient(Polynomial p) : numerator(std::move(p)) {} // NOLINT: polynomials are quotients
    Quotient(int number) : numerator(number) {}         // NOLINT
    Quotient(Polynomial p, Polynomial q) : numerator(std::move(p)), denominator(std::move(q)) {}

    [[nodiscard]] bool is_zero() const { return numerator.is_zero(); }
    [[nodiscard]] mpq_class at(const Point& point) const { return numerator.at(point) / denominator.at(point); }
    [[nodiscard]] Quotient derivative(Variable variable) const
    {
        return {numerator.derivative(variable) * denominator - numerator * denominator.derivative(variable),
                denominator * denominator};
    }
    [[nodiscard]] std::string text() const { return "(" + numerator.text() + ")/(" + denominator.text() + ")"; }

    friend Quotient operator+(const Quotient& a, const Quotient& b)
    {
        if (a.is_zero()) return b;
        if (b.is_zero()) return a;
        return {a.numerator * b.denominator + b.numerator * a.denominator, a.denominator * b.denominator};
    }
    friend Quotient operator*(const Quotient& a, const Quotient& b)
    {
        if (a.is_zero() || b.is_zero()) return {};
        return {a.numerator * b.numerator, a.denominator * b.denominator};
    }
    friend Quotient operator-(const Quotient& a, const Quotient& b) { return a + Quotient(-1) * b; }
};

} // namespace lagen::oracle
