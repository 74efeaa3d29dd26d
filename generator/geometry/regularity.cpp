// SPDX-License-Identifier: GPL-2.0-or-later
/// Rank, regularity and definiteness of W, block by block.
#include "geometry/regularity.hpp"
#include "graph/differentiate.hpp"
#include "graph/evaluate.hpp"

#include <algorithm>
#include <bit>

namespace lagen {
namespace {

using Block = std::vector<std::size_t>;
using Replacements = std::vector<std::pair<NodeId, NodeId>>;
using Point = std::vector<std::pair<std::string, std::string>>;

constexpr std::size_t singular_point_limit = 8;

/// The values of an exact sample point; nothing where one of them is a decimal (an irrational coordinate, rounded).
std::optional<std::map<std::string, Rational>> exact_values(const Point& point)
{
    std::map<std::string, Rational> values;
    for (const auto& [name, text] : point) {
        if (text.find_first_not_of("-0123456789/") != std::string::npos) return {};
        Rational value(text);
        value.canonicalize();
        values.emplace(name, std::move(value));
    }
    return values;
}

/// Rank over the rationals by elimination. `matrix` has m rows of m entries.
std::size_t rank_of(std::vector<Rational> matrix, std::size_t m)
{
    std::size_t rank = 0;
    for (std::size_t column = 0; column < m && rank < m; ++column) {
        std::size_t pivot = rank;
        while (pivot < m && matrix[pivot * m + column] == 0) ++pivot;
        if (pivot == m) continue;
        for (std::size_t k = 0; k < m; ++k) swap(matrix[pivot * m + k], matrix[rank * m + k]);
        for (std::size_t row = rank + 1; row < m; ++row) {
            const Rational factor = matrix[row * m + column] / matrix[rank * m + column];
            for (std::size_t k = column; k < m && factor != 0; ++k)
                matrix[row * m + k] -= factor * matrix[rank * m + k];
        }
        ++rank;
    }
    return rank;
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

/// A symmetric matrix has a nonzero principal minor of the size of its rank.
GenericRank generic_rank(Graph& graph, const FibreHessian& hessian, const Block& block, const ZeroDecider& decider)
{
    if (block.size() > determinant_limit) return rank_at_point(graph, hessian, block, decider);
    for (std::size_t size = block.size(); size > 0; --size)
        for (std::size_t set = 0; set < std::size_t{1} << block.size(); ++set) {
            if (static_cast<std::size_t>(std::popcount(set)) != size) continue;
            Block part;
            for (std::size_t k = 0; k < block.size(); ++k)
                if (set >> k & 1U) part.push_back(block[k]);
            const Decision decision = decider.decide(minor_determinant(graph, hessian, part, part));
            if (decision.status == ProofStatus::refuted) return {size, true};
            if (decision.status == ProofStatus::undecided) return {};
        }
    return {0, true};
}

/// Leading principal minors of every block, the determinant of the block last.
std::vector<std::vector<NodeId>> leading_minors(Graph& graph, const FibreHessian& hessian)
{
    std::vector<std::vector<NodeId>> result;
    for (const Block& block : hessian.blocks) {
        std::vector<NodeId> minors;
        for (std::size_t size = 1; size <= block.size() && block.size() <= determinant_limit; ++size) {
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

Shown show_everywhere(const ZeroDecider& decider, const std::vector<std::vector<NodeId>>& minors)
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

/// The setting with the parameters at their values.
ProofSetting with_values(Graph& graph, const ProofSetting& setting, const Replacements& values)
{
    ProofSetting result;
    result.variables = setting.variables;
    result.constraints = substitute(graph, setting.constraints, values);
    result.domain = substitute(graph, setting.domain, values);
    result.defined = substitute(graph, setting.defined, values);
    return result;
}

/// Points of M = R^n with one coordinate zero where a determinant vanishes although everything is defined there.
void find_singular_points(Graph& graph, Regularity& result, const ProofSetting& setting, const ZeroDecider& decider,
                          const std::vector<std::vector<NodeId>>& minors)
{
    const auto sample = decider.sample_point();
    const auto values = sample ? exact_values(*sample) : std::nullopt;
    if (!values || !setting.constraints.empty()) return;
    for (const NodeId variable : setting.variables) {
        Point point = *sample;
        std::map<std::string, Rational> there = *values;
        there[graph.input_name(variable)] = 0;
        for (auto& [name, text] : point)
            if (name == graph.input_name(variable)) text = "0";
        const std::vector<Rational> inside = evaluate_exactly(graph, setting.domain, there);
        if (inside.size() != setting.domain.size() ||
            std::any_of(inside.begin(), inside.end(), [](const Rational& holds) { return holds == 0; }))
            continue;
        std::vector<NodeId> nodes = setting.defined;
        for (const std::vector<NodeId>& block : minors)
            if (!block.empty()) nodes.push_back(block.back());
        try {
            const Replacements zero = {{variable, graph.constant(0)}};
            const std::vector<NodeId> replaced = substitute(graph, nodes, zero);
            const bool singular = std::any_of(replaced.begin() + static_cast<std::ptrdiff_t>(setting.defined.size()),
                                              replaced.end(), [&](NodeId id) { return graph.is_zero(id); });
            if (singular && result.singular_at.size() < singular_point_limit) result.singular_at.push_back(point);
        } catch (const Error&) {
            // A division by zero: this point does not belong to the model.
        }
    }
}

/// Adds the blocks' ranks; false where one of them is not known.
bool add_ranks(Graph& graph, const FibreHessian& hessian, const ZeroDecider& decider, Regularity& result)
{
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

} // namespace

Regularity decide_regularity(Graph& graph, const FibreHessian& hessian, const ProofSetting& setting,
                             const ZeroDecider& decider, const Replacements& defaults)
{
    Regularity result;
    result.kind = Regularity::Kind::undecided;
    if (!add_ranks(graph, hessian, decider, result)) return result;
    if (result.rank < hessian.momenta.size()) {
        result.kind = Regularity::Kind::degenerate;
        return result;
    }
    result.kind = Regularity::Kind::generically_regular;
    std::vector<std::vector<NodeId>> minors = leading_minors(graph, hessian);
    Shown shown = show_everywhere(decider, minors);
    if (shown.regular && shown.positive_definite) {
        result.kind = Regularity::Kind::regular;
        result.positive_definite = true;
        return result;
    }
    if (defaults.empty()) {
        if (shown.regular)
            result.kind = Regularity::Kind::regular;
        else
            find_singular_points(graph, result, setting, decider, minors);
        return result;
    }
    try {
        const ProofSetting there = with_values(graph, setting, defaults);
        for (std::vector<NodeId>& block : minors) block = substitute(graph, block, defaults);
        const ZeroDecider valued(graph, there);
        const Shown given = show_everywhere(valued, minors);
        result.for_given_parameters = given.positive_definite || (given.regular && !shown.regular);
        result.positive_definite = given.positive_definite;
        if (given.regular || shown.regular)
            result.kind = Regularity::Kind::regular;
        else
            find_singular_points(graph, result, there, valued, minors);
    } catch (const Error&) {
        // The values of the file make something undefined: the claim for all parameters stands alone.
        if (shown.regular) result.kind = Regularity::Kind::regular;
    }
    return result;
}

} // namespace lagen
