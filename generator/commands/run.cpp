// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen run`: generates, compiles (cached) and integrates a scene.
#include "commands/command.hpp"
#include "commands/compile.hpp"
#include "commands/options.hpp"
#include "commands/plot.hpp"
#include "commands/process.hpp"
#include "commands/progress.hpp"
#include "commands/scene_program.hpp"
#include "commands/start_state.hpp"
#include "commands/write_file.hpp"
#include "expression/parse.hpp"
#include "pipeline.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>

namespace lagen {

namespace {

const CommandSyntax syntax{
    "run",
    "MODEL",
    "Generates, compiles and integrates a scene. CSV on standard output unless --output or --format json.",
    {{"scene", "NAME", "the scene; without it `default`, else the first"},
     {"form", "FORM", "lagrange"},
     {"method", "METHOD", "see `lagen methods`; without it the scene's, else dop853"},
     {"step", "H", "step of a fixed-step method"},
     {"tolerance", "TOL", "relative and absolute tolerance of an adaptive method"},
     {"t-end", "T", "end of the run"},
     {"at", "T1,T2,..", "rows at exactly these times"},
     {"set", "NAME=VALUE", "a parameter's value (may be repeated)"},
     {"output,o", "FILE", "the rows as CSV"},
     {"plot", "FILE", "a picture (.svg, .png, .pdf)"},
     {"unchecked", nullptr, "go on although the model is refuted"},
     {"format,f", "FORMAT", "text or json", "text"}}};

/// A folder for the times and the report of one run.
class ExchangeFolder {
  public:
    ExchangeFolder() : path_((std::filesystem::temp_directory_path() / "lagen-run-XXXXXX").string())
    {
        if (::mkdtemp(path_.data()) == nullptr)
            throw MachineError(fmt::format("error: cannot make a folder like '{}'", path_));
    }
    ~ExchangeFolder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    ExchangeFolder(const ExchangeFolder&) = delete;
    ExchangeFolder& operator=(const ExchangeFolder&) = delete;
    [[nodiscard]] std::string file(const char* name) const { return path_ + "/" + name; }

  private:
    std::string path_;
};

constexpr long double standard_tolerance = 1e-10L;

Tree option_tree(const Model& model, const std::string& name, const std::string& text)
{
    return model.scope.close(parse_expression(whole_text("<--" + name + ">", text)));
}

/// The scene as the command line changes it.
Scene scene_of(const Options& options, const Model& model)
{
    Scene scene = find_scene(model, options.get("scene"));
    if (options.has("method")) scene.method = options.get("method");
    const auto replace = [&](const char* name, Tree& tree) {
        if (options.has(name)) tree = option_tree(model, name, options.get(name));
    };
    replace("step", scene.step);
    if (options.has("tolerance")) scene.relative = scene.absolute = nullptr;
    replace("tolerance", scene.tolerance);
    if (options.has("t-end")) {
        const Tree end = option_tree(model, "t-end", options.get("t-end"));
        scene.duration = scene.start ? add({end, negate(scene.start)}) : end;
    }
    if (options.has("at")) {
        scene.sampling = {Sampling::Kind::at, nullptr, 0, {}};
        for (const std::string& time : split_list(options.get("at")))
            scene.sampling.at.push_back(option_tree(model, "at", time));
    }
    for (const Setting& setting : options.settings()) // the command line wins over the scene
        std::erase_if(scene.parameters, [&](const NamedTree& parameter) { return parameter.name == setting.name; });
    if (!scene.form.empty() && scene.form != "lagrange")
        throw ModelError(
            fmt::format("scene '{}' asks for the form '{}', this version of lagen runs the form 'lagrange'", scene.name,
                        scene.form),
            scene.where);
    return scene;
}

const MethodEntry& method_of(const Options& options, const Scene& scene)
{
    const std::string name = scene.method.empty() ? "dop853" : scene.method;
    const MethodEntry* method = find_method(name);
    if (method == nullptr) {
        const std::string nearest = nearest_name(name, method_names());
        const std::string hint =
            nearest.empty() ? "`lagen methods` lists them" : fmt::format("did you mean '{}'?", nearest);
        if (options.has("method"))
            throw UsageError(fmt::format("lagen run: unknown method '{}'\nhint: {}", name, hint));
        throw ModelError(fmt::format("unknown method '{}'", name), scene.method_where, hint);
    }
    if (method->adaptive || scene.step) return *method;
    const std::string text =
        fmt::format("method '{}' needs a step: give --step, or `step` in scene '{}'", name, scene.name);
    if (options.has("method")) throw UsageError("lagen run: " + text);
    throw ModelError(text, scene.where);
}

std::vector<long double> numbers(const std::vector<NamedNumber>& named)
{
    std::vector<long double> values;
    values.reserve(named.size());
    for (const auto& [name, value] : named) values.push_back(value);
    return values;
}

ProgramInput input_of(const KernelModule& module, const Scene& scene, const SceneValues& values,
                      const ExchangeFolder& folder)
{
    if (!values.duration)
        throw ModelError(fmt::format("scene '{}' has no duration", scene.name), scene.where,
                         "give `duration`, or --t-end");
    ProgramInput input;
    input.parameters = numbers(values.parameters);
    input.initial = start_state(module, values);
    input.start = values.start;
    input.end = values.start + *values.duration;
    input.step = values.step;
    input.relative = values.relative.value_or(standard_tolerance);
    input.absolute = values.absolute.value_or(standard_tolerance);
    input.sampling = scene.sampling.kind;
    input.interval = values.interval;
    input.samples = scene.sampling.count;
    input.at_file = folder.file("times");
    input.events = &scene.events;
    input.columns = columns_of(module, scene);
    input.report_file = folder.file("report");
    if (scene.sampling.kind == Sampling::Kind::at) {
        std::string times;
        for (const long double time : values.at) times += fmt::format("{:.21g}\n", time);
        write_file(input.at_file, times);
    }
    return input;
}

/// Runs the program; the rows and the report go into `outcome`.
void integrate_scene(const std::string& program, const ProgramInput& input, RunOutcome& outcome)
{
    Progress progress(static_cast<double>(input.start), static_cast<double>(input.end));
    const ProcessResult result =
        run_process(program_arguments(program, input), [&](const char* bytes, std::size_t count) {
            outcome.table.rows.append(bytes, count);
            progress.show(outcome.table.rows);
        });
    progress.clear();
    if (!result.started)
        throw MachineError(fmt::format("error: the compiled scene could not be started: {}", result.error));
    if (result.interrupted || result.exit_code == static_cast<int>(ExitCode::interrupted))
        throw Error(ExitCode::interrupted, "lagen: interrupted, nothing was written");
    if (result.exit_code != 0 && result.exit_code != 1)
        throw MachineError(
            fmt::format("error: the compiled scene ended with exit code {}\n{}", result.exit_code, result.error));
    read_report(content_of_file(input.report_file), outcome);
    outcome.table.count = outcome.table.lines().size();
}

std::vector<Panel> panels_of(const std::vector<Column>& columns, std::size_t base_lanes)
{
    std::vector<Panel> panels{{"base coordinates", {}}, {"fibre coordinates", {}}, {"observables", {}}};
    for (std::size_t k = 0; k < columns.size(); ++k)
        panels[!columns[k].state ? 2 : columns[k].index < base_lanes ? 0 : 1].columns.push_back(k + 1);
    std::erase_if(panels, [](const Panel& panel) { return panel.columns.empty(); });
    return panels;
}

void tell(const Options& options, const RunOutcome& outcome, bool as_json)
{
    if (as_json) {
        write_standard_output(report_json(outcome));
    } else {
        if (!options.has("output")) write_standard_output(to_csv(outcome.table));
        fmt::print(stderr, "{}", report_text(outcome));
    }
}

} // namespace

ExitCode run_run(Arguments arguments)
{
    const Options options(syntax, arguments);
    if (options.help()) return ExitCode::done;
    const bool as_json = options.choice("format", {"text", "json"}) == "json";
    if (options.has("form")) (void)options.choice("form", {"lagrange"});
    if (options.has("plot")) require_plot_format(options.get("plot"));

    const CheckedModel checked = load(options.positional()[0], options.settings(), options.has("unchecked"));
    for (const std::string& warning : checked.warnings) fmt::print(stderr, "warning: {}\n", warning);
    const Model& model = checked.model;
    const Scene scene = scene_of(options, model);
    const MethodEntry& method = method_of(options, scene);
    const SceneValues values = evaluate_scene(model, scene);
    GenerateRequest request;
    request.scene = &scene;
    const Generated generated = generate(checked, request);
    const ExchangeFolder folder;
    const ProgramInput input = input_of(generated.module, scene, values, folder);
    const Compiled compiled = compile_program(generated.header, program_text(generated.module.name, method));

    RunOutcome outcome;
    outcome.model = model.name;
    outcome.scene = scene.name;
    outcome.form = generated.module.form;
    outcome.method = method.name;
    outcome.table.columns = {"t"};
    for (const Column& column : input.columns) outcome.table.columns.push_back(column.name);
    integrate_scene(compiled.program, input, outcome);
    if (options.has("output")) write_file(options.get("output"), to_csv(outcome.table));
    if (options.has("plot"))
        plot_table(outcome.table, panels_of(input.columns, model.base.coordinates.size()),
                   model.title.empty() ? model.name : model.title, options.get("plot"));
    tell(options, outcome, as_json);
    return outcome.status == "ok" || outcome.status == "stopped_by_event" ? ExitCode::done : ExitCode::refuted;
}

} // namespace lagen
