// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen linearize`: an equilibrium near the start of a scene, the equations linearised there, and a gain.
#include "commands/line/command.hpp"
#include "commands/linearize/cost.hpp"
#include "commands/linearize/plant.hpp"
#include "commands/linearize/report.hpp"
#include "commands/machine/places.hpp"
#include "commands/machine/write_file.hpp"
#include "commands/scene/scene_options.hpp"

#include <fmt/format.h>

namespace lagen {

namespace {

using linear::Matrix;

const CommandSyntax linearize_syntax{
    "linearize",
    "MODEL",
    "Finds an equilibrium near the start of a scene, and linearises the equations of motion there: A and B, "
    "eigenvalues and modes, controllability, and the gain u = u0 - K x of least quadratic cost.",
    {option::scene,
     {"form", "FORM", "lagrange or hamilton; without it that of the scene"},
     option::set,
     option::initial,
     {"lqr", "'Q=..;R=..'", "the gain that makes the integral of x'Qx + u'Ru least: numbers, diagonals or matrices"},
     option::output,
     option::unchecked,
     option::format}};

Matrix matrix_of(const std::vector<std::vector<double>>& rows, std::size_t columns)
{
    Matrix out(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(columns));
    for (std::size_t i = 0; i < rows.size(); ++i)
        for (std::size_t j = 0; j < columns; ++j)
            out(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = rows[i][j];
    return out;
}

std::vector<linear::MultipleEigenvalue> eigenvalues_of(const Equilibrium& found)
{
    std::vector<linear::MultipleEigenvalue> out;
    std::size_t count = 0;
    for (const proof::Eigenvalue& each : found.eigenvalues) {
        out.push_back({{each.real, each.imaginary}, each.multiplicity, each.spread});
        count += each.multiplicity;
    }
    if (count != found.at.state.size()) throw InternalError("eigenvalues that are not as many as the states");
    return out;
}

linear::Regulator regulator_of(const LinearReport& report, const QuadraticCost& cost)
{
    const auto found = linear::regulator(report.system, report.modes, cost.Q, cost.R);
    if (const auto* const regulator = std::get_if<linear::Regulator>(&found)) return *regulator;
    using Reason = linear::NoRegulator::Reason;
    const auto& [reason, lambda] = std::get<linear::NoRegulator>(found);
    switch (reason) {
    case Reason::not_reached:
        throw MathematicsError(
            fmt::format("no gain stabilises this equilibrium: the inputs do not reach its mode of eigenvalue {}, which "
                        "does not decay",
                        eigenvalue_text(lambda)),
            "`lagen linearize` without --lqr shows the mode");
    case Reason::not_seen:
        throw MathematicsError(
            fmt::format("no gain of least cost stabilises this equilibrium: Q does not see its mode of eigenvalue {}, "
                        "which neither grows nor decays",
                        eigenvalue_text(lambda)),
            "weigh a coordinate that the mode moves");
    case Reason::not_found: break;
    }
    throw MathematicsError("no gain was found: floating point does not tell the stable half of the Hamiltonian matrix",
                           "choose Q and R nearer to each other");
}

} // namespace

ExitCode run_linearize(Arguments arguments)
{
    const Options options(linearize_syntax, arguments);
    if (options.help()) return ExitCode::done;
    const bool as_json = options.as_json();
    if (options.has("output")) require_writable(options.get("output"));
    CheckedModel checked = load(model_path(options.positional()[0]), options.settings(), options.has("unchecked"));
    require_apart(options, checked.model);
    const Scene scene = scene_of(options, checked.model, options.named("initial"));
    warn(warnings_of(checked, scene.form));
    Plant plant = plant_of(checked, scene);
    std::vector<std::string> states, inputs;
    for (const NodeId s : plant.equations.state) states.push_back(plant.graph.input_name(s));
    for (const NodeId u : plant.equations.inputs) inputs.push_back(plant.graph.input_name(u));
    if (options.has("lqr") && inputs.empty())
        throw MathematicsError(fmt::format("--lqr asks for a gain, and model '{}' has no inputs", checked.model.name),
                               "[inputs] u = 0, and u in [forces]");
    std::optional<QuadraticCost> cost;
    if (options.has("lqr")) {
        Values parameters;
        for (const auto& [name, value] : plant.parameters) parameters[name] = value;
        cost = read_cost(options, checked.model, parameters, states.size(), inputs.size());
    }
    Equilibrium found = equilibrium_near(plant.graph, plant.equations, plant.starts);
    const std::size_t n = states.size(), m = inputs.size();
    linear::LinearSystem system =
        linear::linear_system(matrix_of(found.A, n), matrix_of(found.B, m), matrix_of(found.leaf, n));
    const std::vector<linear::MultipleEigenvalue> eigenvalues = eigenvalues_of(found);
    LinearReport report{checked.model.name,
                        scene.name,
                        scene.form,
                        std::move(states),
                        std::move(inputs),
                        std::move(plant.following),
                        plant.starts.front(),
                        std::move(found),
                        std::move(system),
                        {},
                        {}};
    report.modes = linear::modes_of(report.system, eigenvalues);
    if (cost) report.regulator = regulator_of(report, *cost);
    write_file(options.has("output") ? options.get("output") : "-",
               as_json ? linear_json(report) : linear_text(report));
    return ExitCode::done;
}

} // namespace lagen
