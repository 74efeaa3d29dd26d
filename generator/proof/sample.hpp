// SPDX-License-Identifier: GPL-2.0-or-later
/// Sample points: a fixed sequence of rational points, small ones first, moved onto the constraints and kept where the
/// domain certainly holds and everything that must be defined certainly is.
#pragma once

#include "proof/enclosure.hpp"
#include "proof/normal_form.hpp"

#include <functional>
#include <set>

namespace lagen::proof {

/// A point: exact values of most inputs; the coordinates that a constraint makes irrational are recomputed at each
/// precision.
struct SamplePoint {
    std::size_t number = 0; ///< in the sequence of tries
    ExactInputs exact;
    std::vector<bool> upper; ///< which root each constraint takes, in the order of solving
};

class Sampler {
  public:
    Sampler(const Graph& graph, const ProofSetting& setting, const std::vector<SolvedConstraint>& constraints,
            const ProofBudget& budget);

    /// The k-th regular point, or nullptr where the tries do not find as many. Cached: the same at each call.
    [[nodiscard]] const SamplePoint* regular(std::size_t k);
    /// Enclosures of these inputs, which may stand outside the setting; with constraints of all inputs.
    [[nodiscard]] BallInputs enclosures(const SamplePoint& point, const std::vector<NodeId>& more,
                                        slong precision) const;
    /// Exact values likewise; those that are irrational are missing.
    [[nodiscard]] ExactInputs exact_values(const SamplePoint& point, const std::vector<NodeId>& more) const;
    /// Names and values, variables first, then parameters, then `more`.
    [[nodiscard]] NamedPoint values(const SamplePoint& point, const std::vector<NodeId>& more) const;

  private:
    struct Bounds {
        std::optional<Rational> low, high;
    };

    [[nodiscard]] Rational draw(std::size_t number, NodeId input, bool constrained) const;
    [[nodiscard]] std::optional<SamplePoint> attempt(std::size_t number, bool exact_only) const;
    [[nodiscard]] std::optional<Rational> solve_exactly(std::size_t k, const ExactInputs& inputs, bool upper) const;
    [[nodiscard]] Ball enclose_root(std::size_t k, BallInputs& inputs, bool upper, slong precision) const;
    [[nodiscard]] bool is_regular(const SamplePoint& point) const;
    void solve_constraints(SamplePoint& point) const;
    /// Which conditions hold: constraints solvable, domain, operands of roots and logarithms positive, all defined.
    [[nodiscard]] std::vector<bool> conditions_met(const SamplePoint& point) const;
    [[nodiscard]] bool concerns_only(std::size_t part, const std::set<NodeId>& inputs) const;
    /// The point of this number, moved until every condition holds; nothing where that fails.
    [[nodiscard]] std::optional<SamplePoint> repaired(std::size_t number) const;
    void read_bounds();

    const Graph& graph_;
    const ProofSetting& setting_;
    const std::vector<SolvedConstraint>& constraints_;
    ProofBudget budget_;
    Evaluation conditions_;                        ///< the domain, then what must be defined
    std::size_t signed_parts_ = 0;                 ///< the first of `parts_` that must be defined only
    std::vector<std::vector<NodeId>> part_inputs_; ///< of each of `parts_`
    Evaluation parts_;                  ///< the domain, operands of roots and logarithms, then what must be defined
    std::vector<NodeId> movable_;       ///< free inputs of conditions and constraints
    std::vector<Evaluation> equations_; ///< the constraints in the order of solving
    std::map<NodeId, Bounds> bounds_;
    std::map<NodeId, std::size_t> places_; ///< of inputs in the sequence
    std::map<NodeId, bool> constrained_;   ///< inputs of constraints
    std::vector<NodeId> free_;             ///< inputs of the setting that no constraint solves
    std::vector<SamplePoint> found_;
    std::size_t next_ = 0;
    std::size_t searched_ = 0; ///< searches begun
};

} // namespace lagen::proof
