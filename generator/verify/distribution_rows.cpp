// SPDX-License-Identifier: GPL-2.0-or-later
#include "verify/distribution_rows.hpp"

#include "graph/calculus/differentiate.hpp"
#include "graph/core/lower.hpp"
#include "proof/rank.hpp"
#include "verify/singular_set.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace lagen {

namespace {

constexpr std::size_t most_minors = 200;

/// sum_k coefficients[k] values[k]
NodeId combination(Graph& graph, const std::vector<NodeId>& coefficients, const std::vector<NodeId>& values)
{
    std::vector<NodeId> terms;
    for (std::size_t k = 0; k < values.size(); ++k) terms.push_back(graph.multiply(coefficients[k], values[k]));
    return graph.sum(terms);
}

/// The combinations of rows that are zero, one for each row outside of a largest minor: a basis of the left kernel.
std::vector<std::vector<NodeId>> relations_of(Graph& graph, const std::vector<NodeId>& entries, std::size_t rows,
                                              const Minor& minor)
{
    const std::size_t width = entries.size() / rows;
    std::vector<NodeId> transposed;
    for (std::size_t column = 0; column < width; ++column)
        for (std::size_t row = 0; row < rows; ++row) transposed.push_back(entries[row * width + column]);
    const FunctionMatrix matrix(graph, transposed, width, rows);
    std::vector<std::vector<NodeId>> relations;
    for (std::size_t extra = 0; extra < rows; ++extra)
        if (std::ranges::find(minor.rows, extra) == minor.rows.end())
            relations.push_back(matrix.kernel_vector({minor.columns, minor.rows}, extra, false));
    return relations;
}

/// The text of a node that may have further inputs in it.
std::string text_with(const Graph& graph, ProofSetting setting, const std::vector<std::string>& names, NodeId node,
                      const ProofBudget& budget)
{
    for (const NodeId input : graph.inputs()) {
        const bool named = std::ranges::find(names, graph.input_name(input)) != names.end();
        const bool known = std::ranges::find(setting.variables, input) != setting.variables.end();
        if (named && !known) setting.variables.push_back(input);
    }
    setting.defined.clear();
    const std::string text = ZeroDecider(graph, setting, budget).decide(node).residual;
    return text.empty() ? to_text(graph, node) : text;
}

Decision dependent_at(const std::string& relation, const NamedPoint& point)
{
    Decision decision;
    decision.status = ProofStatus::refuted;
    decision.residual = relation;
    decision.witness = Witness{point, 0};
    return decision;
}

} // namespace

std::vector<NodeId> section_rows(Graph& graph, const System& system)
{
    const Distribution& distribution = *system.distribution;
    std::vector<NodeId> rows;
    for (const Section& section : distribution.sections)
        for (std::size_t a = 0; a < system.r(); ++a) rows.push_back(Algebroid::entry(graph, section, a));
    return rows;
}

std::vector<NodeId> constraint_rows(Graph& graph, const System& system)
{
    std::vector<NodeId> rows;
    for (const NodeId constraint : system.distribution->constraints) {
        const std::vector<NodeId> row = gradient(graph, constraint, system.algebroid.y);
        rows.insert(rows.end(), row.begin(), row.end());
    }
    return rows;
}

namespace {

/// A minor without the factors that parameters alone make, and where those are not zero.
struct ReducedMinor {
    NodeId rest;
    std::vector<std::string> where;
};

ReducedMinor reduced_minor(Graph& graph, NodeId minor, const ProofSetting& setting, const ZeroDecider& decider)
{
    ReducedMinor result{minor, {}};
    const auto factors = factors_of(graph, minor, writing_order(graph, setting), decider);
    if (!factors) return result;
    std::vector<NodeId> rest;
    for (const Tree& factor : *factors) {
        const NodeId node = Lowering(graph)(factor);
        if (depends_on_any(graph, std::vector{node}, setting.variables))
            rest.push_back(node);
        else if (!decider.proves_nonzero(node))
            result.where.push_back(to_text(factor) + " != 0");
    }
    result.rest = graph.product(rest);
    return result;
}

/// True where these minors have no common zero: the sum of their squares is positive.
bool have_no_common_zero(Graph& graph, const std::vector<ReducedMinor>& minors, const ZeroDecider& decider)
{
    std::vector<NodeId> squares;
    for (const ReducedMinor& minor : minors) squares.push_back(graph.power(minor.rest, 2));
    return !minors.empty() && decider.proves_positive(graph.sum(squares));
}

/// Conditions on the parameters under which some of the minors have no common zero, as few as are found one by one;
/// nothing where all of them together may have one.
std::optional<std::vector<std::string>> conditions_of(Graph& graph, std::vector<ReducedMinor> minors,
                                                      const ZeroDecider& decider)
{
    if (!have_no_common_zero(graph, minors, decider)) return std::nullopt;
    std::ranges::stable_sort(minors, {}, [](const ReducedMinor& minor) { return minor.where.size(); });
    for (std::size_t k = minors.size(); k-- > 0;) {
        std::vector<ReducedMinor> fewer = minors;
        fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(k));
        if (!minors[k].where.empty() && have_no_common_zero(graph, fewer, decider)) minors = std::move(fewer);
    }
    std::vector<std::string> where;
    for (const ReducedMinor& minor : minors)
        for (const std::string& condition : minor.where)
            if (std::ranges::find(where, condition) == where.end()) where.push_back(condition);
    return where;
}

/// The minors of all k rows that are not zero everywhere; nothing where there are too many.
std::optional<std::vector<NodeId>> minors_of(Graph& graph, const std::vector<NodeId>& entries, std::size_t k,
                                             const ZeroDecider& decider)
{
    std::vector<NodeId> minors;
    const std::size_t width = entries.size() / k;
    if (k > determinant_limit) return std::nullopt;
    if (k > width) return minors;
    Places columns = first_places(k);
    std::size_t looked_at = 0;
    do {
        if (++looked_at > most_minors) return std::nullopt;
        const NodeId minor = determinant_of(graph, entries, width, first_places(k), columns);
        if (!graph.is_zero(minor) && decider.status(minor) != ProofStatus::proved) minors.push_back(minor);
    } while (next_places(columns, width));
    return minors;
}

/// Of rows all of whose minors are zero: a combination of them that is. Where `values` are given the rows are linear
/// parts of constraints, and a combination of these may be left that is not zero.
void describe_dependence(Check& check, Graph& graph, const std::vector<NodeId>& entries, Judge& judge,
                         const std::vector<NodeId>& values)
{
    const ZeroDecider& decider = judge.decider();
    const std::size_t count = check.indices.size();
    const auto minor = FunctionMatrix(graph, entries, count, entries.size() / count).largest_minor(decider, true);
    const std::optional<NamedPoint> point = decider.sample_point();
    if (!minor || !point) return;
    std::vector<std::string> rows; // constraints in parentheses
    std::vector<NodeId> inputs;
    for (const std::string& row : check.indices) {
        rows.push_back(row.find(' ') == std::string::npos ? row : "(" + row + ")");
        inputs.push_back(graph.input(rows.back()));
    }
    const auto text = [&](const std::vector<NodeId>& relation) {
        return text_with(graph, judge.setting(), rows, combination(graph, relation, inputs), decider.budget());
    };
    const std::vector<std::vector<NodeId>> relations = relations_of(graph, entries, count, *minor);
    check.decision = dependent_at(text(relations.front()), *point);
    check.meaning = values.empty() ? "a combination of these sections that is zero"
                                   : "a combination of these constraints that is zero: one follows from the others";
    for (const std::vector<NodeId>& relation : relations) {
        if (values.empty()) break;
        const Decision value = judge.decide(combination(graph, relation, values));
        if (value.status == ProofStatus::proved) continue;
        check.decision.residual = text(relation);
        if (value.status == ProofStatus::undecided) {
            check.meaning =
                "a combination of these constraints in which the velocities cancel; not decided whether it is zero";
            check.decision.witness.reset();
            continue;
        }
        check.meaning =
            "a combination of these constraints in which the velocities cancel, and which is not zero: they "
            "contradict each other";
        check.decision.witness = value.witness;
        return;
    }
}

} // namespace

Check independence(Graph& graph, const std::vector<NodeId>& entries, std::vector<std::string> names, Judge& judge,
                   const std::vector<NodeId>& values)
{
    const ProofSetting& setting = judge.setting();
    const ZeroDecider& decider = judge.decider();
    const std::size_t k = names.size();
    Check check{"independent", std::move(names), {}};
    const auto minors = minors_of(graph, entries, k, decider);
    if (!minors) {
        check.decision.evidence = "the minors are more, or larger, than those that are looked at";
        return check;
    }
    if (minors->empty()) {
        describe_dependence(check, graph, entries, judge, values);
        return check;
    }
    std::vector<ReducedMinor> reduced_minors;
    std::vector<NodeId> squares;
    for (const NodeId minor : *minors) {
        if (decider.proves_nonzero(minor)) {
            check.decision = {ProofStatus::proved, "0"};
            return check;
        }
        reduced_minors.push_back(reduced_minor(graph, minor, setting, decider));
        squares.push_back(graph.power(minor, 2));
    }
    if (auto where = conditions_of(graph, std::move(reduced_minors), decider)) {
        check.decision = {ProofStatus::proved, "0"};
        check.where = std::move(*where);
        return check;
    }
    const NodeId sum = graph.sum(squares);
    const std::string text = text_with(graph, setting, {}, sum, decider.budget());
    check.meaning = "the sum of the squares of the minors of these rows, which is zero where they are dependent";
    const std::vector<NamedPoint> points = singular_points(graph, setting, decider.budget(), {sum});
    const std::optional<NamedPoint> point =
        points.empty() ? singular_corner(graph, setting, decider.budget(), {sum}) : points.front();
    if (point) {
        check.decision = dependent_at(text, *point);
        return check;
    }
    check.decision.residual = text;
    check.decision.evidence = "that the sum of the squares of all minors vanishes nowhere is not shown";
    return check;
}

namespace {

/// Linear forms on E that vanish on D, shape (r) each.
std::vector<std::vector<NodeId>> annihilators(Graph& graph, const System& system, const ZeroDecider& decider,
                                              const std::vector<NodeId>& given)
{
    const std::size_t r = system.r(), k = system.distribution->sections.size();
    std::vector<std::vector<NodeId>> forms;
    for (std::size_t first = 0; first < given.size(); first += r)
        forms.emplace_back(given.begin() + static_cast<std::ptrdiff_t>(first),
                           given.begin() + static_cast<std::ptrdiff_t>(first + r));
    if (!forms.empty() || k > determinant_limit) return forms;
    const std::vector<NodeId> A = section_rows(graph, system);
    const FunctionMatrix matrix(graph, A, k, r);
    auto minor = matrix.largest_minor(decider);
    if (!minor || minor->rows.size() != k) return forms;
    std::ranges::sort(minor->columns);
    for (std::size_t extra = 0; extra < r; ++extra) {
        const auto place = std::ranges::lower_bound(minor->columns, extra);
        if (place != minor->columns.end() && *place == extra) continue;
        std::vector<NodeId>& form = forms.emplace_back(matrix.kernel_vector(*minor, extra, false));
        if ((place - minor->columns.begin()) % 2 != 0) // the sign of the minor without the first of its columns
            for (NodeId& entry : form) entry = graph.negate(entry);
    }
    return forms;
}

/// The form with its coefficients on the names of Y: "sin(th)*v_x - cos(th)*v_y".
std::string text_of(Graph& graph, const std::vector<NodeId>& form, const std::vector<std::string>& ambient,
                    const ZeroDecider& decider)
{
    std::vector<Tree> terms;
    for (std::size_t a = 0; a < form.size(); ++a) {
        if (graph.is_zero(form[a])) continue;
        const Decision decision = decider.decide(form[a]);
        if (decision.status == ProofStatus::proved) continue;
        const Tree coefficient = decision.normal_form ? decision.normal_form : to_tree(graph, form[a]);
        const bool negative = coefficient->kind == TreeKind::negate;
        const Tree size = negative ? coefficient->arguments[0] : coefficient;
        const bool one = size->kind == TreeKind::number && (size->number == 1 || size->number == -1);
        const Tree term = one ? name(ambient[a]) : multiply({size, name(ambient[a])});
        terms.push_back(negative || (one && size->number == -1) ? negate(term) : term);
    }
    return to_text(terms.size() == 1 ? terms[0] : add(terms));
}

} // namespace

Integrability decide_integrability(Graph& graph, const System& system, const ProofSetting& setting,
                                   const ProofBudget& budget, const std::vector<NodeId>& given)
{
    Judge judge(graph, setting, budget);
    const ZeroDecider& decider = judge.decider();
    const ConstraintHull hull = constraint_hull(graph, system);
    const std::vector<std::vector<NodeId>> forms = annihilators(graph, system, decider, given);
    Integrability result;
    result.moves_with_time = depends_on_any(graph, section_rows(graph, system), std::array{system.time});
    result.status = forms.empty() && hull.k > 1 ? ProofStatus::undecided : ProofStatus::proved;
    std::vector<std::string> ambient;
    for (const NodeId Y : system.algebroid.y) ambient.push_back(graph.input_name(Y));
    for (std::size_t a = 0; a < hull.k; ++a)
        for (std::size_t b = a + 1; b < hull.k; ++b)
            for (const std::vector<NodeId>& form : forms) {
                const Column& bracket = hull.frame.C(a, b);
                const NodeId residual = pairing(graph, form, bracket);
                if (graph.is_zero(residual)) continue;
                const Decision decision = judge.decide(residual);
                if (decision.status == ProofStatus::undecided) result.status = ProofStatus::undecided;
                if (decision.status != ProofStatus::refuted) continue;
                result.status = ProofStatus::refuted;
                result.bracket = {graph.input_name(system.distribution->y[a]),
                                  graph.input_name(system.distribution->y[b])};
                for (const ColumnEntry& entry : bracket)
                    if (decider.status(entry.value) != ProofStatus::proved)
                        result.components.emplace_back(ambient[entry.index],
                                                       text_with(graph, setting, {}, entry.value, budget));
                result.violates = text_of(graph, form, ambient, decider);
                result.witness = decision.witness;
                return result;
            }
    return result;
}

} // namespace lagen
