// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen solve`: relative equilibria with what is proved of their stability.
#include "analysis/relative_equilibria.hpp"
#include "commands/exact_start.hpp"
#include "commands/line/command.hpp"
#include "commands/line/options.hpp"
#include "commands/line/values.hpp"
#include "commands/machine/places.hpp"
#include "commands/machine/write_file.hpp"
#include "commands/scene/scene_options.hpp"
#include "commands/scene/start_state.hpp"
#include "equations/symbolic_model.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/core/evaluate.hpp"
#include "graph/core/lower.hpp"
#include "model/scene_form.hpp"
#include "pipeline.hpp"
#include "text/record.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

namespace {

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

using NamedValues = std::vector<std::pair<std::string, double>>;

/// What was found, in the model's words.
struct Solution {
    const Model& model;
    std::string scene;
    RelativeEquilibria equilibria;
    std::vector<std::string> conserved;  ///< as texts
    std::vector<NamedValues> velocities; ///< of each, by fibre coordinates
};

std::string number(double value)
{
    return fmt::format("{:.12g}", value == 0 ? 0.0 : value);
}

const char* reason_of(const RelativeEquilibrium& found)
{
    if (!found.certified) return "not certified: it may be none, or one of a family";
    if (found.definite > 0) return "the second variation is positive definite";
    if (found.definite < 0) return "the second variation is negative definite";
    if (found.stability == Stability::spectrally_unstable) return "an eigenvalue has a positive real part";
    return "the second variation is not definite, and no eigenvalue is certain to have a positive real part";
}

std::string eigenvalues_text(const RelativeEquilibrium& found)
{
    std::string text;
    for (const proof::Eigenvalue& each : found.eigenvalues)
        for (std::size_t k = 0; k < each.multiplicity; ++k) {
            text += text.empty() ? "" : ", ";
            text += each.imaginary == 0 ? fmt::format("{:.6g}", each.real)
                                        : fmt::format("{:.6g} {:+.6g}i", each.real, each.imaginary);
        }
    return text;
}

/// ", lambda1 = 2, .."
std::string multipliers_text(const std::vector<double>& multipliers)
{
    std::string text;
    for (std::size_t i = 0; i < multipliers.size(); ++i)
        text += fmt::format(", lambda{} = {}", i + 1, number(multipliers[i]));
    return text;
}

std::string solution_text(const Solution& solution, const Graph& graph)
{
    const RelativeEquilibria& all = solution.equilibria;
    std::string text = fmt::format("{}, scene {}: {} relative equilibri{} found\n", solution.model.name, solution.scene,
                                   all.found.size(), all.found.size() == 1 ? "um" : "a");
    for (std::size_t i = 0; i < all.conserved.size(); ++i)
        text += fmt::format("  F{} = {} = {}{}\n", i + 1, solution.conserved[i],
                            number(all.conserved[i].level.middle()), all.conserved[i].casimir ? " (Casimir)" : "");
    for (std::size_t e = 0; e < all.found.size(); ++e) {
        const RelativeEquilibrium& found = all.found[e];
        text += fmt::format("\n{}: {}: {}\n", e + 1, to_text(found.stability), reason_of(found));
        std::string state;
        for (std::size_t k = 0; k < all.coordinates.size(); ++k)
            state += fmt::format("{}{} = {}", state.empty() ? "" : ", ", graph.input_name(all.coordinates[k]),
                                 found.exact.empty() ? number(found.z[k]) : found.exact[k].get_str());
        text += fmt::format("  {}{}\n", state, found.exact.empty() ? "" : " (exactly)");
        std::string velocities;
        for (const auto& [name, value] : solution.velocities[e])
            velocities += fmt::format("{}{} = {}", velocities.empty() ? "" : ", ", name, number(value));
        text += fmt::format("  {}\n", velocities);
        for (std::size_t k = 0; k < found.cyclic.size(); ++k)
            text += fmt::format("  {}' = {}\n", graph.input_name(all.cyclic[k]), number(found.cyclic[k]));
        text += fmt::format("  H = {}", number(found.energy));
        text += multipliers_text(found.multipliers);
        if (found.certified && found.radius > 0) text += fmt::format("; certified to {:.1g}", found.radius);
        text +=
            fmt::format("\n  on ker dF{}, {} dimension{}: eigenvalues {}\n",
                        found.flows > 0 ? " modulo the flows of F" : "", found.dimension,
                        found.dimension == 1 ? "" : "s", found.eigenvalues.empty() ? "none" : eigenvalues_text(found));
        if (!found.definite_at.empty())
            text += fmt::format("  definite with{}\n", multipliers_text(found.definite_at).substr(1));
    }
    return text;
}

const char* second_variation_of(const RelativeEquilibrium& found)
{
    return found.definite > 0   ? "positive definite"
           : found.definite < 0 ? "negative definite"
                                : "not shown to be definite";
}

Record solution_record(const Solution& solution, const Graph& graph)
{
    const RelativeEquilibria& all = solution.equilibria;
    Record record = {{"model", solution.model.name}, {"scene", solution.scene}};
    Record& conserved = record["conserved"] = Record::array();
    for (std::size_t i = 0; i < all.conserved.size(); ++i)
        conserved.push_back({{"function", solution.conserved[i]},
                             {"value", all.conserved[i].level.middle()},
                             {"casimir", all.conserved[i].casimir}});
    Record& equilibria = record["relative_equilibria"] = Record::array();
    for (std::size_t e = 0; e < all.found.size(); ++e) {
        const RelativeEquilibrium& found = all.found[e];
        Record state = Record::object(), rates = Record::object(), exact = Record::object();
        for (std::size_t k = 0; k < all.coordinates.size(); ++k) {
            const std::string& name = graph.input_name(all.coordinates[k]);
            state[name] = found.z[k];
            if (!found.exact.empty()) exact[name] = found.exact[k].get_str();
        }
        for (std::size_t k = 0; k < found.cyclic.size(); ++k) rates[graph.input_name(all.cyclic[k])] = found.cyclic[k];
        Record each = {{"state", state},
                       {"velocities", object_of(solution.velocities[e], [](double value) { return value; })},
                       {"rates", rates}};
        add_unless_empty(each, "exact", exact);
        each.update({{"energy", found.energy},
                     {"multipliers", found.multipliers},
                     {"certified", found.certified},
                     {"radius", found.radius},
                     {"flows", found.flows},
                     {"dimension", found.dimension},
                     {"second_variation", second_variation_of(found)}});
        add_unless_empty(each, "definite_at", found.definite_at);
        Record& eigenvalues = each["eigenvalues"] = Record::array();
        for (const proof::Eigenvalue& lambda : found.eigenvalues)
            for (std::size_t k = 0; k < lambda.multiplicity; ++k)
                eigenvalues.push_back({lambda.real, lambda.imaginary});
        each["stability"] = to_text(found.stability);
        each["reason"] = reason_of(found);
        equilibria.push_back(std::move(each));
    }
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
    Solution solution{model, scene.name, relative_equilibria(graph, system, *H, start, search), {}, {}};

    SymbolicModel symbolic(model, system.written.algebroid, {});
    for (const ConservedFunction& each : solution.equilibria.conserved)
        solution.conserved.push_back(to_text(symbolic.shortest(symbolic.lower(to_tree(graph, each.value)))));
    for (const RelativeEquilibrium& found : solution.equilibria.found) {
        std::map<std::string, double> inputs;
        for (const NodeId x : system.algebroid.x) inputs[graph.input_name(x)] = 0; // cyclic ones
        for (const auto& [parameter, value] : system.parameter_values)
            inputs[graph.input_name(parameter)] = graph.value(value).get_d();
        for (std::size_t k = 0; k < found.z.size(); ++k)
            inputs[graph.input_name(solution.equilibria.coordinates[k])] = found.z[k];
        const std::vector<double> y = evaluate<double>(graph, H->y, inputs);
        NamedValues& velocities = solution.velocities.emplace_back();
        for (std::size_t a = 0; a < y.size(); ++a) velocities.emplace_back(model.fibre.coordinates[a].name, y[a]);
    }
    write_file(options.has("output") ? options.get("output") : "-",
               as_json ? to_json(solution_record(solution, graph)) + "\n" : solution_text(solution, graph));
    return ExitCode::done;
}

} // namespace lagen
