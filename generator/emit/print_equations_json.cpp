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
#include "emit/json.hpp"
#include "emit/print_equations.hpp"
#include "emit/print_equations_terms.hpp"

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

void write_names(JsonWriter& json, const std::vector<std::string>& names)
{
    json.begin_array();
    for (const std::string& name : names) json.value(name);
    json.end_array();
}

void write_left(JsonWriter& json, const Equation& equation)
{
    json.key("left").begin_object();
    switch (equation.left) {
    case LeftSide::time_derivative: json.key("kind").value("time_derivative"); break;
    case LeftSide::symbol: json.key("kind").value("symbol"); break;
    case LeftSide::zero: json.key("kind").value("zero"); break;
    case LeftSide::bracket: json.key("kind").value("bracket"); break;
    case LeftSide::differential: json.key("kind").value("differential"); break;
    case LeftSide::form: json.key("kind").value("form"); break;
    case LeftSide::component: json.key("kind").value("component"); break;
    case LeftSide::section: json.key("kind").value("section"); break;
    case LeftSide::commutator: json.key("kind").value("commutator"); break;
    }
    if (equation.left != LeftSide::zero) json.key("symbol").value(equation.symbol);
    if (equation.left == LeftSide::bracket || equation.left == LeftSide::commutator)
        json.key("other").value(equation.other);
    if (equation.left == LeftSide::component) write_names(json.key("arguments"), equation.arguments);
    if (!equation.mass.empty()) {
        json.key("mass").begin_array();
        for (const TermGroup& entry : equation.mass)
            json.begin_object().key("symbol").value(entry.label).key("value").value(to_text(entry.value)).end_object();
        json.end_array();
    }
    json.end_object();
}

void write_equation(JsonWriter& json, const Equation& equation)
{
    json.begin_object();
    write_left(json, equation);
    if (equation.relation != Relation::equal)
        json.key("relation").value(equation.relation == Relation::at_least ? "at_least" : "at_most");
    const bool of_forms =
        equation.left == LeftSide::differential || equation.left == LeftSide::form ||
        equation.left == LeftSide::section || equation.left == LeftSide::commutator ||
        std::ranges::any_of(equation.groups, [](const TermGroup& group) { return !group.basis.empty(); });
    if (!of_forms) json.key("right").value(right_text(equation));
    json.key("groups").begin_array();
    for (const TermGroup& group : equation.groups) {
        json.begin_object().key("label").value(group.label).key("value").value(to_text(group.value));
        if (!group.basis.empty()) write_names(json.key("basis"), group.basis);
        json.end_object();
    }
    json.end_array().end_object();
}

void write_statement(JsonWriter& json, const DecidedStatement& statement)
{
    json.begin_object().key("formula").value(statement.formula).key("status").value(statement.status);
    if (!statement.component.empty()) write_names(json.key("component"), statement.component);
    if (!statement.residual.empty()) json.key("residual").value(statement.residual);
    if (!statement.witness.empty()) {
        json.key("witness").begin_object();
        for (const auto& [name, value] : statement.witness) json.key(name).value(value);
        json.end_object().key("value").value(statement.value);
    }
    if (!statement.evidence.empty()) json.key("evidence").value(statement.evidence);
    json.end_object();
}

void write_blocks(JsonWriter& json, const std::vector<EquationBlock>& blocks)
{
    json.begin_array();
    for (const EquationBlock& block : blocks) {
        json.begin_object().key("title").value(block.title).key("formula").value(block.formula);
        json.key("equations").begin_array();
        for (const Equation& equation : block.equations) write_equation(json, equation);
        json.end_array().end_object();
    }
    json.end_array();
}

template <class Entry>
void write_values(JsonWriter& json, const std::vector<Entry>& entries, std::string Entry::*symbol)
{
    json.begin_array();
    for (const Entry& entry : entries)
        json.begin_object().key("symbol").value(entry.*symbol).key("value").value(to_text(entry.value)).end_object();
    json.end_array();
}

void write_structure(JsonWriter& json, const std::vector<StructureEntry>& entries)
{
    json.begin_array();
    for (const StructureEntry& entry : entries) {
        write_names(json.begin_object().key("indices"), entry.indices);
        json.key("value").value(to_text(entry.value)).end_object();
    }
    json.end_array();
}

void write_system(JsonWriter& json, const EquationSystem& system)
{
    write_values(json.begin_object().key("parameters"), system.parameters, &NamedTree::name);
    for (const auto& [part, symbols] : system.parts) write_names(json.key(part), symbols);
    write_values(json.key("definitions"), system.definitions, &NamedTree::name);
    for (const NamedTree& function : system.functions) json.key(function.name).value(to_text(function.value));
    json.key("constraints").begin_array();
    for (const Tree& constraint : system.constraints) json.value(to_text(constraint));
    write_structure(json.end_array().key("rho"), system.rho);
    write_structure(json.key("C"), system.C);
    json.end_object();
}

} // namespace

std::string print_json(const EquationSet& equations, const std::optional<EquationSystem>& system)
{
    JsonWriter json;
    json.begin_object().key("model").value(equations.model).key("title").value(equations.title);
    json.key("form").value(equations.form);
    write_blocks(json.key("blocks"), equations.blocks);
    if (!equations.given.empty()) write_blocks(json.key("given"), equations.given);
    if (!equations.where.empty()) write_values(json.key("where"), equations.where, &WhereEntry::symbol);
    if (system) write_system(json.key("system"), *system);
    if (!equations.statements.empty()) {
        json.key("statements").begin_array();
        for (const DecidedStatement& statement : equations.statements) write_statement(json, statement);
        json.end_array();
    }
    json.end_object();
    return json.text();
}

} // namespace lagen
