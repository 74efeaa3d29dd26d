// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen run` of a morphism file.
#include "commands/line/command.hpp"
#include "commands/line/scene_options.hpp"
#include "commands/report/morphism.hpp"
#include "commands/report/run.hpp"
#include "elaborate/elaborate_morphism.hpp"
#include "elaborate/make_frame.hpp"
#include "machine/temporary_folder.hpp"
#include "machine/write_file.hpp"
#include "model/plain_names.hpp"
#include "model/scene_form.hpp"
#include "scene/image_run.hpp"
#include "text/diagnostic.hpp"
#include "text/record.hpp"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace lagen {

namespace {

/// The column with the largest defect; null where there are no columns.
const ColumnDefect* largest_defect(const RunComparison& comparison, bool lifted)
{
    const ColumnDefect* largest = nullptr;
    for (const ColumnDefect& defect : comparison.defects)
        if (defect.lifted == lifted && (largest == nullptr || defect.max > largest->max)) largest = &defect;
    return largest;
}

/// {"max": .., "t": .., "columns": {NAME: ..}} of the projection, or of what is lifted.
Record defect_record(const RunComparison& comparison, bool lifted)
{
    const ColumnDefect* largest = largest_defect(comparison, lifted);
    Record columns = Record::object();
    for (const ColumnDefect& defect : comparison.defects)
        if (defect.lifted == lifted) columns[defect.name] = defect.max;
    return {{"max", largest == nullptr ? 0 : largest->max},
            {"t", largest == nullptr ? 0 : largest->time},
            {"columns", columns}};
}

/// A line for standard error, and a warning where a column is off by more than 1e-3 of its size; of both.
std::string defect_text(const RunComparison& comparison)
{
    std::string text;
    for (const bool lifted : {false, true})
        if (const ColumnDefect* largest = largest_defect(comparison, lifted))
            text += fmt::format("defect of the {}: at most {:.3g}, of {} at t = {:.6g}, in {} rows\n",
                                lifted ? "reconstruction" : "projection", largest->max, largest->name, largest->time,
                                comparison.table.count());
    for (const ColumnDefect& defect : comparison.defects)
        if (defect.moved)
            text +=
                fmt::format("warning: {}: {} is off by {:.3g}, more than 1e-3 of its size {:.3g} from t = {:.6g} on\n",
                            defect.lifted ? "what is lifted is not the motion of the source"
                                          : "the projection of the source is not the motion of the target",
                            defect.name, defect.max, defect.size, defect.moved_at);
    return text;
}

/// Throws UsageError for options that the run of one model has and the run of two has not.
void refuse_options(const Options& options)
{
    for (const char* name : {"plot", "accuracy", "bind", "time-scale"})
        if (options.has(name))
            throw UsageError(
                fmt::format("--{} is of a model, and {} is a morphism", name, quote(options.positional()[0])));
}

/// Throws where inputs act on a model of the morphism: those of the source are no functions of the target.
void refuse_inputs(const MorphismFile& morphism)
{
    for (const Model* model : {&source_of(morphism), &target_of(morphism)})
        if (!model->inputs.empty())
            throw MathematicsError(
                fmt::format("model '{}' has inputs, which a run of a morphism does not carry over", model->name),
                "`lagen check` compares the forces, whatever the inputs are");
}

CheckedModel as_read(const Model& model, const Options& options, std::vector<Setting> settings)
{
    CheckedModel checked;
    checked.model = model;
    checked.settings = std::move(settings);
    checked.unchecked = options.has("unchecked");
    return checked;
}

/// Both runs in one form.
void require_form_of_target(const std::string& form, const Model& target, const SystemMorphism& map)
{
    const std::vector<std::string> forms = forms_of(target);
    if (std::ranges::find(forms, form) == forms.end())
        throw MathematicsError(fmt::format("the source is run in the form '{}', and its target {} has {}", form,
                                           target.name, form_named(form).needs),
                               forms.empty() ? "" : fmt::format("forms of the target: {}", fmt::join(forms, ", ")));
    if (form_named(form).steps && !map.of_groupoids)
        throw MathematicsError("the source is a discrete motion, and the morphism maps no arrows",
                               "give `element`, the group part of the image of an arrow");
}

/// A variational method makes a discrete Lagrangian, and a groupoid where there is none.
void refuse_variational(const Scene& scene)
{
    const MethodEntry* method = find_method(scene.method);
    if (method == nullptr || *method->scheme == '\0') return;
    throw UsageError(fmt::format("{} makes arrows of its own, which the morphism does not map", scene.method));
}

/// An object of both runs, as JSON; without a target there is nothing to compare the source with.
std::string report_of(const Options& options, const ImageRun& runs)
{
    std::string text = with_member("{}", "source", report_json(runs.source));
    text = with_member(std::move(text), "target", runs.target ? report_json(*runs.target) : "null");
    text =
        with_member(std::move(text), "defect", runs.target ? to_json(defect_record(runs.comparison, false)) : "null");
    if (runs.target && options.has("reconstruct"))
        text = with_member(std::move(text), "reconstruction", to_json(defect_record(runs.comparison, true)));
    return text + "\n";
}

/// `known`: the names of both models. A source that came to no row that an image could be compared at is told alone.
void tell(const Options& options, const ImageRun& runs, const std::vector<std::string>& known)
{
    const std::string report = report_of(options, runs), output = options.get("output");
    const std::string csv = to_csv(runs.comparison.table, known);
    if (runs.target && !output.empty()) write_file(output, output.ends_with(".json") ? report : csv);
    if (options.as_json()) {
        write_standard_output(report);
    } else {
        if (runs.target && output.empty()) write_standard_output(csv);
        write_standard_error(report_text(runs.source));
        if (runs.target) write_standard_error(report_text(*runs.target) + defect_text(runs.comparison));
    }
    if (runs.target) write_standard_error(run_warnings(runs.source) + run_warnings(*runs.target));
}

/// Theorem 3 is of isomorphisms of fibres, and of motions in continuous time.
void require_lift(const VerifiedMorphism& verified, const std::string& form)
{
    if (form_named(form).steps)
        throw UsageError("--reconstruct is of motions in continuous time, and the scene is a discrete one");
    const GenericRank& rank = verified.map.rank;
    if (rank.surjective && rank.injective && rank.where.empty()) return;
    throw MathematicsError(
        fmt::format("the morphism '{}' is not shown to be bijective on every fibre, as --reconstruct "
                    "requires",
                    verified.name),
        "`lagen check` says its rank");
}

} // namespace

ExitCode run_morphism(const Options& options, const std::shared_ptr<const SourceFile>& file)
{
    refuse_options(options);
    const MorphismFile morphism = read_morphism(file, options.settings(), choosers());
    require_apart(options, morphism);
    refuse_inputs(morphism);
    const VerifiedMorphism verified = verify_morphism(morphism);
    warn_of_morphism(verified, file->name, options.has("unchecked"));

    CheckedModel from = as_read(source_of(morphism), options, options.settings());
    CheckedModel to = as_read(target_of(morphism), options, {});
    std::vector<std::string> known = all_names(from.model);
    std::ranges::copy(all_names(to.model), std::back_inserter(known));
    SystemMorphism map = elaborate_whole(morphism);
    Scene scene = scene_of(options, from.model, options.named("initial"));
    require_form_of_target(scene.form, to.model, map);
    refuse_variational(scene);
    require_no_jumps(scene, "images by a morphism are taken");
    const bool reconstruct = options.has("reconstruct");
    if (reconstruct) require_lift(verified, scene.form);
    const MethodEntry& method = method_of(scene);
    const SecondRun second = second_run_of(options);
    const std::size_t asked = observe_states(from.model, scene);

    SceneRun source(from, std::move(scene), method, options.has("at") && !options.has("t-end"));
    const InterruptsHeld held; // between programs, which they reach: rows are written first
    const ImageRun runs = run_image(source, asked, to, std::move(map), reconstruct, second);
    if (is_interrupted(runs.source))
        return leave_rows(options, runs.source.table, known, report_of(options, runs), runs.source.t);
    if (runs.target && is_interrupted(*runs.target))
        return leave_rows(options, runs.comparison.table, known, report_of(options, runs), runs.target->t);
    tell(options, runs, known);
    return runs.target && succeeded(runs.source.status) && succeeded(runs.target->status) ? ExitCode::done
                                                                                          : ExitCode::refuted;
}

} // namespace lagen
