// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen solve`: relative equilibria with what is proved of their stability.
#include "commands/line/command.hpp"
#include "commands/line/scene_options.hpp"
#include "machine/write_file.hpp"
#include "scene/scene_equilibria.hpp"
#include "text/comma_list.hpp"
#include "text/record.hpp"

#include <fmt/format.h>

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

/// A pair once, by the one above the real axis.
std::string eigenvalue_text(const Record& lambda)
{
    const auto real = lambda[0].get<double>(), imaginary = lambda[1].get<double>();
    return imaginary < 0 ? "" : complex_text(real, imaginary);
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

/// The number `e`.
Record record_of(const SceneEquilibria& solved, std::size_t e, const std::vector<Symbol>& fibre)
{
    const RelativeEquilibrium& found = solved.all.found[e];
    Record state = Record::object(), rates = Record::object(), exact = Record::object(), velocities = Record::object();
    for (std::size_t k = 0; k < found.z.size(); ++k) {
        state[solved.coordinates[k]] = found.z[k];
        if (!found.exact.empty()) exact[solved.coordinates[k]] = found.exact[k].get_str();
    }
    for (std::size_t k = 0; k < found.cyclic.size(); ++k) rates[solved.cyclic[k]] = found.cyclic[k];
    for (std::size_t a = 0; a < fibre.size(); ++a) velocities[fibre[a].name] = solved.velocities[e][a];
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
    CheckedModel checked = loaded(options);
    const Model& model = checked.model;
    warn(checked.warnings);
    if (checked.system.distribution || checked.system.control)
        throw MathematicsError(fmt::format("relative equilibria are those of Hamilton's equations of an L or H, and "
                                           "model '{}' is something else",
                                           model.name));
    Scene scene = find_scene(model, options.get("scene"));
    for (const Setting& setting : options.named("initial")) set_initial(model, scene, setting);
    const SceneEquilibria solved = scene_equilibria(checked, scene, static_cast<std::size_t>(starts));
    Record conserved = Record::array(), all = Record::array();
    for (std::size_t i = 0; i < solved.functions.size(); ++i)
        conserved.push_back({{"function", solved.functions[i]},
                             {"value", solved.all.conserved[i].level.middle()},
                             {"casimir", solved.all.conserved[i].casimir}});
    for (std::size_t e = 0; e < solved.velocities.size(); ++e)
        all.push_back(record_of(solved, e, model.fibre.coordinates));
    const Record solution = {
        {"model", model.name}, {"scene", scene.name}, {"conserved", conserved}, {"relative_equilibria", all}};
    write_file(options.output(), as_json ? to_json(solution) + "\n" : solution_text(solution));
    return ExitCode::done;
}

} // namespace lagen
