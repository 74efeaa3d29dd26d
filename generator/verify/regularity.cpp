// SPDX-License-Identifier: GPL-2.0-or-later
/// Rank, regularity and definiteness of W, block by block.
#include "verify/regularity.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/core/evaluate.hpp"
#include "graph/core/operators.hpp"
#include "proof/almost_everywhere.hpp"
#include "proof/rational_matrix.hpp"
#include "verify/at_values.hpp"
#include "verify/definite_squares.hpp"
#include "verify/kernel_vectors.hpp"
#include "verify/singular_factors.hpp"
#include "verify/singular_points.hpp"

#include <algorithm>

namespace lagen {
namespace {

using Block = std::vector<std::size_t>;

/// For ranks, where a witness is usually all that is needed.
constexpr ProofBudget witness_budget{.products = 200'000};

/// The values of an exact sample point; nothing where one of them is irrational.
std::optional<std::map<std::string, Rational>> exact_values(const NamedPoint& point)
{
    std::map<std::string, Rational> values;
    for (const auto& [name, value] : point) {
        if (!value.exact) return {};
        values.emplace(name, *value.exact);
    }
    return values;
}

/// Entries of a block by rows where all of them are numbers; empty otherwise.
std::vector<Rational> constant_entries(const Graph& graph, const FibreHessian& hessian, const Block& block)
{
    std::vector<Rational> entries;
    for (const std::size_t a : block)
        for (const std::size_t b : block) {
            if (!graph.is_constant(hessian.W(a, b))) return {};
            entries.push_back(graph.value(hessian.W(a, b)));
        }
    return entries;
}

struct GenericRank {
    std::size_t rank = 0;
    bool decided = false;
};

/// A block too large for determinants: full rank at one exact point is full generic rank.
GenericRank rank_at_point(const Graph& graph, const FibreHessian& hessian, const Block& block,
                          const ZeroDecider& decider)
{
    const auto point = decider.sample_point();
    const auto values = point ? exact_values(*point) : std::nullopt;
    std::vector<NodeId> entries;
    for (const std::size_t a : block)
        for (const std::size_t b : block) entries.push_back(hessian.W(a, b));
    const std::vector<Rational> matrix = values ? evaluate_exactly(graph, entries, *values) : std::vector<Rational>{};
    if (matrix.empty()) return {};
    const std::size_t rank = rank_of(matrix, block.size());
    return {rank, rank == block.size()};
}

GenericRank generic_rank(Graph& graph, const FibreHessian& hessian, const Block& block, const ZeroDecider& decider)
{
    const std::vector<Rational> entries = constant_entries(graph, hessian, block);
    if (!entries.empty()) return {rank_of(entries, block.size()), true};
    if (block.size() > determinant_limit) return rank_at_point(graph, hessian, block, decider);
    const std::optional<Block> minor = nonzero_principal_minor(graph, hessian, block, decider);
    return minor ? GenericRank{minor->size(), true} : GenericRank{};
}

/// Leading principal minors of every block, the determinant of the block last; none of a block that is too large. A
/// block of numbers has one entry: 1 where it is positive definite, else -1, or 0 where it is singular.
std::vector<std::vector<NodeId>> leading_minors(Graph& graph, const FibreHessian& hessian)
{
    std::vector<std::vector<NodeId>> result;
    for (const Block& block : hessian.blocks) {
        std::vector<NodeId> minors;
        const std::size_t m = block.size();
        if (const std::vector<Rational> entries = constant_entries(graph, hessian, block); !entries.empty()) {
            const int sign = is_positive_definite(entries, m) ? 1 : rank_of(entries, m) == m ? -1 : 0;
            result.push_back({graph.constant(sign)});
            continue;
        }
        for (std::size_t size = 1; size <= m && m <= determinant_limit; ++size) {
            const Block part(block.begin(), block.begin() + static_cast<std::ptrdiff_t>(size));
            minors.push_back(minor_determinant(graph, hessian, part, part));
        }
        result.push_back(std::move(minors));
    }
    return result;
}

struct Shown {
    bool regular = true;
    bool positive_definite = true;
};

Shown show_by_minors(const ZeroDecider& decider, const std::vector<std::vector<NodeId>>& minors)
{
    Shown shown;
    for (const std::vector<NodeId>& block : minors) {
        shown.positive_definite =
            shown.positive_definite && !block.empty() &&
            std::all_of(block.begin(), block.end(), [&](NodeId minor) { return decider.proves_positive(minor); });
        shown.regular =
            shown.regular && (shown.positive_definite || (!block.empty() && decider.proves_nonzero(block.back())));
    }
    return shown;
}

/// Operations that are defined and analytic at all real operands, or divide by a number.
bool is_total(const Graph& graph, NodeId node)
{
    const Operator& row = operator_of(graph.op(node));
    const bool analytic = row.smoothness == Smoothness::meromorphic || row.smoothness == Smoothness::analytic;
    const bool by_number = row.kind == OpKind::quotient && graph.is_constant(graph.operands(node)[1]);
    return analytic && (by_number || domain_of(graph, node) == Sense::always);
}

/// For a W that is regular everywhere: the domain is all of R^N, so that its signature is the one at the origin.
bool is_definite_at_origin(Graph& graph, const FibreHessian& hessian, const ProofSetting& setting)
{
    if (!setting.constraints.empty() || !setting.domain.empty()) return false;
    std::vector<NodeId> roots = setting.defined;
    roots.insert(roots.end(), hessian.hessian.begin(), hessian.hessian.end());
    const std::vector<NodeId> needed = reachable(graph, roots);
    if (!std::all_of(needed.begin(), needed.end(), [&](NodeId node) { return is_total(graph, node); })) return false;
    Replacements origin;
    for (const NodeId node : needed)
        if (graph.op(node) == Op::input) origin.emplace_back(node, graph.constant(0));
    FibreHessian there = hessian;
    there.hessian = substitute(graph, hessian.hessian, origin);
    return std::all_of(there.blocks.begin(), there.blocks.end(), [&](const Block& block) {
        const std::vector<Rational> entries = constant_entries(graph, there, block);
        return !entries.empty() && is_positive_definite(entries, block.size());
    });
}

/// What holds of W on the whole domain. Definiteness by leading minors, else by the signature at one point.
Shown show(Graph& graph, const FibreHessian& hessian, const ProofSetting& setting, const ZeroDecider& decider,
           const std::vector<std::vector<NodeId>>& minors)
{
    Shown shown = show_by_minors(decider, minors);
    shown.positive_definite =
        shown.positive_definite || (shown.regular && is_definite_at_origin(graph, hessian, setting));
    return shown;
}

/// The determinants of the blocks that have one.
std::vector<NodeId> determinants_of(const std::vector<std::vector<NodeId>>& minors)
{
    std::vector<NodeId> determinants;
    for (const std::vector<NodeId>& block : minors)
        if (!block.empty()) determinants.push_back(block.back());
    return determinants;
}

/// W for all parameters, or for the values that some have.
struct Case {
    Graph& graph;
    const FibreHessian& hessian;
    const ProofSetting& setting;
    const ZeroDecider& decider;

    /// A sum of squares needs neither ranks nor determinants.
    [[nodiscard]] bool is_definite_by_squares() const
    {
        return proves_definite_by_squares(graph, hessian, decider) && decider.sample_point().has_value();
    }

    /// Whether W, which is regular at one point, is so at almost all.
    [[nodiscard]] bool is_regular_almost_everywhere() const
    {
        return std::ranges::all_of(hessian.blocks, [&](const Block& block) {
            if (block.size() <= determinant_limit)
                return is_nonzero_almost_everywhere(graph, minor_determinant(graph, hessian, block, block), setting,
                                                    decider);
            std::vector<NodeId> entries;
            for (const std::size_t a : block)
                for (const std::size_t b : block) entries.push_back(hessian.W(a, b));
            return are_analytic(graph, entries, setting, decider);
        });
    }
};

/// Points and equations of a W that was not proved to be regular everywhere. `minors` and `setting` for all parameters,
/// `given` for the values of the file.
void describe_singular(Regularity& result, const ProofSetting& setting, const Case& given, const Replacements& values,
                       const std::vector<std::vector<NodeId>>& minors)
{
    const std::vector<NodeId> determinants = determinants_of(minors);
    if (const auto there = substitute_where_defined(given.graph, determinants, values)) {
        result.singular_everywhere = std::ranges::any_of(
            *there, [&](NodeId value) { return given.decider.status(value) == ProofStatus::proved; });
        if (!result.singular_everywhere)
            result.singular_at = singular_points(given.graph, given.setting, given.decider.budget(), *there);
    }
    if (determinants.size() == minors.size())
        result.singular_where = singular_factors(given.graph, setting, given.decider, values, determinants);
}

/// Adds the blocks' ranks; false where one of them is not known.
bool add_ranks(const Case& all, const ZeroDecider& decider, Regularity& result)
{
    result.rank = 0;
    result.evidence.clear();
    for (const Block& block : all.hessian.blocks) {
        const GenericRank generic = generic_rank(all.graph, all.hessian, block, decider);
        if (!generic.decided) {
            result.evidence =
                "the rank of a block of " + std::to_string(block.size()) + " coupled fibre coordinates is not decided";
            return false;
        }
        result.rank += generic.rank;
    }
    return true;
}

void describe_kernel(const Case& all, Regularity& result)
{
    result.kind = Regularity::Kind::degenerate;
    for (const KernelVector& vector : kernel_vectors(all.graph, all.hessian, all.decider, all.setting)) {
        auto& named = result.kernel.emplace_back();
        for (const auto& [a, text] : vector) named.emplace_back(all.graph.input_name(all.hessian.y[a]), text);
    }
}

/// Of a W of full generic rank, which is not definite by squares: the same question for all parameters, and for the
/// values of the file where there are any (`given`; null where these make something undefined).
void decide_everywhere(Regularity& result, const Case& all, const Case* given, const Replacements& values)
{
    const std::vector<std::vector<NodeId>> minors = leading_minors(all.graph, all.hessian);
    const Shown shown = show(all.graph, all.hessian, all.setting, all.decider, minors);
    const bool asks_again = !shown.positive_definite && given != nullptr && !values.empty();
    Shown here = shown;
    if (asks_again && !given->is_definite_by_squares())
        here =
            show(all.graph, given->hessian, given->setting, given->decider, leading_minors(all.graph, given->hessian));
    else if (asks_again)
        here = Shown{};
    result.positive_definite = here.positive_definite;
    result.for_given_parameters = asks_again && (here.positive_definite || (here.regular && !shown.regular));
    result.kind = shown.regular || here.regular ? Regularity::Kind::regular : Regularity::Kind::generically_regular;
    if (result.kind == Regularity::Kind::regular) return;
    if (given != nullptr) describe_singular(result, all.setting, *given, values, minors);
    const bool everywhere = all.is_regular_almost_everywhere();
    if (everywhere && (result.singular_everywhere || !asks_again || given->is_regular_almost_everywhere())) return;
    result.kind = Regularity::Kind::undecided;
    result.evidence =
        std::string("each block of W is regular at a point; that all are so almost everywhere is not shown") +
        (everywhere ? " for the parameter values of the file" : "");
    result.singular_where.clear();
}

} // namespace

bool proves_definite(Graph& graph, const FibreHessian& hessian, const ProofSetting& setting, const ZeroDecider& decider)
{
    return proves_definite_by_squares(graph, hessian, decider) ||
           show(graph, hessian, setting, decider, leading_minors(graph, hessian)).positive_definite;
}

Regularity decide_regularity(Graph& graph, const FibreHessian& hessian, const ProofSetting& setting,
                             const ZeroDecider& decider, const Replacements& values)
{
    Regularity result;
    result.kind = Regularity::Kind::undecided;
    const auto definite = [&](bool for_values) {
        result.kind = Regularity::Kind::regular;
        result.rank = hessian.momenta.size();
        result.positive_definite = true;
        result.for_given_parameters = for_values;
        return result;
    };
    const Case all{graph, hessian, setting, decider};
    if (all.is_definite_by_squares()) return definite(false);
    const std::optional<AtValues> there = at_values(graph, hessian, setting, decider.budget(), values);
    std::optional<Case> given;
    if (there) given.emplace(Case{graph, there->hessian, there->setting, *there->decider});
    // Small blocks are tried for all parameters first.
    const bool large = std::ranges::any_of(hessian.blocks, [](const Block& block) { return block.size() > 4; });
    if (large && given && !values.empty() && given->is_definite_by_squares()) return definite(true);
    const ZeroDecider quick(graph, setting, smaller(decider.budget(), witness_budget));
    if (!add_ranks(all, quick, result) && !add_ranks(all, decider, result)) return result;
    if (result.rank < hessian.momenta.size())
        describe_kernel(all, result);
    else
        decide_everywhere(result, all, given ? &*given : nullptr, values);
    return result;
}

} // namespace lagen
