// SPDX-License-Identifier: GPL-2.0-or-later
/// Generators and reduction modulo their relations.
#include "proof/ring.hpp"

namespace lagen::proof {

GeneratorId Ring::add_generator(Generator generator)
{
    if (generators_.size() >= 0xffffU) throw BudgetExhausted("more than 65535 generators");
    generators_.push_back(std::move(generator));
    return static_cast<GeneratorId>(generators_.size() - 1);
}

void Ring::restrict_range(GeneratorId id, const Range& range)
{
    generators_[id].range = intersect(generators_[id].range, range);
}

void Ring::set_relation(GeneratorId id, unsigned power, Polynomial relation)
{
    generators_[id].power = power;
    generators_[id].relation = std::move(relation);
}

const Polynomial& Ring::relation_power(GeneratorId id, unsigned exponent)
{
    const auto key = std::pair(id, exponent);
    if (const auto at = relation_powers_.find(key); at != relation_powers_.end()) return at->second;
    const Polynomial relation = generators_[id].relation;
    Polynomial value = exponent == 1 ? reduce(relation) : power(relation, exponent);
    return relation_powers_.emplace(key, std::move(value)).first->second;
}

Polynomial Ring::reduce(const Polynomial& p)
{
    const auto reducible = [this](const Monomial& m) {
        for (std::size_t k = m.size(); k-- > 0;) {
            const unsigned power = generators_[m.generator(k)].power;
            if (power > 0 && m.exponent(k) >= power) return true;
        }
        return false;
    };
    Polynomial done, todo;
    for (const Term& term : p) (reducible(term.monomial) ? todo : done).push_back(term);
    // Terms with the same powers to replace are gathered, so that each power is multiplied in once.
    while (!todo.empty()) {
        std::map<Monomial, Polynomial, Before> groups; ///< by the powers that are replaced
        for (const Term& term : todo) {
            Monomial rest, replaced;
            for (std::size_t k = 0; k < term.monomial.size(); ++k) {
                const GeneratorId id = term.monomial.generator(k);
                const unsigned power = generators_[id].power, exponent = term.monomial.exponent(k);
                const unsigned quotient = power == 0 ? 0 : exponent / power;
                if (quotient > 0) replaced = replaced * Monomial(id, quotient);
                rest = rest * Monomial(id, exponent - quotient * power);
            }
            groups[replaced].push_back({rest, term.coefficient});
        }
        todo.clear();
        for (auto& [powers, group] : groups) {
            Polynomial product = collect(std::move(group), work_);
            for (std::size_t k = 0; k < powers.size(); ++k)
                product = multiply(product, relation_power(powers.generator(k), powers.exponent(k)), work_);
            Polynomial ready, again;
            for (Term& term : product) (reducible(term.monomial) ? again : ready).push_back(std::move(term));
            done = add_scaled(done, ready, 1, work_);
            todo = add_scaled(todo, again, 1, work_);
        }
    }
    return done;
}

Polynomial Ring::power(const Polynomial& p, unsigned exponent)
{
    Polynomial result = constant_polynomial(1), square = p;
    for (unsigned rest = exponent; rest > 0; rest >>= 1) {
        if (rest & 1U) result = times(result, square);
        if (rest > 1) square = times(square, square);
    }
    return result;
}

} // namespace lagen::proof
