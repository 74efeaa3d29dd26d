// SPDX-License-Identifier: GPL-2.0-or-later
/// sin and cos of rational multiples of pi as algebraic numbers: with t = 2 cos(pi/(2 L)), cos(k pi/L) = V_2k(t)/2 and
/// sin(k pi/L) = V_(L - 2k)(t)/2, where V_0 = 2, V_1 = t, V_(k+1) = t V_k - V_(k-1), and t is a root of the minimal
/// polynomial of 2 cos(2 pi/m), m = 4 L.
#include "proof/elementary.hpp"
#include "proof/print_fraction.hpp"

#include <numeric>

namespace lagen::proof {

namespace {

using Coefficients = std::vector<mpz_class>; ///< of 1, x, x^2, ...

/// p / q for a monic q that divides p.
Coefficients quotient_of(Coefficients p, const Coefficients& q)
{
    Coefficients quotient(p.size() - q.size() + 1);
    for (std::size_t k = quotient.size(); k-- > 0;) {
        quotient[k] = p[k + q.size() - 1];
        for (std::size_t j = 0; j < q.size(); ++j) p[k + j] -= quotient[k] * q[j];
    }
    return quotient;
}

/// The cyclotomic polynomial of order m: (x^m - 1) over those of the proper divisors of m.
Coefficients cyclotomic(unsigned m)
{
    std::map<unsigned, Coefficients> known;
    for (unsigned n = 1; n <= m; ++n) {
        if (m % n != 0) continue;
        Coefficients p(n + 1);
        p[0] = -1;
        p[n] = 1;
        for (const auto& [d, divisor] : known)
            if (n % d == 0) p = quotient_of(std::move(p), divisor);
        known.emplace(n, std::move(p));
    }
    return known.at(m);
}

/// V_k as coefficients, k = 0 .. n.
std::vector<Coefficients> doubled_chebyshev(unsigned n)
{
    std::vector<Coefficients> V{{2}, {0, 1}};
    while (V.size() <= n) {
        const Coefficients &last = V.back(), &before = V[V.size() - 2];
        Coefficients next(last.size() + 1);
        for (std::size_t j = 0; j < last.size(); ++j) next[j + 1] += last[j];
        for (std::size_t j = 0; j < before.size(); ++j) next[j] -= before[j];
        V.push_back(std::move(next));
    }
    return V;
}

/// The minimal polynomial of 2 cos(2 pi/m), m > 2: the cyclotomic polynomial is palindromic, x^h P(x + 1/x).
Coefficients minimal_polynomial(unsigned m)
{
    const Coefficients p = cyclotomic(m);
    const std::size_t h = (p.size() - 1) / 2;
    const std::vector<Coefficients> V = doubled_chebyshev(static_cast<unsigned>(h));
    Coefficients result(h + 1);
    result[0] = p[h];
    for (std::size_t k = 1; k <= h; ++k)
        for (std::size_t j = 0; j < V[k].size(); ++j) result[j] += p[h + k] * V[k][j];
    return result;
}

} // namespace

Elementary::SineCosine Elementary::part_of_pi(const mpq_class& turns)
{
    const auto below = static_cast<unsigned>(turns.get_den().get_ui());
    if (pi_parts_ % below != 0) {
        refined_ = refined_ || pi_parts_ > 1;
        pi_parts_ = std::lcm(pi_parts_, below);
    }
    const unsigned L = pi_parts_;
    const GeneratorId id = ring_.keyed("pi/" + std::to_string(L), [&] {
        const std::string text = "(2*cos(pi/" + std::to_string(2 * L) + "))";
        Ball value;
        arb_const_pi(value.get(), 256);
        arb_div_ui(value.get(), value.get(), 2UL * L, 256);
        arb_cos(value.get(), value.get(), 256);
        arb_mul_2exp_si(value.get(), value.get(), 1);
        const Range range{End{false, 0, true}, End{false, 2, true}, true};
        const Tree angle = divide(constant_pi(), number(2 * L));
        return ring_.add_generator(
            {text, range, 0, {}, -1, false, value, lagen::multiply({number(2), call_of(Function::cos, {angle})})});
    });
    if (ring_.generator(id).power == 0) {
        const Coefficients minimal = minimal_polynomial(4 * L);
        Polynomial relation;
        for (std::size_t k = minimal.size() - 1; k-- > 0;)
            if (minimal[k] != 0) relation.push_back({Monomial(id, static_cast<unsigned>(k)), -minimal[k]});
        ring_.set_relation(id, static_cast<unsigned>(minimal.size() - 1), std::move(relation));
    }
    const auto k = static_cast<unsigned>(mpz_class(turns.get_num() * (L / below)).get_ui());
    const std::vector<Coefficients> V = doubled_chebyshev(2 * L);
    const auto half_of = [&](unsigned index) {
        Polynomial p;
        for (std::size_t j = V[index].size(); j-- > 0;)
            if (V[index][j] != 0) p.push_back({Monomial(id, static_cast<unsigned>(j)), V[index][j]});
        return ring_.times(ring_.constant(mpq_class(1, 2)), ring_.of(p));
    };
    return {half_of(L > 2 * k ? L - 2 * k : 2 * k - L), half_of(2 * k)};
}

} // namespace lagen::proof
