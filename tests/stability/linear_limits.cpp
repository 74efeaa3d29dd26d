// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/linear_limits.hpp"

#include "stability/one_step.hpp"
#include "stability/scheme_limits.hpp"

#include "lagen/dop853.hpp"
#include "lagen/dopri5.hpp"
#include "lagen/fixed_step.hpp"
#include "lagen/nystrom.hpp"
#include "lagen/splittings.hpp"
#include "lagen/tsit5.hpp"
#include "lagen/verner.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace lagen {

namespace {

using namespace stability;

double limit_of(std::initializer_list<std::optional<double>> ends)
{
    double least = no_limit;
    for (const std::optional<double>& end : ends) least = std::min(least, end.value_or(no_limit));
    return least;
}

/// Coefficients of a polynomial in y^2 that are those of 0 up to y^order.
std::size_t powers_up_to(int order)
{
    return static_cast<std::size_t>(order) / 2 * 2 + 1;
}

/// Of a polynomial R that agrees with exp to this order: |R(i y)|^2 = 1 up to y^order, and |R(-x)| <= 1.
LinearLimits polynomial_limits(const Polynomial& r, int order, std::size_t calls)
{
    const Polynomial one{1}, re = real_on_axis(r), im = imaginary_on_axis(r), left = reflected(r);
    LinearLimits limits;
    limits.imaginary =
        limit_of({first_negative(in_squares(one - (re * re + Polynomial{0, 1} * im * im)), powers_up_to(order))});
    limits.real = limit_of({first_negative(one - left, 1), first_negative(one + left)});
    limits.calls = calls;
    return limits;
}

template <class Tableau>
LinearLimits explicit_limits()
{
    return polynomial_limits(explicit_function<Tableau>(), Tableau::order, stages_of_step<Tableau>());
}

/// The moduli of both eigenvalues are 1 at most where the determinant D and the trace T have D <= 1, |T| <= 1 + D;
/// D = 1 up to u^(order/2), and T = 2 at u = 0.
double limit_of_matrix(const StepMatrix& m, int order)
{
    const Polynomial one{1}, trace = m.trace(), determinant = m.determinant();
    return limit_of({first_negative(in_squares(one - determinant), powers_up_to(order)),
                     first_negative(in_squares(one + determinant - trace), 1),
                     first_negative(in_squares(one + determinant + trace))});
}

template <class Tableau>
LinearLimits nystrom_limits()
{
    LinearLimits limits;
    if constexpr (requires { Tableau::a; }) limits = explicit_limits<Tableau>(); // x' = v, v' = lambda v
    limits.imaginary = limit_of_matrix(nystrom_matrix<Tableau>(), Tableau::order);
    limits.calls = Tableau::end;
    return limits;
}

/// D = 1: drifts and kicks keep the area.
template <class Splitting>
LinearLimits splitting_limits()
{
    const Polynomial two{2}, trace = splitting_matrix<Splitting>().trace();
    LinearLimits limits;
    limits.imaginary = limit_of({first_negative(in_squares(two - trace), 1), first_negative(in_squares(two + trace))});
    // The last kick of a step is the first of the next one.
    limits.calls = Splitting::weights.size() / 2;
    return limits;
}

/// |P(i y)| <= |Q(i y)| for all y, and no pole on the left, make it A-stable (the maximum principle).
template <class Scheme>
LinearLimits implicit_limits()
{
    const RationalFunction r = implicit_function<Scheme>();
    const auto square_on_axis = [](const Polynomial& p) {
        const Polynomial re = real_on_axis(p), im = imaginary_on_axis(p);
        return re * re + Polynomial{0, 1} * im * im;
    };
    const Polynomial p = reflected(r.numerator), q = reflected(r.denominator);
    LinearLimits limits;
    limits.imaginary =
        limit_of({first_negative(in_squares(square_on_axis(r.denominator) - square_on_axis(r.numerator)))});
    limits.real = limit_of({first_negative(q - p), first_negative(q + p)});
    limits.a_stable = limits.imaginary == no_limit && has_zeros_on_the_right(r.denominator);
    limits.l_stable = limits.a_stable && sgn(r.numerator.back()) == 0;
    return limits;
}

struct KnownMethod {
    std::string_view type;
    LinearLimits (*limits)();
};

constexpr std::array known_methods{
    KnownMethod{"Euler", explicit_limits<tableau::Euler>},
    KnownMethod{"Midpoint", explicit_limits<tableau::Midpoint>},
    KnownMethod{"Heun", explicit_limits<tableau::Heun>},
    KnownMethod{"Ralston", explicit_limits<tableau::Ralston>},
    KnownMethod{"Kutta3", explicit_limits<tableau::Kutta3>},
    KnownMethod{"Rk4", explicit_limits<tableau::Rk4>},
    KnownMethod{"Rk38", explicit_limits<tableau::Rk38>},
    KnownMethod{"Dopri5", explicit_limits<tableau::Dopri5>},
    KnownMethod{"Tsit5", explicit_limits<tableau::Tsit5>},
    KnownMethod{"Dop853", explicit_limits<tableau::Dop853>},
    KnownMethod{"Verner65", explicit_limits<tableau::Verner65>},
    KnownMethod{"Verner76", explicit_limits<tableau::Verner76>},
    KnownMethod{"Verner87", explicit_limits<tableau::Verner87>},
    KnownMethod{"Verner98", explicit_limits<tableau::Verner98>},
    KnownMethod{"Rkn64", nystrom_limits<tableau::Rkn64>},
    KnownMethod{"Rkn86", nystrom_limits<tableau::Rkn86>},
    KnownMethod{"Rkn1210", nystrom_limits<tableau::Rkn1210>},
    KnownMethod{"Rkng54", nystrom_limits<tableau::Rkng54>},
    KnownMethod{"Gauss2", implicit_limits<detail::GaussScheme<1>>},
    KnownMethod{"Gauss4", implicit_limits<detail::GaussScheme<2>>},
    KnownMethod{"Gauss6", implicit_limits<detail::GaussScheme<3>>},
    KnownMethod{"Gauss8", implicit_limits<detail::GaussScheme<4>>},
    KnownMethod{"Gauss12", implicit_limits<detail::GaussScheme<6>>},
    KnownMethod{"Gauss16", implicit_limits<detail::GaussScheme<8>>},
    KnownMethod{"Radau5", implicit_limits<detail::RadauScheme<3>>},
    KnownMethod{"Radau3Fixed", implicit_limits<detail::RadauScheme<2>>},
    KnownMethod{"Radau5Fixed", implicit_limits<detail::RadauScheme<3>>},
    KnownMethod{"LeapfrogDkd", splitting_limits<splitting::LeapfrogDkd>},
    KnownMethod{"LeapfrogKdk", splitting_limits<splitting::LeapfrogKdk>},
    KnownMethod{"McLachlan4", splitting_limits<splitting::McLachlan4>},
    KnownMethod{"BlanesMoan4", splitting_limits<splitting::BlanesMoan4>},
    KnownMethod{"Srkn4", splitting_limits<splitting::Srkn4>},
    KnownMethod{"Yoshida6", splitting_limits<splitting::Yoshida6>},
    KnownMethod{"BlanesMoan6", splitting_limits<splitting::BlanesMoan6>},
    KnownMethod{"Srkn6", splitting_limits<splitting::Srkn6>},
    KnownMethod{"KahanLi8", splitting_limits<splitting::KahanLi8>},
    KnownMethod{"Sofroniou10", splitting_limits<splitting::Sofroniou10>},
};

} // namespace

std::optional<LinearLimits> linear_limits_of(const std::string& type)
{
    const auto found = std::ranges::find(known_methods, std::string_view(type), &KnownMethod::type);
    if (found == known_methods.end()) return std::nullopt;
    return found->limits();
}

LinearLimits taylor_limits(std::size_t order)
{
    Polynomial r{1};
    for (std::size_t k = 1; k <= order; ++k) r.push_back(r.back() / static_cast<unsigned long>(k));
    return polynomial_limits(r, static_cast<int>(order), 0);
}

std::vector<LinearLimits> computed_limits()
{
    std::vector<LinearLimits> all;
    const auto add = [&](std::string_view of, const LinearLimits& limits) { all.emplace_back(limits).of = of; };
    for (const KnownMethod& method : known_methods) add(method.type, method.limits());
    add("taylor:4", taylor_limits(4));
    add("taylor:10", taylor_limits(10));
    add("taylor:20", taylor_limits(20));
    add("taylor:30", taylor_limits(30));
    for (const std::string_view scheme : scheme_names()) add(scheme, scheme_limits(std::string(scheme)).value());
    return all;
}

} // namespace lagen
