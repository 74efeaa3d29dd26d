// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen sweep`: one scene from many starts and with many parameters, a row for each.
#include "commands/line/command.hpp"
#include "commands/line/scene_options.hpp"
#include "commands/report/run.hpp"
#include "commands/sweep/sweep_run.hpp"
#include "elaborate/bind_parameters.hpp"
#include "machine/compile.hpp"
#include "machine/places.hpp"
#include "machine/write_file.hpp"
#include "model/scene_form.hpp"
#include "scene/preparation.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

namespace {

const std::string sweep_form_help = form_list() + "; without it the scene's, else the model's";

const CommandSyntax sweep_syntax{
    "sweep",
    "MODEL...",
    "Integrates a scene for many values of parameters and initial values: a row of CSV a trajectory, with the scene's "
    "columns at its end.\nRanges FIRST:LAST:COUNT make a grid, ends included, the last of them fastest; with --random "
    "they are FIRST:LAST.\nWith --merge the arguments are the parts of a sweep, which are put together.",
    {{"output,o", "FILE", "the table; FILE.partial until it is complete"},
     {"set", "NAME=RANGE", "a parameter's range, or one value for all rows (may be repeated)"},
     {"initial", "NAME=RANGE", "the same of an initial value (may be repeated)"},
     option::bind,
     {"random", "N", "N rows, drawn uniformly from the ranges"},
     {"seed", "S", "of the draws; row k follows from S and k alone", "0"},
     {"ensemble", "FILE", "a row for each row of a CSV file, whose heading names parameters and initial values"},
     {"threads", "N", "without it as many as there are cores for this process"},
     {"resume", nullptr, "go on where an interrupted call of the same command ended"},
     {"shard", "K/N", "rows K, K + N, .. alone; without it rank and size that mpirun, srun or a Slurm array set"},
     {"merge", nullptr, "put the parts of a sweep together"},
     option::scene,
     {"form", "FORM", sweep_form_help.c_str()},
     option::method,
     option::step,
     option::time_scale,
     option::tolerance,
     option::t_end,
     option::unchecked}};

/// The command line without the options that the rows do not depend on, in one line.
std::string command_of(const Options& options)
{
    std::string text = "lagen sweep " + options.positional()[0];
    for (const auto& [name, value] : options.given())
        if (name != "output" && name != "resume" && name != "threads" && name != "shard")
            text += fmt::format(" --{}{}{}", name, value.empty() ? "" : " ", value);
    for (char& c : text)
        if (static_cast<unsigned char>(c) < ' ') c = ' ';
    return text;
}

/// Which sweep a file belongs to: the same key and build on all machines.
SweepIdentity identity_of(const Options& options, const Model& model, const SweepRows& rows, const Shard& shard,
                          const std::string& heading)
{
    ContentHash hash;
    add_model(hash, model);
    hash.add(LAGEN_VERSION).add(rows.text).add(heading);
    for (const char* name : {"scene", "form", "method", "step", "time-scale", "tolerance", "t-end", "unchecked"})
        hash.add(options.has(name) ? name : "").add(options.get(name));
    for (const auto& [name, value] : options.given())
        if (name == "set" || name == "initial" || name == "bind") hash.add(name).add(value);
    return {hash.hex32(), build_text(), command_of(options), rows.count, shard, false};
}

std::size_t threads_of(const Options& options)
{
    constexpr std::uint64_t most_threads = 4096;
    if (!options.has("threads")) return launched_threads();
    const std::optional<std::uint64_t> count = read_whole(options.get("threads"));
    if (count && *count >= 1 && *count <= most_threads) return static_cast<std::size_t>(*count);
    throw UsageError(fmt::format("--threads is '{}', where a whole number from 1 to {} is required",
                                 options.get("threads"), most_threads));
}

/// The lines on standard error that say how many rows there are, and how those failed that did.
std::string summary(const std::string& path, const SweepFile& file, const std::map<std::string, std::string>& reasons)
{
    std::string kinds, why;
    std::uint64_t failed = 0;
    for (const auto& [status, count] : file.statuses()) {
        if (succeeded(status)) continue;
        failed += count;
        kinds += fmt::format("{}{} {}", kinds.empty() ? "" : ", ", count, status);
        if (const auto reason = reasons.find(status); reason != reasons.end())
            why += fmt::format("  {}: {}\n", status, reason->second);
    }
    return fmt::format("{}: {}{}\n{}", path, count_text(file.rows(), "row"),
                       failed == 0 ? "" : fmt::format(", {} failed: {}", failed, kinds), why);
}

/// A warning where lanes of rows that were computed now stayed below the absolute tolerance; else "".
std::string small_lanes_warning(const SweepRun& run, bool resumed)
{
    const std::uint64_t count = run.rows_below_absolute();
    if (count == 0) return "";
    return below_absolute_warning(fmt::format("in {}{} {}", resumed ? "at least " : "", count_text(count, "row"),
                                              fmt::join(run.lanes_below_absolute(), ", ")),
                                  "");
}

void merge_parts(const Options& options)
{
    for (const auto& [name, value] : options.given())
        if (name != "merge" && name != "output")
            throw UsageError(fmt::format("--merge takes the parts and --output alone, found --{}", name));
    merge_sweep(options.positional(), options.get("output"));
}

/// The scene with an initial value for each that is swept.
Scene with_swept(const Model& model, Scene scene, const SweepRows& rows)
{
    for (const SweptName& name : rows.names)
        if (name.option == "initial") set_initial(model, scene, {name.name, whole_text("<--initial>", "0")});
    if (!scene.duration)
        throw ModelError(fmt::format("scene '{}' has no duration", scene.name), scene.where,
                         "give `duration`, or --t-end");
    return scene;
}

/// Where momenta and fibre coordinates are converted into each other, what is decided of that must hold in every row.
void prepare_start(StartState& start, const Model& model, const Scene& scene, const RunRecord& record,
                   const SweepRows& rows)
{
    (void)start.prepare(starts_from_momenta(model, scene), !model.fibre.coordinates.empty());
    if (!start.rests_on_decision()) return;
    const bool sets = std::ranges::any_of(rows.names, [](const SweptName& name) { return name.option == "set"; });
    if (!sets || record.decided_for.empty()) return;
    throw MathematicsError("the start converts between momenta and fibre coordinates, which is decided for the "
                           "parameters of the scene alone",
                           "give `initial` the lanes of the form, or keep the parameters as they are");
}

/// The part of the command line, else of the launcher; `path` becomes the file of a rank.
Shard shard_of(const Options& options, std::string& path)
{
    if (options.has("shard")) return read_shard(options.get("shard"));
    const Shard shard = launched_shard();
    if (shard.count == 1) return shard;
    path = rank_file(path, shard);
    write_standard_error(
        fmt::format("lagen sweep: part {} of this launcher's processes writes '{}'\n", shard.text(), path));
    return shard;
}

} // namespace

ExitCode run_sweep(Arguments arguments)
{
    const Options options(sweep_syntax, arguments);
    if (options.help()) return ExitCode::done;
    const std::string output = options.get("output");
    if (output.empty() || output == "-") throw UsageError("--output FILE is missing");
    if (options.has("merge")) return merge_parts(options), ExitCode::done;
    if (options.positional().size() > 1)
        throw UsageError(fmt::format("unexpected argument '{}' (see lagen sweep --help)", options.positional()[1]));
    if (options.has("form")) (void)options.choice("form", form_names());
    const SweepRequest request(options);
    const std::size_t threads = threads_of(options);
    std::string path = output;
    const Shard shard = shard_of(options, path);
    require_writable(path);

    CheckedModel checked = read(model_path(options.positional()[0]), request.settings, options.has("unchecked"));
    const Model& model = checked.model;
    require_apart(options, model, {"ensemble"});
    if (options.has("bind")) bind_in_scene(checked.model, find_scene(model, options.get("scene")));
    Scene scene = scene_of(options, model, request.initial);
    require_curve(scene, "sweeps are made");
    const SweepRows rows = sweep_rows(options, request, model, scene);
    require_constants(model, rows);
    scene = with_swept(model, std::move(scene), rows);
    const MethodEntry& method = method_of(scene);
    Preparation preparation(checked, scene, method, sweep_driver);
    warn(checked.warnings);
    const std::vector<long double> parameters = finite_numbers(SceneEvaluator(model, scene).parameters({}), scene);
    StartState start([&](bool decided) -> const CheckedModel& { return preparation.checked(parameters, decided); },
                     scene.form);
    preparation.finish(parameters, [&](const RunRecord& found) { prepare_start(start, model, scene, found, rows); });
    const RunRecord& record = preparation.record();

    const SweepSetting setting{model, scene, record, threads};
    const std::string heading = sweep_heading(setting, rows);
    const SweepIdentity identity = identity_of(options, model, rows, shard, heading);
    SweepIdentity whole = identity;
    whole.shard = {};
    if (path != output && options.has("resume") && is_finished(output, whole)) {
        write_standard_error(fmt::format("{}: {} rows, complete\n", output, rows.count));
        return ExitCode::done;
    }
    SweepFile file(path, identity, heading, options.has("resume"));
    SweepRun run(setting, rows, shard, std::move(start), file);
    const bool resumed = file.rows() > 0;
    run.run();
    file.complete();
    write_standard_error(summary(path, file, run.reasons()));
    if (run.unproved() > 0)
        warn(fmt::format("{}{} left out with left_domain: {}", resumed ? "at least " : "",
                         run.unproved() == 1 ? "1 row is" : fmt::format("{} rows are", run.unproved()),
                         proved_for_alone(record.proved_for)),
             "conditions on parameters in [base] domain under which it can be proved make it hold for all of them");
    write_standard_error(small_lanes_warning(run, resumed));
    if (path != output && merge_ranks(output, identity))
        write_standard_error(fmt::format("{}: {} rows of {} parts\n", output, rows.count, shard.count));
    return ExitCode::done;
}

} // namespace lagen
