// SPDX-License-Identifier: GPL-2.0-or-later
/// Gains of least cost against formulas.
#include "linear/regulator.hpp"

#include <catch2/catch.hpp>

#include <numbers>
#include <random>

using namespace lagen::linear;

namespace {

std::variant<Regulator, NoRegulator> gain_of(const Matrix& A, const Matrix& B, const Matrix& Q, const Matrix& R)
{
    const LinearSystem system = linear_system(A, B, Matrix(0, A.rows()));
    std::vector<MultipleEigenvalue> each;
    for (const Eigenvalue& value : eigenvalues(A)) each.push_back({value});
    return regulator(system, modes_of(system, each), Q, R);
}

Matrix one(double value)
{
    return Matrix::Constant(1, 1, value);
}

/// s_k' = s_{k+1}, s_n' = u
Matrix integrators(Eigen::Index n)
{
    Matrix A = Matrix::Zero(n, n);
    A.diagonal(1).setOnes();
    return A;
}

} // namespace

TEST_CASE("the gain of one equation is the root of a quadratic")
{
    for (const double a : {-2.0, 0.0, 3.0})
        for (const double q : {1e-6, 1.0, 1e6}) {
            const double b = 0.5, r = 2;
            const auto found = std::get<Regulator>(gain_of(one(a), one(b), one(q), one(r)));
            const double root = std::sqrt(a * a + q * b * b / r);
            CHECK(found.K(0, 0) == Approx(a < 0 ? q * b / r / (root - a) : (root + a) / b).epsilon(1e-13));
            CHECK(found.closed_loop[0].real() == Approx(-root).epsilon(1e-13));
        }
}

TEST_CASE("the gain of the double integrator is [1, sqrt(3)]")
{
    const auto found =
        std::get<Regulator>(gain_of(integrators(2), Matrix::Identity(2, 2).col(1), Matrix::Identity(2, 2), one(1)));
    CHECK(found.K(0, 0) == Approx(1).epsilon(1e-14));
    CHECK(found.K(0, 1) == Approx(std::numbers::sqrt3).epsilon(1e-14));
    CHECK(found.residual < 1e-15);
    REQUIRE(found.closed_loop.size() == 2);
    CHECK(found.closed_loop[1].real() == Approx(-std::numbers::sqrt3 / 2).epsilon(1e-14));
    CHECK(found.closed_loop[1].imag() == Approx(0.5).epsilon(1e-14));
}

TEST_CASE("a chain of integrators whose first entry alone has a weight gets Butterworth's poles")
{
    for (const Eigen::Index n : {3, 4, 6}) {
        Matrix Q = Matrix::Zero(n, n);
        Q(0, 0) = 1;
        const auto found = std::get<Regulator>(gain_of(integrators(n), Matrix::Identity(n, n).col(n - 1), Q, one(1)));
        CHECK(found.K(0, 0) == Approx(1).epsilon(1e-11));
        for (const Eigenvalue& pole : found.closed_loop) {
            CHECK(std::abs(pole) == Approx(1).epsilon(1e-11));
            const double turns = static_cast<double>(n) * std::arg(pole) / std::numbers::pi; // s^2n = -(-1)^n
            const double off = turns - (n % 2 == 0 ? 0.5 : 0);
            CHECK(off == Approx(std::round(off)).margin(1e-10));
        }
    }
}

TEST_CASE("a gain solves Riccati's equation, and no other gain costs less")
{
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    const auto matrix = [&](Eigen::Index rows, Eigen::Index columns) {
        return Matrix(Matrix::NullaryExpr(rows, columns, [&] { return normal(random); }));
    };
    // The cost of a start s is s^T X s with (A - B K)^T X + X (A - B K) + Q + K^T R K = 0, by a system of n^2
    // equations.
    const auto cost = [](const Matrix& F, const Matrix& C) {
        const Eigen::Index n = F.rows();
        Matrix system = Matrix::Zero(n * n, n * n);
        for (Eigen::Index i = 0; i < n; ++i)
            for (Eigen::Index j = 0; j < n; ++j)
                for (Eigen::Index k = 0; k < n; ++k) {
                    system(i * n + j, k * n + j) += F(k, i);
                    system(i * n + j, i * n + k) += F(k, j);
                }
        const Eigen::VectorXd right = -C.reshaped<Eigen::RowMajor>();
        return Matrix(system.fullPivLu().solve(right).reshaped<Eigen::RowMajor>(n, n)).trace();
    };
    for (int trial = 0; trial < 8; ++trial) {
        const Eigen::Index n = 2 + trial, m = 1 + trial % 3;
        const Matrix A = matrix(n, n), B = matrix(n, m), C = matrix(n, n), D = matrix(m, m);
        const Matrix Q = C * C.transpose(), R = D * D.transpose() + Matrix::Identity(m, m);
        const auto found = std::get<Regulator>(gain_of(A, B, Q, R));
        CHECK(found.residual < 1e-13);
        const auto cost_of = [&](const Matrix& K) { return cost(A - B * K, Q + K.transpose() * R * K); };
        const double least = cost_of(found.K);
        for (int k = 0; k < 5; ++k) CHECK(cost_of(found.K + 1e-3 * matrix(m, n)) > least);
    }
}

TEST_CASE("what cannot be stabilised, or costs nothing, has no regulator")
{
    using Reason = NoRegulator::Reason;
    const auto reason = [](const Matrix& A, const Matrix& B, const Matrix& Q) {
        return std::get<NoRegulator>(gain_of(A, B, Q, one(1)));
    };
    const Matrix oscillator = (Matrix(2, 2) << 0, 1, -1, 0).finished();
    const NoRegulator out = reason(Matrix::Identity(2, 2), Matrix::Identity(2, 2).col(0), Matrix::Identity(2, 2));
    CHECK(out.reason == Reason::not_reached);
    CHECK(out.eigenvalue == Eigenvalue(1));
    CHECK(reason(oscillator, Matrix::Identity(2, 2).col(1), Matrix::Zero(2, 2)).reason == Reason::not_seen);
    CHECK(reason(oscillator, Matrix::Identity(2, 2).col(1), 1e-40 * Matrix::Identity(2, 2)).reason ==
          Reason::not_found);
    // A mode that grows need not be seen, one that decays need not be reached.
    const auto grows = std::get<Regulator>(gain_of(one(2), one(1), one(0), one(1)));
    CHECK(grows.K(0, 0) == Approx(4).epsilon(1e-14)); // it is mirrored
    const Matrix mixed = (Matrix(2, 2) << 1, 0, 0, -1).finished();
    CHECK(std::get<Regulator>(gain_of(mixed, Matrix::Identity(2, 2).col(0), Matrix::Identity(2, 2), one(1)))
              .closed_loop[0]
              .real() == Approx(-std::sqrt(2.0)));
    // A plant that units make lopsided: x'' = x + u, x in nm, and a lag of a nanosecond.
    const Matrix plant = (Matrix(3, 3) << 0, 1e9, 0, 1e-9, 0, 0, 0, 0, -1e9).finished();
    const Matrix push = (Matrix(3, 1) << 0, 1, 1e9).finished();
    const auto held = std::get<Regulator>(gain_of(plant, push, Eigen::Vector3d(1e-18, 1, 0).asDiagonal(), one(1)));
    CHECK(held.K(0, 0) * 1e9 == Approx(1 + std::sqrt(2.0)).epsilon(1e-6));
    CHECK(held.K(0, 1) == Approx(1 + std::sqrt(2.0)).epsilon(1e-6));
    // Two loops in SI units, 1 mH and 1 uF with -2 ohms, 10 nH and 1 nF with 50, Q = R = 1; K in 60 digits.
    Matrix loops = Matrix::Zero(4, 4);
    loops.topRightCorner(2, 2).setIdentity();
    loops(2, 0) = -1e9, loops(2, 2) = 2000, loops(3, 1) = -1e17, loops(3, 3) = -5e9;
    const Matrix volts = (Matrix(4, 1) << 0, 0, 1000, 1e8).finished();
    const auto damped = std::get<Regulator>(gain_of(loops, volts, Matrix::Identity(4, 4), one(1)));
    const double exact[] = {-0.042351103993067467, 42.351603993567167, 4.2360680643206043, 0.0099990001989818376};
    for (Eigen::Index k = 0; k < 4; ++k) CHECK(damped.K(0, k) == Approx(exact[k]).epsilon(k == 0 ? 1e-3 : 1e-6));
    // Nor is one that decays slowly beside others.
    const Matrix stiff = Eigen::Vector3d(1, -1, -1e9).asDiagonal();
    CHECK(std::get<Regulator>(gain_of(stiff, Matrix::Identity(3, 3).col(0), Matrix::Identity(3, 3), one(1)))
              .closed_loop[1]
              .real() == Approx(-std::sqrt(2.0)));
}
