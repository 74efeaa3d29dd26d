// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/describe_check.hpp"

#include <fmt/format.h>

namespace lagen {

namespace {

/// "a,b" of (A, a, b); "value" of a function.
std::string component_of(const Check& check)
{
    std::string text;
    for (std::size_t k = 1; k < check.indices.size(); ++k) text += (k == 1 ? "" : ",") + check.indices[k];
    return text.empty() ? "value" : text;
}

/// Of the claims of a morphism Phi over phi.
std::string map_equation_text(const Check& check)
{
    const std::vector<std::string>& k = check.indices;
    if (check.name == "constraint" && k[0] == "Phi(D)") return "the rank of D' less that of Phi(D)";
    if (check.name == "constraint" && k.size() == 2 && k[0].starts_with("Phi("))
        return fmt::format("component {} of {} less its part along the constraint of the target", k[1], k[0]);
    if (check.name == "constraint" && k.size() == 1)
        return fmt::format("the constraint {} of the target at phi(x)", k[0]);
    if (check.name == "admissible" && k.size() == 2)
        return fmt::format("coordinate {1} of rho'(Phi({0})) - Tphi(rho({0}))", k[0], k[1]);
    if (check.name == "morphism" && k.size() == 3)
        return fmt::format("component {2} of [Phi({0}), Phi({1})] - Phi([{0}, {1}])", k[0], k[1], k[2]);
    if (check.name == "invariance" && k.size() == 1)
        return fmt::format("{0} of the source less {0} of the target along the map", k[0]);
    if (check.name == "invariance" && k.size() == 2)
        return fmt::format("{} of the source, component {}, less that of the target along the map", k[0], k[1]);
    if (check.name == "target" && k.size() == 1)
        return fmt::format("coordinate {} of the target of the image less phi(t(g))", k[0]);
    if (check.name == "product" && k.size() == 2)
        return fmt::format("entry {},{} of W'(g h) - W'(g) W'(h)", k[0], k[1]);
    if (check.name == "unit" && k.size() == 2) return fmt::format("entry {},{} of W' - 1 at the arrows 1", k[0], k[1]);
    if (check.name == "element") return "an entry of dW' at the arrows 1 outside of the algebra of the target's group";
    if (check.name == "fibre" && k.size() == 2)
        return fmt::format("component {} of Phi({}) as it is given less that of the map of arrows", k[0], k[1]);
    return "";
}

} // namespace

std::string equation_text(const Check& check)
{
    const std::vector<std::string>& k = check.indices;
    if (!check.meaning.empty()) return check.meaning;
    if (check.name == "antisymmetry" && k.size() == 3)
        return fmt::format("component {2} of [{0}, {1}] + [{1}, {0}]", k[0], k[1], k[2]);
    if (check.name == "anchor" && k.size() == 3)
        return fmt::format("component {2} of [rho({0}), rho({1})] - rho([{0}, {1}])", k[0], k[1], k[2]);
    if (check.name == "jacobi" && k.size() == 4)
        return fmt::format("component {3} of [{0}, [{1}, {2}]] + [{1}, [{2}, {0}]] + [{2}, [{0}, {1}]]", k[0], k[1],
                           k[2], k[3]);
    if (check.name == "tangency" && k.size() == 2)
        return fmt::format("rho({}) of the constraint {}, on the constraints", k[0], k[1]);
    if (check.name == "casimir" && k.size() == 2) return fmt::format("rho({}) of {}", k[0], k[1]);
    if (check.name == "unit" && k.size() == 1) return fmt::format("coordinate {0} of x.1 less {0}", k[0]);
    if (check.name == "action" && k.size() == 2)
        return fmt::format("d/ds {1} of x.(W exp(s E)) less {1} of the field of the action at x.W, generator {0}", k[0],
                           k[1]);
    if (check.name == "action" && k.size() == 1) return fmt::format("coordinate {} of x.(W W') less (x.W).W'", k[0]);
    if (check.name == "algebroid_of_groupoid" && k.size() == 2)
        return fmt::format("coordinate {1} of rho({0}) as it is given less that of the groupoid", k[0], k[1]);
    if (check.name == "algebroid_of_groupoid" && k.size() == 3)
        return fmt::format("component {2} of [{0}, {1}] as it is given less that of the groupoid", k[0], k[1], k[2]);
    if (const std::string of_map = map_equation_text(check); !of_map.empty()) return of_map;
    if (check.name == "constraint" && k.size() == 2)
        return k[0] == "drift" ? fmt::format("{} at the drift", k[1])
                               : fmt::format("the linear part of {} at the section {}", k[1], k[0]);
    if (check.name == "closed" && !k.empty()) return fmt::format("component {} of d({})", component_of(check), k[0]);
    if (check.name == "equals" && !k.empty())
        return fmt::format("component {} of {} less what it is said to equal", component_of(check), k[0]);
    if (check.name == "legendre") return "H at mu = dL/dy less y dL/dy - L";
    if (check.name == "maximum") return "H = mu_a sigma^a - cost is largest at the controls of Pontryagin's equations";
    if (check.name == "symmetry" && !k.empty())
        return fmt::format("the derivative of the Lagrangian (Hamiltonian) along the complete lift of {}", k[0]);
    if (check.name == "invariant" && k.size() == 1)
        return fmt::format("the rate of {} along the equations of motion", k[0]);
    return "";
}

} // namespace lagen
