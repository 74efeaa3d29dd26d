// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry/orthonormal_span.hpp"

#include <cmath>

namespace lagen {

namespace {

long double inner(const std::vector<long double>& a, const std::vector<long double>& b)
{
    long double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
    return sum;
}

} // namespace

long double length_of(const std::vector<long double>& a)
{
    return std::sqrt(inner(a, a));
}

OrthonormalSpan::Vector OrthonormalSpan::outside(Vector a) const
{
    for (int pass = 0; pass < 2; ++pass)
        for (const Vector& each : basis_) {
            const long double part = inner(a, each);
            for (std::size_t k = 0; k < a.size(); ++k) a[k] -= part * each[k];
        }
    return a;
}

bool OrthonormalSpan::contains(const Vector& a) const
{
    return !(length_of(outside(a)) > negligible_ * length_of(a));
}

OrthonormalSpan::Vector OrthonormalSpan::farthest_outside(std::size_t n) const
{
    Vector best;
    for (std::size_t k = 0; k < n; ++k) {
        Vector unit(n, 0);
        unit[k] = 1;
        Vector out = outside(std::move(unit));
        if (best.empty() || length_of(out) > 1.0001L * length_of(best)) best = std::move(out);
    }
    return best;
}

bool OrthonormalSpan::add(const Vector& a)
{
    Vector rest = outside(a);
    const long double length = length_of(rest);
    if (!(length > negligible_ * length_of(a))) return false;
    for (long double& each : rest) each /= length;
    basis_.push_back(std::move(rest));
    return true;
}

} // namespace lagen
