// SPDX-License-Identifier: GPL-2.0-or-later
/// The coefficients of the collocation methods: simplifying assumptions, order conditions, exact symplecticity of the
/// rounded numbers, eigenvalues and eigenvectors; in 50 digits, where nothing but exact formulas passes.
#include "lagen/integrate/collocation.hpp"
#include "support/rooted_trees.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <catch2/catch.hpp>

#include <vector>

namespace mp = boost::multiprecision;
using Wide = mp::number<mp::cpp_bin_float<50>, mp::et_off>;
using lagen::detail::Collocation;
using lagen::detail::Complex;
using lagen::detail::GaussScheme;
using lagen::detail::RadauScheme;

namespace {

const Wide tiny("1e-47");

template <class Scheme>
std::vector<std::vector<Wide>> matrix()
{
    const auto method = Scheme::template coefficients<Wide>();
    std::vector<std::vector<Wide>> a(Scheme::stages, std::vector<Wide>(Scheme::stages));
    for (std::size_t i = 0; i < Scheme::stages; ++i)
        for (std::size_t j = 0; j < Scheme::stages; ++j) a[i][j] = method.mu[i][j] * method.b[j];
    return a;
}

/// The largest residual of B(p): sum_i b_i c_i^(k-1) = 1/k for k = 1..p.
template <class Scheme>
Wide quadrature_residual(std::size_t p)
{
    const auto method = Scheme::template coefficients<Wide>();
    Wide worst = 0;
    for (std::size_t k = 1; k <= p; ++k) {
        Wide sum = Wide(-1) / k;
        for (std::size_t i = 0; i < Scheme::stages; ++i) sum += method.b[i] * pow(method.c[i], int(k) - 1);
        worst = std::max<Wide>(worst, abs(sum));
    }
    return worst;
}

/// C(q): sum_j a_ij c_j^(k-1) = c_i^k / k for k = 1..q.
template <class Scheme>
Wide stage_residual(std::size_t q)
{
    const auto method = Scheme::template coefficients<Wide>();
    const auto a = matrix<Scheme>();
    Wide worst = 0;
    for (std::size_t k = 1; k <= q; ++k)
        for (std::size_t i = 0; i < Scheme::stages; ++i) {
            Wide sum = -pow(method.c[i], int(k)) / k;
            for (std::size_t j = 0; j < Scheme::stages; ++j) sum += a[i][j] * pow(method.c[j], int(k) - 1);
            worst = std::max<Wide>(worst, abs(sum));
        }
    return worst;
}

/// D(r): sum_i b_i c_i^(k-1) a_ij = b_j (1 - c_j^k) / k for k = 1..r.
template <class Scheme>
Wide adjoint_residual(std::size_t r)
{
    const auto method = Scheme::template coefficients<Wide>();
    const auto a = matrix<Scheme>();
    Wide worst = 0;
    for (std::size_t k = 1; k <= r; ++k)
        for (std::size_t j = 0; j < Scheme::stages; ++j) {
            Wide sum = -method.b[j] * (1 - pow(method.c[j], int(k))) / k;
            for (std::size_t i = 0; i < Scheme::stages; ++i)
                sum += method.b[i] * pow(method.c[i], int(k) - 1) * a[i][j];
            worst = std::max<Wide>(worst, abs(sum));
        }
    return worst;
}

/// B, C, D hold up to these numbers and not beyond.
template <class Scheme>
void check_assumptions(std::size_t b, std::size_t c, std::size_t d, double beyond = 1e-6)
{
    CHECK(quadrature_residual<Scheme>(b) < tiny);
    CHECK(quadrature_residual<Scheme>(b + 1) > beyond);
    CHECK(stage_residual<Scheme>(c) < tiny);
    CHECK(stage_residual<Scheme>(c + 1) > beyond);
    CHECK(adjoint_residual<Scheme>(d) < tiny);
    CHECK(adjoint_residual<Scheme>(d + 1) > beyond);
}

template <class Scheme>
void check_order()
{
    const auto a = matrix<Scheme>();
    const auto method = Scheme::template coefficients<Wide>();
    const std::vector<Wide> b(method.b.begin(), method.b.end());
    constexpr auto order = static_cast<std::size_t>(Scheme::order);
    CHECK(lagen::support::worst_residual(a, b, 1, order) < tiny);
    CHECK(lagen::support::worst_residual(a, b, order + 1, order + 1) > 1e-7);
}

/// Not up to rounding: the rounded numbers themselves are those of a method that keeps quadratic invariants.
template <class Scheme, class Real>
void check_symplectic()
{
    const auto method = Scheme::template coefficients<Real>();
    Real sum = 0;
    for (std::size_t i = 0; i < Scheme::stages; ++i) {
        sum += method.b[i];
        for (std::size_t j = 0; j <= i; ++j) {
            const Real upper = method.mu[j][i], rest = Real(1) - method.mu[i][j];
            CHECK(upper == rest);
            CHECK(Real(1) - upper == method.mu[i][j]); // 1 - mu was not rounded
        }
        CHECK(method.b[i] == method.b[Scheme::stages - 1 - i]);
    }
    CHECK(sum == Real(1));
}

template <class Entry>
Wide distance(const Entry& x, const Entry& y)
{
    return lagen::detail::magnitude(Entry(x - y));
}

/// To `close`; no entry of the right vector is below `least`.
template <class Scheme, class Mode>
void check_mode(const Mode& mode, const Wide& close, double least)
{
    const auto a = matrix<Scheme>();
    using Entry = std::remove_cvref_t<decltype(mode.lambda)>;
    Entry product{};
    for (std::size_t i = 0; i < Scheme::stages; ++i) {
        Entry right{}, left{};
        for (std::size_t j = 0; j < Scheme::stages; ++j) {
            right = right + a[i][j] * mode.right[j];
            left = left + a[j][i] * mode.left[j];
        }
        CHECK(distance<Entry>(right, mode.lambda * mode.right[i]) < close);
        CHECK(distance<Entry>(left, mode.lambda * mode.left[i]) < close);
        CHECK(lagen::detail::magnitude(mode.right[i]) > least);
        product = product + mode.left[i] * mode.right[i];
    }
    Entry one{};
    if constexpr (std::is_same_v<Entry, Wide>)
        one = 1;
    else
        one.re = 1;
    CHECK(distance<Entry>(product, one) < close);
}

template <class Scheme>
void check_modes(const Wide& close = tiny, double least = 0.01)
{
    const auto modes = lagen::detail::modes<Scheme, Wide>(Scheme::template coefficients<Wide>().c);
    CHECK(modes.real.size() + 2 * modes.complex.size() == Scheme::stages);
    for (const auto& mode : modes.real) check_mode<Scheme>(mode, close, least);
    for (const auto& mode : modes.complex) check_mode<Scheme>(mode, close, least);
}

} // namespace

TEST_CASE("Gauss' nodes satisfy B(2s), C(s) and D(s), those of Radau IIA B(2s-1), C(s) and D(s-1), and no more")
{
    check_assumptions<GaussScheme<1>>(2, 1, 1);
    check_assumptions<GaussScheme<2>>(4, 2, 2);
    check_assumptions<GaussScheme<3>>(6, 3, 3);
    check_assumptions<GaussScheme<4>>(8, 4, 4);
    // By Butcher's theorem of 1964 they imply the orders 12 and 16, of 7,741 and 370,000 trees.
    check_assumptions<GaussScheme<6>>(12, 6, 6, 1e-8);
    check_assumptions<GaussScheme<8>>(16, 8, 8, 1e-10);
    check_assumptions<RadauScheme<2>>(3, 2, 1);
    check_assumptions<RadauScheme<3>>(5, 3, 2);
}

TEST_CASE("Collocation methods satisfy the order conditions of every rooted tree up to their order in 50 digits")
{
    check_order<GaussScheme<1>>();
    check_order<GaussScheme<2>>();
    check_order<GaussScheme<3>>();
    check_order<GaussScheme<4>>();
    check_order<RadauScheme<2>>();
    check_order<RadauScheme<3>>();
}

TEST_CASE("The rounded coefficients of Gauss' methods are exactly symplectic, symmetric and of sum 1 in every scalar")
{
    const auto check = []<class Real>(Real) {
        check_symplectic<GaussScheme<1>, Real>();
        check_symplectic<GaussScheme<2>, Real>();
        check_symplectic<GaussScheme<3>, Real>();
        check_symplectic<GaussScheme<4>, Real>();
        check_symplectic<GaussScheme<6>, Real>();
        check_symplectic<GaussScheme<8>, Real>();
    };
    check(0.0f);
    check(0.0);
    check(0.0L);
    check(Wide(0));
}

TEST_CASE("Rounded coefficients are those of 50 digits to their last places")
{
    const auto check = []<class Scheme>(Scheme) {
        const auto rounded = Scheme::template coefficients<double>();
        const auto exact = Scheme::template coefficients<Wide>();
        for (std::size_t i = 0; i < Scheme::stages; ++i) {
            CHECK(abs(Wide(rounded.c[i]) - exact.c[i]) < 2e-16);
            CHECK(abs(Wide(rounded.b[i]) - exact.b[i]) < 1e-16);
            for (std::size_t j = 0; j < Scheme::stages; ++j)
                CHECK(abs(Wide(rounded.mu[i][j]) - exact.mu[i][j]) < 5e-16);
        }
    };
    check(GaussScheme<1>{});
    check(GaussScheme<2>{});
    check(GaussScheme<3>{});
    check(GaussScheme<4>{});
    check(GaussScheme<6>{});
    check(GaussScheme<8>{});
    check(RadauScheme<2>{});
    check(RadauScheme<3>{});
}

TEST_CASE("The modes of a collocation method diagonalise its matrix")
{
    check_modes<GaussScheme<1>>();
    check_modes<GaussScheme<2>>();
    check_modes<GaussScheme<3>>();
    check_modes<GaussScheme<4>>();
    check_modes<GaussScheme<6>>(tiny * 100, 1e-3);
    check_modes<GaussScheme<8>>(tiny * 100, 1e-4);
    check_modes<RadauScheme<2>>();
    check_modes<RadauScheme<3>>();
    // gamma_0 of radau5.f: (6 + 81^(1/3) - 9^(1/3)) / 30 is the real eigenvalue of A.
    const auto radau = lagen::detail::modes<RadauScheme<3>, Wide>(RadauScheme<3>::coefficients<Wide>().c);
    CHECK(abs(radau.real[0].lambda - (6 + cbrt(Wide(81)) - cbrt(Wide(9))) / 30) < tiny);
}
