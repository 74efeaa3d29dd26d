// SPDX-License-Identifier: GPL-2.0-or-later
/// Exact values of operations at rational operands, for the rows of the operator table. A rule answers nothing where
/// the value is irrational, undefined or longer than `most_bits`.
#pragma once

#include "expression/tree.hpp"

#include <cstdint>
#include <optional>

namespace lagen::rules {

using Exact = std::optional<Rational>;

[[nodiscard]] Exact exact_quotient(const Rational& a, const Rational& b);
[[nodiscard]] Exact exact_power(const Rational& a, std::int64_t exponent, std::size_t most_bits);
[[nodiscard]] Exact exact_root(const Rational& a);
/// `value` where a is `point`.
[[nodiscard]] Exact exact_at(const Rational& a, long point, long value);
/// 1 or 0.
[[nodiscard]] Exact exact_truth(bool condition);

} // namespace lagen::rules
