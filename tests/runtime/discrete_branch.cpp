// SPDX-License-Identifier: GPL-2.0-or-later
/// Moser and Veselov's body near the end of its branch: a step has up to four arrows with det N of one sign, of
/// different energies. The energy of a run that keeps its branch is constant.
#include "lagen/integrate.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace lagen;

namespace {

/// SO(3) with L(W) = -tr(J W)/h, J = (tr I/2) 1 - I: F^-L(W)^ = (W J - J W^T)/h.
struct Body {
    using Scalar = double;
    static constexpr int dimension = 12, base_dimension = 0, inner_dimension = 0;
    static constexpr int fibre_dimension = 3, horizontal = 0, group_order = 3;
    static constexpr bool cayley = true;
    using State = Eigen::Matrix<double, 12, 1>;
    using Base = Eigen::Matrix<double, 0, 1>;
    using Matrix = GroupMatrix<double, 3>;
    using Vector = Eigen::Vector3d;

    Vector I;
    double h = 0.1;

    [[nodiscard]] static Matrix hat(const Vector& w)
    {
        Matrix m;
        m << 0, -w[2], w[1], w[2], 0, -w[0], -w[1], w[0], 0;
        return m;
    }
    [[nodiscard]] static Vector vee(const Matrix& m) { return {m(2, 1), m(0, 2), m(1, 0)}; }
    [[nodiscard]] static Matrix element(const State& s) { return detail::group_part<Body>(s) + Matrix::Identity(); }
    [[nodiscard]] Matrix J() const { return Vector(Vector::Constant(I.sum() / 2) - I).asDiagonal(); }
    /// tr(J (1 - W))/h^2.
    [[nodiscard]] double energy(const State& s) const { return -(J() * detail::group_part<Body>(s)).trace() / (h * h); }

    [[nodiscard]] double step() const noexcept { return h; }
    [[nodiscard]] Vector momentum(double, const State& s) const noexcept
    {
        const Matrix W = element(s);
        return vee(W * J() - J() * W.transpose()) / h;
    }
    void forward(double, const State& s, Base&, Vector& mu) const noexcept
    {
        mu = element(s).transpose() * s.tail<3>();
    }
    void arrow_equation(double t, const State& s, Vector& R, Eigen::Matrix3d& N) const noexcept
    {
        R = s.tail<3>() - momentum(t, s);
        for (int b = 0; b < 3; ++b) {
            const Matrix turned = element(s) * hat(Vector::Unit(b));
            N.col(b) = vee(turned * J() - J() * turned.transpose()) / h;
        }
    }
    [[nodiscard]] Matrix cayley_step(double, const State&, const Vector& d) const noexcept
    {
        Matrix V;
        return cayley_less_one<double, 3>(hat(d), V) ? V : Matrix(Matrix::Constant(std::nan("")));
    }
    [[nodiscard]] Vector cayley_coordinates(double, const State& s) const noexcept
    {
        Matrix A;
        return cayley_inverse<double, 3>(detail::group_part<Body>(s), A) ? vee(A) : Vector::Constant(std::nan(""));
    }
};

/// The largest change of the energy, in parts of it; NaN where the motion has no start or does not go on.
double change_of_energy(const Body& body, const Body::Vector& mu, int steps)
{
    Body::State s = Body::State::Zero();
    s.tail<3>() = mu;
    Integrator run(body, s, 0.0, Discrete{});
    if (run.status() != Status::ok) return std::nan("");
    const double first = body.energy(run.state());
    double most = 0;
    for (int k = 0; k < steps; ++k) {
        if (run.step() != Status::ok) return std::nan("");
        most = std::max(most, std::abs(body.energy(run.state()) - first) / std::abs(first));
    }
    return most;
}

} // namespace

TEST_CASE("a body that turns over near the end of its branch stays on it", "[discrete]")
{
    for (const Body::Vector& mu :
         {Body::Vector(1, 22, 0), Body::Vector(0.1, 22.5, 0), Body::Vector(1, 22.5, 0), Body::Vector(0.1, 22.8, 0)})
        CHECK(change_of_energy({{1.1, 2.3, 3.4}}, mu, 1000) < 1e-11);
    CHECK(change_of_energy({{1.102, 3.678, 4.4967}}, {-2.624, 29.132, -0.586}, 1000) < 1e-11);
    CHECK(change_of_energy({{1.447, 1.55, 0.156}}, {11.6776, -1.347, 0.0057}, 1000) < 1e-11);
}

TEST_CASE("bodies and momenta drawn at random keep their branch", "[discrete]")
{
    std::mt19937 bits(14);
    const auto draw = [&](double from, double to) { return from + (to - from) * double(bits()) / 4294967296.0; };
    int moving = 0;
    for (int count = 0; count < 2000; ++count) {
        const double a = draw(1, 4), b = draw(1, 4), c = draw(std::abs(a - b), a + b);
        Body::Vector mu(draw(-1, 1), draw(-1, 1), draw(-1, 1));
        if (count % 2 == 0) mu[count % 3] *= 20; // beside a principal axis
        mu *= draw(0.3, 1.2) * (a + b + c) / (3 * 0.1 * mu.norm());
        const double change = change_of_energy({{a, b, c}}, mu, 100);
        if (std::isnan(change)) continue; // no first arrow
        ++moving;
        INFO(a << ' ' << b << ' ' << c << "   " << mu.transpose());
        CHECK(change < 1e-9);
    }
    CHECK(moving > 1000);
}
