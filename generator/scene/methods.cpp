// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/methods.hpp"

#include "scene/linear_limits_table.hpp"
#include "text/diagnostic.hpp"

#include <fmt/core.h>

#include <array>
#include <utility>

namespace lagen {

namespace {

constexpr MethodEntry composition(const char* name, const char* type, const char* order, const char* text)
{
    MethodEntry entry{
        name, type, order, false, MethodKind::discrete, text, "symplectic or Poisson, momenta, the group"};
    entry.composes = true;
    return entry;
}

constexpr MethodEntry variational(const char* name, const char* order, const char* scheme, const char* text)
{
    MethodEntry entry{
        name, "Discrete", order, false, MethodKind::discrete, text, "symplectic or Poisson, momenta, the group"};
    entry.scheme = scheme;
    return entry;
}

constexpr std::array entries = [] {
    using enum MethodKind;
    return std::array{
        MethodEntry{"euler", "Euler", "1", false, explicit_stages, "explicit Euler"},
        MethodEntry{"midpoint", "Midpoint", "2", false, explicit_stages, "explicit midpoint (Runge 1895)"},
        MethodEntry{"heun", "Heun", "2", false, explicit_stages, "explicit trapezoidal rule (Heun 1900), for teaching"},
        MethodEntry{"ralston", "Ralston", "2", false, explicit_stages,
                    "two stages with least truncation error (Ralston 1962), for teaching"},
        MethodEntry{"kutta3", "Kutta3", "3", false, explicit_stages, "Kutta's third-order method (1901), for teaching"},
        MethodEntry{"rk4", "Rk4", "4", false, explicit_stages, "the classical Runge-Kutta method (Kutta 1901)"},
        MethodEntry{"rk38", "Rk38", "4", false, explicit_stages, "the 3/8 rule (Kutta 1901), for teaching"},
        MethodEntry{"dopri5", "Dopri5", "5(4)", true, explicit_stages,
                    "Dormand and Prince 1980, dense output of order 4"},
        MethodEntry{"tsit5", "Tsit5", "5(4)", true, explicit_stages,
                    "Tsitouras 2011, dense output of order 4, for teaching"},
        MethodEntry{"dop853", "Dop853", "8(5,3)", true, explicit_stages,
                    "Hairer, Norsett and Wanner 1993, dense output of order 7"},
        MethodEntry{"verner65", "Verner65", "6(5)", true, explicit_stages,
                    "Verner 2010, dense output of order 5, for teaching"},
        MethodEntry{"verner76", "Verner76", "7(6)", true, explicit_stages, "Verner 2010, dense output of order 6"},
        MethodEntry{"verner87", "Verner87", "8(7)", true, explicit_stages, "Verner 2010, dense output of order 7"},
        MethodEntry{"verner98", "Verner98", "9(8)", true, explicit_stages, "Verner 2010, dense output of order 8"},
        MethodEntry{"rkn64", "Rkn64", "6(4)", true, explicit_stages,
                    "Nystrom (Dormand and Prince 1987), dense output of order 5, for teaching", "",
                    SecondOrder::Kind::velocity_free},
        MethodEntry{"rkn86", "Rkn86", "8(6)", true, explicit_stages,
                    "Nystrom (Dormand, El-Mikkawy and Prince 1987), dense output of order 7", "",
                    SecondOrder::Kind::velocity_free},
        MethodEntry{"rkn1210", "Rkn1210", "12(10)", true, explicit_stages,
                    "Nystrom (Dormand, El-Mikkawy and Prince 1987), dense output of order 10", "",
                    SecondOrder::Kind::velocity_free},
        MethodEntry{"rkng54", "Rkng54", "5(4)", true, explicit_stages,
                    "Nystrom (Fine 1987), dense output of order 4, for teaching", "", SecondOrder::Kind::general},
        MethodEntry{"taylor", "Taylor", "3-30", true, series,
                    "Taylor series, order by the tolerance (Jorba and Zou 2005), dense output of that order"},
        MethodEntry{"gauss2", "Gauss2", "2", false, implicit_stages, "Gauss, one stage: the implicit midpoint rule",
                    "symplectic"},
        MethodEntry{"gauss4", "Gauss4", "4", false, implicit_stages, "Gauss, two stages (Kuntzmann, Butcher 1964)",
                    "symplectic"},
        MethodEntry{"gauss6", "Gauss6", "6", false, implicit_stages, "Gauss, three stages (Kuntzmann, Butcher 1964)",
                    "symplectic"},
        MethodEntry{"gauss8", "Gauss8", "8", false, implicit_stages, "Gauss, four stages (Kuntzmann, Butcher 1964)",
                    "symplectic"},
        MethodEntry{"gauss12", "Gauss12", "12", false, implicit_stages, "Gauss, six stages (Kuntzmann, Butcher 1964)",
                    "symplectic"},
        MethodEntry{"gauss16", "Gauss16", "16", false, implicit_stages, "Gauss, eight stages (Kuntzmann, Butcher 1964)",
                    "symplectic"},
        MethodEntry{"radau5", "Radau5", "5(3)", true, implicit_stages,
                    "Radau IIA (Hairer and Wanner 1991), stiff, dense output of order 3"},
        MethodEntry{"radau3_fixed", "Radau3Fixed", "3", false, implicit_stages,
                    "Radau IIA, two stages, fixed step, stiff"},
        MethodEntry{"radau5_fixed", "Radau5Fixed", "5", false, implicit_stages,
                    "Radau IIA, three stages, fixed step, stiff"},
        MethodEntry{"leapfrog_dkd", "LeapfrogDkd", "2", false, splitting, "Stoermer-Verlet, drift-kick-drift",
                    "symplectic"},
        MethodEntry{"leapfrog_kdk", "LeapfrogKdk", "2", false, splitting, "Stoermer-Verlet, kick-drift-kick",
                    "symplectic"},
        MethodEntry{"mclachlan4", "McLachlan4", "4", false, splitting,
                    "McLachlan and Atela 1992, four stages, for teaching", "symplectic", SecondOrder::Kind::no, true,
                    false},
        MethodEntry{"blanesmoan4", "BlanesMoan4", "4", false, splitting, "Blanes and Moan 2002, six stages",
                    "symplectic"},
        MethodEntry{"srkn4", "Srkn4", "4", false, splitting,
                    "Blanes and Moan 2002, six stages, best where x' is affine in y, for teaching", "symplectic"},
        MethodEntry{"yoshida6", "Yoshida6", "6", false, splitting,
                    "Yoshida 1990, solution A, seven leapfrogs, for teaching", "symplectic"},
        MethodEntry{"blanesmoan6", "BlanesMoan6", "6", false, splitting, "Blanes and Moan 2002, ten stages",
                    "symplectic"},
        MethodEntry{"srkn6", "Srkn6", "6", false, splitting, "Blanes and Moan 2002, fourteen stages", "symplectic",
                    SecondOrder::Kind::no, true},
        MethodEntry{"kahanli8", "KahanLi8", "8", false, splitting, "Kahan and Li 1997, 17 leapfrogs", "symplectic"},
        MethodEntry{"sofroniou10", "Sofroniou10", "10", false, splitting, "Sofroniou and Spaletta 2005, 35 leapfrogs",
                    "symplectic"},
        MethodEntry{"rkmk4", "Rkmk4", "4", false, group, "Munthe-Kaas 1999, the classical Runge-Kutta method in charts",
                    "group, orbits, Casimirs"},
        MethodEntry{"rkmk_dop853", "RkmkDop853", "8(5,3)", true, group,
                    "Munthe-Kaas 1999, DOP853 in charts, dense output of order 7", "group, orbits, Casimirs"},
        MethodEntry{"gauss_lie4", "GaussLie4", "4", false, group, "Gauss, two stages, in charts",
                    "group, orbits, Casimirs"},
        MethodEntry{"crouch_grossman3", "CrouchGrossman3", "3", false, group, "Crouch and Grossman 1993, three stages",
                    "group, orbits, Casimirs"},
        MethodEntry{"lie_poisson2", "LiePoisson2", "2", false, poisson,
                    "variational, logarithmic midpoint (Bou-Rabee and Marsden 2009)",
                    "Poisson, group, orbits, Casimirs"},
        MethodEntry{"lie_poisson4", "LiePoisson4", "4", false, poisson, "five steps of lie_poisson2 (Suzuki 1990)",
                    "Poisson, group, orbits, Casimirs"},
        MethodEntry{"discrete", "Discrete", "of L", false, discrete,
                    "discrete Euler-Lagrange equations on a Lie groupoid (Martinez 2001)",
                    "symplectic or Poisson, momenta, the group"},
        composition("discrete4", "Discrete4", "4", "five steps of L (Suzuki 1990)"),
        composition("discrete6", "Discrete6", "6", "nine steps of L (Kahan and Li 1997)"),
        composition("discrete8", "Discrete8", "8", "17 steps of L (Kahan and Li 1997)"),
        variational("variational2", "2", "gauss:1", "discrete Lagrangian of L by the midpoint, on pairs and groups"),
        variational("variational4", "4", "gauss:2", "Galerkin, two Gauss points (Marsden and West 2001)"),
        variational("variational6", "6", "gauss:3", "Galerkin, three Gauss points (Marsden and West 2001)"),
        variational("variational8", "8", "gauss:4", "Galerkin, four Gauss points (Marsden and West 2001)"),
    };
}();

/// What other programs and books call a method, in small letters.
constexpr std::array<std::pair<const char*, const char*>, 18> names_elsewhere{{{"rk45", "dopri5"},
                                                                               {"ode45", "dopri5"},
                                                                               {"runge_kutta", "rk4"},
                                                                               {"radau", "radau5"},
                                                                               {"ode15s", "radau5"},
                                                                               {"bdf", "radau5"},
                                                                               {"implicit_midpoint", "gauss2"},
                                                                               {"leapfrog", "leapfrog_kdk"},
                                                                               {"verlet", "leapfrog_kdk"},
                                                                               {"velocity_verlet", "leapfrog_kdk"},
                                                                               {"vern6", "verner65"},
                                                                               {"vern7", "verner76"},
                                                                               {"vern8", "verner87"},
                                                                               {"vern9", "verner98"},
                                                                               {"dprkn6", "rkn64"},
                                                                               {"dprkn8", "rkn86"},
                                                                               {"dprkn12", "rkn1210"},
                                                                               {"finerkn5", "rkng54"}}};

} // namespace

std::span<const MethodEntry> method_table()
{
    return entries;
}

const MethodEntry* find_method(const std::string& name)
{
    for (const MethodEntry& entry : entries)
        if (name == entry.name) return &entry;
    return nullptr;
}

std::string nearest_method(const std::string& name)
{
    std::string small = name;
    for (char& letter : small) {
        if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
        if (letter == '-') letter = '_';
    }
    for (const auto& [other, ours] : names_elsewhere)
        if (small == other) return ours;
    return nearest_name(small, method_names());
}

std::string hint_for_method(const std::string& name)
{
    const std::string nearest = nearest_method(name);
    return nearest.empty() ? "`lagen methods` lists them" : fmt::format("did you mean '{}'?", nearest);
}

bool is_symmetric_splitting(const MethodEntry& method)
{
    return method.kind == MethodKind::splitting && method.symmetric;
}

bool goes_abreast(const MethodEntry& method)
{
    return method.kind == MethodKind::explicit_stages || method.kind == MethodKind::series;
}

std::string system_of(const MethodEntry& method)
{
    if (*method.scheme != '\0') return "L on a tangent bundle, a Lie algebra, an action or an Atiyah algebroid";
    if (method.composes) return "discrete Lagrangians of order 2 with L(g, h) = -L(g^-1, -h)";
    if (method.kind == MethodKind::discrete) return "discrete Lagrangians";
    if (method.kind == MethodKind::group) return "states that a group moves linearly";
    if (method.kind == MethodKind::poisson) return "Lie-Poisson systems";
    if (method.kind == MethodKind::splitting)
        return method.affine ? "x' = M y + c, y' = g(x)" : "x' = f(y), y' = g(x) or a sum of exact flows";
    switch (method.system) {
    case SecondOrder::Kind::no: return "";
    case SecondOrder::Kind::general: return "x'' = f(t, x, x')";
    case SecondOrder::Kind::velocity_free: return "x'' = f(t, x)";
    }
    return "";
}

std::span<const std::string> method_names()
{
    static const std::vector<std::string> names = [] {
        std::vector<std::string> list;
        for (const MethodEntry& entry : entries) list.emplace_back(entry.name);
        return list;
    }();
    return names;
}

const LinearLimits* find_limits(std::string_view of)
{
    const auto found = std::ranges::find(linear_limits, of, &LinearLimits::of);
    return found == linear_limits.end() ? nullptr : &*found;
}

} // namespace lagen
