// SPDX-License-Identifier: GPL-2.0-or-later
/// H = mu_a sigma^a - cost,   xdot^i = rho^i_a sigma^a,   mudot_a = -(rho_a(H) + mu_c C^c_ab sigma^b)    [Martinez
/// 2004] Angles have a closed form (verify/angle_controls.hpp). The other controls solve dH/du = 0: linearly where
/// that is affine in u, else by Newton's method. Between bounds each control has a part of H of its own that is
/// strictly concave (verify/control_maximum.hpp): the maximum is the root of dH/du, or the bound next to it. Controls
/// that are merely stationary are searched for where they were in the last step, and watched.
#include "graph/calculus/differentiate.hpp"
#include "graph/simplify/simplify.hpp"
#include "kernels/formulation.hpp"
#include "mechanics/phase_motion.hpp"
#include "verify/angle_controls.hpp"
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
        if (!is_proved()) form.documentation.insert(form.documentation.end() - 1, stationary_controls);
        bind_names(form);
        add_kernels(form);
        return form;
    }

  private:
    void differentiate()
    {
        BaseSlopes slopes = base_slopes(graph_, system_, hamiltonian_);
        dH_dx_ = std::move(slopes.x);
        dH_dt_ = slopes.t;
        const std::vector<NodeId> dH_du = gradient(graph_, hamiltonian_, u_);
        const auto zeros = zeros_for(graph_, u_, verified_.maximum.angles);
        others_ = other_controls(u_.size(), verified_.maximum.angles);
        for (const std::size_t k : others_) {
            rest_.push_back(u_[k]);
            dH_drest_.push_back(dH_du[k]);
        }
        dH_drest_ = substitute(graph_, dH_drest_, zeros); // they stand apart from the angles
        std::vector<NodeId> curvature = joined_rows(jacobian(graph_, dH_drest_, rest_));
        for (NodeId& entry : curvature) entry = graph_.negate(entry); // positive where H is concave
        std::vector<NodeId> divisors;
        curvature_ = simplify(graph_, curvature, divisors);
    }

    [[nodiscard]] NodeId curvature(std::size_t k, std::size_t l) const { return curvature_[k * rest_.size() + l]; }
    [[nodiscard]] bool is_proved() const { return verified_.maximum.kind == ControlMaximum::Kind::maximal; }

    void solve_controls()
    {
        solution_ = u_;
        if (!verified_.maximum.angles.empty()) find_angles();
        if (rest_.empty()) return;
        // Where what must be positive has cancelled in dH/du, its root may lie where H is not defined.
        const bool linear = is_proved() && !depends_on_any(graph_, curvature_, u_) &&
                            (!control_.bounds.empty() || positive_operands(graph_, hamiltonian_, rest_).empty());
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
        for (std::size_t k = 0; k < rest_.size(); ++k)
            for (std::size_t l = 0; l < rest_.size(); ++l)
                if (k != l && !graph_.is_zero(curvature(k, l))) return false;
        return is_proved() && !verified_.maximum.on_part;
    }

    /// What [control] says of the k-th control, or else.
    [[nodiscard]] NodeId guess_of(std::size_t k, NodeId otherwise)
    {
        if (control_.guess.empty() || !control_.guess[k]) return otherwise;
        Binding names = {{"t", system_.time}}; // other names are those of inputs
        return Lowering(graph_, std::move(names))(control_.guess[k]);
    }

    void find_angles()
    {
        const std::vector<NodeId> slopes = gradient(graph_, hamiltonian_, u_);
        std::vector<NodeId> unknowns, residuals, guess;
        Angles angles;
        for (const std::size_t k : verified_.maximum.angles) {
            const AngleTerms terms = angle_terms(graph_, slopes[k], u_[k]);
            angles.b.push_back(terms.b);
            angles.c.push_back(terms.c);
            unknowns.push_back(u_[k]);
            residuals.push_back(graph_.subtract(graph_.multiply(terms.c, graph_.apply(Op::cos, u_[k])),
                                                graph_.multiply(terms.b, graph_.apply(Op::sin, u_[k]))));
            guess.push_back(guess_of(k, graph_.constant(0)));
        }
        implicit_.push_back(implicit_block(graph_, rest_.empty() ? "controls" : "angles",
                                           "u where H = a + b cos u + c sin u is largest, as near as can be to the "
                                           "guess.",
                                           unknowns, residuals, guess, MatrixStructure::symmetric));
        implicit_.back().angles = std::move(angles);
        implicit_.back().follows = true;
    }

    void solve_linearly()
    {
        const std::vector<NodeId> zeros(rest_.size(), graph_.constant(0));
        const std::vector<NodeId> right = substitute(graph_, dH_drest_, replacements(rest_, zeros));
        const std::vector<NodeId> solved = graph_.solve(curvature_, right, MatrixStructure::symmetric);
        for (std::size_t k = 0; k < others_.size(); ++k) solution_[others_[k]] = solved[k];
        pivots_ = single_blocks(graph_, curvature_, rest_.size());
    }

    void solve_by_newton()
    {
        implicit_.push_back(gradient_block(graph_, "controls", "u with dH/du = 0.", rest_, dH_drest_, hamiltonian_,
                                           verified_.maximum.newton_start));
        std::vector<NodeId>& guess = implicit_.back().guess;
        for (std::size_t k = 0; k < others_.size(); ++k) guess[k] = guess_of(others_[k], guess[k]);
        implicit_.back().follows = !is_proved();
    }

    /// Each control by itself: dH/du_k falls with u_k and holds no other control.
    void solve_between_bounds()
    {
        ImplicitBlock block = implicit_block(
            graph_, "controls",
            control_.bounds.empty() ? "u with dH/du = 0."
                                    : "u with dH/du = 0, each between its bounds, or the bound next to it.",
            rest_, dH_drest_, {}, MatrixStructure::symmetric);
        Bracket& bracket = block.bracket.emplace();
        bracket.lower.resize(rest_.size());
        bracket.upper.resize(rest_.size());
        Lowering lower(graph_);
        for (const ControlBound& bound : control_.bounds) {
            const auto k = static_cast<std::size_t>(std::ranges::find(others_, bound.control) - others_.begin());
            NodeId& u = solution_[bound.control];
            if (bound.upper) {
                const NodeId end = lower(bound.upper);
                bracket.upper[k] = end;
                u = graph_.select(graph_.apply(Op::greater_equal, rest_[k], end), end, u);
            }
            if (bound.lower) {
                const NodeId end = lower(bound.lower);
                bracket.lower[k] = end;
                u = graph_.select(graph_.apply(Op::less_equal, rest_[k], end), end, u);
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
        if (!is_proved()) controls.documentation = {stationary_controls};
        controls.outputs[0].entry_names = form.controls;
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
    std::vector<std::size_t> others_;     ///< the controls that are no angles
    std::vector<NodeId> rest_, dH_drest_; ///< their inputs, and the slopes of H in them
    std::vector<NodeId> dH_dx_, curvature_;
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
