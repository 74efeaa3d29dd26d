// SPDX-License-Identifier: GPL-2.0-or-later
/// Small symbolic linear systems, solved block by block where a person can still read the solution.
#pragma once

#include <ginac/ginac.h>

#include <functional>
#include <optional>
#include <vector>

namespace lagen {

/// A square matrix by rows.
struct SquareMatrix {
    std::size_t order;
    std::vector<GiNaC::ex> entries;

    [[nodiscard]] const GiNaC::ex& operator()(std::size_t i, std::size_t j) const { return entries[i * order + j]; }
};

/// The classes of unknowns that a matrix couples, each ascending, by their first unknown.
[[nodiscard]] std::vector<std::vector<std::size_t>> coupled_unknowns(const SquareMatrix& matrix);

/// Blocks of more unknowns are solved where all their entries are numbers.
inline constexpr std::size_t largest_written_block = 3;

/// z with A z = b; nothing where a determinant vanishes or a block is too large to be written out. `simpler` rewrites
/// determinants before they are divided; `divisor` may give the one below another form, a name.
using Rewriting = std::function<GiNaC::ex(const GiNaC::ex&)>;
[[nodiscard]] std::optional<GiNaC::exvector> solve_in_blocks(const SquareMatrix& A, const GiNaC::exvector& b,
                                                             const Rewriting& simpler, const Rewriting& divisor = {});

} // namespace lagen
