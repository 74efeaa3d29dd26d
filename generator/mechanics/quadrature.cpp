// SPDX-License-Identifier: GPL-2.0-or-later
#include "mechanics/quadrature.hpp"

namespace lagen {

namespace {

/// sqrt(value) to 200 bits, from below.
Rational root(const Rational& value)
{
    constexpr unsigned bits = 200;
    mpz_class scale;
    mpz_ui_pow_ui(scale.get_mpz_t(), 2, bits);
    const mpz_class square = value.get_num() * scale * scale / value.get_den();
    mpz_class whole;
    mpz_sqrt(whole.get_mpz_t(), square.get_mpz_t());
    Rational result(whole, scale);
    result.canonicalize();
    return result;
}

Rational ratio(long a, long b)
{
    Rational value(a, b);
    value.canonicalize();
    return value;
}

/// 1/2 -+ d with the weight b each, for each pair (d, b), and the middle with its weight where that is not 0.
QuadratureRule symmetric_rule(const std::vector<std::pair<Rational, Rational>>& pairs, const Rational& middle,
                              std::size_t degree)
{
    const Rational half = ratio(1, 2);
    QuadratureRule rule{{}, {}, degree};
    const auto add = [&](const Rational& node, const Rational& weight) {
        rule.nodes.push_back(node);
        rule.weights.push_back(weight);
    };
    for (const auto& [distance, weight] : pairs) add(half - distance, weight);
    if (middle != 0) add(half, middle);
    for (auto pair = pairs.rbegin(); pair != pairs.rend(); ++pair) add(half + pair->first, pair->second);
    return rule;
}

QuadratureRule gauss_rule(std::size_t stages)
{
    const Rational half = ratio(1, 2);
    switch (stages) {
    case 1: return symmetric_rule({}, 1, 1);
    case 2: return symmetric_rule({{root(3) / 6, half}}, 0, 2);
    case 3: return symmetric_rule({{root(15) / 10, ratio(5, 18)}}, ratio(4, 9), 3);
    case 4: {
        const Rational inner = ratio(2, 7) * root(ratio(6, 5)), weight = root(30) / 72;
        return symmetric_rule({{root(ratio(3, 7) + inner) / 2, ratio(1, 4) - weight},
                               {root(ratio(3, 7) - inner) / 2, ratio(1, 4) + weight}},
                              0, 4);
    }
    default: throw InternalError("there is no such rule of Gauss");
    }
}

QuadratureRule lobatto_rule(std::size_t stages)
{
    const Rational half = ratio(1, 2);
    switch (stages) {
    case 2: return symmetric_rule({{half, half}}, 0, 1);
    case 3: return symmetric_rule({{half, ratio(1, 6)}}, ratio(2, 3), 2);
    case 4: return symmetric_rule({{half, ratio(1, 12)}, {root(5) / 10, ratio(5, 12)}}, 0, 3);
    case 5: return symmetric_rule({{half, ratio(1, 20)}, {root(21) / 14, ratio(49, 180)}}, ratio(16, 45), 4);
    default: throw InternalError("there is no such rule of Lobatto");
    }
}

} // namespace

QuadratureRule quadrature_rule(const std::string& scheme)
{
    if (scheme == "midpoint") return gauss_rule(1);
    if (scheme == "trapezoidal") return lobatto_rule(2);
    if (scheme == "left") return {{0}, {1}, 1};
    const std::size_t colon = scheme.find(':');
    if (colon == std::string::npos) throw InternalError("there is no scheme called " + scheme);
    const auto stages = static_cast<std::size_t>(std::stoul(scheme.substr(colon + 1)));
    return scheme.starts_with("gauss") ? gauss_rule(stages) : lobatto_rule(stages);
}

InnerPolynomials::InnerPolynomials(std::size_t degree)
{
    for (std::size_t k = 0; k <= degree; ++k) points_.push_back(ratio(static_cast<long>(k), static_cast<long>(degree)));
}

Rational InnerPolynomials::value(std::size_t k, const Rational& c) const
{
    Rational product = 1;
    for (std::size_t j = 0; j < points_.size(); ++j)
        if (j != k) product *= (c - points_[j]) / (points_[k] - points_[j]);
    return product;
}

Rational InnerPolynomials::slope(std::size_t k, const Rational& c) const
{
    Rational sum = 0;
    for (std::size_t left_out = 0; left_out < points_.size(); ++left_out) {
        if (left_out == k) continue;
        Rational product = 1 / Rational(points_[k] - points_[left_out]);
        for (std::size_t j = 0; j < points_.size(); ++j)
            if (j != k && j != left_out) product *= (c - points_[j]) / (points_[k] - points_[j]);
        sum += product;
    }
    return sum;
}

} // namespace lagen
