// SPDX-License-Identifier: GPL-2.0-or-later
/// The model file of a quotient TQ/G: the file of the whole model with what the reduction changes. Coordinates that the
/// slice fixes and velocities that the group moves become definitions, with the values that they have on the slice, so
/// that what is invariant stands as it did; what is not is left out.
#pragma once

#include "commands/reduce/reduced_document.hpp"
#include "mechanics/quotient.hpp"
#include "model/read_model.hpp"

#include <functional>
#include <map>

namespace lagen {

/// What a reduction by a group is made of.
struct GroupReduction {
    const Model& model;
    const System& system;
    Graph& graph; ///< a copy of the system's, with what is derived
    const InfinitesimalAction& action;
    const Quotient& quotient;
    std::string group, algebra;                   ///< "SO(3)", "so(3)"
    std::function<bool(NodeId)> is_invariant;     ///< of a function of t, x and y
    std::function<bool(NodeId)> is_invariant_set; ///< of the set f > 0 of a function of x
};

class QuotientDocument {
  public:
    /// Keeps a reference.
    QuotientDocument(const GroupReduction& reduction, const std::vector<Setting>& settings);

    /// The reduced Lagrangian as it is derived, in the names of the file.
    [[nodiscard]] const Tree& lagrangian() const { return lagrangian_; }
    /// "v_x = u_x - w*y" of each coordinate and velocity that is defined.
    [[nodiscard]] const std::vector<std::pair<std::string, std::string>>& definitions() const { return definitions_; }
    /// The file with `lagrangian` for L.
    [[nodiscard]] std::string text(const Tree& lagrangian);

  private:
    void choose_names(const std::vector<Symbol>& symbols, bool fibre);
    [[nodiscard]] std::string unused(std::string name);
    [[nodiscard]] Tree shown(NodeId node) const;
    [[nodiscard]] bool is_in_names_of_whole(const Tree& tree) const;
    [[nodiscard]] bool is_kept(const Tree& tree) const;
    [[nodiscard]] std::vector<std::string> domain() const;
    void put_algebroid();
    void drop_claims();
    bool move_start(const Scene& scene, TomlValue& table) const;
    void move_scenes();

    const GroupReduction& reduction_;
    ReducedDocument document_;
    std::vector<std::string> taken_;
    std::vector<std::string> x_, u_, w_;         ///< names of free coordinates, of their velocities, of generators
    std::map<std::string, Tree> values_;         ///< what names of the whole stand for on the slice
    std::vector<std::string> base_, velocities_; ///< declarations
    std::vector<std::pair<std::string, std::string>> definitions_;
    Tree lagrangian_;
};

} // namespace lagen
