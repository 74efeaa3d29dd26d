// SPDX-License-Identifier: GPL-2.0-or-later
/// H = mu_a sigma^a - cost,   xdot^i = rho^i_a sigma^a,   mudot_a = -(rho_a(H) + mu_c C^c_ab sigma^b)    [Martinez
/// 2004] The controls solve dH/du = 0: linearly where that is affine in u, else by Newton's method. Bounds clip them
/// where every control has a part of H of its own that is proved to be strictly concave: only then the clipped value
/// maximises H.
#include "graph/differentiate.hpp"
#include "graph/simplify.hpp"
#include "kernels/formulation.hpp"
#include "kernels/system.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

namespace {

class PontryaginForm {
  public:
    PontryaginForm(Graph& graph, const Model& model, const VerifiedAlgebroid& verified)
        : graph_(graph), model_(model), control_(*model.control), verified_(verified),
          system_(system_nodes(graph, model, verified.algebroid))
    {
        for (const Symbol& symbol : model.fibre.momenta) mu_.push_back(graph.input(symbol.name));
        for (const Symbol& symbol : control_.controls) u_.push_back(graph.input(symbol.name));
        Lowering lower(graph);
        sigma_.assign(system_.r, graph.constant(0));
        for (const ComponentEntry& entry : control_.sigma)
            sigma_[entry.section] = graph.add(sigma_[entry.section], lower(entry.value));
        cost_ = lower(control_.cost);
        hamiltonian_ = graph.subtract(contraction(graph, mu_, sigma_), cost_);
        differentiate();
        solve_controls();
    }

    Formulation build(const FormulationParts& parts)
    {
        Formulation form;
        form.form = "pontryagin";
        form.time = system_.time;
        form.parameters = system_.parameters;
        form.x = system_.x;
        form.lanes = mu_;
        form.lane_names = model_.fibre.momenta;
        form.lane_group = "Momenta";
        form.implicit = implicit_;
        form.pivots = pivots_;
        for (const Symbol& symbol : control_.controls) form.controls.push_back(symbol.name);
        const std::vector<NodeId> sigma = at_controls(sigma_);
        if (parts.motion) {
            form.derivative = base_velocity(graph_, system_, sigma);
            std::vector<NodeId> rate = along_anchor(graph_, system_, at_controls(dH_dx_));
            for (NodeId& entry : rate) entry = graph_.negate(entry);
            subtract_brackets(graph_, system_, mu_, sigma, rate);
            form.derivative.insert(form.derivative.end(), rate.begin(), rate.end());
        }
        form.documentation = {
            "Pontryagin's equations for H = mu_a sigma^a - cost, ds = (xdot, mudot): xdot^i = rho^i_a "
            "sigma^a and",
            "mudot_a = -(rho_a(H) + mu_c C^c_ab sigma^b), with the controls that solve dH/du = 0" +
                std::string(control_.bounds.empty() ? "." : ", clipped to their bounds."),
            "s and ds may be the same object."};
        bind_names(form);
        add_kernels(form);
        return form;
    }

  private:
    void differentiate()
    {
        Slopes slopes = slopes_of(graph_, hamiltonian_, u_, system_);
        dH_du_ = std::move(slopes.lanes);
        dH_dx_ = std::move(slopes.x);
        dH_dt_ = slopes.t;
        std::vector<NodeId> curvature = joined_rows(jacobian(graph_, dH_du_, u_));
        for (NodeId& entry : curvature) entry = graph_.negate(entry); // positive where H is concave
        std::vector<NodeId> divisors;
        curvature_ = simplify(graph_, curvature, divisors);
    }

    [[nodiscard]] NodeId curvature(std::size_t k, std::size_t l) const { return curvature_[k * u_.size() + l]; }

    void solve_controls()
    {
        const std::size_t m = u_.size();
        for (std::size_t k = 0; k < m; ++k) {
            bool singular = true;
            for (std::size_t l = 0; l < m; ++l) singular = singular && graph_.is_zero(curvature(k, l));
            if (singular)
                throw MathematicsError(fmt::format(
                    "error: the Hamiltonian of model '{}' is affine in the control {}: dH/d{} = 0 does not determine "
                    "it "
                    "(a singular or bang-bang control)\nhint: give the cost a term in which {} is strictly convex",
                    model_.name, name_of(k), name_of(k), name_of(k)));
        }
        if (!control_.bounds.empty()) require_concave();
        depends_on_any(graph_, curvature_, u_) ? solve_by_newton() : solve_linearly();
        clip();
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
        std::vector<NodeId> guess(u_.size(), graph_.constant(0));
        Lowering lower(graph_);
        for (const ControlBound& bound : control_.bounds)
            if (bound.lower && bound.upper) {
                const NodeId low = lower(bound.lower); // nodes are numbered in the order of these lines
                const NodeId high = lower(bound.upper);
                guess[bound.control] = graph_.divide(graph_.add(low, high), graph_.constant(2));
            }
        implicit_.push_back(implicit_block(graph_, "controls", "u with dH/du = 0.", u_, dH_du_, std::move(guess),
                                           MatrixStructure::symmetric));
        solution_ = u_;
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

    /// Separable: no mixed second derivatives; strictly concave: -d2H/du2 > 0 on the domain.
    void require_concave()
    {
        const auto refuse = [&](const std::string& why) {
            throw MathematicsError(fmt::format(
                "error: the controls of model '{}' have bounds, which clip the solution of dH/du = 0 only where H is "
                "separable and strictly concave in them: {}\nhint: without bounds dH/du = 0 is solved as it is",
                model_.name, why));
        };
        for (std::size_t k = 0; k < u_.size(); ++k)
            for (std::size_t l = 0; l < u_.size(); ++l)
                if (k != l && !graph_.is_zero(curvature(k, l)))
                    refuse(fmt::format("d2H/d{}d{} is not zero", name_of(k), name_of(l)));
        ProofSetting setting;
        setting.variables = system_.x;
        setting.variables.insert(setting.variables.end(), u_.begin(), u_.end());
        setting.variables.insert(setting.variables.end(), mu_.begin(), mu_.end());
        setting.variables.push_back(system_.time);
        setting.parameters = system_.parameters;
        Lowering lower(graph_);
        for (const Tree& tree : verified_.algebroid.constraints) setting.constraints.push_back(lower(tree));
        for (const Tree& tree : verified_.algebroid.domain) setting.domain.push_back(lower(tree));
        const ZeroDecider decider(graph_, setting);
        for (std::size_t k = 0; k < u_.size(); ++k)
            if (!decider.proves_positive(curvature(k, k)))
                refuse(fmt::format("d2H/d{}2 < 0 was not proved", name_of(k)));
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
        for (const auto& [name, node] : system_names(model_, system_)) form.binding[name] = node;
    }

    void add_kernels(Formulation& form)
    {
        const std::vector<NodeId> values = at_controls({hamiltonian_, cost_, dH_dt_});
        form.kernels.push_back({"controls",
                                KernelShape::vector,
                                column("u", solution_),
                                {"The controls that maximise H."},
                                form.controls,
                                {}});
        form.kernels.push_back(scalar_kernel("hamiltonian", values[0], "H = mu_a sigma^a - cost at these controls."));
        if (!graph_.is_zero(values[2]))
            form.kernels.push_back(scalar_kernel("power", values[2], "dH/dt along the motion."));
        form.kernels.push_back(scalar_kernel("cost", values[1], "The running cost."));
    }

    Graph& graph_;
    const Model& model_;
    const Control& control_;
    const VerifiedAlgebroid& verified_;
    SystemNodes system_;
    std::vector<NodeId> mu_, u_, sigma_;
    NodeId cost_ = 0, hamiltonian_ = 0, dH_dt_ = 0;
    std::vector<NodeId> dH_du_, dH_dx_, curvature_;
    std::vector<NodeId> solution_; ///< u over the state, or the unknowns
    std::vector<NodeId> pivots_;
    std::vector<ImplicitBlock> implicit_;
};

} // namespace

Formulation pontryagin_form(Graph& graph, const Model& model, const VerifiedAlgebroid& verified,
                            const FormulationParts& parts)
{
    if (!model.control)
        throw MathematicsError(fmt::format("error: model '{}' is no control problem; the Pontryagin form needs "
                                           "[control] with controls, sigma and cost",
                                           model.name));
    return PontryaginForm(graph, model, verified).build(parts);
}

} // namespace lagen
