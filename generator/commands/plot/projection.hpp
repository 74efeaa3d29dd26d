// SPDX-License-Identifier: GPL-2.0-or-later
/// Parallel projection onto a plane.
#pragma once

#include "commands/plot/drawing.hpp"

namespace lagen {

using Vector = std::array<double, 3>;

[[nodiscard]] double dot(const Vector& a, const Vector& b);
[[nodiscard]] double length(const Vector& a);
[[nodiscard]] bool is_finite(const Vector& a);

/// The angles of the usual view, in degrees: the first axis points to the left and down, the second to the right.
inline constexpr double usual_azimuth = 35, usual_elevation = 25;

/// The eye is far away in the direction of these angles, in degrees; the third axis points up.
class PictureProjection {
  public:
    PictureProjection(double azimuth, double elevation);

    [[nodiscard]] Point operator()(const Vector& r) const { return {dot(right_, r), dot(up_, r)}; }
    [[nodiscard]] double depth(const Vector& r) const { return dot(towards_, r); } ///< larger is nearer
    [[nodiscard]] const Vector& towards() const { return towards_; }

  private:
    Vector right_, up_, towards_;
};

} // namespace lagen
