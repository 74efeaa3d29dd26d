// SPDX-License-Identifier: MIT
/// Eigenvalues of a small real matrix, by the double-shift QR algorithm on its Hessenberg form.
/// Source: J. G. F. Francis, The QR transformation, Computer J. 4 (1961/62); Wilkinson and Reinsch, Handbook for
/// Automatic Computation II (1971), contributions II/13 (elmhes) and II/14 (hqr). Eigen's solver gives the same to
/// rounding, and a compiler takes three times as long for it as for everything else in a chart's program.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace lagen::chart {

/// A square matrix, by rows.
class SquareMatrix {
  public:
    explicit SquareMatrix(int size) : size_(size), entries_(static_cast<std::size_t>(size * size)) {}

    [[nodiscard]] int size() const noexcept { return size_; }
    [[nodiscard]] double& operator()(int i, int j) noexcept
    {
        return entries_[static_cast<std::size_t>(i * size_ + j)];
    }

  private:
    int size_;
    std::vector<double> entries_;
};

/// Makes the matrix an upper Hessenberg one with the same eigenvalues, by eliminations with pivots.
inline void make_hessenberg(SquareMatrix& a)
{
    const int n = a.size();
    for (int m = 1; m + 1 < n; ++m) {
        int pivot = m;
        for (int i = m + 1; i < n; ++i)
            if (std::abs(a(i, m - 1)) > std::abs(a(pivot, m - 1))) pivot = i;
        if (a(pivot, m - 1) == 0) continue;
        if (pivot != m) {
            for (int j = m - 1; j < n; ++j) std::swap(a(pivot, j), a(m, j));
            for (int i = 0; i < n; ++i) std::swap(a(i, pivot), a(i, m));
        }
        for (int i = m + 1; i < n; ++i) {
            const double factor = a(i, m - 1) / a(m, m - 1);
            a(i, m - 1) = 0;
            for (int j = m; j < n; ++j) a(i, j) -= factor * a(m, j);
            for (int k = 0; k < n; ++k) a(k, m) += factor * a(k, i);
        }
    }
}

/// The QR iteration on rows low..high of a Hessenberg matrix, until one or two eigenvalues stand alone at its end.
class FrancisSteps {
  public:
    explicit FrancisSteps(SquareMatrix& a) : a_(a)
    {
        for (int i = 0; i < a.size(); ++i)
            for (int j = 0; j < a.size(); ++j) norm_ += std::abs(a(i, j));
    }

    /// All eigenvalues; none where one was not found in 60 steps.
    [[nodiscard]] std::vector<std::complex<double>> eigenvalues()
    {
        std::vector<std::complex<double>> found;
        int count = 0;
        for (int high = a_.size() - 1; high >= 0;) {
            const int low = start_of_block(high);
            if (high - low < 2) {
                if (high == low)
                    found.emplace_back(a_(high, high) + shifted_);
                else
                    add_pair(high, found);
                high = low - 1;
                count = 0;
            } else {
                if (++count > most_steps) return {};
                step(low, high, count % 10 == 0);
            }
        }
        return found;
    }

  private:
    static constexpr int most_steps = 60;
    static constexpr double rounding = std::numeric_limits<double>::epsilon();

    /// The first row of the block that ends with row `high`: what is left of it is 0 to rounding.
    [[nodiscard]] int start_of_block(int high)
    {
        for (int l = high; l > 0; --l) {
            const double beside = std::abs(a_(l - 1, l - 1)) + std::abs(a_(l, l));
            if (!(std::abs(a_(l, l - 1)) > rounding * (beside > 0 ? beside : norm_))) {
                a_(l, l - 1) = 0;
                return l;
            }
        }
        return 0;
    }

    void add_pair(int high, std::vector<std::complex<double>>& found) const
    {
        const double x = a_(high, high), w = a_(high, high - 1) * a_(high - 1, high);
        const double p = (a_(high - 1, high - 1) - x) / 2, q = p * p + w, z = std::sqrt(std::abs(q));
        if (q < 0) {
            found.emplace_back(x + shifted_ + p, z);
            found.emplace_back(x + shifted_ + p, -z);
        } else { // without cancellation
            const double far = p + (p < 0 ? -z : z);
            found.emplace_back(x + shifted_ + far);
            found.emplace_back(x + shifted_ - (far == 0 ? 0 : w / far));
        }
    }

    /// The first column of (A - s1)(A - s2), up to a factor.
    struct Column {
        double p, q, r;

        [[nodiscard]] double size() const { return std::abs(p) + std::abs(q) + std::abs(r); }
        [[nodiscard]] Column over(double s) const { return {p / s, q / s, r / s}; }
    };

    /// One step with the eigenvalues of the last two rows as shifts, or with others where those lead round in circles.
    void step(int low, int high, bool exceptional)
    {
        double x = a_(high, high), y = a_(high - 1, high - 1), w = a_(high, high - 1) * a_(high - 1, high);
        if (exceptional) {
            shifted_ += x;
            for (int i = 0; i <= high; ++i) a_(i, i) -= x;
            const double s = std::abs(a_(high, high - 1)) + std::abs(a_(high - 1, high - 2));
            x = y = 0.75 * s;
            w = -0.4375 * s * s;
        }
        int m = high - 2;
        Column first = first_column(m, x, y, w);
        for (; m > low; first = first_column(--m, x, y, w)) {
            const double left = std::abs(a_(m, m - 1)) * (std::abs(first.q) + std::abs(first.r));
            const double right =
                std::abs(first.p) * (std::abs(a_(m - 1, m - 1)) + std::abs(a_(m, m)) + std::abs(a_(m + 1, m + 1)));
            if (left <= rounding * right) break;
        }
        for (int i = m + 2; i <= high; ++i) {
            a_(i, i - 2) = 0;
            if (i > m + 2) a_(i, i - 3) = 0;
        }
        chase(low, m, high, first);
    }

    [[nodiscard]] Column first_column(int m, double x, double y, double w) const
    {
        const double z = a_(m, m), r = x - z, s = y - z;
        const Column column{(r * s - w) / a_(m + 1, m) + a_(m, m + 1), a_(m + 1, m + 1) - z - r - s, a_(m + 2, m + 1)};
        const double size = column.size();
        return size > 0 ? column.over(size) : column;
    }

    /// Reflections that bring the block back to Hessenberg form, from row m down.
    void chase(int low, int m, int high, Column column)
    {
        for (int k = m; k < high; ++k) {
            const bool three = k + 1 < high;
            double before = 0;
            if (k > m) {
                column = {a_(k, k - 1), a_(k + 1, k - 1), three ? a_(k + 2, k - 1) : 0};
                before = column.size();
                if (before == 0) continue;
                column = column.over(before);
            }
            const double length = std::sqrt(column.p * column.p + column.q * column.q + column.r * column.r);
            if (length == 0) continue;
            const double s = std::copysign(length, column.p);
            if (k > m)
                a_(k, k - 1) = -s * before;
            else if (low < m)
                a_(k, k - 1) = -a_(k, k - 1);
            reflect(low, k, high, three, column, s);
        }
    }

    void reflect(int low, int k, int high, bool three, const Column& column, double s)
    {
        const double p = column.p + s, x = p / s, y = column.q / s, z = column.r / s, q = column.q / p,
                     r = column.r / p;
        for (int j = k; j <= high; ++j) {
            const double sum = a_(k, j) + q * a_(k + 1, j) + (three ? r * a_(k + 2, j) : 0);
            a_(k, j) -= sum * x;
            a_(k + 1, j) -= sum * y;
            if (three) a_(k + 2, j) -= sum * z;
        }
        for (int i = low; i <= std::min(high, k + 3); ++i) {
            const double sum = x * a_(i, k) + y * a_(i, k + 1) + (three ? z * a_(i, k + 2) : 0);
            a_(i, k) -= sum;
            a_(i, k + 1) -= sum * q;
            if (three) a_(i, k + 2) -= sum * r;
        }
    }

    SquareMatrix& a_;
    double norm_ = 0, shifted_ = 0;
};

/// All eigenvalues, with their multiplicities, conjugates side by side; none where an entry is no number or the
/// iteration does not end.
[[nodiscard]] inline std::vector<std::complex<double>> eigenvalues(SquareMatrix a)
{
    for (int i = 0; i < a.size(); ++i)
        for (int j = 0; j < a.size(); ++j)
            if (!std::isfinite(a(i, j))) return {};
    make_hessenberg(a);
    return FrancisSteps(a).eigenvalues();
}

} // namespace lagen::chart
