// SPDX-License-Identifier: GPL-2.0-or-later
/// Linear algebra over functions: rank and kernel of a matrix whose entries are graph nodes. A rank is that at almost
/// every point: a minor that is certainly not zero at some point, while all that border it are zero everywhere.
#pragma once

#include "graph/calculus/determinant.hpp"
#include "proof/decide.hpp"

namespace lagen {

/// As many rows as columns of a matrix, in the order in which they were found.
struct Minor {
    Places rows, columns;
};

class FunctionMatrix {
  public:
    /// Entries by rows, `columns` in each. Keeps references.
    FunctionMatrix(Graph& graph, const std::vector<NodeId>& entries, std::size_t rows, std::size_t columns)
        : graph_(graph), entries_(entries), rows_(rows), columns_(columns)
    {
    }

    /// Its determinant; 1 where it has no rows.
    [[nodiscard]] NodeId value(const Minor& minor) const;

    /// A minor of the size of the rank; its rows are the first independent ones, ascending. Nothing where a minor on
    /// the way is not decided, or is larger than `determinant_limit`. `everywhere`: for each row a column whose minor
    /// vanishes nowhere is taken, where there is one. Of a symmetric matrix the same rows and columns have a minor that
    /// is not zero either.
    [[nodiscard]] std::optional<Minor> largest_minor(const ZeroDecider& decider, bool everywhere = false) const;

    /// k with M k = 0 for a column j outside of a largest minor, shape (columns): k^j = 1 and M_PQ k^Q = -M_Pj by
    /// Cramer's rule; not `divided` all of it times the determinant of the minor.
    [[nodiscard]] std::vector<NodeId> kernel_vector(const Minor& minor, std::size_t j, bool divided = true) const;

    /// True where M k = 0 is proved.
    [[nodiscard]] bool maps_to_zero(const std::vector<NodeId>& k, const ZeroDecider& decider) const;

  private:
    Graph& graph_;
    const std::vector<NodeId>& entries_;
    std::size_t rows_, columns_;
};

/// The rank of a bundle map on the fibres, at almost every point of M.
struct GenericRank {
    std::optional<std::size_t> rank; ///< nothing where it is not decided
    bool surjective = false;
    bool injective = false;
    std::vector<std::string> where; ///< it is this everywhere where these strict conditions hold, which the domain does
                                    ///< not imply
};

/// The rank of Phi^a_b with `rows` rows of `columns` entries.
[[nodiscard]] GenericRank generic_rank(Graph& graph, const std::vector<NodeId>& matrix, std::size_t rows,
                                       std::size_t columns, const ZeroDecider& decider);

/// A minor of a square matrix of any size by numbers at a point: elimination with the largest pivot of the rows from
/// `first` on, then of those before. Rounding decides which pivots are zero, and is not believed: product_of_pivots
/// tells whether the guess was right. Nothing where a number is not finite.
[[nodiscard]] std::optional<Minor> guess_minor(std::vector<long double> N, std::size_t m, std::size_t first);

/// The determinant of a minor as a product of pivots in their order: short, and defined where no pivot vanishes.
[[nodiscard]] NodeId product_of_pivots(Graph& graph, std::vector<NodeId> N, std::size_t m, const Minor& minor);

} // namespace lagen
