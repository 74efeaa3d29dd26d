// SPDX-License-Identifier: GPL-2.0-or-later
#include "least/rational_span.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace lagen {

namespace {

constexpr long double negligible = 1e-10L; ///< of a vector of length 1
constexpr long largest_denominator = 1000;

/// The fraction with the smallest denominator within 1e-9 of x, by its continued fraction.
std::optional<Rational> simplest_near(long double x)
{
    long double rest = x;
    Rational p0 = 1, q0 = 0, p1, q1 = 1;
    p1 = Rational(static_cast<long>(std::floor(rest)));
    for (int k = 0; k < 12; ++k) {
        const Rational value = p1 / q1;
        if (std::abs(static_cast<long double>(value.get_d()) - x) < 1e-9L) return value;
        const long double part = rest - std::floor(rest);
        if (part < 1e-12L) return std::nullopt;
        rest = 1 / part;
        if (rest > 1e6L) return std::nullopt;
        const Rational next(static_cast<long>(std::floor(rest)));
        const Rational p2 = next * p1 + p0, q2 = next * q1 + q0;
        p0 = p1, q0 = q1, p1 = p2, q1 = q2;
        if (q1 > largest_denominator) return std::nullopt;
    }
    return std::nullopt;
}

} // namespace

bool RationalSpan::add(std::vector<long double> vector)
{
    long double length = 0;
    for (const long double entry : vector) length = std::max(length, std::abs(entry));
    if (!std::isfinite(length) || length == 0) return false;
    for (long double& entry : vector) entry /= length;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
        const long double factor = vector[pivots_[k]];
        for (std::size_t j = 0; j < size_; ++j) vector[j] -= factor * rows_[k][j];
    }
    const auto largest = std::ranges::max_element(vector, {}, [](long double each) { return std::abs(each); });
    if (std::abs(*largest) < negligible) return false;
    // The first column that is not negligible beside the largest leads, so that rows are those of an echelon form.
    const auto leading =
        std::ranges::find_if(vector, [&](long double each) { return std::abs(each) > 1e-6L * std::abs(*largest); });
    const auto pivot = static_cast<std::size_t>(leading - vector.begin());
    const long double value = *leading;
    for (long double& entry : vector) entry /= value;
    for (std::vector<long double>& row : rows_) {
        const long double factor = row[pivot];
        for (std::size_t j = 0; j < size_; ++j) row[j] -= factor * vector[j];
    }
    rows_.push_back(std::move(vector));
    pivots_.push_back(pivot);
    return true;
}

std::vector<std::vector<Rational>> RationalSpan::rows() const
{
    std::vector<std::vector<Rational>> result;
    for (const std::vector<long double>& row : rows_) {
        std::vector<Rational>& exact = result.emplace_back();
        for (const long double entry : row) {
            const std::optional<Rational> near = simplest_near(entry);
            if (!near) return {};
            exact.push_back(*near);
        }
    }
    return result;
}

std::vector<std::vector<Rational>> RationalSpan::kernel() const
{
    const std::vector<std::vector<Rational>> exact = rows();
    if (exact.size() != rows_.size()) return {};
    std::vector<std::vector<Rational>> result;
    for (std::size_t j = 0; j < size_; ++j) {
        if (std::ranges::find(pivots_, j) != pivots_.end()) continue;
        std::vector<Rational>& vector = result.emplace_back(size_);
        vector[j] = 1;
        for (std::size_t k = 0; k < exact.size(); ++k) vector[pivots_[k]] = -exact[k][j];
    }
    return result;
}

} // namespace lagen
