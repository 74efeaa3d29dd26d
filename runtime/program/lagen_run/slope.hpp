// SPDX-License-Identifier: MIT
/// The slope of values along a run, with a bound of its error that does not take the values' departures from the line
/// as independent: the round-off of a long run walks at random, and a method that keeps the energy lets it swing.
///
/// The values are averaged over batches, 16 to 31 of them with as many values each: when there are 32, pairs of them
/// become one, and the next ones take twice as many values, or, once those are 256, every second of the values that
/// they took. So 8191 steps or fewer all count, of a million every 64th or 128th. The slope is that of the least
/// squares line through the means m_j at the mean times t_j,
///   b = sum_j w_j m_j = sum_j W_j (m_{j+1} - m_j),   w_j = (t_j - mean t)/sum (t - mean t)^2,   W_j = sum_{i>j} w_i.
/// Of a random walk the increments of the means are nearly independent, so the variance of b is
///   (3/2) sum_j W_j^2 S,   S = sum_j (m_{j+1} - m_j - b (t_{j+1} - t_j))^2/(K - 2),
/// where 3/2 makes up for what two neighbours share (their correlation is 1/4). Of values whose departures forget
/// themselves faster (a swing, independent errors) that is a bound: their increments undo each other in the sum.
/// `error` is this standard error times Student's 97.5 % quantile: nineteen times in twenty the slope is within it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace lagen::detail {

struct Slope {
    double value = std::numeric_limits<double>::quiet_NaN();
    double error = std::numeric_limits<double>::quiet_NaN();
};

/// The 97.5 % quantile of Student's t with n degrees of freedom, n >= 6, to 0.6 %: the series in 1/n
/// [Abramowitz-Stegun 26.7.5].
[[nodiscard]] inline double student_quantile(double n) noexcept
{
    constexpr double z = 1.959963984540054, z2 = z * z;
    return z * (1 + (z2 + 1) / (4 * n) + ((5 * z2 + 16) * z2 + 3) / (96 * n * n));
}

/// Of several functions at the same times; memory is taken at the beginning.
class BatchMeans {
  public:
    void begin(std::size_t count)
    {
        open_.values.assign(count, 0);
        means_.assign(most, open_);
    }

    /// Whether the next values are to be seen.
    [[nodiscard]] bool wants() noexcept { return --left_ == 0; }

    void see(double t, std::span<const double> values) noexcept
    {
        left_ = stride_;
        open_.t += t;
        for (std::size_t k = 0; k < values.size(); ++k) open_.values[k] += values[k];
        if (++filled_ == size_) close();
    }

    /// Of function k; NaN where there are fewer than eight batches.
    [[nodiscard]] Slope slope(std::size_t k) const noexcept
    {
        if (batches_ < fewest) return {};
        const auto number = static_cast<double>(batches_);
        std::array<double, most> t{}, mean{};
        double middle = 0;
        for (std::size_t j = 0; j < batches_; ++j) {
            t[j] = means_[j].t;
            mean[j] = means_[j].values[k];
            middle += t[j] / number;
        }
        double squares = 0, slope = 0;
        for (std::size_t j = 0; j < batches_; ++j) squares += (t[j] - middle) * (t[j] - middle);
        for (std::size_t j = 0; j < batches_; ++j) slope += (t[j] - middle) / squares * mean[j];
        double scatter = 0, weights = 0, behind = 0;
        for (std::size_t j = batches_ - 1; j > 0; --j) {
            const double increment = mean[j] - mean[j - 1] - slope * (t[j] - t[j - 1]);
            scatter += increment * increment / (number - 2);
            behind += (t[j] - middle) / squares;
            weights += behind * behind;
        }
        return {slope, student_quantile(number - 2) * std::sqrt(1.5 * weights * scatter)};
    }

  private:
    static constexpr std::size_t fewest = 8, most = 32, largest = 256;
    struct Batch {
        double t = 0;
        std::vector<double> values;
    };

    /// to = (a + b)/n
    static void mean(const Batch& a, const Batch& b, double n, Batch& to) noexcept
    {
        to.t = (a.t + b.t) / n;
        for (std::size_t k = 0; k < to.values.size(); ++k) to.values[k] = (a.values[k] + b.values[k]) / n;
    }

    void close() noexcept
    {
        Batch& closed = means_[batches_++];
        closed.t = open_.t / static_cast<double>(size_);
        for (std::size_t k = 0; k < closed.values.size(); ++k)
            closed.values[k] = open_.values[k] / static_cast<double>(size_);
        open_.t = 0;
        std::ranges::fill(open_.values, 0.0);
        filled_ = 0;
        if (batches_ < most) return;
        for (std::size_t j = 0; j < most / 2; ++j) mean(means_[2 * j], means_[2 * j + 1], 2, means_[j]);
        batches_ = most / 2;
        (size_ < largest ? size_ : stride_) *= 2;
    }

    std::vector<Batch> means_;
    Batch open_; ///< sums
    std::size_t batches_ = 0, size_ = 1, filled_ = 0, stride_ = 1, left_ = 1;
};

} // namespace lagen::detail
