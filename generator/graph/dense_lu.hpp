// SPDX-License-Identifier: GPL-2.0-or-later
/// Dense linear systems of the interpreter. (Generated code has its own: runtime, linear.hpp.)
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace lagen {

/// P A = L U by rows with partial pivoting; `regular` is false where a pivot is 0 or not a number.
template <class Scalar>
struct Factorisation {
    std::vector<Scalar> lu;
    std::vector<std::size_t> order; ///< row of A that stands in row i of L U
    bool regular = true;
};

/// Of the n x n matrix `a`, by rows.
template <class Scalar>
[[nodiscard]] Factorisation<Scalar> factorise(std::vector<Scalar> a, std::size_t n)
{
    Factorisation<Scalar> result;
    result.order.resize(n);
    for (std::size_t i = 0; i < n; ++i) result.order[i] = i;
    for (std::size_t k = 0; k < n; ++k) {
        std::size_t pivot = k;
        for (std::size_t i = k + 1; i < n; ++i)
            if (std::abs(a[i * n + k]) > std::abs(a[pivot * n + k])) pivot = i;
        if (!(std::abs(a[pivot * n + k]) > 0)) result.regular = false;
        for (std::size_t j = 0; pivot != k && j < n; ++j) std::swap(a[k * n + j], a[pivot * n + j]);
        std::swap(result.order[k], result.order[pivot]);
        for (std::size_t i = k + 1; i < n; ++i) {
            const Scalar factor = a[i * n + k] /= a[k * n + k];
            for (std::size_t j = k + 1; j < n; ++j) a[i * n + j] -= factor * a[k * n + j];
        }
    }
    result.lu = std::move(a);
    return result;
}

/// z with A z = b; not a number where A is singular.
template <class Scalar>
[[nodiscard]] std::vector<Scalar> substitute(const Factorisation<Scalar>& f, const std::vector<Scalar>& b)
{
    const std::size_t n = b.size();
    std::vector<Scalar> z(n, std::numeric_limits<Scalar>::quiet_NaN());
    if (!f.regular) return z;
    for (std::size_t i = 0; i < n; ++i) {
        z[i] = b[f.order[i]];
        for (std::size_t j = 0; j < i; ++j) z[i] -= f.lu[i * n + j] * z[j];
    }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t j = i + 1; j < n; ++j) z[i] -= f.lu[i * n + j] * z[j];
        z[i] /= f.lu[i * n + i];
    }
    return z;
}

} // namespace lagen
