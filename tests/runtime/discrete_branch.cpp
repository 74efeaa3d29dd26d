// SPDX-License-Identifier: GPL-2.0-or-later
/// Moser and Veselov's body near the end of its branch: a step has up to four arrows with det N of one sign, of
/// different energies. The energy of a run that keeps its branch is constant.
#include "lagen/integrate.hpp"

#include <catch2/catch.hpp>

#include <array>
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

/// Pairs of numbers with F^-L = f(d), d = x_next - x, and a kick: mu' = f(d) - a x_next.
struct Line {
    using Scalar = double;
    static constexpr int dimension = 3, base_dimension = 1, inner_dimension = 0;
    static constexpr int fibre_dimension = 1, horizontal = 1, group_order = 0;
    static constexpr bool cayley = true;
    using State = Eigen::Matrix<double, 3, 1>;
    using One = Eigen::Matrix<double, 1, 1>;

    double (*f)(double), (*slope)(double);
    double a = 0;

    [[nodiscard]] double step() const noexcept { return 1; }
    [[nodiscard]] One momentum(double, const State& s) const noexcept { return One(f(s[1])); }
    void forward(double, const State& s, One& x, One& mu) const noexcept
    {
        x[0] = s[0] + s[1];
        mu[0] = f(s[1]) - a * x[0];
    }
    void arrow_equation(double t, const State& s, One& R, One& N) const noexcept
    {
        R = s.tail<1>() - momentum(t, s);
        N[0] = slope(s[1]);
    }
};

/// Its folds are at odd multiples of pi/2.
const Line wave{[](double d) { return std::sin(d); }, [](double d) { return std::cos(d); }};
/// Affine but for a bump below d = 3, whose top is 0.104.
const Line bump{[](double d) { return d - 3 * d * d * std::exp(-d); },
                [](double d) { return 1 + (3 * d * d - 6 * d) * std::exp(-d); }};

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

/// Momenta of h Omega = part about axis `axis`.
Body::State about_axis(const Body& body, int axis, double part)
{
    Body::State s = Body::State::Zero();
    s[9 + axis] = body.I[axis] * part / body.h;
    return s;
}

/// The angle of a rotation by its trace.
double angle_of(const Body::State& s)
{
    return std::acos((Body::element(s).trace() - 1) / 2);
}

} // namespace

TEST_CASE("momenta about a principal axis have the arrows asin(h Omega) and pi - asin(h Omega), and runs follow both",
          "[discrete]")
{
    const Body body{{1.1, 2.3, 3.4}};
    for (int axis = 0; axis < 3; ++axis)
        for (const double part : {0.02, 0.5, 0.9}) {
            INFO("axis " << axis + 1 << ", h Omega = " << part);
            const auto arrows = arrows_of_momenta(body, 0.0, about_axis(body, axis, part));
            // Half turns across the axis have h |mu| up to the difference of the other moments.
            const double others = std::abs(body.I[(axis + 1) % 3] - body.I[(axis + 2) % 3]);
            REQUIRE(arrows.size() == (body.I[axis] * part < others ? 4 : 2));
            const double angle = std::asin(part);
            CHECK(std::abs(angle_of(arrows[0].state) - angle) < 1e-9);
            CHECK(std::abs(angle_of(arrows[1].state) - (M_PI - angle)) < 1e-9);
            CHECK(std::abs(Body::element(arrows[1].state)(axis, axis) - 1) < 1e-14);
            CHECK(arrows[1].distance == Approx(2 * std::sqrt(2.0) * std::sin(M_PI / 2 - angle)).epsilon(1e-12));
            if (axis == 1) continue; // where the turn by pi - theta is unstable
            for (const std::size_t branch : {0U, 1U}) {
                Integrator run(body, arrows[branch].state, 0.0, Discrete{});
                for (int k = 0; k < 100; ++k) REQUIRE(run.step() == Status::ok);
                CHECK(std::abs(angle_of(run.state()) - (branch == 0 ? angle : M_PI - angle)) < 1e-9);
            }
        }
}

TEST_CASE("momenta in general have no, two or four arrows with det N of both signs, each followed", "[discrete]")
{
    const Body body{{1.1, 2.3, 3.4}};
    Body::State s = Body::State::Zero();
    s.tail<3>() << 1, 2, 0.5;
    const auto arrows = arrows_of_momenta(body, 0.0, s);
    REQUIRE(arrows.size() == 4);
    for (const auto& arrow : arrows) {
        CHECK((body.momentum(0, arrow.state) - s.tail<3>()).norm() < 1e-12 * s.tail<3>().norm());
        Integrator run(body, arrow.state, 0.0, Discrete{});
        const double energy = body.energy(run.state());
        for (int k = 0; k < 100; ++k) REQUIRE(run.step() == Status::ok);
        CHECK(std::abs(body.energy(run.state()) - energy) < 1e-12 * std::abs(energy));
    }
    std::mt19937 bits(3);
    const auto draw = [&](double from, double to) { return from + (to - from) * double(bits()) / 4294967296.0; };
    std::array<int, 5> found{};
    for (int count = 0; count < 60; ++count) {
        const double a = draw(0.1, 4), b = draw(0.1, 4), c = draw(std::abs(a - b), a + b);
        Body::Vector mu(draw(-1, 1), draw(-1, 1), draw(-1, 1));
        s.tail<3>() = mu * (draw(0, 0.9) * (a + b + c) / (3 * 0.1 * mu.norm()));
        int signs = 0;
        const auto drawn = arrows_of_momenta(Body{{a, b, c}}, 0.0, s);
        for (const auto& arrow : drawn) signs += arrow.negative ? -1 : 1;
        CHECK(signs == 0); // the degree of F^-L is 0: SO(3) is compact
        REQUIRE(drawn.size() <= 4);
        ++found[drawn.size()];
    }
    CHECK(found[0] > 0);
    CHECK(found[2] > 5);
    CHECK(found[4] > 5);
}

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

TEST_CASE("a step beside a fold stays on its branch, where Newton's first step leads over several folds", "[discrete]")
{
    for (const auto& [p, a] : {std::pair(0.9975, 1.20), {0.9975, 1.24}, {0.98, 1.10}, {0.98, 1.05}}) {
        Line line = wave;
        line.a = a;
        Integrator run(line, Line::State(0, 0, p), 0.0, Discrete{});
        REQUIRE(run.status() == Status::ok);
        const double d = std::asin(p);
        CHECK(run.state()[1] == Approx(d).epsilon(1e-14));
        REQUIRE(run.step() == Status::ok);
        CHECK(run.state()[1] == Approx(std::asin(p - a * d)).epsilon(1e-12));
    }
}

TEST_CASE("momenta behind a bump have no arrow that is connected with the arrow 1, however affine the rest is",
          "[discrete]")
{
    for (const double p : {0.01, 0.05, 0.1}) {
        Integrator run(bump, Line::State(0, 0, p), 0.0, Discrete{});
        REQUIRE(run.status() == Status::ok);
        CHECK(run.state()[1] < 0.4);
    }
    for (const double p : {0.2, 1.0, 3.0, 8.0, 10.0, 30.0, 100.0, 300.0})
        CHECK(Integrator(bump, Line::State(0, 0, p), 0.0, Discrete{}).status() == Status::no_solution);
}

TEST_CASE("a first arrow that is plainly beside its group is refused", "[discrete]")
{
    const Body body{{1.1, 2.3, 3.4}};
    const auto status_of = [&](double turn, double off) {
        Body::State s = Body::State::Zero();
        s[4] = s[8] = std::cos(turn) - 1 + off;
        s[5] = -std::sin(turn);
        s[7] = std::sin(turn);
        return Integrator(body, at_arrow(body, 0.0, s), 0.0, Discrete{}).status();
    };
    CHECK(status_of(0.1, 0) == Status::ok);
    CHECK(status_of(0.1, 1e-9) == Status::ok);
    CHECK(status_of(0.1, 1e-3) == Status::invalid_input);
    CHECK(status_of(0.1, 1 - std::cos(0.1)) == Status::invalid_input);
}
