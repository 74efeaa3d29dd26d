// SPDX-License-Identifier: GPL-2.0-or-later
/// Arithmetic of Laurent polynomials over atoms.
#include "graph/simplify/polynomial.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <optional>

namespace lagen {
namespace {

/// Terms that one form may make: about 50 MB, a second.
constexpr int largest_exponent = 4096;
constexpr std::size_t largest_bits = 4096;

int compare(const Term& a, const Term& b)
{
    if (a.monomial != b.monomial) return a.monomial < b.monomial ? -1 : 1;
    return cmp(a.coefficient, b.coefficient);
}

int compare(const Polynomial& a, const Polynomial& b)
{
    for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k)
        if (const int order = compare(a[k], b[k]); order != 0) return order;
    return a.size() == b.size() ? 0 : a.size() < b.size() ? -1 : 1;
}

Monomial product(const Monomial& a, const Monomial& b)
{
    Monomial result;
    result.reserve(a.size() + b.size());
    auto i = a.begin();
    auto j = b.begin();
    while (i != a.end() || j != b.end()) {
        if (j == b.end() || (i != a.end() && i->atom < j->atom))
            result.push_back(*i++);
        else if (i == a.end() || j->atom < i->atom)
            result.push_back(*j++);
        else {
            const int exponent = i->exponent + j->exponent;
            if (std::abs(exponent) > largest_exponent) throw FormRefused{};
            if (exponent != 0) result.push_back({i->atom, exponent});
            ++i;
            ++j;
        }
    }
    return result;
}

/// The monomial that divides every term and leaves no negative exponents that all terms share.
Monomial common_monomial(const Polynomial& a)
{
    Monomial common = a.front().monomial;
    for (const Term& term : a) {
        Monomial kept;
        auto j = term.monomial.begin();
        for (const Factor& factor : common) {
            while (j != term.monomial.end() && j->atom < factor.atom) ++j;
            if (j == term.monomial.end() || j->atom != factor.atom) continue;
            if ((j->exponent > 0) != (factor.exponent > 0)) continue;
            const int magnitude = std::min(std::abs(j->exponent), std::abs(factor.exponent));
            kept.push_back({factor.atom, factor.exponent > 0 ? magnitude : -magnitude});
        }
        common = std::move(kept);
    }
    return common;
}

Monomial inverse(Monomial monomial)
{
    for (Factor& factor : monomial) factor.exponent = -factor.exponent;
    return monomial;
}

Rational rational_content(const Polynomial& a)
{
    mpz_class numerator = 0;
    mpz_class denominator = 1;
    for (const Term& term : a) {
        numerator = gcd(numerator, term.coefficient.get_num());
        denominator = lcm(denominator, term.coefficient.get_den());
    }
    const Rational content(numerator, denominator);
    return sgn(a.front().coefficient) < 0 ? Rational(-content) : content;
}

Rational rational_power(const Rational& value, int n)
{
    const auto magnitude = static_cast<unsigned long>(std::abs(n));
    const std::size_t bits = bits_of(value);
    if (value == 1) return value;
    if (bits * magnitude > largest_bits) throw FormRefused{};
    Rational result;
    mpz_pow_ui(result.get_num_mpz_t(), value.get_num_mpz_t(), magnitude);
    mpz_pow_ui(result.get_den_mpz_t(), value.get_den_mpz_t(), magnitude);
    return n < 0 ? Rational(1 / result) : result;
}

int exponent_of(const Monomial& monomial, AtomId atom)
{
    const auto found = std::ranges::lower_bound(monomial, atom, {}, &Factor::atom);
    return found == monomial.end() || found->atom != atom ? 0 : found->exponent;
}

void sort_terms(Polynomial& a)
{
    std::ranges::sort(a, [](const Term& x, const Term& y) { return x.monomial < y.monomial; });
}

} // namespace

bool less(const Polynomial& a, const Polynomial& b)
{
    return compare(a, b) < 0;
}

bool Algebra::KeyLess::operator()(const Atom& a, const Atom& b) const
{
    if (a.op != b.op) return a.op < b.op;
    if (a.payload != b.payload) return a.payload < b.payload;
    if (a.operands.size() != b.operands.size()) return a.operands.size() < b.operands.size();
    for (std::size_t k = 0; k < a.operands.size(); ++k)
        if (const int order = compare(a.operands[k], b.operands[k]); order != 0) return order < 0;
    return false;
}

AtomId Algebra::atom(Op op, std::uint32_t payload, std::vector<Polynomial> operands)
{
    for (const Polynomial& operand : operands) spend(operand.size());
    Atom key{op, payload, std::move(operands)};
    const auto [it, inserted] = ids_.try_emplace(key, static_cast<AtomId>(atoms_.size()));
    const AtomId id = it->second;
    if (inserted) {
        atoms_.push_back(std::move(key));
        if (op == Op::sqrt || op == Op::abs) learn_root(id);
    }
    return id;
}

void Algebra::spend(std::size_t terms)
{
    work_ += terms;
    if (work_ > most_work_) throw FormRefused{};
}

void Algebra::learn_root(AtomId root)
{
    const Polynomial argument = atoms_[root].operands[0];
    if (argument.empty()) return;
    const Term square = as_term(argument);
    if (square.monomial.size() == 1 && square.monomial[0].exponent == 1)
        roots_.push_back({square.monomial[0].atom, root, square.coefficient, atoms_[root].op == Op::abs});
}

void Algebra::normalise_root(Term& term, const Root& root) const
{
    const int s = exponent_of(term.monomial, root.root);
    const int q = exponent_of(term.monomial, root.base);
    if (s == 0) return;
    const int base_degree = root.absolute ? 2 : 1; // of w^2
    const int degree = 2 * q + base_degree * s;
    const int new_s = !root.absolute ? degree % 2 : s % 2 == 0 ? 0 : degree > 0 ? 1 : -1;
    const int squares = (s - new_s) / 2; // of w that turn into powers of base
    const int new_q = q + base_degree * squares;
    if (new_q == q && new_s == s) return;
    term.coefficient *= rational_power(root.coefficient, base_degree * squares);
    std::erase_if(term.monomial, [&](const Factor& f) { return f.atom == root.root || f.atom == root.base; });
    if (new_q != 0) term.monomial.push_back({root.base, new_q});
    if (new_s != 0) term.monomial.push_back({root.root, new_s});
    std::ranges::sort(term.monomial);
}

void Algebra::normalise_roots(Term& term) const
{
    for (const Root& root : roots_) normalise_root(term, root);
}

Polynomial Algebra::add(const Polynomial& a, const Polynomial& b)
{
    Polynomial result;
    result.reserve(a.size() + b.size());
    auto i = a.begin();
    auto j = b.begin();
    while (i != a.end() || j != b.end()) {
        if (j == b.end() || (i != a.end() && i->monomial < j->monomial))
            result.push_back(*i++);
        else if (i == a.end() || j->monomial < i->monomial)
            result.push_back(*j++);
        else {
            const Rational sum = i->coefficient + j->coefficient;
            if (sum != 0) result.push_back({sum, i->monomial});
            ++i;
            ++j;
        }
    }
    spend(result.size());
    return result;
}

Polynomial Algebra::scaled(Polynomial a, const Rational& factor)
{
    if (factor == 0) return {};
    spend(a.size());
    for (Term& term : a) term.coefficient *= factor;
    return a;
}

Term Algebra::multiply(const Term& a, const Term& b)
{
    Term result{a.coefficient * b.coefficient, product(a.monomial, b.monomial)};
    if (mpz_sizeinbase(result.coefficient.get_num_mpz_t(), 2) > largest_bits ||
        mpz_sizeinbase(result.coefficient.get_den_mpz_t(), 2) > largest_bits)
        throw FormRefused{};
    normalise_roots(result);
    spend(1);
    return result;
}

Polynomial Algebra::distribute(const Polynomial& a, const Polynomial& b)
{
    Polynomial products;
    for (const Term& x : a)
        for (const Term& y : b) products.push_back(multiply(x, y));
    sort_terms(products);
    Polynomial result;
    for (Term& term : products) {
        if (result.empty() || result.back().monomial != term.monomial)
            result.push_back(std::move(term));
        else
            result.back().coefficient += term.coefficient;
        if (result.back().coefficient == 0) result.pop_back();
    }
    return result;
}

Term Algebra::extract_content(Polynomial& a) const
{
    Term content{rational_content(a), common_monomial(a)};
    const Monomial divisor = inverse(content.monomial);
    for (Term& term : a) {
        term.coefficient /= content.coefficient;
        if (!divisor.empty()) term.monomial = product(term.monomial, divisor);
    }
    if (!divisor.empty()) sort_terms(a);
    if (sgn(a.front().coefficient) < 0) {
        for (Term& term : a) term.coefficient = -term.coefficient;
        content.coefficient = -content.coefficient;
    }
    return content;
}

Term Algebra::as_term(const Polynomial& a)
{
    if (a.empty()) throw FormRefused{};
    if (a.size() == 1) return a.front();
    Polynomial primitive = a;
    const Term content = extract_content(primitive);
    return multiply(content, {1, {{atom(Op::add, 0, {std::move(primitive)}), 1}}});
}

Term Algebra::power(const Term& term, int n)
{
    Term result{rational_power(term.coefficient, n), term.monomial};
    for (Factor& factor : result.monomial) {
        if (std::abs(std::int64_t{factor.exponent} * n) > largest_exponent) throw FormRefused{};
        factor.exponent *= n;
    }
    normalise_roots(result);
    return result;
}

// sin^2 + cos^2 = 1 in sums of which both terms are there: rows of kinetic energies in angles are full of them.
namespace {

/// monomial / atom^2.
Monomial without_square(const Monomial& monomial, AtomId atom)
{
    Monomial result;
    for (Factor factor : monomial) {
        if (factor.atom == atom) factor.exponent -= 2;
        if (factor.exponent != 0) result.push_back(factor);
    }
    return result;
}

/// A square of a sine or cosine in a term, as the argument and what is left of the monomial.
struct Square {
    AtomId atom;
    Monomial rest;
};

std::vector<Square> squares(const Algebra& algebra, const Monomial& monomial, Op op)
{
    std::vector<Square> result;
    for (const Factor& factor : monomial)
        if (algebra[factor.atom].op == op && factor.exponent >= 2)
            result.push_back({factor.atom, without_square(monomial, factor.atom)});
    return result;
}

bool same_argument(const Algebra& algebra, AtomId a, AtomId b)
{
    const Polynomial& x = algebra[a].operands[0];
    const Polynomial& y = algebra[b].operands[0];
    return !less(x, y) && !less(y, x);
}

struct Contraction {
    std::size_t sine;
    std::size_t cosine;
    Monomial rest;
};

std::optional<Contraction> find_contraction(const Algebra& algebra, const Polynomial& a)
{
    std::multimap<Monomial, std::pair<std::size_t, AtomId>> cosines;
    for (std::size_t k = 0; k < a.size(); ++k)
        for (const Square& square : squares(algebra, a[k].monomial, Op::cos))
            cosines.emplace(square.rest, std::pair{k, square.atom});
    if (cosines.empty()) return std::nullopt;
    for (std::size_t k = 0; k < a.size(); ++k)
        for (const Square& square : squares(algebra, a[k].monomial, Op::sin))
            for (auto [it, end] = cosines.equal_range(square.rest); it != end; ++it)
                if (it->second.first != k && a[it->second.first].coefficient == a[k].coefficient &&
                    same_argument(algebra, square.atom, it->second.second))
                    return Contraction{k, it->second.first, square.rest};
    return std::nullopt;
}

} // namespace

Polynomial Algebra::contract_circles(Polynomial a)
{
    while (const auto found = find_contraction(*this, a)) {
        Polynomial rest;
        for (std::size_t k = 0; k < a.size(); ++k)
            if (k != found->sine && k != found->cosine) rest.push_back(a[k]);
        a = add(rest, {{a[found->sine].coefficient, found->rest}});
    }
    return a;
}

} // namespace lagen
