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

    /// Unknowns whose function has no other sign than that of an end are at that end. An end at which the function
    /// cannot be computed is open: the interval grows towards it from the other one, or from where it is nearest to 0.
    void settle_at_ends(const Unknowns& lower, const Unknowns& upper) noexcept
    {
        const S infinity(std::numeric_limits<Real>::infinity());
        for (std::size_t i = 0; i < N; ++i) {
            failed_ = either<Mask>(failed_, !(lower[i] <= upper[i]));
            failed_ = either<Mask>(failed_, !both<Mask>(lower[i]<infinity, upper[i]> - infinity));
            const S above = select(lower[i] > S(0), lower[i], S(0));
            low_[i] = high_[i] = select(above < upper[i], above, upper[i]); // nearest to 0
            z_[i] = select(lower[i] > -infinity, lower[i], high_[i]);
        }
        evaluate();
        for (std::size_t i = 0; i < N; ++i) {
            open_low_[i] = !both<Mask>(lower[i] > -infinity, is_known(i));
            done_[i] = both<Mask>(!open_low_[i], residual_[i] <= S(0));
            low_[i] = select(open_low_[i], low_[i], lower[i]);
            z_[i] = select(done_[i], z_[i], select(upper[i] < infinity, upper[i], high_[i]));
        }
        evaluate();
        for (std::size_t i = 0; i < N; ++i) {
            open_high_[i] = !both<Mask>(upper[i] < infinity, is_known(i));
            const Mask at_upper = both<Mask>(!open_high_[i], residual_[i] >= S(0));
            done_[i] = either<Mask>(done_[i], at_upper);
            // An open end starts from the other one.
            high_[i] = select(open_high_[i], select(open_low_[i], high_[i], low_[i]), upper[i]);
            low_[i] = select(open_low_[i], high_[i], low_[i]);
        }
    }

    /// Moves low ends down (sign 1) or high ends up (sign -1) until the function has that sign there; the end itself is
    /// the solution where it has not. A zero inside is not enough: a function that only tends to zero may underflow.
    void grow(const Unknowns& ends, Real sign) noexcept
    {
        using std::abs;
        const S most(std::numeric_limits<Real>::max());
        Unknowns& moving = sign > Real(0) ? low_ : high_;
        Unknowns& other = sign > Real(0) ? high_ : low_;
        Unknowns width{};
        std::array<Mask, N> open = sign > Real(0) ? open_low_ : open_high_;
        for (std::size_t i = 0; i < N; ++i) {
            open[i] = both<Mask>(open[i], !done_[i]);
            width[i] = select(abs(moving[i]) < S(1), S(1), abs(moving[i]));
        }
        for (int count = 0; count < bracket_doublings && any_of(open); ++count) {
            for (std::size_t i = 0; i < N; ++i) z_[i] = select(open[i], moving[i], z_[i]);
            evaluate();
            for (std::size_t i = 0; i < N; ++i) {
                const Mask at_end = both<Mask>(abs(ends[i]) <= most, !(S(sign) * moving[i] > S(sign) * ends[i]));
                failed_ = either<Mask>(failed_, both<Mask>(open[i], !is_number(residual_[i])));
                const Mask usable = either<Mask>(is_known(i), at_end);
                const Mask zero = both<Mask>(residual_[i] >= S(0), residual_[i] <= S(0));
                const Mask beyond =
                    both<Mask>(usable, either<Mask>(S(sign) * residual_[i] > S(0), both<Mask>(at_end, zero)));
                const Mask ended = both<Mask>(both<Mask>(open[i], at_end), !beyond);
                done_[i] = either<Mask>(done_[i], ended);
                open[i] = both<Mask>(open[i], !either<Mask>(either<Mask>(beyond, failed_), ended));
                other[i] = select(both<Mask>(open[i], both<Mask>(usable, !zero)), moving[i], other[i]);
                const S next = moving[i] - S(sign) * width[i];
                const S limit = select(abs(ends[i]) <= most, ends[i], S(-sign) * most);
                const S within = select(S(sign) * next > S(sign) * limit, next, limit);
                moving[i] = select(open[i], within, moving[i]);
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
            evaluate();
            for (std::size_t i = 0; i < N; ++i) {
                const S f = residual_[i];
                failed_ = either<Mask>(failed_, !is_number(f));
                low_[i] = select(f > S(0), z_[i], low_[i]);
                high_[i] = select(f < S(0), z_[i], high_[i]);
                // A step that leaves the interval, or is not half as long as the last one, is replaced by bisection.
                const S newton = z_[i] - f / derivative_[i];
                const Mask inside = both<Mask>(newton >= low_[i], newton <= high_[i]);
                const Mask shorter = both<Mask>(abs(derivative_[i]) <= most, S(2) * abs(newton - z_[i]) <= last[i]);
                S next = select(both<Mask>(inside, shorter), newton, middle(low_[i], high_[i]));
                done_[i] = either<Mask>(done_[i], both<Mask>(f >= S(0), f <= S(0)));
                const S tight = S(epsilon) * abs(z_[i]) + S(least);
                done_[i] = either<Mask>(done_[i], high_[i] - low_[i] <= S(2) * tight);
                // A step of rounding errors goes a little further, so that the root comes to lie between two places; a
                // second one is replaced by bisection.
                const S beyond = select(f > S(0), z_[i] + tight, z_[i] - tight);
                const S kept = select(beyond > low_[i], select(beyond < high_[i], beyond, high_[i]), low_[i]);
                const S further = select(last[i] <= S(2) * tight, middle(low_[i], high_[i]), kept);
                next = select(abs(next - z_[i]) <= tight, further, next);
                last[i] = abs(next - z_[i]);
                z_[i] = select(done_[i], z_[i], next);
            }
        }
        for (const Mask& done : done_) failed_ = either<Mask>(failed_, !done);
    }

    [[nodiscard]] const Mask& failed() const noexcept { return failed_; }

  private:
    void evaluate() noexcept { call_with_sizes(function_, z_, residual_, derivative_, size_); }

    /// True where F_i has the sign that was computed: its terms have not overflowed, or it has itself.
    [[nodiscard]] Mask is_known(std::size_t i) const noexcept
    {
        using std::abs;
        const S most(std::numeric_limits<Real>::max());
        const Mask infinite = abs(residual_[i]) > most;
        return both<Mask>(is_number(residual_[i]), either<Mask>(size_[i] <= most, infinite));
    }

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
    Unknowns low_{}, high_{}, residual_{}, derivative_{}, size_{};
    std::array<Mask, N> done_{}, open_low_{}, open_high_{};
    Mask failed_ = S(1) < S(0);
};

} // namespace detail

/// Solves F_i(z_i) = 0 in lower_i <= z_i <= upper_i for functions that fall with their argument: the root, or the end
/// next to it where there is none.
/// @param lower, upper the intervals; -infinity and infinity are open ends, towards which an interval is searched up to
///        2^128 times the larger of 1 and the other end, and so are ends at which F_i cannot be computed
/// @param function function(z, residual, derivative): F_i(z_i) and dF_i/dz_i, N entries each; or function(z, residual,
///        derivative, size), with the rounding error of each F_i in units of epsilon: where that is not finite terms of
///        F_i have overflowed, and its sign is not believed
/// @return newton_diverged, a lane, where a value or an end is not a number, ends cross, or an open interval has no
///         root: then z is NaN. Else z is within 2 epsilon |z| of where the computed function changes its sign (or
///         within the smallest normal number)
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
