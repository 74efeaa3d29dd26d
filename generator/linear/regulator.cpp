// SPDX-License-Identifier: GPL-2.0-or-later
#include "linear/regulator.hpp"

#include <algorithm>
#include <cmath>

namespace lagen::linear {

namespace {

using Complex = Eigen::MatrixXcd;

/// A real part below the first of its eigenvalue, or the second of |A|, is none.
constexpr double axis_tolerance = 1e-9, rounding_tolerance = 1e-14;

/// A^T P + P A - P G P + Q = 0.
struct Riccati {
    Matrix A, G, Q;

    /// Relative to the terms.
    [[nodiscard]] double residual(const Matrix& P) const
    {
        const double terms = 2 * A.norm() * P.norm() + G.norm() * P.norm() * P.norm() + Q.norm();
        return terms > 0 ? (A.transpose() * P + P * A - P * G * P + Q).norm() / terms : 0;
    }
};

/// Exchanges the eigenvalues k and k + 1 of T in U T U^*.
void exchange(Complex& T, Complex& U, Eigen::Index k)
{
    Eigen::JacobiRotation<Eigenvalue> rotation;
    rotation.makeGivens(T(k, k + 1), T(k + 1, k + 1) - T(k, k));
    T.applyOnTheLeft(k, k + 1, rotation.adjoint());
    T.applyOnTheRight(k, k + 1, rotation);
    U.applyOnTheRight(k, k + 1, rotation);
    T(k + 1, k) = 0;
}

/// P by the stable subspace of [A, -G; -Q, -A^T], G and Q first scaled to one size; nothing where that has not half
/// the dimension, or no P.
std::optional<Matrix> by_stable_subspace(const Riccati& equation)
{
    const Eigen::Index n = equation.A.rows();
    const double G = equation.G.norm(), Q = equation.Q.norm(), scale = G > 0 && Q > 0 ? std::sqrt(Q / G) : 1;
    Matrix H(2 * n, 2 * n);
    H << equation.A, -scale * equation.G, -equation.Q / scale, -equation.A.transpose();
    const Eigen::ComplexSchur<Complex> schur(H.cast<Eigenvalue>());
    Complex T = schur.matrixT(), U = schur.matrixU();
    Eigen::Index stable = 0;
    for (Eigen::Index k = 0; k < 2 * n; ++k) {
        if (!(T(k, k).real() < 0)) continue;
        for (Eigen::Index j = k; j > stable; --j) exchange(T, U, j - 1);
        ++stable;
    }
    const Eigen::FullPivLU<Complex> first(U.topLeftCorner(n, n).transpose());
    if (stable != n || !first.isInvertible()) return std::nullopt;
    const Matrix P = scale * first.solve(U.bottomLeftCorner(n, n).transpose()).real();
    return (P + P.transpose()) / 2;
}

/// X with F^T X + X F + C = 0, where all of F decays. [Bartels and Stewart 1972]
Matrix lyapunov(const Matrix& F, const Matrix& C)
{
    const Eigen::ComplexSchur<Complex> schur(F.cast<Eigenvalue>());
    const Complex &T = schur.matrixT(), &U = schur.matrixU();
    const Complex right = -U.adjoint() * C.cast<Eigenvalue>() * U;
    Complex Y = Complex::Zero(F.rows(), F.cols());
    for (Eigen::Index j = 0; j < Y.cols(); ++j) {
        Complex L = T.adjoint();
        L.diagonal().array() += T(j, j);
        Y.col(j) = L.triangularView<Eigen::Lower>().solve(right.col(j) - Y.leftCols(j) * T.col(j).head(j));
    }
    const Matrix X = (U * Y * U.adjoint()).real();
    return (X + X.transpose()) / 2;
}

/// All of `size` eigenvalues, of which there are none where they are not found.
bool decays(const std::vector<Eigenvalue>& values, Eigen::Index size)
{
    return std::ssize(values) == size &&
           std::ranges::all_of(values, [](const Eigenvalue& each) { return each.real() < 0; });
}

} // namespace

std::variant<Regulator, NoRegulator> regulator(const LinearSystem& system, const std::vector<Mode>& modes,
                                               const Matrix& Q, const Matrix& R)
{
    for (const Mode& mode : modes) {
        const double real = mode.eigenvalue.real(),
                     axis = std::max(axis_tolerance * mode.frequency(), rounding_tolerance * system.size());
        if (real >= -axis && !mode.reached) return NoRegulator{NoRegulator::Reason::not_reached, mode.eigenvalue};
        if (std::abs(real) <= axis && !system.is_seen(mode.eigenvalue, Q))
            return NoRegulator{NoRegulator::Reason::not_seen, mode.eigenvalue};
    }
    const Matrix &T = system.leaf, A = T.transpose() * system.A * T, B = T.transpose() * system.B;
    const Matrix weighted = R.llt().solve(B.transpose()); // R^-1 B^T
    const Riccati equation{A, B * weighted, T.transpose() * Q * T};
    std::optional<Matrix> P = by_stable_subspace(equation);
    if (!P || !decays(eigenvalues(A - equation.G * *P), A.rows())) return NoRegulator{};
    const Matrix K = weighted * *P;
    const Matrix refined = lyapunov(A - B * K, equation.Q + K.transpose() * R * K);
    if (equation.residual(refined) < equation.residual(*P)) P = refined;
    const Matrix gain = weighted * *P;
    Regulator out{gain * T.transpose(), equation.residual(*P), eigenvalues(A - B * gain)};
    const double rounding = 1e-14 * out.K.cwiseAbs().maxCoeff();
    out.K = out.K.unaryExpr([&](double entry) { return std::abs(entry) < rounding ? 0.0 : entry; });
    if (!decays(out.closed_loop, A.rows())) return NoRegulator{};
    return out;
}

} // namespace lagen::linear
