// SPDX-License-Identifier: GPL-2.0-or-later
/// Proofs that functions vanish for all values of the parameters, or for as few values of the scene as that takes. The
/// relations `parameter = value` that an accepted proof needs hold from then on.
#pragma once

#include "analysis/generic_points.hpp"
#include "proof/decide.hpp"

#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace lagen {

/// True where one of `nodes` may jump along a motion of the lanes though its derivative does not tell: it has an
/// operation of several branches, and that is no modulus, minimum, maximum or root, or something that moves is divided
/// by.
[[nodiscard]] bool may_jump(const Graph& graph, const std::vector<NodeId>& nodes, const std::vector<NodeId>& lanes);

/// True where one of `nodes` has an operation of several branches on the lanes.
[[nodiscard]] bool has_branch(const Graph& graph, const std::vector<NodeId>& nodes, const std::vector<NodeId>& lanes);

class Prover {
  public:
    /// Keeps a reference to `graph`; copies are independent. `values`: of the parameters, in the scene; those that are
    /// left out are free.
    Prover(Graph& graph, ProofSetting setting, Replacements values);

    /// The parameters that must have their values for all of `functions` to vanish, beside those that are bound:
    /// none where they vanish for all. Nothing where that is not proved.
    [[nodiscard]] std::optional<std::vector<NodeId>> vanishing(const std::vector<NodeId>& functions);
    /// The same of "the functions do not change along `direction`", wherever that leads: off the constraints too, and
    /// past points where they are not defined. Of operations that have several branches (|y|/y, sqrt(y^2)/y) the
    /// operands must not change either.
    [[nodiscard]] std::optional<std::vector<NodeId>> unchanging(std::vector<NodeId> functions,
                                                                const Replacements& direction);
    /// True where `function` is proved to vanish nowhere under the relations.
    [[nodiscard]] bool vanishes_nowhere(NodeId function);

    /// Adds relations.
    void bind(const std::vector<NodeId>& parameters);
    [[nodiscard]] const std::vector<NodeId>& bound() const { return bound_; }

    /// Inserts these in what is known of the variables, and takes them off the variables; false, and nothing changes,
    /// where that makes something undefined. `constants` are parameters from now on, and `variables` are there too.
    [[nodiscard]] bool restrict_to(const Replacements& replacements, const std::vector<NodeId>& constants,
                                   const std::vector<NodeId>& variables = {});

    /// The same function with the values of the relations.
    [[nodiscard]] std::vector<NodeId> with_relations(const std::vector<NodeId>& functions);
    /// The scene's parameters in numbers.
    [[nodiscard]] NamedNumbers parameter_numbers() const;
    /// Random points of the motion's set with the scene's parameters, in numbers.
    [[nodiscard]] const std::vector<NamedNumbers>& points();
    /// The same, up to `count` of them with exact coordinates.
    [[nodiscard]] std::vector<NamedPoint> exact_points(std::size_t count);
    /// A function of parameters in normal form; nothing where it has none.
    [[nodiscard]] std::optional<NodeId> normal_form(NodeId function);
    /// One of them under the relations alone, with values of all inputs.
    [[nodiscard]] std::optional<NamedPoint> sample_point();
    [[nodiscard]] const ProofSetting& setting() const { return setting_; }

  private:
    /// The setting in which some parameters have their values, and what decides there.
    struct There {
        ProofSetting setting;
        std::shared_ptr<const ZeroDecider> decider; ///< null where there is none
    };
    [[nodiscard]] There& where(std::vector<NodeId> parameters, bool constrained = true);
    [[nodiscard]] Replacements values_of(const std::vector<NodeId>& parameters) const;
    [[nodiscard]] bool is_plainly_nonzero(NodeId function);
    [[nodiscard]] bool proves(const std::vector<NodeId>& functions, const std::vector<NodeId>& parameters,
                              bool constrained);
    [[nodiscard]] std::optional<std::vector<NodeId>> vanishing(const std::vector<NodeId>& functions, bool constrained);
    void forget();

    Graph* graph_;
    ProofSetting setting_;
    Replacements values_;
    std::vector<NodeId> bound_;
    std::map<std::pair<bool, std::vector<NodeId>>, There> there_;
    std::optional<std::vector<NamedNumbers>> points_;
};

} // namespace lagen
