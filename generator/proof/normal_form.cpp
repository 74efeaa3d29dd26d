// SPDX-License-Identifier: GPL-2.0-or-later
/// The walk over the graph: one ring element a node, in topological order.
#include "proof/normal_form.hpp"

#include "graph/core/operators.hpp"
#include "proof/print_fraction.hpp"

#include <algorithm>
#include <set>

namespace lagen::proof {

NormalForm::NormalForm(const Graph& graph, const ProofSetting& setting,
                       const std::vector<SolvedConstraint>& constraints, NodeId root,
                       const std::vector<NonnegativeOperand>& operands, Work budget, Angles angles,
                       Assumptions assumptions)
    : graph_(graph), setting_(setting), constraints_(constraints), operands_(nonnegative_operands(graph, {root})),
      ring_(budget), elementary_(ring_, angles, std::move(assumptions))
{
    const auto declare = [this](NodeId input) {
        if (inputs_.count(input) > 0) return;
        inputs_[input] = ring_.add_generator(
            {graph_.input_name(input), {}, 0, {}, -1, false, std::nullopt, name(graph_.input_name(input))});
    };
    operands_.insert(operands_.end(), operands.begin(), operands.end());
    std::vector<NodeId> all{root};
    for (const NonnegativeOperand& operand : operands_) all.push_back(operand.node);
    all.insert(all.end(), setting.constraints.begin(), setting.constraints.end());
    all.insert(all.end(), setting.domain.begin(), setting.domain.end());
    const std::vector<NodeId> occurring = reachable(graph, all);
    for (const std::vector<NodeId>* inputs : {&setting.parameters, &setting.variables})
        for (const NodeId input : *inputs)
            if (std::ranges::binary_search(occurring, input)) declare(input);
    for (const NodeId node : occurring)
        if (graph.op(node) == Op::input) declare(node);
    // A model may call a quantity pi: then the number is written otherwise, since texts tell generators apart.
    const auto is_called_pi = [&](const auto& entry) { return graph_.input_name(entry.first) == "pi"; };
    if (std::any_of(inputs_.begin(), inputs_.end(), is_called_pi)) static_cast<void>(elementary_.pi("acos(-1)"));
    prepare(all);
}

namespace {

enum class Units { none, angle, exponent };

Units units_of(Op op)
{
    if (op == Op::sin || op == Op::cos || op == Op::tan) return Units::angle;
    if (op == Op::sinh || op == Op::cosh || op == Op::tanh || op == Op::exp) return Units::exponent;
    return Units::none;
}

/// The inputs of a rational argument; empty where it is not rational.
std::set<NodeId> inputs_of_rational(const Graph& graph, NodeId argument)
{
    std::set<NodeId> inputs;
    for (const NodeId node : reachable(graph, std::vector<NodeId>{argument})) {
        if (!is_rational(graph.op(node))) return {};
        if (graph.op(node) == Op::input) inputs.insert(node);
    }
    return inputs;
}

} // namespace

/// Before a constraint is solved in terms of some angles and exponents, the units that the same coordinates have in
/// `roots`: with z = -sin(2 x) a finer angle x found later would leave sin(2 x) in z as a generator of its own.
void NormalForm::register_units(const std::vector<NodeId>& roots)
{
    std::set<NodeId> concerned;
    for (const NodeId node : reachable(graph_, setting_.constraints))
        if (units_of(graph_.op(node)) != Units::none)
            concerned.merge(inputs_of_rational(graph_, graph_.operands(node)[0]));
    for (const NodeId node : concerned.empty() ? std::vector<NodeId>{} : reachable(graph_, roots)) {
        const Units kind = units_of(graph_.op(node));
        if (kind == Units::none) continue;
        const std::set<NodeId> inputs = inputs_of_rational(graph_, graph_.operands(node)[0]);
        const auto meets = [&concerned](NodeId input) { return concerned.contains(input); };
        if (std::none_of(inputs.begin(), inputs.end(), meets)) continue;
        const Fraction argument = of(graph_.operands(node)[0]);
        do {
            if (kind == Units::angle)
                (void)elementary_.sine_cosine(argument);
            else
                (void)elementary_.exponential(argument);
        } while (elementary_.take_refined());
    }
    done_.clear();
}

/// Rational radicands, short ones first: the root of a product is taken apart by factors that are known when it is met.
void NormalForm::register_radicands(const std::vector<NodeId>& roots)
{
    std::set<NodeId> operands;
    for (const NodeId node : reachable(graph_, roots)) {
        const Op op = graph_.op(node);
        if (op != Op::sqrt && op != Op::real_power) continue;
        const NodeId operand = graph_.operands(node)[0];
        if (!inputs_of_rational(graph_, operand).empty()) operands.insert(operand);
    }
    std::vector<Polynomial> radicands;
    for (const NodeId operand : operands) radicands.push_back(of(operand).num);
    std::ranges::stable_sort(radicands, {}, [](const Polynomial& p) { return p.size(); });
    for (const Polynomial& radicand : radicands) {
        std::vector<std::pair<std::size_t, unsigned>> factors;
        if (!radicand.empty()) (void)ring_.split(radicand, factors);
    }
}

void NormalForm::prepare(const std::vector<NodeId>& roots)
{
    // Signs first, since a constraint may divide by what the domain makes nonzero; signs again, in the ring that the
    // constraints leave.
    add_domain();
    if (!constraints_.empty()) register_units(roots);
    for (const SolvedConstraint& solved : constraints_) solve_constraint(solved);
    elementary_.keep_families();
    done_.clear();
    if (!constraints_.empty()) add_domain();
    if (ring_.work().radicands_first) register_radicands(roots);
    add_definedness();
    for (const SolvedConstraint& solved : constraints_) {
        const Generator& coordinate = ring_.generator(inputs_.at(solved.variable));
        if (coordinate.power > 0 && coordinate.power % 2 == 0)
            ring_.add_fact(Polynomial(coordinate.relation), {false, true, true});
    }
    ring_.propagate_facts();
}

void NormalForm::add_domain()
{
    for (const NodeId node : setting_.domain) {
        const auto operands = graph_.operands(node);
        const auto [below, equal, above] = operator_of(graph_.op(node)).holds;
        if (!below && !above) continue; // no comparison, or an equation
        Fraction difference = ring_.add(of(operands[0]), of(operands[1]), -1);
        if (!above) difference = ring_.negate(std::move(difference));
        const Signs known{below && above, equal, true};
        Polynomial product = difference.num;
        // n / d > 0 says n d > 0.
        for (const auto& [index, power] : difference.factors)
            if (power % 2 != 0) product = ring_.times(product, Polynomial(ring_.factor(index)));
        ring_.add_fact(product, known);
    }
}

void NormalForm::add_definedness()
{
    for (const NonnegativeOperand& operand : operands_) {
        const Fraction value = of(operand.node);
        Polynomial product = value.num;
        for (const auto& [index, power] : value.factors)
            if (power % 2 != 0) product = ring_.times(product, Polynomial(ring_.factor(index)));
        ring_.add_fact(product, {false, !operand.positive, true});
    }
}

/// True where every divisor in the node's fraction is one that the node divides by, so that none of them vanishes where
/// it is defined. Not so with functions whose formulas divide where they are defined (Stumpff), and with branches.
bool NormalForm::divides_as_written(NodeId root) const
{
    for (const NodeId node : reachable(graph_, std::vector<NodeId>{root})) {
        const Op op = graph_.op(node);
        if (!is_rational(op) && units_of(op) == Units::none) return false;
    }
    return true;
}

void NormalForm::solve_constraint(const SolvedConstraint& solved)
{
    done_.clear();
    const Fraction form = of(setting_.constraints[solved.constraint]);
    const Polynomial& h = form.num;
    const GeneratorId id = inputs_.at(solved.variable);
    Polynomial leading, lower;
    for (const Term& term : h) {
        if (term.monomial.exponent_of(id) == solved.degree) {
            leading.push_back({term.monomial.without(id), term.coefficient});
        } else {
            lower.push_back(term);
        }
    }
    Work& work = ring_.work();
    leading = collect(std::move(leading), work);
    Polynomial open = leading, quotient;
    if (divides_as_written(setting_.constraints[solved.constraint]))
        for (const auto& [index, power] : form.factors)
            while (divide_exactly(open, ring_.factor(index), quotient, work) && !is_constant(open)) open = quotient;
    if (!ring_.signs(open).certainly_nonzero()) condition_ = to_text(ring_, leading);
    if (solved.degree == 1) {
        substitutes_[solved.variable] = ring_.divide(ring_.negate(ring_.of(lower)), ring_.of(leading));
    } else if (is_constant(leading) && abs(leading[0].coefficient) == 1) {
        ring_.set_relation(id, solved.degree, scale(lower, -leading[0].coefficient));
    } else {
        // V = leading * v satisfies the monic V^k = -leading^(k-1) lower.
        const Fraction ratio = ring_.of(leading);
        const std::string& name = graph_.input_name(solved.variable);
        const Printed factor = print(ring_, leading);
        Generator scaled{"(" + name + "*(" + factor.text + "))", {}, 0, {}, -1, false};
        if (factor.tree) scaled.tree = lagen::multiply({lagen::name(name), factor.tree});
        scaled.power = solved.degree;
        scaled.relation = ring_.times(negate(ring_.power(leading, solved.degree - 1)), lower);
        const GeneratorId multiple = ring_.add_generator(scaled);
        multiples_.push_back({multiple, id, leading});
        substitutes_[solved.variable] = ring_.divide(ring_.of(multiple), ratio);
    }
    done_.clear();
}

Fraction NormalForm::readable(const Fraction& a)
{
    Fraction result = a;
    for (const Multiple& entry : multiples_) {
        Polynomial sum;
        for (const Term& term : result.num) {
            const unsigned exponent = term.monomial.exponent_of(entry.multiple);
            const Polynomial image =
                multiply_term(ring_.power(entry.leading, exponent),
                              term.monomial.without(entry.multiple) * Monomial(entry.coordinate, exponent),
                              term.coefficient, ring_.work());
            sum = add_scaled(sum, image, 1, ring_.work());
        }
        result.num = std::move(sum);
        result = ring_.normalised(std::move(result));
    }
    return without_root_powers(std::move(result));
}

/// Powers of roots as divisors: 1/sqrt(k)^2 is 1/k, which may cancel.
Fraction NormalForm::without_root_powers(Fraction a)
{
    const auto is_input = [this](GeneratorId id) {
        return std::ranges::any_of(inputs_, [id](const auto& entry) { return entry.second == id; });
    };
    const auto divisors = a.factors;
    for (const auto& [index, power] : divisors) {
        const Polynomial divisor = ring_.factor(index);
        if (divisor.size() != 1 || divisor[0].monomial.size() != 1 || divisor[0].monomial.exponent(0) != 1) continue;
        const GeneratorId id = divisor[0].monomial.generator(0);
        const unsigned degree = ring_.generator(id).power;
        if (degree == 0 || power < degree || ring_.generator(id).partner >= 0 || is_input(id)) continue;
        const Polynomial radicand = ring_.generator(id).relation;
        const auto place = std::ranges::find(a.factors, index, &std::pair<std::size_t, unsigned>::first);
        if (place == a.factors.end() || place->second < power) continue; // something has cancelled it
        place->second = power % degree;
        if (place->second == 0) a.factors.erase(place);
        a = ring_.divide(a, ring_.power(ring_.of(radicand), static_cast<int>(power / degree)));
    }
    return a;
}

Fraction NormalForm::of(NodeId node)
{
    // A finer unit for an angle, or a root of an argument of Stumpff functions, changes earlier results: start again.
    // Each restart divides a unit by an integer or knows one more root.
    for (int restart = 0; restart < 32; ++restart) {
        Fraction result = once(node);
        if (!elementary_.take_refined())
            return !relations_.empty() && vanishes_by_rows(result.num) ? Fraction{} : result;
        done_.clear();
    }
    throw BudgetExhausted("32 refinements of units and roots exhausted");
}

Fraction NormalForm::once(NodeId node)
{
    if (const auto at = done_.find(node); at != done_.end()) return at->second;
    for (const NodeId id : reachable(graph_, std::vector<NodeId>{node}))
        if (done_.find(id) == done_.end()) done_.emplace(id, apply(id));
    return done_.at(node);
}

Fraction NormalForm::apply(NodeId node)
{
    const auto a = [&]() -> const Fraction& { return operand(node, 0); };
    const auto b = [&]() -> const Fraction& { return operand(node, 1); };
    switch (graph_.op(node)) {
    case Op::constant: return ring_.constant(graph_.value(node));
    case Op::pi: return elementary_.pi();
    case Op::input: return input(node);
    case Op::add: return ring_.add(a(), b());
    case Op::subtract: return ring_.add(a(), b(), -1);
    case Op::multiply: return ring_.times(a(), b());
    case Op::divide: return ring_.divide(a(), b());
    case Op::negate: return ring_.negate(a());
    case Op::power: return ring_.power(a(), static_cast<std::int32_t>(graph_.payload(node)));
    case Op::real_power: return elementary_.real_power(a(), b());
    case Op::sqrt: return elementary_.root(a(), 2);
    case Op::sin: return elementary_.sine_cosine(a()).sine;
    case Op::cos: return elementary_.sine_cosine(a()).cosine;
    case Op::tan: return tangent(a());
    case Op::asin: return elementary_.arcsine(a());
    case Op::acos: return elementary_.arccosine(a());
    case Op::atan: return elementary_.arctangent(a());
    case Op::atan2: return elementary_.arctangent2(a(), b());
    case Op::sinh: return hyperbolic(a(), -1);
    case Op::cosh: return hyperbolic(a(), 1);
    case Op::tanh: return hyperbolic_tangent(a());
    case Op::exp: return elementary_.exponential(a());
    case Op::log: return elementary_.logarithm(a());
    case Op::abs: return elementary_.absolute(a());
    case Op::minimum: return extremum(node, -1);
    case Op::maximum: return extremum(node, 1);
    case Op::sign: return sign(a());
    case Op::stumpff: return elementary_.stumpff(graph_.payload(node), a());
    case Op::erf: return elementary_.error_function(a());
    case Op::less:
    case Op::less_equal:
    case Op::greater:
    case Op::greater_equal:
    case Op::equal:
    case Op::not_equal: return comparison(node);
    case Op::select: return choice(node);
    case Op::factor:
    case Op::solve: break; // never read: a component looks at the entries itself
    case Op::component: return component(node);
    }
    return {};
}

Fraction NormalForm::input(NodeId node)
{
    const auto substitute = substitutes_.find(node);
    return substitute != substitutes_.end() ? substitute->second : ring_.of(inputs_.at(node));
}

Fraction NormalForm::tangent(const Fraction& a)
{
    const auto [sine, cosine] = elementary_.sine_cosine(a);
    return ring_.divide(sine, cosine);
}

Fraction NormalForm::hyperbolic(const Fraction& a, int sign)
{
    const Fraction e = elementary_.exponential(a);
    return ring_.times(ring_.constant(mpq_class(1, 2)), ring_.add(e, ring_.inverse(e), sign));
}

Fraction NormalForm::hyperbolic_tangent(const Fraction& a)
{
    const Fraction square = ring_.power(elementary_.exponential(a), 2);
    const Fraction one = ring_.constant(1);
    return ring_.divide(ring_.add(square, one, -1), ring_.add(square, one));
}

// min, max, sign, comparisons and if: by signs where these are known, else as free generators.

namespace {

/// True where a comparison of d with 0 holds, where the signs that d may have decide it.
std::optional<bool> compared(const Trichotomy& holds, const Signs& d)
{
    const bool yes = (d.negative && holds.below) || (d.zero && holds.equal) || (d.positive && holds.above);
    const bool no = (d.negative && !holds.below) || (d.zero && !holds.equal) || (d.positive && !holds.above);
    return yes && no ? std::nullopt : std::optional(yes);
}

} // namespace

std::optional<bool> NormalForm::holds(NodeId condition)
{
    const Op op = graph_.op(condition);
    if (kind_of(op) == OpKind::comparison)
        return compared(operator_of(op).holds,
                        elementary_.sign_of(ring_.add(operand(condition, 0), operand(condition, 1), -1)));
    return compared(operator_of(Op::not_equal).holds, elementary_.sign_of(done_.at(condition)));
}

Fraction NormalForm::comparison(NodeId node)
{
    if (const std::optional<bool> known = holds(node)) return ring_.constant(*known ? 1 : 0);
    return elementary_.opaque(operator_of(graph_.op(node)).word, {operand(node, 0), operand(node, 1)});
}

Fraction NormalForm::choice(NodeId node)
{
    const std::vector<Fraction> arguments{operand(node, 0), operand(node, 1), operand(node, 2)};
    const std::optional<bool> known = holds(graph_.operands(node)[0]);
    return known ? arguments[*known ? 1 : 2] : elementary_.opaque("if", arguments);
}

/// min, max = (a + b -+ |a - b|)/2
Fraction NormalForm::extremum(NodeId node, int sign)
{
    const Fraction& a = operand(node, 0);
    const Fraction& b = operand(node, 1);
    const Fraction gap = elementary_.absolute(ring_.add(a, b, -1));
    return ring_.times(ring_.constant(mpq_class(1, 2)), ring_.add(ring_.add(a, b), gap, sign));
}

Fraction NormalForm::sign(const Fraction& a)
{
    const Signs signs = elementary_.sign_of(a);
    if (static_cast<int>(signs.negative) + signs.zero + signs.positive == 1)
        return ring_.constant(signs.positive ? 1 : signs.negative ? -1 : 0);
    return elementary_.opaque("sign", {a});
}

// What the definedness of roots and logarithms says about the signs of their operands.

namespace {

bool is_simple(const Graph& graph, NodeId operand)
{
    for (const NodeId node : reachable(graph, std::vector<NodeId>{operand})) {
        const Op op = graph.op(node);
        if (!is_rational(op) && op != Op::sin && op != Op::cos) return false;
    }
    return true;
}

} // namespace

std::vector<NonnegativeOperand> nonnegative_operands(const Graph& graph, const std::vector<NodeId>& roots)
{
    std::vector<NonnegativeOperand> found;
    const std::vector<NodeId> needed = certainly_needed(graph, roots);
    for (std::size_t k = needed.size(); k-- > 0;) {
        const NodeId node = needed[k];
        const Sense sense = known_where_defined(graph, node);
        if (operator_of(graph.op(node)).condition_operand != 0) continue;
        if (sense != Sense::positive && sense != Sense::nonnegative) continue;
        const NodeId operand = graph.operands(node)[0];
        if (is_simple(graph, operand)) found.push_back({operand, sense == Sense::positive});
    }
    return found;
}

} // namespace lagen::proof
