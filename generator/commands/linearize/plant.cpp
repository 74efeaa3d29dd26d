// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/linearize/plant.hpp"

#include "analysis/leaf.hpp"
#include "commands/scene/start_state.hpp"
#include "geometry/rational_near.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/core/evaluate.hpp"
#include "graph/core/lower.hpp"
#include "graph/unknowns/solve_unknowns.hpp"
#include "kernels/formulation.hpp"
#include "model/carried_states.hpp"
#include "model/form.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lagen {

namespace {

constexpr long double level_rounding = 1e-15L; ///< of the level of a function at a start in doubles, relative

void require_rates(const Scene& scene)
{
    const FormKind kind = form_named(scene.form).kind;
    if (kind == FormKind::lagrange || kind == FormKind::hamilton) return;
    throw MathematicsError(fmt::format("scene '{}' is run in the form '{}': Lagrange's and Hamilton's equations are "
                                       "linearised",
                                       scene.name, scene.form),
                           kind == FormKind::pontryagin
                               ? "[inputs] in the place of [control], for an input that is given"
                               : "--form lagrange, where the model has [lagrangian]");
}

class PlantMaker {
  public:
    PlantMaker(CheckedModel& checked, const Scene& scene)
        : checked_(checked), model_(checked.model), system_(checked.system), scene_(scene),
          values_(evaluate_scene(checked.model, scene))
    {
        const std::vector<long double> parameters = finite_numbers(values_.parameters, scene);
        set_parameters(checked, parameters);
        set_parameters(checked.system, parameters);
    }

    Plant make()
    {
        out_.graph = system_.graph;
        FormulationRequest request;
        request.states = carried_states(model_, scene_.form, &scene_);
        const Formulation form =
            formulation(out_.graph, model_, system_, checked_.report, form_named(scene_.form).kind, request);
        out_.equations.state = state_of(form);
        out_.equations.inputs = system_.inputs;
        out_.equations.rates = form.derivative;
        out_.equations.implicit = form.implicit;
        set_starts(form);
        leave_out_matrices();
        set_leaf();
        out_.equations.domain = system_.domain;
        out_.parameters = values_.parameters;
        insert_parameters();
        require_autonomous();
        return std::move(out_);
    }

  private:
    void set_starts(const Formulation& form)
    {
        StartState start([this](bool) -> const CheckedModel& { return checked_; }, scene_.form);
        const std::vector<long double> numbers = start(values_);
        std::vector<double> state(numbers.begin(), numbers.end());
        const std::map<std::string, double> known = add_start(form, state);
        std::fill_n(state.begin() + static_cast<std::ptrdiff_t>(form.x.size()), form.lanes.size(), 0.0);
        add_start(form, state);
        Lowering lower(out_.graph, form.binding);
        for (const Input& input : model_.inputs) {
            const auto given = std::ranges::find(scene_.inputs, input.symbol.name, &NamedTree::name);
            const Tree& tree = given != scene_.inputs.end() ? given->value : input.value;
            const NodeId node[] = {lower(tree)};
            const double value = evaluate<double>(out_.graph, node, known)[0];
            if (!std::isfinite(value))
                throw MathematicsError(fmt::format("the input '{}' is no finite number at the start of scene '{}'",
                                                   input.symbol.name, scene_.name));
            for (MotionPoint& each : out_.starts) each.inputs.push_back(value);
            keep_rest(input, tree, node[0], value);
        }
    }

    /// An input of parameters alone is exactly what they make it: u + m g/2 - value stands for u, which is `value`.
    void keep_rest(const Input& input, const Tree& tree, NodeId node, double value)
    {
        std::map<std::string, Rational> known;
        for (const auto& [parameter, constant] : system_.parameter_values)
            known[out_.graph.input_name(parameter)] = out_.graph.value(constant);
        const std::vector<std::string> names = names_in(tree);
        if (!std::ranges::all_of(names, [&](const std::string& name) { return known.contains(name); })) return;
        const std::vector<Rational> exact = evaluate_exactly(out_.graph, std::vector{node}, known);
        if (exact.empty() || exact[0] == Rational(value)) return;
        const NodeId u = out_.graph.input(input.symbol.name);
        rests_.emplace_back(u, out_.graph.add(u, out_.graph.constant(exact[0] - Rational(value))));
    }

    /// Without inputs; by names what is known there.
    std::map<std::string, double> add_start(const Formulation& form, const std::vector<double>& state)
    {
        std::map<std::string, double> known{{"t", static_cast<double>(values_.start)}};
        for (const auto& [name, value] : values_.parameters) known[name] = static_cast<double>(value);
        for (std::size_t k = 0; k < state.size(); ++k) known[out_.graph.input_name(out_.equations.state[k])] = state[k];
        solve_unknowns<double>(out_.graph, form.implicit, known);
        MotionPoint& out = out_.starts.emplace_back(MotionPoint{state, {}, {}});
        for (const ImplicitBlock& block : form.implicit)
            for (const NodeId z : block.unknowns) out.unknowns.push_back(known.at(out_.graph.input_name(z)));
        return known;
    }

    /// Nine entries with R' = R xi are no nine coordinates.
    void leave_out_matrices()
    {
        std::vector<NodeId>&state = out_.equations.state, &rates = out_.equations.rates;
        for (const Reconstruction& g : model_.reconstructions) {
            const auto first = std::ranges::find(state, system_.states[g.first]);
            if (first == state.end()) continue;
            const auto place = first - state.begin(), size = static_cast<std::ptrdiff_t>(g.size * g.size);
            const std::vector<NodeId> entries(first, first + size);
            rates.erase(rates.begin() + place, rates.begin() + place + size);
            if (depends_on_any(out_.graph, rates, entries))
                throw MathematicsError(
                    fmt::format("the motion depends on the matrix '{}' of [reconstruct], whose {} entries are no "
                                "coordinates of a group",
                                g.name, g.size * g.size),
                    "an action algebroid has the columns of the matrix that act as base coordinates");
            state.erase(first, first + size);
            for (MotionPoint& start : out_.starts)
                start.state.erase(start.state.begin() + place, start.state.begin() + place + size);
            out_.following.push_back(g.name);
        }
    }

    /// Levels that are a short fraction but for rounding are that.
    void set_leaf()
    {
        const Leaves leaves = leaves_of(out_.graph, system_);
        out_.equations.constraints = leaves.constraints;
        out_.equations.base = system_.algebroid.x;
        out_.equations.fields = leaves.fields;
        std::map<std::string, long double> start;
        for (std::size_t k = 0; k < out_.equations.state.size(); ++k)
            start[out_.graph.input_name(out_.equations.state[k])] = out_.starts.front().state[k];
        const std::vector<long double> levels = evaluate<long double>(out_.graph, leaves.casimirs, start);
        for (std::size_t k = 0; k < levels.size(); ++k) {
            const Rational level =
                rational_near(levels[k], level_rounding).value_or(Rational(static_cast<double>(levels[k])));
            out_.equations.casimirs.push_back(out_.graph.subtract(leaves.casimirs[k], out_.graph.constant(level)));
        }
    }

    void insert_parameters()
    {
        const auto insert = [this](std::vector<NodeId>& nodes) {
            nodes = substitute(out_.graph, substitute(out_.graph, nodes, system_.parameter_values), rests_);
        };
        insert(out_.equations.rates);
        insert(out_.equations.constraints);
        insert(out_.equations.casimirs);
        insert(out_.equations.domain);
        for (ImplicitBlock& block : out_.equations.implicit) insert(block.residuals);
    }

    void require_autonomous() const
    {
        std::vector<NodeId> nodes = out_.equations.rates;
        for (const ImplicitBlock& block : out_.equations.implicit)
            nodes.insert(nodes.end(), block.residuals.begin(), block.residuals.end());
        if (depends_on_any(out_.graph, nodes, std::vector<NodeId>{system_.time}))
            throw MathematicsError(
                fmt::format("the equations of model '{}' depend on the time t, and have no equilibria", model_.name),
                "what acts from outside may be an input: [inputs]");
    }

    CheckedModel& checked_;
    const Model& model_;
    const System& system_;
    const Scene& scene_;
    SceneValues values_;
    Plant out_;
    Replacements rests_; ///< of inputs that are no floating-point numbers
};

} // namespace

Plant plant_of(CheckedModel& checked, const Scene& scene)
{
    require_rates(scene);
    return PlantMaker(checked, scene).make();
}

} // namespace lagen
