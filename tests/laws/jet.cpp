// SPDX-License-Identifier: GPL-2.0-or-later
/// Ball arithmetic on values and slopes.
#include "jet.hpp"

#include <stdexcept>

namespace lagen::laws {

Ball::Ball(const mpq_class& value) : Ball()
{
    fmpq_t exact;
    fmpq_init(exact);
    fmpq_set_mpq(exact, value.get_mpq_t());
    arb_set_fmpq(ball_, exact, ball_precision);
    fmpq_clear(exact);
}

double Ball::middle() const
{
    return arf_get_d(arb_midref(ball_), ARF_RND_NEAR);
}

double Ball::bound() const
{
    mag_t bound;
    mag_init(bound);
    arb_get_mag(bound, ball_);
    const double result = mag_get_d(bound);
    mag_clear(bound);
    return result;
}

Ball operator+(const Ball& a, const Ball& b)
{
    Ball result;
    arb_add(result.ball_, a.ball_, b.ball_, ball_precision);
    return result;
}

Ball operator-(const Ball& a, const Ball& b)
{
    Ball result;
    arb_sub(result.ball_, a.ball_, b.ball_, ball_precision);
    return result;
}

Ball operator*(const Ball& a, const Ball& b)
{
    Ball result;
    arb_mul(result.ball_, a.ball_, b.ball_, ball_precision);
    return result;
}

Ball operator/(const Ball& a, const Ball& b)
{
    Ball result;
    arb_div(result.ball_, a.ball_, b.ball_, ball_precision);
    return result;
}

const Jet& JetEvaluation::operator()(const Formula& formula)
{
    const auto found = known_.find(formula.text());
    if (found != known_.end()) return found->second;
    Jet jet = evaluate(formula);
    return known_.emplace(formula.text(), std::move(jet)).first->second;
}

Jet JetEvaluation::constant(Ball value) const
{
    return {std::move(value), std::vector<Ball>(directions_.size())};
}

Jet JetEvaluation::product(const Jet& a, const Jet& b) const
{
    Jet result{a.value * b.value, {}};
    for (std::size_t k = 0; k < directions_.size(); ++k)
        result.slope.push_back(a.slope[k] * b.value + a.value * b.slope[k]);
    return result;
}

Jet JetEvaluation::chain(Ball value, const Ball& outer, const Jet& inner) const
{
    Jet result{std::move(value), {}};
    for (const Ball& slope : inner.slope) result.slope.push_back(outer * slope);
    return result;
}

Jet JetEvaluation::apply(const std::string& function, const Jet& inner) const
{
    using Operation = void (*)(arb_t, const arb_t, slong);
    static const std::map<std::string, Operation> operations{
        {"sin", arb_sin},   {"cos", arb_cos},   {"tan", arb_tan},   {"exp", arb_exp},   {"log", arb_log},
        {"sqrt", arb_sqrt}, {"sinh", arb_sinh}, {"cosh", arb_cosh}, {"tanh", arb_tanh}, {"atan", arb_atan}};
    const auto value_of = [&](const std::string& name) {
        Ball result;
        operations.at(name)(result.get(), inner.value.get(), ball_precision);
        return result;
    };
    const Ball one(mpq_class(1)), &u = inner.value;
    if (function == "abs") {
        const Ball sign(mpq_class(u.is_positive() ? 1 : -1));
        return chain(sign * u, u.excludes_zero() ? sign : one / Ball(), inner);
    }
    const Ball value = value_of(function);
    if (function == "sin") return chain(value, value_of("cos"), inner);
    if (function == "cos") return chain(value, Ball() - value_of("sin"), inner);
    if (function == "tan") return chain(value, one + value * value, inner);
    if (function == "exp") return chain(value, value, inner);
    if (function == "log") return chain(value, one / u, inner);
    if (function == "sqrt") return chain(value, one / (value + value), inner);
    if (function == "sinh") return chain(value, value_of("cosh"), inner);
    if (function == "cosh") return chain(value, value_of("sinh"), inner);
    if (function == "tanh") return chain(value, one - value * value, inner);
    return chain(value, one / (one + u * u), inner);
}

Jet JetEvaluation::evaluate(const Formula& formula)
{
    const FormulaNode& node = formula.node();
    switch (node.kind) {
    case FormulaKind::number: return constant(Ball(node.number));
    case FormulaKind::variable: {
        Jet result = constant(point_.at(node.name));
        for (std::size_t k = 0; k < directions_.size(); ++k)
            if (directions_[k] == node.name) result.slope[k] = Ball(mpq_class(1));
        return result;
    }
    case FormulaKind::call: return apply(node.name, (*this)(node.argument.front()));
    case FormulaKind::sum: {
        Jet result = constant(Ball(node.number));
        for (const auto& [coefficient, term] : node.terms) {
            const Jet scaled = product(constant(Ball(coefficient)), (*this)(term));
            result.value = result.value + scaled.value;
            for (std::size_t k = 0; k < directions_.size(); ++k) result.slope[k] = result.slope[k] + scaled.slope[k];
        }
        return result;
    }
    case FormulaKind::product: {
        Jet result = constant(Ball(node.number));
        for (const auto& [base, exponent] : node.factors) {
            const Jet& jet = (*this)(base);
            const Ball one(mpq_class(1)), inverse = one / jet.value;
            // base^exponent by repeated products; 1/u has slope -u'/u^2.
            const Jet step = exponent > 0 ? jet : chain(inverse, Ball() - inverse * inverse, jet);
            for (int k = 0; k < std::abs(exponent); ++k) result = product(result, step);
        }
        return result;
    }
    }
    throw std::logic_error("a formula of no kind");
}

} // namespace lagen::laws
