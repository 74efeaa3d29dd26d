// SPDX-License-Identifier: GPL-2.0-or-later
/// Sums keyed by the text of their terms, products by the text of their bases; derivatives and substitution.
#include "formula.hpp"

#include <stdexcept>

namespace lagen::laws {
namespace {

/// Finite decimals with a long denominator print as such, so that 1 + 10^-15 is read as the digits that a user types.
std::string number_text(const mpq_class& value)
{
    mpz_class denominator = value.get_den(), scale = 1;
    int digits = 0;
    while (digits < 40 && scale % denominator != 0) {
        scale *= 10;
        ++digits;
    }
    if (denominator < 1000 || scale % denominator != 0) return value.get_str();
    mpz_class shifted = abs(value.get_num()) * (scale / denominator);
    std::string text = shifted.get_str();
    const auto places = static_cast<std::size_t>(digits);
    if (text.size() <= places) text.insert(0, places + 1 - text.size(), '0');
    text.insert(text.size() - places, ".");
    return (value < 0 ? "-" : "") + text;
}

std::string base_text(const Formula& base, int exponent)
{
    std::string text = base.node().kind == FormulaKind::sum ? "(" + base.text() + ")" : base.text();
    if (exponent != 1) text += "^" + std::to_string(exponent);
    return text;
}

std::string product_text(const FormulaNode& node)
{
    std::string above, below;
    std::size_t count = 0;
    for (const auto& [base, exponent] : node.factors) {
        if (exponent > 0) above += (above.empty() ? "" : "*") + base_text(base, exponent);
        if (exponent < 0) {
            below += (below.empty() ? "" : "*") + base_text(base, -exponent);
            ++count;
        }
    }
    std::string text = above;
    if (above.empty())
        text = number_text(node.number);
    else if (node.number == -1)
        text = "-" + above;
    else if (node.number != 1)
        text = number_text(node.number) + "*" + above;
    if (below.empty()) return text;
    return text + (count > 1 ? "/(" + below + ")" : "/" + below);
}

std::string sum_text(const FormulaNode& node)
{
    std::string text;
    for (const auto& [coefficient, term] : node.terms) {
        const std::string piece = (Formula(coefficient) * term).text();
        if (text.empty())
            text = piece;
        else
            text += piece.front() == '-' ? " - " + piece.substr(1) : " + " + piece;
    }
    if (node.number == 0) return text;
    const std::string constant = number_text(node.number);
    return text + (constant.front() == '-' ? " - " + constant.substr(1) : " + " + constant);
}

using Terms = std::map<std::string, std::pair<mpq_class, Formula>>;
using Factors = std::map<std::string, std::pair<Formula, int>>;

} // namespace

struct FormulaBuilder {
    static Formula make(FormulaNode node)
    {
        switch (node.kind) {
        case FormulaKind::number: node.text = number_text(node.number); break;
        case FormulaKind::variable: node.text = node.name; break;
        case FormulaKind::sum: node.text = sum_text(node); break;
        case FormulaKind::product: node.text = product_text(node); break;
        case FormulaKind::call: node.text = node.name + "(" + node.argument.front().text() + ")"; break;
        }
        return Formula(std::make_shared<const FormulaNode>(std::move(node)));
    }

    static Formula sum(const Terms& terms, const mpq_class& constant)
    {
        FormulaNode node;
        node.kind = FormulaKind::sum;
        node.number = constant;
        for (const auto& [key, term] : terms)
            if (term.first != 0) node.terms.push_back(term);
        if (node.terms.empty()) return Formula(constant);
        if (node.terms.size() == 1 && constant == 0) return Formula(node.terms[0].first) * node.terms[0].second;
        return make(std::move(node));
    }

    static Formula product(const Factors& factors, const mpq_class& coefficient)
    {
        FormulaNode node;
        node.kind = FormulaKind::product;
        node.number = coefficient;
        for (const auto& [key, factor] : factors)
            if (factor.second != 0) node.factors.push_back(factor);
        if (node.factors.empty() || coefficient == 0) return Formula(coefficient);
        if (node.factors.size() == 1 && node.factors[0].second == 1 && coefficient == 1) return node.factors[0].first;
        return make(std::move(node));
    }

    static void add_to(Terms& terms, mpq_class& constant, const Formula& formula)
    {
        const FormulaNode& node = formula.node();
        if (node.kind == FormulaKind::number) {
            constant += node.number;
            return;
        }
        if (node.kind == FormulaKind::sum) {
            constant += node.number;
            for (const auto& [coefficient, term] : node.terms)
                terms.try_emplace(term.text(), mpq_class(0), term).first->second.first += coefficient;
            return;
        }
        if (node.kind == FormulaKind::product && node.number != 1) {
            Factors factors;
            for (const auto& factor : node.factors) factors.emplace(factor.first.text(), factor);
            const Formula term = product(factors, 1);
            terms.try_emplace(term.text(), mpq_class(0), term).first->second.first += node.number;
            return;
        }
        terms.try_emplace(formula.text(), mpq_class(0), formula).first->second.first += 1;
    }

    static void multiply_to(Factors& factors, mpq_class& coefficient, const Formula& formula, int exponent)
    {
        const FormulaNode& node = formula.node();
        if (node.kind == FormulaKind::number || node.kind == FormulaKind::product) {
            if (node.number == 0 && exponent < 0) throw std::logic_error("a formula divides by zero");
            for (int k = 0; k < std::abs(exponent); ++k) coefficient *= exponent > 0 ? node.number : 1 / node.number;
            for (const auto& [base, inner] : node.factors) multiply_to(factors, coefficient, base, inner * exponent);
            return;
        }
        factors.try_emplace(formula.text(), formula, 0).first->second.second += exponent;
    }
};

Formula::Formula(const mpq_class& value)
{
    FormulaNode node;
    node.number = value;
    node.text = number_text(value);
    node_ = std::make_shared<const FormulaNode>(std::move(node));
}

Formula Formula::variable(const std::string& name)
{
    FormulaNode node;
    node.kind = FormulaKind::variable;
    node.name = name;
    return FormulaBuilder::make(std::move(node));
}

const std::string& Formula::text() const
{
    return node_->text;
}

bool Formula::is_zero() const
{
    return node_->kind == FormulaKind::number && node_->number == 0;
}

Formula operator+(const Formula& a, const Formula& b)
{
    Terms terms;
    mpq_class constant = 0;
    FormulaBuilder::add_to(terms, constant, a);
    FormulaBuilder::add_to(terms, constant, b);
    return FormulaBuilder::sum(terms, constant);
}

Formula operator*(const Formula& a, const Formula& b)
{
    Factors factors;
    mpq_class coefficient = 1;
    FormulaBuilder::multiply_to(factors, coefficient, a, 1);
    FormulaBuilder::multiply_to(factors, coefficient, b, 1);
    return FormulaBuilder::product(factors, coefficient);
}

Formula power(const Formula& base, int exponent)
{
    Factors factors;
    mpq_class coefficient = 1;
    FormulaBuilder::multiply_to(factors, coefficient, base, exponent);
    return FormulaBuilder::product(factors, coefficient);
}

Formula call(const std::string& function, const Formula& argument)
{
    FormulaNode node;
    node.kind = FormulaKind::call;
    node.name = function;
    node.argument.push_back(argument);
    return FormulaBuilder::make(std::move(node));
}

namespace {

/// f'(u)
Formula outer_derivative(const std::string& f, const Formula& u)
{
    if (f == "sin") return call("cos", u);
    if (f == "cos") return -call("sin", u);
    if (f == "tan") return Formula(1) + power(call("tan", u), 2);
    if (f == "exp") return call("exp", u);
    if (f == "log") return power(u, -1);
    if (f == "sqrt") return mpq_class(1, 2) * power(call("sqrt", u), -1);
    if (f == "abs") return call("abs", u) / u;
    if (f == "sinh") return call("cosh", u);
    if (f == "cosh") return call("sinh", u);
    if (f == "tanh") return Formula(1) - power(call("tanh", u), 2);
    if (f == "atan") return power(Formula(1) + power(u, 2), -1);
    throw std::logic_error("no derivative of " + f);
}

} // namespace

Formula derivative(const Formula& formula, const std::string& variable)
{
    const FormulaNode& node = formula.node();
    Formula result;
    switch (node.kind) {
    case FormulaKind::number: break;
    case FormulaKind::variable: return node.name == variable ? 1 : 0;
    case FormulaKind::sum:
        for (const auto& [coefficient, term] : node.terms)
            result = result + Formula(coefficient) * derivative(term, variable);
        break;
    case FormulaKind::product:
        for (const auto& [base, exponent] : node.factors) {
            const Formula inner = derivative(base, variable);
            if (!inner.is_zero()) result = result + Formula(exponent) * formula * inner / base;
        }
        break;
    case FormulaKind::call: {
        const Formula inner = derivative(node.argument.front(), variable);
        if (!inner.is_zero()) result = outer_derivative(node.name, node.argument.front()) * inner;
        break;
    }
    }
    return result;
}

Formula substitute(const Formula& formula, const std::map<std::string, Formula>& values)
{
    const FormulaNode& node = formula.node();
    switch (node.kind) {
    case FormulaKind::number: return formula;
    case FormulaKind::variable: {
        const auto found = values.find(node.name);
        return found == values.end() ? formula : found->second;
    }
    case FormulaKind::call: return call(node.name, substitute(node.argument.front(), values));
    case FormulaKind::sum: {
        Formula result(node.number);
        for (const auto& [coefficient, term] : node.terms)
            result = result + Formula(coefficient) * substitute(term, values);
        return result;
    }
    case FormulaKind::product: {
        Formula result(node.number);
        for (const auto& [base, exponent] : node.factors) result = result * power(substitute(base, values), exponent);
        return result;
    }
    }
    return formula;
}

} // namespace lagen::laws
