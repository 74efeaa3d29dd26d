// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen run`: generates, compiles (cached) and integrates a scene.
#include "commands/report/run.hpp"
#include "commands/chart/accuracy.hpp"
#include "commands/line/command.hpp"
#include "commands/line/options.hpp"
#include "commands/line/scene_options.hpp"
#include "commands/plot/draw_scene.hpp"
#include "elaborate/bind_parameters.hpp"
#include "elaborate/elaborate.hpp"
#include "elaborate/variational_model.hpp"
#include "machine/places.hpp"
#include "machine/temporary_folder.hpp"
#include "machine/write_file.hpp"
#include "model/plain_names.hpp"
#include "model/read_values.hpp"
#include "model/scene_form.hpp"
#include "reduction/least_scene.hpp"
#include "scene/integrate_scene.hpp"
#include "scene/scene_run.hpp"
#include "scene/variation_states.hpp"

#include <fmt/core.h>

#include <unistd.h>

namespace lagen {

namespace {

const std::string run_form_help = form_list() + "; without it the scene's, else the model's";

const CommandSyntax run_syntax{
    "run",
    "MODEL",
    "Generates, compiles and integrates a scene. CSV on standard output unless --output or --format json, or --plot on "
    "a terminal. Of a morphism file: a scene of the source, the motion of the target from the image of its start, and "
    "how far they are apart.",
    {{"scene", "NAME",
      "the scene; without it `default`, else the first; of several --plot draws all in the panels of the last"},
     {"form", "FORM", run_form_help.c_str()},
     option::method,
     option::step,
     option::time_scale,
     option::tolerance,
     {"accuracy", "E",
      "largest error of the rows, relative to the state: method and tolerance from a chart of the scene"},
     option::t_end,
     {"at", "T1,T2,..",
      "rows at exactly these times; without --t-end the run ends with the scene's duration or the last of them, "
      "whichever is later"},
     option::set,
     option::bind,
     option::initial,
     {"branch", "N",
      "of a discrete motion that starts from momenta: its first arrow is the N-th that has them, by the distance from "
      "that of short steps; without it that one"},
     {"variations", "N",
      "the action along the run, with its first and second variations by N random admissible variations with fixed "
      "ends"},
     {"seed", "S", "of these variations; without it 0"},
     {"jacobi-field", "NAME=VALUE",
      "a Jacobi field along the motion, sigma = 0 and these delta y at the start, as columns (may be repeated)"},
     {"output,o", "FILE", "the rows as CSV; FILE.json: the report with the rows as JSON"},
     {"plot", "FILE", "a picture (.svg, .png, .pdf): the scene's curves, else its columns over time"},
     {"curves", "X:Y,..", "what --plot draws: t:x, x:y, x:y:z; curves in brackets share a panel (may be repeated)"},
     {"equal", nullptr, "curves have one scale on all axes"},
     {"points", nullptr, "curves are the points at the rows, with nothing between them"},
     {"sphere", nullptr, "curves in space lie on a sphere around the origin"},
     {"like", "NAME", "--plot draws what [scene.NAME.plot] says"},
     {"second-run", nullptr,
      "say what the state is worth, by a second run at a tenth of the tolerance or with half the step, however long "
      "the "
      "first one took; without it where that took at most 5 s"},
     {"no-second-run", nullptr, "say nothing of it"},
     {"reconstruct", nullptr,
      "of a morphism that is bijective on the fibres: lift the motion of the target to the source too"},
     option::least,
     option::full,
     option::unchecked,
     option::format}};

/// The variational method that is asked for; null where it is another one.
const MethodEntry* variational_method(const Options& options, const Model& model)
{
    const std::string asked = options.get("method");
    if (asked.empty() && model.scenes.empty()) return nullptr;
    const MethodEntry* method = find_method(asked.empty() ? find_scene(model, options.get("scene")).method : asked);
    return method != nullptr && *method->scheme != '\0' ? method : nullptr;
}

/// --variations N, --seed S, --jacobi-field NAME=VALUE.
VariationRequest variations_of(const Options& options, const Model& model)
{
    constexpr std::uint64_t most_variations = 100;
    VariationRequest request;
    if (options.has("variations")) request.count = whole_option(options, "variations", 1, most_variations);
    if (options.has("seed") && request.count == 0) throw UsageError("--seed needs --variations");
    if (options.has("seed")) request.seed = whole_option(options, "seed", 0);
    for (const Setting& start : options.named("jacobi-field"))
        request.field.push_back({start.name, option_tree(model, "jacobi-field", start.value),
                                 start.value.range(0, start.value.text.size())});
    return request;
}

/// The number of the first arrow that is asked for, which only a discrete motion from momenta has.
std::uint64_t branch_of(const Options& options, const Scene& scene, const SceneValues& values)
{
    const std::uint64_t branch = whole_option(options, "branch", 1);
    if (!values.discrete)
        throw UsageError(
            fmt::format("--branch counts the first arrows of a discrete motion, and scene '{}' is run in the form '{}'",
                        scene.name, scene.form),
            "--form discrete, or a variational method: --method variational4");
    if (starts_from_arrow(values))
        throw UsageError(
            fmt::format(
                "--branch counts the arrows that have the momenta of the start, and scene '{}' starts from an arrow",
                scene.name),
            "give the momenta in 'initial', or in 'element' and 'next' the arrow of that branch");
    return branch;
}

/// `picture`: what was drawn, or "". Where there is one a terminal is spared the rows.
void tell(const Options& options, const RunOutcome& outcome, const std::vector<std::string>& known,
          const std::string& picture, bool as_json)
{
    if (as_json) {
        write_standard_output(report_json(outcome) + "\n");
    } else {
        const bool spared = !picture.empty() && !options.has("output") && ::isatty(STDOUT_FILENO) == 1;
        if (!options.has("output") && !spared) write_standard_output(to_csv(outcome.table, known));
        write_standard_error(report_text(outcome));
        if (!picture.empty())
            write_standard_error(fmt::format("  picture in {}: {}{}\n", options.get("plot"), picture,
                                             spared ? "; the rows as CSV: -o FILE.csv, or into a pipe" : ""));
    }
    write_standard_error(start_note(outcome) + run_warnings(outcome));
}

/// Puts the least model in the place of the whole one where --least asks for it, and says what that left out; nothing
/// where the whole one runs.
std::optional<LeastNote> put_least(const Options& options, CheckedModel& checked, Scene& scene)
{
    if (options.has("least") && options.has("full")) throw UsageError("--least and --full exclude one another");
    if (!options.has("least")) return {};
    for (const char* other : {"variations", "jacobi-field", "reconstruct", "branch", "plot"})
        if (options.has(other)) throw UsageError(fmt::format("--least leaves out what --{} is about", other), "--full");
    require_least(checked.model, scene);
    if (scene.input_table) {
        write_standard_error("  the whole model runs: a table gives its inputs\n");
        return {};
    }
    prove(checked);
    const LeastScene least = least_scene(checked, scene, true);
    if (least.least == least.full || !least.unwritten.empty()) {
        write_standard_error(fmt::format("  the whole model runs: {}\n",
                                         least.unwritten.empty() ? "nothing can be left out" : least.unwritten));
        return {};
    }
    write_standard_error(
        fmt::format("  the least model runs: {} of {} states; `lagen explain` says why\n", least.least, least.full));
    LeastRun run = least_run(least);
    checked = std::move(run.model);
    scene = std::move(run.scene);
    return LeastNote{least.least, least.full, least.relations, least.not_followed};
}

} // namespace

ExitCode run_run(Arguments arguments)
{
    const Options options(run_syntax, arguments);
    if (options.help()) return ExitCode::done;
    const bool as_json = options.as_json();
    if (options.has("form")) (void)options.choice("form", form_names());
    if (options.has("plot")) require_plot_format(options.get("plot"));
    if (options.has("output")) require_no_picture(options.get("output"));
    for (const char* word : {"curves", "equal", "points", "sphere", "like"})
        if (options.has(word) && !options.has("plot"))
            throw UsageError(fmt::format("--{} says what --plot draws: give --plot FILE.svg as well", word));
    const SecondRun second = second_run_of(options);
    for (const char* file : {"output", "plot"})
        if (options.has(file)) require_writable(options.get(file));

    const std::string path = model_path(options.positional()[0]);
    const auto file = std::make_shared<const SourceFile>(SourceFile{path, read_file(path)});
    if (is_morphism(file)) return run_morphism(options, file);
    if (options.has("reconstruct"))
        throw UsageError("--reconstruct is of a morphism, and " + quote(path) + " is a model");
    CheckedModel checked = read(path, options.settings(), options.has("unchecked"));
    if (const MethodEntry* method = variational_method(options, checked.model))
        checked.model = variational_model(std::move(checked.model), method->scheme, method->name);
    const Model& model = checked.model;
    require_apart(options, model);
    // What a chart chooses is chosen for the equations that it ran: those of the values.
    if (options.has("accuracy")) {
        require_curve(scene_of(options, model, {}), "charts of an accuracy are made");
        require_no_jumps(scene_of(options, model, {}), "charts of an accuracy are made");
        bind_all_in_scene(checked.model, find_scene(model, options.get("scene")));
    } else if (options.has("bind"))
        bind_in_scene(checked.model, find_scene(model, options.get("scene")));
    const std::optional<AccurateMethod> accurate = accurate_method(options, checked, path);
    Scene scene = scene_of(options, model, options.named("initial"));
    const std::vector<std::string> beside = scenes_beside(options, model, scene);
    const bool stretch = options.has("at") && !options.has("t-end");
    const VariationRequest variations = variations_of(options, model);
    if (variations.any()) require_no_jumps(scene, "variations are taken");
    if (variations.any())
        add_variation_states(checked.model, elaborate(model), scene, variations,
                             sample_times(scene, evaluate_scene(model, scene), 1, stretch));
    const MethodEntry& method = accurate ? *accurate->method : method_of(scene);
    std::optional<std::uint64_t> branch;
    if (options.has("branch")) branch = branch_of(options, scene, evaluate_scene(model, scene));
    const std::string name = model.name;
    const std::optional<LeastNote> least = put_least(options, checked, scene);
    SceneRun run(checked, std::move(scene), method, stretch);
    run.input().branch = branch;

    bool whole = !accurate || confirm_accuracy(*accurate, run.record(), run.input());

    const std::vector<std::string> known = all_names(model);
    const InterruptsHeld held; // between programs, which they reach: rows are written first
    RunOutcome outcome = run.integrate(second);
    if (is_interrupted(outcome))
        return leave_rows(options, outcome.table, known, report_json(outcome) + "\n", outcome.t);
    outcome.model = name;
    outcome.least = least;
    outcome.action = action_report(outcome, variations);
    if (const std::string output = options.get("output"); !output.empty())
        write_file(output, output.ends_with(".json") ? report_json(outcome) + "\n" : to_csv(outcome.table, known));
    std::string picture;
    const bool drawn = is_uninterrupted([&] {
        if (options.has("plot")) picture = draw_scene(options, run, outcome, beside, whole);
    });
    tell(options, outcome, known, picture, as_json);
    if (!drawn) throw InterruptedError("lagen: interrupted while drawing");
    return succeeded(outcome.status) && whole ? ExitCode::done : ExitCode::refuted;
}

} // namespace lagen
