// SPDX-License-Identifier: GPL-2.0-or-later
/// H = mu_a sigma^a - cost,   xdot^i = rho^i_a sigma^a,   mudot_a = -(rho_a(H) + mu_c C^c_ab sigma^b)    [Martinez
/// 2004] The controls solve dH/du = 0: linearly where that is affine in u, else by Newton's method. Between bounds each
/// control has a part of H of its own that is strictly concave (verify/control_maximum.hpp): the maximum is the root
/// of dH/du, or the bound next to it.
#include "graph/differentiate.hpp"
#include "graph/simplify.hpp"
#include "kernels/formulation.hpp"
#include "mechanics/phase_motion.hpp"
#include "verify/control_maximum.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

namespace {

class PontryaginForm {
  public:
    PontryaginForm(Graph& graph, const Model& model, const System& system, const Report& verified)
        : graph_(graph), model_(model), control_(*model.control), verified_(verified), system_(system), mu_(system.mu),
          u_(system.control->u), sigma_(system.control->sigma), cost_(system.control->cost)
    {
        require_maximum(system.name, verified.maximum);
        hamiltonian_ = control_hamiltonian(graph, *system.control, mu_);
        differentiate();
        solve_controls();
    }

    Formulation build(const FormulationParts& parts)
    {
        Formulation form = empty_form(system_, FormKind::pontryagin, mu_);
        form.implicit = implicit_;
        form.pivots = pivots_;
        for (const Symbol& symbol : control_.controls) form.controls.push_back(symbol.name);
        require_intervals(form);
        const std::vector<NodeId> sigma = at_controls(sigma_);
        if (parts.motion) {
            form.derivative = base_velocity(graph_, system_.algebroid, sigma);
            MomentumBalance balance;
            for (const NodeId slope : at_controls(dH_dx_)) balance.df_dx.push_back(graph_.negate(slope));
            balance.p = mu_;
            balance.y = sigma;
            balance.forces = std::vector<NodeId>(mu_.size(), graph_.constant(0));
            const std::vector<NodeId> rate = momentum_rates(graph_, system_.algebroid, balance);
            form.derivative.insert(form.derivative.end(), rate.begin(), rate.end());
        }
        form.documentation = {
            "Pontryagin's equations for H = mu_a sigma^a - cost, ds = (xdot, mudot): xdot^i = rho^i_a "
            "sigma^a and",
            "mudot_a = -(rho_a(H) + mu_c C^c_ab sigma^b), with the controls that solve dH/du = 0" +
                std::string(control_.bounds.empty() ? "." : ", or are at the bound next to that."),
            "s and ds may be the same object."};
        if (verified_.maximum.kind != ControlMaximum::Kind::maximal)
            form.documentation.insert(form.documentation.end() - 1, stationary_controls);
        bind_names(form);
        add_kernels(form);
        return form;
    }

  private:
    void differentiate()
    {
        dH_du_ = gradient(graph_, hamiltonian_, u_);
        std::vector<NodeId> variables = system_.algebroid.x;
        variables.push_back(system_.time);
        dH_dx_ = gradient(graph_, hamiltonian_, variables);
        dH_dt_ = dH_dx_.back();
        dH_dx_.pop_back();
        std::vector<NodeId> curvature = joined_rows(jacobian(graph_, dH_du_, u_));
        for (NodeId& entry : curvature) entry = graph_.negate(entry); // positive where H is concave
        std::vector<NodeId> divisors;
        curvature_ = simplify(graph_, curvature, divisors);
    }

    [[nodiscard]] NodeId curvature(std::size_t k, std::size_t l) const { return curvature_[k * u_.size() + l]; }

    void solve_controls()
    {
        // Where what must be positive has cancelled in dH/du, its root may lie where H is not defined.
        const bool linear = !depends_on_any(graph_, curvature_, u_) &&
                            (!control_.bounds.empty() || positive_operands(graph_, hamiltonian_, u_).empty());
        if (linear) {
            solve_linearly();
            clip();
        } else if (control_.bounds.empty() && !stand_apart()) {
            solve_by_newton();
        } else {
            solve_between_bounds();
        }
    }

    /// Whether each dH/du_k holds no other control and falls with its own: then no step can miss the root.
    [[nodiscard]] bool stand_apart() const
    {
        for (std::size_t k = 0; k < u_.size(); ++k)
            for (std::size_t l = 0; l < u_.size(); ++l)
                if (k != l && !graph_.is_zero(curvature(k, l))) return false;
        return verified_.maximum.kind == ControlMaximum::Kind::maximal && !verified_.maximum.on_part;
    }

    void solve_linearly()
    {
        const std::vector<NodeId> zeros(u_.size(), graph_.constant(0));
        const std::vector<NodeId> right = substitute(graph_, dH_du_, replacements(u_, zeros));
        solution_ = graph_.solve(curvature_, right, MatrixStructure::symmetric);
        pivots_ = single_blocks(graph_, curvature_, u_.size());
    }

    void solve_by_newton()
    {
        implicit_.push_back(gradient_block(graph_, "controls", "u with dH/du = 0.", u_, dH_du_, hamiltonian_,
                                           verified_.maximum.newton_start));
        solution_ = u_;
    }

    /// Each control by itself: dH/du_k falls with u_k and holds no other control.
    void solve_between_bounds()
    {
        ImplicitBlock block = implicit_block(
            graph_, "controls",
            control_.bounds.empty() ? "u with dH/du = 0."
                                    : "u with dH/du = 0, each between its bounds, or the bound next to it.",
            u_, dH_du_, {}, MatrixStructure::symmetric);
        Bracket& bracket = block.bracket.emplace();
        bracket.lower.resize(u_.size());
        bracket.upper.resize(u_.size());
        solution_ = u_;
        Lowering lower(graph_);
        for (const ControlBound& bound : control_.bounds) {
            const std::size_t k = bound.control;
            NodeId& u = solution_[k];
            if (bound.upper) {
                const NodeId end = lower(bound.upper);
                bracket.upper[k] = end;
                u = graph_.select(graph_.apply(Op::greater_equal, u_[k], end), end, u);
            }
            if (bound.lower) {
                const NodeId end = lower(bound.lower);
                bracket.lower[k] = end;
                u = graph_.select(graph_.apply(Op::less_equal, u_[k], end), end, u);
            }
        }
        implicit_.push_back(std::move(block));
    }

    void clip()
    {
        Lowering lower(graph_);
        for (const ControlBound& bound : control_.bounds) {
            NodeId& u = solution_[bound.control];
            if (bound.lower) u = graph_.apply(Op::maximum, u, lower(bound.lower));
            if (bound.upper) u = graph_.apply(Op::minimum, u, lower(bound.upper));
        }
    }

    /// Bounds over parameters: the lower below the upper, a single one finite. Those of numbers alone are checked where
    /// they are read.
    void require_intervals(Formulation& form)
    {
        Lowering lower(graph_);
        const auto is_number = [](const Tree& end) { return names_in(end).empty(); };
        for (const ControlBound& bound : control_.bounds) {
            if (bound.lower && bound.upper) {
                if (is_number(bound.lower) && is_number(bound.upper)) continue;
                form.parameter_conditions.emplace_back(
                    fmt::format("{} < {}", to_text(bound.lower), to_text(bound.upper)),
                    graph_.subtract(lower(bound.upper), lower(bound.lower)));
                continue;
            }
            const Tree& end = bound.lower ? bound.lower : bound.upper;
            if (!is_number(end))
                form.parameter_conditions.emplace_back(
                    to_text(end) + " is finite",
                    graph_.divide(graph_.constant(1),
                                  graph_.add(graph_.constant(1), graph_.apply(Op::abs, lower(end)))));
        }
    }

    [[nodiscard]] const std::string& name_of(std::size_t k) const { return control_.controls[k].name; }

    /// The unknowns of an implicit block stand for themselves, clipped ones for their clipped values.
    [[nodiscard]] std::vector<NodeId> at_controls(const std::vector<NodeId>& nodes)
    {
        return substitute(graph_, nodes, replacements(u_, solution_));
    }

    void bind_names(Formulation& form)
    {
        const std::vector<NodeId> values = at_controls({hamiltonian_, cost_});
        form.binding["energy"] = form.binding["hamiltonian"] = values[0];
        form.binding["lagrangian"] = values[1]; // of the control problem: the cost
        const std::vector<NodeId> sigma = at_controls(sigma_);
        for (std::size_t a = 0; a < mu_.size(); ++a) {
            form.binding[model_.fibre.coordinates[a].name] = sigma[a];
            form.binding[model_.fibre.momenta[a].name] = mu_[a];
        }
        for (std::size_t k = 0; k < u_.size(); ++k) form.binding[name_of(k)] = solution_[k];
        bind_system(system_, form);
    }

    void add_kernels(Formulation& form)
    {
        const std::vector<NodeId> values = at_controls({hamiltonian_, cost_, dH_dt_});
        Kernel controls = table_kernel(form, "controls", column("u", solution_));
        if (verified_.maximum.kind != ControlMaximum::Kind::maximal) controls.documentation = {stationary_controls};
        controls.entry_names = form.controls;
        form.kernels.push_back(std::move(controls));
        form.kernels.push_back(scalar_kernel(form, "hamiltonian", values[0]));
        if (!graph_.is_zero(values[2])) form.kernels.push_back(scalar_kernel(form, "power", values[2]));
        form.kernels.push_back(scalar_kernel(form, "cost", values[1]));
    }

    Graph& graph_;
    const Model& model_;
    const Control& control_;
    const Report& verified_;
    const System& system_;
    std::vector<NodeId> mu_, u_, sigma_;
    NodeId cost_ = 0, hamiltonian_ = 0, dH_dt_ = 0;
    std::vector<NodeId> dH_du_, dH_dx_, curvature_;
    std::vector<NodeId> solution_; ///< u over the state, or the unknowns
    std::vector<NodeId> pivots_;
    std::vector<ImplicitBlock> implicit_;
};

} // namespace

Formulation pontryagin_form(Graph& graph, const Model& model, const System& system, const Report& report,
                            const FormulationParts& parts)
{
    if (!model.control)
        throw MathematicsError(fmt::format("model '{}' is no control problem; the Pontryagin form needs "
                                           "[control] with controls, sigma and cost",
                                           model.name));
    return PontryaginForm(graph, model, system, report).build(parts);
}

} // namespace lagen
