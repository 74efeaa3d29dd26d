// SPDX-License-Identifier: GPL-2.0-or-later
/// Exact rational evaluation, as far as every operation is rational at the point.
#include "expression/evaluate_stumpff.hpp"
#include "proof/enclosure.hpp"

namespace lagen::proof {

namespace {

constexpr std::size_t longest_number = 20'000; ///< bits

bool exact_power(const Rational& base, std::int32_t exponent, Rational& result)
{
    const auto magnitude = static_cast<unsigned long>(std::abs(static_cast<long>(exponent)));
    if (exponent < 0 && sgn(base) == 0) return false;
    if (bits_of(base) * magnitude > 4 * longest_number) return false;
    mpz_class above, below;
    mpz_pow_ui(above.get_mpz_t(), base.get_num_mpz_t(), magnitude);
    mpz_pow_ui(below.get_mpz_t(), base.get_den_mpz_t(), magnitude);
    result = exponent < 0 ? Rational(below, above) : Rational(above, below);
    result.canonicalize();
    return true;
}

bool exact_root(const Rational& a, Rational& result)
{
    if (sgn(a) < 0 || !mpz_perfect_square_p(a.get_num_mpz_t()) || !mpz_perfect_square_p(a.get_den_mpz_t()))
        return false;
    result = Rational(sqrt(a.get_num()), sqrt(a.get_den()));
    return true;
}

bool compare(Op op, const Rational& a, const Rational& b)
{
    switch (op) {
    case Op::less: return a < b;
    case Op::less_equal: return a <= b;
    case Op::greater: return a > b;
    case Op::greater_equal: return a >= b;
    case Op::equal: return a == b;
    default: return a != b;
    }
}

} // namespace

std::optional<std::vector<Rational>> Evaluation::exactly(const ExactInputs& inputs) const
{
    std::vector<Rational> values(order_.size());
    for (std::size_t k = 0; k < order_.size(); ++k) {
        const NodeId node = order_[k];
        if (graph_.op(node) == Op::input) {
            const auto at = inputs.find(node);
            if (at == inputs.end()) return std::nullopt;
            values[k] = at->second;
        } else if (!exact_node(node, values, values[k]) || bits_of(values[k]) > longest_number) {
            return std::nullopt;
        }
    }
    std::vector<Rational> results;
    for (const NodeId root : roots_) results.push_back(values[slots_.at(root)]);
    return results;
}

bool Evaluation::exact_node(NodeId node, const std::vector<Rational>& values, Rational& result) const
{
    const Op op = graph_.op(node);
    if (op == Op::constant) {
        result = graph_.value(node);
        return true;
    }
    if (op == Op::pi || op == Op::factor || op == Op::solve || op == Op::component) return false;
    const Rational& a = operand(node, 0, values);
    switch (op) {
    case Op::negate: result = -a; return true;
    case Op::power: return exact_power(a, static_cast<std::int32_t>(graph_.payload(node)), result);
    case Op::sqrt: return exact_root(a, result);
    case Op::abs: result = abs(a); return true;
    case Op::sign: result = sgn(a); return true;
    case Op::stumpff: result = stumpff_at_zero(graph_.payload(node)); return sgn(a) == 0;
    default: break;
    }
    if (graph_.operands(node).size() == 1 || op == Op::real_power || op == Op::atan2) return false;
    const Rational& b = operand(node, 1, values);
    switch (op) {
    case Op::add: result = a + b; break;
    case Op::subtract: result = a - b; break;
    case Op::multiply: result = a * b; break;
    case Op::divide:
        if (sgn(b) == 0) return false;
        result = a / b;
        break;
    case Op::minimum: result = a < b ? a : b; break;
    case Op::maximum: result = a < b ? b : a; break;
    case Op::select: result = sgn(a) != 0 ? b : operand(node, 2, values); break;
    default: result = compare(op, a, b) ? 1 : 0; break;
    }
    return true;
}

} // namespace lagen::proof
