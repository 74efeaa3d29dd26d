// SPDX-License-Identifier: GPL-2.0-or-later
/// The decision: normal form first (it is the proof and the residual's text), then certified points.
#include "proof/decide.hpp"

#include "proof/print_fraction.hpp"
#include "proof/prove_by_cases.hpp"
#include "proof/sample.hpp"
#include "proof/triangular.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace lagen {

using namespace proof;

const char* to_text(ProofStatus status)
{
    switch (status) {
    case ProofStatus::proved: return "proved";
    case ProofStatus::refuted: return "refuted";
    case ProofStatus::undecided: break;
    }
    return "undecided";
}

class ZeroDecider::State {
  public:
    State(const Graph& graph, ProofSetting setting, ProofBudget budget)
        : graph_(graph), setting_(std::move(setting)), budget_(budget),
          constraints_(triangular_constraints(graph, setting_)),
          operands_(nonnegative_operands(graph, setting_.defined)), sampler_(graph, setting_, constraints_, budget)
    {
    }

    [[nodiscard]] const ProofBudget& budget() const { return budget_; }
    /// True where a sample point where the residual is not 0 says so of M.
    [[nodiscard]] bool refutes_on_M(NodeId residual) const
    {
        return !setting_.is_wider || graph_.is_constant(residual);
    }
    [[nodiscard]] Decision decide(NodeId residual);
    [[nodiscard]] ProofStatus status(NodeId residual);
    [[nodiscard]] Decision confirm(NodeId residual, const std::string& argument);
    [[nodiscard]] Signs signs(NodeId value) const
    {
        return domain_signs(graph_, setting_, constraints_, operands_, value, {budget_.terms, budget_.products});
    }
    [[nodiscard]] std::optional<NamedPoint> sample_point();
    [[nodiscard]] Reevaluation reevaluate(NodeId residual, std::size_t points);

  private:
    /// What algebra says about a residual.
    struct Algebra {
        bool zero = false;
        bool division_by_zero = false;
        bool exhausted = false; ///< the budget
        Printed form;           ///< the normal form
        std::string note;       ///< why there is no verdict from here
    };

    [[nodiscard]] Algebra reduce(NodeId residual) const;
    [[nodiscard]] bool is_multiple(NodeId residual) const;
    [[nodiscard]] bool vanishes(NodeId residual, const Work& work) const;
    [[nodiscard]] bool vanishes_with_roots_apart(NodeId residual) const;
    [[nodiscard]] bool has_many_divisors(NodeId residual) const;
    void search_witness(const Evaluation& evaluation, Sampler& sampler, bool prove, Decision& decision) const;
    [[nodiscard]] Ball refine(const Evaluation& evaluation, const Sampler& sampler, const SamplePoint& point,
                              bool raise) const;
    [[nodiscard]] std::size_t affordable_tries(const Evaluation& evaluation) const;

    const Graph& graph_;
    ProofSetting setting_;
    ProofBudget budget_;
    std::vector<SolvedConstraint> constraints_;
    std::vector<NonnegativeOperand> operands_;
    Sampler sampler_;
};

namespace {

constexpr std::size_t many_divisors = 6;

std::string joined(const std::string& a, const std::string& b)
{
    return a.empty() || b.empty() ? a + b : a + "; " + b;
}

/// "1e-74": the next power of ten above, as a text; a bound beyond the range of double reads "inf".
std::string power_of_ten_above(double bound)
{
    if (!std::isfinite(bound)) return "inf";
    return "1e" + std::to_string(static_cast<int>(std::ceil(std::log10(bound))));
}

/// A nonzero double of the right sign even where the value under- or overflows.
double nonzero_double(const Ball& value)
{
    const double sign = arb_is_negative(value.get()) != 0 ? -1 : 1;
    const double magnitude = std::abs(value.middle());
    return sign * std::clamp(magnitude, std::numeric_limits<double>::denorm_min(), std::numeric_limits<double>::max());
}

} // namespace

/// Modulo the constraints with constant leading coefficients: is the residual 0 or a multiple of one of the others?
bool ZeroDecider::State::is_multiple(NodeId residual) const
{
    std::vector<SolvedConstraint> sound, others;
    for (const SolvedConstraint& solved : constraints_) (solved.monic ? sound : others).push_back(solved);
    NormalForm forms(graph_, setting_, sound, residual, operands_, {budget_.terms, budget_.products});
    const Polynomial numerator = forms.of(residual).num;
    if (!forms.condition().empty()) return false;
    Polynomial quotient;
    for (const SolvedConstraint& solved : others) {
        const Polynomial constraint = forms.of(setting_.constraints[solved.constraint]).num;
        const Polynomial primitive = divide_content(constraint, content(constraint));
        if (divide_exactly(numerator, primitive, quotient, forms.ring().work())) return true;
    }
    return numerator.empty();
}

/// True where the normal form is 0, with no condition, within this work.
bool ZeroDecider::State::vanishes(NodeId residual, const Work& work) const
{
    try {
        NormalForm forms(graph_, setting_, constraints_, residual, operands_, work);
        return forms.of(residual).is_zero() && forms.condition().empty();
    } catch (const BudgetExhausted&) {
        return false;
    } catch (const VanishingDivisor&) {
        return false;
    }
}

/// Roots of products as products of the other roots: sqrt(u v) = sqrt(u) sqrt(v), where several roots are. Not at
/// first, since other roots are denested while they are whole.
bool ZeroDecider::State::vanishes_with_roots_apart(NodeId residual) const
{
    std::size_t roots = 0;
    for (const NodeId node : reachable(graph_, std::vector<NodeId>{residual}))
        roots += graph_.op(node) == Op::sqrt || graph_.op(node) == Op::real_power ? 1 : 0;
    if (roots < 2) return false;
    return vanishes(residual, {budget_.terms, budget_.products, false, true});
}

/// Many different divisors: a common denominator would be their product.
bool ZeroDecider::State::has_many_divisors(NodeId residual) const
{
    std::set<NodeId> divisors;
    for (const NodeId node : reachable(graph_, std::vector<NodeId>{residual})) {
        const auto operands = graph_.operands(node);
        const bool negative = graph_.op(node) == Op::power && static_cast<std::int32_t>(graph_.payload(node)) < 0;
        if (graph_.op(node) == Op::divide && !graph_.is_constant(operands[1])) divisors.insert(operands[1]);
        if (negative || graph_.op(node) == Op::real_power) divisors.insert(operands[0]);
    }
    return divisors.size() >= many_divisors;
}

ZeroDecider::State::Algebra ZeroDecider::State::reduce(NodeId residual) const
{
    Algebra result;
    // Where this fails the common denominator decides, and says why not.
    if (has_many_divisors(residual) && vanishes(residual, {budget_.terms, budget_.products, true})) {
        result.zero = true;
        result.form = {"0", number(0)};
        return result;
    }
    try {
        NormalForm forms(graph_, setting_, constraints_, residual, operands_, {budget_.terms, budget_.products});
        const Fraction form = forms.of(residual);
        result.form = print(forms.ring(), forms.readable(form));
        result.zero = form.is_zero() && (forms.condition().empty() || is_multiple(residual));
        if (form.is_zero() && !result.zero)
            result.note = "zero wherever " + forms.condition() + " != 0, which is not shown on the whole domain";
        return result;
    } catch (const BudgetExhausted& error) {
        result.note = error.what();
        result.exhausted = true;
    } catch (const VanishingDivisor& error) {
        result.note = error.what();
        result.division_by_zero = true;
    }
    result.form.text = to_text(graph_, residual, 397); // the cut adds three dots
    return result;
}

std::size_t ZeroDecider::State::affordable_tries(const Evaluation& evaluation) const
{
    constexpr std::size_t most_operations = 4'000'000;
    return std::clamp<std::size_t>(most_operations / (evaluation.size() + 1), 4, 2 * budget_.tries);
}

/// The residual at a point: at the first precision, and where its sign stays open (and `raise`) at up to eight times
/// that.
Ball ZeroDecider::State::refine(const Evaluation& evaluation, const Sampler& sampler, const SamplePoint& point,
                                bool raise) const
{
    Ball value;
    for (slong precision = budget_.precision; precision <= 8 * budget_.precision; precision *= 2) {
        value = evaluation.enclose(sampler.enclosures(point, evaluation.inputs(), precision), precision)[0];
        if (value.excludes_zero() || !raise) break;
    }
    return value;
}

void ZeroDecider::State::search_witness(const Evaluation& evaluation, Sampler& sampler, bool prove,
                                        Decision& decision) const
{
    std::size_t finite = 0;
    double bound = 0;
    const std::size_t tries = affordable_tries(evaluation);
    for (std::size_t k = 0; k < tries; ++k) {
        const SamplePoint* point = sampler.regular(k);
        if (point == nullptr) break;
        const auto exact = evaluation.exactly(sampler.exact_values(*point, evaluation.inputs()));
        const bool zero = exact && sgn((*exact)[0]) == 0;
        const Ball value = exact ? Ball((*exact)[0], budget_.precision)
                                 : refine(evaluation, sampler, *point, !prove && finite < budget_.points);
        if (!value.is_finite()) continue;
        if (!zero && value.excludes_zero()) {
            decision.status = ProofStatus::refuted;
            decision.witness = Witness{sampler.values(*point, evaluation.inputs()), nonzero_double(value)};
            return;
        }
        // The evidence speaks of the first points alone: later ones are looked at with one precision only.
        if (finite < std::max<std::size_t>(budget_.points, 1)) bound = std::max(bound, value.bound());
        decision.points = ++finite;
        if (prove) {
            decision.status = ProofStatus::proved;
            return;
        }
    }
    if (finite == 0) {
        decision.evidence = "no regular point found in " + std::to_string(budget_.tries) + " tries";
        return;
    }
    finite = std::min(finite, std::max<std::size_t>(budget_.points, 1));
    const std::string points = " at " + std::to_string(finite) + (finite == 1 ? " point" : " points");
    decision.evidence = (bound == 0 ? "r = 0" : "|r| < " + power_of_ten_above(bound)) + points;
}

Decision ZeroDecider::State::decide(NodeId residual)
{
    Decision decision;
    const Algebra algebra = reduce(residual);
    decision.residual = algebra.form.text;
    decision.normal_form = algebra.form.tree;
    if (algebra.division_by_zero) {
        decision.evidence = algebra.note;
        return decision;
    }
    const Evaluation evaluation(graph_, {residual});
    search_witness(evaluation, sampler_, algebra.zero, decision);
    if (decision.status == ProofStatus::undecided && decision.points == 0 && sampler_.regular(0) != nullptr) {
        // The residual is defined on a part of the domain that the points of the model miss.
        ProofSetting narrower = setting_;
        narrower.defined.push_back(residual);
        Sampler sampler(graph_, narrower, constraints_, budget_);
        search_witness(evaluation, sampler, algebra.zero, decision);
    }
    if (algebra.zero && decision.status == ProofStatus::refuted)
        throw InternalError("the residual " + to_text(graph_, residual, 200) +
                            " has the normal form 0 and a point where it is not zero");
    const Decision proved_zero{.status = ProofStatus::proved, .residual = "0", .normal_form = number(0)};
    if (decision.status == ProofStatus::undecided && decision.points > 0 && !algebra.exhausted &&
        vanishes_with_roots_apart(residual))
        return proved_zero;
    if (decision.status == ProofStatus::undecided && decision.points > 0 &&
        proves_by_cases(graph_, setting_, constraints_, operands_, residual, {budget_.terms, budget_.products}))
        return proved_zero;
    if (decision.status == ProofStatus::undecided) decision.evidence = joined(decision.evidence, algebra.note);
    return decision;
}

ProofStatus ZeroDecider::State::status(NodeId residual)
{
    const Evaluation evaluation(graph_, {residual});
    for (std::size_t k = 0; k < std::max<std::size_t>(budget_.points, 1); ++k) {
        const SamplePoint* point = sampler_.regular(k);
        if (point == nullptr) break;
        if (refine(evaluation, sampler_, *point, false).excludes_zero()) return ProofStatus::refuted;
    }
    return decide(residual).status;
}

Decision ZeroDecider::State::confirm(NodeId residual, const std::string& argument)
{
    Decision decision;
    const Evaluation evaluation(graph_, {residual});
    search_witness(evaluation, sampler_, true, decision);
    if (decision.status == ProofStatus::refuted)
        throw InternalError("the residual " + to_text(graph_, residual, 200) + " should be zero (" + argument +
                            ") and has a point where it is not");
    if (decision.status != ProofStatus::proved) return decision;
    decision.residual = "0";
    decision.normal_form = number(0);
    decision.evidence = argument;
    return decision;
}

std::optional<NamedPoint> ZeroDecider::State::sample_point()
{
    const SamplePoint* point = sampler_.regular(0);
    if (point == nullptr) return std::nullopt;
    return sampler_.values(*point, {});
}

Reevaluation ZeroDecider::State::reevaluate(NodeId residual, std::size_t points)
{
    constexpr double sixty_digits = 1e-60;
    const Evaluation evaluation(graph_, {residual});
    Reevaluation result;
    for (std::size_t k = 0; result.points < points; ++k) {
        const SamplePoint* point = sampler_.regular(k);
        if (point == nullptr) break;
        Ball value;
        for (slong precision = budget_.precision; precision <= 8 * budget_.precision; precision *= 2) {
            value = evaluation.enclose(sampler_.enclosures(*point, evaluation.inputs(), precision), precision)[0];
            if (value.excludes_zero() || value.bound() < sixty_digits) break;
        }
        if (!value.is_finite()) continue;
        ++result.points;
        result.bound = std::max(result.bound, value.bound());
        if (!value.excludes_zero() || result.zero_excluded) continue;
        result.zero_excluded = true;
        result.where = sampler_.values(*point, evaluation.inputs());
    }
    return result;
}

ZeroDecider::ZeroDecider(const Graph& graph, ProofSetting setting, ProofBudget budget)
    : state_(std::make_unique<State>(graph, std::move(setting), budget))
{
}

const ProofBudget& ZeroDecider::budget() const
{
    return state_->budget();
}
ZeroDecider::~ZeroDecider() = default;

Decision ZeroDecider::decide(NodeId residual) const
{
    Decision decision = state_->decide(residual);
    if (decision.status != ProofStatus::refuted || state_->refutes_on_M(residual)) return decision;
    decision.status = ProofStatus::undecided;
    decision.evidence = "not 0 at a point that need not fulfil the base constraints: not all are triangular";
    decision.witness.reset();
    return decision;
}

ProofStatus ZeroDecider::status(NodeId residual) const
{
    const ProofStatus status = state_->status(residual);
    return status != ProofStatus::refuted || state_->refutes_on_M(residual) ? status : ProofStatus::undecided;
}

Decision ZeroDecider::confirm(NodeId residual, const std::string& argument) const
{
    return state_->confirm(residual, argument);
}

bool ZeroDecider::proves_positive(NodeId value) const
{
    return state_->signs(value).certainly_positive();
}

bool ZeroDecider::proves_nonnegative(NodeId value) const
{
    return state_->signs(value).certainly_nonnegative();
}

bool ZeroDecider::proves_nonzero(NodeId value) const
{
    return state_->signs(value).certainly_nonzero();
}

std::optional<NamedPoint> ZeroDecider::sample_point() const
{
    return state_->sample_point();
}

Reevaluation ZeroDecider::reevaluate(NodeId residual, std::size_t points) const
{
    return state_->reevaluate(residual, points);
}

double ZeroDecider::largest_bound(NodeId residual, std::size_t points) const
{
    const Reevaluation result = reevaluate(residual, points);
    return result.points == 0 ? std::numeric_limits<double>::infinity() : result.bound;
}

ProofBudget smaller(ProofBudget budget, const ProofBudget& other)
{
    budget.terms = std::min(budget.terms, other.terms);
    budget.products = std::min(budget.products, other.products);
    budget.points = std::min(budget.points, other.points);
    budget.tries = std::min(budget.tries, other.tries);
    budget.searches = std::min(budget.searches, other.searches);
    budget.precision = std::min(budget.precision, other.precision);
    return budget;
}

} // namespace lagen
