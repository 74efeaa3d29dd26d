// SPDX-License-Identifier: GPL-2.0-or-later
/// Products of polynomials: short ones term by term, long ones by FLINT, in the ring of the generators that occur. Its
/// lexicographic order with the first generator greatest is ours. FLINT aborts where exponents or memory overflow: it
/// is given a bounded number of term products at a time, of bounded exponents and coefficients.
#include "proof/polynomial.hpp"

#include <flint/fmpz_mpoly.h>

#include <algorithm>
#include <map>

namespace lagen::proof {

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

} // namespace lagen::proof
