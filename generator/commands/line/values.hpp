// SPDX-License-Identifier: GPL-2.0-or-later
/// Values that options give: expressions of a model's parameters, whole numbers, ranges FIRST:LAST:COUNT. Grids are
/// exact: point k of n between a and b is the double nearest to a + (b - a) k/(n - 1).
#pragma once

#include "commands/line/options.hpp"
#include "model/model.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lagen {

/// The expression given to --NAME, closed over parameters; ModelError where it depends on anything else.
[[nodiscard]] Tree option_tree(const Model& model, const std::string& name, const Excerpt& text);
/// The same of a number, a vector or a matrix.
[[nodiscard]] ArrayValue option_array(const Model& model, const std::string& name, const Excerpt& text);

struct GridAxis {
    Rational first, last;
    std::uint64_t count = 0; ///< 0: a continuum

    [[nodiscard]] double at(std::uint64_t place) const;
};

/// An end of a range of --OPTION: exactly where its expression is rational, else the nearest double. Throws ModelError
/// where it is no finite number.
[[nodiscard]] Rational end_of_range(const Model& model, const std::string& option, const Excerpt& text);

/// The parts between colons, blanks trimmed.
[[nodiscard]] std::vector<Excerpt> parts_of_range(const Excerpt& text);

/// A whole number without a sign, at most 1e18; nothing where the text is none.
[[nodiscard]] std::optional<std::uint64_t> read_whole(const std::string& text);
/// The value of an option as such a number; UsageError where it is none, or outside of these bounds.
[[nodiscard]] std::uint64_t whole_option(const Options& options, const std::string& name, std::uint64_t least,
                                         std::uint64_t most = UINT64_MAX);

} // namespace lagen
