// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/reduce/by_group.hpp"

#include "algebra/named_algebra.hpp"
#include "commands/reduce/choose_slice.hpp"
#include "commands/reduce/quotient_document.hpp"
#include "equations/symbolic_model.hpp"
#include "graph/calculus/transplant.hpp"
#include "model/families.hpp"
#include "verify/verify_quotient.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace lagen {

namespace {

void require_quotient(const Model& model, const System& system)
{
    require_tangent_lagrangian(model, "a reduction by a group");
    if (!system.forces.empty() || !system.constraints.empty() || !system.inputs.empty())
        throw MathematicsError(
            fmt::format(
                "model '{}' has forces, constraints or inputs, which a reduction by a group does not carry over",
                model.name),
            "leave them out, or write the quotient with its morphism: lagen reduce MORPHISM");
}

/// "w1", "w2", ..: one a generator, that nothing else is called; "w" of one.
std::vector<std::string> generator_names(const Model& model, std::size_t count)
{
    std::vector<std::string> taken = symbol_names(model), names;
    for (const Definition& each : model.definitions) taken.push_back(each.name);
    for (std::size_t b = 1; b <= count; ++b) {
        names.push_back(count == 1 ? "w" : fmt::format("w{}", b));
        while (std::ranges::find(taken, names.back()) != taken.end()) names.back() += '_';
    }
    return names;
}

/// The coordinates of `model` with a section a generator, whose groupoid is the action.
Model read_action_model(const Model& model, const std::vector<Setting>& settings, const std::string& group,
                        const std::string& action, const std::vector<std::string>& w)
{
    ReducedDocument document(model, settings, "to an action");
    document.keep({"parameters", "sizes", "base"});
    document.at("name") = toml_string("action");
    document.erase("base", {"domain"});
    std::vector<std::string> conditions;
    for (const Tree& each : model.base.domain) conditions.push_back(to_text(each));
    if (!conditions.empty()) entry_in(document.at("base"), "domain") = toml_list(conditions);
    entry_in(document.at("fibre"), "coordinates") = toml_list(w);
    TomlValue& groupoid = document.at("groupoid");
    entry_in(groupoid, "kind") = toml_string("action");
    entry_in(groupoid, "group") = toml_string(group);
    TomlValue& moved = entry_in(groupoid, "action");
    for (const std::string& each : split_list(action)) {
        const Setting setting = read_setting("action", each);
        entry_in(moved, setting.name) = toml_string(setting.value.text);
    }
    for (const Symbol& each : model.base.coordinates) // what is not named stays
        if (std::ranges::none_of(moved.entries, [&](const TomlEntry& e) { return names_entry(e.name(), each.name); }))
            entry_in(moved, each.name) = toml_string(each.name);
    return read_model_text("--action", document.text("# The action\n"));
}

InfinitesimalAction infinitesimal(Graph& graph, const System& whole, const System& moving)
{
    std::map<NodeId, NodeId> inputs;
    for (std::size_t i = 0; i < whole.n(); ++i) inputs[moving.algebroid.x[i]] = whole.algebroid.x[i];
    InfinitesimalAction action{{}, true};
    for (std::size_t b = 0; b < moving.r(); ++b) {
        Graph own = moving.graph;
        std::vector<NodeId> field;
        for (std::size_t i = 0; i < whole.n(); ++i)
            field.push_back(Algebroid::entry(own, moving.algebroid.anchor[b], i));
        action.fields.push_back(transplant(graph, own, field, inputs));
        for (std::size_t c = 0; c < moving.r(); ++c)
            action.is_abelian = action.is_abelian && moving.algebroid.C(b, c).empty();
    }
    return action;
}

void add_checks(StructureReport& to, const StructureReport& from)
{
    to.checks.insert(to.checks.end(), from.checks.begin(), from.checks.end());
    to.trivial += from.trivial;
    to.verdict = verdict_of(to);
}

} // namespace

GroupQuotient quotient_by_group(const CheckedModel& checked, const std::vector<Setting>& settings,
                                const std::string& group, const std::string& action, const std::string& slice)
{
    const Model& model = checked.model;
    const System& whole = checked.system;
    require_quotient(model, whole);
    const std::optional<NamedAlgebra> algebra = algebra_of_group(group);
    const std::vector<std::string> names = generator_names(model, algebra ? algebra->basis.size() : 1);
    const Model acting = read_action_model(model, settings, group, action, names);
    const System moving = elaborate(acting);

    GroupQuotient made;
    add_checks(made.report, verify_right_action(moving));
    if (made.report.verdict == Verdict::invalid) {
        made.said = "  x.W is no right action\n";
        return made;
    }
    Graph graph = whole.graph;
    const InfinitesimalAction fields = infinitesimal(graph, whole, moving);
    add_checks(made.report, verify_symmetry(graph, whole, fields, names));
    if (made.report.verdict == Verdict::invalid) {
        made.said = "  the action does not leave L as it is\n";
        return made;
    }

    std::vector<NodeId> w;
    for (const std::string& each : names) w.push_back(graph.input(each));
    const Quotient divided = quotient(graph, whole, fields, choose_slice(graph, checked, fields, group, slice), w);
    const GroupReduction reduction{model,
                                   whole,
                                   graph,
                                   fields,
                                   divided,
                                   group,
                                   algebra ? algebra->name : "",
                                   [&](NodeId f) { return is_invariant(graph, whole, fields, f); },
                                   [&](NodeId f) { return is_invariant_set(graph, whole, fields, f); }};
    QuotientDocument document(reduction, settings);
    const std::string name = model.name + "_quotient.toml";
    const Model draft = read_model_text(name, document.text(document.lagrangian()));
    const System drafted = elaborate(draft);
    SymbolicModel symbolic(draft, drafted.written.algebroid, {});
    const Tree lagrangian = symbolic.shortest(symbolic.lower(draft.lagrangian));
    made.document = document.text(lagrangian);
    made.lagrangian = to_text(lagrangian);
    add_checks(made.report,
               verify_quotient(graph, whole, fields, divided, elaborate(read_model_text(name, made.document))));
    for (const auto& [defined, value] : document.definitions()) made.said += fmt::format("  {} = {}\n", defined, value);
    made.said += fmt::format("  L = {}\n", made.lagrangian);
    return made;
}

} // namespace lagen
