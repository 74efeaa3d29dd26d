// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen chart`: what accuracy costs by every method, on one scene of a model.
#include "commands/chart/chart.hpp"

#include "commands/chart/accuracy.hpp"
#include "commands/chart/report.hpp"
#include "commands/chart/stability_chart.hpp"
#include "commands/line/command.hpp"
#include "commands/line/options.hpp"
#include "commands/line/scene_options.hpp"
#include "machine/places.hpp"
#include "machine/process.hpp"
#include "machine/write_file.hpp"
#include "model/scene_form.hpp"

#include <fmt/core.h>

#include <filesystem>

namespace lagen {

namespace {

const std::string chart_form_help = form_list() + "; without it the scene's, else the model's";

const CommandSyntax chart_syntax{
    "chart",
    "MODEL",
    "Runs a scene by every method that applies, over tolerances and steps, and charts time and calls against the error "
    "of the state. Writes chart.svg, chart.png, chart.csv and chart.json, and drift.svg and drift.png where something "
    "is conserved.",
    {option::scene,
     {"form", "FORM", chart_form_help.c_str()},
     {"methods", "A,B,..", "these alone, see `lagen methods`; without it all that apply"},
     {"stability", nullptr, "chart instead what becomes of the scene with each step: stability.svg, .png, .csv, .json"},
     {"over", "RANGES", "of --stability: step=FIRST:LAST:COUNT[,NAME=FIRST:LAST:COUNT], NAME a parameter or initial.x"},
     {"peers", nullptr, "odeint, GSL and SUNDIALS too, where they are installed, with the same right-hand side"},
     option::t_end,
     option::set,
     option::initial,
     {"output,o", "DIR", "the folder of the files, made where it is missing", "."},
     option::unchecked,
     option::format}};

std::vector<const MethodEntry*> wanted_methods(const Options& options)
{
    std::vector<const MethodEntry*> wanted;
    for (const std::string& name : split_list(options.get("methods"))) {
        wanted.push_back(find_method(name));
        if (wanted.back() != nullptr) continue;
        throw UsageError(fmt::format("unknown method '{}'", name), hint_for_method(name));
    }
    if (options.has("methods") && wanted.empty())
        throw UsageError("--methods needs at least one method, e.g. --methods dop853,taylor");
    return wanted;
}

void require_together(const Options& options)
{
    if (options.has("over") && !options.has("stability")) throw UsageError("--over needs --stability");
    if (options.has("peers") && options.has("stability"))
        throw UsageError("--peers and --stability exclude each other");
}

void make_folder(const std::string& folder)
{
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw MachineError(fmt::format("cannot make the folder '{}': {}", folder, error.message()));
}

/// `chart --stability`.
ExitCode chart_stability(const Options& options, ChartRequest request, bool as_json)
{
    CheckedModel checked = read(model_path(options.positional()[0]), options.settings(), options.has("unchecked"));
    request.scene = scene_of(options, checked.model, options.named("initial"));
    require_no_jumps(request.scene, "stability charts are made");
    std::vector<StabilityAxis> axes = stability_axes(options.get("over"), checked.model, request.scene);
    prove(checked);
    warn(checked.warnings);
    const std::string folder = options.get("output");
    make_folder(folder);
    const StabilityChart chart = make_stability_chart(checked, request, std::move(axes));
    write_file(folder + "/stability.json", stability_json(chart));
    write_file(folder + "/stability.csv", stability_csv(chart));
    if (!find_program("gnuplot").empty())
        for (const char* extension : {".svg", ".png"}) draw_stability(chart, folder + "/stability" + extension);
    write_standard_output(as_json ? stability_json(chart) : stability_text(chart));
    return ExitCode::done;
}

} // namespace

ExitCode run_chart(Arguments arguments)
{
    const Options options(chart_syntax, arguments);
    if (options.help()) return ExitCode::done;
    const bool as_json = options.as_json();
    if (options.has("form")) (void)options.choice("form", form_names());
    ChartRequest request;
    request.methods = wanted_methods(options);
    request.peers = options.has("peers");
    require_together(options);
    const bool draws = !find_program("gnuplot").empty();
    if (!draws)
        warn(fmt::format("gnuplot was not found: {0}.svg and {0}.png are not drawn",
                         options.has("stability") ? "stability" : "chart"));
    if (options.has("stability")) return chart_stability(options, std::move(request), as_json);
    const std::string folder = options.get("output");
    CheckedModel checked = charted_model(options, model_path(options.positional()[0]));
    warn(checked.warnings);
    request.scene = scene_of(options, checked.model, options.named("initial"));
    require_curve(request.scene, "charts are made");
    require_no_jumps(request.scene, "charts are made");
    make_folder(folder);
    const Chart chart = make_chart(checked, request);
    if (!chart.shortened.empty()) warn(fmt::format("the chart ends at t = {:.9g}: {}", chart.end, chart.shortened));
    if (request.methods.empty() && !request.peers) keep_chart(chart_file(options, checked.model), kept_chart(chart));
    write_file(folder + "/chart.json", chart_json(chart));
    write_file(folder + "/chart.csv", chart_csv(chart));
    if (draws)
        for (const char* extension : {".svg", ".png"}) {
            draw_chart(chart, folder + "/chart" + extension);
            (void)draw_drifts(chart, folder + "/drift" + extension);
        }
    write_standard_output(as_json ? chart_json(chart) : chart_text(chart));
    return ExitCode::done;
}

} // namespace lagen
