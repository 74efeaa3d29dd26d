// SPDX-License-Identifier: GPL-2.0-or-later
#include "kernels/lagrange_kernels.hpp"

#include "graph/differentiate.hpp"
#include "graph/simplify.hpp"
#include "kernels/mechanics.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

namespace {

const std::vector<std::string> kernel_names{"rhs",        "mass_matrix", "momentum", "energy",
                                            "lagrangian", "constraints", "domain",   "observables",
                                            "invariants", "events",      "jacobian"};

void refuse_what_has_no_kernels(const Model& model, const VerifiedAlgebroid& verified)
{
    if (!model.lagrangian)
        throw MathematicsError(
            fmt::format("error: model '{}' has no Lagrangian; the Lagrangian form needs [lagrangian] L", model.name));
    if (verified.regularity.kind == Regularity::Kind::degenerate)
        throw MathematicsError(fmt::format(
            "error: the Lagrangian of model '{}' is degenerate: d2L/dy2 has rank {}, and the Lagrangian form "
            "needs rank {}\nhint: the velocities cannot be solved for; give every fibre coordinate a kinetic term",
            model.name, verified.regularity.rank, model.fibre.coordinates.size()));
}

void refuse_unknown(const std::vector<std::string>& only)
{
    for (const std::string& name : only) {
        if (std::ranges::find(kernel_names, name) != kernel_names.end()) continue;
        const std::string near = nearest_name(name, kernel_names);
        std::string text = fmt::format("error: there is no kernel '{}'; there are", name);
        for (const std::string& known : kernel_names) text += (known == kernel_names.front() ? " " : ", ") + known;
        if (!near.empty()) text += fmt::format("\nhint: did you mean '{}'?", near);
        throw Error(ExitCode::usage, text);
    }
}

/// Kernels of one module, each simplified on its own and left out where nobody asked for it or it would be empty.
class ModuleBuilder {
  public:
    ModuleBuilder(const Model& model, const VerifiedAlgebroid& verified, const KernelRequest& request)
        : model_(model), verified_(verified), request_(request), graph_(std::make_shared<Graph>()),
          nodes_(lagrange_nodes(*graph_, model, verified, wants("rhs") || wants("jacobian"))),
          lower_(*graph_, nodes_.binding)
    {
    }

    KernelModule build()
    {
        describe();
        if (wants("rhs")) add_right_hand_side();
        add_mechanics();
        add_trees("constraints", model_base_constraints(), "Base constraints: each is 0 on M.");
        if (wants("domain")) add_domain();
        add_trees("observables", observables(), "Observables of the model.");
        add_trees("invariants", named(model_.invariants), "Functions that are constant along solutions.");
        if (wants("events")) add_trees("events", events(), "Events: each happens where its value crosses 0.");
        if (wants("jacobian")) add_jacobian();
        return std::move(module_);
    }

  private:
    using NamedTrees = std::vector<std::pair<std::string, Tree>>;

    [[nodiscard]] bool wants(const std::string& name) const
    {
        return request_.only.empty() || std::ranges::find(request_.only, name) != request_.only.end();
    }

    [[nodiscard]] static Quantity quantity(const Symbol& symbol, NodeId input)
    {
        return {symbol.name, symbol.text, symbol.unit, input};
    }

    void describe()
    {
        module_.name = module_.model = model_.name;
        module_.title = model_.title;
        module_.form = "lagrange";
        module_.regenerate = fmt::format("lagen generate {}.toml", model_.name);
        module_.graph = graph_;
        module_.time = nodes_.time;
        for (std::size_t k = 0; k < model_.parameters.size(); ++k)
            module_.parameters.push_back(quantity(model_.parameters[k].symbol, nodes_.parameters[k]));
        for (std::size_t i = 0; i < nodes_.x.size(); ++i)
            module_.base.push_back(quantity(model_.base.coordinates[i], nodes_.x[i]));
        for (std::size_t a = 0; a < nodes_.y.size(); ++a)
            module_.fibre.push_back(quantity(model_.fibre.coordinates[a], nodes_.y[a]));
        module_.parameter_defaults = defaults();
    }

    /// Every default lowered after those that it uses; the model has made sure that there is no cycle.
    std::vector<NodeId> defaults()
    {
        const std::size_t count = model_.parameters.size();
        Binding known;
        std::vector<NodeId> result(count);
        for (std::size_t done = 0; done < count;) {
            const std::size_t before = done;
            for (std::size_t k = 0; k < count; ++k) {
                const Parameter& parameter = model_.parameters[k];
                const std::vector<std::string> uses = names_in(parameter.value);
                const bool ready =
                    std::ranges::all_of(uses, [&](const std::string& use) { return known.contains(use); });
                if (known.contains(parameter.symbol.name) || !ready) continue;
                known[parameter.symbol.name] = result[k] = Lowering(*graph_, known)(parameter.value);
                ++done;
            }
            if (done == before) throw InternalError("parameters that depend on each other in a cycle");
        }
        return result;
    }

    /// Adds a kernel with its entries and pivots simplified together.
    void add(Kernel kernel)
    {
        std::vector<NodeId> outputs;
        for (const KernelEntry& entry : kernel.output.entries) outputs.push_back(entry.node);
        outputs.insert(outputs.end(), kernel.pivots.begin(), kernel.pivots.end());
        std::vector<NodeId> divisors;
        outputs = simplify(*graph_, outputs, divisors);
        for (std::size_t k = 0; k < kernel.output.entries.size(); ++k) kernel.output.entries[k].node = outputs[k];
        for (std::size_t k = 0; k < kernel.pivots.size(); ++k)
            kernel.pivots[k] = outputs[kernel.output.entries.size() + k];
        if (kernel.shape == KernelShape::right_hand_side)
            for (const NodeId divisor : divisors)
                if (std::ranges::find(kernel.pivots, divisor) == kernel.pivots.end()) kernel.pivots.push_back(divisor);
        module_.kernels.push_back(std::move(kernel));
    }

    /// A column of all entries.
    [[nodiscard]] static KernelOutput column(std::string name, const std::vector<NodeId>& values)
    {
        KernelOutput output{std::move(name), values.size(), 1, {}};
        for (std::size_t k = 0; k < values.size(); ++k) output.entries.push_back({k, 0, values[k]});
        return output;
    }

    [[nodiscard]] std::vector<NodeId> state_derivative() const
    {
        std::vector<NodeId> derivative = nodes_.xdot;
        derivative.insert(derivative.end(), nodes_.ydot.begin(), nodes_.ydot.end());
        return derivative;
    }

    void add_right_hand_side()
    {
        Kernel kernel;
        kernel.name = "rhs";
        kernel.shape = KernelShape::right_hand_side;
        kernel.output = column("ds", state_derivative());
        kernel.pivots = nodes_.pivots;
        kernel.documentation = {"The equations of motion, ds = (xdot, ydot): xdot^i = rho^i_a y^a and",
                                "W_ab ydot^b = rho_a(L) - (d2L/dy^a dx^i) rho^i_b y^b - d2L/dy^a dt - p_c C^c_ab y^b.",
                                "Answers singular_mass_matrix where W has no inverse at this state; what depends on "
                                "the parameters alone is",
                                "checked by parameter_status() instead, once. s and ds may be the same object."};
        add(std::move(kernel));
    }

    void add_mechanics()
    {
        const std::size_t r = nodes_.y.size();
        if (wants("mass_matrix") && r > 0) {
            Kernel kernel{"mass_matrix", KernelShape::matrix, {"W", r, r, {}}, {}, {}, {}};
            for (std::size_t k = 0; k < r * r; ++k)
                if (!graph_->is_zero(nodes_.W[k])) kernel.output.entries.push_back({k / r, k % r, nodes_.W[k]});
            kernel.documentation = {fmt::format("W_ab = d2L/dy^a dy^b, shape ({}, {}), symmetric.", r, r)};
            add(std::move(kernel));
        }
        if (wants("momentum") && r > 0)
            add({"momentum",
                 KernelShape::vector,
                 column("p", nodes_.momentum),
                 {fmt::format("p_a = dL/dy^a, shape ({}).", r)},
                 {},
                 {}});
        if (wants("energy"))
            add({"energy", KernelShape::scalar, column("E", {nodes_.energy}), {"E = y^a p_a - L."}, {}, {}});
        if (wants("lagrangian"))
            add({"lagrangian", KernelShape::scalar, column("L", {nodes_.lagrangian}), {"L(t, x, y)."}, {}, {}});
    }

    void add_trees(const std::string& name, const NamedTrees& trees, const std::string& text)
    {
        if (trees.empty() || !wants(name)) return;
        std::vector<NodeId> values;
        std::vector<std::string> names;
        for (const auto& [label, tree] : trees) {
            values.push_back(lower_(tree));
            names.push_back(label);
        }
        add({name, KernelShape::vector, column(name, values), {text}, std::move(names), {}});
    }

    [[nodiscard]] NamedTrees model_base_constraints() const
    {
        NamedTrees trees;
        for (const Tree& tree : verified_.algebroid.constraints) trees.emplace_back(to_text(tree), tree);
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
        if (request_.scene == nullptr || !request_.scene->observe) return trees;
        for (const NamedTree& entry : *request_.scene->observe) {
            const auto known = [&](const auto& other) { return other.first == entry.name; };
            const auto lane = [&](const Quantity& other) { return other.name == entry.name; };
            if (std::ranges::any_of(trees, known) || std::ranges::any_of(module_.base, lane) ||
                std::ranges::any_of(module_.fibre, lane))
                continue;
            trees.emplace_back(entry.name, entry.value);
        }
        return trees;
    }

    [[nodiscard]] bool depends_on_parameters_alone(std::initializer_list<NodeId> nodes) const
    {
        const std::vector<NodeId> below = reachable(*graph_, std::vector<NodeId>(nodes));
        const auto moves = [&](const Quantity& lane) { return std::ranges::find(below, lane.input) != below.end(); };
        return !std::ranges::any_of(module_.base, moves) && !std::ranges::any_of(module_.fibre, moves) &&
               std::ranges::find(below, module_.time) == below.end();
    }

    /// a < b as b - a, a > b as a - b, a != b as (a - b)^2: positive inside the domain. What holds of the parameters
    /// alone cannot change along a run and is left out: a scene is refused where its parameters violate it.
    void add_domain()
    {
        std::vector<NodeId> values;
        std::vector<std::string> names;
        for (const Tree& tree : verified_.algebroid.domain) {
            if (tree->kind != TreeKind::compare)
                throw InternalError("a domain that is no comparison: " + to_text(tree));
            const NodeId a = lower_(tree->arguments[0]);
            const NodeId b = lower_(tree->arguments[1]);
            const bool less = tree->comparison == Comparison::less || tree->comparison == Comparison::less_equal;
            if (depends_on_parameters_alone({a, b})) continue;
            const NodeId difference = less ? graph_->subtract(b, a) : graph_->subtract(a, b);
            values.push_back(tree->comparison == Comparison::not_equal ? graph_->power(difference, 2) : difference);
            names.push_back(to_text(tree));
        }
        if (values.empty()) return;
        add({"domain",
             KernelShape::vector,
             column("domain", values),
             {"Positive inside the domain of the model."},
             std::move(names),
             {}});
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
        std::vector<NodeId> lanes = nodes_.x;
        lanes.insert(lanes.end(), nodes_.y.begin(), nodes_.y.end());
        const std::vector<std::vector<NodeId>> rows = jacobian(*graph_, state_derivative(), lanes);
        Kernel kernel{"jacobian", KernelShape::sparse, {"values", lanes.size(), lanes.size(), {}}, {}, {}, {}};
        for (std::size_t row = 0; row < rows.size(); ++row)
            for (std::size_t k = 0; k < lanes.size(); ++k)
                if (!graph_->is_zero(rows[row][k])) kernel.output.entries.push_back({row, k, rows[row][k]});
        kernel.documentation = {"Derivative of ds with respect to s: the entries that are not zero by structure."};
        add(std::move(kernel));
    }

    const Model& model_;
    const VerifiedAlgebroid& verified_;
    const KernelRequest& request_;
    std::shared_ptr<Graph> graph_;
    LagrangeNodes nodes_;
    Lowering lower_;
    KernelModule module_;
};

} // namespace

KernelModule lagrange_kernels(const Model& model, const VerifiedAlgebroid& verified, const KernelRequest& request)
{
    refuse_unknown(request.only);
    refuse_what_has_no_kernels(model, verified);
    return ModuleBuilder(model, verified, request).build();
}

} // namespace lagen
