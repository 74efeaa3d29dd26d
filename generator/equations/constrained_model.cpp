// SPDX-License-Identifier: GPL-2.0-or-later
#include "equations/constrained_model.hpp"

namespace lagen {

namespace {

/// Y on the constraint is put in for Y, and y is solved for.
std::set<std::string> substituted_in(const Model& model, const System& system)
{
    std::set<std::string> names = name_set(system.written.algebroid.fibre);
    names.merge(name_set(model.fibre.coordinates));
    return names;
}

} // namespace

ConstrainedModel::ConstrainedModel(const Model& model, const System& system, const DefinitionChoice& choice)
    : written_(*system.written.distribution),
      symbolic_(model, system.written.algebroid, {model.lagrangian, model.dissipation}, choice,
                substituted_in(model, system)),
      r_(symbolic_.r()), k_(written_.y.size()), sections_(k_, Sum(r_, 0)), drift_(r_, 0)
{
    for (const Symbol& symbol : written_.y) y_.push_back(symbolic_.lower(name(symbol.name)));
    for (const SectionValue& entry : written_.sections) sections_[entry.alpha][entry.a] += symbolic_.lower(entry.value);
    for (const SectionValue& entry : written_.drift) drift_[entry.a] += symbolic_.lower(entry.value);
    Y_ = drift_;
    for (std::size_t alpha = 0; alpha < k_; ++alpha)
        for (std::size_t a = 0; a < r_; ++a) Y_[a] += sections_[alpha][a] * y_[alpha];
    lagrangian_ = symbolic_.reduced(symbolic_.lower(model.lagrangian));
    for (const GiNaC::ex& Y : symbolic_.y()) ambient_momenta_.push_back(symbolic_.derivative(lagrangian_, Y));
    l_ = on_constraint(lagrangian_);
    for (const GiNaC::ex& P : ambient_momenta_) P_.push_back(on_constraint(P));
    for (const GiNaC::ex& y : y_) p_.push_back(symbolic_.derivative(l_, y));
    forces_ = symbolic_.forces(Y_);
}

GiNaC::ex ConstrainedModel::on_constraint(const GiNaC::ex& f) const
{
    GiNaC::exmap there;
    for (std::size_t a = 0; a < r_; ++a)
        if (!Y_[a].is_equal(symbolic_.y()[a])) there[symbolic_.y()[a]] = Y_[a];
    return f.subs(there, GiNaC::subs_options::no_pattern);
}

Sum ConstrainedModel::along(const Sum& s, const GiNaC::ex& f) const
{
    Sum terms;
    for (std::size_t a = 0; a < r_; ++a) {
        if (s[a].is_zero()) continue;
        for (const GiNaC::ex& term : symbolic_.along_anchor(a, f)) terms.push_back(s[a] * term);
    }
    return terms;
}

Sum ConstrainedModel::bracket(const Sum& s, const Sum& t) const
{
    Sum result;
    for (std::size_t a = 0; a < r_; ++a) {
        GiNaC::ex component = total(along(s, t[a])) - total(along(t, s[a]));
        for (std::size_t c = 0; c < r_; ++c)
            for (std::size_t d = 0; d < r_; ++d)
                if (!symbolic_.C(a, c, d).is_zero()) component += s[c] * t[d] * symbolic_.C(a, c, d);
        result.push_back(component);
    }
    return result;
}

Equation ConstrainedModel::section_equation(LeftSide left, std::size_t alpha, std::size_t beta, const Sum& s,
                                            const std::vector<Symbol>& frame) const
{
    Equation equation{left, written_.y[alpha].name, {}, {}};
    if (left == LeftSide::commutator) equation.other = written_.y[beta].name;
    for (std::size_t a = 0; a < s.size(); ++a)
        for (TermGroup& group : symbolic_.simplified({{"", s[a]}})) {
            group.basis = {frame[a].name};
            equation.groups.push_back(std::move(group));
        }
    return equation;
}

EquationBlock ConstrainedModel::sections()
{
    EquationBlock block{"sections", "e_α = A_α^a e_a", R"(e_\alpha = A_\alpha^a\, e_a)", {}};
    for (std::size_t alpha = 0; alpha < k_; ++alpha)
        block.equations.push_back(
            section_equation(LeftSide::section, alpha, alpha, sections_[alpha], symbolic_.algebroid().fibre));
    return block;
}

EquationBlock ConstrainedModel::velocities()
{
    EquationBlock block{"ambient velocities",
                        has_drift() ? "Y^a = b^a + A_α^a y^α" : "Y^a = A_α^a y^α",
                        has_drift() ? R"(Y^a = b^a + A_\alpha^a\, y^\alpha)" : R"(Y^a = A_\alpha^a\, y^\alpha)",
                        {}};
    for (std::size_t a = 0; a < r_; ++a)
        if (!Y_[a].is_equal(symbolic_.y()[a]))
            block.equations.push_back(symbolic_.equation(LeftSide::symbol, ambient_name(a), {Y_[a]}));
    return block;
}

std::vector<Group> ConstrainedModel::balance(std::size_t alpha)
{
    GiNaC::ex bracket_term, moving, force;
    const Sum V = bracket(sections_[alpha], Y_);
    for (std::size_t a = 0; a < r_; ++a) {
        bracket_term -= P_[a] * V[a];
        moving += P_[a] * symbolic_.time_derivative(sections_[alpha][a]);
        force += sections_[alpha][a] * forces_[a];
    }
    return {{"ρ(e_α)(l)", total(along(sections_[alpha], l_))},
            {"-P_a [e_α, Y]^a", bracket_term},
            {"P_a ∂A_α^a/∂t", moving},
            {"Q_α", force}};
}

GiNaC::ex ConstrainedModel::at_fixed_velocity(const GiNaC::ex& f)
{
    return total(along(Y_, f)) + symbolic_.time_derivative(f);
}

GiNaC::ex ConstrainedModel::as_fraction(const GiNaC::ex& e)
{
    const GiNaC::ex simple = symbolic_.simpler(e);
    return has_short_fraction(simple) ? simple.normal() : simple;
}

SquareMatrix ConstrainedModel::hessian()
{
    SquareMatrix W{k_, {}};
    for (std::size_t alpha = 0; alpha < k_; ++alpha)
        for (std::size_t beta = 0; beta < k_; ++beta)
            W.entries.push_back(symbolic_.simpler(symbolic_.derivative(p_[alpha], y_[beta])));
    return W;
}

std::optional<GiNaC::exvector> ConstrainedModel::solved(const SquareMatrix& matrix, const Sum& right)
{
    return solve_in_blocks(matrix, right, [this](const GiNaC::ex& e) { return symbolic_.simpler(e); });
}

std::optional<GiNaC::exvector> ConstrainedModel::accelerations()
{
    Sum right;
    for (std::size_t alpha = 0; alpha < k_; ++alpha) {
        GiNaC::ex force = -at_fixed_velocity(p_[alpha]);
        for (const Group& group : balance(alpha)) force += group.value;
        right.push_back(symbolic_.simpler(force));
    }
    return solved(hessian(), right);
}

Sum ConstrainedModel::along_motion(const GiNaC::ex& f, const GiNaC::exvector& ydot)
{
    Sum terms{at_fixed_velocity(f)};
    for (std::size_t alpha = 0; alpha < k_; ++alpha) terms.push_back(symbolic_.derivative(f, y_[alpha]) * ydot[alpha]);
    return terms;
}

} // namespace lagen
