// SPDX-License-Identifier: GPL-2.0-or-later
#include "proof/least_squares.hpp"

#include "proof/ball_matrix.hpp"

#include <algorithm>
#include <cmath>

namespace lagen::proof {

namespace {

constexpr slong step_bits = 128; ///< J^T J of doubles is exact in them, but for sums of very different terms
constexpr int most_descents = 80;
constexpr double rounding = 1e-13;

BallMatrix exact_matrix(const std::vector<double>& entries, std::size_t rows, std::size_t columns)
{
    BallMatrix out(rows, columns);
    for (std::size_t k = 0; k < entries.size(); ++k) out.entries[k] = Ball(Rational(entries[k]), step_bits);
    return out;
}

std::optional<std::vector<double>> damped_step(const Residual& at, std::size_t n, double damping)
{
    const auto finite = [](double each) { return std::isfinite(each); };
    if (!std::ranges::all_of(at.slopes, finite)) return std::nullopt;
    const BallMatrix J = exact_matrix(at.slopes, at.values.size(), n), Jt = transposed(J);
    const BallMatrix A =
        sum(product(Jt, J, step_bits), Ball(Rational(damping), step_bits), BallMatrix::identity(n), step_bits);
    const auto x = solved(A, product(Jt, exact_matrix(at.values, at.values.size(), 1), step_bits), step_bits);
    if (!x) return std::nullopt;
    std::vector<double> step;
    for (const Ball& entry : x->entries) step.push_back(-entry.middle());
    return step;
}

std::vector<double> added(std::vector<double> z, const std::vector<double>& step)
{
    for (std::size_t k = 0; k < z.size(); ++k) z[k] += step[k];
    return z;
}

} // namespace

double Residual::length() const
{
    double sum = 0;
    for (const double value : values) sum += value * value;
    return std::sqrt(sum);
}

std::optional<LeastSquares> least_squares(std::vector<double> z,
                                          const std::function<Residual(const std::vector<double>&)>& residual,
                                          const Move& move)
{
    double damping = 1e-2;
    Residual now = residual(z);
    for (int step = 0; step < most_descents; ++step) {
        const double length = now.length();
        if (!std::isfinite(length)) return std::nullopt;
        if (length <= rounding * now.size) break;
        const std::size_t columns = now.values.empty() ? z.size() : now.slopes.size() / now.values.size();
        const auto change = damped_step(now, columns, damping * std::min(1.0, length));
        if (!change) return std::nullopt;
        const std::vector<double> next_z = move ? move(z, *change) : added(z, *change);
        const bool finite = std::ranges::all_of(next_z, [](double each) { return std::isfinite(each); });
        Residual next = finite ? residual(next_z) : now;
        if (next.length() < length) {
            z = next_z, now = std::move(next);
            damping = std::max(damping / 10, 1e-14);
        } else {
            damping *= 10;
            if (damping > 1e8) break;
        }
    }
    return LeastSquares{std::move(z), std::move(now)};
}

} // namespace lagen::proof
