// SPDX-License-Identifier: GPL-2.0-or-later
#include "proof/ball_matrix.hpp"

#include <arb_mat.h>

#include <algorithm>
#include <cmath>

namespace lagen::proof {
namespace {

/// A matrix of Arb for the length of a call.
class ArbMatrix {
  public:
    ArbMatrix(std::size_t rows, std::size_t columns)
    {
        arb_mat_init(matrix_, static_cast<slong>(rows), static_cast<slong>(columns));
    }
    explicit ArbMatrix(const BallMatrix& A) : ArbMatrix(A.rows, A.columns)
    {
        for (std::size_t i = 0; i < A.rows; ++i)
            for (std::size_t j = 0; j < A.columns; ++j) arb_set(entry(i, j), A.at(i, j).get());
    }
    ArbMatrix(const ArbMatrix&) = delete;
    ArbMatrix& operator=(const ArbMatrix&) = delete;
    ~ArbMatrix() { arb_mat_clear(matrix_); }

    [[nodiscard]] arb_ptr entry(std::size_t i, std::size_t j)
    {
        return arb_mat_entry(matrix_, static_cast<slong>(i), static_cast<slong>(j));
    }
    [[nodiscard]] arb_mat_struct* get() { return matrix_; }
    [[nodiscard]] BallMatrix balls()
    {
        BallMatrix out(static_cast<std::size_t>(arb_mat_nrows(matrix_)),
                       static_cast<std::size_t>(arb_mat_ncols(matrix_)));
        for (std::size_t i = 0; i < out.rows; ++i)
            for (std::size_t j = 0; j < out.columns; ++j) arb_set(out.at(i, j).get(), entry(i, j));
        return out;
    }

  private:
    arb_mat_t matrix_;
};

} // namespace

BallMatrix BallMatrix::identity(std::size_t n)
{
    BallMatrix out(n, n);
    for (std::size_t k = 0; k < n; ++k) arb_one(out.at(k, k).get());
    return out;
}

BallMatrix product(const BallMatrix& A, const BallMatrix& B, slong precision)
{
    ArbMatrix a(A), b(B), c(A.rows, B.columns);
    arb_mat_mul(c.get(), a.get(), b.get(), precision);
    return c.balls();
}

BallMatrix sum(const BallMatrix& A, const Ball& factor, const BallMatrix& B, slong precision)
{
    BallMatrix out = A;
    for (std::size_t k = 0; k < out.entries.size(); ++k)
        arb_addmul(out.entries[k].get(), factor.get(), B.entries[k].get(), precision);
    return out;
}

BallMatrix joined_columns(const std::vector<BallMatrix>& columns, std::size_t rows)
{
    BallMatrix out(rows, columns.size());
    for (std::size_t j = 0; j < columns.size(); ++j)
        for (std::size_t k = 0; k < rows; ++k) out.at(k, j) = columns[j].at(k, 0);
    return out;
}

BallMatrix transposed(const BallMatrix& A)
{
    BallMatrix out(A.columns, A.rows);
    for (std::size_t i = 0; i < A.rows; ++i)
        for (std::size_t j = 0; j < A.columns; ++j) out.at(j, i) = A.at(i, j);
    return out;
}

std::optional<BallMatrix> solved(const BallMatrix& A, const BallMatrix& B, slong precision)
{
    ArbMatrix a(A), b(B), x(A.columns, B.columns);
    if (arb_mat_solve(x.get(), a.get(), b.get(), precision) == 0) return std::nullopt;
    BallMatrix out = x.balls();
    if (!std::ranges::all_of(out.entries, &Ball::is_finite)) return std::nullopt;
    return out;
}

bool is_certainly_definite(const BallMatrix& A, slong precision)
{
    ArbMatrix a(A), factor(A.rows, A.rows);
    return A.rows == 0 || arb_mat_cho(factor.get(), a.get(), precision) != 0;
}

Ball widened(const Ball& ball, long exponent)
{
    Ball out = ball;
    mag_set_ui_2exp_si(arb_radref(out.get()), 1, -exponent);
    return out;
}

double radius_of(const Ball& ball)
{
    return mag_get_d(arb_radref(ball.get()));
}

RefinedRoot refined_root(const std::function<NewtonEquations(const std::vector<Ball>&)>& equations,
                         const std::vector<Ball>& start, std::size_t watched, slong bits)
{
    std::vector<Ball> u = start;
    for (int step = 0; step < 12; ++step) {
        const NewtonEquations at = equations(u);
        const auto change = solved(at.slope, at.value, bits);
        if (!change) return {start};
        for (std::size_t k = 0; k < u.size(); ++k) {
            arb_sub(u[k].get(), u[k].get(), change->at(k, 0).get(), bits);
            mag_zero(arb_radref(u[k].get()));
        }
    }
    for (std::size_t k = 0; k < watched; ++k)
        if (!(std::fabs(u[k].middle() - start[k].middle()) < 1e-3 * (1 + std::fabs(u[k].middle())))) return {start};
    for (const long exponent : {160L, 120L, 80L, 40L}) {
        std::vector<Ball> box;
        for (const Ball& each : u) box.push_back(widened(each, exponent));
        const auto change = solved(equations(box).slope, equations(u).value, bits);
        if (!change) continue;
        std::vector<Ball> inside = u;
        bool contained = true;
        for (std::size_t k = 0; k < u.size(); ++k) {
            arb_sub(inside[k].get(), u[k].get(), change->at(k, 0).get(), bits);
            contained = contained && arb_contains_interior(box[k].get(), inside[k].get()) != 0;
        }
        if (contained) return {inside, true};
    }
    return {u};
}

} // namespace lagen::proof
