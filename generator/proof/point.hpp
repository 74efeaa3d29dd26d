// SPDX-License-Identifier: GPL-2.0-or-later
/// Points as data: the value of each input, exact where it is rational. Texts are made where a point is shown.
#pragma once

#include "expression/tree.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lagen {

/// The value of an input at a point.
struct PointValue {
    std::optional<Rational> exact; ///< none where a constraint forces an irrational number
    std::string decimal;           ///< of an irrational number, with at least 17 correct digits
    Rational lower, upper;         ///< the number lies between these; both are the exact value where there is one

    PointValue(const Rational& value) : exact(value), lower(value), upper(value) {}
    PointValue(std::string digits, Rational from, Rational to)
        : decimal(std::move(digits)), lower(std::move(from)), upper(std::move(to))
    {
    }
    [[nodiscard]] bool operator==(const PointValue&) const = default;
};

/// "3/5", or the decimal.
[[nodiscard]] inline std::string to_text(const PointValue& value)
{
    return value.exact ? value.exact->get_str() : value.decimal;
}

/// The nearest double of an exact value; of an irrational one, of the middle of its enclosure.
[[nodiscard]] inline double to_double(const PointValue& value)
{
    return value.exact ? value.exact->get_d() : Rational((value.lower + value.upper) / 2).get_d();
}

/// Inputs by name.
using NamedPoint = std::vector<std::pair<std::string, PointValue>>;

} // namespace lagen
