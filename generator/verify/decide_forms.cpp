// SPDX-License-Identifier: GPL-2.0-or-later
/// What [forms] claims, component by component.
#include "geometry/algebroid_of.hpp"
#include "graph/calculus/differentiate.hpp"
#include "verify/arrow_decider.hpp"
#include "verify/claims.hpp"
#include "verify/verify.hpp"

#include <algorithm>
#include <iterator>
#include <set>

namespace lagen {
namespace {

// Of forms that claim nothing.
constexpr std::size_t most_components = 5000;
constexpr std::size_t most_nodes = 20'000;                                ///< of all components
constexpr ProofBudget quick_budget{.terms = 2000, .products = 2'000'000}; ///< products: of all components

std::size_t binomial(std::size_t n, std::size_t k)
{
    if (k > n) return 0;
    std::size_t result = 1;
    for (std::size_t j = 0; j < k; ++j) result = result * (n - j) / (j + 1);
    return result;
}

/// What must be defined of a form.
std::vector<NodeId> defined_parts(const FormClaim& claim)
{
    std::vector<NodeId> nodes = claim.partial_parts;
    for (const auto& [index, value] : claim.form.components) nodes.push_back(value);
    return nodes;
}

ProofStatus status_of(const std::vector<Check>& checks)
{
    ProofStatus status = ProofStatus::proved;
    for (const Check& check : checks) status = both(status, check.decision.status);
    return status;
}

} // namespace

/// Of a form that does not claim it, within a small budget: one component that does not vanish is enough.
ProofStatus Claims::closedness(const FormClaim& claim)
{
    const std::size_t count = binomial(system_.r(), claim.form.degree + 1);
    if (count > most_components) return ProofStatus::undecided;
    const ExteriorForm d = differential(partial_, system_.algebroid, claim.form);
    ProofSetting setting = setting_;
    for (const NodeId node : defined_parts(claim)) setting.defined.push_back(node);
    ProofBudget budget = quick_budget;
    budget.products /= std::max<std::size_t>(d.components.size(), 1);
    const ZeroDecider decider(graph_, setting, smaller(judge_->decider().budget(), budget));
    ProofStatus status = decider.status(graph_.constant(0));
    std::size_t nodes = 0;
    std::set<NodeId> values;
    for (const auto& [index, value] : d.components) {
        if (!values.insert(value).second) continue;
        nodes += reachable(graph_, std::vector{value}).size();
        if (nodes > most_nodes) return ProofStatus::undecided;
        const ProofStatus component = decider.status(value);
        if (component == ProofStatus::refuted) return component;
        if (component == ProofStatus::undecided) status = component;
    }
    return status;
}

/// A check for each component of `residual`, at points where the form, and what it is said to equal, is defined as
/// written.
Claims::Vanishing Claims::vanishing(const std::string& name, const FormClaim& claim, const ExteriorForm& residual)
{
    ProofSetting setting = setting_;
    for (const NodeId node : defined_parts(claim)) setting.defined.push_back(node);
    if (name == "equals")
        setting.defined.insert(setting.defined.end(), claim.equals_parts.begin(), claim.equals_parts.end());
    Judge judge(graph_, setting, judge_->decider().budget());
    std::vector<Check> checks;
    if (residual.components.empty() && !setting.defined.empty())
        if (Decision zero = judge.decide(graph_.constant(0)); zero.status != ProofStatus::proved)
            checks.push_back({name, {claim.name}, std::move(zero)});
    for (const auto& [index, value] : residual.components) {
        Check check{name, {claim.name}, judge.decide(value)};
        for (const std::size_t a : index) check.indices.push_back(graph_.input_name(system_.algebroid.y[a]));
        checks.push_back(std::move(check));
    }
    return {std::move(checks), binomial(system_.r(), residual.degree) - residual.components.size()};
}

void Claims::decide_forms(StructureReport& structure)
{
    WhereConstant where = along_anchor();
    for (const FormClaim& claim : system_.forms) {
        const auto append = [&](Vanishing equations) {
            structure.trivial += equations.trivial;
            std::ranges::move(equations.checks, std::back_inserter(structure.checks));
        };
        FormReport report{claim.name, claim.form.degree};
        if (claim.closed) {
            Vanishing closed = vanishing("closed", claim, differential(partial_, system_.algebroid, claim.form));
            // A closed function is a Casimir.
            if (claim.form.degree == 0)
                say_where(where, defined_parts(claim), closed.checks, {"closed", {claim.name}, {}});
            report.closed = status_of(closed.checks);
            append(std::move(closed));
        } else {
            report.closed = closedness(claim);
        }
        structure.forms.push_back(std::move(report));
        if (!claim.equals) continue;
        append(vanishing("equals", claim, difference(graph_, claim.form, *claim.equals)));
    }
}

// What a groupoid claims: that its action is a right action of the group, and that the algebroid given beside it is
// its own.
//   unit       x.1 = x
//   action     x.(W W') = (x.W).W'

namespace {

/// The action property with two matrices of inputs, and the same in charts of the group.
class ActionClaims {
  public:
    ActionClaims(Graph& graph, const System& system, const ProofBudget& budget)
        : graph_(graph), groupoid_(*system.groupoid), W_(groupoid_.arrow.W), second_(primed(graph, W_)),
          decider_(graph, arrow_setting(graph, system, {groupoid_.arrow.x}), groupoid_, {W_, second_}, budget)
    {
        const Arrow g{groupoid_.arrow.x, {}, W_}, h{target(graph, groupoid_, g), {}, second_};
        const std::vector<NodeId> both = target(graph, groupoid_, h);
        const Arrow first{groupoid_.arrow.x, {}, second_};
        const Arrow other{target(graph, groupoid_, first), {}, W_};
        right_ = differences(target(graph, groupoid_, product(graph, groupoid_, g, h)), both);
        left_ = differences(target(graph, groupoid_, product(graph, groupoid_, g, h)), target(graph, groupoid_, other));
    }

    [[nodiscard]] Decision decide(NodeId residual) { return decider_.decide(residual); }

    /// True where x.(W W') = (x.W').W, by a proof.
    [[nodiscard]] bool is_left_action()
    {
        return std::ranges::all_of(left_, [&](NodeId residual) {
            return graph_.is_zero(residual) || decide(residual).status == ProofStatus::proved;
        });
    }

    /// x.(W W') - (x.W).W', shape (n)
    [[nodiscard]] const std::vector<NodeId>& residuals() const { return right_; }

  private:
    [[nodiscard]] std::vector<NodeId> differences(const std::vector<NodeId>& a, const std::vector<NodeId>& b)
    {
        std::vector<NodeId> out;
        for (std::size_t i = 0; i < a.size(); ++i) out.push_back(graph_.subtract(a[i], b[i]));
        return out;
    }

    Graph& graph_;
    const Groupoid& groupoid_;
    std::vector<NodeId> W_, second_;
    ArrowDecider decider_;
    std::vector<NodeId> right_, left_; ///< x.(W W') - (x.W).W', x.(W W') - (x.W').W
};

/// Every entry of two columns, those that neither has left out.
std::set<std::size_t> indices_of(const Column& a, const Column& b)
{
    std::set<std::size_t> indices;
    for (const Column* column : {&a, &b})
        for (const ColumnEntry& entry : *column) indices.insert(entry.index);
    return indices;
}

} // namespace

void Claims::decide_action(StructureReport& structure)
{
    const Groupoid& groupoid = *system_.groupoid;
    if (groupoid.action.empty()) return;
    const std::vector<NodeId>& x = system_.algebroid.x;
    const std::vector<NodeId> moved = target(graph_, groupoid, identity(graph_, groupoid, x));
    for (std::size_t i = 0; i < x.size(); ++i)
        append_equality(structure, "unit", {graph_.input_name(x[i])}, moved[i], x[i]);
    ActionClaims claims(graph_, system_, judge_->decider().budget());
    bool hinted = false;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (graph_.is_zero(claims.residuals()[i])) {
            ++structure.trivial;
            continue;
        }
        Check check{"action", {graph_.input_name(x[i])}, claims.decide(claims.residuals()[i])};
        if (check.decision.status != ProofStatus::proved && !hinted) {
            hinted = true;
            if (claims.is_left_action())
                check.hint = "this is a left action; the right one has the inverse of the element: transpose(W) of a "
                             "rotation, inverse(W)";
        }
        structure.checks.push_back(std::move(check));
    }
}

/// A check that `value` is `wanted`; trivial where they are one node.
void Claims::append_equality(StructureReport& structure, const char* name, std::vector<std::string> indices,
                             NodeId value, NodeId wanted)
{
    structure.append(graph_, name, std::move(indices), graph_.subtract(value, wanted), *judge_);
}

void Claims::decide_groupoid(StructureReport& structure)
{
    if (!system_.groupoid) return;
    decide_action(structure);
    if (!system_.groupoid_is_claim) return;
    const Algebroid& given = system_.algebroid;
    const Algebroid computed = algebroid_of(graph_, *system_.groupoid, given.y).algebroid;
    const auto section = [&](std::size_t a) { return graph_.input_name(given.y[a]); };
    const char* name = "algebroid_of_groupoid";
    for (std::size_t a = 0; a < given.r(); ++a)
        for (const std::size_t i : indices_of(given.anchor[a], computed.anchor[a]))
            append_equality(structure, name, {section(a), graph_.input_name(given.x[i])},
                            Algebroid::entry(graph_, given.anchor[a], i),
                            Algebroid::entry(graph_, computed.anchor[a], i));
    for (std::size_t a = 0; a < given.r(); ++a)
        for (std::size_t b = a + 1; b < given.r(); ++b)
            for (const std::size_t c : indices_of(given.C(a, b), computed.C(a, b)))
                append_equality(structure, name, {section(a), section(b), section(c)},
                                Algebroid::entry(graph_, given.C(a, b), c),
                                Algebroid::entry(graph_, computed.C(a, b), c));
}

// Involutivity of a subbundle, pair by pair: its anchor equations say it, row by row.

namespace {

/// True where `check` tells more than `known` of the same pair: refuted before undecided before proved.
bool is_worse(const Check& check, const Check& known)
{
    const ProofStatus status = check.decision.status, before = known.decision.status;
    return before != ProofStatus::refuted && (status == ProofStatus::refuted || before == ProofStatus::proved);
}

} // namespace

void append_involutive(StructureReport& structure, const System& system)
{
    if (!system.is_distribution) return;
    std::vector<Check> found;
    for (const Check& check : structure.checks) { // those of a pair stand together
        if (check.name != "anchor") continue;
        const std::vector<std::string> pair{check.indices[0], check.indices[1]};
        const bool known = !found.empty() && found.back().indices == pair;
        if (known && !is_worse(check, found.back())) continue;
        Check involutive{"involutive", pair, check.decision};
        if (check.decision.status == ProofStatus::refuted)
            involutive.hint = "[" + pair[0] + ", " + pair[1] + "] leaves the distribution along " + check.indices[2] +
                              ": a subbundle needs [rho(" + pair[0] + "), rho(" + pair[1] +
                              ")] in the span of its sections";
        if (known) found.pop_back();
        found.push_back(std::move(involutive));
    }
    std::ranges::move(found, std::back_inserter(structure.checks));
}

} // namespace lagen
