// SPDX-License-Identifier: GPL-2.0-or-later
/// Formulas with which the tests build random algebroids: sums and products that collect equal terms and never expand.
/// They share no code with the generator: the text is all that passes over.
#pragma once

#include <gmpxx.h>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace lagen::laws {

struct FormulaNode;

/// A value of (rational numbers, variables, + * and integer powers, functions of one argument). Cheap to copy.
class Formula {
  public:
    Formula() : Formula(mpq_class(0)) {}
    Formula(int value) : Formula(mpq_class(value)) {}
    Formula(const mpq_class& value);
    static Formula variable(const std::string& name);

    /// In the expression language; equal texts are the same formula.
    [[nodiscard]] const std::string& text() const;
    [[nodiscard]] bool is_zero() const;
    [[nodiscard]] const FormulaNode& node() const { return *node_; }

    friend Formula operator+(const Formula& a, const Formula& b);
    friend Formula operator*(const Formula& a, const Formula& b);
    friend Formula call(const std::string& function, const Formula& argument);
    friend Formula power(const Formula& base, int exponent);

  private:
    friend struct FormulaBuilder;
    explicit Formula(std::shared_ptr<const FormulaNode> node) : node_(std::move(node)) {}
    std::shared_ptr<const FormulaNode> node_;
};

enum class FormulaKind { number, variable, sum, product, call };

struct FormulaNode {
    FormulaKind kind = FormulaKind::number;
    mpq_class number;                                 ///< the number; constant of a sum; coefficient of a product
    std::string name;                                 ///< of a variable or function
    std::vector<std::pair<mpq_class, Formula>> terms; ///< of a sum: coefficient, term
    std::vector<std::pair<Formula, int>> factors;     ///< of a product: base, exponent
    std::vector<Formula> argument;                    ///< of a call: one
    std::string text;
};

/// `function` is one of sin cos tan exp log sqrt abs sinh cosh tanh atan.
[[nodiscard]] Formula call(const std::string& function, const Formula& argument);
/// Division by the number 0 is a std::logic_error.
[[nodiscard]] Formula power(const Formula& base, int exponent);

inline Formula operator-(const Formula& a)
{
    return Formula(-1) * a;
}
inline Formula operator-(const Formula& a, const Formula& b)
{
    return a + -b;
}
inline Formula operator/(const Formula& a, const Formula& b)
{
    return a * power(b, -1);
}

/// d formula / d variable
[[nodiscard]] Formula derivative(const Formula& formula, const std::string& variable);

/// Every variable that `values` names is replaced, all at once.
[[nodiscard]] Formula substitute(const Formula& formula, const std::map<std::string, Formula>& values);

} // namespace lagen::laws
