// SPDX-License-Identifier: GPL-2.0-or-later
/// Factorisations and solutions written out: 2 x 2 in closed form, L D L^T up to order 16 where definiteness is proved
/// (zero pattern respected, order of elimination chosen for least fill), pivoted LU from the runtime otherwise.
/// Cofactors are never used beyond order 2: they lose all digits at condition numbers where elimination keeps them.
#pragma once

#include "emit/spell.hpp"

#include <functional>
#include <map>

namespace lagen {

/// One factorisation as it stands in a function body: names by which solutions find its parts.
struct PrintedFactor {
    enum class Kind { closed_form, ldlt, pivoted } kind = Kind::pivoted;
    std::size_t order = 0;
    std::vector<std::size_t> elimination;    ///< ldlt: position -> row of the matrix
    std::vector<std::string> entries;        ///< closed form: the four entries, "" for zero
    std::string name;                        ///< closed form: 1 / determinant; pivoted: the PivotedLu
    std::vector<std::vector<std::string>> l; ///< ldlt: l[i][j], j < i, "" for zero
    std::vector<std::string> reciprocals;    ///< ldlt: 1 / d_j
};

/// Where statements go and how new names are made.
struct SolveContext {
    const Graph& graph;
    Speller& spell;
    std::function<void(std::string)> add_statement;
    std::function<std::string(const std::string&)> fresh; ///< a name that nobody uses, from a wish
};

/// Writes the factorisation `id`. With `check` it reports singular_mass_matrix to `status`; `solved` is false where
/// only the check is wanted.
[[nodiscard]] PrintedFactor print_factor(const SolveContext& context, NodeId id, std::size_t number, bool check,
                                         bool solved);

/// Writes the solution `id` of a printed factorisation; answers the expressions of its components. Components that
/// `wanted` does not ask for may be "".
[[nodiscard]] std::vector<std::string> print_solution(const SolveContext& context, const PrintedFactor& factor,
                                                      NodeId id, std::size_t number, const std::vector<bool>& wanted);

/// The order of elimination of a symmetric matrix by least degree; ties go to the smaller row.
[[nodiscard]] std::vector<std::size_t> least_degree_order(std::vector<std::vector<bool>> pattern);

} // namespace lagen
