// SPDX-License-Identifier: GPL-2.0-or-later
/// An orthonormal basis that grows, of vectors of numbers.
#pragma once

#include <cstddef>
#include <vector>

namespace lagen {

class OrthonormalSpan {
  public:
    using Vector = std::vector<long double>;

    /// `negligible`: how small, relative to its length, what is left of a vector outside counts as nothing.
    explicit OrthonormalSpan(long double negligible) : negligible_(negligible) {}

    /// What the span leaves of `a`; twice, since once leaves roundings.
    [[nodiscard]] Vector outside(Vector a) const;
    [[nodiscard]] bool contains(const Vector& a) const;
    /// The unit vector that sticks out farthest of a span that is not everything, or what sticks out of it.
    [[nodiscard]] Vector farthest_outside(std::size_t n) const;
    /// True where it was new: false where the span contains it.
    bool add(const Vector& a);

    [[nodiscard]] std::size_t size() const { return basis_.size(); }
    [[nodiscard]] const Vector& operator[](std::size_t k) const { return basis_[k]; }

  private:
    long double negligible_;
    std::vector<Vector> basis_;
};

/// |a|
[[nodiscard]] long double length_of(const std::vector<long double>& a);

} // namespace lagen
