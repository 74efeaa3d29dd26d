// SPDX-License-Identifier: GPL-2.0-or-later
/// Intervals of linear stability: exact polynomials against numbers that others computed, and against steps that the
/// runtime makes.
#include "stability/linear_limits.hpp"
#include "stability/polynomial.hpp"

#include "lagen/integrate.hpp"
#include "support/golden.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>

using lagen::linear_limits_of;
using lagen::no_limit;
using namespace lagen::stability;

namespace {

double imaginary(const char* type)
{
    return linear_limits_of(type).value().imaginary;
}

double negative(const char* type)
{
    return linear_limits_of(type).value().real.value();
}

/// The table of the program.
std::string table_text()
{
    const auto number = [](double x) { return x == no_limit ? "no_limit" : fmt::format("{}", x); };
    std::string text = R"(// SPDX-License-Identifier: GPL-2.0-or-later
/// The intervals of linear stability of every method and scheme. scripts/stability-table writes this file:
/// tests/stability computes them exactly, from the coefficients that the runtime steps with, and rounds once.
#pragma once

#include "scene/linear_limits.hpp"

#include <array>

namespace lagen {

inline constexpr std::array linear_limits{
)";
    for (const lagen::LinearLimits& limits : lagen::computed_limits())
        text += fmt::format("    LinearLimits{{\"{}\", {}, {}, {}, {}, {}}},\n", limits.of, number(limits.imaginary),
                            limits.real ? number(*limits.real) : "std::nullopt", limits.calls, limits.a_stable,
                            limits.l_stable);
    return text + "};\n\n} // namespace lagen\n";
}

/// x'' = -omega^2 x.
struct Oscillator {
    using Scalar = double;
    using State = Eigen::Vector2d;
    static constexpr int dimension = 2, base_dimension = 1;
    static constexpr auto second_order = lagen::SecondOrder::velocity_free;
    static constexpr std::array<int, 2> jacobian_rows{0, 1}, jacobian_columns{1, 0};
    double omega = 1;

    lagen::Status rhs(double, const State& s, State& ds) const noexcept
    {
        ds = {s[1], -omega * omega * s[0]};
        return lagen::Status::ok;
    }
    lagen::Status jacobian_values(double, const State&, std::array<double, 2>& values) const noexcept
    {
        values = {1, -omega * omega};
        return lagen::Status::ok;
    }
};

/// The largest |x| + |v| behind 60000 steps of length 1 from (1, 0), or 1e6 as soon as it is that large.
template <class Method>
double size_after_steps(double omega)
{
    lagen::Integrator integrator(Oscillator{omega}, Eigen::Vector2d(1, 0), 0.0, Method{.step = 1});
    double most = 0;
    for (int k = 0; k < 60000 && most < 1e6; ++k) {
        if (integrator.step() != lagen::Status::ok) return 1e6;
        most = std::max(most, integrator.state().template lpNorm<1>());
    }
    return most;
}

template <class Method>
void check_by_steps(const char* type)
{
    INFO(type);
    const double limit = imaginary(type);
    CHECK(size_after_steps<Method>(0.9999 * limit) < 1e4);
    CHECK(size_after_steps<Method>(1.00005 * limit) == Approx(1e6).epsilon(0.9).scale(1e6));
}

} // namespace

TEST_CASE("a polynomial that touches zero is not negative there, and one that dips is negative from there on")
{
    const Polynomial x{0, 1}, one{1}, touching{mpq_class(1, 3), -1};
    CHECK(first_negative(touching * touching * (Polynomial{3} - x)) == Approx(3).epsilon(1e-15));
    const Polynomial dip = (x - one) * (x - Polynomial{mpq_class(1001, 1000)});
    CHECK(first_negative(dip).value() == Approx(1).epsilon(1e-15));
    CHECK_FALSE(first_negative(dip + Polynomial{mpq_class(1, 1000000)}));
    CHECK(first_negative(Polynomial{0, 0, -1, 5}) == 0.0);
    CHECK(first_negative(Polynomial{-1, 0, 1, -1}, 1) == Approx(1).epsilon(1e-15));
}

TEST_CASE("Routh's scheme tells where the zeros of a polynomial lie")
{
    const Polynomial z{0, 1}, pair{5, -2, 1}, left{5, 2, 1}; // 1 +- 2 i, -1 +- 2 i
    CHECK(has_zeros_on_the_right(pair * (z - Polynomial{3})));
    CHECK(has_zeros_on_the_right(pair * pair * (z - Polynomial{3}) * (z - Polynomial{mpq_class(1, 7)})));
    CHECK_FALSE(has_zeros_on_the_right(left * (z - Polynomial{3})));
    CHECK_FALSE(has_zeros_on_the_right(pair * (z + Polynomial{3})));
    CHECK_FALSE(has_zeros_on_the_right(Polynomial{1, 0, 1}));
}

TEST_CASE("intervals are those of the literature and of computations in quadruple precision")
{
    CHECK(negative("Euler") == Approx(2).epsilon(1e-15));
    for (const char* type : {"Euler", "Midpoint", "Heun", "Ralston"}) CHECK(imaginary(type) == 0);
    CHECK(imaginary("Kutta3") == Approx(std::sqrt(3.0)).epsilon(1e-15));
    for (const char* type : {"Rk4", "Rk38"}) {
        CHECK(imaginary(type) == Approx(2 * std::sqrt(2.0)).epsilon(1e-15));
        CHECK(negative(type) == Approx(2.785293563405282).epsilon(1e-13));
    }
    CHECK(imaginary("Dopri5") == Approx(0.9971890088).margin(1e-10));
    CHECK(negative("Dopri5") == Approx(3.3065678926).margin(1e-10));
    CHECK(imaginary("Dop853") == Approx(5.9603598117).margin(1e-10));
    CHECK(negative("Dop853") == Approx(6.3936515229).margin(1e-10));
    CHECK(imaginary("LeapfrogDkd") == Approx(2).epsilon(1e-15));
    CHECK(imaginary("LeapfrogKdk") == Approx(2).epsilon(1e-15));
    CHECK(imaginary("Yoshida6") == Approx(2.2691).margin(1e-4));
    CHECK(imaginary("KahanLi8") == Approx(3.0965).margin(1e-4));
    CHECK(linear_limits_of("KahanLi8")->calls == 17);
    CHECK(linear_limits_of("Dopri5")->calls == 6);
    CHECK_FALSE(linear_limits_of("Rkn86")->real);
    CHECK_FALSE(linear_limits_of("Taylor"));
}

TEST_CASE("Taylor's method has the real interval of its order, and an imaginary one for half of the orders")
{
    for (const auto& [order, real] : {std::pair{2, 2.0},
                                      {3, 2.51275},
                                      {4, 2.78529},
                                      {5, 3.21705},
                                      {6, 3.55344},
                                      {7, 3.95413},
                                      {8, 4.31363},
                                      {10, 5.06952},
                                      {12, 5.82278},
                                      {16, 7.32433},
                                      {20, 8.82143},
                                      {24, 10.31534},
                                      {28, 11.80678},
                                      {30, 12.55173}}) {
        const auto limits = lagen::taylor_limits(static_cast<std::size_t>(order));
        CHECK(limits.real.value() == Approx(real).margin(1e-5));
        CHECK((limits.imaginary > 0) == (order % 4 == 3 || order % 4 == 0));
    }
}

TEST_CASE("Gauss' methods are A-stable, Radau IIA is L-stable")
{
    for (const char* type : {"Gauss2", "Gauss4", "Gauss6", "Gauss8", "Gauss12", "Gauss16"}) {
        const auto limits = linear_limits_of(type).value();
        CHECK(limits.imaginary == no_limit);
        CHECK(limits.real == no_limit);
        CHECK((limits.a_stable && !limits.l_stable));
    }
    for (const char* type : {"Radau3Fixed", "Radau5Fixed", "Radau5"}) CHECK(linear_limits_of(type)->l_stable);
    CHECK_FALSE(linear_limits_of("Rk4")->a_stable);
    CHECK(size_after_steps<lagen::Gauss8>(40) < 100); // |x| + |v|, where v is omega times as large
}

TEST_CASE("steps of the runtime grow beyond the interval and not inside of it")
{
    check_by_steps<lagen::Kutta3>("Kutta3");
    check_by_steps<lagen::Rk4>("Rk4");
    check_by_steps<lagen::Rk38>("Rk38");
    check_by_steps<lagen::LeapfrogDkd>("LeapfrogDkd");
    check_by_steps<lagen::LeapfrogKdk>("LeapfrogKdk");
    check_by_steps<lagen::McLachlan4>("McLachlan4");
    check_by_steps<lagen::BlanesMoan4>("BlanesMoan4");
    check_by_steps<lagen::Srkn4>("Srkn4");
    check_by_steps<lagen::Yoshida6>("Yoshida6");
    check_by_steps<lagen::BlanesMoan6>("BlanesMoan6");
    check_by_steps<lagen::Srkn6>("Srkn6");
    check_by_steps<lagen::KahanLi8>("KahanLi8");
    check_by_steps<lagen::Sofroniou10>("Sofroniou10");
    CHECK(size_after_steps<lagen::Heun>(0.2) > 1e4);
}

TEST_CASE("the program's table of intervals is what the coefficients give")
{
    lagen::testing::check_text("generator/scene/linear_limits_table.hpp", table_text());
}
