// SPDX-License-Identifier: GPL-2.0-or-later
#include "kernels/form_kernels.hpp"

#include "graph/calculus/differentiate.hpp"
#include "graph/calculus/limits.hpp"
#include "graph/kernel.hpp"
#include "graph/simplify/simplify.hpp"
#include "graph/unknowns/implicit.hpp"
#include "graph/unknowns/tangent_size.hpp"
#include "kernels/algebra_action.hpp"
#include "kernels/exact_flows.hpp"
#include "kernels/formulation.hpp"
#include "kernels/jumps.hpp"
#include "kernels/kernel_table.hpp"
#include "kernels/named_trees.hpp"
#include "kernels/requested_kernels.hpp"
#include "model/families.hpp"
#include "model/model.hpp"
#include "model/scene_form.hpp"
#include "text/activity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <memory>
#include <vector>

namespace lagen {

namespace {

/// Simplifies the nodes at these places together, and answers their divisors.
std::vector<NodeId> simplify_at(Graph& graph, const std::vector<NodeId*>& places, SimplifyReport* report = nullptr)
{
    std::vector<NodeId> nodes, divisors;
    for (const NodeId* place : places) nodes.push_back(*place);
    nodes = simplify(graph, nodes, divisors, report);
    for (std::size_t k = 0; k < places.size(); ++k) *places[k] = nodes[k];
    return divisors;
}

/// The same for all nodes of these lists.
void simplify_at(Graph& graph, std::initializer_list<std::vector<NodeId>*> lists)
{
    std::vector<NodeId*> places;
    for (std::vector<NodeId>* list : lists)
        for (NodeId& node : *list) places.push_back(&node);
    simplify_at(graph, places);
}

/// Residuals, Jacobian and guess of each block, simplified together.
void simplify_blocks(Graph& graph, std::vector<ImplicitBlock>& blocks)
{
    for (ImplicitBlock& block : blocks) {
        simplify_at(graph, {&block.guess});
        if (block.bracket)
            for (auto* ends : {&block.bracket->lower, &block.bracket->upper})
                for (std::optional<NodeId>& end : *ends)
                    if (end) simplify_at(graph, std::vector<NodeId*>{&*end});
        if (block.angles)
            for (auto* parts : {&block.angles->b, &block.angles->c}) simplify_at(graph, {parts});
        simplify_at(graph, {&block.residuals, &block.jacobian, &block.inside});
        block.sizes = rounding_sizes(graph, block.residuals);
    }
}

// The matrices of [reconstruct] among the lanes of a form.

/// The matrices whose entries are among `states`, numbers of first-order states that stand behind `before` other lanes.
std::vector<GroupLanes> group_lanes(const Model& model, const std::vector<std::size_t>& states, std::size_t before)
{
    std::vector<GroupLanes> matrices;
    for (const Reconstruction& g : model.reconstructions) {
        const auto place = std::ranges::find(states, g.first);
        if (place == states.end()) continue;
        GroupLanes& lanes = matrices.emplace_back();
        lanes.name = g.name;
        lanes.group = g.group;
        lanes.first = before + static_cast<std::size_t>(place - states.begin());
        lanes.size = g.size;
        for (std::size_t c = 0; c < g.generators.size(); ++c)
            for (std::size_t k = 0; k < g.size * g.size; ++k)
                if (const Rational& value = g.generators[c].entries[k]->number; value != 0)
                    lanes.generators.push_back({c, k / g.size, k % g.size, value});
    }
    return matrices;
}

Quantity quantity(const Symbol& symbol, NodeId input)
{
    return {symbol.name, symbol.text, symbol.unit, input};
}

/// Parameters of the model, and its inputs; the step of a discrete motion is a parameter too where it is a symbol of
/// its own.
void describe_parameters(KernelModule& module, const Model& model, const System& system, const Formulation& form)
{
    Graph& graph = *module.graph;
    for (const Parameter& parameter : model.parameters) {
        const std::string& name = parameter.symbol.name;
        const NodeId node = graph.input(name);
        if (parameter.bound)
            module.constants.push_back(fmt::format("{} = {}", name, to_text(graph, node)));
        else
            module.parameters.push_back(quantity(parameter.symbol, node));
    }
    for (const auto& [parameter, value] : system.parameter_values) module.parameter_defaults.push_back(value);
    if (!form.step) {
        for (std::size_t k = 0; k < form.inputs.size(); ++k)
            module.inputs.push_back(quantity(model.inputs[k].symbol, form.inputs[k]));
        for (const auto& [input, value] : system.input_values) module.input_defaults.push_back(value);
        return;
    }
    if (!has_own_step(model)) return;
    module.parameters.push_back(quantity(model.discrete->step, system.discrete->step));
    module.parameter_defaults.push_back(graph.constant(0));
}

/// The numbers of the first-order states that the form carries.
std::vector<std::size_t> numbers_of(const System& system, const Formulation& form)
{
    std::vector<std::size_t> numbers;
    for (const NodeId state : form.states)
        numbers.push_back(static_cast<std::size_t>(std::ranges::find(system.states, state) - system.states.begin()));
    return numbers;
}

std::vector<LaneGroup> lane_groups(const Model& model, const System& system, const Formulation& form)
{
    if (!form.groups.empty()) return form.groups;
    LaneGroup base{"Base", "base", "Base coordinates, the first lanes of State.", {}};
    for (std::size_t i = 0; i < form.x.size(); ++i)
        base.lanes.push_back(quantity(model.base.coordinates[i], form.x[i]));
    LaneGroup fibre{form.form->lane_group, "fibre", "The other lanes of State.", {}};
    const std::vector<Symbol>& symbols = form.form->momenta ? model.fibre.momenta : model.fibre.coordinates;
    for (std::size_t a = 0; a < form.lanes.size(); ++a) fibre.lanes.push_back(quantity(symbols[a], form.lanes[a]));
    std::vector<LaneGroup> groups{std::move(base)};
    if (form.form->kind != FormKind::first_order || !form.states.empty()) groups.push_back(std::move(fibre));
    if (!form.states.empty())
        groups.push_back({"States", "states", "First-order states, the last lanes of State.", {}});
    for (const std::size_t k : numbers_of(system, form))
        groups.back().lanes.push_back(quantity(model.states[k].symbol, system.states[k]));
    return groups;
}

KernelModule describe_module(std::shared_ptr<Graph> graph, const Model& model, const System& system,
                             const Formulation& form)
{
    KernelModule module;
    module.model = model.name;
    module.form = form.form->name;
    module.name = model.name + form.form->suffix;
    module.title = model.title;
    module.regenerate = fmt::format("lagen generate {}.toml", model.name);
    module.graph = std::move(graph);
    module.time = form.time;
    module.kind = form.step ? ModuleKind::step : ModuleKind::vector_field;
    module.groups = lane_groups(model, system, form);
    module.matrices = group_lanes(model, numbers_of(system, form), form.x.size() + form.lanes.size());
    module.step = form.step;
    module.implicit = form.implicit;
    module.parameter_conditions = form.parameter_conditions;
    describe_parameters(module, model, system, form);
    return module;
}

FormulationRequest formulation_request(const Model& model, const KernelRequest& request, FormKind form,
                                       std::vector<std::size_t> states)
{
    return {is_requested(request, form, "lagrangian_hessian") || is_requested(request, form, "hamiltonian_hessian"),
            request.scene == nullptr && is_requested(request, form, "inverse_dynamics"),
            is_requested(request, form, "hamiltonian"), std::move(states), given_inputs(model, request.scene)};
}

/// Kernels of one module, each simplified on its own and left out where nobody asked for it or it would be empty.
class ModuleBuilder {
  public:
    ModuleBuilder(const Model& model, const System& system, const Report& report, const KernelRequest& request)
        : ModuleBuilder(model, system, report, request, request.form.empty() ? default_form(model) : request.form)
    {
    }

    ModuleBuilder(const Model& model, const System& system, const Report& report, const KernelRequest& request,
                  const std::string& form)
        : model_(model), system_(system), report_(report), request_(request),
          states_(carried_states(model, form, request.scene)), graph_(std::make_shared<Graph>(system.graph)),
          form_(formulation(*graph_, model, system, report, form_named(form).kind,
                            formulation_request(model, request, form_named(form).kind, states_))),
          lower_(*graph_, form_.binding)
    {
    }

    KernelModule build()
    {
        module_ = describe_module(graph_, model_, system_, form_);
        if (has_rates() && wants("rhs")) add_right_hand_side();
        if (has_rates() && wants("taylor")) add_taylor();
        for (Kernel& kernel : form_.constants)
            if (wants(kernel.name)) module_.kernels.push_back(simplified(std::move(kernel), {}));
        for (Kernel& kernel : form_.kernels)
            if (wants(kernel.name)) add(std::move(kernel));
        add_trees("constraints", constraint_trees(model_));
        add_trees("casimirs", model_.base.casimirs);
        add_domain();
        if (has_rates() && has_kernel(module_, "domain") && (wants("taylor") || wants("domain_series")))
            add_domain_series();
        add_trees("observables",
                  observable_trees(model_, request_.scene, state_names(model_, module_.form), lanes_of(module_)));
        add_trees("invariants", conserved_quantities());
        if (has_rates()) add_motion();
        simplify_blocks(*graph_, module_.implicit);
        return std::move(module_);
    }

  private:
    /// Else it goes from step to step.
    [[nodiscard]] bool has_rates() const { return !form_.step; }

    /// Those of the model, and a moving energy where its rate is proved to be zero.
    [[nodiscard]] std::vector<NamedTree> conserved_quantities() const
    {
        std::vector<NamedTree> trees = conserved_trees(model_);
        const auto& energy = report_.mechanics.conserved;
        if (energy && energy->name == "moving_energy" && energy->status == ProofStatus::proved)
            trees.push_back({energy->name, name(energy->name), {}});
        return trees;
    }

    /// What is made of the rates beside them, and what happens between the steps.
    void add_motion()
    {
        if (wants("events")) add_trees("events", event_trees(model_, request_.scene));
        if (wants("event_series") && has_kernel(module_, "events")) add_series("event_series", "events");
        if (wants("jumps") && has_jumps(model_, request_.scene, *form_.form))
            add(jumps_kernel(*graph_, model_, system_, form_, request_.scene));
        if (wants("jacobian")) add_jacobian();
        if (!form_.inputs.empty() && wants("input_jacobian")) add_derivative("input_jacobian", form_.inputs);
        if (wants("variational")) add_variational();
        if (request_.time_scale != nullptr) add_time_scale();
        add_group_motion();
        if (form_.hamiltonian && wants_flows()) add_flows(flows_of(*form_.hamiltonian));
    }

    [[nodiscard]] bool wants(const std::string& name) const { return is_requested(request_, form_.form->kind, name); }

    void add(Kernel kernel) { module_.kernels.push_back(simplified(std::move(kernel))); }

    /// A kernel at (t, s) with its entries and pivots simplified together.
    [[nodiscard]] Kernel simplified(Kernel kernel) { return simplified(std::move(kernel), point_inputs(module_)); }
    [[nodiscard]] Kernel simplified(Kernel kernel, const std::vector<KernelInput>& inputs)
    {
        const Activity activity("simplifying the kernel " + kernel.name);
        kernel.inputs.insert(kernel.inputs.begin(), inputs.begin(), inputs.end());
        std::vector<NodeId> none;
        std::vector<NodeId>& pivots = kernel.checks ? kernel.checks->pivots : none;
        std::vector<NodeId*> places;
        for (KernelOutput& output : kernel.outputs)
            for (KernelEntry& entry : output.entries) places.push_back(&entry.node);
        for (NodeId& pivot : pivots) places.push_back(&pivot);
        SimplifyReport report;
        const auto divisors = simplify_at(*graph_, places, request_.reports != nullptr ? &report : nullptr);
        if (request_.reports != nullptr) request_.reports->push_back({kernel.name, std::move(report)});
        for (const NodeId divisor : divisors)
            if (std::ranges::find(pivots, divisor) == pivots.end()) pivots.push_back(divisor);
        return kernel;
    }

    /// The right-hand side, made once.
    [[nodiscard]] const Kernel& right_hand_side()
    {
        if (rhs_) return *rhs_;
        Kernel kernel = table_kernel(form_, "rhs", column("ds", form_.derivative));
        kernel.checks->pivots = form_.pivots;
        kernel.checks->failures = form_.failures;
        kernel.documentation = form_.documentation;
        return rhs_.emplace(simplified(std::move(kernel)));
    }

    void add_right_hand_side()
    {
        module_.kernels.push_back(right_hand_side());
        module_.second_order = second_order_of(module_, nodes_of(right_hand_side()));
    }

    [[nodiscard]] std::vector<NodeId> curve() const
    {
        std::vector<NodeId> coordinates = state_of(form_);
        coordinates.push_back(form_.time);
        return coordinates;
    }

    [[nodiscard]] TaylorRecurrence recurrence_of(const std::vector<NodeId>& functions)
    {
        require_analytic(*graph_, functions, curve(), form_.implicit);
        return taylor_recurrence(*graph_, functions, curve(), form_.implicit);
    }

    /// The rates as they were written or as they were simplified, whichever takes fewer sums over lower orders.
    void add_taylor()
    {
        Kernel kernel = table_kernel(form_, "taylor", column("ds", form_.derivative));
        kernel.checks->pivots = form_.pivots;
        if (has_kernel(module_, "rhs")) { // the same rates, which are simplified already
            const Kernel& rhs = kernel_named(module_, "rhs");
            kernel.inputs = rhs.inputs;
            kernel.outputs = rhs.outputs;
            kernel.checks->pivots = rhs.checks->pivots;
            module_.kernels.push_back(std::move(kernel));
        } else {
            add(std::move(kernel));
        }
        Kernel& added = module_.kernels.back();
        std::vector<NodeId> moving = curve();
        for (const ImplicitBlock& block : form_.implicit)
            moving.insert(moving.end(), block.unknowns.begin(), block.unknowns.end());
        const std::vector<NodeId> written = with_joined_factors(*graph_, form_.derivative, moving);
        std::vector<NodeId> rates = with_joined_factors(*graph_, nodes_of(added), moving);
        TaylorRecurrence as_written = recurrence_of(written);
        added.recurrence = recurrence_of(rates);
        if (as_written.sums.size() < added.recurrence->sums.size()) {
            added.checks->pivots = form_.pivots;
            added.recurrence = std::move(as_written);
            rates = written;
        }
        for (std::size_t i = 0; i < rates.size(); ++i) added.outputs[0].entries[i].node = rates[i];
    }

    /// Of the functions of another kernel along the motion.
    void add_series(const std::string& name, const std::string& of)
    {
        const std::vector<NodeId> values = nodes_of(kernel_named(module_, of));
        Kernel kernel = table_kernel(form_, name, column("e", values));
        kernel.inputs = point_inputs(module_);
        kernel.recurrence = recurrence_of(values);
        module_.kernels.push_back(std::move(kernel));
    }

    /// Beside the series of the motion where there is one; conditions with kinks are looked at without it.
    void add_domain_series()
    {
        try {
            add_series("domain_series", "domain");
        } catch (const MathematicsError&) {
            if (wants("domain_series")) throw;
        }
    }

    void add_trees(const std::string& name, const std::vector<NamedTree>& trees)
    {
        if (trees.empty() || !wants(name)) return;
        std::vector<NodeId> values;
        std::vector<std::string> names;
        for (const NamedTree& tree : trees) {
            if (!has_value(model_, tree.value, form_.form->name) || uses_other_states(model_, tree.value, states_))
                continue;
            values.push_back(lower_(tree.value));
            names.push_back(tree.name);
        }
        if (values.empty()) return;
        add_named(name, values, std::move(names));
    }

    void add_named(const std::string& name, const std::vector<NodeId>& values, std::vector<std::string> names)
    {
        Kernel kernel = table_kernel(form_, name, column(name, values));
        kernel.outputs[0].entry_names = std::move(names);
        add(std::move(kernel));
    }

    [[nodiscard]] bool depends_on_parameters_alone(std::initializer_list<NodeId> nodes) const
    {
        std::vector<NodeId> moving = {module_.time};
        for (const Quantity& lane : lanes_of(module_)) moving.push_back(lane.input);
        return !depends_on_any(*graph_, std::vector<NodeId>(nodes), moving);
    }

    /// a < b as b - a, a > b as a - b, a != b as (a - b)^2: positive inside the domain. What holds of the parameters
    /// alone cannot change along a run and is checked once.
    void add_domain()
    {
        std::vector<NodeId> values;
        std::vector<std::string> names;
        for (const Tree& tree : model_.base.domain) {
            if (tree->kind != TreeKind::compare)
                throw InternalError("a domain that is no comparison: " + to_text(tree));
            const NodeId a = lower_(tree->arguments[0]);
            const NodeId b = lower_(tree->arguments[1]);
            const bool less = tree->comparison == Comparison::less || tree->comparison == Comparison::less_equal;
            const NodeId difference = less ? graph_->subtract(b, a) : graph_->subtract(a, b);
            const bool unequal = tree->comparison == Comparison::not_equal;
            const NodeId value = unequal ? graph_->power(difference, 2) : difference;
            if (depends_on_parameters_alone({a, b})) {
                module_.parameter_conditions.emplace_back(to_text(tree), value);
                continue;
            }
            values.push_back(value);
            names.push_back(to_text(tree));
        }
        if (values.empty() || !wants("domain")) return;
        add_named("domain", values, std::move(names));
    }

    void add_jacobian()
    {
        const std::vector<NodeId> lanes = state_of(form_);
        if (is_made_by_columns(*graph_, form_.derivative, lanes, form_.implicit)) {
            const Kernel& tangent = variational();
            std::vector<NodeId> directions;
            for (const Quantity& entry : tangent.inputs.back().entries) directions.push_back(entry.input);
            Kernel kernel =
                table_kernel(form_, "jacobian", entries_along(*graph_, "values", nodes_of(tangent), directions));
            kernel.inputs = point_inputs(module_);
            kernel.directions = std::move(directions);
            return module_.kernels.push_back(std::move(kernel));
        }
        add_derivative("jacobian", lanes);
    }

    /// Of the rates, with respect to these inputs of the graph.
    void add_derivative(const char* name, const std::vector<NodeId>& inputs)
    {
        const std::vector<NodeId> values =
            joined_rows(jacobian_through(*graph_, form_.derivative, inputs, form_.implicit));
        add(table_kernel(form_, name, matrix(*graph_, "values", form_.derivative.size(), inputs.size(), values)));
    }

    /// True where the right-hand side has no factorisation left of those that it was written with.
    [[nodiscard]] bool is_eliminated()
    {
        const auto factors = [&](const std::vector<NodeId>& nodes) {
            return std::ranges::any_of(reachable(*graph_, nodes),
                                       [&](NodeId id) { return graph_->op(id) == Op::factor; });
        };
        return factors(form_.derivative) && !factors(nodes_of(right_hand_side()));
    }

    /// The directional derivative of the right-hand side along v: one sweep, however many lanes there are. Made once;
    /// of the right-hand side with its systems eliminated where they were, since the derivative of a solution has the
    /// products of all entries of the matrix.
    [[nodiscard]] const Kernel& variational()
    {
        if (variational_) return *variational_;
        std::vector<std::pair<NodeId, NodeId>> seeds;
        KernelInput along{"v", ArrayRole::tangent, {1, state_of(form_).size(), 1}, {}};
        for (const NodeId lane : state_of(form_)) {
            const std::string& name = graph_->input_name(lane);
            along.entries.push_back({"d_" + name, {}, {}, graph_->input("tangent of " + name)});
            seeds.emplace_back(lane, along.entries.back().input);
        }
        seeds = seeds_through(*graph_, form_.implicit, std::move(seeds));
        const bool eliminated = is_eliminated();
        const std::vector<NodeId> tangent =
            directional_with_limits(*graph_, eliminated ? nodes_of(right_hand_side()) : form_.derivative, seeds);
        Kernel kernel = table_kernel(form_, "variational", column("dv", tangent));
        kernel.inputs = {std::move(along)};
        if (eliminated) kernel.checks->pivots = right_hand_side().checks->pivots;
        return variational_.emplace(simplified(std::move(kernel)));
    }

    void add_variational() { module_.kernels.push_back(variational()); }

    void add_time_scale()
    {
        std::vector<std::pair<NodeId, NodeId>> seeds = replacements(state_of(form_), form_.derivative);
        seeds.emplace_back(form_.time, graph_->constant(1));
        const NodeId scale = lower_(request_.time_scale);
        const NodeId rate =
            directional(*graph_, std::array{scale}, seeds_through(*graph_, form_.implicit, std::move(seeds)))[0];
        Kernel kernel{.name = "time_scale", .inputs = {}, .outputs = {column("value", {scale, rate})}};
        kernel.documentation = {"A time scale of the motion, and its rate along it, for lagen::Reversible."};
        add(std::move(kernel));
    }

    void add_group_motion()
    {
        AlgebraAction found = algebra_action(*graph_, model_, system_, form_);
        module_.motion = std::move(found.motion);
        for (Kernel& kernel : found.at_states)
            if (wants(kernel.name)) add(std::move(kernel));
        for (Kernel& kernel : found.constants)
            if (wants(kernel.name)) module_.kernels.push_back(simplified(std::move(kernel), {}));
    }

    [[nodiscard]] bool wants_flows() const
    {
        if (wants("flows")) return true;
        return request_.flows && has_kernel(module_, "rhs") && separation_of(module_).kind == Separation::Kind::no;
    }

    [[nodiscard]] ExactFlows flows_of(const HamiltonianNodes& hamiltonian)
    {
        if (states_.empty()) return exact_flows(*graph_, system_, hamiltonian);
        return {0, {}, "it carries the first-order state " + model_.states[states_.front()].symbol.name};
    }

    void add_flows(ExactFlows flows)
    {
        module_.flows = {flows.parts.size(), std::move(flows.obstacle)};
        for (std::size_t k = 0; k < flows.parts.size(); ++k) {
            const std::vector<NodeId>& increments = flows.parts[k].increments;
            KernelOutput output{"ds", {1, increments.size(), 1}, {}};
            for (std::size_t lane = 0; lane < increments.size(); ++lane)
                if (!graph_->is_zero(increments[lane])) output.entries.push_back({lane, 0, increments[lane]});
            Kernel kernel = table_kernel(form_, "flows", std::move(output));
            kernel.name = fmt::format("flow_{}", k);
            kernel.inputs = {{"h", ArrayRole::value, {}, {{"h", {}, {}, flows.length}}}};
            kernel.documentation.front() += fmt::format(" The part is {}.", flows.parts[k].part);
            add(std::move(kernel));
        }
    }

    const Model& model_;
    const System& system_;
    const Report& report_;
    const KernelRequest& request_;
    std::vector<std::size_t> states_; ///< numbers of the first-order states that are lanes
    std::shared_ptr<Graph> graph_;
    Formulation form_;
    Lowering lower_;
    KernelModule module_;
    std::optional<Kernel> rhs_, variational_;
};

} // namespace

KernelModule form_kernels(const Model& model, const System& system, const Report& report, const KernelRequest& request)
{
    refuse_unknown(request);
    const std::vector<NamedTree> inputs = given_inputs(model, request.scene);
    std::optional<System> own;
    if (!inputs.empty()) own = insert_inputs(system, inputs);
    KernelModule module = ModuleBuilder(model, own ? *own : system, report, request).build();
    require_requested(module, model, system, report, request);
    return module;
}

} // namespace lagen
