// SPDX-License-Identifier: GPL-2.0-or-later
/// Constants of matrix algebras come from commutators and elimination, not from a table.
#include "lie_algebras.hpp"

#include <array>
#include <stdexcept>

namespace lagen::laws {
namespace {

using Matrix = std::vector<mpq_class>;

Matrix commutator(const Matrix& a, const Matrix& b, std::size_t m)
{
    Matrix result(m * m);
    for (std::size_t i = 0; i < m; ++i)
        for (std::size_t j = 0; j < m; ++j)
            for (std::size_t l = 0; l < m; ++l)
                result[i * m + j] += a[i * m + l] * b[l * m + j] - b[i * m + l] * a[l * m + j];
    return result;
}

/// c with target = c^a basis_a, by Gauss-Jordan elimination of (basis^T | target).
std::vector<mpq_class> coordinates_in(const std::vector<Matrix>& basis, const Matrix& target)
{
    const std::size_t r = basis.size();
    std::vector<std::vector<mpq_class>> rows(target.size());
    for (std::size_t entry = 0; entry < target.size(); ++entry) {
        for (const Matrix& element : basis) rows[entry].push_back(element[entry]);
        rows[entry].push_back(target[entry]);
    }
    for (std::size_t column = 0; column < r; ++column) {
        std::size_t pivot = column;
        while (rows.at(pivot)[column] == 0) ++pivot;
        std::swap(rows[pivot], rows[column]);
        for (std::size_t row = 0; row < rows.size(); ++row) {
            if (row == column) continue;
            const mpq_class factor = rows[row][column] / rows[column][column];
            for (std::size_t k = 0; k <= r; ++k) rows[row][k] -= factor * rows[column][k];
        }
    }
    for (std::size_t row = r; row < rows.size(); ++row)
        if (rows[row][r] != 0) throw std::logic_error("the matrices do not close under commutators");
    std::vector<mpq_class> result;
    for (std::size_t a = 0; a < r; ++a) result.push_back(rows[a][r] / rows[a][a]);
    return result;
}

/// {row, column, value} from 1, one list a basis element; values in units of 1/denominator.
using Entries = std::vector<std::array<int, 3>>;

MatrixAlgebra from_entries(const std::string& name, std::size_t m, const std::vector<Entries>& elements,
                           const std::vector<int>& invariant = {}, int denominator = 1)
{
    MatrixAlgebra result;
    result.name = name;
    result.m = m;
    for (const int d : invariant) result.invariant.emplace_back(d);
    for (const Entries& element : elements) {
        Matrix matrix(m * m);
        for (const auto& [i, j, value] : element) {
            mpq_class& entry = matrix[static_cast<std::size_t>(i - 1) * m + static_cast<std::size_t>(j - 1)];
            entry = mpq_class(value, denominator);
            entry.canonicalize();
        }
        result.basis.push_back(std::move(matrix));
    }
    const std::size_t r = elements.size();
    result.algebroid = LocalAlgebroid({}, numbered("e", r));
    for (std::size_t a = 0; a < r; ++a)
        for (std::size_t b = a + 1; b < r; ++b) {
            const auto constants = coordinates_in(result.basis, commutator(result.basis[a], result.basis[b], m));
            for (std::size_t c = 0; c < r; ++c) result.algebroid.set_bracket(c, a, b, constants[c]);
        }
    return result;
}

const std::vector<MatrixAlgebra>& matrix_algebras()
{
    static const std::vector<MatrixAlgebra> table{
        from_entries("so(3)", 3,
                     {{{{3, 2, 1}}, {{2, 3, -1}}}, {{{1, 3, 1}}, {{3, 1, -1}}}, {{{2, 1, 1}}, {{1, 2, -1}}}},
                     {1, 1, 1}),
        from_entries("so(2,1)", 3,
                     {{{{1, 3, 1}}, {{3, 1, 1}}}, {{{2, 3, 1}}, {{3, 2, 1}}}, {{{2, 1, 1}}, {{1, 2, -1}}}}, {1, 1, -1}),
        from_entries("sl(2)", 2, {{{{1, 1, 1}}, {{2, 2, -1}}}, {{{1, 2, 1}}}, {{{2, 1, 1}}}}),
        from_entries("gl(2)", 2, {{{{1, 1, 1}}}, {{{1, 2, 1}}}, {{{2, 1, 1}}}, {{{2, 2, 1}}}}),
        from_entries("se(2)", 3, {{{{2, 1, 1}}, {{1, 2, -1}}}, {{{1, 3, 1}}}, {{{2, 3, 1}}}}),
        from_entries("heis(3)", 3, {{{{1, 2, 1}}}, {{{2, 3, 1}}}, {{{1, 3, 1}}}}),
        from_entries("aff(1)", 2, {{{{1, 1, 1}}}, {{{1, 2, 1}}}}),
        from_entries("su(2)", 4,
                     {{{{1, 2, -1}}, {{2, 1, 1}}, {{3, 4, -1}}, {{4, 3, 1}}},
                      {{{1, 3, -1}}, {{2, 4, 1}}, {{3, 1, 1}}, {{4, 2, -1}}},
                      {{{1, 4, -1}}, {{2, 3, -1}}, {{3, 2, 1}}, {{4, 1, 1}}}},
                     {1, 1, 1, 1}, 2),
        from_entries("so(2)", 2, {{{{2, 1, 1}}, {{1, 2, -1}}}}, {1, 1}),
        from_entries("", 2, {{{{1, 2, 1}}, {{2, 1, 1}}}}, {1, -1}),
        from_entries("R^2", 3, {{{{1, 3, 1}}}, {{{2, 3, 1}}}}),
    };
    return table;
}

/// e_0 acts on R^(r-1) by a random matrix: [e_0, e_i] = D_i^j e_j, which is a Lie algebra for every D.
LocalAlgebroid extension(std::size_t r, Dice& dice)
{
    LocalAlgebroid result({}, numbered("e", r));
    for (std::size_t i = 1; i < r; ++i)
        for (std::size_t j = 1; j < r; ++j)
            if (dice.below(3) != 0) result.set_bracket(j, 0, i, dice.signed_digit(3));
    return result;
}

} // namespace

std::size_t matrix_algebra_count()
{
    return matrix_algebras().size();
}

MatrixAlgebra matrix_algebra(std::size_t number)
{
    return matrix_algebras()[number % matrix_algebra_count()];
}

LocalAlgebroid bianchi(const Formula& n1, const Formula& n2, const Formula& n3, const Formula& a)
{
    LocalAlgebroid result({}, numbered("e", 3));
    result.set_bracket(2, 0, 1, n3);
    result.set_bracket(1, 0, 1, -a);
    result.set_bracket(0, 1, 2, n1);
    result.set_bracket(1, 2, 0, n2);
    result.set_bracket(2, 2, 0, a);
    return result;
}

LocalAlgebroid random_lie_algebra(Dice& dice)
{
    static const std::vector<std::array<int, 4>> types{{0, 0, 0, 0},  {1, 0, 0, 0}, {1, -1, 0, 0}, {1, 1, 0, 0},
                                                       {1, 1, -1, 0}, {1, 1, 1, 0}, {0, 0, 0, 1},  {0, 0, 1, 1},
                                                       {0, 1, -1, 1}, {0, 1, 1, 1}, {0, 1, -1, 2}, {0, 1, 1, 3}};
    switch (dice.below(6)) {
    case 0: return extension(2 + dice.below(3), dice);
    case 1: return direct_product(matrix_algebra(6).algebroid, matrix_algebra(6).algebroid);
    case 2: return direct_product(matrix_algebra(dice.below(8)).algebroid, LocalAlgebroid({}, {"z"}));
    case 3: return matrix_algebra(dice.below(8)).algebroid;
    default: break;
    }
    const auto& [n1, n2, n3, a] = dice.pick(types);
    if (!dice.flip()) return bianchi(n1, n2, n3, a);
    // Types VI_h and VII_h have a free parameter, and a class-A constant may be scaled.
    const Formula k = Formula::variable("k");
    LocalAlgebroid result = a == 0 ? bianchi(n1, n2, Formula(n3) * k, 0) : bianchi(0, n2, n3, Formula(a) * k);
    result.parameters = {"k"};
    return result;
}

namespace {

/// rho_a = sum_ij coefficient(A_a, i, j) x_j d/dx_i
template <class Coefficient>
LocalAlgebroid matrix_action(const MatrixAlgebra& algebra, Coefficient coefficient)
{
    LocalAlgebroid result(numbered("x", algebra.m), algebra.algebroid.fibre);
    result.C = algebra.algebroid.C;
    for (std::size_t a = 0; a < result.r(); ++a)
        for (std::size_t i = 0; i < algebra.m; ++i)
            for (std::size_t j = 0; j < algebra.m; ++j)
                result.anchor(i, a) =
                    result.anchor(i, a) + Formula(coefficient(algebra.basis[a], i, j)) * result.coordinate(j);
    return result;
}

} // namespace

LocalAlgebroid linear_action(const MatrixAlgebra& algebra)
{
    return matrix_action(algebra, [&](const auto& A, std::size_t i, std::size_t j) { return -A[i * algebra.m + j]; });
}

LocalAlgebroid right_action(const MatrixAlgebra& algebra)
{
    return matrix_action(algebra, [&](const auto& A, std::size_t i, std::size_t j) { return A[j * algebra.m + i]; });
}

LocalAlgebroid projective_action(const MatrixAlgebra& algebra)
{
    const std::size_t m = algebra.m, n = m - 1;
    LocalAlgebroid result(numbered("x", n), algebra.algebroid.fibre);
    result.C = algebra.algebroid.C;
    // (A (x, 1))^i
    const auto row = [&](std::size_t a, std::size_t i) {
        Formula sum(algebra.basis[a][i * m + n]);
        for (std::size_t j = 0; j < n; ++j) sum = sum + Formula(algebra.basis[a][i * m + j]) * result.coordinate(j);
        return sum;
    };
    for (std::size_t a = 0; a < result.r(); ++a)
        for (std::size_t i = 0; i < n; ++i) result.anchor(i, a) = result.coordinate(i) * row(a, n) - row(a, i);
    return result;
}

} // namespace lagen::laws
