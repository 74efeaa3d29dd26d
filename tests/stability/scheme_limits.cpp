// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/scheme_limits.hpp"

#include "stability/polynomial.hpp"

#include <array>

namespace lagen {

namespace {

using namespace stability;

Polynomial trimmed(Polynomial p)
{
    while (!p.empty() && sgn(p.back()) == 0) p.pop_back();
    return p;
}

Polynomial derivative(const Polynomial& p)
{
    Polynomial slope;
    for (std::size_t k = 1; k < p.size(); ++k) slope.push_back(mpq_class(static_cast<unsigned long>(k)) * p[k]);
    return trimmed(slope);
}

struct Division {
    Polynomial quotient, remainder;
};

/// p = quotient q + remainder, q not 0.
Division divide(const Polynomial& p, const Polynomial& q)
{
    Division out{{}, trimmed(p)};
    Polynomial& rest = out.remainder;
    if (rest.size() >= q.size()) out.quotient.resize(rest.size() - q.size() + 1);
    while (rest.size() >= q.size()) {
        const std::size_t shift = rest.size() - q.size();
        const mpq_class factor = rest.back() / q.back();
        out.quotient[shift] = factor;
        for (std::size_t k = 0; k < q.size(); ++k) rest[shift + k] -= factor * q[k];
        rest = trimmed(rest);
    }
    return out;
}

/// Monic.
Polynomial common_divisor(Polynomial p, Polynomial q)
{
    p = trimmed(p);
    q = trimmed(q);
    while (!q.empty()) {
        Polynomial rest = divide(p, q).remainder;
        p = std::move(q);
        q = std::move(rest);
    }
    return mpq_class(1 / p.back()) * p;
}

/// The product of the factors that p has an odd number of times, with the sign of p: p >= 0 where this is, but for
/// single points [Yun 1976].
Polynomial odd_part(const Polynomial& p)
{
    const Polynomial whole = trimmed(p), slope = derivative(whole);
    Polynomial odd{mpq_class(sgn(whole.back()))};
    const Polynomial repeated = common_divisor(whole, slope);
    Polynomial b = divide(whole, repeated).quotient;
    Polynomial d = trimmed(divide(slope, repeated).quotient - derivative(b));
    for (int k = 1; b.size() > 1; ++k) {
        const Polynomial factor = d.empty() ? mpq_class(1 / b.back()) * b : common_divisor(b, d);
        if (k % 2 == 1) odd = odd * factor;
        b = divide(b, factor).quotient;
        if (!d.empty()) d = trimmed(divide(d, factor).quotient - derivative(b));
    }
    return odd;
}

/// Over [0, 1].
mpq_class integral(const Polynomial& p)
{
    mpq_class sum;
    for (std::size_t k = 0; k < p.size(); ++k) sum += p[k] / mpq_class(static_cast<unsigned long>(k + 1));
    return sum;
}

/// A polynomial curve through the ends of a step, and the polynomial whose zeros are the nodes of its quadrature.
struct GalerkinScheme {
    std::string_view name;
    std::size_t degree;
    Polynomial nodal;

    /// The quadrature of p, whose weights are those of interpolation: the integral of what interpolates p.
    [[nodiscard]] mpq_class quadrature(const Polynomial& p) const { return integral(divide(p, nodal).remainder); }
};

/// d^k/dx^k (x^2 - x)^power: Gauss' nodes where k = power, Lobatto's where k = power - 1 [Legendre, Rodrigues].
Polynomial rodrigues(std::size_t power, std::size_t k)
{
    const Polynomial factor{0, -1, 1};
    Polynomial p{1};
    for (std::size_t j = 0; j < power; ++j) p = p * factor;
    for (std::size_t j = 0; j < k; ++j) p = derivative(p);
    return p;
}

std::vector<GalerkinScheme> schemes()
{
    return {{"midpoint", 1, rodrigues(1, 1)},  {"left", 1, Polynomial{0, 1}},     {"trapezoidal", 1, rodrigues(1, 0)},
            {"gauss:1", 1, rodrigues(1, 1)},   {"gauss:2", 2, rodrigues(2, 2)},   {"gauss:3", 3, rodrigues(3, 3)},
            {"gauss:4", 4, rodrigues(4, 4)},   {"lobatto:2", 1, rodrigues(1, 0)}, {"lobatto:3", 2, rodrigues(2, 1)},
            {"lobatto:4", 3, rodrigues(3, 2)}, {"lobatto:5", 4, rodrigues(4, 3)}};
}

using Matrix = std::vector<std::vector<Polynomial>>;

/// By its first row.
Polynomial determinant(const Matrix& a)
{
    if (a.empty()) return {1};
    Polynomial sum;
    for (std::size_t j = 0; j < a.size(); ++j) {
        Matrix minor;
        for (std::size_t i = 1; i < a.size(); ++i) {
            minor.push_back(a[i]);
            minor.back().erase(minor.back().begin() + static_cast<std::ptrdiff_t>(j));
        }
        sum = sum + mpq_class(j % 2 == 0 ? 1 : -1) * (a[0][j] * determinant(minor));
    }
    return sum;
}

/// F(u) of the discrete Lagrangian z^T F z / 2h of x'^2/2 - omega^2 x^2/2, u = (h omega)^2, over the ends of the step
/// and the factors of x (1 - x) x^k.
Matrix action_matrix(const GalerkinScheme& scheme)
{
    std::vector<Polynomial> basis{{1, -1}, {0, 1}};
    Polynomial bubble{0, 1, -1};
    for (std::size_t k = 2; k <= scheme.degree; ++k) {
        basis.push_back(bubble);
        bubble = bubble * Polynomial{0, 1};
    }
    Matrix F(basis.size());
    for (std::size_t i = 0; i < basis.size(); ++i)
        for (const Polynomial& other : basis)
            F[i].push_back({scheme.quadrature(derivative(basis[i]) * derivative(other)),
                            mpq_class(-scheme.quadrature(basis[i] * other))});
    return F;
}

/// The determinant of F with row a and column b of the ends, and those of the inner unknowns: the entry ab of the form
/// that is left when these are eliminated, times their determinant [Cramer].
Polynomial eliminated(const Matrix& F, std::size_t a, std::size_t b)
{
    Matrix part;
    for (std::size_t i = 0; i < F.size(); ++i) {
        if (i < 2 && i != a) continue;
        part.emplace_back();
        for (std::size_t j = 0; j < F.size(); ++j)
            if (j >= 2 || j == b) part.back().push_back(F[i][j]);
    }
    return determinant(part);
}

} // namespace

std::optional<LinearLimits> scheme_limits(const std::string& scheme)
{
    for (const GalerkinScheme& each : schemes()) {
        if (each.name != scheme) continue;
        const Matrix F = action_matrix(each);
        const Polynomial sum = eliminated(F, 0, 0) + eliminated(F, 1, 1);
        const Polynomial twice = mpq_class(2) * eliminated(F, 0, 1);
        LinearLimits limits;
        const std::optional<double> end = first_negative(in_squares(odd_part((twice - sum) * (twice + sum))));
        limits.imaginary = end.value_or(no_limit);
        return limits;
    }
    return std::nullopt;
}

std::vector<std::string_view> scheme_names()
{
    std::vector<std::string_view> names;
    for (const GalerkinScheme& each : schemes()) names.push_back(each.name);
    return names;
}

} // namespace lagen
