// SPDX-License-Identifier: GPL-2.0-or-later
/// The Lie algebra g that matrices E_c span, as a subspace of the n x n matrices.
#pragma once

#include "geometry/groupoid.hpp"

namespace lagen {

class GeneratorSpan {
  public:
    /// Keeps references to both.
    GeneratorSpan(Graph& graph, const GroupoidParts& parts);

    /// f_c with Z = f_c E_c on the entries `rows`.
    [[nodiscard]] std::vector<NodeId> components(const std::vector<NodeId>& Z);
    /// f_c E_c
    [[nodiscard]] std::vector<NodeId> matrix(std::span<const NodeId> f);
    /// Z - f_c E_c; all entries vanish where Z lies in g.
    [[nodiscard]] std::vector<NodeId> outside(std::vector<NodeId> Z, const std::vector<NodeId>& f);

    /// What E_a E_b E_c + E_c E_b E_a (for all a <= c and b) leave outside, entries that are not the constant 0. Where
    /// all of it vanishes, and nowhere else, the Cayley map cay(A) = (1 - A/2)^-1 (1 + A/2) leads from g into its
    /// group: d/ds cay(A + s B) cay(A)^-1 = (1 - A/2)^-1 B (1 + A/2)^-1 is a sum of S_k/2^k, S_k = [A, S_{k-1}] + A
    /// S_{k-2} A.
    [[nodiscard]] std::vector<NodeId> triples_outside();

  private:
    Graph& graph_;
    const GroupoidParts& parts_;
    std::size_t m_;
    std::vector<NodeId> inverse_; ///< of the generators' entries `rows`: [c * m + k]
};

} // namespace lagen
