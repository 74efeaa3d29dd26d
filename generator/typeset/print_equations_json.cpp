// SPDX-License-Identifier: GPL-2.0-or-later
/// Equations as JSON. Expressions are texts of the expression language:
///   {"model", "title", "form", "blocks": [{"title", "formula", "equations":
///     [{"left": {"kind": "time_derivative" | "symbol" | "zero" | "bracket" | "differential" | "form" | "section" |
///     "commutator", "symbol",
///     "other", "arguments": [..],
///                "mass": [{"symbol", "value"}]},
///       "relation": "at_least" | "at_most", "right": "...", "groups": [{"label", "value"}]}]}],
///   "given": [..], "where": [{"symbol", "value"}], "system": {}, "statements": [{"formula", "status", "component":
///   [..], "residual", "witness": {}, "value", "evidence"}]}
/// `given` has blocks as `blocks`: what the model gives, L, brackets, constraints, claimed invariants; it is left out
/// where there are none. `where` says what symbols of the equations stand for, in coordinates, parameters and others of
/// the list; it is left out where there are none. `system`, {"parameters": [{"symbol", "value"}], "base": [..],
/// "fibre": [..], "momenta": [..], "ambient": [..], "controls": [..], "states": [..], "definitions": [{"symbol",
/// "value"}], "lagrangian", "hamiltonian", "constraints": [..], "rho": [{"indices", "value"}], "C": [{"indices",
/// "value"}]}, is what EquationSystem has; what the model lacks is left out. `symbol` is left out of kind "zero",
/// `mass` where the left side has no mass matrix; `other` is of kind "bracket", {symbol, other}; `arguments` are those
/// of kind "component", symbol(arguments); `relation` is left out of equations, `statements` where there are none. Of
/// kinds "differential", d symbol, and "form", d e^symbol, the right side is the sum of value e^{basis[0]} ^
/// e^{basis[1]} .. of the groups, each {"label", "value", "basis"}; of "section", e_symbol, and "commutator",
/// [e_symbol, e_other], that of value e_{basis[0]}.
#include "text/record.hpp"
#include "typeset/print_equations.hpp"
#include "typeset/print_equations_terms.hpp"

namespace lagen {
namespace {

std::string right_text(const Equation& equation)
{
    std::vector<Tree> terms;
    for (const SignedTree& term : right_side_terms(equation))
        terms.push_back(term.negative ? negate(term.tree) : term.tree);
    if (terms.empty()) return "0";
    return to_text(terms.size() == 1 ? terms[0] : add(terms));
}

const char* kind_of(LeftSide side)
{
    switch (side) {
    case LeftSide::time_derivative: return "time_derivative";
    case LeftSide::symbol: return "symbol";
    case LeftSide::zero: return "zero";
    case LeftSide::bracket: return "bracket";
    case LeftSide::differential: return "differential";
    case LeftSide::form: return "form";
    case LeftSide::component: return "component";
    case LeftSide::section: return "section";
    case LeftSide::commutator: break;
    }
    return "commutator";
}

Record left_of(const Equation& equation)
{
    Record left = {{"kind", kind_of(equation.left)}};
    if (equation.left != LeftSide::zero) left["symbol"] = equation.symbol;
    if (equation.left == LeftSide::bracket || equation.left == LeftSide::commutator) left["other"] = equation.other;
    if (equation.left == LeftSide::component) left["arguments"] = equation.arguments;
    if (!equation.mass.empty())
        left["mass"] = list_of(equation.mass, [](const TermGroup& entry) {
            return Record{{"symbol", entry.label}, {"value", to_text(entry.value)}};
        });
    return left;
}

Record record_of(const Equation& equation)
{
    Record record = {{"left", left_of(equation)}};
    if (equation.relation != Relation::equal)
        record["relation"] = equation.relation == Relation::at_least ? "at_least" : "at_most";
    const bool of_forms =
        equation.left == LeftSide::differential || equation.left == LeftSide::form ||
        equation.left == LeftSide::section || equation.left == LeftSide::commutator ||
        std::ranges::any_of(equation.groups, [](const TermGroup& group) { return !group.basis.empty(); });
    if (!of_forms) record["right"] = right_text(equation);
    record["groups"] = list_of(equation.groups, [](const TermGroup& group) {
        Record each = {{"label", group.label}, {"value", to_text(group.value)}};
        add_unless_empty(each, "basis", group.basis);
        return each;
    });
    return record;
}

Record record_of(const DecidedStatement& statement)
{
    Record record = {{"formula", statement.formula}, {"status", statement.status}};
    add_unless_empty(record, "component", statement.component);
    add_unless_empty(record, "residual", statement.residual);
    if (!statement.witness.empty()) {
        record["witness"] = object_of(statement.witness, [](const auto& value) { return value; });
        record["value"] = statement.value;
    }
    add_unless_empty(record, "evidence", statement.evidence);
    return record;
}

Record record_of(const EquationBlock& block)
{
    return {{"title", block.title},
            {"formula", block.formula},
            {"equations", list_of(block.equations, [](const Equation& each) { return record_of(each); })}};
}

/// A list of {"symbol", "value"}.
template <class Entry>
Record values_of(const std::vector<Entry>& entries, std::string Entry::*symbol)
{
    return list_of(entries, [&](const Entry& entry) {
        return Record{{"symbol", entry.*symbol}, {"value", to_text(entry.value)}};
    });
}

Record structure_of(const std::vector<StructureEntry>& entries)
{
    return list_of(entries, [](const StructureEntry& entry) {
        return Record{{"indices", entry.indices}, {"value", to_text(entry.value)}};
    });
}

} // namespace

Record record_of(const EquationSet& equations)
{
    const auto blocks = [](const std::vector<EquationBlock>& list) {
        return list_of(list, [](const EquationBlock& each) { return record_of(each); });
    };
    Record record = {{"model", equations.model},
                     {"title", equations.title},
                     {"form", equations.form},
                     {"blocks", blocks(equations.blocks)}};
    add_unless_empty(record, "given", blocks(equations.given));
    add_unless_empty(record, "where", values_of(equations.where, &WhereEntry::symbol));
    add_unless_empty(record, "statements",
                     list_of(equations.statements, [](const DecidedStatement& each) { return record_of(each); }));
    return record;
}

Record record_of(const EquationSystem& system)
{
    Record record = {{"parameters", values_of(system.parameters, &NamedTree::name)}};
    for (const auto& [part, symbols] : system.parts) record[part] = symbols;
    record["definitions"] = values_of(system.definitions, &NamedTree::name);
    for (const NamedTree& function : system.functions) record[function.name] = to_text(function.value);
    record["constraints"] = list_of(system.constraints, [](const Tree& constraint) { return to_text(constraint); });
    record["rho"] = structure_of(system.rho);
    record["C"] = structure_of(system.C);
    return record;
}

std::string print_json(const EquationSet& equations)
{
    return to_json(record_of(equations));
}

} // namespace lagen
