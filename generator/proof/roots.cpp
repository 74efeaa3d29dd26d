// SPDX-License-Identifier: GPL-2.0-or-later
/// Roots and absolute values: what is certainly of one sign leaves the root, even powers leave it as absolute values.
#include "proof/elementary.hpp"
#include "proof/print_fraction.hpp"

#include <algorithm>
#include <numeric>

namespace lagen::proof {
namespace {

constexpr unsigned highest_degree = 64; ///< of the common root of several

int floor_divide(int a, int b)
{
    return a >= 0 ? a / b : -((b - 1 - a) / b);
}

} // namespace

std::vector<std::pair<mpz_class, unsigned>> small_factors(const mpz_class& number)
{
    std::vector<std::pair<mpz_class, unsigned>> factors;
    mpz_class rest = abs(number);
    for (unsigned long p = 2; p < 2000 && rest > 1; ++p) {
        unsigned exponent = 0;
        while (mpz_divisible_ui_p(rest.get_mpz_t(), p)) {
            rest /= p;
            ++exponent;
        }
        if (exponent > 0) factors.emplace_back(p, exponent);
    }
    if (rest > 1) {
        mpz_class root;
        const bool square = mpz_perfect_square_p(rest.get_mpz_t()) != 0;
        if (square) root = sqrt(rest);
        factors.emplace_back(square ? root : rest, square ? 2U : 1U);
    }
    return factors;
}

Elementary::Factored Elementary::factored(const Fraction& a)
{
    std::vector<std::pair<std::size_t, unsigned>> above;
    const mpz_class unit = ring_.split(a.num, above);
    Factored result{mpq_class(unit, a.scale), {}};
    result.number.canonicalize();
    for (const auto& [index, power] : above) result.factors.push_back({ring_.factor(index), static_cast<int>(power)});
    for (const auto& [index, power] : a.factors)
        result.factors.push_back({ring_.factor(index), -static_cast<int>(power)});
    return result;
}

const Fraction* Elementary::exponent_of(const Polynomial& p) const
{
    if (p.size() != 1 || p[0].coefficient != 1 || p[0].monomial.size() != 1) return nullptr;
    const auto at = exponents_.find(p[0].monomial.generator(0));
    return at == exponents_.end() || p[0].monomial.exponent(0) != 1 ? nullptr : &at->second;
}

/// All roots of one radicand are powers of one generator, whose degree is the least common multiple of theirs.
Fraction Elementary::root_generator(const Polynomial& radicand, unsigned wanted)
{
    const auto [known, fresh] = root_degrees_.try_emplace(key_of(radicand), wanted);
    unsigned& common = known->second;
    if (fresh) forget_families(); // Stumpff functions are written by known roots
    if (common % wanted != 0 && std::lcm(common, wanted) <= highest_degree) {
        common = std::lcm(common, wanted);
        refined_ = true;
    }
    const unsigned degree = common % wanted == 0 ? common : wanted;
    const std::string key = "root" + std::to_string(degree) + ':' + key_of(radicand);
    const GeneratorId id = ring_.keyed(key, [&] {
        const Printed inner = print(ring_, radicand, longest_generator);
        const std::string text =
            degree == 2 ? "sqrt(" + inner.text + ")" : "(" + inner.text + ")^(1/" + std::to_string(degree) + ")";
        Tree tree = degree == 2 ? call_of(Function::sqrt, {inner.tree}) : nullptr;
        if (degree != 2 && inner.tree) tree = power(inner.tree, number(Rational(1, degree)));
        const Range range = ring_.signs(radicand).zero ? Range::nonnegative() : Range::positive();
        std::optional<Ball> value = ring_.value_of(radicand);
        if (value && !value->is_positive()) value.reset();
        if (value) arb_root_ui(value->get(), value->get(), degree, 256);
        return ring_.add_generator({text, range, degree, radicand, -1, false, value, tree});
    });
    roots_.insert_or_assign(id, Root{radicand, degree});
    return ring_.of(id, degree / wanted);
}

Fraction Elementary::number_root(const mpq_class& number, unsigned degree)
{
    Fraction result = ring_.constant(1);
    const auto multiply_in = [&](const mpz_class& integer, int sign) {
        for (const auto& [prime, power] : small_factors(integer)) {
            const int exponent = sign * static_cast<int>(power);
            const int whole = floor_divide(exponent, static_cast<int>(degree));
            const int rest = exponent - whole * static_cast<int>(degree);
            result = ring_.times(result, ring_.power(ring_.constant(mpq_class(prime)), whole));
            if (rest > 0) {
                const Fraction w = root_generator(constant_polynomial(prime), degree);
                result = ring_.times(result, ring_.power(w, rest));
            }
        }
    };
    multiply_in(number.get_num(), 1);
    multiply_in(number.get_den(), -1);
    return result;
}

/// sqrt(a + b sqrt n) = sqrt((a + d)/2) + sign(b) sqrt((a - d)/2) where d = sqrt(a^2 - b^2 n) is an integer and a > 0.
std::optional<Fraction> Elementary::denested(const Polynomial& radicand)
{
    if (radicand.size() != 2 || !radicand[1].monomial.is_one() || radicand[1].coefficient <= 0) return std::nullopt;
    for (std::size_t k = 0; k < radicand[0].monomial.size(); ++k) {
        const Generator& generator = ring_.generator(radicand[0].monomial.generator(k));
        // A coordinate with s^2 = n may be the negative root.
        const bool root = !generator.range.low.infinite && sgn(generator.range.low.value) >= 0;
        if (generator.power != 2 || !is_constant(generator.relation) || !root) return std::nullopt;
    }
    const mpz_class &a = radicand[1].coefficient, &b = radicand[0].coefficient;
    const Polynomial square = ring_.power({{radicand[0].monomial, 1}}, 2);
    if (!is_constant(square) || square.empty()) return std::nullopt;
    const mpz_class discriminant = a * a - b * b * square[0].coefficient;
    if (discriminant < 0 || !mpz_perfect_square_p(discriminant.get_mpz_t())) return std::nullopt;
    const mpz_class d = sqrt(discriminant);
    mpq_class larger(a + d, 2), smaller(a - d, 2);
    larger.canonicalize();
    smaller.canonicalize();
    return ring_.add(number_root(larger, 2), number_root(smaller, 2), sgn(b));
}

Fraction Elementary::remaining_root(const Polynomial& radicand, unsigned degree)
{
    if (is_one(radicand)) return ring_.constant(1);
    // A coordinate that a constraint makes a root already, g3^2 = 1 - g1^2 - g2^2, and whose sign is known. (Not a root
    // that was made here: its degree may be too low for the others of the same radicand.)
    for (std::size_t k = 0; k < ring_.size(); ++k) {
        const auto id = static_cast<GeneratorId>(k);
        const Generator& generator = ring_.generator(id);
        if (generator.power == degree && !roots_.contains(id) && signs_of(generator.range).certainly_nonnegative() &&
            equal(generator.relation, radicand))
            return ring_.of(id);
    }
    if (degree == 2) {
        if (const auto simple = denested(radicand)) return *simple;
        std::vector<Polynomial> forms = ring_.rewritings(radicand);
        forms.insert(forms.begin(), radicand);
        Polynomial square;
        for (const Polynomial& form : forms)
            if (square_root(form, square, ring_.work())) return absolute(ring_.of(square));
    }
    return root_generator(radicand, degree);
}

Fraction Elementary::root(const Fraction& argument, unsigned degree)
{
    if (argument.is_zero()) return {};
    const Factored parts = factored(argument);
    Fraction result = number_root(parts.number, degree);
    Polynomial rest = constant_polynomial(sgn(parts.number) < 0 ? -1 : 1);
    const int q = static_cast<int>(degree);
    std::vector<std::pair<Polynomial, unsigned>> remaining;
    for (const auto& [base, exponent] : parts.factors) {
        if (const Fraction* inner = exponent_of(base)) {
            mpq_class power(exponent, q);
            power.canonicalize();
            result = ring_.times(result, exponential(ring_.times(ring_.constant(power), *inner)));
            continue;
        }
        if (const auto tower = base.size() == 1 && base[0].monomial.size() == 1
                                   ? roots_.find(base[0].monomial.generator(0))
                                   : roots_.end();
            tower != roots_.end() && base[0].monomial.exponent(0) == 1 &&
            tower->second.degree * degree <= highest_degree) {
            // w^(e/q) of a root w = r^(1/p) >= 0: whole powers of w, and of r^(1/(p q)) in lowest terms
            const Root inner = tower->second;
            const int powers = floor_divide(exponent, q), left = exponent - powers * q, shared = std::gcd(left, q);
            result = ring_.times(result, ring_.power(ring_.of(base), powers));
            const auto reduced = static_cast<unsigned>(q / shared);
            if (left > 0)
                result = ring_.times(
                    result, ring_.power(root_generator(inner.radicand, inner.degree * reduced), left / shared));
            continue;
        }
        int whole = floor_divide(exponent, q);
        if (ring_.signs(base).certainly_nonnegative()) {
            result = ring_.times(result, ring_.power(ring_.of(base), whole));
            const int left = exponent - whole * q;
            if (left > 0) result = ring_.times(result, ring_.power(remaining_root(base, degree), left));
            continue;
        }
        // f^(q k) has the root |f|^k where q k is even.
        if (q % 2 != 0 && whole % 2 != 0) --whole;
        if (whole != 0) result = ring_.times(result, ring_.power(absolute(ring_.of(base)), whole));
        const int left = exponent - whole * q;
        if (left > 0) remaining.emplace_back(base, static_cast<unsigned>(left));
    }
    unsigned shared = degree;
    for (const auto& [base, left] : remaining) shared = std::gcd(shared, left);
    if (sgn(parts.number) < 0 && shared % 2 == 0) shared = 1;
    for (const auto& [base, left] : remaining) rest = ring_.times(rest, ring_.power(base, left / shared));
    if (shared > 1 && !remaining.empty()) {
        // (b^g)^(1/q) = |b|^(g/q), and b >= 0 where g is odd.
        const Fraction inner = shared % 2 == 0 ? absolute(ring_.of(rest)) : ring_.of(rest);
        return ring_.times(result, shared == degree ? inner : root(inner, degree / shared));
    }
    if (is_one(rest)) return result;
    return ring_.times(result, remaining_root(rest, degree));
}

Fraction Elementary::absolute_generator(const Polynomial& p)
{
    const GeneratorId id = ring_.keyed("abs:" + key_of(p), [&] {
        const Printed inner = print(ring_, p, longest_generator);
        const std::string text = "abs(" + inner.text + ")";
        const Range range = ring_.signs(p).zero ? Range::nonnegative() : Range::positive();
        std::optional<Ball> value = ring_.value_of(p);
        if (value) arb_abs(value->get(), value->get());
        return ring_.add_generator(
            {text, range, 2, ring_.power(p, 2), -1, false, value, call_of(Function::abs, {inner.tree}), true});
    });
    return ring_.of(id);
}

Fraction Elementary::open_absolute(const Polynomial& p)
{
    const Tree tree = print(ring_, p, longest_open).tree;
    if (const auto known = assumed(p, tree)) {
        if (!known->negative) return ring_.of(p);
        if (!known->positive) return ring_.of(negate(p));
    }
    const Fraction magnitude = absolute_generator(p);
    if (tree) open_signs_.push_back({tree, false, magnitude.num[0].monomial.generator(0)});
    return magnitude;
}

Fraction Elementary::absolute(const Fraction& argument)
{
    if (argument.is_zero()) return {};
    const Factored parts = factored(argument);
    Fraction result = ring_.constant(abs(parts.number));
    for (const auto& [base, exponent] : parts.factors) {
        const Signs signs = ring_.signs(base);
        Fraction magnitude = ring_.of(base);
        if (!signs.certainly_nonnegative() && exponent % 2 != 0)
            magnitude = !signs.positive ? ring_.negate(magnitude) : open_absolute(base);
        result = ring_.times(result, ring_.power(magnitude, exponent));
    }
    return result;
}

Fraction Elementary::real_power(const Fraction& base, const Fraction& exponent)
{
    const std::optional<mpq_class> number = exponent.constant();
    if (number && number->get_den() <= 64 && abs(number->get_num()) <= 4096) {
        const auto degree = static_cast<unsigned>(number->get_den().get_ui());
        const int power = static_cast<int>(number->get_num().get_si());
        if (power == 0) return ring_.constant(1);
        return ring_.power(degree == 1 ? base : root(base, degree), power);
    }
    return exponential(ring_.times(exponent, logarithm(base)));
}

// Assumed signs: the cases of |p|, min, max, sign and if. A case adds a fact to the ring; p = 0 also eliminates a
// variable where p is linear in one.

std::optional<Signs> Elementary::assumed(const Polynomial& p, const Tree& tree)
{
    if (!tree) return std::nullopt;
    const auto at = std::ranges::find_if(
        assumptions_, [&](const Assumption& assumption) { return same_tree(assumption.polynomial, tree); });
    if (at == assumptions_.end()) return std::nullopt;
    const Signs known = both(at->signs, ring_.signs(p));
    if (applied_.insert(static_cast<std::size_t>(at - assumptions_.begin())).second) {
        ring_.add_fact(p, known);
        ring_.propagate_facts();
        if (!known.negative && !known.positive) eliminate(p);
        refined_ = true; // what was made before did not know it
    }
    return known;
}

/// p = 0 as the relation v = rest of a free variable v with coefficient 1 or -1.
void Elementary::eliminate(const Polynomial& p)
{
    for (std::size_t k = 0; k < p.size(); ++k) {
        if (p[k].monomial.size() != 1 || p[k].monomial.exponent(0) != 1 || abs(p[k].coefficient) != 1) continue;
        const GeneratorId variable = p[k].monomial.generator(0);
        const Generator& generator = ring_.generator(variable);
        bool usable = generator.power == 0 && generator.partner < 0 && !generator.value;
        Polynomial rest;
        for (std::size_t j = 0; j < p.size() && usable; ++j) {
            if (j == k) continue;
            for (std::size_t i = 0; i < p[j].monomial.size(); ++i) {
                const Generator& other = ring_.generator(p[j].monomial.generator(i));
                usable = usable && p[j].monomial.generator(i) != variable && other.power == 0 && other.partner < 0;
            }
            rest.push_back(p[j]);
        }
        if (!usable) continue;
        ring_.set_relation(variable, 1, scale(rest, -p[k].coefficient));
        return;
    }
}

Signs Elementary::sign_of(const Fraction& a)
{
    Polynomial product = a.num;
    // The sign of n / d is that of n d.
    for (const auto& [index, power] : a.factors)
        if (power % 2 != 0) product = ring_.times(product, Polynomial(ring_.factor(index)));
    if (product.empty()) return {false, true, false};
    if (product[0].coefficient < 0) {
        Fraction negative = ring_.negate(a);
        return -sign_of(negative);
    }
    const mpz_class common = content(product); // first: arguments are evaluated in any order
    product = divide_content(std::move(product), common);
    const Signs known = ring_.signs(product);
    if (static_cast<int>(known.negative) + known.zero + known.positive <= 1) return known;
    const Tree tree = print(ring_, product, longest_open).tree;
    if (const auto assumption = assumed(product, tree)) return *assumption;
    if (tree) open_signs_.push_back({tree, true, std::nullopt});
    return known;
}

} // namespace lagen::proof
