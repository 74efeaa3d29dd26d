// SPDX-License-Identifier: GPL-2.0-or-later
/// Which coordinates linear constraints B Y = beta leave free on the whole domain: those whose complement has a minor
/// that is proved to vanish nowhere.
#pragma once

#include "elaborate/build_workspace.hpp"
#include "graph/calculus/places.hpp"
#include "model/read_model.hpp"

namespace lagen {

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
