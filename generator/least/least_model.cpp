// SPDX-License-Identifier: GPL-2.0-or-later
#include "least/least_model.hpp"

#include "graph/calculus/differentiate.hpp"
#include "kernels/jumps.hpp"
#include "kernels/named_trees.hpp"
#include "mechanics/lagrange.hpp"
#include "model/scene_form.hpp"
#include "verify/proof_setting.hpp"

#include <algorithm>

namespace lagen {

namespace {

constexpr std::size_t most_simplified = 250; ///< nodes of rates whose operations are counted in their cheapest form

class LaneSystemMaker {
  public:
    LaneSystemMaker(const Model& model, const System& system, const Report& report, const Scene& scene)
        : model_(model), system_(insert_inputs(system, given_inputs(model, &scene))), scene_(scene),
          graph_(std::make_shared<Graph>(system_.graph)),
          form_(formulation(*graph_, model, system_, report, form_named(scene.form).kind, request())),
          lower_(*graph_, form_.binding)
    {
    }

    LaneSystem make()
    {
        out_.graph = graph_;
        out_.time = system_.time;
        if (scene_.start) out_.start_time = lower_(scene_.start);
        out_.lanes = state_of(form_);
        out_.rates = form_.derivative;
        if (!form_.implicit.empty()) out_.obstacle = "the rates rest on equations that are solved step by step";
        out_.setting = proof_setting(*graph_, system_);
        for (const NodeId lane : out_.lanes)
            if (std::ranges::find(out_.setting.variables, lane) == out_.setting.variables.end())
                out_.setting.variables.push_back(lane);
        set_values();
        set_start();
        set_watched();
        set_jumps();
        set_candidates();
        return std::move(out_);
    }

  private:
    [[nodiscard]] FormulationRequest request() const
    {
        FormulationRequest request;
        for (std::size_t k = 0; k < model_.states.size(); ++k) request.states.push_back(k);
        request.inputs = given_inputs(model_, &scene_);
        return request;
    }

    [[nodiscard]] static Tree given(const std::vector<NamedTree>& values, const std::string& name)
    {
        const auto found = std::ranges::find(values, name, &NamedTree::name);
        return found == values.end() ? nullptr : found->value;
    }

    /// As the scene or the file writes them; values that rest on other parameters are put together.
    void set_values()
    {
        for (const Parameter& parameter : model_.parameters) {
            if (parameter.bound) continue;
            const Tree tree = given(scene_.parameters, parameter.symbol.name);
            out_.values.emplace_back(graph_->input(parameter.symbol.name),
                                     lower_(tree == nullptr ? parameter.value : tree));
        }
        for (std::size_t round = 0; round < out_.values.size(); ++round) {
            std::vector<NodeId> values;
            for (const auto& each : out_.values) values.push_back(each.second);
            if (!depends_on_any(*graph_, values, system_.parameters)) break;
            values = substitute(*graph_, values, out_.values);
            for (std::size_t k = 0; k < values.size(); ++k) out_.values[k].second = values[k];
        }
    }

    void set_start()
    {
        const bool has_momenta = std::ranges::any_of(
            system_.mu, [&](NodeId mu) { return given(scene_.initial, graph_->input_name(mu)) != nullptr; });
        const std::size_t behind = form_.x.size() + form_.lanes.size();
        std::vector<std::optional<NodeId>> start;
        for (std::size_t i = 0; i < out_.lanes.size(); ++i) {
            const Tree tree = given(scene_.initial, graph_->input_name(out_.lanes[i]));
            std::optional<NodeId>& value = start.emplace_back();
            if (tree != nullptr)
                value = lower_(tree);
            else if (i >= behind)
                value = graph_->constant(model_.states[i - behind].start);
            if (i < form_.x.size() && scene_.project) value.reset();
        }
        if (form_.form->momenta && !has_momenta && system_.lagrangian) set_momenta(start);
        out_.start = std::move(start);
    }

    /// mu = dL/dy at the start.
    void set_momenta(std::vector<std::optional<NodeId>>& start)
    {
        Replacements at;
        for (std::size_t i = 0; i < form_.x.size(); ++i) {
            if (!start[i]) return;
            at.emplace_back(form_.x[i], *start[i]);
        }
        const LagrangianNodes lagrangian = lagrangian_nodes(*graph_, system_);
        for (const NodeId y : lagrangian.fibre.y) {
            const Tree tree = given(scene_.initial, graph_->input_name(y));
            if (tree == nullptr) return;
            at.emplace_back(y, lower_(tree));
        }
        at.emplace_back(system_.time, out_.start_time.value_or(graph_->constant(0)));
        const std::vector<NodeId> momenta = substitute(*graph_, lagrangian.fibre.momenta, at);
        for (std::size_t a = 0; a < momenta.size(); ++a) start[form_.x.size() + a] = momenta[a];
    }

    void watch(const std::string& name, const Tree& tree) { out_.watched.push_back({lower_(tree), name}); }

    void set_watched()
    {
        if (scene_.observe)
            for (const NamedTree& column : *scene_.observe) watch(column.name, column.value);
        else
            for (const NodeId lane : out_.lanes) out_.watched.push_back({lane, graph_->input_name(lane)});
        for (const Event& event : scene_.events) watch(event.name, event.when);
        if (scene_.time_scale != nullptr) watch("time_scale", scene_.time_scale);
        for (const NodeId condition : system_.domain)
            if (depends_on_any(*graph_, std::vector{condition}, out_.lanes)) out_.walls.push_back(condition);
    }

    void set_jumps()
    {
        if (!has_jumps(model_, &scene_, *form_.form)) return;
        const Kernel kernel = jumps_kernel(*graph_, model_, system_, form_, &scene_);
        const KernelOutput& output = kernel.outputs.at(0);
        out_.jumps.assign(output.shape.columns, std::vector<NodeId>(out_.lanes.size(), graph_->constant(0)));
        for (const KernelEntry& entry : output.entries) out_.jumps[entry.column][entry.row] = entry.node;
    }

    void set_candidates()
    {
        if (!form_.form->momenta && system_.lagrangian)
            for (const NodeId mu : system_.mu) {
                const std::string& name = graph_->input_name(mu);
                out_.candidates.push_back({form_.binding.at(name), name});
            }
        else
            for (const NodeId lane : form_.lanes) out_.candidates.push_back({lane, graph_->input_name(lane)});
        if (const auto energy = form_.binding.find("energy"); energy != form_.binding.end())
            out_.candidates.push_back({energy->second, "energy"});
        for (const NamedTree& invariant : conserved_trees(model_))
            if (has_value(model_, invariant.value, scene_.form))
                out_.candidates.push_back({lower_(invariant.value), invariant.name});
        for (const NamedTree& casimir : model_.base.casimirs)
            out_.candidates.push_back({lower_(casimir.value), casimir.name});
    }

    const Model& model_;
    System system_;
    const Scene& scene_;
    std::shared_ptr<Graph> graph_;
    Formulation form_;
    Lowering lower_;
    LaneSystem out_;
};

} // namespace

LaneSystem lane_system(const Model& model, const System& system, const Report& report, const Scene& scene)
{
    return LaneSystemMaker(model, system, report, scene).make();
}

LeastModel least_model(LaneSystem system)
{
    Graph& graph = *system.graph;
    std::erase_if(system.candidates, [&](const NamedNode& candidate) {
        return may_jump(graph, {candidate.node}, system.lanes); // its rate does not tell
    });
    LeastModel least{system, Reduction(system), {}, {}, {}};
    if (system.obstacle.empty())
        for (bool smaller = true; smaller;) {
            smaller = false;
            for (const LeastRule& rule : least_rules())
                if ((smaller = rule.apply(least.reduction))) break; // the first ones are the simplest
        }
    least.rank = certified_rank(least.reduction);
    const std::vector<NodeId> rates = least.reduction.prover.with_relations(least.reduction.system.rates);
    const bool is_short = reachable(graph, system.rates).size() <= most_simplified;
    least.full_operations = count_operations(graph, is_short ? simplify(graph, system.rates) : system.rates);
    least.least_operations = count_operations(graph, is_short ? simplify(graph, rates) : rates);
    return least;
}

} // namespace lagen
