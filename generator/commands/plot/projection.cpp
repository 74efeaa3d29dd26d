// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/plot/projection.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lagen {

double dot(const Vector& a, const Vector& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double length(const Vector& a)
{
    return std::sqrt(dot(a, a));
}

bool is_finite(const Vector& a)
{
    return std::isfinite(a[0]) && std::isfinite(a[1]) && std::isfinite(a[2]);
}

PictureProjection::PictureProjection(double azimuth, double elevation)
{
    const double a = azimuth * std::numbers::pi / 180, e = elevation * std::numbers::pi / 180;
    right_ = {-std::sin(a), std::cos(a), 0};
    up_ = {-std::sin(e) * std::cos(a), -std::sin(e) * std::sin(a), std::cos(e)};
    towards_ = {std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)};
}

} // namespace lagen
