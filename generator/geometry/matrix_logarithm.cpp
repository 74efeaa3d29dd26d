// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry/matrix_logarithm.hpp"

#include "expression/linear_algebra.hpp"

#include <algorithm>

namespace lagen {

namespace {

constexpr long double rounding = std::numeric_limits<long double>::epsilon();
constexpr int most_roots = 60, most_iterations = 40, most_terms = 40;

RealMatrix one(std::size_t n)
{
    RealMatrix out(n * n, 0);
    for (std::size_t k = 0; k < n; ++k) out[k * (n + 1)] = 1;
    return out;
}

/// a + f b
RealMatrix sum(RealMatrix a, long double f, const RealMatrix& b)
{
    for (std::size_t k = 0; k < a.size(); ++k) a[k] += f * b[k];
    return a;
}

long double size_of(const RealMatrix& a)
{
    long double most = 0;
    for (const long double each : a) most = std::max(most, std::isfinite(each) ? std::abs(each) : HUGE_VALL);
    return most;
}

/// a^-1 b; entries that are no numbers where a is singular.
RealMatrix quotient(const RealMatrix& a, const RealMatrix& b, std::size_t n)
{
    const Factorisation<long double> f = factorise(a, n);
    RealMatrix out(n * n);
    for (std::size_t j = 0; j < n; ++j) {
        std::vector<long double> column(n);
        for (std::size_t i = 0; i < n; ++i) column[i] = b[i * n + j];
        column = substitute(f, column);
        for (std::size_t i = 0; i < n; ++i) out[i * n + j] = column[i];
    }
    return out;
}

/// The root whose eigenvalues have positive real parts.
std::optional<RealMatrix> square_root(const RealMatrix& W, std::size_t n)
{
    RealMatrix Y = W, Z = one(n);
    for (int k = 0; k < most_iterations; ++k) {
        const RealMatrix next = sum(Y, 1, quotient(Z, one(n), n)), other = sum(Z, 1, quotient(Y, one(n), n));
        const RealMatrix before = Y;
        for (std::size_t i = 0; i < n * n; ++i) Y[i] = next[i] / 2, Z[i] = other[i] / 2;
        const long double size = size_of(Y);
        if (!std::isfinite(size)) return {};
        if (size_of(sum(Y, -1, before)) <= 16 * rounding * size) break;
    }
    if (size_of(sum(times(Y, Y, n), -1, W)) > 1e4L * rounding * size_of(W)) return {};
    return Y;
}

} // namespace

RealMatrix times(const RealMatrix& a, const RealMatrix& b, std::size_t n)
{
    RealMatrix out(n * n, 0);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < n; ++k)
            for (std::size_t j = 0; a[i * n + k] != 0 && j < n; ++j) out[i * n + j] += a[i * n + k] * b[k * n + j];
    return out;
}

std::optional<RealMatrix> principal_logarithm(const RealMatrix& W, std::size_t n)
{
    std::optional<RealMatrix> root = W;
    long double factor = 2;
    for (int k = 0; size_of(sum(*root, -1, one(n))) > 0.1L; ++k, factor *= 2) {
        if (k == most_roots) return {};
        root = square_root(*root, n);
        if (!root) return {};
    }
    const RealMatrix X = quotient(sum(*root, 1, one(n)), sum(*root, -1, one(n)), n), square = times(X, X, n);
    RealMatrix power = X, log = X;
    for (int k = 3; k < 2 * most_terms; k += 2) {
        power = times(power, square, n);
        log = sum(std::move(log), 1.0L / k, power);
    }
    for (long double& each : log) each *= factor;
    return log;
}

long double cayley_size(const RealMatrix& W, std::size_t n)
{
    return 2 * size_of(quotient(sum(W, 1, one(n)), sum(W, -1, one(n)), n));
}

} // namespace lagen
