// SPDX-License-Identifier: MIT
/// Parts of an interval in which a polynomial changes its sign at most once, from the signs of its Bernstein
/// coefficients: as many real roots as they have variations of sign, or fewer by an even number (Descartes' rule;
/// J. M. Lane, R. F. Riesenfeld, BIT 21 (1981) 112-117). Coefficients within their rounding error of 0 count for either
/// sign, so that no change of sign of the polynomial is missed.
#pragma once

#include "lagen/lanes/lanes.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace lagen::detail {

template <class Real, std::size_t size>
class RootIsolation {
  public:
    /// found(end) for the ends, ascending, of parts of (0, 1] in each of which sum_k coefficients[k] x^k, k < count,
    /// may change its sign, once where the part is longer than `width`; elsewhere it does not.
    template <class Found>
    static void isolate(std::array<Real, size> coefficients, std::size_t count, Real width, const Found& found)
    {
        Real total = Real(0);
        for (std::size_t k = 0; k < count; ++k) total += size_of(coefficients[k]);
        const Real first = size_of(coefficients[0]);
        const Real noise = Real(2 * static_cast<int>(count)) * std::numeric_limits<Real>::epsilon() * total;
        if (first > total - first + noise || total == Real(0)) return;
        RootIsolation isolation{count, noise, width};
        isolation.to_bernstein(coefficients);
        isolation.search(coefficients, Real(0), Real(1), found);
    }

  private:
    RootIsolation(std::size_t count, const Real& noise, const Real& width) : count_(count), noise_(noise), width_(width)
    {
    }

    /// b_i = sum_k binomial(i, k) / binomial(n, k) c_k.
    void to_bernstein(std::array<Real, size>& c) const
    {
        const std::size_t n = count_ - 1;
        Real binomial = Real(1);
        for (std::size_t k = 1; k <= n; ++k) {
            binomial *= Real(static_cast<int>(n - k + 1)) / Real(static_cast<int>(k));
            c[k] /= binomial;
        }
        for (std::size_t j = 0; j < n; ++j)
            for (std::size_t i = n; i > j; --i) c[i] += c[i - 1];
    }

    enum class Signs { none, one, more };

    /// Variations of sign, whatever the signs of what is within the noise.
    [[nodiscard]] Signs variations(const std::array<Real, size>& b) const
    {
        int changes = 0, last = 0;
        std::size_t unknown = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            const int sign = b[i] > noise_ ? 1 : (b[i] < -noise_ ? -1 : 0);
            if (sign == 0) {
                ++unknown;
                continue;
            }
            const bool change = last != 0 && sign != last;
            if (unknown > (change ? 1U : 0U)) return Signs::more;
            changes += change ? 1 : 0;
            last = sign;
            unknown = 0;
        }
        if (unknown > 0 || changes > 1) return Signs::more;
        return changes == 0 ? Signs::none : Signs::one;
    }

    template <class Found>
    void search(const std::array<Real, size>& b, const Real& from, const Real& to, const Found& found)
    {
        const Signs signs = variations(b);
        if (signs == Signs::none) return;
        const Real middle = (from + to) / Real(2);
        const bool divided = to - from <= width_ || !(middle > from && middle < to) || parts_ >= most_parts;
        if (signs == Signs::one || divided || is_noise(b)) {
            ++parts_;
            return found(to);
        }
        // De Casteljau: the coefficients of both halves.
        std::array<Real, size> left = b, right = b;
        for (std::size_t j = 1; j < count_; ++j) {
            for (std::size_t i = 0; i + j < count_; ++i) right[i] = (right[i] + right[i + 1]) / Real(2);
            left[j] = right[0];
        }
        search(left, from, middle, found);
        search(right, middle, to, found);
    }

    [[nodiscard]] bool is_noise(const std::array<Real, size>& b) const
    {
        for (std::size_t i = 0; i < count_; ++i)
            if (b[i] > noise_ || b[i] < -noise_) return false;
        return true;
    }

    static constexpr int most_parts = 1000; ///< more are no longer told apart

    int parts_ = 0;
    std::size_t count_;
    Real noise_;
    Real width_;
};

} // namespace lagen::detail
