// SPDX-License-Identifier: GPL-2.0-or-later
/// Ranks of differentials and of vector fields, at points drawn at random where all of a system is defined.
#pragma once

#include "geometry/orthonormal_span.hpp"
#include "verify/proof_setting.hpp"

#include <map>

namespace lagen {

/// Numbers of the variables and parameters of a setting, by name.
using NamedNumbers = std::map<std::string, long double>;

/// A setting with values for all parameters.
[[nodiscard]] ProofSetting setting_at_values(Graph& graph, ProofSetting setting, const Replacements& values);

/// `count` points; fewer, or none, where as many are not found.
[[nodiscard]] std::vector<NamedNumbers> generic_points(const Graph& graph, const ProofSetting& setting,
                                                       std::size_t count);

/// The rank of vectors of functions, one after the other: the largest at some points. A vector is new that makes it
/// larger. With differentials: functions of which none is locally a function of those before.
class GenericSpan {
  public:
    /// Keeps references.
    GenericSpan(Graph& graph, const std::vector<NamedNumbers>& points);

    /// True where it was new.
    bool add(const std::vector<NodeId>& vector);
    /// df by the inputs z.
    bool add_differential(NodeId f, const std::vector<NodeId>& z);
    [[nodiscard]] std::size_t size() const { return size_; }

  private:
    Graph* graph_;
    const std::vector<NamedNumbers>* points_;
    std::vector<OrthonormalSpan> spans_; ///< one a point
    std::size_t size_ = 0;               ///< the rank
};

} // namespace lagen
