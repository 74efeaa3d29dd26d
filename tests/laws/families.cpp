// SPDX-License-Identifier: GPL-2.0-or-later
/// Each family from the constructions of local_algebroid.hpp; constraints and domains are made here.
#include "families.hpp"

#include "disguise.hpp"
#include "frames.hpp"
#include "lie_algebras.hpp"
#include "own_kind.hpp"

namespace lagen::laws {
namespace {

const std::vector<FunctionClass> smooth_classes{FunctionClass::polynomial, FunctionClass::rational,
                                                FunctionClass::trigonometric, FunctionClass::exponential};

LocalAlgebroid tangent(std::size_t n)
{
    LocalAlgebroid result(numbered("x", n), numbered("e", n));
    for (std::size_t i = 0; i < n; ++i) result.anchor(i, i) = 1;
    return result;
}

LocalAlgebroid any_action(Dice& dice)
{
    const MatrixAlgebra algebra = matrix_algebra(dice.below(matrix_algebra_count()));
    switch (dice.below(3)) {
    case 0: return linear_action(algebra);
    case 1: return right_action(algebra);
    default: return projective_action(algebra);
    }
}

/// A bundle of Lie algebras, rho = 0, over two coordinates.
LocalAlgebroid algebra_bundle(Dice& dice)
{
    const LocalAlgebroid algebra = random_lie_algebra(dice);
    LocalAlgebroid result(numbered("x", 2), algebra.fibre);
    result.C = algebra.C;
    result.parameters = algebra.parameters;
    return result;
}

LocalAlgebroid small_algebroid(Dice& dice)
{
    switch (dice.below(4)) {
    case 0: return in_random_frame(tangent(2), dice.pick(smooth_classes), dice);
    case 1: return random_lie_algebra(dice);
    case 2: return any_action(dice);
    default: return in_random_frame(algebra_bundle(dice), FunctionClass::polynomial, dice);
    }
}

Specimen random_atiyah(Dice& dice)
{
    LocalAlgebroid structure = dice.below(4) == 0 ? LocalAlgebroid({}, {"z"}) : random_lie_algebra(dice);
    const std::size_t n = structure.r() > 3 ? 1 + dice.below(2) : 1 + dice.below(3), s = structure.r();
    LocalAlgebroid functions(numbered("x", n), {});
    functions.parameters = structure.parameters;
    std::vector<Formula> connection(n * s);
    for (Formula& entry : connection)
        if (dice.below(3) != 0) entry = random_function(functions, dice.pick(smooth_classes), dice);
    LocalAlgebroid result = atiyah(structure, functions.base, connection);
    result.parameters = structure.parameters;
    return {result, structure,
            [=](const LocalAlgebroid& part) { return atiyah_text(part, functions.base, connection); }};
}

/// d/dx^1, .., d/dx^k of R^n through random changes of coordinates: involutive by construction.
LocalAlgebroid distribution(Dice& dice)
{
    const std::size_t n = 3 + dice.below(2), k = 2 + (n > 3 ? dice.below(2) : 0);
    LocalAlgebroid result(numbered("x", n), numbered("e", k));
    for (std::size_t a = 0; a < k; ++a) result.anchor(a, a) = 1;
    for (int count = 0; count < 3; ++count) result = in_random_coordinates(result, dice);
    return in_random_frame(result, dice.pick(smooth_classes), dice);
}

/// The leaves of x^2 + y^2 - z^2: frame (-y, x, 0), (xz, yz, x^2+y^2), or (z, 0, x), (0, z, y) where z != 0.
LocalAlgebroid level(Dice& dice)
{
    LocalAlgebroid result(numbered("x", 3), numbered("e", 2));
    const Formula x = result.coordinate(0), y = result.coordinate(1), z = result.coordinate(2);
    if (dice.flip()) {
        result.rho = {-y, x * z, x, y * z, 0, power(x, 2) + power(y, 2)};
    } else {
        result.rho = {z, 0, 0, z, x, y};
        result.set_bracket(0, 0, 1, -y / z);
        result.set_bracket(1, 0, 1, x / z);
    }
    if (dice.flip()) {
        const Formula a = Formula::variable("a");
        result.parameters = {"a"};
        result.constraints = {power(x, 2) + power(y, 2) - power(z, 2) - a};
        result.solved = {{"x1", call("sqrt", a + power(z, 2) - power(y, 2)), true}};
    }
    return in_random_frame(result, dice.pick(smooth_classes), dice);
}

/// Multiples of a constraint h with rho_a(h) = 0 on M change nothing on M.
void add_multiples(LocalAlgebroid& algebroid, const Formula& h, Dice& dice)
{
    const std::size_t r = algebroid.r();
    for (std::size_t count = 1 + dice.below(3); count > 0; --count) {
        const Formula multiple = h * random_function(algebroid, FunctionClass::polynomial, dice);
        const std::size_t a = dice.below(r), b = r > 1 ? (a + 1 + dice.below(r - 1)) % r : a;
        if (a != b && dice.flip()) {
            algebroid.add_to_bracket(dice.below(r), a, b, multiple);
        } else {
            Formula& entry = algebroid.anchor(dice.below(algebroid.n()), a);
            entry = entry + multiple;
        }
    }
}

/// An action on a level of its invariant quadratic form: spheres, hyperboloids, circles, hyperbolas.
LocalAlgebroid on_quadric(Dice& dice)
{
    static const std::vector<std::size_t> with_form{0, 1, 7, 8, 9};
    const MatrixAlgebra algebra = matrix_algebra(dice.pick(with_form));
    LocalAlgebroid result = linear_action(algebra);
    Formula rest, level_value(1);
    if (dice.flip()) {
        result.parameters = {"a"};
        level_value = Formula::variable("a");
    }
    for (std::size_t i = 1; i < result.n(); ++i)
        rest = rest + Formula(algebra.invariant[i]) * power(result.coordinate(i), 2);
    const Formula h = power(result.coordinate(0), 2) + rest - level_value;
    result.constraints = {h};
    result.solved = {{result.base[0], call("sqrt", level_value - rest), true}};
    if (dice.flip()) result = in_random_frame(result, FunctionClass::polynomial, dice);
    add_multiples(result, h, dice);
    return result;
}

/// A small algebroid carried to the graph z = f(x).
LocalAlgebroid on_graph(Dice& dice)
{
    LocalAlgebroid flat = dice.flip() ? in_random_frame(tangent(2), dice.pick(smooth_classes), dice)
                                      : linear_action(matrix_algebra(dice.below(7)));
    const Formula f = random_function(flat, dice.pick(smooth_classes), dice);
    std::vector<std::string> base = flat.base;
    base.emplace_back("z");
    LocalAlgebroid result(base, flat.fibre);
    for (std::size_t a = 0; a < flat.r(); ++a) {
        for (std::size_t i = 0; i < flat.n(); ++i) result.anchor(i, a) = flat.anchor(i, a);
        result.anchor(flat.n(), a) = flat.along(a, f);
    }
    result.C = flat.C;
    const Formula h = Formula::variable("z") - f;
    result.constraints = {h};
    result.solved = {{"z", f, false}};
    add_multiples(result, h, dice);
    return result;
}

/// Coordinates that are positive, frames with their roots and logarithms, and identities that need the signs.
LocalAlgebroid with_domain(Dice& dice)
{
    LocalAlgebroid result = dice.flip() ? tangent(2) : linear_action(matrix_algebra(2 + dice.below(2)));
    for (std::size_t i = 0; i < result.n(); ++i) result.positive.push_back(result.coordinate(i));
    result = in_random_frame(result, FunctionClass::positive_roots, dice);
    return disguised(result, true, dice);
}

/// A random frame of an algebroid, in the notation of `frame` too.
Specimen framed(const LocalAlgebroid& inner, FunctionClass kind, Dice& dice)
{
    const Frame frame = random_frame(inner, kind, dice);
    return {in_frame(inner, frame), inner, [=](const LocalAlgebroid& part) { return frame_text(part, frame); }};
}

Specimen prolonged(const LocalAlgebroid& inner, bool dual)
{
    return {prolongation(inner, dual), inner,
            [=](const LocalAlgebroid& part) { return prolongation_text(part, dual); }};
}

/// C is solved for, so that a change of the given C is none of the model.
Specimen spanned(const LocalAlgebroid& algebroid)
{
    return {algebroid, algebroid, subbundle_text, false};
}

Specimen of_algebra(const LocalAlgebroid& algebra)
{
    return {algebra, algebra, lie_algebra_text};
}

Specimen represented(Dice& dice)
{
    const MatrixAlgebra algebra = matrix_algebra(dice.below(matrix_algebra_count()));
    const LocalAlgebroid result = linear_action(algebra);
    return {result, result, [=](const LocalAlgebroid& part) { return representation_text(algebra, part); }, false};
}

Specimen plain(LocalAlgebroid algebroid)
{
    return {std::move(algebroid), {}, {}};
}

} // namespace

const std::vector<AlgebroidFamily>& algebroid_families()
{
    using enum FunctionClass;
    static const std::vector<AlgebroidFamily> families{
        {"Lie algebra", [](Dice& d) { return of_algebra(in_random_frame(random_lie_algebra(d), constant, d)); }},
        {"representation", represented},
        {"action",
         [](Dice& d) { return plain(in_random_coordinates(in_random_frame(any_action(d), constant, d), d)); }},
        {"TM, frame", [](Dice& d) { return framed(tangent(2 + d.below(3)), d.pick(smooth_classes), d); }},
        {"TM, two frames",
         [](Dice& d) { return plain(in_random_frame(tangent(2 + d.below(3)), d.pick(smooth_classes), d)); }},
        {"action, frame", [](Dice& d) { return framed(any_action(d), d.pick(smooth_classes), d); }},
        {"bundle of algebras", [](Dice& d) { return framed(algebra_bundle(d), d.pick(smooth_classes), d); }},
        {"full frame",
         [](Dice& d) { return plain(in_full_frame(d.flip() ? tangent(2 + d.below(2)) : any_action(d), d)); }},
        {"Atiyah", random_atiyah},
        {"Atiyah, frame", [](Dice& d) { return framed(random_atiyah(d).algebroid, polynomial, d); }},
        {"product", [](Dice& d) { return plain(direct_product(small_algebroid(d), small_algebroid(d))); }},
        {"prolongation", [](Dice& d) { return prolonged(small_algebroid(d), d.flip()); }},
        {"subbundle", [](Dice& d) { return spanned(distribution(d)); }},
        {"level", [](Dice& d) { return plain(level(d)); }},
        {"on a quadric", [](Dice& d) { return plain(on_quadric(d)); }},
        {"on a graph", [](Dice& d) { return plain(on_graph(d)); }},
        {"domain", [](Dice& d) { return plain(with_domain(d)); }},
        {"identities", [](Dice& d) { return plain(disguised(small_algebroid(d), false, d)); }},
    };
    return families;
}

} // namespace lagen::laws
