// SPDX-License-Identifier: MIT
/// Roots of falling functions between bounds, for the controls of a generated kernel: Newton's method, safeguarded by
/// bisection, to round-off, without allocation. On packs every lane goes its own way, by selection.
#pragma once

#include "lagen/newton.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace lagen {

/// Most doublings of an interval that grows towards an open end, and most steps towards a root.
constexpr int bracket_doublings = 128;
constexpr int bracket_steps = 1000;

namespace detail {

/// What `bracket` knows of its unknowns, each in its interval [low, high].
template <class S, std::size_t N, class Function>
class Brackets {
  public:
    using Mask = typename StatusOf<S>::mask;
    using Real = real_t<S>;
    using Unknowns = std::array<S, N>;

    Brackets(Unknowns& z, const Function& function) noexcept : z_(z), function_(function)
    {
        for (Mask& done : done_) done = S(1) < S(0);
    }

    /// Unknowns whose function has no other sign than that of an end are at that end.
    void settle_at_ends(const Unknowns& lower, const Unknowns& upper) noexcept
    {
        const S infinity(std::numeric_limits<Real>::infinity());
        for (std::size_t i = 0; i < N; ++i) {
            failed_ = either<Mask>(failed_, !(lower[i] <= upper[i]));
            failed_ = either<Mask>(failed_, !both<Mask>(lower[i]<infinity, upper[i]> - infinity));
            const Mask has_lower = lower[i] > -infinity;
            const Mask has_upper = upper[i] < infinity;
            low_[i] = select(has_lower, lower[i], select(has_upper, upper[i], S(0)));
            high_[i] = select(has_upper, upper[i], select(has_lower, lower[i], S(0)));
            z_[i] = low_[i];
        }
        function_(z_, residual_, derivative_);
        for (std::size_t i = 0; i < N; ++i) {
            done_[i] = both<Mask>(lower[i] > -infinity, residual_[i] <= S(0));
            failed_ = either<Mask>(failed_, !is_number(residual_[i]));
        }
        for (std::size_t i = 0; i < N; ++i) z_[i] = select(done_[i], z_[i], high_[i]);
        function_(z_, residual_, derivative_);
        for (std::size_t i = 0; i < N; ++i) {
            done_[i] = either<Mask>(done_[i], both<Mask>(upper[i] < infinity, residual_[i] >= S(0)));
            failed_ = either<Mask>(failed_, !is_number(residual_[i]));
        }
    }

    /// Moves low ends down (sign 1) or high ends up (sign -1) until the function has that sign there.
    void grow(const Unknowns& ends, Real sign) noexcept
    {
        using std::abs;
        const S infinity(std::numeric_limits<Real>::infinity());
        Unknowns& moving = sign > Real(0) ? low_ : high_;
        Unknowns& other = sign > Real(0) ? high_ : low_;
        Unknowns width{};
        std::array<Mask, N> open{};
        for (std::size_t i = 0; i < N; ++i) {
            open[i] = !either<Mask>(done_[i], abs(ends[i]) < infinity);
            width[i] = select(abs(moving[i]) < S(1), S(1), abs(moving[i]));
        }
        for (int count = 0; count < bracket_doublings && any_of(open); ++count) {
            for (std::size_t i = 0; i < N; ++i) z_[i] = select(open[i], moving[i], z_[i]);
            function_(z_, residual_, derivative_);
            for (std::size_t i = 0; i < N; ++i) {
                failed_ = either<Mask>(failed_, both<Mask>(open[i], !is_number(residual_[i])));
                const Mask beyond = S(sign) * residual_[i] >= S(0);
                open[i] = both<Mask>(open[i], !either<Mask>(beyond, failed_));
                other[i] = select(open[i], moving[i], other[i]);
                moving[i] = select(open[i], moving[i] - S(sign) * width[i], moving[i]);
                width[i] = S(2) * width[i];
            }
        }
        for (const Mask& still : open) failed_ = either<Mask>(failed_, still);
    }

    void close_in() noexcept
    {
        using std::abs;
        const Real epsilon = std::numeric_limits<Real>::epsilon(), least = std::numeric_limits<Real>::min();
        const S most(std::numeric_limits<Real>::max());
        Unknowns last{};
        for (std::size_t i = 0; i < N; ++i) {
            last[i] = high_[i] - low_[i];
            z_[i] = select(done_[i], z_[i], middle(low_[i], high_[i]));
        }
        for (int count = 0; count < bracket_steps && !all_done(); ++count) {
            function_(z_, residual_, derivative_);
            for (std::size_t i = 0; i < N; ++i) {
                const S f = residual_[i];
                failed_ = either<Mask>(failed_, !is_number(f));
                low_[i] = select(f > S(0), z_[i], low_[i]);
                high_[i] = select(f < S(0), z_[i], high_[i]);
                // A step that leaves the interval, or is not half as long as the last one, is replaced by bisection.
                const S newton = z_[i] - f / derivative_[i];
                const Mask inside = both<Mask>(newton >= low_[i], newton <= high_[i]);
                const Mask shorter = both<Mask>(abs(derivative_[i]) <= most, S(2) * abs(newton - z_[i]) <= last[i]);
                const S next = select(both<Mask>(inside, shorter), newton, middle(low_[i], high_[i]));
                done_[i] = either<Mask>(done_[i], both<Mask>(f >= S(0), f <= S(0)));
                last[i] = abs(next - z_[i]);
                z_[i] = select(done_[i], z_[i], next);
                const S tight = S(Real(2) * epsilon) * abs(z_[i]) + S(least);
                done_[i] = either<Mask>(done_[i], either<Mask>(last[i] <= tight, high_[i] - low_[i] <= tight));
            }
        }
        for (const Mask& done : done_) failed_ = either<Mask>(failed_, !done);
    }

    [[nodiscard]] const Mask& failed() const noexcept { return failed_; }

  private:
    /// Half-way; in the exponent where the ends have one sign and are far apart, and 0 where they have two.
    [[nodiscard]] static S middle(const S& low, const S& high) noexcept
    {
        using std::abs;
        using std::sqrt;
        const S a = abs(low), b = abs(high), least(std::numeric_limits<Real>::min());
        const S small = select(a < b, a, b), large = select(a < b, b, a), base = select(small < least, least, small);
        const S mean = sqrt(base) * sqrt(large);
        const S half = S(Real(0.5)) * low + S(Real(0.5)) * high;
        const S between = select(large > S(4) * base, select(high > S(0), mean, -mean), half);
        return select(both<Mask>(low<S(0), high> S(0)), S(0), between);
    }

    [[nodiscard]] static bool any_of(const std::array<Mask, N>& masks) noexcept
    {
        Mask some = masks[0];
        for (const Mask& mask : masks) some = either<Mask>(some, mask);
        return !none(some);
    }

    [[nodiscard]] bool all_done() const noexcept
    {
        Mask open = !done_[0];
        for (const Mask& done : done_) open = either<Mask>(open, !done);
        return none(both<Mask>(open, !failed_));
    }

    Unknowns& z_;
    const Function& function_;
    Unknowns low_{}, high_{}, residual_{}, derivative_{};
    std::array<Mask, N> done_{};
    Mask failed_ = S(1) < S(0);
};

} // namespace detail

/// Solves F_i(z_i) = 0 in lower_i <= z_i <= upper_i for functions that fall with their argument: the root, or the end
/// next to it where there is none.
/// @param lower, upper the intervals; -infinity and infinity are open ends, towards which an interval is searched up to
///        2^128 times the larger of 1 and the other end
/// @param function function(z, residual, derivative): F_i(z_i) and dF_i/dz_i, N entries each
/// @return newton_diverged, a lane, where a value or an end is not a number, ends cross, or an open interval has no
/// root:
///         then z is NaN. Else z is within 2 epsilon |z| of where the computed function changes its sign (or within the
///         smallest normal number)
template <class S, std::size_t N, class Function>
[[nodiscard]] status_t<S> bracket(std::array<S, N>& z, const std::array<S, N>& lower, const std::array<S, N>& upper,
                                  const Function& function) noexcept
{
    detail::Brackets<S, N, Function> brackets(z, function);
    brackets.settle_at_ends(lower, upper);
    brackets.grow(lower, real_t<S>(1));
    brackets.grow(upper, real_t<S>(-1));
    brackets.close_in();
    auto status = StatusOf<S>::good();
    StatusOf<S>::fail(status, brackets.failed(), Status::newton_diverged);
    for (S& entry : z) entry = select(brackets.failed(), S(std::numeric_limits<real_t<S>>::quiet_NaN()), entry);
    return status;
}

} // namespace lagen
