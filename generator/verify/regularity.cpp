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
using Point = NamedPoint;

/// For ranks, where a witness is usually all that is needed.
constexpr ProofBudget witness_budget{.products = 200'000};

/// The values of an exact sample point; nothing where one of them is irrational.
std::optional<std::map<std::string, Rational>> exact_values(const Point& point)
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

/// Points and equations of a W that was not proved to be regular everywhere. `minors` for all parameters, `valued` and
/// `there` for the values of the file.
void describe_singular(Regularity& result, Graph& graph, const ProofSetting& setting, const ZeroDecider& valued,
                       const ProofSetting& there, const Replacements& defaults,
                       const std::vector<std::vector<NodeId>>& minors)
{
    const std::vector<NodeId> determinants = determinants_of(minors);
    if (const auto values = substitute_where_defined(graph, determinants, defaults)) {
        result.singular_everywhere =
            std::ranges::any_of(*values, [&](NodeId value) { return valued.status(value) == ProofStatus::proved; });
        if (!result.singular_everywhere) result.singular_at = singular_points(graph, there, valued.budget(), *values);
    }
    if (determinants.size() == minors.size())
        result.singular_where = singular_factors(graph, setting, valued, defaults, determinants);
}

/// Adds the blocks' ranks; false where one of them is not known.
bool add_ranks(Graph& graph, const FibreHessian& hessian, const ZeroDecider& decider, Regularity& result)
{
    result.rank = 0;
    result.evidence.clear();
    for (const Block& block : hessian.blocks) {
        const GenericRank generic = generic_rank(graph, hessian, block, decider);
        if (!generic.decided) {
            result.evidence =
                "the rank of a block of " + std::to_string(block.size()) + " coupled fibre coordinates is not decided";
            return false;
        }
        result.rank += generic.rank;
    }
    return true;
}

/// Definite by squares where the parameters have the values of the file.
bool is_definite_for(Graph& graph, const FibreHessian& hessian, const ProofSetting& setting, const ProofBudget& budget,
                     const Replacements& defaults)
{
    if (defaults.empty()) return false;
    const std::optional<AtValues> there = at_values(graph, hessian, setting, budget, defaults);
    return there && proves_definite_by_squares(graph, there->hessian, *there->decider) &&
           there->decider->sample_point().has_value();
}

/// Whether W, which is regular at one point, is so at almost all.
bool is_regular_almost_everywhere(Graph& graph, const FibreHessian& hessian, const ProofSetting& setting,
                                  const ZeroDecider& decider)
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

/// The same where the parameters have the values of the file; true where these make something undefined.
bool is_regular_for(Graph& graph, const FibreHessian& hessian, const ProofSetting& setting, const ProofBudget& budget,
                    const Replacements& defaults)
{
    if (defaults.empty()) return true;
    const std::optional<AtValues> there = at_values(graph, hessian, setting, budget, defaults);
    return !there || is_regular_almost_everywhere(graph, there->hessian, there->setting, *there->decider);
}

/// Of a W of full generic rank: where it is regular, and whether definite.
void decide_everywhere(Regularity& result, Graph& graph, const FibreHessian& hessian, const ProofSetting& setting,
                       const ZeroDecider& decider, const Replacements& defaults)
{
    result.kind = Regularity::Kind::generically_regular;
    const std::vector<std::vector<NodeId>> minors = leading_minors(graph, hessian);
    const Shown shown = show(graph, hessian, setting, decider, minors);
    if (shown.regular && shown.positive_definite) {
        result.kind = Regularity::Kind::regular;
        result.positive_definite = true;
        return;
    }
    if (defaults.empty()) {
        if (shown.regular)
            result.kind = Regularity::Kind::regular;
        else
            describe_singular(result, graph, setting, decider, setting, defaults, minors);
        return;
    }
    const std::optional<AtValues> there = at_values(graph, hessian, setting, decider.budget(), defaults);
    if (!there) { // the claim for all parameters stands alone
        if (shown.regular) result.kind = Regularity::Kind::regular;
        return;
    }
    const Shown given =
        is_definite_for(graph, hessian, setting, decider.budget(), defaults)
            ? Shown{}
            : show(graph, there->hessian, there->setting, *there->decider, leading_minors(graph, there->hessian));
    result.for_given_parameters = given.positive_definite || (given.regular && !shown.regular);
    result.positive_definite = given.positive_definite;
    if (given.regular || shown.regular)
        result.kind = Regularity::Kind::regular;
    else
        describe_singular(result, graph, setting, *there->decider, there->setting, defaults, minors);
}

} // namespace

bool proves_definite(Graph& graph, const FibreHessian& hessian, const ProofSetting& setting, const ZeroDecider& decider)
{
    return proves_definite_by_squares(graph, hessian, decider) ||
           show(graph, hessian, setting, decider, leading_minors(graph, hessian)).positive_definite;
}

Regularity decide_regularity(Graph& graph, const FibreHessian& hessian, const ProofSetting& setting,
                             const ZeroDecider& decider, const Replacements& defaults)
{
    Regularity result;
    result.kind = Regularity::Kind::undecided;
    // A sum of squares needs neither ranks nor determinants.
    if (proves_definite_by_squares(graph, hessian, decider) && decider.sample_point()) {
        result.kind = Regularity::Kind::regular;
        result.rank = hessian.momenta.size();
        result.positive_definite = true;
        return result;
    }
    // Small blocks are tried for all parameters first.
    const bool large =
        std::any_of(hessian.blocks.begin(), hessian.blocks.end(), [](const Block& block) { return block.size() > 4; });
    if (large && is_definite_for(graph, hessian, setting, decider.budget(), defaults)) {
        result.kind = Regularity::Kind::regular;
        result.rank = hessian.momenta.size();
        result.positive_definite = result.for_given_parameters = true;
        return result;
    }
    const ZeroDecider quick(graph, setting, smaller(decider.budget(), witness_budget));
    if (!add_ranks(graph, hessian, quick, result) && !add_ranks(graph, hessian, decider, result)) return result;
    if (result.rank < hessian.momenta.size()) {
        result.kind = Regularity::Kind::degenerate;
        for (const KernelVector& vector : kernel_vectors(graph, hessian, decider, setting)) {
            auto& named = result.kernel.emplace_back();
            for (const auto& [a, text] : vector) named.emplace_back(graph.input_name(hessian.y[a]), text);
        }
        return result;
    }
    decide_everywhere(result, graph, hessian, setting, decider, defaults);
    if (result.kind != Regularity::Kind::generically_regular) return result;
    const auto withdraw = [&](const char* where) {
        result.kind = Regularity::Kind::undecided;
        result.evidence =
            std::string("each block of W is regular at a point; that all are so almost everywhere is not shown") +
            where;
        result.singular_where.clear();
    };
    if (!is_regular_almost_everywhere(graph, hessian, setting, decider))
        withdraw("");
    else if (!result.singular_everywhere && !is_regular_for(graph, hessian, setting, decider.budget(), defaults))
        withdraw(" for the parameter values of the file");
    return result;
}

} // namespace lagen
