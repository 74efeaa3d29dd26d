// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/polynomial.hpp"

#include <algorithm>
#include <cmath>

namespace lagen::stability {

namespace {

constexpr mp_bitcnt_t precision = 256; ///< of values: rounding is far below what tables of 40 digits leave open
constexpr double grid = 1.0 / 64;
constexpr int halvings = 80; ///< of an interval of the grid, beyond the digits of a double

class Values {
  public:
    explicit Values(const Polynomial& p)
    {
        for (const mpq_class& coefficient : p) coefficients_.emplace_back(coefficient, precision);
    }

    [[nodiscard]] mpf_class at(const mpf_class& x) const
    {
        mpf_class sum(0, precision);
        for (std::size_t k = coefficients_.size(); k-- > 0;) sum = sum * x + coefficients_[k];
        return sum;
    }

  private:
    std::vector<mpf_class> coefficients_;
};

/// No zero is larger in modulus [Fujiwara 1916]: 2 max |p_(n-k) / p_n|^(1/k).
double farthest_zero(const Polynomial& p)
{
    const auto size = [](const mpq_class& c) {
        const mpf_class x(c, precision);
        long exponent = 0;
        const double fraction = mpf_get_d_2exp(&exponent, x.get_mpf_t());
        return std::log2(std::abs(fraction)) + static_cast<double>(exponent);
    };
    std::size_t last = p.size() - 1;
    while (last > 0 && sgn(p[last]) == 0) --last;
    double most = 0;
    for (std::size_t k = 0; k < last; ++k)
        if (sgn(p[k]) != 0) most = std::max(most, (size(p[k]) - size(p[last])) / static_cast<double>(last - k));
    return std::exp2(most + 1);
}

/// Where p changes its sign between `good` (p >= 0) and `bad` (p < 0).
double change_between(const Values& p, mpf_class good, mpf_class bad)
{
    for (int k = 0; k < halvings; ++k) {
        const mpf_class middle = (good + bad) / 2;
        (sgn(p.at(middle)) < 0 ? bad : good) = middle;
    }
    return good.get_d();
}

/// The place of the least value between `low` and `high`, where p falls and rises again.
mpf_class least_between(const Values& p, mpf_class low, mpf_class high)
{
    for (int k = 0; k < 2 * halvings; ++k) {
        const mpf_class left = (low + low + high) / 3, right = (low + high + high) / 3;
        if (p.at(left) < p.at(right))
            high = right;
        else
            low = left;
    }
    return (low + high) / 2;
}

} // namespace

Polynomial operator+(const Polynomial& p, const Polynomial& q)
{
    Polynomial sum(std::max(p.size(), q.size()));
    for (std::size_t k = 0; k < p.size(); ++k) sum[k] += p[k];
    for (std::size_t k = 0; k < q.size(); ++k) sum[k] += q[k];
    return sum;
}

Polynomial operator-(const Polynomial& p, const Polynomial& q)
{
    return p + mpq_class(-1) * q;
}

Polynomial operator*(const Polynomial& p, const Polynomial& q)
{
    if (p.empty() || q.empty()) return {};
    Polynomial product(p.size() + q.size() - 1);
    for (std::size_t i = 0; i < p.size(); ++i)
        for (std::size_t j = 0; j < q.size(); ++j) product[i + j] += p[i] * q[j];
    return product;
}

Polynomial operator*(const mpq_class& factor, Polynomial p)
{
    for (mpq_class& coefficient : p) coefficient *= factor;
    return p;
}

Polynomial in_squares(const Polynomial& p)
{
    Polynomial spread(2 * p.size());
    for (std::size_t k = 0; k < p.size(); ++k) spread[2 * k] = p[k];
    return spread;
}

Polynomial reflected(Polynomial p)
{
    for (std::size_t k = 1; k < p.size(); k += 2) p[k] = -p[k];
    return p;
}

Polynomial real_on_axis(const Polynomial& p)
{
    Polynomial part;
    for (std::size_t k = 0; k < p.size(); k += 2) part.push_back(k % 4 == 0 ? p[k] : mpq_class(-p[k]));
    return part;
}

Polynomial imaginary_on_axis(const Polynomial& p)
{
    Polynomial part;
    for (std::size_t k = 1; k < p.size(); k += 2) part.push_back(k % 4 == 1 ? p[k] : mpq_class(-p[k]));
    return part;
}

std::optional<double> first_negative(const Polynomial& whole, std::size_t zeros)
{
    const auto begin = std::find_if(whole.begin() + static_cast<std::ptrdiff_t>(std::min(zeros, whole.size())),
                                    whole.end(), [](const mpq_class& c) { return sgn(c) != 0; });
    const Polynomial p(begin, whole.end());
    if (std::ranges::all_of(p, [](const mpq_class& c) { return sgn(c) >= 0; })) return std::nullopt;
    if (sgn(p.front()) < 0) return 0.0;
    const Values values(p);
    mpf_class before = values.at(0), here = before; // at the last two places of the grid
    const double end = farthest_zero(p) + 2 * grid;
    for (double x = grid; x < end; x += grid) {
        const mpf_class next = values.at(mpf_class(x, precision));
        if (here < before && here < next) {
            const mpf_class least = least_between(values, x - 2 * grid, x);
            if (sgn(values.at(least)) < 0) return change_between(values, x - 2 * grid, least);
        }
        if (sgn(next) < 0) return change_between(values, mpf_class(x - grid, precision), mpf_class(x, precision));
        before = here;
        here = next;
    }
    return std::nullopt;
}

bool has_zeros_on_the_right(const Polynomial& p)
{
    // Of p(-x), whose zeros have negative real parts: the first column of Routh's scheme has one sign.
    const Polynomial q = reflected(p);
    Polynomial upper, lower;
    for (std::size_t k = q.size(); k-- > 0;) ((q.size() - 1 - k) % 2 == 0 ? upper : lower).push_back(q[k]);
    const int sign = sgn(upper.front());
    while (!lower.empty()) {
        if (sgn(lower.front()) != sign) return false;
        const mpq_class ratio = upper.front() / lower.front();
        Polynomial next;
        for (std::size_t k = 1; k < upper.size(); ++k)
            next.push_back(k < lower.size() ? mpq_class(upper[k] - ratio * lower[k]) : upper[k]);
        upper = std::move(lower);
        lower = std::move(next);
    }
    return sign != 0;
}

} // namespace lagen::stability
