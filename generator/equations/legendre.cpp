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
std::optional<SquareMatrix> constant_hessian(const SymbolicModel& symbolic, const Sum& p, const Sum& y)
{
    SquareMatrix W{y.size(), {}};
    for (std::size_t a = 0; a < y.size(); ++a)
        for (std::size_t b = 0; b < y.size(); ++b) {
            GiNaC::ex entry = symbolic.derivative(p[a], y[b]);
            if (depends_on(entry, y)) {
                if (!expanded_length(entry)) return {};
                entry = entry.expand();
                if (depends_on(entry, y)) return {};
            }
            W.entries.push_back(entry);
        }
    return W;
}

bool couples_by(const SymbolicModel& symbolic, const SquareMatrix& W)
{
    for (std::size_t a = 0; a < W.order; ++a)
        for (std::size_t b = 0; b < a; ++b)
            if (symbolic.depends_on(W(a, b), symbolic.x())) return true;
    return false;
}

constexpr std::size_t long_hessian = 12; ///< terms of its entries, written out

/// Symbols W_ab for the entries of a coupled Hessian that is long; false where it is short.
bool name_entries(SymbolicModel& symbolic, SquareMatrix& W)
{
    std::size_t terms = 0;
    for (const GiNaC::ex& entry : W.entries) terms += expanded_length(entry).value_or(long_hessian);
    if (terms < long_hessian) return false;
    const std::vector<Symbol>& y = symbolic.algebroid().fibre;
    for (std::size_t a = 0; a < W.order; ++a)
        for (std::size_t b = a; b < W.order; ++b)
            W.entries[a * W.order + b] = W.entries[b * W.order + a] =
                symbolic.named("W_" + y[a].name + "_" + y[b].name, W(a, b));
    return true;
}

} // namespace

std::optional<LegendreTransform> legendre_transform(SymbolicModel& symbolic, const GiNaC::ex& lagrangian)
{
    const Sum& y = symbolic.y();
    Sum p;
    GiNaC::exmap rest;
    for (const GiNaC::ex& velocity : y) {
        p.push_back(symbolic.derivative(lagrangian, velocity));
        rest[velocity] = 0;
    }
    std::optional<SquareMatrix> W = constant_hessian(symbolic, p, y);
    if (!W) return {};
    Sum difference; // mu_a - b_a
    for (std::size_t a = 0; a < y.size(); ++a)
        difference.push_back(symbolic.mu()[a] - p[a].subs(rest, GiNaC::subs_options::no_pattern));
    const auto simpler = [&](const GiNaC::ex& e) { return symbolic.simpler(e); };
    const bool coupled = couples_by(symbolic, *W);
    Rewriting divisor;
    if (coupled && name_entries(symbolic, *W)) divisor = [&](const GiNaC::ex& e) { return symbolic.named("det_W", e); };
    auto velocities = solve_in_blocks(*W, difference, simpler, divisor);
    if (!velocities) return {};
    for (GiNaC::ex& velocity : *velocities) velocity = simpler(velocity);
    // L = y.Wy/2 + b.y + L_0, so that H = (mu - b).y/2 - L_0.
    Sum terms = {-lagrangian.subs(rest, GiNaC::subs_options::no_pattern)};
    for (std::size_t a = 0; a < y.size(); ++a) terms.push_back(difference[a] * (*velocities)[a] / 2);
    return LegendreTransform{total(terms), *velocities, coupled};
}

} // namespace lagen
