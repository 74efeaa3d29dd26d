// SPDX-License-Identifier: GPL-2.0-or-later
#include "random_morphism.hpp"

#include "lie_algebras.hpp"
#include "own_kind.hpp"

namespace lagen::laws {

namespace {

const std::vector<FunctionClass> rational_classes{FunctionClass::polynomial, FunctionClass::rational};

LocalAlgebroid plain_tangent(std::size_t n)
{
    LocalAlgebroid result(numbered("x", n), numbered("e", n));
    for (std::size_t i = 0; i < n; ++i) result.anchor(i, i) = 1;
    return result;
}

LocalAlgebroid rational_algebroid(Dice& dice)
{
    switch (dice.below(4)) {
    case 0: return in_random_frame(plain_tangent(2 + dice.below(2)), dice.pick(rational_classes), dice);
    case 1: return random_lie_algebra(dice);
    case 2: return linear_action(matrix_algebra(dice.below(matrix_algebra_count())));
    default: return in_random_frame(right_action(matrix_algebra(dice.below(7))), FunctionClass::polynomial, dice);
    }
}

/// The identity of an algebroid.
RandomMorphism identity_of(const char* sort, const LocalAlgebroid& algebroid)
{
    RandomMorphism result{sort, algebroid, algebroid, "", {}, std::vector<Formula>(algebroid.r() * algebroid.r())};
    for (std::size_t i = 0; i < algebroid.n(); ++i) result.base.push_back(algebroid.coordinate(i));
    for (std::size_t a = 0; a < algebroid.r(); ++a) result.entry(a, a) = 1;
    return result;
}

/// The source in the frame e'_c = A_c^b e_b: y^b = A_c^b y'^c.
void change_source_frame(RandomMorphism& morphism, const Frame& frame)
{
    const std::size_t r = morphism.source.r();
    std::vector<Formula> Phi(morphism.Phi.size());
    for (std::size_t a = 0; a < morphism.target.r(); ++a)
        for (std::size_t c = 0; c < r; ++c)
            for (std::size_t b = 0; b < r; ++b)
                Phi[a * r + c] = Phi[a * r + c] + morphism.entry(a, b) * frame.A[c * r + b];
    morphism.Phi = Phi;
    morphism.source = in_frame(morphism.source, frame);
}

/// The target in a constant frame: y'^a = (A^-1)_b^a y^b.
void change_target_frame(RandomMorphism& morphism, const Frame& frame)
{
    const std::size_t r = morphism.source.r(), s = morphism.target.r();
    std::vector<Formula> Phi(morphism.Phi.size());
    for (std::size_t a = 0; a < s; ++a)
        for (std::size_t c = 0; c < r; ++c)
            for (std::size_t b = 0; b < s; ++b)
                Phi[a * r + c] = Phi[a * r + c] + frame.inverse[b * s + a] * morphism.entry(b, c);
    morphism.Phi = Phi;
    morphism.target = in_frame(morphism.target, frame);
}

/// One coordinate of the source becomes c x^i + d (x^j)^2.
void change_source_coordinate(RandomMorphism& morphism, Dice& dice)
{
    const std::size_t n = morphism.source.n();
    if (n < 2) return;
    const std::size_t i = dice.below(n), j = (i + 1 + dice.below(n - 1)) % n;
    const Formula x = morphism.source.coordinate(i), y = morphism.source.coordinate(j);
    const Formula c(dice.signed_digit(2)), d(dice.signed_digit(2));
    const Formula backward = (x - d * power(y, 2)) / c;
    const std::map<std::string, Formula> old{{morphism.source.base[i], backward}};
    for (std::vector<Formula>* list : {&morphism.base, &morphism.Phi})
        for (Formula& each : *list) each = substitute(each, old);
    morphism.source = in_coordinate(morphism.source, i, c * x + d * power(y, 2), backward);
}

/// e'_a -> e_b of the frame, in the notation of `frame`.
RandomMorphism change_of_frame(Dice& dice)
{
    RandomMorphism result = identity_of("frame", rational_algebroid(dice));
    const Frame frame = random_frame(result.target, dice.pick(rational_classes), dice);
    change_source_frame(result, frame);
    result.source.fibre = numbered("f", result.source.r());
    result.source_text = frame_text(result.target, frame);
    return result;
}

/// k + V, V = R^m with [e_a, v_i] = (A_a)_ji v_j.
LocalAlgebroid semidirect(const MatrixAlgebra& algebra)
{
    const LocalAlgebroid& k = algebra.algebroid;
    const std::size_t r = k.r(), m = algebra.m;
    LocalAlgebroid result({}, numbered("e", r + m));
    for (std::size_t a = 0; a < r; ++a)
        for (std::size_t b = a + 1; b < r; ++b)
            for (std::size_t c = 0; c < r; ++c) result.set_bracket(c, a, b, k.bracket(c, a, b));
    for (std::size_t a = 0; a < r; ++a)
        for (std::size_t i = 0; i < m; ++i)
            for (std::size_t j = 0; j < m; ++j) result.set_bracket(r + j, a, r + i, algebra.basis[a][j * m + i]);
    return result;
}

/// On R^m: linearly by k, and of V as `translations` or not at all.
LocalAlgebroid acting(const MatrixAlgebra& algebra, const LocalAlgebroid& sum, bool translations)
{
    const LocalAlgebroid linear = linear_action(algebra);
    LocalAlgebroid result(linear.base, sum.fibre);
    result.C = sum.C;
    for (std::size_t i = 0; i < result.n(); ++i) {
        for (std::size_t a = 0; a < linear.r(); ++a) result.anchor(i, a) = linear.anchor(i, a);
        if (translations) result.anchor(i, linear.r() + i) = -1;
    }
    return result;
}

/// R^n with a new central element z: [e_i, e_j] = w_ij z.
LocalAlgebroid central_extension(std::size_t n, Dice& dice)
{
    LocalAlgebroid result({}, numbered("e", n + 1));
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = i + 1; j < n; ++j) result.set_bracket(n, i, j, dice.signed_digit(3));
    return result;
}

/// The quotient by the last sections, which span an ideal; base coordinates are kept or forgotten.
RandomMorphism quotient(const char* sort, const LocalAlgebroid& source, const LocalAlgebroid& target)
{
    RandomMorphism result{sort, source, target, "", {}, std::vector<Formula>(target.r() * source.r())};
    for (std::size_t a = 0; a < target.r(); ++a) result.entry(a, a) = 1;
    for (std::size_t i = 0; i < target.n(); ++i) result.base.push_back(source.coordinate(i));
    return result;
}

RandomMorphism quotient_by_ideal(Dice& dice)
{
    RandomMorphism result;
    if (dice.below(4) == 0) {
        const std::size_t n = 2 + dice.below(2);
        result = quotient("ideal", central_extension(n, dice), LocalAlgebroid({}, numbered("e", n)));
    } else {
        const MatrixAlgebra algebra = matrix_algebra(dice.below(8));
        const LocalAlgebroid sum = semidirect(algebra);
        switch (dice.below(3)) {
        case 0: result = quotient("ideal", sum, algebra.algebroid); break;
        case 1: result = quotient("ideal", acting(algebra, sum, false), linear_action(algebra)); break;
        default: result = quotient("ideal", acting(algebra, sum, true), algebra.algebroid); break;
        }
    }
    for (int k = 0; k < 3; ++k) change_source_frame(result, random_frame(result.source, FunctionClass::constant, dice));
    for (int k = 0; k < 2; ++k) change_target_frame(result, random_frame(result.target, FunctionClass::constant, dice));
    if (result.source.n() > 0)
        change_source_frame(result, random_frame(result.source, dice.pick(rational_classes), dice));
    return result;
}

RandomMorphism projection(Dice& dice)
{
    const LocalAlgebroid one = rational_algebroid(dice), two = rational_algebroid(dice);
    // Base and sections of the product begin with those of the first; its parameters keep their names.
    RandomMorphism result = quotient("projection", direct_product(one, two), one);
    change_source_coordinate(result, dice);
    change_source_frame(result, random_frame(result.source, FunctionClass::polynomial, dice));
    return result;
}

/// The function of the target at base(x).
Formula moved(const RandomMorphism& morphism, const Formula& function)
{
    std::map<std::string, Formula> values;
    for (std::size_t i = 0; i < morphism.target.n(); ++i) values.emplace(morphism.target.base[i], morphism.base[i]);
    return substitute(function, values);
}

} // namespace

RandomMorphism random_morphism(std::size_t number, Dice& dice)
{
    switch (number % 3) {
    case 0: return change_of_frame(dice);
    case 1: return quotient_by_ideal(dice);
    default: return projection(dice);
    }
}

std::string mutate(RandomMorphism& morphism, Dice& dice)
{
    const LocalAlgebroid& E = morphism.source;
    if (!morphism.base.empty() && dice.below(5) == 0) {
        Formula& entry = morphism.base[dice.below(morphism.base.size())];
        entry = entry + Formula(mpq_class(dice.signed_digit(3), dice.flip() ? 3 : 1'000'000)) * E.coordinate(0);
        return "base map";
    }
    Formula& entry = morphism.Phi[dice.below(morphism.Phi.size())];
    switch (dice.below(entry.is_zero() ? 3 : 5)) {
    case 0: entry = entry + Formula(mpq_class(dice.signed_digit(4), 5)); return "constant";
    case 1: entry = entry + Formula(mpq_class(1, 1'000'000'000)); return "1e-9";
    case 2:
        entry = entry + Formula(dice.signed_digit(2)) * (E.n() > 0 ? E.coordinate(dice.below(E.n())) : Formula(1));
        return "extra term";
    case 3: entry = -entry; return "sign";
    default: entry = Formula(); return "missing entry";
    }
}

std::vector<Formula> morphism_residuals(const RandomMorphism& morphism)
{
    const LocalAlgebroid &E = morphism.source, &F = morphism.target;
    std::vector<Formula> list;
    for (std::size_t b = 0; b < E.r(); ++b)
        for (std::size_t i = 0; i < F.n(); ++i) {
            Formula sum = -E.along(b, morphism.base[i]);
            for (std::size_t c = 0; c < F.r(); ++c) sum = sum + moved(morphism, F.anchor(i, c)) * morphism.entry(c, b);
            list.push_back(sum);
        }
    for (std::size_t b = 0; b < E.r(); ++b)
        for (std::size_t c = b + 1; c < E.r(); ++c)
            for (std::size_t a = 0; a < F.r(); ++a) {
                Formula sum = E.along(b, morphism.entry(a, c)) - E.along(c, morphism.entry(a, b));
                for (std::size_t d = 0; d < E.r(); ++d) sum = sum - morphism.entry(a, d) * E.bracket(d, b, c);
                for (std::size_t d = 0; d < F.r(); ++d)
                    for (std::size_t e = 0; e < F.r(); ++e)
                        if (!F.bracket(a, d, e).is_zero())
                            sum =
                                sum + moved(morphism, F.bracket(a, d, e)) * morphism.entry(d, b) * morphism.entry(e, c);
                list.push_back(sum);
            }
    return list;
}

Truth truth_of(const RandomMorphism& morphism, Dice& dice, std::size_t points)
{
    const std::vector<Formula> residuals = morphism_residuals(morphism);
    for (std::size_t k = 0; k < points; ++k) {
        std::map<std::string, Formula> point;
        for (const auto* names : {&morphism.source.base, &morphism.source.parameters, &morphism.target.parameters})
            for (const std::string& name : *names) point.emplace(name, dice.rational());
        for (const Formula& residual : residuals) {
            const Formula value = substitute(residual, point);
            if (value.node().kind != FormulaKind::number) return Truth::unknown;
            if (!value.is_zero()) return Truth::violated;
        }
    }
    return Truth::holds;
}

} // namespace lagen::laws
