// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen solve`: relative equilibria with what is proved of their stability.
#include "analysis/relative_equilibria.hpp"
#include "commands/line/command.hpp"
#include "commands/line/options.hpp"
#include "commands/scene/scene_options.hpp"
#include "commands/scene/start_state.hpp"
#include "equations/symbolic_model.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/core/evaluate.hpp"
#include "graph/core/lower.hpp"
#include "machine/places.hpp"
#include "machine/write_file.hpp"
#include "mechanics/lagrange.hpp"
#include "model/scene_form.hpp"
#include "pipeline.hpp"
#include "text/comma_list.hpp"
#include "text/record.hpp"
#include "verify/verify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lagen {

namespace {

// The values of a scene as they are written: 1/10 and sqrt(2) are no doubles, and a verdict at a bifurcation depends
// on it. Where a number does not come of what is written alone (a start that is projected), the double is taken.

Tree value_in(const std::vector<NamedTree>& given, const std::string& name)
{
    const auto found = std::ranges::find(given, name, &NamedTree::name);
    return found == given.end() ? nullptr : found->value;
}

bool is_closed(const Graph& graph, NodeId node)
{
    const NodeId roots[] = {node};
    return std::ranges::none_of(reachable(graph, roots), [&](NodeId each) { return graph.op(each) == Op::input; });
}

/// The node where it has no inputs and is this number; else the double.
NodeId node_or_double(Graph& graph, NodeId node, long double value)
{
    if (is_closed(graph, node)) {
        const NodeId roots[] = {node};
        const long double there = evaluate<long double>(graph, roots, {})[0];
        if (std::abs(there - value) <= 1e-15L * std::abs(value)) return node;
    }
    return graph.constant(Rational(static_cast<double>(value)));
}

NodeId lowered(Graph& graph, const Tree& tree, const Replacements& parameters)
{
    const NodeId node[] = {Lowering(graph)(tree)};
    return substitute(graph, node, parameters)[0];
}

/// Gives the parameters the scene's values, `values` in numbers; the regularity is decided anew where it rests on them.
void put_exact_parameters(CheckedModel& checked, const Scene& scene, const std::vector<long double>& values)
{
    System& system = checked.system;
    if (!set_parameters(system, values)) return;
    for (std::size_t k = 0; k < values.size(); ++k) {
        auto& [parameter, value] = system.parameter_values[k];
        if (const Tree given = value_in(scene.parameters, system.graph.input_name(parameter)))
            value = node_or_double(system.graph, Lowering(system.graph)(given), values[k]);
    }
    if (rests_on_values(checked.report.mechanics.regularity))
        checked.report.mechanics.regularity = verify_regularity(system);
}

/// (x, mu) at the start as nodes without inputs; `state` is the same in numbers. `graph`: a copy of the system's.
std::vector<NodeId> exact_start(Graph& graph, const System& system, const Scene& scene,
                                const std::vector<long double>& state)
{
    const auto given = [&](NodeId input, NodeId absent) {
        const Tree tree = value_in(scene.initial, graph.input_name(input));
        return tree == nullptr ? absent : lowered(graph, tree, system.parameter_values);
    };
    std::vector<NodeId> start;
    Replacements at = system.parameter_values;
    for (std::size_t i = 0; i < system.n(); ++i) {
        const NodeId x = system.algebroid.x[i];
        start.push_back(node_or_double(graph, given(x, x), state[i]));
        at.emplace_back(x, start.back());
    }
    std::vector<NodeId> momenta = system.mu; // those of the velocities that the scene gives
    if (system.lagrangian) {
        const LagrangianNodes lagrangian = lagrangian_nodes(graph, system);
        const NodeId rest = graph.constant(0);
        for (const NodeId y : lagrangian.fibre.y) at.emplace_back(y, given(y, scene.rest ? rest : y));
        momenta = substitute(graph, lagrangian.fibre.momenta, at);
    }
    for (std::size_t a = 0; a < system.r(); ++a)
        start.push_back(node_or_double(graph, given(system.mu[a], momenta[a]), state[system.n() + a]));
    return start;
}

const CommandSyntax solve_syntax{"solve",
                                 "MODEL",
                                 "Finds relative equilibria: motions along the flow of momenta and Casimirs, with the "
                                 "values of these at the start of "
                                 "a scene. Each is certified, and its stability proved where it can be.",
                                 {{"relative-equilibria", nullptr, "what is solved for"},
                                  option::scene,
                                  option::set,
                                  option::initial,
                                  {"starts", "N", "from how many random points they are sought", "600"},
                                  option::output,
                                  option::unchecked,
                                  option::format}};

const char* reason_of(const RelativeEquilibrium& found)
{
    if (!found.certified) return "not certified: it may be none, or one of a family";
    if (found.definite > 0) return "the second variation is positive definite";
    if (found.definite < 0) return "the second variation is negative definite";
    if (found.stability == Stability::spectrally_unstable) return "an eigenvalue has a positive real part";
    return "the second variation is not definite, and no eigenvalue is certain to have a positive real part";
}

/// ", lambda1 = 2, .."
std::string multipliers_text(const Record& multipliers)
{
    std::string text;
    for (std::size_t i = 0; i < multipliers.size(); ++i)
        text += fmt::format(", lambda{} = {}", i + 1, value_text(multipliers[i]));
    return text;
}

std::string eigenvalue_text(const Record& lambda)
{
    const auto real = lambda[0].get<double>(), imaginary = lambda[1].get<double>();
    return imaginary == 0 ? fmt::format("{:.6g}", real) : fmt::format("{:.6g} {:+.6g}i", real, imaginary);
}

std::string equilibrium_text(const Record& found)
{
    std::string text = filled(found.contains("exact") ? "  {exact} (exactly)\n" : "  {state}\n", found) +
                       filled("  {velocities}\n", found);
    for (const auto& [name, rate] : found["rates"].items()) text += fmt::format("  {}' = {}\n", name, value_text(rate));
    text += filled("  H = {energy}", found) + multipliers_text(found["multipliers"]);
    if (found["certified"] == true && found["radius"] > 0) text += filled("; certified to {radius:.1g}", found);
    const std::string eigenvalues = comma_list(found["eigenvalues"], eigenvalue_text);
    text += filled("\n  on ker dF", found) + (found["flows"] > 0 ? " modulo the flows of F" : "") +
            filled(found["dimension"] == 1 ? ", {dimension} dimension: eigenvalues "
                                           : ", {dimension} dimensions: eigenvalues ",
                   found) +
            (eigenvalues.empty() ? "none" : eigenvalues) + "\n";
    if (found.contains("definite_at"))
        text += fmt::format("  definite with{}\n", multipliers_text(found["definite_at"]).substr(1));
    return text;
}

std::string solution_text(const Record& solution)
{
    const Record &conserved = solution["conserved"], &all = solution["relative_equilibria"];
    std::string text = filled("{model}, scene {scene}: ", solution) +
                       fmt::format("{} relative equilibri{} found\n", all.size(), all.size() == 1 ? "um" : "a");
    for (std::size_t i = 0; i < conserved.size(); ++i)
        text += fmt::format("  F{} = {}{}\n", i + 1, filled("{function} = {value}", conserved[i]),
                            conserved[i]["casimir"] == true ? " (Casimir)" : "");
    for (std::size_t e = 0; e < all.size(); ++e)
        text += fmt::format("\n{}: {}\n", e + 1, filled("{stability}: {reason}", all[e])) + equilibrium_text(all[e]);
    return text;
}

const char* second_variation_of(const RelativeEquilibrium& found)
{
    return found.definite > 0   ? "positive definite"
           : found.definite < 0 ? "negative definite"
                                : "not shown to be definite";
}

/// `velocities`: by fibre coordinates.
Record record_of(const RelativeEquilibrium& found, const RelativeEquilibria& all, const Graph& graph,
                 const Record& velocities)
{
    Record state = Record::object(), rates = Record::object(), exact = Record::object();
    for (std::size_t k = 0; k < all.coordinates.size(); ++k) {
        const std::string& name = graph.input_name(all.coordinates[k]);
        state[name] = found.z[k];
        if (!found.exact.empty()) exact[name] = found.exact[k].get_str();
    }
    for (std::size_t k = 0; k < found.cyclic.size(); ++k) rates[graph.input_name(all.cyclic[k])] = found.cyclic[k];
    Record record = {{"state", state}, {"velocities", velocities}, {"rates", rates}};
    add_unless_empty(record, "exact", exact);
    record.update({{"energy", found.energy},
                   {"multipliers", found.multipliers},
                   {"certified", found.certified},
                   {"radius", found.radius},
                   {"flows", found.flows},
                   {"dimension", found.dimension},
                   {"second_variation", second_variation_of(found)}});
    add_unless_empty(record, "definite_at", found.definite_at);
    Record& eigenvalues = record["eigenvalues"] = Record::array();
    for (const proof::Eigenvalue& lambda : found.eigenvalues)
        for (std::size_t k = 0; k < lambda.multiplicity; ++k) eigenvalues.push_back({lambda.real, lambda.imaginary});
    record["stability"] = to_text(found.stability);
    record["reason"] = reason_of(found);
    return record;
}

void require_autonomous(const Model& model, const Graph& graph, const System& system, const HamiltonianNodes& H)
{
    const NodeId only[] = {H.value};
    if (depends_on_any(graph, only, std::vector<NodeId>{system.time}) || !system.forces.empty())
        throw MathematicsError(fmt::format("relative equilibria are those of motions without forces and explicit time, "
                                           "and model '{}' has them",
                                           model.name));
}

} // namespace

ExitCode run_solve(Arguments arguments)
{
    const Options options(solve_syntax, arguments);
    if (options.help()) return ExitCode::done;
    const bool as_json = options.as_json();
    if (options.has("output")) require_writable(options.get("output"));
    if (!options.has("relative-equilibria"))
        throw UsageError("give --relative-equilibria, which is what it solves for");
    const std::uint64_t starts = whole_option(options, "starts", 0, 100000);
    CheckedModel checked = load(model_path(options.positional()[0]), options.settings(), options.has("unchecked"));
    const Model& model = checked.model;
    require_apart(options, model);
    warn(checked.warnings);
    if (checked.system.distribution || checked.system.control)
        throw MathematicsError(fmt::format("relative equilibria are those of Hamilton's equations of an L or H, and "
                                           "model '{}' is something else",
                                           model.name));
    Scene scene = find_scene(model, options.get("scene"));
    for (const Setting& setting : options.named("initial")) set_initial(model, scene, setting);
    scene = in_form(model, scene, "hamilton");
    const SceneValues values = evaluate_scene(model, scene);
    put_exact_parameters(checked, scene, finite_numbers(values.parameters, scene));
    const System& system = checked.system;
    Graph graph = system.graph;
    std::optional<HamiltonianNodes> H;
    const Regularity& regularity = checked.report.mechanics.regularity;
    if (system.hamiltonian || (system.lagrangian && regularity.kind != Regularity::Kind::degenerate))
        H = closed_hamiltonian(graph, system, regularity.newton_start);
    if (!H)
        throw MathematicsError(
            fmt::format("model '{}' has no Hamiltonian in closed form, whose critical points these are", model.name));
    require_autonomous(model, graph, system, *H);

    StartState to_momenta([&](bool) -> const CheckedModel& { return checked; }, "hamilton");
    (void)to_momenta.prepare(!values.momenta.empty(), true);
    const std::vector<NodeId> start = exact_start(graph, system, scene, to_momenta(values));
    EquilibriumSearch search;
    search.starts = static_cast<std::size_t>(starts);
    const RelativeEquilibria all = relative_equilibria(graph, system, *H, start, search);
    Record solution = {{"model", model.name}, {"scene", scene.name}};
    SymbolicModel symbolic(model, system.written.algebroid, {});
    solution["conserved"] = list_of(all.conserved, [&](const ConservedFunction& each) {
        return Record{{"function", to_text(symbolic.shortest(symbolic.lower(to_tree(graph, each.value))))},
                      {"value", each.level.middle()},
                      {"casimir", each.casimir}};
    });
    solution["relative_equilibria"] = list_of(all.found, [&](const RelativeEquilibrium& found) {
        std::map<std::string, double> inputs;
        for (const NodeId x : system.algebroid.x) inputs[graph.input_name(x)] = 0; // cyclic ones
        for (const auto& [parameter, value] : system.parameter_values)
            inputs[graph.input_name(parameter)] = graph.value(value).get_d();
        for (std::size_t k = 0; k < found.z.size(); ++k) inputs[graph.input_name(all.coordinates[k])] = found.z[k];
        const std::vector<double> y = evaluate<double>(graph, H->y, inputs);
        Record velocities = Record::object();
        for (std::size_t a = 0; a < y.size(); ++a) velocities[model.fibre.coordinates[a].name] = y[a];
        return record_of(found, all, graph, velocities);
    });
    write_file(options.has("output") ? options.get("output") : "-",
               as_json ? to_json(solution) + "\n" : solution_text(solution));
    return ExitCode::done;
}

} // namespace lagen
