// SPDX-License-Identifier: GPL-2.0-or-later
/// Modes, and which of them inputs reach.
#include "linear/linear_system.hpp"

#include <catch2/catch.hpp>

using namespace lagen::linear;

namespace {

LinearSystem with_input(const Matrix& A, const Matrix& B)
{
    return linear_system(A, B, Matrix(0, A.rows()));
}

} // namespace

TEST_CASE("an oscillator has its natural frequency and its damping")
{
    Matrix A(2, 2), B(2, 1);
    A << 0, 1, -4, -0.4; // omega = 2, 2 zeta omega = 0.4
    B << 0, 1;
    const double wd = 2 * std::sqrt(1 - 0.01);
    const std::vector<Mode> modes = modes_of(with_input(A, B), {{{-0.2, -wd}}, {{-0.2, wd}}});
    REQUIRE(modes.size() == 2);
    for (const Mode& mode : modes) {
        CHECK(mode.frequency() == Approx(2).epsilon(1e-15));
        CHECK(mode.damping() == Approx(0.1).epsilon(1e-15));
        CHECK(mode.multiplicity == 1);
        CHECK(mode.reached);
        REQUIRE(mode.eigenvectors.size() == 1);
        const Eigen::VectorXcd& v = mode.eigenvectors[0];
        CHECK(v[1] == Eigenvalue(1));
        CHECK((A.cast<Eigenvalue>() * v - mode.eigenvalue * v).norm() < 1e-14);
    }
}

TEST_CASE("equal eigenvalues are one mode with all of its eigenvectors")
{
    const std::vector<Mode> chain =
        modes_of(with_input((Matrix(2, 2) << 0, 1, 0, 0).finished(), Matrix::Zero(2, 1)), {{0, 2}});
    REQUIRE(chain.size() == 1);
    CHECK(chain[0].multiplicity == 2);
    REQUIRE(chain[0].eigenvectors.size() == 1);
    CHECK(chain[0].eigenvectors[0] == Eigen::Vector2cd(1, 0));
    CHECK_FALSE(chain[0].reached);
    const std::vector<Mode> apart = modes_of(with_input(-Matrix::Identity(2, 2), Matrix::Ones(2, 1)), {{-1, 2}});
    REQUIRE(apart.size() == 1);
    CHECK(apart[0].eigenvectors.size() == 2);
    CHECK_FALSE(apart[0].reached); // one input for two equal modes
}

TEST_CASE("a slow mode beside one that is a million million times faster has the eigenvector of its own")
{
    Matrix A =
        Matrix::Zero(4, 4); // two oscillators that damping overcomes, x, v, q, w; the slow one pulls the fast one
    A << 0, 1, 0, 0, -1e12, -2e12, 1e3, 0, 0, 0, 0, 1, 0, 0, -1e-3, -0.1;
    const double slow = -0.05 + std::sqrt(0.0025 - 1e-3);
    const std::vector<Mode> modes = modes_of(with_input(A, Matrix::Zero(4, 1)), {{slow}});
    REQUIRE(modes[0].eigenvectors.size() == 1);
    const Eigen::VectorXcd& v = modes[0].eigenvectors[0];
    CHECK(std::abs(v[2] - 1.0) < 1e-15);
    CHECK(std::abs(v[3] - slow) < 1e-12);
    const double x = 1e3 / (slow * slow + 2e12 * slow + 1e12); // x'' = -1e12 x - 2e12 x' + 1e3 q
    CHECK(std::abs(v[0] - x) < 1e-12 * x);
}

TEST_CASE("two equal oscillators that one force pushes alike are not reached in their difference")
{
    Matrix A = Matrix::Zero(4, 4), B(4, 1); // x1, x2, v1, v2, stiffnesses 1 + e and 1
    for (const double e : {0.0, 0.5}) {
        A << 0, 0, 1, 0, 0, 0, 0, 1, -1 - e, 0, 0, 0, 0, -1, 0, 0;
        B << 0, 0, 1, 1;
        // Kalman's test by another route: the rank of [B, AB, A^2 B, A^3 B].
        Matrix kalman(4, 4);
        kalman << B, A * B, A * A * B, A * A * A * B;
        const bool all = kalman.fullPivLu().rank() == 4;
        CHECK(all == (e > 0));
        CHECK(with_input(A, B).is_reached({0, 1}) == all);
        CHECK(with_input(A, 1e-12 * B).is_reached({0, 1}) == all); // units of the input are nothing
    }
}

TEST_CASE("inputs reach modes of any size, in any units")
{
    Matrix A = Matrix::Zero(4, 4), B(4, 1); // x'' = u - x, q'' = s u - s^2 q - s q'
    for (const double s : {1.0, 1e3, 1e6, 1e9, 1e12}) {
        for (const double unit : {1.0, 1e-9, 1e9}) {
            for (const double push : {0.0, 1.0}) {
                A << 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 0, unit, 0, 0, -s * s / unit, -s;
                B << 0, push, 0, s;
                const LinearSystem system = with_input(A, B);
                INFO(s << ", " << unit);
                CHECK(system.is_reached({0, 1}) == (push > 0));
                CHECK(system.is_reached(s * Eigenvalue(-0.5, std::sqrt(0.75))));
                const Matrix sees = Eigen::Vector4d(push, 0, 1, 0).asDiagonal();
                CHECK(system.is_seen({0, 1}, sees) == (push > 0));
            }
        }
    }
}

TEST_CASE("on a leaf what points off it need not be reached")
{
    Matrix A = Matrix::Zero(3, 3), B(3, 1), slope(2, 3);
    A(0, 1) = 1; // s1' = s2, s2' = u, s3' = 0 on s3 = const
    B << 0, 1, 0;
    slope << 0, 0, 2, 0, 0, 5; // said twice
    CHECK_FALSE(with_input(A, B).is_reached(0));
    const LinearSystem leaf = linear_system(A, B, slope);
    CHECK(leaf.leaf.cols() == 2);
    CHECK(leaf.normal.cols() == 1);
    CHECK(leaf.is_reached(0));
    Matrix Q = Matrix::Zero(3, 3);
    CHECK_FALSE(leaf.is_seen(0, Q));
    Q(0, 0) = 1;
    CHECK(leaf.is_seen(0, Q));
    CHECK_FALSE(with_input(A, B).is_seen(0, Q));
}

TEST_CASE("eigenvalues stand by real, then by imaginary parts; there are none where an entry is no number")
{
    Matrix A(3, 3);
    A << 0, 3, 0, -3, 0, 0, 0, 0, -2;
    const std::vector<Eigenvalue> found = eigenvalues(A);
    REQUIRE(found.size() == 3);
    CHECK(std::abs(found[0] - Eigenvalue(-2)) < 1e-15);
    CHECK(std::abs(found[1] - Eigenvalue(0, -3)) < 1e-15);
    CHECK(std::abs(found[2] - Eigenvalue(0, 3)) < 1e-15);
    Matrix cycle = Matrix::Zero(6, 6); // steps with shifts of 0 do not move it
    for (Eigen::Index i = 0; i < 6; ++i) cycle(i, (i + 1) % 6) = 1;
    REQUIRE(eigenvalues(cycle).size() == 6);
    for (const Eigenvalue& value : eigenvalues(cycle)) CHECK(std::abs(std::pow(value, 6) - 1.0) < 1e-13);
    A(2, 2) = std::numeric_limits<double>::quiet_NaN();
    CHECK(eigenvalues(A).empty());
    CHECK(eigenvalues(Matrix(0, 0)).empty());
}
