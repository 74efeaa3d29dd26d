// SPDX-License-Identifier: GPL-2.0-or-later
/// f(k) = f2 k^2 + f1 k + f0 from f(0), f(1), f(-1).
#include "advice/solve_entry.hpp"

namespace lagen {
namespace {

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

} // namespace

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

} // namespace lagen
