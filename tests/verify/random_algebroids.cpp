// SPDX-License-Identifier: GPL-2.0-or-later
/// Families of Lie algebroids from matrix commutators, coordinate fields and the change-of-frame formula.
#include "verify/random_algebroids.hpp"

#include <algorithm>

namespace lagen::oracle {
namespace {

using Matrix = std::vector<mpq_class>; ///< m x m by rows

Matrix product(const Matrix& a, const Matrix& b, std::size_t m)
{
    Matrix result(m * m);
    for (std::size_t i = 0; i < m; ++i)
        for (std::size_t j = 0; j < m; ++j)
            for (std::size_t l = 0; l < m; ++l) result[i * m + j] += a[i * m + l] * b[l * m + j];
    return result;
}

/// Coordinates of `target` in a basis whose matrices are found by elimination of (basis^T | target).
std::vector<mpq_class> coordinates_of(const std::vector<Matrix>& basis, const Matrix& target)
{
    const std::size_t r = basis.size();
    std::vector<std::vector<mpq_class>> rows;
    for (std::size_t entry = 0; entry < target.size(); ++entry) {
        std::vector<mpq_class> row;
        for (const Matrix& element : basis) row.push_back(element[entry]);
        row.push_back(target[entry]);
        rows.push_back(std::move(row));
    }
    for (std::size_t column = 0; column < r; ++column) {
        std::size_t pivot = column;
        while (rows[pivot][column] == 0) ++pivot;
        std::swap(rows[pivot], rows[column]);
        for (std::size_t row = 0; row < rows.size(); ++row) {
            if (row == column) continue;
            const mpq_class factor = rows[row][column] / rows[column][column];
            for (std::size_t k_ = 0; k_ <= r; ++k_) rows[row][k_] -= factor * rows[column][k_];
        }
    }
    std::vector<mpq_class> result;
    for (std::size_t a = 0; a < r; ++a) result.push_back(rows[a][r] / rows[a][a]);
    return result;
}

Matrix matrix(std::size_t m, std::initializer_list<std::array<int, 3>> entries)
{
    Matrix result(m * m);
    for (const auto& [i, j, value] : entries)
        result[static_cast<std::size_t>(i) * m + static_cast<std::size_t>(j)] = value;
    return result;
}

std::vector<Matrix> matrix_algebra(std::size_t number, std::size_t& m)
{
    m = number % 5 < 3 ? 3 : 2;
    switch (number % 5) {
    case 0:
        return {matrix(3, {{{2, 1, 1}}, {{1, 2, -1}}}), matrix(3, {{{0, 2, 1}}, {{2, 0, -1}}}),
                matrix(3, {{{1, 0, 1}}, {{0, 1, -1}}})};
    case 1:
        return {matrix(3, {{{0, 1, 1}}}), matrix(3, {{{1, 2, 1}}}), matrix(3, {{{0, 2, 1}}}),
                matrix(3, {{{0, 0, 1}}, {{2, 2, -1}}})};
    case 2: return {matrix(3, {{{1, 0, 1}}, {{0, 1, -1}}}), matrix(3, {{{0, 2, 1}}}), matrix(3, {{{1, 2, 1}}})};
    case 3:
        return {matrix(2, {{{0, 0, 1}}}), matrix(2, {{{0, 1, 1}}}), matrix(2, {{{1, 0, 1}}}), matrix(2, {{{1, 1, 1}}})};
    default: return {matrix(2, {{{0, 0, 1}}, {{1, 1, -1}}}), matrix(2, {{{0, 1, 1}}}), matrix(2, {{{1, 0, 1}}})};
    }
}

/// A matrix algebra in a random constant basis (unipotent change of the matrices themselves, so that C comes from
/// their commutators alone); with `acts`, rho_a = -(A_a x)^i d/dx^i on R^m.
RandomAlgebroid from_matrices(std::size_t number, bool acts, Dice& dice)
{
    std::size_t m = 0;
    std::vector<Matrix> basis = matrix_algebra(number, m);
    const std::size_t r = basis.size();
    for (std::size_t a = 0; a < r; ++a)
        for (std::size_t b = 0; b < a; ++b) {
            const mpq_class factor(dice.signed_digit(3), static_cast<long>(dice.below(3)) + 1);
            for (std::size_t e = 0; e < m * m; ++e) basis[a][e] += factor * basis[b][e];
        }
    for (Matrix& element : basis)
        for (mpq_class& e : element) e.canonicalize();
    RandomAlgebroid result{acts ? m : 0, r, {}, std::vector<Quotient>(r * r * r)};
    result.rho.resize(result.n * r);
    for (std::size_t a = 0; a < r; ++a)
        for (std::size_t b = 0; b < r; ++b) {
            Matrix commutator = product(basis[a], basis[b], m);
            const Matrix back = product(basis[b], basis[a], m);
            for (std::size_t e = 0; e < m * m; ++e) commutator[e] -= back[e];
            const std::vector<mpq_class> constants = coordinates_of(basis, commutator);
            for (std::size_t c_ = 0; c_ < r; ++c_) result.bracket(c_, a, b) = Quotient(Polynomial(constants[c_]));
        }
    for (std::size_t a = 0; a < r; ++a)
        for (std::size_t i = 0; i < result.n; ++i)
            for (std::size_t j = 0; j < result.n; ++j)
                result.anchor(i, a) =
                    result.anchor(i, a) + Quotient(Polynomial(-basis[a][i * m + j]) * Polynomial::of(Variable(j)));
    return result;
}

/// T R^3, or with `kernel` T R^2 x R: a third section without anchor, [e_1, e_2] = g e_3 with any g(x, y).
RandomAlgebroid coordinate_fields(bool kernel, Dice& dice)
{
    RandomAlgebroid result{kernel ? 2U : 3U, 3, {}, std::vector<Quotient>(27)};
    result.rho.resize(result.n * 3);
    for (std::size_t i = 0; i < result.n; ++i) result.anchor(i, i) = 1;
    if (!kernel) return result;
    const Polynomial g = Polynomial(dice.signed_digit(4)) * Polynomial::of(x) * Polynomial::of(y) + Polynomial::of(k);
    result.bracket(2, 0, 1) = g;
    result.bracket(2, 1, 0) = Polynomial(-1) * g;
    return result;
}

struct FrameChange {
    std::vector<Quotient> A, inverse; ///< (r, r) by rows; A[a * r + b] = A_a^b
};

Polynomial random_monomial(Dice& dice, std::size_t n)
{
    Polynomial result(dice.signed_digit(3));
    for (std::size_t factor = dice.below(3); factor > 0 && n > 0; --factor)
        result = result * Polynomial::of(Variable(dice.below(n)));
    if (dice.below(4) == 0) result = result * Polynomial::of(k);
    return result;
}

FrameChange identity(std::size_t r)
{
    FrameChange change{std::vector<Quotient>(r * r), std::vector<Quotient>(r * r)};
    for (std::size_t a = 0; a < r; ++a) change.A[a * r + a] = change.inverse[a * r + a] = 1;
    return change;
}

/// e'_a = e_a + f e_b: its inverse has -f.
FrameChange shear(std::size_t r, std::size_t n, Dice& dice)
{
    FrameChange change = identity(r);
    const std::size_t a = dice.below(r);
    const std::size_t b = (a + 1 + dice.below(r - 1)) % r;
    const Polynomial f = random_monomial(dice, n);
    change.A[a * r + b] = f;
    change.inverse[a * r + b] = Polynomial(-1) * f;
    return change;
}

/// e'_a = q e_a with q = 1/(1 + x^2 + ..) or its inverse.
FrameChange stretch(std::size_t r, std::size_t n, Dice& dice)
{
    FrameChange change = identity(r);
    const std::size_t a = dice.below(r);
    const Polynomial f = random_monomial(dice, n);
    const Polynomial q = Polynomial(1) + f * f;
    change.A[a * r + a] = dice.below(2) == 0 ? Quotient(q) : Quotient(1, q);
    change.inverse[a * r + a] = Quotient(change.A[a * r + a].denominator, change.A[a * r + a].numerator);
    return change;
}

/// Rotation by z in the plane of two sections; z is a base coordinate (n = 3).
FrameChange rotation(std::size_t r, Dice& dice)
{
    FrameChange change = identity(r);
    const std::size_t a = dice.below(r);
    const std::size_t b = (a + 1 + dice.below(r - 1)) % r;
    const Polynomial cosine = Polynomial::of(c), sine = Polynomial::of(s), minus = Polynomial(-1) * sine;
    for (std::vector<Quotient>* m : {&change.A, &change.inverse}) {
        (*m)[a * r + a] = (*m)[b * r + b] = cosine;
        (*m)[a * r + b] = m == &change.A ? sine : minus;
        (*m)[b * r + a] = m == &change.A ? minus : sine;
    }
    return change;
}

/// rho'^i_a = A_a^b rho^i_b,
/// C'^c_ab = (A^-1)_d^c [ A_a^p A_b^q C^d_pq + A_a^p rho_p(A_b^d) - A_b^p rho_p(A_a^d) ]
RandomAlgebroid in_frame(const RandomAlgebroid& old, const FrameChange& change)
{
    const std::size_t n = old.n, r = old.r;
    RandomAlgebroid result = old;
    const auto A = [&](std::size_t a, std::size_t b) -> const Quotient& { return change.A[a * r + b]; };
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t a = 0; a < r; ++a) {
            result.anchor(i, a) = Quotient();
            for (std::size_t b = 0; b < r; ++b) result.anchor(i, a) = result.anchor(i, a) + A(a, b) * old.anchor(i, b);
        }
    for (std::size_t a = 0; a < r; ++a)
        for (std::size_t b = 0; b < r; ++b) {
            std::vector<Quotient> inner(r);
            for (std::size_t d = 0; d < r; ++d) {
                for (std::size_t p = 0; p < r; ++p)
                    for (std::size_t q = 0; q < r; ++q) inner[d] = inner[d] + A(a, p) * A(b, q) * old.bracket(d, p, q);
                for (std::size_t i = 0; i < n; ++i) {
                    inner[d] = inner[d] + result.anchor(i, a) * A(b, d).derivative(Variable(i));
                    inner[d] = inner[d] - result.anchor(i, b) * A(a, d).derivative(Variable(i));
                }
            }
            for (std::size_t c_ = 0; c_ < r; ++c_) {
                result.bracket(c_, a, b) = Quotient();
                for (std::size_t d = 0; d < r; ++d)
                    result.bracket(c_, a, b) = result.bracket(c_, a, b) + change.inverse[d * r + c_] * inner[d];
            }
        }
    return result;
}

/// x^2 + y^2 + z^2 - level
Polynomial sphere_equation(int level)
{
    Polynomial h(-level);
    for (const Variable v : {x, y, z}) h = h + Polynomial::of(v) * Polynomial::of(v);
    return h;
}

void add_to_bracket(RandomAlgebroid& algebroid, std::size_t c_, std::size_t a, std::size_t b, const Quotient& more)
{
    algebroid.bracket(c_, a, b) = algebroid.bracket(c_, a, b) + more;
    algebroid.bracket(c_, b, a) = algebroid.bracket(c_, b, a) - more;
}

/// The rotations on the sphere, with multiples of its equation added to rho and C.
RandomAlgebroid on_sphere(Dice& dice)
{
    RandomAlgebroid result = from_matrices(0, true, dice);
    result.on_sphere = true;
    for (int count = 0; count < 2; ++count) {
        const std::size_t a = dice.below(3);
        add_to_bracket(result, dice.below(3), a, (a + 1 + dice.below(2)) % 3,
                       sphere_equation(1) * random_monomial(dice, 3));
        Quotient& entry = result.anchor(dice.below(3), dice.below(3));
        entry = entry + Quotient(sphere_equation(1) * random_monomial(dice, 3));
    }
    return result;
}

mpq_class random_value(Dice& dice)
{
    mpq_class value(dice.signed_digit(9), static_cast<long>(dice.below(7)) + 1);
    value.canonicalize();
    return value;
}

Point random_point(bool on_sphere, Dice& dice)
{
    Point point;
    for (mpq_class& value : point) value = random_value(dice);
    const mpq_class t = random_value(dice), u = random_value(dice), v = random_value(dice);
    point[s] = 2 * t / (1 + t * t);
    point[c] = (1 - t * t) / (1 + t * t);
    if (!on_sphere) return point;
    const mpq_class below = 1 + u * u + v * v;
    point[x] = 2 * u / below;
    point[y] = 2 * v / below;
    point[z] = (below - 2) / below;
    return point;
}

/// rho_a(f) at a point
mpq_class along_anchor(const RandomAlgebroid& algebroid, std::size_t a, const Quotient& f, const Point& point)
{
    mpq_class sum;
    for (std::size_t i = 0; i < algebroid.n; ++i)
        sum += algebroid.anchor(i, a).at(point) * f.derivative(Variable(i)).at(point);
    return sum;
}

bool holds_at(const RandomAlgebroid& algebroid, const Point& point)
{
    const std::size_t n = algebroid.n, r = algebroid.r;
    for (std::size_t a = 0; a < r; ++a) {
        if (algebroid.on_sphere && along_anchor(algebroid, a, sphere_equation(1), point) != 0) return false;
        for (std::size_t b = a + 1; b < r; ++b)
            for (std::size_t i = 0; i < n; ++i) {
                mpq_class residual = along_anchor(algebroid, a, algebroid.anchor(i, b), point) -
                                     along_anchor(algebroid, b, algebroid.anchor(i, a), point);
                for (std::size_t c_ = 0; c_ < r; ++c_)
                    residual -= algebroid.anchor(i, c_).at(point) * algebroid.bracket(c_, a, b).at(point);
                if (residual != 0) return false;
            }
    }
    std::vector<mpq_class> C;
    for (const Quotient& entry : algebroid.C) C.push_back(entry.at(point));
    for (std::size_t a = 0; a < r; ++a)
        for (std::size_t b = a + 1; b < r; ++b)
            for (std::size_t d = b + 1; d < r; ++d)
                for (std::size_t v = 0; v < r; ++v) {
                    mpq_class residual;
                    const std::size_t cycles[3][3] = {{a, b, d}, {b, d, a}, {d, a, b}};
                    for (const auto& [p, q, w] : cycles) {
                        residual += along_anchor(algebroid, p, algebroid.bracket(v, q, w), point);
                        for (std::size_t m = 0; m < r; ++m) residual += C[(m * r + q) * r + w] * C[(v * r + p) * r + m];
                    }
                    if (residual != 0) return false;
                }
    return true;
}

} // namespace

RandomAlgebroid random_algebroid(std::size_t number, Dice& dice)
{
    const std::size_t family = number % 5;
    if (family == 4) return on_sphere(dice);
    RandomAlgebroid result = family == 0   ? from_matrices(number / 5, false, dice)
                             : family == 1 ? from_matrices(number / 5, true, dice)
                                           : coordinate_fields(family == 3, dice);
    result = in_frame(result, shear(result.r, result.n, dice));
    if (dice.below(2) == 0) result = in_frame(result, stretch(result.r, result.n, dice));
    if (result.n == 3 && dice.below(3) == 0) result = in_frame(result, rotation(result.r, dice));
    return result;
}

std::string model_text(const RandomAlgebroid& algebroid)
{
    static constexpr const char* names[] = {"x", "y", "z"};
    std::string text = "[parameters]\nk = 1\n";
    if (algebroid.n > 0) {
        text += "[base]\ncoordinates = [";
        for (std::size_t i = 0; i < algebroid.n; ++i) text += (i == 0 ? "\"" : ", \"") + std::string(names[i]) + "\"";
        text += "]\n";
        if (algebroid.on_sphere) text += "constraints = [\"x^2 + y^2 + z^2 - 1\"]\n";
    }
    text += "[fibre]\ncoordinates = [";
    for (std::size_t a = 0; a < algebroid.r; ++a) text += (a == 0 ? "\"w" : ", \"w") + std::to_string(a) + "\"";
    text += "]\n[algebroid]\n";
    for (std::size_t a = 0; a < algebroid.r; ++a)
        for (std::size_t i = 0; i < algebroid.n; ++i)
            if (!algebroid.anchor(i, a).is_zero())
                text +=
                    "anchor.w" + std::to_string(a) + "." + names[i] + " = \"" + algebroid.anchor(i, a).text() + "\"\n";
    for (std::size_t a = 0; a < algebroid.r; ++a)
        for (std::size_t b = a + 1; b < algebroid.r; ++b)
            for (std::size_t c_ = 0; c_ < algebroid.r; ++c_)
                if (!algebroid.bracket(c_, a, b).is_zero())
                    text += "bracket.\"w" + std::to_string(a) + ",w" + std::to_string(b) + "\".w" + std::to_string(c_) +
                            " = \"" + algebroid.bracket(c_, a, b).text() + "\"\n";
    return text;
}

bool holds_at_points(const RandomAlgebroid& algebroid, Dice& dice)
{
    for (int count = 0; count < 3; ++count)
        if (!holds_at(algebroid, random_point(algebroid.on_sphere, dice))) return false;
    return true;
}

RandomAlgebroid mutated(const RandomAlgebroid& algebroid, Dice& dice)
{
    RandomAlgebroid result = algebroid;
    const std::size_t r = algebroid.r, a = dice.below(r), b = (a + 1 + dice.below(r - 1)) % r, c_ = dice.below(r);
    const bool in_anchor = algebroid.n > 0 && dice.below(3) == 0;
    const std::size_t i = algebroid.n > 0 ? dice.below(algebroid.n) : 0;
    const Quotient entry = in_anchor ? algebroid.anchor(i, a) : algebroid.bracket(c_, a, b);
    const mpz_class ten13("10000000000000"), ten15("1000000000000000");
    Quotient change;
    switch (dice.below(entry.is_zero() ? 2 : 5)) {
    case 0: change = Quotient(Polynomial(mpq_class(1, ten15))); break;
    case 1:
        change =
            Quotient((algebroid.n == 3 ? sphere_equation(2) : Polynomial::of(k)) * random_monomial(dice, algebroid.n));
        break;
    case 2: change = Quotient(-2) * entry; break;
    case 3: change = Quotient(Polynomial(mpq_class(1, ten13))) * entry; break;
    default: change = Quotient(Polynomial::of(k) - Polynomial(1)) * entry; break;
    }
    if (in_anchor)
        result.anchor(i, a) = entry + change;
    else
        add_to_bracket(result, c_, a, b, change);
    return result;
}

} // namespace lagen::oracle
