// SPDX-License-Identifier: GPL-2.0-or-later
/// Sums and multiples of sparse integer polynomials; every product is paid for out of `Work`.
#include "proof/polynomial.hpp"

#include <flint/fmpz_mpoly.h>

#include <algorithm>
#include <map>

namespace lagen::proof {
namespace {

std::size_t limbs(const mpz_class& z)
{
    return mpz_size(z.get_mpz_t());
}

void check(const mpz_class& z)
{
    if (limbs(z) * 64 > longest_coefficient)
        throw BudgetExhausted("a coefficient exceeds " + std::to_string(longest_coefficient) + " bits");
}

void check(const Polynomial& p, const Work& work)
{
    if (p.size() > work.terms) throw BudgetExhausted("term budget of " + std::to_string(work.terms) + " exhausted");
}

} // namespace

void Work::spend(std::size_t count)
{
    if (count > products) {
        products = 0;
        throw BudgetExhausted("budget of term products exhausted");
    }
    products -= count;
}

Polynomial constant_polynomial(const mpz_class& value)
{
    check(value);
    if (value == 0) return {};
    return {Term{Monomial(), value}};
}

Polynomial generator_polynomial(GeneratorId generator, unsigned exponent)
{
    return {Term{Monomial(generator, exponent), 1}};
}

bool is_constant(const Polynomial& p)
{
    return p.empty() || (p.size() == 1 && p[0].monomial.is_one());
}

bool is_one(const Polynomial& p)
{
    return p.size() == 1 && p[0].monomial.is_one() && p[0].coefficient == 1;
}

bool equal(const Polynomial& a, const Polynomial& b)
{
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Term& s, const Term& t) {
        return s.monomial == t.monomial && s.coefficient == t.coefficient;
    });
}

Polynomial negate(Polynomial p)
{
    for (Term& term : p) mpz_neg(term.coefficient.get_mpz_t(), term.coefficient.get_mpz_t());
    return p;
}

Polynomial scale(Polynomial p, const mpz_class& factor)
{
    if (factor == 0) return {};
    if (factor == 1) return p;
    for (Term& term : p) {
        term.coefficient *= factor;
        check(term.coefficient);
    }
    return p;
}

Polynomial add_scaled(const Polynomial& p, const Polynomial& q, const mpz_class& factor, Work& work)
{
    work.spend(p.size() + q.size());
    Polynomial sum;
    sum.reserve(p.size() + q.size());
    std::size_t i = 0, j = 0;
    while (i < p.size() || j < q.size()) {
        if (j == q.size() || (i < p.size() && before(p[i].monomial, q[j].monomial))) {
            sum.push_back(p[i++]);
        } else if (i == p.size() || before(q[j].monomial, p[i].monomial)) {
            sum.push_back({q[j].monomial, q[j].coefficient * factor});
            ++j;
        } else {
            mpz_class coefficient = p[i].coefficient + q[j].coefficient * factor;
            if (coefficient != 0) sum.push_back({p[i].monomial, std::move(coefficient)});
            ++i, ++j;
        }
    }
    check(sum, work);
    return sum;
}

Polynomial multiply_term(const Polynomial& p, const Monomial& m, const mpz_class& factor, Work& work)
{
    work.spend(p.size() * (1 + limbs(factor) / 4));
    Polynomial product;
    product.reserve(p.size());
    for (const Term& term : p) {
        product.push_back({term.monomial * m, term.coefficient * factor});
        check(product.back().coefficient);
    }
    return product;
}

Polynomial collect(std::vector<Term> terms, Work& work)
{
    work.spend(terms.size());
    std::stable_sort(terms.begin(), terms.end(),
                     [](const Term& a, const Term& b) { return before(a.monomial, b.monomial); });
    Polynomial result;
    result.reserve(terms.size());
    for (Term& term : terms) {
        if (!result.empty() && result.back().monomial == term.monomial) {
            result.back().coefficient += term.coefficient;
        } else {
            if (!result.empty() && result.back().coefficient == 0) result.pop_back();
            result.push_back(std::move(term));
        }
    }
    if (!result.empty() && result.back().coefficient == 0) result.pop_back();
    check(result, work);
    return result;
}

mpz_class content(const Polynomial& p)
{
    mpz_class divisor = 0;
    for (const Term& term : p) {
        mpz_gcd(divisor.get_mpz_t(), divisor.get_mpz_t(), term.coefficient.get_mpz_t());
        if (divisor == 1) break;
    }
    return divisor;
}

Polynomial divide_content(Polynomial p, const mpz_class& divisor)
{
    if (divisor == 1) return p;
    for (Term& term : p) mpz_divexact(term.coefficient.get_mpz_t(), term.coefficient.get_mpz_t(), divisor.get_mpz_t());
    return p;
}

Monomial monomial_content(const Polynomial& p)
{
    if (p.empty()) return {};
    Monomial common = p[0].monomial;
    for (std::size_t k = 1; k < p.size() && !common.is_one(); ++k) common = Monomial::common(common, p[k].monomial);
    return common;
}

Polynomial divide_monomial(Polynomial p, const Monomial& divisor)
{
    if (divisor.is_one()) return p;
    for (Term& term : p) {
        Monomial quotient;
        if (!Monomial::divide(term.monomial, divisor, quotient)) continue;
        term.monomial = quotient;
    }
    return p;
}

std::string key_of(const Monomial& m)
{
    std::string key;
    for (std::size_t k = 0; k < m.size(); ++k)
        key += 'g' + std::to_string(m.generator(k)) + '^' + std::to_string(m.exponent(k));
    return key;
}

std::string key_of(const Polynomial& p)
{
    std::string key;
    for (const Term& term : p) {
        if (term.coefficient > 0) key += '+';
        key += term.coefficient.get_str() + key_of(term.monomial);
    }
    return key;
}

// Power products: exponent arithmetic with overflow checks, and their order.

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

// Products of polynomials: short ones term by term, long ones by FLINT, in the ring of the generators that occur. Its
// lexicographic order with the first generator greatest is ours. FLINT aborts where exponents or memory overflow: it
// is given a bounded number of term products at a time, of bounded exponents and coefficients.

namespace {

constexpr std::size_t short_product = 64;         ///< term products up to which conversion does not pay
constexpr std::size_t most_limbs = 1U << 18U;     ///< of the coefficients of one step
constexpr std::size_t most_sum_limbs = 1U << 24U; ///< of the coefficients of a product: 128 MiB
constexpr std::size_t highest_exponent = 65535;

/// The generators of two polynomials; their greatest exponents must fit in those of a product.
class Variables {
  public:
    Variables(const Polynomial& p, const Polynomial& q)
    {
        std::map<GeneratorId, std::size_t> degrees;
        for (const Polynomial* each : {&p, &q}) {
            std::map<GeneratorId, std::size_t> own;
            for (const Term& term : *each)
                for (std::size_t k = 0; k < term.monomial.size(); ++k) {
                    std::size_t& degree = own[term.monomial.generator(k)];
                    degree = std::max<std::size_t>(degree, term.monomial.exponent(k));
                }
            for (const auto& [id, degree] : own) degrees[id] += degree;
        }
        for (const auto& [id, degree] : degrees) {
            if (degree > highest_exponent) throw BudgetExhausted("an exponent exceeds 65535");
            generators_.push_back(id);
        }
        exponents_.resize(std::max<std::size_t>(generators_.size(), 1));
        fmpz_mpoly_ctx_init(context_, static_cast<slong>(exponents_.size()), ORD_LEX);
    }
    ~Variables() { fmpz_mpoly_ctx_clear(context_); }
    Variables(const Variables&) = delete;
    Variables& operator=(const Variables&) = delete;

    [[nodiscard]] const fmpz_mpoly_ctx_struct* context() const { return context_; }
    [[nodiscard]] const std::vector<GeneratorId>& generators() const { return generators_; }
    /// The exponents of a monomial, by generator.
    [[nodiscard]] const ulong* exponents(const Monomial& monomial)
    {
        std::fill(exponents_.begin(), exponents_.end(), 0);
        auto at = generators_.begin();
        for (std::size_t k = 0; k < monomial.size(); ++k) {
            at = std::lower_bound(at, generators_.end(), monomial.generator(k));
            exponents_[static_cast<std::size_t>(at - generators_.begin())] = monomial.exponent(k);
        }
        return exponents_.data();
    }

  private:
    fmpz_mpoly_ctx_t context_;
    std::vector<GeneratorId> generators_; ///< ascending
    std::vector<ulong> exponents_;
};

/// A polynomial of FLINT.
class Packed {
  public:
    explicit Packed(const Variables& variables) : context_(variables.context())
    {
        fmpz_mpoly_init(polynomial_, context_);
        fmpz_init(number_);
    }
    ~Packed()
    {
        fmpz_clear(number_);
        fmpz_mpoly_clear(polynomial_, context_);
    }
    Packed(const Packed&) = delete;
    Packed& operator=(const Packed&) = delete;

    /// Terms first .. last - 1 of p.
    void assign(Variables& variables, const Polynomial& p, std::size_t first, std::size_t last)
    {
        fmpz_mpoly_zero(polynomial_, context_);
        for (std::size_t k = first; k < last; ++k) {
            fmpz_set_mpz(number_, p[k].coefficient.get_mpz_t());
            fmpz_mpoly_push_term_fmpz_ui(polynomial_, number_, variables.exponents(p[k].monomial), context_);
        }
    }
    void set_product(const Packed& a, const Packed& b)
    {
        fmpz_mpoly_mul_johnson(polynomial_, a.polynomial_, b.polynomial_, context_);
    }
    void set_sum(const Packed& a, const Packed& b)
    {
        fmpz_mpoly_add(polynomial_, a.polynomial_, b.polynomial_, context_);
    }
    void swap(Packed& other) { fmpz_mpoly_swap(polynomial_, other.polynomial_, context_); }
    [[nodiscard]] std::size_t size() const
    {
        return static_cast<std::size_t>(fmpz_mpoly_length(polynomial_, context_));
    }
    [[nodiscard]] Polynomial terms(const Variables& variables)
    {
        Polynomial result(size());
        std::vector<ulong> exponents(std::max<std::size_t>(variables.generators().size(), 1));
        for (std::size_t k = 0; k < result.size(); ++k) {
            fmpz_mpoly_get_term_exp_ui(exponents.data(), polynomial_, static_cast<slong>(k), context_);
            fmpz_mpoly_get_term_coeff_fmpz(number_, polynomial_, static_cast<slong>(k), context_);
            fmpz_get_mpz(result[k].coefficient.get_mpz_t(), number_);
            result[k].monomial = Monomial(variables.generators(), exponents);
        }
        return result;
    }

  private:
    const fmpz_mpoly_ctx_struct* context_;
    fmpz_mpoly_t polynomial_;
    fmpz_t number_;
};

std::size_t longest_bits(const Polynomial& p)
{
    std::size_t bits = 0;
    for (const Term& term : p) bits = std::max(bits, mpz_sizeinbase(term.coefficient.get_mpz_t(), 2));
    return bits;
}

/// The product of short polynomials.
Polynomial by_terms(const Polynomial& p, const Polynomial& q, Work& work)
{
    std::vector<Term> terms;
    terms.reserve(p.size() * q.size());
    for (const Term& a : p)
        for (const Term& b : q) terms.push_back({a.monomial * b.monomial, a.coefficient * b.coefficient});
    return collect(std::move(terms), work);
}

} // namespace

Polynomial multiply(const Polynomial& p, const Polynomial& q, Work& work)
{
    if (p.empty() || q.empty()) return {};
    if (q.size() == 1) return multiply_term(p, q[0].monomial, q[0].coefficient, work);
    if (p.size() == 1) return multiply_term(q, p[0].monomial, p[0].coefficient, work);
    if (p.size() > q.size()) return multiply(q, p, work);
    // Paid in advance: a product that cannot be finished is not begun.
    work.spend(p.size() * q.size() * (1 + mpz_size(p[0].coefficient.get_mpz_t()) / 4));
    const std::size_t bits = longest_bits(p) + longest_bits(q);
    if (bits > longest_coefficient)
        throw BudgetExhausted("a coefficient exceeds " + std::to_string(longest_coefficient) + " bits");
    if (p.size() * q.size() <= short_product) return by_terms(p, q, work);
    Variables variables(p, q);
    Packed rows(variables), columns(variables), product(variables), sum(variables), next(variables);
    columns.assign(variables, q, 0, q.size());
    const std::size_t limbs = 1 + bits / 64;
    const std::size_t step = std::max<std::size_t>(1, most_limbs / (q.size() * limbs));
    for (std::size_t row = 0; row < p.size(); row += step) {
        rows.assign(variables, p, row, std::min(p.size(), row + step));
        product.set_product(rows, columns);
        next.set_sum(sum, product);
        sum.swap(next);
        // What later rows cancel is there until then: twice the budget leaves room for it.
        if (sum.size() > 2 * work.terms)
            throw BudgetExhausted("term budget of " + std::to_string(work.terms) + " exhausted");
        if (sum.size() * limbs > most_sum_limbs) throw BudgetExhausted("the coefficients of a product exceed 128 MiB");
    }
    if (sum.size() > work.terms) throw BudgetExhausted("term budget of " + std::to_string(work.terms) + " exhausted");
    return sum.terms(variables);
}

// Exact quotients and square roots of polynomials, from the leading term down.

namespace {

using Remainder = std::map<Monomial, mpz_class, Before>;

Remainder remainder_of(const Polynomial& p)
{
    Remainder remainder;
    for (const Term& term : p) remainder.emplace_hint(remainder.end(), term.monomial, term.coefficient);
    return remainder;
}

/// remainder -= factor * m * q
void subtract_multiple(Remainder& remainder, const Polynomial& q, const Monomial& m, const mpz_class& factor,
                       Work& work)
{
    work.spend(q.size());
    for (const Term& term : q) {
        const auto at = remainder.try_emplace(term.monomial * m).first;
        at->second -= factor * term.coefficient;
        if (at->second == 0) remainder.erase(at);
    }
}

bool divide_term(const Monomial& a, const mpz_class& ca, const Monomial& b, const mpz_class& cb, Term& quotient)
{
    if (!mpz_divisible_p(ca.get_mpz_t(), cb.get_mpz_t())) return false;
    if (!Monomial::divide(a, b, quotient.monomial)) return false;
    mpz_divexact(quotient.coefficient.get_mpz_t(), ca.get_mpz_t(), cb.get_mpz_t());
    return true;
}

} // namespace

bool divide_exactly(const Polynomial& p, const Polynomial& q, Polynomial& quotient, Work& work)
{
    quotient.clear();
    if (q.empty()) return false;
    if (p.empty()) return true;
    work.spend(1 + p[0].monomial.size());
    Term term;
    // The trailing terms must divide too: this refuses most hopeless cases at no cost.
    if (!divide_term(p.back().monomial, p.back().coefficient, q.back().monomial, q.back().coefficient, term))
        return false;
    if (!divide_term(p[0].monomial, p[0].coefficient, q[0].monomial, q[0].coefficient, term)) return false;
    Remainder remainder = remainder_of(p);
    const std::size_t most = 4 * p.size() + 64;
    while (!remainder.empty()) {
        const auto& [monomial, coefficient] = *remainder.begin();
        if (quotient.size() > most || !divide_term(monomial, coefficient, q[0].monomial, q[0].coefficient, term))
            return false;
        quotient.push_back(term);
        subtract_multiple(remainder, q, term.monomial, term.coefficient, work);
    }
    return true;
}

bool square_root(const Polynomial& p, Polynomial& root, Work& work)
{
    root.clear();
    if (p.empty()) return true;
    Term lead{p[0].monomial, p[0].coefficient};
    if (lead.coefficient < 0 || !mpz_perfect_square_p(lead.coefficient.get_mpz_t())) return false;
    lead.coefficient = sqrt(lead.coefficient);
    Monomial half;
    for (std::size_t k = 0; k < p[0].monomial.size(); ++k) {
        if (p[0].monomial.exponent(k) % 2 != 0) return false;
        half = half * Monomial(p[0].monomial.generator(k), p[0].monomial.exponent(k) / 2);
    }
    lead.monomial = half;
    root.push_back(lead);
    Remainder remainder = remainder_of(p);
    remainder.erase(remainder.begin());
    const mpz_class twice = 2 * lead.coefficient;
    Term term;
    while (!remainder.empty()) {
        const auto& [monomial, coefficient] = *remainder.begin();
        if (root.size() > p.size() || !divide_term(monomial, coefficient, lead.monomial, twice, term)) return false;
        if (!before(root.back().monomial, term.monomial)) return false;
        // (r + t)^2 = r^2 + 2 r t + t^2
        subtract_multiple(remainder, root, term.monomial, 2 * term.coefficient, work);
        subtract_multiple(remainder, {term}, term.monomial, term.coefficient, work);
        root.push_back(term);
    }
    return true;
}

} // namespace lagen::proof
