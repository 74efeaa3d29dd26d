// SPDX-License-Identifier: GPL-2.0-or-later
/// Trials in order of plausibility: signs, values that the anchor asks for, multiples of entries, missing entries. A
/// trial is first looked at where the equations were refuted; what vanishes there is decided like any model.
#include "advice/repair_search.hpp"

#include "advice/repair.hpp"
#include "graph/core/lower.hpp"
#include "verify/judge.hpp"

#include <algorithm>
#include <functional>

namespace lagen {

namespace {

// Repairs in the words and in the order of the model file.

constexpr std::size_t longest_value = 200; ///< characters; a longer one helps nobody

/// Does the file have the pair (b, a) alone? Then the hint speaks of that order.
bool is_reversed(const Algebroid& lowered, const EntryPlace& place)
{
    const std::size_t r = lowered.r();
    return !place.anchor && lowered.given[place.b * r + place.a] && !lowered.given[place.a * r + place.b];
}

std::string owner(const WrittenAlgebroid& names, const Algebroid& lowered, const EntryPlace& place)
{
    if (place.anchor) return "the anchor of " + names.fibre[place.a].name;
    const bool reversed = is_reversed(lowered, place);
    return "[" + names.fibre[reversed ? place.b : place.a].name + ", " +
           names.fibre[reversed ? place.a : place.b].name + "]";
}

std::string component(const WrittenAlgebroid& names, const EntryPlace& place)
{
    return "component " + (place.anchor ? names.base : names.fibre)[place.index].name;
}

/// The normal form, in the order of the file.
std::string value_text(Graph& graph, Judge& judge, const Algebroid& lowered, const EntryPlace& place, NodeId value)
{
    const NodeId shown = is_reversed(lowered, place) ? graph.negate(value) : value;
    return graph.is_zero(shown) ? "0" : judge.decide(shown).residual;
}

/// As the file has it.
std::string given_text(const WrittenAlgebroid& names, const Algebroid& lowered, const EntryPlace& place)
{
    const bool reversed = is_reversed(lowered, place);
    const std::size_t a = reversed ? place.b : place.a, b = reversed ? place.a : place.b;
    if (place.anchor) {
        for (const AnchorValue& entry : names.rho)
            if (entry.a == a && entry.i == place.index) return to_text(entry.value);
    } else {
        for (const StructureValue& entry : names.C)
            if (entry.a == a && entry.b == b && entry.c == place.index) return to_text(entry.value);
    }
    return "none";
}

/// Values that are numbers, as such: x*y/(y*x) is 1.
Repair simplified(Graph& graph, Judge& judge, Repair repair)
{
    for (EntryChange& change : repair.changes) {
        if (graph.is_constant(change.value)) continue;
        const Decision& decision = judge.decide(change.value);
        if (decision.status == ProofStatus::proved)
            change.value = graph.constant(0);
        else if (const NodeId value = decision.normal_form ? Lowering(graph)(decision.normal_form) : change.value;
                 graph.is_constant(value))
            change.value = value;
    }
    return repair;
}

/// Can the file have it? Not an entry that depends on the base in a bracket of constants.
bool is_admissible(const Graph& graph, const Algebroid& algebroid, const Editable& editable, const Repair& repair)
{
    if (!editable.constant_bracket) return true;
    return std::all_of(repair.changes.begin(), repair.changes.end(), [&](const EntryChange& change) {
        if (change.place.anchor) return true;
        const NodeId roots[] = {change.value};
        const std::vector<NodeId> nodes = reachable(graph, roots);
        return std::none_of(algebroid.x.begin(), algebroid.x.end(),
                            [&](NodeId x) { return std::binary_search(nodes.begin(), nodes.end(), x); });
    });
}

/// "[a, b] needs component c = V, given is W; with it <what> hold", or "<what> hold with ..."; empty where there is no
/// repair or a value has a long text. The normal forms of values come from `judge`.
std::string describe(Graph& graph, Judge& judge, const WrittenAlgebroid& names, const Algebroid& lowered,
                     const std::vector<Repair>& repairs, const std::string& what)
{
    std::vector<std::string> phrases;
    for (const Repair& repair : repairs) {
        const auto& [place, value] = repair.changes.front();
        const std::string whose = owner(names, lowered, place), which = component(names, place);
        const std::string wanted = value_text(graph, judge, lowered, place, value);
        const std::string given = given_text(names, lowered, place);
        std::string phrase;
        if (repair.kind == RepairKind::sign) {
            phrase = "the opposite sign of " + which + " of " + whose;
        } else if (repair.kind == RepairKind::order) {
            phrase = "the opposite sign of " + whose + ", as if its sections were given in the wrong order";
        } else if (wanted.size() > longest_value || given.size() > longest_value) {
            continue;
        } else if (repair.kind == RepairKind::needed && repairs.size() == 1) {
            return whose + " needs " + which + " = " + wanted + ", given is " + given + "; with it " + what + " hold";
        } else if (graph.is_zero(value)) {
            phrase = whose + " without its " + which;
        } else {
            phrase = which + " = " + wanted + " of " + whose + " (given is " + given + ")";
        }
        // On a constraint one value has many forms, and the same normal form.
        if (std::find(phrases.begin(), phrases.end(), phrase) == phrases.end()) phrases.push_back(phrase);
    }
    std::string text;
    for (const std::string& phrase : phrases) text += (text.empty() ? what + " hold with " : ", or with ") + phrase;
    return text;
}

// Values of one entry for which an equation vanishes at one point.
// f(k) = f2 k^2 + f1 k + f0 from f(0), f(1), f(-1).

/// The rational square root, where there is one.
std::optional<Rational> square_root(const Rational& value)
{
    if (sgn(value) < 0 || mpz_perfect_square_p(value.get_num().get_mpz_t()) == 0 ||
        mpz_perfect_square_p(value.get_den().get_mpz_t()) == 0)
        return std::nullopt;
    return Rational(sqrt(value.get_num()), sqrt(value.get_den()));
}

std::vector<Rational> roots(const Rational& f2, const Rational& f1, const Rational& f0)
{
    if (sgn(f2) == 0) return sgn(f1) == 0 ? std::vector<Rational>{} : std::vector<Rational>{-f0 / f1};
    const std::optional<Rational> root = square_root(f1 * f1 - 4 * f2 * f0);
    if (!root) return {};
    return {(-f1 - *root) / (2 * f2), (-f1 + *root) / (2 * f2)};
}

/// The equation is at most quadratic in a factor k of the entry (in the entry itself where there is none): k solves
/// it where `value` of a trial is known exactly. Rational k alone, other than 1 and -1; a root means something at the
/// point alone, until it is decided.
std::vector<Repair> solve_entry(Graph& graph, const Algebroid& algebroid, const EntryPlace& place,
                                const std::function<std::optional<Rational>(const Repair&)>& value)
{
    const NodeId entry = value_at(graph, algebroid, place);
    const NodeId unit = graph.is_zero(entry) ? graph.constant(1) : entry;
    const auto repair = [&](const Rational& k) {
        return Repair{RepairKind::value, {{place, graph.multiply(graph.constant(k), unit)}}};
    };
    const std::optional<Rational> at_one = value(repair(1)), at_zero = value(repair(0));
    if (!at_one || !at_zero) return {};
    const std::optional<Rational> at_minus_one = value(repair(-1));
    if (!at_minus_one) return {};
    const Rational even = (*at_one + *at_minus_one) / 2;
    std::vector<Repair> repairs;
    for (const Rational& k : roots(even - *at_zero, (*at_one - *at_minus_one) / 2, *at_zero))
        repairs.push_back(repair(k));
    return repairs;
}

constexpr std::size_t most_operations = 3'000'000; ///< in evaluations at points
constexpr std::size_t most_proofs = 12;            ///< trials that are decided in full
constexpr std::size_t most_refuted = 4;            ///< refuted equations that a trial is looked at with
constexpr std::size_t alternatives = 2;

/// The residual with the same name and indices, of a changed algebroid.
NodeId again(Graph& graph, BaseGradient& partial, const Algebroid& algebroid, const BaseFunctions& functions,
             const Residual& residual)
{
    const auto& k = residual.indices;
    if (residual.name == "anchor") return Algebroid::entry(graph, anchor_defect(partial, algebroid, k[0], k[1]), k[2]);
    if (residual.name == "jacobi")
        return Algebroid::entry(graph, jacobiator(partial, algebroid, k[0], k[1], k[2]), k[3]);
    if (residual.name == "antisymmetry")
        return graph.add(Algebroid::entry(graph, algebroid.C(k[0], k[1]), k[2]),
                         Algebroid::entry(graph, algebroid.C(k[1], k[0]), k[2]));
    const NodeId f = (residual.name == "tangency" ? functions.constraints : functions.casimirs)[k[1]];
    return partial.along(algebroid.anchor[k[0]], f);
}

} // namespace

RepairSearch::RepairSearch(Graph& graph, BaseGradient& partial, Judge& judge, const WrittenAlgebroid& names,
                           const Algebroid& lowered, const BaseFunctions& functions, Editable editable)
    : graph_(graph), partial_(partial), judge_(judge), names_(names), lowered_(lowered), functions_(functions),
      editable_(editable)
{
}

bool RepairSearch::affords(std::size_t operations)
{
    effort_ += operations;
    return effort_ < most_operations;
}

/// Do the refuted equations vanish, as far as can be seen, where they were refuted?
bool RepairSearch::fits(const std::vector<Refuted>& refuted, const Repair& repair)
{
    const Trial trial(graph_, lowered_, repair);
    for (std::size_t k = 0; k < std::min(refuted.size(), most_refuted); ++k) {
        const NodeId value = again(graph_, partial_, lowered_, functions_, *refuted[k].residual);
        WitnessPoint point(graph_, refuted[k].witness.whole);
        const bool vanishes = point.may_vanish(value);
        if (!affords(point.effort() + lowered_.r()) || !vanishes) return false;
    }
    return true;
}

bool RepairSearch::all_hold(const Repair& repair)
{
    if (++proofs_ > most_proofs) return false;
    const Trial trial(graph_, lowered_, repair);
    const ResidualList list = structure_equations(partial_, lowered_, functions_);
    return std::all_of(list.residuals.begin(), list.residuals.end(), [&](const Residual& residual) {
        return judge_.decide(residual.value).status == ProofStatus::proved;
    });
}

bool RepairSearch::anchor_holds(const Repair& repair, std::size_t a, std::size_t b)
{
    if (++proofs_ > 4 * most_proofs) return false;
    const Trial trial(graph_, lowered_, repair);
    const Column equations = anchor_defect(partial_, lowered_, a, b);
    return std::all_of(equations.begin(), equations.end(), [&](const ColumnEntry& entry) {
        return judge_.decide(entry.value).status == ProofStatus::proved;
    });
}

std::vector<Repair> RepairSearch::select(const std::vector<Repair>& candidates, const Holds& holds)
{
    std::vector<Repair> found;
    for (const Repair& candidate : candidates) {
        if (found.size() == alternatives || !affords(1)) break;
        if (is_admissible(graph_, lowered_, editable_, candidate) && holds(candidate)) found.push_back(candidate);
    }
    return found;
}

/// Values that the refuted anchor, tangency and casimir equations ask for when they are solved for one entry.
std::vector<Repair> RepairSearch::needed_values(const std::vector<Refuted>& refuted)
{
    std::vector<Repair> needed;
    const auto append = [&](const std::vector<Repair>& more) {
        for (const Repair& repair : more) needed.push_back(simplified(graph_, judge_, repair));
    };
    std::set<std::vector<std::size_t>> done; // pairs, and sections with a function
    for (const auto& [residual, witness] : refuted) {
        const std::string& name = residual->name;
        const std::vector<std::size_t>& k = residual->indices;
        if (done.size() == most_refuted) break;
        if (name == "anchor" && done.insert({k[0], k[1]}).second) {
            const Column equations = anchor_defect(partial_, lowered_, k[0], k[1]);
            if (editable_.bracket) append(needed_brackets(graph_, lowered_, k[0], k[1], equations));
            if (editable_.anchor) append(needed_anchors(graph_, lowered_, k[0], k[1], equations));
        } else if ((name == "tangency" || name == "casimir") && editable_.anchor &&
                   done.insert({k[0], k[1], name == "casimir" ? 1U : 0U}).second) {
            const NodeId f = (name == "tangency" ? functions_.constraints : functions_.casimirs)[k[1]];
            append(annihilating_anchors(graph_, partial_, lowered_, k[0], f, residual->value));
        }
    }
    return needed;
}

std::vector<Repair> RepairSearch::global_repairs(const std::vector<Refuted>& refuted)
{
    const Holds holds = [&](const Repair& repair) { return fits(refuted, repair) && all_hold(repair); };
    const auto first_stage = select(sign_repairs(graph_, lowered_, editable_), holds);
    if (!first_stage.empty()) return first_stage;
    const auto second_stage = select(needed_values(refuted), holds);
    if (!second_stage.empty()) return second_stage;
    // Multiples of an entry, or a missing number: solved for where the first equation was refuted.
    std::vector<Repair> solved;
    for (const EntryPlace& place : editable_places(lowered_, editable_, true)) {
        WitnessPoint point(graph_, refuted.front().witness.whole);
        const auto value = [&](const Repair& repair) {
            const Trial trial(graph_, lowered_, repair);
            return point.exactly(again(graph_, partial_, lowered_, functions_, *refuted.front().residual));
        };
        for (Repair& repair : solve_entry(graph_, lowered_, place, value)) solved.push_back(std::move(repair));
        if (!affords(point.effort() + lowered_.r())) break;
    }
    return select(solved, holds);
}

/// For the anchor equations of one pair alone.
std::string RepairSearch::local_hint(const ResidualList& list, std::size_t a, std::size_t b)
{
    if (!editable_.bracket) return {};
    Column residual;
    for (const Residual& equation : list.residuals)
        if (equation.name == "anchor" && equation.indices[0] == a && equation.indices[1] == b)
            residual.push_back({equation.indices[2], equation.value});
    std::vector<Repair> candidates;
    for (const ColumnEntry& entry : lowered_.C(a, b))
        candidates.push_back({RepairKind::sign, {{{false, a, b, entry.index}, graph_.negate(entry.value)}}});
    const Holds holds = [&](const Repair& repair) { return anchor_holds(repair, a, b); };
    std::vector<Repair> found = select(candidates, holds);
    if (found.empty()) {
        candidates.clear();
        for (Repair& repair : needed_brackets(graph_, lowered_, a, b, residual))
            candidates.push_back(simplified(graph_, judge_, std::move(repair)));
        found = select(candidates, holds);
    }
    return describe(graph_, judge_, names_, lowered_, found,
                    "the anchor equations of [" + names_.fibre[a].name + ", " + names_.fibre[b].name + "]");
}

std::vector<std::string> RepairSearch::hints(const ResidualList& list)
{
    std::vector<std::string> result(list.residuals.size());
    std::vector<Refuted> refuted;
    for (const Residual& residual : list.residuals) {
        const Decision& decision = judge_.decide(residual.value);
        if (decision.status == ProofStatus::refuted && decision.witness)
            refuted.push_back({&residual, *decision.witness});
    }
    if (refuted.empty()) return result;
    const std::string global =
        describe(graph_, judge_, names_, lowered_, global_repairs(refuted), "all equations of the algebroid");
    std::map<std::pair<std::size_t, std::size_t>, std::string> local;
    for (const Refuted& entry : refuted) {
        std::string& hint = result[static_cast<std::size_t>(entry.residual - list.residuals.data())];
        hint = global;
        if (!global.empty() || entry.residual->name != "anchor") continue;
        const std::pair<std::size_t, std::size_t> pair(entry.residual->indices[0], entry.residual->indices[1]);
        if (!local.contains(pair)) local[pair] = local_hint(list, pair.first, pair.second);
        hint = local[pair];
    }
    return result;
}

} // namespace lagen
