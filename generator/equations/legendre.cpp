// SPDX-License-Identifier: GPL-2.0-or-later
#include "equations/legendre.hpp"

#include "equations/linear_equations.hpp"

namespace lagen {
namespace {

bool depends_on(const GiNaC::ex& f, const Sum& variables)
{
    for (const GiNaC::ex& variable : variables)
        if (f.has(variable)) return true;
    return false;
}

/// W_ab = dp_a/dy^b; nothing where an entry depends on y.
std::optional<SquareMatrix> constant_hessian(const Sum& p, const Sum& y)
{
    SquareMatrix W{y.size(), {}};
    for (std::size_t a = 0; a < y.size(); ++a)
        for (std::size_t b = 0; b < y.size(); ++b) {
            GiNaC::ex entry = derivative(p[a], y[b]);
            if (depends_on(entry, y)) {
                if (!expanded_length(entry)) return {};
                entry = entry.expand();
                if (depends_on(entry, y)) return {};
            }
            W.entries.push_back(entry);
        }
    return W;
}

bool couples_by(const SquareMatrix& W, const Sum& x)
{
    for (std::size_t a = 0; a < W.order; ++a)
        for (std::size_t b = 0; b < a; ++b)
            if (depends_on(W(a, b), x)) return true;
    return false;
}

} // namespace

std::optional<LegendreTransform> legendre_transform(SymbolicModel& symbolic, const GiNaC::ex& lagrangian)
{
    const Sum& y = symbolic.y();
    Sum p;
    GiNaC::exmap rest;
    for (const GiNaC::ex& velocity : y) {
        p.push_back(derivative(lagrangian, velocity));
        rest[velocity] = 0;
    }
    const std::optional<SquareMatrix> W = constant_hessian(p, y);
    if (!W) return {};
    Sum difference; // mu_a - b_a
    for (std::size_t a = 0; a < y.size(); ++a)
        difference.push_back(symbolic.mu()[a] - p[a].subs(rest, GiNaC::subs_options::no_pattern));
    const auto simpler = [&](const GiNaC::ex& e) { return symbolic.simpler(e); };
    auto velocities = solve_in_blocks(*W, difference, simpler);
    if (!velocities) return {};
    for (GiNaC::ex& velocity : *velocities) velocity = simpler(velocity);
    // L = y.Wy/2 + b.y + L_0, so that H = (mu - b).y/2 - L_0.
    Sum terms = {-lagrangian.subs(rest, GiNaC::subs_options::no_pattern)};
    for (std::size_t a = 0; a < y.size(); ++a) terms.push_back(difference[a] * (*velocities)[a] / 2);
    return LegendreTransform{total(terms), *velocities, couples_by(*W, symbolic.x())};
}

} // namespace lagen
