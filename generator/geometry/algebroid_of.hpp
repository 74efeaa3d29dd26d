// SPDX-License-Identifier: GPL-2.0-or-later
/// The Lie algebroid of a groupoid, read off its left invariant fields at the arrows 1:
///   rho(e_a) = Tt(<-e_a),      [<-e_a, <-e_b] = C^c_ab <-e_c
#pragma once

#include "geometry/groupoid.hpp"

namespace lagen {

/// An entry of [<-e_a, <-e_b] at the arrows 1, less C^c_ab <-e_c: it is zero where the generators close.
struct OpenEntry {
    std::size_t a, b; ///< sections
    NodeId value;
};

struct AlgebroidOfGroupoid {
    Algebroid algebroid;
    std::vector<OpenEntry> open; ///< those that are not the constant 0
};

/// `y`: inputs of the fibre coordinates, shape (r).
[[nodiscard]] AlgebroidOfGroupoid algebroid_of(Graph& graph, const Groupoid& groupoid, std::vector<NodeId> y);

} // namespace lagen
