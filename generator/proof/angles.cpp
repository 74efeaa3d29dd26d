// SPDX-License-Identifier: GPL-2.0-or-later
/// sin, cos and exp: splitting of arguments, units, addition theorems.
#include "proof/elementary.hpp"
#include "proof/print_fraction.hpp"

#include <numeric>

namespace lagen::proof {

namespace {

constexpr unsigned largest_multiple = 256; ///< of an angle; cos(256 u) has 129 terms
constexpr std::size_t most_parts = 64;     ///< terms of one argument: each brings generators of its own

} // namespace

mpq_class common_divisor(const mpq_class& a, const mpq_class& b)
{
    mpz_class above, below;
    mpz_gcd(above.get_mpz_t(), mpz_class(a.get_num() * b.get_den()).get_mpz_t(),
            mpz_class(b.get_num() * a.get_den()).get_mpz_t());
    below = a.get_den() * b.get_den();
    mpq_class divisor(above, below);
    divisor.canonicalize();
    return divisor;
}

Fraction Elementary::pi(const char* text)
{
    return ring_.of(ring_.keyed("pi", [this, text] {
        const Range range{End{false, mpq_class(333, 106), true}, End{false, mpq_class(355, 113), true}, true};
        Ball value;
        arb_const_pi(value.get(), 256);
        const Tree number = constant_pi();
        const bool taken = std::string_view(text) != "pi"; // a name of the model; the number is acos(-1) then
        return ring_.add_generator({text,
                                    range,
                                    0,
                                    {},
                                    -1,
                                    false,
                                    value,
                                    taken ? call_of(Function::acos, {negate(lagen::number(1))}) : number});
    }));
}

std::vector<Elementary::Part> Elementary::parts(const Fraction& argument) const
{
    if (argument.num.size() > most_parts)
        throw BudgetExhausted("an argument of sin, cos or exp has more than " + std::to_string(most_parts) + " terms");
    std::vector<Part> result;
    for (const Term& term : argument.num) {
        Part part;
        part.coefficient = mpq_class(term.coefficient, argument.scale);
        part.coefficient.canonicalize();
        part.atom = ring_.normalised({{Term{term.monomial, 1}}, 1, argument.factors});
        result.push_back(std::move(part));
    }
    return result;
}

void Elementary::make_generators(Unit& unit, const Fraction& atom, bool angle)
{
    Fraction argument = ring_.times(ring_.constant(unit.size), atom);
    const Printed inner = print(ring_, argument, longest_generator);
    if (!angle) {
        Generator generator{"exp(" + inner.text + ")", Range::positive(), 0, {}, -1, false};
        generator.tree = call_of(Function::exp, {inner.tree});
        const Signs signs = ring_.signs(argument);
        if (!signs.negative) generator.range.low = End{false, 1, !signs.zero};
        if (!signs.positive) generator.range.high = End{false, 1, !signs.zero};
        if (argument.is_polynomial())
            generator.range = intersect(
                generator.range,
                increasing_image(ring_.range_of(argument.num) * Range::point(mpq_class(1, argument.scale)), arb_exp));
        generator.value = ring_.value_of(argument);
        if (generator.value) arb_exp(generator.value->get(), generator.value->get(), 256);
        unit.first = ring_.add_generator(std::move(generator));
        exponents_.emplace(unit.first, std::move(argument));
        return;
    }
    std::optional<Ball> sine = ring_.value_of(argument), cosine = sine;
    if (sine) arb_sin_cos(sine->get(), cosine->get(), Ball(*sine).get(), 256);
    unit.first = ring_.add_generator({"sin(" + inner.text + ")",
                                      angle_range(argument, true),
                                      0,
                                      {},
                                      -1,
                                      true,
                                      sine,
                                      call_of(Function::sin, {inner.tree})});
    unit.second = ring_.add_generator({"cos(" + inner.text + ")",
                                       angle_range(argument, false),
                                       0,
                                       {},
                                       static_cast<int>(unit.first),
                                       false,
                                       cosine,
                                       call_of(Function::cos, {inner.tree})});
    Polynomial relation = constant_polynomial(1);
    relation = add_scaled(relation, generator_polynomial(unit.second, 2), -1, ring_.work());
    ring_.set_relation(unit.first, 2, std::move(relation));
}

mpz_class Elementary::multiple_of_unit(std::map<std::string, Unit>& units, const Part& part, bool angle)
{
    const auto [at, fresh] = units.try_emplace(key_of(part.atom));
    Unit& unit = at->second;
    mpq_class quotient = fresh ? mpq_class(0) : mpq_class(part.coefficient / unit.size);
    if (fresh || quotient.get_den() != 1) {
        refined_ = refined_ || !fresh;
        unit.size = fresh ? mpq_class(abs(part.coefficient)) : common_divisor(unit.size, part.coefficient);
        make_generators(unit, part.atom, angle);
        quotient = part.coefficient / unit.size;
    }
    return quotient.get_num();
}

Elementary::SineCosine Elementary::sum(const SineCosine& a, const SineCosine& b)
{
    return {ring_.add(ring_.times(a.sine, b.cosine), ring_.times(a.cosine, b.sine)),
            ring_.add(ring_.times(a.cosine, b.cosine), ring_.times(a.sine, b.sine), -1)};
}

Elementary::SineCosine Elementary::multiple_angle(const Unit& unit, const mpz_class& multiple)
{
    return multiple_angle({ring_.of(unit.first), ring_.of(unit.second)}, multiple, ring_.generator(unit.first).text);
}

Elementary::SineCosine Elementary::multiple_angle(SineCosine square, const mpz_class& multiple, const std::string& text)
{
    if (abs(multiple) > largest_multiple)
        throw BudgetExhausted("the angle " + multiple.get_str() + " times " + text + " exceeds the multiple " +
                              std::to_string(largest_multiple));
    const auto count = static_cast<unsigned>(mpz_class(abs(multiple)).get_ui());
    SineCosine result{{}, ring_.constant(1)};
    for (unsigned rest = count; rest > 0; rest >>= 1) {
        if (rest & 1U) result = sum(result, square);
        if (rest > 1) square = sum(square, square);
    }
    if (multiple < 0) result.sine = ring_.negate(result.sine);
    return result;
}

Elementary::SineCosine Elementary::pi_angle(const mpq_class& turns)
{
    // turns * pi = quarter * pi/2 + rest * pi, 0 <= rest < 1/2
    mpz_class quarter;
    mpz_fdiv_q(quarter.get_mpz_t(), mpz_class(turns.get_num() * 2).get_mpz_t(), turns.get_den().get_mpz_t());
    const mpq_class rest = turns - mpq_class(quarter) / 2;
    SineCosine value{{}, ring_.constant(1)};
    if (rest != 0 && mpz_class(12) % rest.get_den() == 0) {
        const Fraction half = ring_.constant(mpq_class(1, 2));
        const SineCosine sixth{half, ring_.times(half, number_root(3, 2))};
        const SineCosine fourth{ring_.times(half, number_root(2, 2)), ring_.times(half, number_root(2, 2))};
        const SineCosine third = sum(sixth, sixth);
        const SineCosine minus_sixth{ring_.negate(sixth.sine), sixth.cosine};
        const mpq_class twelfths = rest * 12;
        const SineCosine twelfth = sum(fourth, minus_sixth);
        const SineCosine table[6] = {value, twelfth, sixth, fourth, third, sum(fourth, sixth)};
        value = table[twelfths.get_num().get_ui()];
    } else if (rest != 0) {
        const Part part{rest, pi()};
        const mpz_class multiple = multiple_of_unit(angle_units_, part, true);
        value = multiple_angle(angle_units_.at(key_of(part.atom)), multiple);
    }
    const auto turn = mpz_fdiv_ui(quarter.get_mpz_t(), 4);
    for (unsigned long k = 0; k < turn; ++k) value = {value.cosine, ring_.negate(value.sine)};
    return value;
}

Elementary::SineCosine Elementary::sine_cosine(const Fraction& angle)
{
    SineCosine result{{}, ring_.constant(1)};
    std::vector<Part> all = parts(angle);
    const std::string pi_key = key_of(pi());
    std::vector<Part> generic;
    for (Part& part : all) {
        if (key_of(part.atom) == pi_key) {
            result = sum(result, pi_angle(part.coefficient));
        } else if (const auto known = inverse_values(part)) {
            result = sum(result, *known);
        } else {
            generic.push_back(std::move(part));
        }
    }
    if (angles_ == Angles::whole && generic.size() > 1) {
        Fraction whole;
        for (const Part& part : generic)
            whole = ring_.add(whole, ring_.times(ring_.constant(part.coefficient), part.atom));
        // The number in front is kept in the coefficient, so that a - b and b - a meet in one unit.
        mpq_class number(whole.num[0].coefficient < 0 ? mpz_class(-content(whole.num)) : content(whole.num),
                         whole.scale);
        number.canonicalize();
        generic = {{number, ring_.times(ring_.constant(1 / number), whole)}};
    }
    for (const Part& part : generic) {
        const mpz_class multiple = multiple_of_unit(angle_units_, part, true);
        result = sum(result, multiple_angle(angle_units_.at(key_of(part.atom)), multiple));
    }
    return result;
}

Fraction Elementary::exponential(const Fraction& argument)
{
    Fraction result = ring_.constant(1);
    for (const Part& part : parts(argument)) {
        const Monomial& monomial = part.atom.num[0].monomial;
        const bool single = part.atom.factors.empty() && monomial.size() == 1 && monomial.exponent(0) == 1;
        if (const auto log = single ? logs_.find(monomial.generator(0)) : logs_.end(); log != logs_.end()) {
            // exp(p/q log a) = a^(p/q): log a is defined, so a > 0.
            const mpq_class& c = part.coefficient;
            if (c.get_den() <= 64 && abs(c.get_num()) <= 4096) {
                const Fraction base = ring_.of(log->second);
                const auto degree = static_cast<unsigned>(c.get_den().get_ui());
                const Fraction rooted = degree == 1 ? base : root(base, degree);
                result = ring_.times(result, ring_.power(rooted, static_cast<int>(c.get_num().get_si())));
                continue;
            }
        }
        const mpz_class multiple = multiple_of_unit(exponential_units_, part, false);
        if (abs(multiple) > 0xffff) throw BudgetExhausted("an exponent exceeds 65535");
        const Fraction base = ring_.of(exponential_units_.at(key_of(part.atom)).first);
        result = ring_.times(result, ring_.power(base, static_cast<int>(multiple.get_si())));
    }
    return result;
}

Fraction Elementary::opaque(const std::string& name, const std::vector<Fraction>& arguments)
{
    std::string key = name, text = name + '(';
    std::vector<Tree> trees;
    for (std::size_t k = 0; k < arguments.size(); ++k) {
        key += ':' + key_of(arguments[k]);
        const Printed argument = print(ring_, arguments[k], longest_generator);
        text += (k == 0 ? "" : ", ") + argument.text;
        trees.push_back(argument.tree);
        if (key.size() > 1'000'000) throw BudgetExhausted("an argument is longer than 1000000 characters");
    }
    if (text.size() > 2 * longest_generator) text = name + "(...";
    return ring_.of(ring_.keyed(key, [&] {
        return ring_.add_generator({text + ')', {}, 0, {}, -1, false, std::nullopt, call_of(name, std::move(trees))});
    }));
}

} // namespace lagen::proof
