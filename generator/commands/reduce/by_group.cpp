// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/reduce/by_group.hpp"

#include "algebra/named_algebra.hpp"
#include "commands/line/options.hpp"
#include "commands/reduce/quotient_document.hpp"
#include "equations/symbolic_model.hpp"
#include "expression/parse.hpp"
#include "graph/calculus/determinant.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/calculus/places.hpp"
#include "graph/calculus/transplant.hpp"
#include "graph/core/lower.hpp"
#include "mechanics/quotient.hpp"
#include "model/families.hpp"
#include "pipeline.hpp"
#include "verify/judge.hpp"
#include "verify/proof_setting.hpp"
#include "verify/verify_quotient.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace lagen {

namespace {

// Where the orbits of a group are cut: which coordinates stay, and at what values.

/// Choices of coordinates that are looked at.
constexpr std::size_t most_choices = 2000;

using FixedNodes = std::vector<std::optional<NodeId>>; // of each coordinate; nothing where it cannot be fixed

FixedNodes start_values(Graph& graph, const Model& model)
{
    FixedNodes values(model.base.coordinates.size());
    if (model.scenes.empty()) return values;
    const Scene& scene = find_scene(model, "");
    for (std::size_t i = 0; i < values.size(); ++i)
        if (const auto given = std::ranges::find(scene.initial, model.base.coordinates[i].name, &NamedTree::name);
            given != scene.initial.end())
            values[i] = Lowering(graph)(given->value);
    return values;
}

/// Values of coordinates by name; those that are not named are free.
FixedNodes named_values(Graph& graph, const Model& model, const std::string& text)
{
    FixedNodes values(model.base.coordinates.size());
    const std::vector<Symbol> parameters = parameter_symbols(model);
    for (const std::string& each : split_list(text)) {
        const Setting setting = read_setting("slice", each);
        const auto found = std::ranges::find(model.base.coordinates, setting.name, &Symbol::name);
        if (found == model.base.coordinates.end())
            throw UsageError(fmt::format("'{}' of --slice is no coordinate of model '{}'", setting.name, model.name));
        const Tree value = model.observer.close(parse_expression(setting.value));
        for (const std::string& used : names_in(value))
            if (std::ranges::find(parameters, used, &Symbol::name) == parameters.end())
                throw UsageError(fmt::format("'{}' in --slice is no parameter of model '{}'", used, model.name));
        values[static_cast<std::size_t>(found - model.base.coordinates.begin())] = Lowering(graph)(value);
    }
    return values;
}

/// The slice that `text` ("x=0, y=l") names. Without it: as many coordinates as the group has dimensions, at their
/// values in the first scene (that called default, where there is one), else at 0, such that the orbits cross it: where
/// possible at every point, else at the start of that scene. Throws UsageError for a text that names others, and
/// MathematicsError where there is none.
Slice choose_slice(Graph& graph, const CheckedModel& checked, const InfinitesimalAction& action,
                   const std::string& group, const std::string& text)
{
    const Model& model = checked.model;
    const System& whole = checked.system;
    const std::size_t size = action.fields.size();
    std::vector<FixedNodes> offers;
    if (text.empty())
        offers = {start_values(graph, model), FixedNodes(whole.n(), graph.constant(0))};
    else
        offers = {named_values(graph, model, text)};
    Replacements start; // a slice that orbits cross there is better than one that they touch
    for (std::size_t i = 0; i < whole.n(); ++i)
        if (offers[0][i]) start.emplace_back(whole.algebroid.x[i], *offers[0][i]);
    std::optional<Slice> crossed, touched;
    Judge judge(graph, proof_setting(graph, whole), {});
    const auto vanishes = [&](NodeId f) { return judge.decide(f).status != ProofStatus::refuted; };
    for (const FixedNodes& values : offers) {
        if (size > whole.n()) break;
        Places choice = first_places(size);
        std::size_t tried = 0;
        do {
            Slice slice{choice, {}};
            for (const std::size_t k : choice)
                if (values[k]) slice.values.push_back(*values[k]);
            if (size > determinant_limit || slice.values.size() < size) continue;
            try {
                const NodeId only[] = {slice_determinant(graph, whole, action, slice)};
                if (graph.is_constant(only[0]) && !graph.is_zero(only[0])) return slice;
                if (crossed || vanishes(only[0])) continue;
                if (!touched) touched = slice;
                if (!vanishes(substitute(graph, only, start)[0])) crossed = slice;
            } catch (const DivisionByZero&) { // the field has no value there
            }
        } while (++tried < most_choices && next_places(choice, whole.n()));
    }
    if (crossed) return *crossed;
    if (touched) return *touched;
    throw MathematicsError(
        fmt::format("no slice {}of its coordinates cuts the orbits of {} on model '{}' in points: the group has "
                    "dimension {}",
                    text.empty() ? "" : fmt::format("'{}' ", text), group, model.name, size),
        "the group acts freely where orbits are as large as it is; --slice 'x=1, y=0' names coordinates and values");
}

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
