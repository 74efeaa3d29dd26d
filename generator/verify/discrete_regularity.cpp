// SPDX-License-Identifier: GPL-2.0-or-later
/// N stands over all matrices W, where it is short, and over a chart of the group, where its witnesses are arrows:
/// proofs are tried on both, since what holds for all matrices holds on the group.
#include "verify/discrete_regularity.hpp"

#include "expression/linear_algebra.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/core/evaluate.hpp"
#include "mechanics/discrete.hpp"
#include "proof/almost_everywhere.hpp"
#include "verify/arrow_decider.hpp"
#include "verify/definiteness.hpp"
#include "verify/proof_setting.hpp"
#include "verify/regularity.hpp"
#include "verify/singular_set.hpp"

#include <algorithm>
#include <cmath>

namespace lagen {
namespace {

constexpr ProofBudget decision_budget{.terms = 2000, .products = 100'000};

/// N by rows over the coordinates of arrows, and what holds of these.
using Chart = AtValues;

class DiscreteRegularity {
  public:
    DiscreteRegularity(Graph& graph, const System& system, const ProofBudget& budget)
        : graph_(graph), system_(system), budget_(smaller(budget, decision_budget)),
          equations_(arrow_equations(graph, system)), m_(equations_.unknowns())
    {
        for (const auto& value : system.parameter_values)
            if (value.first != system.discrete->step) values_.push_back(value);
        const auto& N = equations_.matrix;
        blocks_ = connected_classes(m_, [&](std::size_t a, std::size_t b) {
            return !graph.is_zero(N[a * m_ + b]) || !graph.is_zero(N[b * m_ + a]);
        });
        for (std::size_t a = 0; a < m_; ++a)
            names_.push_back(
                graph.input_name(a < system.r() ? system.algebroid.y[a] : system.discrete->inner[a - system.r()]));
    }

    Regularity decide()
    {
        Regularity result;
        result.of = Regularity::Matrix::newton;
        result.kind = Regularity::Kind::undecided;
        const auto& logarithm = system_.discrete->logarithm;
        if (logarithm ? system_.groupoid->size > most_chart_rows
                      : system_.groupoid->size > 0 && !has_chart(*system_.groupoid)) {
            result.evidence =
                "arrows are made by Cayley's map, which does not lead into this group or is not shown to, "
                "or has larger matrices than are computed with";
            return result;
        }
        matrices_ = on_all_matrices();
        arrows_ = on_arrows();
        const std::optional<NamedPoint> point = arrows_.decider->sample_point();
        if (point) numbers_ = numbers_at(*point);
        const std::optional<Minor> minor = point ? guess_minor(numbers_, m_, system_.r()) : std::nullopt;
        if (!minor ||
            arrows_.decider->status(product_of_pivots(graph_, arrows_.nodes, m_, *minor)) != ProofStatus::refuted) {
            result.evidence = "no arrow was found at which the rank of N is certain";
            return result;
        }
        const auto& rows = minor->rows; // the momenta that are reached where dL/dw stays 0
        result.rank =
            static_cast<std::size_t>(std::ranges::count_if(rows, [&](std::size_t row) { return row < system_.r(); }));
        rows.size() < m_ ? describe_kernel(result, *minor) : describe_regular(result);
        return result;
    }

  private:
    /// x, x_next, W and the inner unknowns; t where something depends on it.
    [[nodiscard]] ProofSetting setting_over(const std::vector<NodeId>& W) const
    {
        const Groupoid& groupoid = *system_.groupoid;
        ProofSetting setting;
        setting.variables = groupoid.arrow.x;
        for (const auto* more : {&groupoid.arrow.next, &W, &system_.discrete->inner})
            setting.variables.insert(setting.variables.end(), more->begin(), more->end());
        if (depends_on_any(graph_, equations_.matrix, std::vector{system_.time}))
            setting.variables.push_back(system_.time);
        setting.parameters = system_.parameters;
        append_step(setting, system_);
        return setting;
    }

    /// The conditions of [base] hold at both ends of an arrow, and its step is positive.
    [[nodiscard]] std::vector<NodeId> domain()
    {
        std::vector<NodeId> conditions = system_.domain;
        const Replacements moved =
            replacements(system_.groupoid->arrow.x, target(graph_, *system_.groupoid, system_.groupoid->arrow));
        for (const NodeId behind : substitute(graph_, system_.domain, moved)) conditions.push_back(behind);
        if (graph_.op(system_.discrete->step) == Op::input)
            conditions.push_back(graph_.apply(Op::greater, system_.discrete->step, graph_.constant(0)));
        return conditions;
    }

    [[nodiscard]] Chart on_all_matrices()
    {
        Chart chart{equations_.matrix, setting_over(system_.groupoid->arrow.W), nullptr};
        chart.setting.constraints = system_.functions.constraints;
        chart.setting.domain = domain();
        chart.setting.defined = {*system_.discrete->lagrangian};
        chart.decider = std::make_unique<ZeroDecider>(graph_, chart.setting, budget_);
        return chart;
    }

    [[nodiscard]] Chart on_arrows()
    {
        GroupChart group;
        const std::vector<NodeId>& W = system_.groupoid->arrow.W;
        if (const auto& logarithm = system_.discrete->logarithm)
            group = {{}, replacements(W, logarithm->element)}; // over inner unknowns
        else if (!W.empty())
            group = group_chart(graph_, *system_.groupoid, W, "s");
        s_ = group.s;
        Chart chart{substitute(graph_, matrices_.nodes, group.element), setting_over(s_), nullptr};
        if (const auto& logarithm = system_.discrete->logarithm)
            s_.assign(system_.discrete->inner.begin(),
                      system_.discrete->inner.begin() + static_cast<std::ptrdiff_t>(logarithm->conditions.size()));
        chart.setting.constraints = matrices_.setting.constraints;
        chart.setting.domain = substitute(graph_, matrices_.setting.domain, group.element);
        chart.setting.defined = substitute(graph_, matrices_.setting.defined, group.element);
        chart.decider = std::make_unique<ZeroDecider>(graph_, chart.setting, budget_);
        return chart;
    }

    /// The same for the parameter values of the file.
    [[nodiscard]] std::optional<Chart> at_file_values(const Chart& chart)
    {
        return at_values(graph_, chart.nodes, chart.setting, budget_, values_);
    }

    /// Of N over the arrows; entries that vanish are 0 where the point and N are rational.
    [[nodiscard]] std::vector<long double> numbers_at(const NamedPoint& point) const
    {
        std::map<std::string, long double> values;
        std::map<std::string, Rational> fractions;
        for (const auto& [name, value] : point) {
            values[name] = to_double(value);
            if (value.exact) fractions.emplace(name, *value.exact);
        }
        if (fractions.size() == point.size())
            if (const std::vector<Rational> exact = evaluate_exactly(graph_, arrows_.nodes, fractions);
                !exact.empty()) {
                std::vector<long double> numbers;
                for (const Rational& entry : exact) numbers.push_back(entry.get_d());
                return numbers;
            }
        return evaluate<long double>(graph_, arrows_.nodes, values);
    }

    /// One a block; none where a block is too large.
    [[nodiscard]] std::vector<NodeId> determinants_on(const Chart& chart)
    {
        std::vector<NodeId> determinants;
        for (const Places& block : blocks_) {
            if (block.size() > determinant_limit) return {};
            determinants.push_back(determinant_of(graph_, chart.nodes, m_, block, block));
        }
        return determinants;
    }

    [[nodiscard]] bool is_constant_on_group(NodeId f)
    {
        return std::ranges::all_of(gradient(graph_, f, s_), [&](NodeId slope) {
            return graph_.is_zero(slope) || arrows_.decider->status(slope) == ProofStatus::proved;
        });
    }

    /// Of an N that is regular at one arrow. On a chart a determinant that is not zero may vanish at the elements that
    /// the chart misses, but for one that is the same at all elements.
    [[nodiscard]] bool is_regular_everywhere(const Chart& matrices, const Chart& arrows)
    {
        if (!numbers_of(graph_, arrows.nodes).empty()) return true;
        const std::vector<NodeId> free = determinants_on(matrices), charted = determinants_on(arrows);
        for (std::size_t k = 0; k < free.size(); ++k)
            if (!matrices.decider->proves_nonzero(free[k]) &&
                !(!s_.empty() && arrows.decider->proves_nonzero(charted[k]) && is_constant_on_group(charted[k])))
                return false;
        return !free.empty();
    }

    void describe_regular(Regularity& result)
    {
        if (is_regular_everywhere(matrices_, arrows_)) {
            result.kind = Regularity::Kind::regular;
            return;
        }
        const std::optional<Chart> matrices = at_file_values(matrices_), arrows = at_file_values(arrows_);
        if (matrices && arrows && is_regular_everywhere(*matrices, *arrows)) {
            result.kind = Regularity::Kind::regular;
            result.for_given_parameters = true;
            return;
        }
        if (is_regular_almost_everywhere())
            result.kind = Regularity::Kind::generically_regular;
        else
            result.evidence = "N is regular at an arrow; that it is so at almost all is not shown";
        if (matrices && arrows) describe_singular(result, *matrices, *arrows);
    }

    [[nodiscard]] bool is_regular_almost_everywhere()
    {
        if (are_analytic(graph_, arrows_.nodes, arrows_.setting, *arrows_.decider)) return true;
        const std::vector<NodeId> determinants = determinants_on(arrows_);
        return !determinants.empty() && std::ranges::all_of(determinants, [&](NodeId determinant) {
            return is_nonzero_almost_everywhere(graph_, determinant, arrows_.setting, *arrows_.decider);
        });
    }

    void describe_singular(Regularity& result, const Chart& matrices, const Chart& arrows)
    {
        const std::vector<NodeId> determinants = determinants_on(arrows);
        result.singular_everywhere = std::ranges::any_of(determinants, [&](NodeId determinant) {
            return arrows.decider->status(determinant) == ProofStatus::proved;
        });
        if (result.singular_everywhere) return;
        result.singular_at = singular_points(graph_, arrows.setting, budget_, determinants);
        if (!result.singular_at.empty()) name_chart(result);
        if (result.kind == Regularity::Kind::generically_regular)
            result.singular_where =
                singular_factors(graph_, matrices_.setting, *matrices.decider, values_, determinants_on(matrices_));
    }

    void name_chart(Regularity& result) const
    {
        if (!s_.empty())
            result.coordinates = system_.discrete->logarithm ? "W = exp(xi(c) E_c) with the generators E_c of the group"
                                                             : "W = cay(s(c) E_c) with the generators E_c of the group";
    }

    /// k with N k = 0 for a column j outside of a minor, k^j = 1, N_PQ k^Q = -N_Pj, if it has small fractions as
    /// entries at the point where the minor was found.
    [[nodiscard]] std::vector<NodeId> constant_entries(const Minor& minor, std::size_t j)
    {
        std::vector<long double> matrix, right;
        for (const std::size_t p : minor.rows) {
            for (const std::size_t q : minor.columns) matrix.push_back(numbers_[p * m_ + q]);
            right.push_back(-numbers_[p * m_ + j]);
        }
        const std::vector<long double> z = substitute(factorise(std::move(matrix), right.size()), right);
        std::vector<NodeId> k(m_, graph_.constant(0));
        k[j] = graph_.constant(1);
        constexpr long multiple = 2520; // of the denominators up to 10
        for (std::size_t i = 0; i < z.size(); ++i) {
            const long double scaled = std::round(z[i] * multiple);
            if (!(std::abs(z[i] * multiple - scaled) < 1e-6L && std::abs(scaled) < 1e6L)) return {};
            k[minor.columns[i]] = graph_.constant(Rational(static_cast<long>(scaled), multiple));
        }
        return k;
    }

    /// The same by Cramer's rule, with the part of the minor in the block of j. Nothing where that is
    /// too large.
    [[nodiscard]] std::vector<NodeId> kernel_vector(const Chart& chart, const Minor& minor, std::size_t j)
    {
        const Places& block = *std::ranges::find_if(
            blocks_, [&](const Places& each) { return std::ranges::find(each, j) != each.end(); });
        const auto within = [&](Places places) {
            std::erase_if(places, [&](std::size_t k) { return std::ranges::find(block, k) == block.end(); });
            return places;
        };
        const Minor part{within(minor.rows), within(minor.columns)};
        if (part.rows.size() != part.columns.size() || part.rows.size() > determinant_limit) return {};
        return FunctionMatrix(graph_, chart.nodes, m_, m_).kernel_vector(part, j);
    }

    /// One vector a column outside of the minor; nothing where one is not proved to be in the kernel.
    [[nodiscard]] std::optional<std::vector<std::vector<NodeId>>> kernel_on(const Chart& chart, const Minor& minor)
    {
        std::vector<std::vector<NodeId>> vectors;
        for (std::size_t j = 0; j < m_; ++j) {
            if (std::ranges::find(minor.columns, j) != minor.columns.end()) continue;
            const FunctionMatrix N(graph_, chart.nodes, m_, m_);
            const auto is_in_kernel = [&](const std::vector<NodeId>& k) {
                return !k.empty() && N.maps_to_zero(k, *chart.decider);
            };
            std::vector<NodeId> k = constant_entries(minor, j);
            if (!is_in_kernel(k)) k = kernel_vector(chart, minor, j);
            if (!is_in_kernel(k)) return {};
            vectors.push_back(std::move(k));
        }
        return vectors;
    }

    void describe_kernel(Regularity& result, const Minor& minor)
    {
        for (const Chart* chart : {&matrices_, &arrows_}) {
            const auto vectors = kernel_on(*chart, minor);
            if (!vectors) continue;
            result.kind = Regularity::Kind::degenerate;
            if (chart == &arrows_) name_chart(result);
            const Order order = writing_order(graph_, chart->setting);
            for (const std::vector<NodeId>& k : *vectors) {
                const auto vector = readable_vector(graph_, first_places(m_), k, order, *chart->decider);
                if (!vector) continue;
                auto& named = result.kernel.emplace_back();
                for (const auto& [a, text] : *vector) named.emplace_back(names_[a], text);
            }
            return;
        }
        result.evidence = "N has rank " + std::to_string(minor.rows.size()) + " of " + std::to_string(m_) +
                          " at an arrow; that it is singular everywhere is not shown";
    }

    Graph& graph_;
    const System& system_;
    ProofBudget budget_;
    ArrowEquations equations_;
    std::size_t m_;                  ///< rows of N
    Replacements values_;            ///< of the parameters but the step
    std::vector<Places> blocks_;     ///< classes of coupled directions, each ascending
    std::vector<std::string> names_; ///< of the directions b
    std::vector<NodeId> s_;          ///< coordinates of the group: of exp the xi among the inner unknowns
    Chart matrices_, arrows_;
    std::vector<long double> numbers_; ///< N at one arrow
};

} // namespace

Regularity decide_discrete_regularity(Graph& graph, const System& system, const ProofBudget& budget)
{
    if (!system.discrete || !system.discrete->lagrangian || system.r() == 0) return {};
    return DiscreteRegularity(graph, system, budget).decide();
}

} // namespace lagen
