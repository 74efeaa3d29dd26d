// SPDX-License-Identifier: GPL-2.0-or-later
/// Lowering of a model for its proofs, and the setting in which they are decided.
#include "geometry/claims.hpp"
#include "geometry/regularity.hpp"

#include <algorithm>
#include <set>

namespace lagen {
namespace {

/// Divisors of a tree with the place of the division: b in a / b, and the base of a negative constant power.
struct Divisor {
    Tree tree;
    SourceRange where;
};

bool is_negative_number(const Tree& tree)
{
    if (tree->kind == TreeKind::negate)
        return tree->arguments[0]->kind == TreeKind::number && tree->arguments[0]->number > 0;
    return tree->kind == TreeKind::number && tree->number < 0;
}

void collect_divisors(const Tree& root, std::vector<Divisor>& divisors)
{
    std::set<const TreeNode*> seen;
    std::vector<Tree> stack = {root};
    while (!stack.empty()) {
        const Tree tree = stack.back();
        stack.pop_back();
        if (tree == nullptr || !seen.insert(tree.get()).second) continue;
        if (tree->kind == TreeKind::divide) divisors.push_back({tree->arguments[1], tree->arguments[1]->where});
        if (tree->kind == TreeKind::power && is_negative_number(tree->arguments[1]))
            divisors.push_back({tree->arguments[0], tree->arguments[0]->where});
        // Pushed in reverse, so that the leftmost division is met first.
        for (auto argument = tree->arguments.rbegin(); argument != tree->arguments.rend(); ++argument)
            stack.push_back(*argument);
    }
}

} // namespace

Claims::Claims(const Model& model, const Algebroid& algebroid) : model_(model), algebroid_(algebroid)
{
    lower_model();
    make_decider();
    if (decider_->sample_point()) return;
    refuse_zero_divisors();
    note_ = "no point was found where everything in the model is defined and every condition of [base] holds";
}

void Claims::lower_model()
{
    const std::vector<std::string> names = symbol_names(model_);
    const auto declared = [&](const std::string& name) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    for (const Symbol& symbol : algebroid_.base) graph_.input(symbol.name);
    Lowering plain(graph_);
    for (const NamedTree& casimir : model_.base.casimirs)
        if (!declared(casimir.name)) binding_.emplace(casimir.name, plain(casimir.value));
    lower_ = std::make_unique<Lowering>(graph_, binding_);
    lowered_ = lower_algebroid(graph_, *lower_, algebroid_);
    partial_ = std::make_unique<BaseGradient>(graph_, lowered_.x);
    if (!declared("t")) time_ = graph_.input("t");
    if (model_.lagrangian) hessian_ = fibre_hessian(graph_, (*lower_)(model_.lagrangian), lowered_.y);
}

void Claims::make_decider()
{
    setting_.variables = lowered_.x;
    setting_.variables.insert(setting_.variables.end(), lowered_.y.begin(), lowered_.y.end());
    if (time_) setting_.variables.push_back(*time_);
    for (const std::string& name : algebroid_.parameters) setting_.parameters.push_back(graph_.input(name));
    for (const Tree& tree : algebroid_.domain) setting_.domain.push_back((*lower_)(tree));
    for (const std::vector<Column>* columns : {&lowered_.anchor, &lowered_.bracket})
        for (const Column& column : *columns)
            for (const ColumnEntry& entry : column)
                if (!graph_.is_constant(entry.value)) setting_.defined.push_back(entry.value);
    if (hessian_) setting_.defined.push_back(hessian_->lagrangian);
    for (const NamedTree& casimir : model_.base.casimirs) setting_.defined.push_back((*lower_)(casimir.value));
    std::sort(setting_.defined.begin(), setting_.defined.end());
    setting_.defined.erase(std::unique(setting_.defined.begin(), setting_.defined.end()), setting_.defined.end());
    // One constraint more each time, so that the one that is refused is known by its place.
    ProofSetting growing;
    growing.variables = lowered_.x;
    growing.parameters = setting_.parameters;
    for (const Tree& tree : algebroid_.constraints) {
        const NodeId constraint = (*lower_)(tree);
        setting_.constraints.push_back(constraint);
        growing.constraints.push_back(constraint);
        try {
            ZeroDecider(graph_, growing);
        } catch (const MathematicsError& error) {
            throw ModelError(error.what(), tree->where,
                             "each constraint must solve for a base coordinate that no earlier one uses up, linearly "
                             "or as a monic power");
        }
    }
    decider_ = std::make_unique<ZeroDecider>(graph_, setting_);
}

/// Called where no point of definition was found: a divisor that is zero everywhere explains it.
void Claims::refuse_zero_divisors()
{
    std::vector<Divisor> divisors;
    for (const AnchorValue& entry : algebroid_.rho) collect_divisors(entry.value, divisors);
    for (const StructureValue& entry : algebroid_.C) collect_divisors(entry.value, divisors);
    if (model_.lagrangian) collect_divisors(model_.lagrangian, divisors);
    ProofSetting setting = setting_;
    setting.defined.clear();
    std::vector<NodeId> nodes;
    for (const Divisor& divisor : divisors) nodes.push_back((*lower_)(divisor.tree));
    const ZeroDecider decider(graph_, setting);
    for (std::size_t k = 0; k < divisors.size(); ++k)
        if (decider.decide(nodes[k]).status == ProofStatus::proved)
            throw ModelError("division by " + to_text(divisors[k].tree) + ", which is zero everywhere",
                             divisors[k].where, "a divisor must be nonzero somewhere on the domain");
}

/// The decision, its witness free of fibre coordinates and time that the residual does not depend on.
Decision Claims::decide(NodeId residual, const ZeroDecider& decider) const
{
    Decision decision = decider.decide(residual);
    if (!decision.witness) return decision;
    std::set<std::string> unused;
    for (const NodeId y : lowered_.y) unused.insert(graph_.input_name(y));
    if (time_) unused.insert(graph_.input_name(*time_));
    const NodeId roots[] = {residual};
    for (const NodeId id : reachable(graph_, roots))
        if (graph_.op(id) == Op::input) unused.erase(graph_.input_name(id));
    std::erase_if(decision.witness->point, [&](const auto& entry) { return unused.contains(entry.first); });
    return decision;
}

/// Parameter inputs with their values as nodes; empty where one of them cannot be lowered.
std::vector<std::pair<NodeId, NodeId>> Claims::parameter_values()
{
    Binding known;
    std::vector<std::pair<NodeId, NodeId>> values;
    for (std::size_t pass = 0; pass < model_.parameters.size() && values.size() < model_.parameters.size(); ++pass)
        for (const Parameter& parameter : model_.parameters) {
            if (known.contains(parameter.symbol.name) || !parameter.value) continue;
            const std::vector<std::string> names = names_in(parameter.value);
            if (!std::all_of(names.begin(), names.end(), [&](const std::string& name) { return known.contains(name); }))
                continue;
            const NodeId value = Lowering(graph_, known)(parameter.value);
            known.emplace(parameter.symbol.name, value);
            values.emplace_back(graph_.input(parameter.symbol.name), value);
        }
    return values.size() == model_.parameters.size() ? values : std::vector<std::pair<NodeId, NodeId>>{};
}

void Claims::decide_regularity(VerifiedAlgebroid& verified)
{
    if (hessian_)
        verified.regularity = lagen::decide_regularity(graph_, *hessian_, setting_, *decider_, parameter_values());
}

} // namespace lagen
