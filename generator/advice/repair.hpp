// SPDX-License-Identifier: GPL-2.0-or-later
/// A change of a few entries of rho and C, to be tried out.
#pragma once

#include "mechanics/system.hpp"
#include "verify/witness_point.hpp"

namespace lagen {

/// An entry of C ([e_a, e_b] along e_index) or, with `anchor`, of rho (rho(e_a) along d/dx^index).
struct EntryPlace {
    bool anchor = false;
    std::size_t a = 0, b = 0;
    std::size_t index = 0;

    friend bool operator==(const EntryPlace&, const EntryPlace&) = default;
};

/// The entry at a place gets this value; the constant 0 takes it out.
struct EntryChange {
    EntryPlace place;
    NodeId value;
};

enum class RepairKind {
    sign,  ///< of one entry
    order, ///< [a, b] is given for [b, a]
    value, ///< of one entry, any
    needed ///< the only value with which the anchor equations of its pair hold, the other entries being as they are
};

struct Repair {
    RepairKind kind;
    std::vector<EntryChange> changes;
};

/// The value at a place, or the constant 0.
[[nodiscard]] NodeId value_at(Graph& graph, const Algebroid& algebroid, const EntryPlace& place);

/// Carries out changes on an algebroid, and undoes them when it goes. A bracket that the model gives in one order, or
/// not at all, changes in both.
class Trial {
  public:
    Trial(Graph& graph, Algebroid& algebroid, const Repair& repair);
    ~Trial();
    Trial(const Trial&) = delete;
    Trial& operator=(const Trial&) = delete;

  private:
    void set(Column& column, std::size_t index, NodeId value);

    Graph& graph_;
    std::vector<std::pair<Column*, Column>> before_;
};

/// Every entry with its sign flipped, brackets first, then whole pairs of more than one component.
[[nodiscard]] std::vector<Repair> sign_repairs(Graph& graph, const Algebroid& algebroid, const Editable& editable);

/// C^c_ab + R^i / rho^i_c for one component c each: what the anchor equations R of [e_a, e_b] ask for.
[[nodiscard]] std::vector<Repair> needed_brackets(Graph& graph, const Algebroid& algebroid, std::size_t a,
                                                  std::size_t b, const Column& anchor_residual);

/// rho^i_c + R^i / C^c_ab for one component c each: what they ask for of the anchor of a bracket's component.
[[nodiscard]] std::vector<Repair> needed_anchors(Graph& graph, const Algebroid& algebroid, std::size_t a, std::size_t b,
                                                 const Column& anchor_residual);

/// rho^i_a - rho_a(f) / (df/dx^i) for one i each: an anchor that annihilates f.
[[nodiscard]] std::vector<Repair> annihilating_anchors(Graph& graph, BaseGradient& partial, const Algebroid& algebroid,
                                                       std::size_t a, NodeId f, NodeId derivative);

/// The places of all entries that a file may change: those that there are, then, with `missing`, the brackets' others.
[[nodiscard]] std::vector<EntryPlace> editable_places(const Algebroid& algebroid, const Editable& editable,
                                                      bool missing);

} // namespace lagen
