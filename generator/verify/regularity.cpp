// SPDX-License-Identifier: GPL-2.0-or-later
/// The questions of one run, each where the one before it leaves something open: the sign rule; the generic rank, by a
/// witness; definiteness or det W != 0, block by block; whether the witness stands for almost all points.
#include "verify/regularity.hpp"

#include "graph/calculus/differentiate.hpp"
#include "graph/core/evaluate.hpp"
#include "graph/core/lower.hpp"
#include "proof/almost_everywhere.hpp"
#include "proof/rational_matrix.hpp"
#include "verify/definiteness.hpp"
#include "verify/proof_setting.hpp"
#include "verify/singular_set.hpp"

#include <algorithm>

namespace lagen {
namespace {

using Block = std::vector<std::size_t>;
using RegularityKind = Regularity::Kind;

/// The values of nodes at a sample point; empty where there is none, or they are not rational there.
std::vector<Rational> values_at_point(const Graph& graph, const std::vector<NodeId>& nodes, const ZeroDecider& decider)
{
    std::map<std::string, Rational> values;
    const std::optional<NamedPoint> point = decider.sample_point();
    if (!point) return {};
    for (const auto& [name, value] : *point) {
        if (!value.exact) return {};
        values.emplace(name, *value.exact);
    }
    return evaluate_exactly(graph, nodes, values);
}

/// Full rank at one exact point is full generic rank; else a largest minor tells, of a block that is not too large for
/// one.
std::optional<std::size_t> generic_rank(Graph& graph, const FibreHessian& hessian, const Block& block,
                                        const ZeroDecider& decider)
{
    const std::vector<NodeId> entries = hessian.submatrix(block);
    const std::vector<Rational> numbers = numbers_of(graph, entries);
    if (!numbers.empty()) return rank_of(numbers, block.size());
    const std::vector<Rational> there = values_at_point(graph, entries, decider);
    if (!there.empty() && rank_of(there, block.size()) == block.size()) return block.size();
    if (block.size() > determinant_limit) return {};
    // Of constraints that describe several parts a smaller minor may vanish on one: the determinant speaks of all.
    const ProofStatus singular = decider.status(block_determinant(graph, hessian, block));
    if (singular == ProofStatus::refuted) return block.size();
    if (singular == ProofStatus::undecided) return {};
    const auto minor = FunctionMatrix(graph, entries, block.size(), block.size()).largest_minor(decider);
    return minor ? std::optional(minor->rows.size()) : std::nullopt;
}

/// A node that vanishes exactly where the block is singular; nothing of a block that is too large.
std::optional<NodeId> determinant_of_block(Graph& graph, const FibreHessian& hessian, const Block& block)
{
    if (const std::vector<Rational> numbers = numbers_of(graph, hessian.submatrix(block)); !numbers.empty())
        return graph.constant(rank_of(numbers, block.size()) == block.size() ? 1 : 0);
    if (block.size() > determinant_limit) return {};
    return block_determinant(graph, hessian, block);
}

/// Those of the blocks that have one.
std::vector<NodeId> determinants_of(Graph& graph, const FibreHessian& hessian)
{
    std::vector<NodeId> determinants;
    for (const Block& block : hessian.blocks)
        if (const auto determinant = determinant_of_block(graph, hessian, block)) determinants.push_back(*determinant);
    return determinants;
}

/// W for all parameters, or for the values that some have.
struct Case {
    Graph& graph;
    const FibreHessian& hessian;
    const ProofSetting& setting;
    const ZeroDecider& decider;
};

/// The sum of the blocks' ranks; nothing, with the reason, where one of them is not known.
std::optional<std::size_t> generic_rank(const Case& one, std::string& evidence)
{
    std::size_t sum = 0;
    for (const Block& block : one.hessian.blocks) {
        const auto rank = generic_rank(one.graph, one.hessian, block, one.decider);
        if (!rank) {
            evidence =
                "the rank of a block of " + std::to_string(block.size()) + " coupled fibre coordinates is not decided";
            return std::nullopt;
        }
        sum += *rank;
    }
    return sum;
}

/// Regular where blocks are definite, and the determinants of the others, from the first one that is not, not zero.
RegularityKind kind_everywhere(const Case& one, bool& definite)
{
    definite = true;
    for (const Block& block : one.hessian.blocks) {
        definite =
            definite && proves_matrix_definite(one.graph, one.hessian.submatrix(block), block.size(), one.decider);
        if (definite) continue;
        const auto determinant = determinant_of_block(one.graph, one.hessian, block);
        if (!determinant || !one.decider.proves_nonzero(*determinant)) return RegularityKind::generically_regular;
    }
    return RegularityKind::regular;
}

/// True where W, which is regular at one point, is so at almost all.
bool is_regular_almost_everywhere(const Case& one)
{
    return std::ranges::all_of(one.hessian.blocks, [&](const Block& block) {
        if (const auto determinant = determinant_of_block(one.graph, one.hessian, block))
            return is_nonzero_almost_everywhere(one.graph, *determinant, one.setting, one.decider);
        return are_analytic(one.graph, one.hessian.submatrix(block), one.setting, one.decider);
    });
}

/// Kind, rank, definiteness and evidence.
Regularity decide_case(const Case& one)
{
    Regularity result;
    const std::size_t full = one.hessian.y.size();
    // The sign rule needs neither ranks nor determinants.
    if (proves_definite_by_parts(one.graph, one.hessian, one.decider) && one.decider.sample_point()) {
        result.kind = RegularityKind::regular;
        result.rank = full;
        result.positive_definite = true;
        return result;
    }
    result.kind = RegularityKind::undecided;
    const std::optional<std::size_t> rank = generic_rank(one, result.evidence);
    if (!rank) return result;
    result.rank = *rank;
    result.kind = *rank < full ? RegularityKind::degenerate : kind_everywhere(one, result.positive_definite);
    if (one.setting.is_wider && result.kind != RegularityKind::regular) {
        result.kind = RegularityKind::undecided;
        result.evidence = "W is looked at on a larger set: not all base constraints are triangular";
        return result;
    }
    if (result.kind == RegularityKind::generically_regular && !is_regular_almost_everywhere(one)) {
        result.kind = RegularityKind::undecided;
        result.evidence = "each block of W is regular at a point; that all are so almost everywhere is not shown";
    }
    return result;
}

/// Points and equations of a W that was not proved to be regular everywhere; `all` for all parameters, `given` for the
/// values of the file.
void describe_singular(Regularity& result, const Case& all, const Case& given, const Replacements& values)
{
    const std::vector<NodeId> determinants = determinants_of(all.graph, all.hessian);
    if (const auto there = substitute_where_defined(all.graph, determinants, values)) {
        result.singular_everywhere = std::ranges::any_of(
            *there, [&](NodeId value) { return given.decider.status(value) == ProofStatus::proved; });
        if (!result.singular_everywhere)
            result.singular_at = singular_points(all.graph, given.setting, given.decider.budget(), *there);
    }
    if (determinants.size() == all.hessian.blocks.size())
        result.singular_where = singular_factors(all.graph, all.setting, given.decider, values, determinants);
}

void describe_kernel(Regularity& result, const Case& all)
{
    for (const KernelVector& vector : kernel_vectors(all.graph, all.hessian, all.decider, all.setting)) {
        auto& named = result.kernel.emplace_back();
        for (const auto& [a, text] : vector) named.emplace_back(all.graph.input_name(all.hessian.y[a]), text);
    }
}

} // namespace

Regularity decide_regularity(Graph& graph, const FibreHessian& hessian, const ProofSetting& setting,
                             const ZeroDecider& decider, const Replacements& values)
{
    const Case all{graph, hessian, setting, decider};
    Regularity result = decide_case(all);
    if (result.positive_definite) return result;
    if (result.kind == RegularityKind::degenerate) {
        describe_kernel(result, all);
        return result;
    }
    const auto there = at_values(graph, hessian, setting, decider.budget(), values);
    if (!there) return result;
    const Case given{graph, there->hessian, there->setting, *there->decider};
    const Regularity here = values.empty() ? result : decide_case(given);
    if (here.kind == RegularityKind::regular && (here.positive_definite || result.kind != RegularityKind::regular)) {
        result = here;
        result.for_given_parameters = true;
    }
    if (result.kind == RegularityKind::regular || result.rank < hessian.y.size()) return result;
    describe_singular(result, all, given, values);
    if (result.kind == RegularityKind::generically_regular && here.kind == RegularityKind::undecided) {
        result.kind = RegularityKind::undecided;
        result.evidence = here.evidence + " for the parameter values of the file";
    }
    if (result.kind == RegularityKind::undecided) result.singular_where.clear();
    return result;
}

namespace {

using Block = std::vector<std::size_t>;

constexpr std::size_t longest_component = 200;

/// Normal forms that take long are not worth a text.
constexpr std::size_t longest_input = 2000;

/// The later one where they are equally long.
Tree shorter(const Tree& tree, const Tree& other)
{
    return to_text(other).size() <= to_text(tree).size() ? other : tree;
}

/// The node as it was built, or its normal form.
Tree shorter_tree(const Graph& graph, NodeId node, const Decision& decision)
{
    const Tree tree = to_tree(graph, node);
    return decision.normal_form ? shorter(tree, decision.normal_form) : tree;
}

/// The shortest of what was built, its normal form and its reduced fraction; null where all are too long.
Tree tree_of(Graph& graph, NodeId node, const Decision& decision, const Order& order, const ZeroDecider& decider)
{
    Tree tree = shorter_tree(graph, node, decision);
    if (to_text(tree).size() > longest_input) return nullptr;
    if (const auto reduced = reduced_fraction(graph, node, tree, order, decider)) tree = shorter(tree, *reduced);
    return to_text(tree).size() <= longest_component ? tree : nullptr;
}

void append_vectors(std::vector<KernelVector>& vectors, Graph& graph, const FibreHessian& hessian, const Block& block,
                    const ZeroDecider& decider, const Order& order)
{
    const std::vector<NodeId> entries = hessian.submatrix(block);
    const FunctionMatrix W(graph, entries, block.size(), block.size());
    std::optional<Minor> minor = W.largest_minor(decider);
    if (!minor) return;
    minor->columns = minor->rows; // W is symmetric
    for (std::size_t j = 0; j < block.size(); ++j) {
        if (std::ranges::find(minor->rows, j) != minor->rows.end()) continue;
        const std::vector<NodeId> k = W.kernel_vector(*minor, j);
        if (!W.maps_to_zero(k, decider)) continue;
        if (auto vector = readable_vector(graph, block, k, order, decider)) vectors.push_back(std::move(*vector));
    }
}

} // namespace

std::optional<KernelVector> readable_vector(Graph& graph, const std::vector<std::size_t>& places,
                                            const std::vector<NodeId>& k, const Order& order,
                                            const ZeroDecider& decider)
{
    KernelVector vector;
    for (std::size_t b = 0; b < places.size(); ++b) {
        const Decision decision = decider.decide(k[b]);
        if (decision.status == ProofStatus::proved) continue;
        vector.emplace_back(places[b], tree_of(graph, k[b], decision, order, decider));
        if (vector.back().second == nullptr) return {};
    }
    return vector;
}

std::vector<KernelVector> kernel_vectors(Graph& graph, const FibreHessian& hessian, const ZeroDecider& decider,
                                         const ProofSetting& setting)
{
    const Order order = writing_order(graph, setting);
    std::vector<KernelVector> vectors;
    for (const Block& block : hessian.blocks)
        if (block.size() <= determinant_limit) append_vectors(vectors, graph, hessian, block, decider, order);
    return vectors;
}

} // namespace lagen
