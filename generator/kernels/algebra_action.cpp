// SPDX-License-Identifier: GPL-2.0-or-later
#include "kernels/algebra_action.hpp"

#include "graph/calculus/differentiate.hpp"
#include "mechanics/momentum_balance.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

namespace {

class ActionBuilder {
  public:
    ActionBuilder(Graph& graph, const Model& model, const System& system, const Formulation& form)
        : graph_(graph), model_(model), system_(system), form_(form), lanes_(state_of(form)),
          has_momenta_(form.hamiltonian && system.forces.empty())
    {
    }

    AlgebraAction build()
    {
        if (form_.form->kind != FormKind::lagrange && form_.form->kind != FormKind::hamilton)
            return refused(fmt::format("the form is '{}'", form_.form->name));
        if (system_.distribution) return refused("the motions are constrained, and no group moves a distribution");
        for (const Column& column : system_.algebroid.bracket)
            for (const ColumnEntry& C : column)
                if (const std::optional<NodeId> other = variable_of(C.value))
                    return refused(fmt::format("brackets of sections depend on {}", graph_.input_name(*other)));
        declare_elements();
        set_rates();
        find_moved();
        if (std::ranges::none_of(rates_, [this](NodeId rate) { return !graph_.is_zero(rate); }))
            return refused(obstacle_.empty() ? "the group moves no lane" : obstacle_);
        add_element();
        add_action();
        add_bracket();
        result_.motion.dimension = xi_.size();
        return std::move(result_);
    }

  private:
    [[nodiscard]] static AlgebraAction refused(std::string obstacle)
    {
        AlgebraAction result;
        result.motion.obstacle = std::move(obstacle);
        return result;
    }

    /// A lane, or time, that the node depends on.
    [[nodiscard]] std::optional<NodeId> variable_of(NodeId node) const
    {
        std::vector<NodeId> variables = lanes_;
        variables.push_back(system_.time);
        if (!depends_on_any(graph_, std::array{node}, variables)) return std::nullopt;
        for (const NodeId variable : variables)
            if (depends_on_any(graph_, std::array{node}, std::array{variable})) return variable;
        return std::nullopt;
    }

    void declare_elements()
    {
        std::vector<NodeId> parts = system_.algebroid.y;
        if (has_momenta_) parts.insert(parts.end(), form_.x.begin(), form_.x.end());
        for (const NodeId part : parts) {
            const std::string& name = graph_.input_name(part);
            xi_.push_back({"xi_" + name, {}, {}, graph_.input("element along " + name)});
            eta_.push_back({"eta_" + name, {}, {}, graph_.input("other element along " + name)});
        }
    }

    /// Components of an element on the sections, or, behind these, on dx^i.
    [[nodiscard]] std::vector<NodeId> on_sections(const std::vector<Quantity>& element) const
    {
        std::vector<NodeId> u;
        for (std::size_t a = 0; a < system_.r(); ++a) u.push_back(element[a].input);
        return u;
    }
    [[nodiscard]] NodeId on_base(const std::vector<Quantity>& element, std::size_t i) const
    {
        return element[system_.r() + i].input;
    }

    /// What xi does to every lane that it may move, linear or not; 0 in the others.
    void set_rates()
    {
        const std::vector<NodeId> u = on_sections(xi_);
        rates_ = base_velocity(graph_, system_.algebroid, u);
        if (has_momenta_) {
            MomentumBalance balance;
            for (std::size_t i = 0; i < form_.x.size(); ++i) balance.df_dx.push_back(graph_.negate(on_base(xi_, i)));
            balance.p = system_.mu;
            balance.y = u;
            balance.forces.assign(system_.r(), graph_.constant(0));
            const std::vector<NodeId> momenta = momentum_rates(graph_, system_.algebroid, balance);
            rates_.insert(rates_.end(), momenta.begin(), momenta.end());
        }
        rates_.resize(lanes_.size(), graph_.constant(0));
        Binding binding = form_.binding;
        for (std::size_t a = 0; a < system_.r(); ++a) binding[graph_.input_name(system_.algebroid.y[a])] = u[a];
        Lowering lower(graph_, std::move(binding));
        for (std::size_t k = 0; k < form_.states.size(); ++k) {
            const auto place = std::ranges::find(system_.states, form_.states[k]) - system_.states.begin();
            const auto state = static_cast<std::size_t>(place);
            const auto holds = [state](const Reconstruction& g) { return g.holds(state); };
            if (std::ranges::any_of(model_.reconstructions, holds))
                rates_[form_.x.size() + form_.lanes.size() + k] = lower(system_.written.states[state].value);
        }
    }

    [[nodiscard]] bool is_candidate(std::size_t lane) const
    {
        const std::size_t n = form_.x.size(), r = form_.lanes.size();
        if (lane < n) return true;
        if (lane < n + r) return has_momenta_;
        const auto place = std::ranges::find(system_.states, lanes_[lane]) - system_.states.begin();
        return std::ranges::any_of(model_.reconstructions, [place](const Reconstruction& g) {
            return g.holds(static_cast<std::size_t>(place));
        });
    }

    /// The largest set of lanes whose rates are linear in lanes of the set; momenta take part all together.
    void find_moved()
    {
        std::vector<bool>& moved = result_.motion.moved;
        for (std::size_t k = 0; k < lanes_.size(); ++k) moved.push_back(is_candidate(k));
        for (bool changed = true; changed;) {
            changed = false;
            for (std::size_t k = 0; k < lanes_.size(); ++k) {
                if (!moved[k] || is_linear(rates_[k])) continue;
                if (obstacle_.empty())
                    obstacle_ = fmt::format("{}' is not linear in the lanes that the group moves",
                                            graph_.input_name(lanes_[k]));
                changed = true;
                moved[k] = false;
                if (k < form_.x.size() + form_.lanes.size()) drop_momenta();
            }
        }
        for (std::size_t k = 0; k < lanes_.size(); ++k)
            if (!moved[k]) rates_[k] = graph_.constant(0);
    }

    void drop_momenta()
    {
        for (std::size_t a = 0; a < form_.lanes.size(); ++a) result_.motion.moved[form_.x.size() + a] = false;
        has_momenta_ = false;
        xi_.resize(system_.r());
        eta_.resize(system_.r());
    }

    /// Free of other lanes and of time, slopes free of all lanes, zero at zero.
    [[nodiscard]] bool is_linear(NodeId rate)
    {
        std::vector<NodeId> inside, outside{system_.time};
        for (std::size_t k = 0; k < lanes_.size(); ++k)
            (result_.motion.moved[k] ? inside : outside).push_back(lanes_[k]);
        if (depends_on_any(graph_, std::array{rate}, outside)) return false;
        if (depends_on_any(graph_, gradient(graph_, rate, inside), inside)) return false;
        const std::vector<NodeId> zeros(inside.size(), graph_.constant(0));
        const auto at_zero = substitute_where_defined(graph_, std::array{rate}, replacements(inside, zeros));
        return at_zero && graph_.is_zero((*at_zero)[0]);
    }

    [[nodiscard]] static KernelInput argument(const char* name, const std::vector<Quantity>& entries)
    {
        return {name, ArrayRole::value, {1, entries.size(), 1}, entries};
    }

    void add_element()
    {
        std::vector<NodeId> element = form_.hamiltonian ? form_.hamiltonian->y : system_.algebroid.y;
        if (has_momenta_) {
            const std::vector<NodeId>& slopes = form_.hamiltonian->dH_dx;
            element.insert(element.end(), slopes.begin(), slopes.end());
        }
        Kernel kernel = table_kernel(form_, "algebra_element", column("xi", element));
        if (form_.hamiltonian) kernel.checks->pivots = form_.pivots;
        result_.at_states.push_back(std::move(kernel));
    }

    void add_action()
    {
        Kernel kernel = table_kernel(form_, "algebra_action", column("ds", rates_));
        kernel.inputs = {argument("xi", xi_)};
        result_.at_states.push_back(std::move(kernel));
    }

    void add_bracket()
    {
        const std::vector<NodeId> u = on_sections(xi_), w = on_sections(eta_);
        std::vector<NodeId> sums(xi_.size(), graph_.constant(0));
        const auto add = [&](std::size_t component, NodeId factor, NodeId a, NodeId b) {
            sums[component] = graph_.add(sums[component], graph_.product(std::array{factor, a, b}));
        };
        for (std::size_t a = 0; a < system_.r(); ++a)
            for (std::size_t b = 0; b < system_.r(); ++b)
                for (const ColumnEntry& C : system_.algebroid.C(a, b)) add(C.index, C.value, u[a], w[b]);
        if (has_momenta_) {
            for (std::size_t a = 0; a < system_.r(); ++a)
                for (const ColumnEntry& rho : system_.algebroid.anchor[a]) {
                    const std::vector<NodeId> slopes = gradient(graph_, rho.value, form_.x);
                    for (std::size_t k = 0; k < slopes.size(); ++k) {
                        if (graph_.is_zero(slopes[k])) continue;
                        add(system_.r() + k, slopes[k], u[a], on_base(eta_, rho.index));
                        add(system_.r() + k, graph_.negate(slopes[k]), w[a], on_base(xi_, rho.index));
                    }
                }
        }
        Kernel kernel = table_kernel(form_, "algebra_bracket", column("bracket", sums));
        kernel.inputs = {argument("xi", xi_), argument("eta", eta_)};
        result_.constants.push_back(std::move(kernel));
    }

    Graph& graph_;
    const Model& model_;
    const System& system_;
    const Formulation& form_;
    std::vector<NodeId> lanes_;
    bool has_momenta_;               ///< these may be moved
    std::vector<Quantity> xi_, eta_; ///< inputs: two elements of the algebra
    std::vector<NodeId> rates_;
    std::string obstacle_;
    AlgebraAction result_;
};

} // namespace

AlgebraAction algebra_action(Graph& graph, const Model& model, const System& system, const Formulation& form)
{
    return ActionBuilder(graph, model, system, form).build();
}

} // namespace lagen
