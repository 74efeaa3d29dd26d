// SPDX-License-Identifier: GPL-2.0-or-later
/// Equations as JSON. Expressions are texts of the expression language:
///   {"model", "title", "form", "blocks": [{"title", "formula", "equations":
///     [{"left": {"kind": "time_derivative" | "symbol" | "zero" | "bracket" | "differential" | "form", "symbol",
///     "other",
///                "mass": [{"symbol", "value"}]},
///       "relation": "at_least" | "at_most", "right": "...", "groups": [{"label", "value"}]}]}]}
/// `symbol` is left out of kind "zero", `mass` where the left side has no mass matrix; `other` is of kind "bracket",
/// {symbol, other}; `relation` is left out of equations. Of kinds "differential", d symbol, and "form", d e^symbol, the
/// right side is the sum of value e^{basis[0]} ^ e^{basis[1]} .. of the groups, each {"label", "value", "basis"}.
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
    }
    if (equation.left != LeftSide::zero) json.key("symbol").value(equation.symbol);
    if (equation.left == LeftSide::bracket) json.key("other").value(equation.other);
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
        std::ranges::any_of(equation.groups, [](const TermGroup& group) { return !group.basis.empty(); });
    if (!of_forms) json.key("right").value(right_text(equation));
    json.key("groups").begin_array();
    for (const TermGroup& group : equation.groups) {
        json.begin_object().key("label").value(group.label).key("value").value(to_text(group.value));
        if (!group.basis.empty()) {
            json.key("basis").begin_array();
            for (const std::string& name : group.basis) json.value(name);
            json.end_array();
        }
        json.end_object();
    }
    json.end_array().end_object();
}

} // namespace

std::string print_json(const EquationSet& equations)
{
    JsonWriter json;
    json.begin_object().key("model").value(equations.model).key("title").value(equations.title);
    json.key("form").value(equations.form).key("blocks").begin_array();
    for (const EquationBlock& block : equations.blocks) {
        json.begin_object().key("title").value(block.title).key("formula").value(block.formula);
        json.key("equations").begin_array();
        for (const Equation& equation : block.equations) write_equation(json, equation);
        json.end_array().end_object();
    }
    json.end_array().end_object();
    return json.text();
}

} // namespace lagen
