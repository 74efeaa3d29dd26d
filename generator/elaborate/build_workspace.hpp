// SPDX-License-Identifier: GPL-2.0-or-later
/// What the kinds of algebroid are built with: one graph for all formulas, the setting in which residuals vanish, and
/// the way back to trees that a person can read.
#pragma once

#include "elaborate/build_algebroid.hpp"
#include "expression/linear_algebra.hpp"
#include "geometry/section.hpp"
#include "graph/calculus/determinant.hpp"
#include "proof/decide.hpp"
#include "proof/normal_form.hpp"
#include "symbolic/ginac_door.hpp"

#include <memory>
#include <optional>

namespace lagen {

/// Anchor and structure functions of a block: sections by their number in it, base coordinates by the model's.
struct BlockParts {
    std::vector<AnchorValue> rho;
    std::vector<StructureValue> C;
};

class BuildWorkspace {
  public:
    explicit BuildWorkspace(const Model& model);
    BuildWorkspace(const BuildWorkspace&) = delete;
    BuildWorkspace& operator=(const BuildWorkspace&) = delete;

    [[nodiscard]] const Model& model() const { return model_; }
    [[nodiscard]] Graph& graph() { return graph_; }
    NodeId lower(const Tree& tree) { return lower_(tree); }
    [[nodiscard]] NodeId coordinate(std::size_t i) const { return x_.at(i); }
    [[nodiscard]] BaseGradient& gradients() { return partial_; }
    /// The parts on the graph; the order of a pair that they leave out is the negative.
    [[nodiscard]] Algebroid lowered(const AlgebroidBlock& block, const BlockParts& parts);

    /// The shortest of several exact rewritings of the node, by the base constraints too; nothing where it is zero
    /// wherever it is defined. Expressions beyond a budget come back as they were built.
    [[nodiscard]] Tree readable(NodeId node);
    /// Appends C^c_ab unless it is zero.
    void append_structure(BlockParts& parts, std::size_t c, std::size_t a, std::size_t b, NodeId value,
                          const SourceRange& where);
    void append_anchor(BlockParts& parts, std::size_t i, std::size_t a, NodeId value, const SourceRange& where);

    /// Variables, parameters, domain and (triangular) constraints of the base.
    [[nodiscard]] const ProofSetting& setting() const { return setting_; }
    /// Decides whether a function on the base is zero; `refuted` means that it is not zero at some point. The base
    /// constraints that are not triangular are ignored here (the checks refuse them).
    [[nodiscard]] Decision decide(NodeId function) const;

    /// Notes that what is built has no construction that would prove it.
    void forget_construction() { construction_.reset(); }
    /// Notes a block that everything else is made of, and which must satisfy the structure equations itself.
    void rest_on(const AlgebroidBlock& block, const BlockParts& parts);
    /// Neither the directions nor the functions of the block know coordinates outside its own base; else there is no
    /// construction.
    void require_own_base(const AlgebroidBlock& block, const BlockParts& parts);
    /// What the builders state so far; null where nothing follows.
    [[nodiscard]] Construction* construction() { return construction_ ? &*construction_ : nullptr; }
    /// It, once everything is built, with the graph that it is about.
    [[nodiscard]] std::shared_ptr<const Construction> take_construction();

  private:
    const Model& model_;
    std::optional<Construction> construction_;
    Graph graph_;
    Lowering lower_;
    std::vector<NodeId> x_;
    BaseGradient partial_;
    ProofSetting setting_;
    std::vector<proof::SolvedConstraint> solved_;
    SymbolTable symbols_;
    Order order_;
    std::map<NodeId, Tree> readable_;

    [[nodiscard]] Tree normal_tree(NodeId node, bool& zero);
};

/// rho and C of a block and everything inside it. Throws ModelError.
[[nodiscard]] BlockParts build_block(BuildWorkspace& work, const AlgebroidBlock& block);

// By kind.
[[nodiscard]] BlockParts build_given(const AlgebroidBlock& block);
[[nodiscard]] BlockParts build_action(BuildWorkspace& work, const AlgebroidBlock& block);
[[nodiscard]] BlockParts build_subbundle(BuildWorkspace& work, const AlgebroidBlock& block);
[[nodiscard]] BlockParts build_of_groupoid(BuildWorkspace& work, const AlgebroidBlock& block);
[[nodiscard]] BlockParts build_atiyah(BuildWorkspace& work, const AlgebroidBlock& block);
[[nodiscard]] BlockParts build_frame(BuildWorkspace& work, const AlgebroidBlock& block, const BlockParts& inner);
[[nodiscard]] BlockParts build_prolongation(const AlgebroidBlock& block, const BlockParts& inner);

/// Structure constants of `algebra` or `bracket`, sections counted from `first`. Throws ModelError where the algebra is
/// unknown or has not `rank` basis elements.
[[nodiscard]] std::vector<StructureValue> structure_constants(const AlgebroidBlock& block, std::size_t first,
                                                              std::size_t rank);

/// Of a matrix with m*m entries.
[[nodiscard]] std::vector<CoupledBlock> coupled_blocks(const Graph& graph, const std::vector<NodeId>& matrix,
                                                       std::size_t m);
/// z with M z = b for each b of `right`; M has m*m entries by rows and is invertible. Uncoupled unknowns are solved for
/// each for themselves, small blocks by Cramer's rule, larger ones as components of a solve.
[[nodiscard]] std::vector<std::vector<NodeId>> solve_exactly(Graph& graph, const std::vector<NodeId>& matrix,
                                                             std::size_t m,
                                                             const std::vector<std::vector<NodeId>>& right);
/// The largest block that is solved by determinants.
inline constexpr std::size_t written_determinant_limit = 5;

} // namespace lagen
