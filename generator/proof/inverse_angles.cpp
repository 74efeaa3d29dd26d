// SPDX-License-Identifier: GPL-2.0-or-later
/// asin, acos, atan and atan2 as angles whose sine and cosine are known: acos a = pi/2 - asin a, atan2 by the signs of
/// its arguments, sin and cos of integer multiples and halves by the addition theorems, and sums of angles that vanish
/// because their cosine is 1.
#include "proof/elementary.hpp"
#include "proof/print_fraction.hpp"

#include <arb_hypgeom.h>

#include <numeric>

namespace lagen::proof {
namespace {

/// Rational bounds outside of pi/2 and pi.
const mpq_class half_turn_quarter(355, 226);
const mpq_class half_turn(355, 113);

Range right_angles(const Signs& signs, bool open)
{
    Range range{End{false, -half_turn_quarter, open}, End{false, half_turn_quarter, open}, !signs.zero};
    if (!signs.negative) range.low = End{false, 0, !signs.zero};
    if (!signs.positive) range.high = End{false, 0, !signs.zero};
    return range;
}

bool is_positive(const Signs& signs)
{
    return signs.certainly_positive();
}

} // namespace

Fraction Elementary::inverse_angle(const std::string& name, const std::vector<Fraction>& arguments,
                                   const SineCosine& values, const Range& range)
{
    std::string key = name, text = name + '(';
    std::vector<Tree> trees;
    for (std::size_t k = 0; k < arguments.size(); ++k) {
        key += ':' + key_of(arguments[k]);
        const Printed argument = print(ring_, arguments[k], longest_generator);
        text += (k == 0 ? "" : ", ") + argument.text;
        trees.push_back(argument.tree);
    }
    const GeneratorId id = ring_.keyed(key, [&] {
        Generator generator{text + ')', range, 0, {}, -1, false};
        generator.tree = call_of(name, std::move(trees));
        const auto sine = ring_.value_of(values.sine), cosine = ring_.value_of(values.cosine);
        if (sine && cosine) {
            generator.value = Ball();
            // Not across the cut: there the enclosure is wide, and nothing follows from it.
            arb_atan2(generator.value->get(), sine->get(), cosine->get(), 256);
        }
        return ring_.add_generator(std::move(generator));
    });
    inverses_.insert_or_assign(id, values);
    if (name != "atan2") halved_.insert(id);
    return ring_.of(id);
}

Fraction Elementary::arcsine(const Fraction& a)
{
    if (a.is_zero()) return {};
    if (a.num[0].coefficient < 0) return ring_.negate(arcsine(ring_.negate(a)));
    const Fraction square = ring_.add(ring_.constant(1), ring_.times(a, a), -1);
    return inverse_angle("asin", {a}, {a, root(square, 2)}, right_angles(ring_.signs(a), false));
}

Fraction Elementary::arccosine(const Fraction& a)
{
    return ring_.add(ring_.times(ring_.constant(mpq_class(1, 2)), pi()), arcsine(a), -1);
}

Fraction Elementary::arctangent(const Fraction& a)
{
    if (a.is_zero()) return {};
    if (a.num[0].coefficient < 0) return ring_.negate(arctangent(ring_.negate(a)));
    const Fraction cosine = ring_.inverse(root(ring_.add(ring_.constant(1), ring_.times(a, a)), 2));
    return inverse_angle("atan", {a}, {ring_.times(a, cosine), cosine}, right_angles(ring_.signs(a), true));
}

Fraction Elementary::arctangent2(const Fraction& y, const Fraction& x)
{
    const Signs below = ring_.signs(x), above = ring_.signs(y);
    const Fraction quarter = ring_.times(ring_.constant(mpq_class(1, 2)), pi());
    if (is_positive(below)) return arctangent(ring_.divide(y, x));
    if (is_positive(above)) return ring_.add(quarter, arctangent(ring_.divide(x, y)), -1);
    if (above.certainly_negative()) return ring_.add(ring_.negate(quarter), arctangent(ring_.divide(x, y)), -1);
    if (y.is_zero() && below.certainly_negative()) return pi();
    if (x.is_zero() && y.is_zero()) return opaque("atan2", {y, x}); // defined nowhere
    // A common positive number does not matter.
    const mpq_class size(abs((y.is_zero() ? x : y).num[0].coefficient), (y.is_zero() ? x : y).scale);
    mpq_class inverse = 1 / size;
    inverse.canonicalize();
    const Fraction v = ring_.times(ring_.constant(inverse), y), u = ring_.times(ring_.constant(inverse), x);
    const Fraction distance = root(ring_.add(ring_.times(v, v), ring_.times(u, u)), 2);
    Range range = Range::between(-half_turn, half_turn);
    if (!above.negative) range.low = End{false, 0, false};
    return inverse_angle("atan2", {v, u}, {ring_.divide(v, distance), ring_.divide(u, distance)}, range);
}

/// sin and cos of k theta or k theta/2 where theta is an inverse angle.
std::optional<Elementary::SineCosine> Elementary::inverse_values(const Part& part)
{
    const Polynomial& atom = part.atom.num;
    if (!part.atom.factors.empty() || part.atom.scale != 1 || atom.size() != 1 || atom[0].monomial.size() != 1 ||
        atom[0].monomial.exponent(0) != 1)
        return std::nullopt;
    const GeneratorId id = atom[0].monomial.generator(0);
    const auto at = inverses_.find(id);
    if (at == inverses_.end()) return std::nullopt;
    SineCosine values = at->second;
    const std::string text = ring_.generator(id).text;
    if (part.coefficient.get_den() == 2 && halved_.count(id) > 0) {
        // cos(theta/2) = sqrt((1 + cos theta)/2) >= sqrt(1/2) for |theta| <= pi/2
        const Fraction half = ring_.constant(mpq_class(1, 2));
        const Fraction cosine = root(ring_.times(half, ring_.add(ring_.constant(1), values.cosine)), 2);
        values = {ring_.divide(ring_.times(half, values.sine), cosine), cosine};
    } else if (part.coefficient.get_den() != 1) {
        return std::nullopt;
    }
    return multiple_angle(values, part.coefficient.get_num(), text);
}

bool Elementary::is_vanishing_angle(const Fraction& a)
{
    if (!a.factors.empty()) return false;
    bool inverse = false;
    mpz_class common = 1;
    for (const Term& term : a.num) {
        if (term.monomial.size() != 1 || inverses_.count(term.monomial.generator(0)) == 0) continue;
        inverse = true;
        mpq_class coefficient(term.coefficient, a.scale);
        coefficient.canonicalize();
        if (coefficient.get_den() > 2) mpz_lcm(common.get_mpz_t(), common.get_mpz_t(), coefficient.get_den_mpz_t());
    }
    if (!inverse || common > 64) return false;
    const Fraction angle = ring_.times(ring_.constant(mpq_class(common)), a);
    const Fraction turn = ring_.times(ring_.constant(2), pi());
    if (!is_positive(ring_.signs(ring_.add(turn, angle))) || !is_positive(ring_.signs(ring_.add(turn, angle, -1))))
        return false;
    const Fraction excess = ring_.add(sine_cosine(angle).cosine, ring_.constant(1), -1);
    if (excess.is_zero()) return true;
    const Signs signs = ring_.signs(excess.num);
    return !signs.negative && !signs.positive;
}

/// The values of sin or cos of an angle whose quadrants are known.
Range Elementary::angle_range(const Fraction& argument, bool sine)
{
    Range range = Range::between(-1, 1);
    if (argument.num.size() > 4) return range;
    // sin >= 0 on [0, pi], cos >= 0 on [-pi/2, pi/2]; shifted by whole half turns.
    for (int k = -2; k <= 2; ++k) {
        const mpq_class start = k + (sine ? mpq_class(0) : mpq_class(-1, 2));
        const auto multiple = [this](const mpq_class& turns) { return ring_.times(ring_.constant(turns), pi()); };
        const Signs after = ring_.signs(ring_.add(argument, multiple(start), -1));
        if (after.negative) continue;
        const Signs before = ring_.signs(ring_.add(multiple(start + 1), argument, -1));
        if (before.negative) continue;
        const bool open = !after.zero && !before.zero;
        (k % 2 == 0 ? range.low : range.high) = End{false, 0, open};
    }
    return range;
}

// erf in the ring: a generator for every argument up to its sign, with the signs of its argument. No formula takes
// erf(a + b) apart.

Fraction Elementary::error_function(const Fraction& a)
{
    if (a.is_zero()) return {};
    if (a.num[0].coefficient < 0) return ring_.negate(error_function(ring_.negate(a)));
    const GeneratorId id = ring_.keyed("erf:" + key_of(a), [&] {
        const Signs signs = ring_.signs(a);
        Range range{End{false, -1, true}, End{false, 1, true}, !signs.zero};
        if (!signs.negative) range.low = End{false, 0, !signs.zero};
        if (!signs.positive) range.high = End{false, 0, !signs.zero};
        const Printed argument = print(ring_, a, longest_generator);
        Generator generator{"erf(" + argument.text + ")", range, 0, {}, -1, false};
        generator.tree = call_of(Function::erf, {argument.tree});
        if (const auto value = ring_.value_of(a)) {
            generator.value = Ball();
            arb_hypgeom_erf(generator.value->get(), value->get(), 256);
        }
        return ring_.add_generator(std::move(generator));
    });
    return ring_.of(id);
}

} // namespace lagen::proof
