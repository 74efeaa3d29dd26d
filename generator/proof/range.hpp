// SPDX-License-Identifier: GPL-2.0-or-later
/// Intervals with exact rational or infinite ends, open or closed, and possible signs: what is known of a generator on
/// the whole domain, and what follows for monomials.
#pragma once

#include <gmpxx.h>

namespace lagen::proof {

/// One end of a range. An `open` end is not attained; an infinite end never is.
struct End {
    bool infinite = true;
    mpq_class value;
    bool open = true;
};

/// All values lie between `low` and `high`; `nonzero` says that 0 is not among them although it may lie between.
struct Range {
    End low;
    End high;
    bool nonzero = false;

    [[nodiscard]] static Range point(const mpq_class& value);
    [[nodiscard]] static Range between(const mpq_class& low, const mpq_class& high); ///< closed
    [[nodiscard]] static Range positive();
    [[nodiscard]] static Range nonnegative();
    [[nodiscard]] bool contains_zero() const;
};

[[nodiscard]] Range operator+(const Range& a, const Range& b);
[[nodiscard]] Range operator*(const Range& a, const Range& b);
[[nodiscard]] Range power(const Range& a, unsigned exponent);
/// The values that lie in both.
[[nodiscard]] Range intersect(const Range& a, const Range& b);

/// The signs that a quantity may have, as a set; fewer is more knowledge.
struct Signs {
    bool negative = true;
    bool zero = true;
    bool positive = true;

    [[nodiscard]] bool certainly_positive() const { return !negative && !zero; }
    [[nodiscard]] bool certainly_negative() const { return !positive && !zero; }
    [[nodiscard]] bool certainly_nonnegative() const { return !negative; }
    [[nodiscard]] bool certainly_nonzero() const { return !zero; }
};

[[nodiscard]] Signs signs_of(const Range& range);
[[nodiscard]] Signs signs_of(const mpz_class& value);
[[nodiscard]] Signs operator*(const Signs& a, const Signs& b);
[[nodiscard]] Signs operator+(const Signs& a, const Signs& b);
[[nodiscard]] Signs operator-(const Signs& a);
[[nodiscard]] Signs power(const Signs& a, unsigned exponent);
[[nodiscard]] Signs both(const Signs& a, const Signs& b); ///< what two true statements leave possible

} // namespace lagen::proof
