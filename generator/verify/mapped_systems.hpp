// SPDX-License-Identifier: GPL-2.0-or-later
/// Both sides of a morphism on one graph, that of the source: where claims about the map and about equations along it
/// are decided.
#pragma once

#include "mechanics/velocity_map.hpp"
#include "verify/arrow_decider.hpp"
#include "verify/judge.hpp"
#include "verify/verify.hpp"

namespace lagen {

class MappedSystems {
  public:
    /// Copies the morphism: functions of the target are derived on the graph of `morphism.target` and moved with
    /// `along`.
    explicit MappedSystems(const SystemMorphism& morphism);
    MappedSystems(const MappedSystems&) = delete;
    MappedSystems& operator=(const MappedSystems&) = delete;

    SystemMorphism morphism;
    Graph graph; ///< the source's, and what is derived
    AlongMap along;
    std::optional<DerivedFibre> derived; ///< of a morphism of groupoids
    std::vector<NodeId> given;           ///< Phi^a_b as `fibre` says, shape (r', r); may be empty
    std::vector<NodeId> matrix;          ///< Phi^a_b, shape (r', r)
    VelocityMap moving;                  ///< on velocities: Phi itself, but of nonholonomic systems

    [[nodiscard]] const System& from() const { return morphism.source; }
    [[nodiscard]] const System& to() const { return morphism.target; }

    /// True where no force of either side depends on first-order states, whose own equations are not compared.
    [[nodiscard]] bool compares_forces() const;
    [[nodiscard]] bool is_constrained() const { return from().distribution || to().distribution; }

    /// Phi^a_b w_a and Phi^a_b v^b.
    [[nodiscard]] std::vector<NodeId> pulled(const std::vector<NodeId>& covector);
    [[nodiscard]] std::vector<NodeId> pushed(const std::vector<NodeId>& vector);
    /// mu' as inputs of their own.
    [[nodiscard]] const std::vector<NodeId>& target_momenta();

    /// Points of the source which the map takes into the domain of the target.
    [[nodiscard]] ProofSetting setting();

    /// An arrow g and one that follows it: s(h) = t(g).
    struct Arrows {
        Arrow g, h;
    };
    [[nodiscard]] Arrows arrows();
    /// Of residuals over both arrows, t, the step and the parameters. Keeps references.
    [[nodiscard]] ArrowDecider arrow_decider(const Arrows& pair, const ProofBudget& budget);

    [[nodiscard]] std::string section(std::size_t b) const { return from().graph.input_name(from().algebroid.y[b]); }
    [[nodiscard]] std::string target_section(std::size_t a) const { return to().graph.input_name(to().algebroid.y[a]); }
    /// The name of y^b, or of y^alpha where the system is nonholonomic.
    [[nodiscard]] std::string velocity(std::size_t b) const { return from().graph.input_name(from().velocities()[b]); }
    [[nodiscard]] std::string target_velocity(std::size_t a) const
    {
        return to().graph.input_name(to().velocities()[a]);
    }
    [[nodiscard]] std::string target_coordinate(std::size_t i) const
    {
        return to().graph.input_name(to().algebroid.x[i]);
    }

  private:
    std::vector<NodeId> momenta_;
};

// Does a map carry the distribution of a nonholonomic system onto that of another? The checks `constraint` of a
// morphism and of its reduction: Phi(e_alpha) in D', Phi(b) in b' + D', Phi(D) = D'.

struct CarriedDistribution {
    std::vector<Check> checks; ///< residuals that are 0 by structure are left out
    bool onto = false;         ///< Phi(D) = D' is proved at every point
};
[[nodiscard]] CarriedDistribution decide_carried(MappedSystems& both, Judge& judge);

} // namespace lagen
