// SPDX-License-Identifier: GPL-2.0-or-later
#include "linear/regulator.hpp"

#include <algorithm>
#include <cmath>

namespace lagen::linear {

namespace {

using Complex = Eigen::MatrixXcd;
using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

constexpr int most_steps = 30; ///< of Newton's method
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
LongMatrix lyapunov(const LongMatrix& F, const LongMatrix& C)
{
    using LongComplex = Eigen::Matrix<std::complex<long double>, Eigen::Dynamic, Eigen::Dynamic>;
    const Eigen::ComplexSchur<LongComplex> schur(F.cast<std::complex<long double>>());
    const LongComplex &T = schur.matrixT(), &U = schur.matrixU();
    const LongComplex right = -U.adjoint() * C.cast<std::complex<long double>>() * U;
    LongComplex Y = LongComplex::Zero(F.rows(), F.cols());
    for (Eigen::Index j = 0; j < Y.cols(); ++j) {
        LongComplex L = T.adjoint();
        L.diagonal().array() += T(j, j);
        Y.col(j) = L.triangularView<Eigen::Lower>().solve(right.col(j) - Y.leftCols(j) * T.col(j).head(j));
    }
    const LongMatrix X = (U * Y * U.adjoint()).real();
    return (X + X.transpose()) / 2;
}

/// All of `size` eigenvalues, of which there are none where they are not found.
bool decays(const std::vector<Eigenvalue>& values, Eigen::Index size)
{
    return std::ssize(values) == size &&
           std::ranges::all_of(values, [](const Eigenvalue& each) { return each.real() < 0; });
}

struct Refined {
    Matrix P, gain;                      ///< gain = R^-1 B^T P
    std::vector<Eigenvalue> closed_loop; ///< of A - B gain, which decays
};

/// Newton's method from a gain with which all decays, until every entry keeps its digits. Slow modes have few of them
/// where fast ones stand beside: each step doubles them, to those of long double. Nothing where it does not come there.
std::optional<Refined> refine(const Riccati& equation, const Matrix& B, const Matrix& R, const Matrix& start)
{
    const LongMatrix longA = equation.A.cast<long double>(), longB = B.cast<long double>(),
                     longQ = equation.Q.cast<long double>(), longR = R.cast<long double>();
    LongMatrix gain = start.cast<long double>();
    for (int step = 0; step < most_steps; ++step) {
        const LongMatrix P = lyapunov(longA - longB * gain, longQ + gain.transpose() * longR * gain);
        const LongMatrix next = longR.llt().solve(longB.transpose() * P), change = next - gain;
        const long double least = 1e-13L * next.cwiseAbs().maxCoeff();
        gain = next;
        Refined out{P.cast<double>(), gain.cast<double>(), {}};
        out.closed_loop = eigenvalues(equation.A - B * out.gain);
        if (!out.P.allFinite() || !decays(out.closed_loop, B.rows())) return std::nullopt;
        if ((change.array().abs() <= 1e-8L * next.array().abs() + least).all()) return out;
    }
    return std::nullopt;
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
    const Matrix T = system.balanced_leaf();
    const Eigen::VectorXd inverse = system.units.array().square().inverse();
    const Matrix onto = T.transpose() * inverse.asDiagonal(); // onto T = 1
    const Matrix A = onto * system.A * T, B = onto * system.B;
    const Matrix weighted = R.llt().solve(B.transpose()); // R^-1 B^T
    const Riccati equation{A, B * weighted, T.transpose() * Q * T};
    const std::optional<Matrix> P = by_stable_subspace(equation);
    if (!P || !decays(eigenvalues(A - equation.G * *P), A.rows())) return NoRegulator{};
    const std::optional<Refined> refined = refine(equation, B, R, weighted * *P);
    if (!refined) return NoRegulator{};
    Regulator out{refined->gain * onto, equation.residual(refined->P), refined->closed_loop};
    const double rounding = 1e-14 * out.K.cwiseAbs().maxCoeff();
    out.K = out.K.unaryExpr([&](double entry) { return std::abs(entry) < rounding ? 0.0 : entry; });
    return out;
}

} // namespace lagen::linear
