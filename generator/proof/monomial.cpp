// SPDX-License-Identifier: GPL-2.0-or-later
/// Power products: exponent arithmetic with overflow checks, and their order.
#include "proof/polynomial.hpp"

namespace lagen::proof {

Monomial::Monomial(GeneratorId generator, unsigned exponent)
{
    append(generator, exponent);
}

Monomial::Monomial(const std::vector<GeneratorId>& generators, const std::vector<unsigned long>& exponents)
{
    for (std::size_t k = 0; k < generators.size(); ++k) append(generators[k], static_cast<unsigned>(exponents[k]));
}

void Monomial::append(GeneratorId generator, unsigned exponent)
{
    if (exponent > 0xffffU) throw BudgetExhausted("an exponent exceeds 65535");
    if (exponent > 0) factors_.push_back(static_cast<std::uint32_t>(generator) << 16 | exponent);
}

unsigned Monomial::exponent_of(GeneratorId generator) const
{
    for (std::size_t k = 0; k < size(); ++k)
        if (this->generator(k) == generator) return exponent(k);
    return 0;
}

Monomial operator*(const Monomial& a, const Monomial& b)
{
    Monomial product;
    std::size_t i = 0, j = 0;
    while (i < a.size() || j < b.size()) {
        if (j == b.size() || (i < a.size() && a.generator(i) < b.generator(j))) {
            product.factors_.push_back(a.factors_[i++]);
        } else if (i == a.size() || b.generator(j) < a.generator(i)) {
            product.factors_.push_back(b.factors_[j++]);
        } else {
            product.append(a.generator(i), a.exponent(i) + b.exponent(j));
            ++i, ++j;
        }
    }
    return product;
}

bool Monomial::divide(const Monomial& a, const Monomial& b, Monomial& quotient)
{
    quotient.factors_.clear();
    std::size_t j = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (j < b.size() && b.generator(j) < a.generator(i)) return false;
        if (j < b.size() && b.generator(j) == a.generator(i)) {
            if (b.exponent(j) > a.exponent(i)) return false;
            quotient.append(a.generator(i), a.exponent(i) - b.exponent(j));
            ++j;
        } else {
            quotient.factors_.push_back(a.factors_[i]);
        }
    }
    return j == b.size();
}

Monomial Monomial::common(const Monomial& a, const Monomial& b)
{
    Monomial result;
    for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
        if (a.generator(i) < b.generator(j)) {
            ++i;
        } else if (b.generator(j) < a.generator(i)) {
            ++j;
        } else {
            result.append(a.generator(i), std::min(a.exponent(i), b.exponent(j)));
            ++i, ++j;
        }
    }
    return result;
}

Monomial Monomial::without(GeneratorId generator) const
{
    Monomial result;
    for (std::size_t k = 0; k < size(); ++k)
        if (this->generator(k) != generator) result.factors_.push_back(factors_[k]);
    return result;
}

bool before(const Monomial& a, const Monomial& b)
{
    const std::size_t shared = std::min(a.size(), b.size());
    for (std::size_t k = 0; k < shared; ++k) {
        if (a.factors_[k] == b.factors_[k]) continue;
        if (a.generator(k) != b.generator(k)) return a.generator(k) < b.generator(k);
        return a.exponent(k) > b.exponent(k);
    }
    return a.size() > b.size();
}

} // namespace lagen::proof
