// SPDX-License-Identifier: GPL-2.0-or-later
/// Pontryagin's equations (mechanics/pontryagin.hpp) as kernels. Angles have a closed form (verify/angle_controls.hpp).
/// The other controls solve dH/du = 0: linearly where that is affine in u, else by Newton's method. Between bounds each
/// control has a part of H of its own that is strictly concave (verify/control_maximum.hpp): the maximum is the root of
/// dH/du, or the bound next to it. Controls that are merely stationary are searched for where they were in the last
/// step, and watched.
#include "kernels/formulation.hpp"
#include "mechanics/pontryagin.hpp"
#include "verify/control_maximum.hpp"

#include <fmt/format.h>

namespace lagen {

namespace {

/// Gives each control a value over the state, or makes it an unknown of an implicit block.
class SolvedControls {
  public:
    SolvedControls(Graph& graph, const System& system, const Control& written, const ControlMaximum& maximum)
        : graph_(graph), system_(system), written_(written), maximum_(maximum),
          hamiltonian_(control_hamiltonian(graph, *system.control, system.mu)),
          others_(other_controls(system.control->u.size(), maximum.angles)),
          rest_(without_angles(graph, *system.control, maximum.angles)),
          of_rest_(control_hamiltonian(graph, rest_, system.mu)), equations_(control_equations(graph, of_rest_)),
          solution_(system.control->u)
    {
    }

    void solve(Formulation& form)
    {
        if (!maximum_.angles.empty()) form.implicit.push_back(angles());
        if (rest_.u.empty()) return;
        // Where what must be positive has cancelled in dH/du, its root may lie where H is not defined.
        if (is_proved() && equations_.right &&
            (rest_.bounded() || positive_operands(graph_, of_rest_.value, rest_.u).empty())) {
            solve_linearly();
            form.pivots = single_blocks(graph_, equations_.negative.hessian, rest_.u.size());
        } else if (rest_.bounded() || stand_apart()) {
            form.implicit.push_back(between_bounds());
        } else {
            form.implicit.push_back(by_newton());
        }
    }

    [[nodiscard]] NodeId hamiltonian() const { return hamiltonian_.value; }
    [[nodiscard]] Replacements values() const { return replacements(system_.control->u, solution_); }

  private:
    [[nodiscard]] bool is_proved() const { return maximum_.kind == ControlMaximum::Kind::maximal; }

    /// True where each dH/du_k holds no other control and falls with its own: then no step can miss the root.
    [[nodiscard]] bool stand_apart() const
    {
        return is_proved() && !maximum_.on_part && equations_.negative.blocks.size() == rest_.u.size();
    }

    /// What [control] says of the k-th control, or else.
    [[nodiscard]] NodeId guess_of(std::size_t k, NodeId otherwise)
    {
        if (written_.guess.empty() || !written_.guess[k]) return otherwise;
        Binding names = {{"t", system_.time}}; // other names are those of inputs
        return Lowering(graph_, std::move(names))(written_.guess[k]);
    }

    [[nodiscard]] ImplicitBlock angles()
    {
        std::vector<NodeId> unknowns, residuals, guess;
        Angles angles;
        for (const std::size_t k : maximum_.angles) {
            const NodeId u = system_.control->u[k];
            const AngleTerms terms = angle_terms(graph_, hamiltonian_.dH_du[k], u);
            angles.b.push_back(terms.b);
            angles.c.push_back(terms.c);
            unknowns.push_back(u);
            residuals.push_back(graph_.subtract(graph_.multiply(terms.c, graph_.apply(Op::cos, u)),
                                                graph_.multiply(terms.b, graph_.apply(Op::sin, u))));
            guess.push_back(guess_of(k, graph_.constant(0)));
        }
        ImplicitBlock block = implicit_block(graph_, rest_.u.empty() ? "controls" : "angles",
                                             "u where H = a + b cos u + c sin u is largest, as near as can be to the "
                                             "guess.",
                                             unknowns, residuals, guess, MatrixStructure::symmetric);
        block.angles = std::move(angles);
        block.follows = true;
        return block;
    }

    /// Cut to the bounds, if there are any.
    void solve_linearly()
    {
        const std::vector<NodeId> solved =
            graph_.solve(equations_.negative.hessian, *equations_.right, MatrixStructure::symmetric);
        for (std::size_t k = 0; k < solved.size(); ++k) {
            NodeId& u = solution_[others_[k]] = solved[k];
            if (rest_.lower[k]) u = graph_.apply(Op::maximum, u, *rest_.lower[k]);
            if (rest_.upper[k]) u = graph_.apply(Op::minimum, u, *rest_.upper[k]);
        }
    }

    [[nodiscard]] ImplicitBlock by_newton()
    {
        ImplicitBlock block = gradient_block(graph_, "controls", "u with dH/du = 0.", rest_.u, of_rest_.dH_du,
                                             of_rest_.value, maximum_.newton_start);
        for (std::size_t k = 0; k < others_.size(); ++k) block.guess[k] = guess_of(others_[k], block.guess[k]);
        block.follows = !is_proved();
        return block;
    }

    /// Each control by itself: dH/du_k falls with u_k and holds no other control.
    [[nodiscard]] ImplicitBlock between_bounds()
    {
        ImplicitBlock block =
            implicit_block(graph_, "controls",
                           rest_.bounded() ? "u with dH/du = 0, each between its bounds, or the bound next to it."
                                           : "u with dH/du = 0.",
                           rest_.u, of_rest_.dH_du, {}, MatrixStructure::symmetric);
        block.bracket = {rest_.lower, rest_.upper};
        for (std::size_t k = 0; k < others_.size(); ++k) {
            const auto stop = [&](const std::optional<NodeId>& end, Op beyond) {
                NodeId& u = solution_[others_[k]];
                if (end) u = graph_.select(graph_.apply(beyond, rest_.u[k], *end), *end, u);
            };
            stop(rest_.upper[k], Op::greater_equal);
            stop(rest_.lower[k], Op::less_equal);
        }
        return block;
    }

    Graph& graph_;
    const System& system_;
    const Control& written_;
    const ControlMaximum& maximum_;
    ControlHamiltonian hamiltonian_;
    std::vector<std::size_t> others_; ///< the controls that are no angles
    ControlProblem rest_;             ///< theirs
    ControlHamiltonian of_rest_;
    ControlEquations equations_;
    std::vector<NodeId> solution_; ///< u over the state, or the unknowns
};

/// Bounds over parameters: the lower below the upper, a single one finite. Those of numbers alone are checked where
/// they are read.
void require_intervals(Graph& graph, const ControlProblem& control, const Control& written, Formulation& form)
{
    const auto is_number = [](const Tree& end) { return names_in(end).empty(); };
    for (const ControlBound& bound : written.bounds) {
        const std::optional<NodeId> lower = control.lower[bound.control], upper = control.upper[bound.control];
        if (lower && upper) {
            if (is_number(bound.lower) && is_number(bound.upper)) continue;
            form.parameter_conditions.emplace_back(fmt::format("{} < {}", to_text(bound.lower), to_text(bound.upper)),
                                                   graph.subtract(*upper, *lower));
        } else if (const Tree& end = lower ? bound.lower : bound.upper; !is_number(end)) {
            const NodeId size = graph.apply(Op::abs, lower ? *lower : *upper);
            form.parameter_conditions.emplace_back(to_text(end) + " is finite",
                                                   graph.divide(graph.constant(1), graph.add(graph.constant(1), size)));
        }
    }
}

void add_kernels(Graph& graph, const PhaseSystem& phase, bool proved, Formulation& form)
{
    std::vector<NodeId> values;
    std::vector<std::string> names;
    for (const auto& [control, value] : phase.found) {
        names.push_back(graph.input_name(control));
        values.push_back(value);
    }
    Kernel controls = table_kernel(form, "controls", column("u", values));
    if (!proved) controls.documentation = {stationary_controls};
    controls.outputs[0].entry_names = std::move(names);
    form.kernels.push_back(std::move(controls));
    form.kernels.push_back(scalar_kernel(form, "hamiltonian", phase.hamiltonian));
    if (!graph.is_zero(phase.energy_rate)) form.kernels.push_back(scalar_kernel(form, "power", phase.energy_rate));
    form.kernels.push_back(scalar_kernel(form, "cost", phase.lagrangian));
}

} // namespace

Formulation pontryagin_form(Graph& graph, const Model& model, const System& system, const Report& report,
                            const FormulationRequest& request)
{
    if (!model.control)
        throw MathematicsError(fmt::format("model '{}' is no control problem; the Pontryagin form needs "
                                           "[control] with controls, sigma and cost",
                                           model.name));
    require_maximum(system.name, report.control.maximum);
    const bool proved = report.control.maximum.kind == ControlMaximum::Kind::maximal;
    Formulation form = empty_form(system, FormKind::pontryagin, system.mu, request);
    SolvedControls controls(graph, system, *model.control, report.control.maximum);
    controls.solve(form);
    require_intervals(graph, *system.control, *model.control, form);
    const PhaseSystem phase = pontryagin_system(graph, system, controls.hamiltonian(), controls.values());
    form.documentation = {"Pontryagin's equations for H = mu_a sigma^a - cost, ds = (xdot, mudot): xdot^i = rho^i_a "
                          "sigma^a and",
                          "mudot_a = -(rho_a(H) + mu_c C^c_ab sigma^b), with the controls that solve dH/du = 0" +
                              std::string(system.control->bounded() ? ", or are at the bound next to that." : ".")};
    if (!proved) form.documentation.push_back(stationary_controls);
    form.documentation.push_back("s and ds may be the same object.");
    set_motion(graph, system, phase, form);
    add_kernels(graph, phase, proved, form);
    return form;
}

} // namespace lagen
