// SPDX-License-Identifier: GPL-2.0-or-later
/// Normal forms of graph nodes in the ring of one decision: the proof half of the zero decision.
#pragma once

#include "graph/core/graph.hpp"
#include "proof/decide.hpp"
#include "proof/elementary.hpp"

namespace lagen::proof {

/// Constraint `constraint` solves for `variable`: leading * variable^degree + (terms of lower degree) = 0.
struct SolvedConstraint {
    std::size_t constraint = 0; ///< index in ProofSetting::constraints
    NodeId variable = 0;
    unsigned degree = 1;
    bool pure = true;  ///< no terms of degrees 1 .. degree - 1
    bool monic = true; ///< the leading coefficient is a number
};

/// An operand of sqrt, log or a real power that must be defined: it is not negative.
struct NonnegativeOperand {
    NodeId node = 0;
    bool positive = false; ///< of log, or of a negative power
};

/// Those that `roots` need; branches of select are left out, and so are operands that contain other functions than sin
/// and cos (their signs are not needed to normalise the others).
[[nodiscard]] std::vector<NonnegativeOperand> nonnegative_operands(const Graph& graph,
                                                                   const std::vector<NodeId>& roots);

/// Normal forms under one setting. One object serves one decision.
class NormalForm {
  public:
    /// `root`: the node of interest; `operands`: of roots and logarithms elsewhere in the model, whose definedness may
    /// be used besides that of `root`.
    NormalForm(const Graph& graph, const ProofSetting& setting, const std::vector<SolvedConstraint>& constraints,
               NodeId root, const std::vector<NonnegativeOperand>& operands, Work budget, Angles angles = Angles::split,
               Assumptions assumptions = {});

    /// Throws BudgetExhausted or VanishingDivisor. Zero proves that the node vanishes wherever everything is defined,
    /// except where `condition()` vanishes.
    [[nodiscard]] Fraction of(NodeId node);
    /// A divisor that reduction used and that was not shown to be nonzero on the domain; empty: none.
    [[nodiscard]] const std::string& condition() const
    {
        return condition_.empty() ? elementary_.condition() : condition_;
    }
    /// The same value in the names of the model: without the multiples of coordinates that constraints were solved for.
    [[nodiscard]] Fraction readable(const Fraction& a);
    [[nodiscard]] Ring& ring() { return ring_; }
    [[nodiscard]] Elementary& elementary() { return elementary_; }
    [[nodiscard]] GeneratorId generator_of(NodeId input) const { return inputs_.at(input); }

  private:
    void register_units(const std::vector<NodeId>& roots);
    void register_radicands(const std::vector<NodeId>& roots);
    void prepare(const std::vector<NodeId>& roots);
    void add_domain();
    void add_definedness();
    void solve_constraint(const SolvedConstraint& solved);
    [[nodiscard]] Fraction without_root_powers(Fraction a);
    [[nodiscard]] bool divides_as_written(NodeId root) const;
    [[nodiscard]] Fraction once(NodeId node);
    [[nodiscard]] Fraction apply(NodeId node);
    [[nodiscard]] Fraction input(NodeId node);
    [[nodiscard]] Fraction tangent(const Fraction& a);
    [[nodiscard]] Fraction hyperbolic(const Fraction& a, int sign); ///< (e^a + sign e^-a)/2
    [[nodiscard]] Fraction hyperbolic_tangent(const Fraction& a);
    [[nodiscard]] Fraction component(NodeId node);
    [[nodiscard]] Fraction comparison(NodeId node);
    [[nodiscard]] Fraction choice(NodeId node);
    [[nodiscard]] Fraction extremum(NodeId node, int sign);
    [[nodiscard]] Fraction sign(const Fraction& a);
    [[nodiscard]] std::optional<bool> holds(NodeId condition);
    /// All components of a `solve`.
    [[nodiscard]] const std::vector<Fraction>& solution(NodeId solve);
    [[nodiscard]] std::vector<Fraction> free_unknowns(const std::string& key,
                                                      const std::vector<std::vector<Fraction>>& rows);
    [[nodiscard]] bool vanishes_by_rows(Polynomial p);
    [[nodiscard]] const Fraction& operand(NodeId node, std::size_t k) const
    {
        return done_.at(graph_.operands(node)[k]);
    }

    const Graph& graph_;
    const ProofSetting& setting_;
    const std::vector<SolvedConstraint>& constraints_;
    std::vector<NonnegativeOperand> operands_;
    Ring ring_;
    Elementary elementary_;
    std::map<NodeId, GeneratorId> inputs_;
    std::map<NodeId, Fraction> substitutes_; ///< of inputs that constraints solve
    std::map<NodeId, Fraction> done_;
    std::map<std::string, std::vector<Fraction>> solutions_; ///< of linear systems, by their entries
    std::vector<Polynomial> relations_;                      ///< rows of A z - b whose unknowns are free generators
    std::string condition_;

    /// `multiple` = leading * coordinate, monic in its constraint.
    struct Multiple {
        GeneratorId multiple;
        GeneratorId coordinate;
        Polynomial leading;
    };
    std::vector<Multiple> multiples_;
};

} // namespace lagen::proof
