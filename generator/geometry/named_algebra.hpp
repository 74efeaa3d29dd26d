// SPDX-License-Identifier: GPL-2.0-or-later
/// Named Lie algebras by their matrices: so(n), su(2), se(2), se(3), so(2,1), sl(2), heis(3), aff(1), gl(n), R^n and
/// direct sums "A + B"; and the groups that they generate. Structure constants are not typed in: they are read off the
/// commutators of the basis matrices.
#pragma once

#include "expression/tree.hpp"

#include <optional>

namespace lagen {

/// An entry of a square matrix; zero entries are left out.
struct MatrixEntry {
    std::size_t row, column;
    Rational value;
};

/// Sorted by row, then column.
using SparseMatrix = std::vector<MatrixEntry>;

/// [E_a, E_b] contains value * E_c; only a < b.
struct StructureConstant {
    std::size_t a, b, c;
    Rational value;
};

struct NamedAlgebra {
    std::string name;
    std::size_t size = 0;            ///< of the matrices
    std::vector<SparseMatrix> basis; ///< E_a, r of them
    std::vector<StructureConstant> constants;
};

/// The largest rank that a named algebra may have.
inline constexpr std::size_t named_algebra_rank_limit = 128;

/// The algebra called `name` ("so(3) + R^2"), or nothing where the name is unknown or its rank is above the limit.
[[nodiscard]] std::optional<NamedAlgebra> named_algebra(std::string_view name);

/// The names that `named_algebra` knows, for messages.
[[nodiscard]] const std::vector<std::string>& named_algebra_names();

/// The algebra of the matrix group called `name`: the same names in capitals, "SO(3) + R^2". Nothing where the name is
/// unknown, or the rank above the limit.
[[nodiscard]] std::optional<NamedAlgebra> algebra_of_group(std::string_view name);

/// The names that `algebra_of_group` knows, for messages.
[[nodiscard]] const std::vector<std::string>& named_group_names();

/// The entries of a matrix of this size, by rows.
[[nodiscard]] std::vector<Rational> dense(const SparseMatrix& matrix, std::size_t size);

} // namespace lagen
