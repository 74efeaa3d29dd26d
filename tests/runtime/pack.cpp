// SPDX-License-Identifier: GPL-2.0-or-later
/// Packs: arithmetic a lane, masks, statuses, and fixed-step methods on them.
#include "lagen/lagen.hpp"
#include "support/problems.hpp"
#include "support/tolerances.hpp"

#include <catch2/catch.hpp>

using namespace lagen;
using P = Pack<double, 4>;

namespace {

P lanes(double a, double b, double c, double d)
{
    return P(std::array<double, 4>{a, b, c, d});
}

/// x' = -1, fails where x < 1/2.
struct Singular {
    using Scalar = P;
    using State = Eigen::Matrix<P, 1, 1>;
    static constexpr int dimension = 1;
    status_t<P> rhs(P, const State& s, State& ds) const noexcept
    {
        auto status = StatusOf<P>::good();
        StatusOf<P>::fail(status, s[0] < P(0.5), Status::singular_mass_matrix);
        ds[0] = P(-1);
        return status;
    }
};

} // namespace

TEST_CASE("A pack computes in every lane what its scalar computes")
{
    const P a = lanes(1, -2, 0.5, 3), b = lanes(4, 0.25, -1, 2);
    const auto check = [&](const P& result, auto function) {
        for (int i = 0; i < 4; ++i) CHECK(result[i] == function(a[i], b[i]));
    };
    check(a + b, [](double x, double y) { return x + y; });
    check(a - b, [](double x, double y) { return x - y; });
    check(a * b, [](double x, double y) { return x * y; });
    check(a / b, [](double x, double y) { return x / y; });
    check(-a, [](double x, double) { return -x; });
    check(2 * a + 1.0, [](double x, double) { return 2 * x + 1; });
    check(sin(a), [](double x, double) { return std::sin(x); });
    check(cos(a), [](double x, double) { return std::cos(x); });
    check(exp(a), [](double x, double) { return std::exp(x); });
    check(sqrt(abs(a)), [](double x, double) { return std::sqrt(std::abs(x)); });
    check(log(abs(a)), [](double x, double) { return std::log(std::abs(x)); });
    check(erf(a), [](double x, double) { return std::erf(x); });
    check(atan2(a, b), [](double x, double y) { return std::atan2(x, y); });
    check(select(a < b, a, b), [](double x, double y) { return x < y ? x : y; });
    check(max(a, b), [](double x, double y) { return x < y ? y : x; });
    check(select(a < b && b > P(1), a, P(7)), [](double x, double y) { return x < y && y > 1 ? x : 7; });
    CHECK(any(a < b));
    CHECK_FALSE(all(a < b));
    CHECK(all(a == a));
}

TEST_CASE("A pack of trajectories agrees with the trajectories one by one")
{
    using Many = problems::Kepler<P>;
    using One = problems::Kepler<double>;
    const auto check = [](const auto& method) {
        Many::State s;
        s << lanes(1, 0.9, 0.8, 1.1), P(0), P(0.1), lanes(1, 1.1, 1.2, 0.9);
        const std::array<double, 2> at{0.5, 1.03};
        const auto run = integrate(Many{}, s, {0.0, 2.0}, method, {.at = at});
        REQUIRE(run.status() == Status::ok);
        REQUIRE(run.states.size() == 2);
        for (int lane = 0; lane < 4; ++lane) {
            const One::State single(s[0][lane], s[1][lane], s[2][lane], s[3][lane]);
            const auto alone = integrate(One{}, single, {0.0, 2.0}, method, {.at = at});
            for (Eigen::Index i = 0; i < 4; ++i) {
                CHECK_THAT(run.state[i][lane], Catch::WithinAbs(alone.state[i], tolerance::roundoff(500)));
                CHECK_THAT(run.states[1][i][lane], Catch::WithinAbs(alone.states[1][i], tolerance::roundoff(500)));
            }
            CHECK(alone.state.norm() > 1);
        }
    };
    check(Euler{.step = 0.02});
    check(Midpoint{.step = 0.02});
    check(Heun{.step = 0.02});
    check(Kutta3{.step = 0.02});
    check(Rk4{.step = 0.02});
    check(Rk4{.step = 0.02, .compensated = true});
    check(Rk38{.step = 0.02});
    check(LeapfrogDkd{.step = 0.02});
    check(LeapfrogKdk{.step = 0.02});
    check(McLachlan4{.step = 0.02});
    check(Yoshida6{.step = 0.02});
    check(BlanesMoan6{.step = 0.02});
    check(Srkn6{.step = 0.02});
}

TEST_CASE("A lane that fails keeps its last good state while the others go on")
{
    Singular::State s;
    s[0] = lanes(10, 1, 10, 2);
    const auto run = integrate(Singular{}, s, {0.0, 4.0}, Rk4{.step = 0.125});
    CHECK(run.status() == Status::singular_mass_matrix);
    CHECK(run.lanes.lanes ==
          std::array{Status::ok, Status::singular_mass_matrix, Status::ok, Status::singular_mass_matrix});
    CHECK(run.t == 4.0);
    CHECK(run.state[0][0] == 6.0);
    CHECK(run.state[0][1] == 0.5);
    CHECK(run.state[0][3] == 0.5);
    const auto none = integrate(Singular{}, Singular::State(P(1)), {0.0, 4.0}, Rk4{.step = 0.125});
    CHECK(none.t == 0.5);
}

TEST_CASE("Packs of float have their lanes, too")
{
    using F = Pack<float, 8>;
    const F a = F(2) * F(1.5f);
    for (int i = 0; i < 8; ++i) CHECK(sqrt(a + F(1))[i] == 2.0f);
}
