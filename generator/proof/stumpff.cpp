// SPDX-License-Identifier: GPL-2.0-or-later
/// Stumpff functions in the ring. All orders of one argument z are written by c_0 and c_1, z c_{k+2} = 1/k! - c_k, with
/// c_0^2 + z c_1^2 = 1; where z is w^2 or -w^2, by the sine and cosine, or the exponential, of w. So is z >= 0 whose
/// root stands in the expression already: c_1(v.v) beside sin(|v|/2).
///
/// The division by z is sound although c_k is defined where z = 0. Let V be the points of the tower of generators over
/// the space F of the free ones, all of them taken as independent variables, and E the expression, in which c_k(z) is
/// the entire function of the ring element z: E is continuous on V wherever the model's own divisors do not vanish, and
/// z^m E is the ring element N. N = 0 makes E vanish where z does not. V is a finite cover of F, since the relations of
/// the tower are monic, so that the points with z != 0 are dense in V where the norm of z over F is not 0, and then
/// E = 0 on all of V. Where the norm is 0 or not found, z may vanish on a whole component, and `condition` names it.
#include "expression/evaluate_stumpff.hpp"
#include "proof/elementary.hpp"
#include "proof/print_fraction.hpp"

namespace lagen::proof {

namespace {

constexpr unsigned most_repeats = 256; ///< of one argument's root in another's
constexpr int most_conjugations = 32;  ///< in a search for the norm of an argument

/// a = square * rest with a square-free integer `rest`, up to primes above 2000; the root of `square`.
struct SquarePart {
    mpq_class root = 1;
    mpz_class rest = 1;
};

SquarePart square_part(const mpq_class& a)
{
    SquarePart part;
    for (const auto& [prime, exponent] : small_factors(mpz_class(a.get_num() * a.get_den()))) {
        mpz_class power;
        mpz_pow_ui(power.get_mpz_t(), prime.get_mpz_t(), exponent / 2);
        part.root *= power;
        if (exponent % 2 != 0) part.rest *= prime;
    }
    part.root /= a.get_den();
    return part;
}

} // namespace

/// Is {z != 0} dense? By the norm: p = a + b g with g^2 = r divides a^2 - b^2 r; a product vanishes where the radicands
/// of its roots do.
bool Elementary::is_dense_where_nonzero(const Fraction& z)
{
    if (ring_.signs(z).certainly_nonzero()) return true;
    Polynomial p = z.num;
    for (int k = 0; k < most_conjugations && !p.empty(); ++k) {
        std::optional<GeneratorId> found;
        for (const Term& term : p)
            for (std::size_t i = 0; i < term.monomial.size(); ++i)
                if (ring_.generator(term.monomial.generator(i)).power != 0) found = term.monomial.generator(i);
        if (!found) return true;
        if (p.size() == 1) {
            Polynomial radicands = constant_polynomial(1);
            for (std::size_t i = 0; i < p[0].monomial.size(); ++i)
                if (const Generator& root = ring_.generator(p[0].monomial.generator(i)); root.power != 0)
                    radicands = ring_.times(radicands, Polynomial(root.relation));
            p = std::move(radicands);
            continue;
        }
        if (ring_.generator(*found).power != 2) return false;
        Polynomial even, odd;
        for (const Term& term : p) {
            const bool has = term.monomial.exponent_of(*found) != 0;
            (has ? odd : even).push_back({term.monomial.without(*found), term.coefficient});
        }
        even = ring_.power(proof::collect(std::move(even), ring_.work()), 2);
        odd = ring_.power(proof::collect(std::move(odd), ring_.work()), 2);
        const Polynomial relation = ring_.generator(*found).relation;
        p = add_scaled(even, ring_.times(odd, relation), -1, ring_.work());
    }
    return false;
}

void Elementary::divide_by_argument(const Fraction& z)
{
    if (condition_.empty() && !is_dense_where_nonzero(z)) condition_ = to_text(ring_, z);
}

/// w with w^2 = z (or -z where `sign` is -1), or nothing.
std::optional<Fraction> Elementary::argument_root(const Fraction& z, int sign)
{
    mpq_class number(content(z.num), z.scale);
    number.canonicalize();
    const SquarePart part = square_part(number);
    if (part.rest != 1) return std::nullopt;
    Fraction below = ring_.constant(part.root);
    for (const auto& [index, power] : z.factors) {
        if (power % 2 != 0) return std::nullopt;
        below =
            ring_.divide(below, ring_.power(ring_.of(Polynomial(ring_.factor(index))), static_cast<int>(power / 2)));
    }
    const Polynomial primitive = scale(divide_content(z.num, content(z.num)), sign);
    if (is_one(primitive)) return below;
    Polynomial root;
    if (!square_root(primitive, root, ring_.work())) return std::nullopt;
    return ring_.times(below, ring_.of(root));
}

/// sqrt z, where z is not negative and roots of its factors are generators already; nothing else.
std::optional<Fraction> Elementary::known_root(const Fraction& z)
{
    const Factored parts = factored(z);
    if (sgn(parts.number) < 0) return std::nullopt;
    bool known = false;
    for (const auto& [base, exponent] : parts.factors) {
        if (exponent % 2 == 0) continue;
        const auto found = root_degrees_.find(key_of(base));
        if (found == root_degrees_.end() || found->second % 2 != 0) return std::nullopt;
        if (!ring_.signs(base).certainly_nonnegative()) return std::nullopt;
        known = true;
    }
    if (!known) return std::nullopt;
    return root(z, 2);
}

void Elementary::forget_families()
{
    refined_ = std::erase_if(families_, [](const auto& entry) { return !entry.second.kept; }) > 0 || refined_;
}

void Elementary::keep_families()
{
    for (auto& [key, family] : families_) family.kept = true;
}

/// Two generators: c_0 of the unit n/d, and c_1 / d, so that c_0^2 = 1 - n d (c_1/d)^2 has no denominator.
void Elementary::make_family(Family& family, const Fraction& kernel)
{
    family.argument = ring_.times(ring_.constant(mpq_class(family.size * family.size)), kernel);
    Polynomial below = constant_polynomial(family.argument.scale);
    for (const auto& [index, power] : family.argument.factors) {
        const Polynomial factor = ring_.factor(index);
        below = ring_.times(below, ring_.power(factor, power));
    }
    const Printed argument = print(ring_, family.argument, longest_generator);
    const Printed divisor = print(ring_, below, longest_generator);
    const auto generator = [&](unsigned order, const Range& range) {
        Generator made{"stumpff(" + std::to_string(order) + ", " + argument.text + ")", range, 0, {}, -1, false};
        made.tree = call_of(Function::stumpff, {number(order), argument.tree});
        return made;
    };
    Generator quotient = generator(1, {});
    if (!is_one(below)) {
        quotient.text = "(" + quotient.text + "/(" + divisor.text + "))";
        quotient.tree = quotient.tree && divisor.tree ? divide(quotient.tree, divisor.tree) : nullptr;
    }
    const GeneratorId odd = ring_.add_generator(std::move(quotient));
    const bool circular = ring_.signs(kernel).certainly_nonnegative();
    const GeneratorId even = ring_.add_generator(generator(0, circular ? Range::between(-1, 1) : Range{}));
    const Polynomial square = ring_.times(ring_.times(family.argument.num, below), generator_polynomial(odd, 2));
    ring_.set_relation(even, 2, add_scaled(constant_polynomial(1), square, -1, ring_.work()));
    family.first = {ring_.of(even), ring_.times(ring_.of(below), ring_.of(odd))};
}

/// c_0 and c_1 of k^2 times the argument of `family`: (c, s) -> cos and sin/w of a multiple angle.
Elementary::StumpffPair Elementary::repeated(const Family& family, const mpz_class& count)
{
    if (count > most_repeats)
        throw BudgetExhausted("the root of an argument of stumpff is " + count.get_str() +
                              " times that of another, more than " + std::to_string(most_repeats));
    const auto product = [&](const StumpffPair& a, const StumpffPair& b) -> StumpffPair {
        return {ring_.add(ring_.times(a.even, b.even), ring_.times(family.argument, ring_.times(a.odd, b.odd)), -1),
                ring_.add(ring_.times(a.odd, b.even), ring_.times(a.even, b.odd))};
    };
    StumpffPair result{ring_.constant(1), {}};
    StumpffPair square = family.first;
    for (unsigned long rest = count.get_ui(); rest > 0; rest >>= 1U) {
        if ((rest & 1U) != 0) result = product(result, square);
        if (rest > 1) square = product(square, square);
    }
    result.odd = ring_.times(ring_.constant(mpq_class(mpz_class(1), count)), result.odd);
    return result;
}

Elementary::StumpffPair Elementary::stumpff_pair(const Fraction& z)
{
    const auto circular = [&](const Fraction& angle) -> StumpffPair {
        divide_by_argument(z);
        const SineCosine value = sine_cosine(angle);
        return {value.cosine, ring_.divide(value.sine, angle)};
    };
    if (const auto angle = argument_root(z, 1)) return circular(*angle);
    if (const auto argument = argument_root(z, -1)) {
        divide_by_argument(*argument);
        const Fraction e = exponential(*argument);
        const Fraction half = ring_.constant(mpq_class(1, 2));
        const Fraction inverse = ring_.inverse(e);
        return {ring_.times(half, ring_.add(e, inverse)),
                ring_.divide(ring_.times(half, ring_.add(e, inverse, -1)), *argument)};
    }
    mpq_class number(content(z.num), z.scale);
    number.canonicalize();
    const mpq_class size = square_part(number).root;
    const Fraction kernel = ring_.times(ring_.constant(mpq_class(1 / (size * size))), z);
    if (!families_.contains(key_of(kernel)))
        if (const auto angle = known_root(z)) return circular(*angle);
    const auto [at, fresh] = families_.try_emplace(key_of(kernel));
    Family& family = at->second;
    mpq_class quotient = fresh ? mpq_class(1) : mpq_class(size / family.size);
    if (fresh || quotient.get_den() != 1) {
        refined_ = refined_ || !fresh;
        family.size = fresh ? size : common_divisor(family.size, size);
        make_family(family, kernel);
        quotient = size / family.size;
    }
    return repeated(family, quotient.get_num());
}

Fraction Elementary::stumpff(unsigned order, const Fraction& z)
{
    if (z.is_zero()) return ring_.constant(stumpff_at_zero(order));
    const StumpffPair pair = stumpff_pair(z);
    Fraction value = order % 2 == 0 ? pair.even : pair.odd;
    if (order >= 2) divide_by_argument(z);
    for (unsigned k = order % 2; k < order; k += 2)
        value = ring_.divide(ring_.add(ring_.constant(stumpff_at_zero(k)), value, -1), z);
    return value;
}

} // namespace lagen::proof
