// SPDX-License-Identifier: GPL-2.0-or-later
#include "kernels/form_kernels.hpp"

#include "graph/calculus/differentiate.hpp"
#include "kernels/formulation.hpp"
#include "kernels/kernel_table.hpp"
#include "kernels/requested_kernels.hpp"
#include "model/scene_form.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

namespace {

Formulation formulation(Graph& graph, const Model& model, const System& system, const Report& report,
                        const KernelRequest& request, const FormulationParts& parts)
{
    switch (form_named(request.form.empty() ? default_form(model) : request.form).kind) {
    case FormKind::lagrange: return lagrange_form(graph, system, report, parts);
    case FormKind::hamilton: return hamilton_form(graph, system, report, parts);
    case FormKind::pontryagin: return pontryagin_form(graph, model, system, report, parts);
    }
    throw InternalError("a form without kernels");
}

/// Kernels of one module, each simplified on its own and left out where nobody asked for it or it would be empty.
class ModuleBuilder {
  public:
    ModuleBuilder(const Model& model, const System& system, const Report& report, const KernelRequest& request)
        : model_(model), system_(system), request_(request), graph_(std::make_shared<Graph>(system.graph)),
          form_(formulation(*graph_, model, system, report, request, parts())), lower_(*graph_, form_.binding)
    {
    }

    KernelModule build()
    {
        describe();
        if (wants("rhs")) add_right_hand_side();
        for (Kernel& kernel : form_.kernels)
            if (wants(kernel.name)) add(std::move(kernel));
        add_trees("constraints", model_base_constraints());
        add_domain();
        add_trees("observables", observables());
        add_trees("invariants", named(model_.invariants));
        if (wants("events")) add_trees("events", events());
        if (wants("jacobian")) add_jacobian();
        if (wants("variational")) add_variational();
        simplify_implicit();
        return std::move(module_);
    }

  private:
    using NamedTrees = std::vector<std::pair<std::string, Tree>>;

    [[nodiscard]] bool wants(const std::string& name) const { return is_requested(request_.only, name); }

    [[nodiscard]] FormulationParts parts() const
    {
        return {.motion = wants("rhs") || wants("jacobian") || wants("variational"),
                .hessians = wants("lagrangian_hessian") || wants("hamiltonian_hessian")};
    }

    [[nodiscard]] static Quantity quantity(const Symbol& symbol, NodeId input)
    {
        return {symbol.name, symbol.text, symbol.unit, input};
    }

    void describe()
    {
        module_.model = model_.name;
        module_.form = form_.form->name;
        module_.name = model_.name + form_.form->suffix;
        module_.title = model_.title;
        module_.regenerate = fmt::format("lagen generate {}.toml", model_.name);
        module_.graph = graph_;
        module_.time = form_.time;
        for (std::size_t k = 0; k < model_.parameters.size(); ++k)
            module_.parameters.push_back(quantity(model_.parameters[k].symbol, form_.parameters[k]));
        LaneGroup base{"Base", "base", "Base coordinates, the first lanes of State.", {}};
        for (std::size_t i = 0; i < form_.x.size(); ++i)
            base.lanes.push_back(quantity(model_.base.coordinates[i], form_.x[i]));
        LaneGroup fibre{form_.form->lane_group, "fibre", "The other lanes of State.", {}};
        for (std::size_t a = 0; a < form_.lanes.size(); ++a)
            fibre.lanes.push_back(quantity(lane_symbol(a), form_.lanes[a]));
        module_.groups = {std::move(base), std::move(fibre)};
        module_.implicit = form_.implicit;
        module_.parameter_conditions = form_.parameter_conditions;
        for (const auto& [parameter, value] : system_.parameter_values) module_.parameter_defaults.push_back(value);
    }

    [[nodiscard]] const Symbol& lane_symbol(std::size_t a) const
    {
        return (form_.form->momenta ? model_.fibre.momenta : model_.fibre.coordinates)[a];
    }

    /// Adds a kernel at (t, s) with its entries and pivots simplified together.
    void add(Kernel kernel)
    {
        std::vector<KernelInput> inputs = point_inputs(module_);
        kernel.inputs.insert(kernel.inputs.begin(), inputs.begin(), inputs.end());
        std::vector<NodeId> outputs = nodes_of(kernel);
        if (kernel.checks) outputs.insert(outputs.end(), kernel.checks->pivots.begin(), kernel.checks->pivots.end());
        std::vector<NodeId> divisors;
        SimplifyReport report;
        outputs = simplify(*graph_, outputs, divisors, request_.reports != nullptr ? &report : nullptr);
        if (request_.reports != nullptr) request_.reports->push_back({kernel.name, std::move(report)});
        auto next = outputs.begin();
        for (KernelOutput& output : kernel.outputs)
            for (KernelEntry& entry : output.entries) entry.node = *next++;
        if (kernel.checks) {
            std::vector<NodeId>& pivots = kernel.checks->pivots;
            pivots.assign(next, outputs.end());
            for (const NodeId divisor : divisors)
                if (std::ranges::find(pivots, divisor) == pivots.end()) pivots.push_back(divisor);
        }
        module_.kernels.push_back(std::move(kernel));
    }

    void add_right_hand_side()
    {
        Kernel kernel = table_kernel(form_, "rhs", column("ds", form_.derivative));
        kernel.checks->pivots = form_.pivots;
        kernel.documentation = form_.documentation;
        add(std::move(kernel));
    }

    void add_trees(const std::string& name, const NamedTrees& trees)
    {
        if (trees.empty() || !wants(name)) return;
        std::vector<NodeId> values;
        std::vector<std::string> names;
        for (const auto& [label, tree] : trees) {
            if (form_.controls.empty() && uses_controls(model_, tree)) continue; // no value in this form
            values.push_back(lower_(tree));
            names.push_back(label);
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

    [[nodiscard]] NamedTrees model_base_constraints() const
    {
        NamedTrees trees;
        for (const Tree& tree : model_.base.constraints) trees.emplace_back(to_text(tree), tree);
        return trees;
    }

    [[nodiscard]] static NamedTrees named(const std::vector<NamedTree>& list)
    {
        NamedTrees trees;
        for (const NamedTree& entry : list) trees.emplace_back(entry.name, entry.value);
        return trees;
    }

    /// Of the model, then what the scene asks for that is neither a state lane nor one of them.
    [[nodiscard]] NamedTrees observables() const
    {
        NamedTrees trees = named(model_.observables);
        if (request_.scene == nullptr) return trees;
        if (!request_.scene->observe)
            for (const std::string& control : form_.controls) trees.emplace_back(control, lagen::name(control));
        if (!request_.scene->observe) return trees;
        for (const NamedTree& entry : *request_.scene->observe) {
            const auto known = [&](const auto& other) { return other.first == entry.name; };
            const auto lane = [&](const Quantity& other) { return other.name == entry.name; };
            if (std::ranges::any_of(trees, known) || std::ranges::any_of(lanes_of(module_), lane)) continue;
            trees.emplace_back(entry.name, entry.value);
        }
        return trees;
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

    /// Of the one scene asked for, or of all; the same event of two scenes once, different ones of one name with the
    /// scene's name in front.
    [[nodiscard]] NamedTrees events() const
    {
        NamedTrees trees;
        const auto find = [&](const std::string& name) {
            return std::ranges::find_if(trees, [&](const auto& entry) { return entry.first == name; });
        };
        const auto append = [&](const Scene& scene) {
            for (const Event& event : scene.events) {
                const auto found = find(event.name);
                if (found == trees.end())
                    trees.emplace_back(event.name, event.when);
                else if (!same_tree(found->second, event.when))
                    trees.emplace_back(scene.name + "." + event.name, event.when);
            }
        };
        if (request_.scene != nullptr)
            append(*request_.scene);
        else
            for (const Scene& scene : model_.scenes) append(scene);
        return trees;
    }

    void add_jacobian()
    {
        const std::vector<NodeId> lanes = state_of(form_);
        const std::vector<NodeId> values =
            joined_rows(jacobian_through(*graph_, form_.derivative, lanes, form_.implicit));
        add(table_kernel(form_, "jacobian", matrix(*graph_, "values", lanes.size(), lanes.size(), values)));
    }

    /// The directional derivative of the right-hand side along v: one sweep, however many lanes there are.
    void add_variational()
    {
        std::vector<std::pair<NodeId, NodeId>> seeds;
        KernelInput along{"v", ArrayRole::tangent, {1, state_of(form_).size(), 1}, {}};
        for (const NodeId lane : state_of(form_)) {
            const std::string& name = graph_->input_name(lane);
            along.entries.push_back({"d_" + name, {}, {}, graph_->input("tangent of " + name)});
            seeds.emplace_back(lane, along.entries.back().input);
        }
        const std::vector<NodeId> tangent =
            directional(*graph_, form_.derivative, seeds_through(*graph_, form_.implicit, std::move(seeds)));
        Kernel kernel = table_kernel(form_, "variational", column("dv", tangent));
        kernel.inputs = {std::move(along)};
        add(std::move(kernel));
    }

    /// Residuals, Jacobian and guess of each block, simplified together.
    void simplify_implicit()
    {
        for (ImplicitBlock& block : module_.implicit) {
            std::vector<NodeId> divisors;
            block.guess = simplify(*graph_, block.guess, divisors);
            if (block.bracket)
                for (auto* ends : {&block.bracket->lower, &block.bracket->upper})
                    for (std::optional<NodeId>& end : *ends)
                        if (end) end = simplify(*graph_, std::vector<NodeId>{*end}, divisors).front();
            if (block.angles)
                for (auto* parts : {&block.angles->b, &block.angles->c}) *parts = simplify(*graph_, *parts, divisors);
            std::vector<NodeId> inner = block.residuals;
            for (const auto* more : {&block.jacobian, &block.inside})
                inner.insert(inner.end(), more->begin(), more->end());
            inner = simplify(*graph_, inner, divisors);
            auto from = inner.begin();
            for (auto* part : {&block.residuals, &block.jacobian, &block.inside})
                for (NodeId& node : *part) node = *from++;
            block.sizes = rounding_sizes(*graph_, block.residuals);
        }
    }

    const Model& model_;
    const System& system_;
    const KernelRequest& request_;
    std::shared_ptr<Graph> graph_;
    Formulation form_;
    Lowering lower_;
    KernelModule module_;
};

} // namespace

KernelModule form_kernels(const Model& model, const System& system, const Report& report, const KernelRequest& request)
{
    refuse_unknown(request.only);
    KernelModule module = ModuleBuilder(model, system, report, request).build();
    require_requested(module, model, system, report, request);
    return module;
}

} // namespace lagen
