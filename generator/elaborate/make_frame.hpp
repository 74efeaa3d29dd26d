// SPDX-License-Identifier: GPL-2.0-or-later
/// Frames of the tangent spaces of level sets M = {f^A(x) = 0}, A = 1..m, with B^A_i = df^A/dx^i of rank m on M.
#pragma once

#include "elaborate/build_workspace.hpp"
#include "graph/calculus/places.hpp"
#include "model/read_model.hpp"

namespace lagen {

/// With kept coordinates K and the others P, where det B_P is proved to vanish nowhere: e_a = d/dx^a - (B_P^-1 B_a)^P
/// d/dx^P, a in K. They lie in ker B around M, not on M alone, and their components along K are constants: so their
/// brackets, which lie there too and have the components 0, are 0.
/// On a curve (n - m = 1) that has no such K, and whose fibre coordinate has a name of its own: e = (-1)^(n-1+i) M_i
/// d/dx^i, M_i the minor of B without column i, up to a number. It is defined on all of M, and zero where M is singular
/// alone.
/// Throws ModelError: as many constraints as coordinates, dependent ones, singular level sets, several charts.
[[nodiscard]] LevelSetFrame make_frame(const Model& model, const LevelSetRequest& request);

/// All that the reading of a model asks for.
[[nodiscard]] Choosers choosers();

// Which coordinates linear constraints B Y = beta leave free on the whole domain: those whose complement has a minor
// that is proved to vanish nowhere.

/// The rows B^A of m constraints on r coordinates.
struct ConstraintRows {
    std::vector<NodeId> B; ///< B^A_a, by rows, shape (m, r)
    std::size_t m, r;

    /// The columns that are not kept.
    [[nodiscard]] Places solved(const Places& kept) const;
    [[nodiscard]] NodeId minor(Graph& graph, const Places& kept) const;
};

/// The first choice that is proved, and what stands in the way of the others.
struct KeptChoice {
    std::optional<Places> kept;
    std::string minors;     ///< "2*z (keeping v_x, v_y), .."; empty where all are zero
    std::vector<Tree> open; ///< factors of the minor with the fewest whose signs are not known, without their own
};

/// Of all choices of r - m columns, in lexicographic order, or of `wanted` alone.
[[nodiscard]] KeptChoice choose_free(BuildWorkspace& work, const ConstraintRows& rows,
                                     const std::vector<Symbol>& coordinates, const Places& wanted = {});

/// The ambient coordinates that a nonholonomic model by constraints keeps, where it does not say so: of constraints
/// that are dependent everywhere the first choice. Throws MathematicsError where there is none.
[[nodiscard]] std::vector<std::size_t> choose_kept(const Model& model);

} // namespace lagen
