// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/run_morphism.hpp"

#include "commands/machine/temporary_folder.hpp"
#include "commands/machine/write_file.hpp"
#include "commands/morphism/defect.hpp"
#include "commands/morphism/image_scene.hpp"
#include "commands/morphism/lift.hpp"
#include "commands/report_morphism.hpp"
#include "commands/scene/partial_rows.hpp"
#include "commands/scene/scene_options.hpp"
#include "elaborate/elaborate_morphism.hpp"
#include "elaborate/make_frame.hpp"
#include "model/plain_names.hpp"
#include "model/scene_form.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace lagen {

namespace {

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

/// The first `count` columns behind t.
Table first_columns(const Table& table, std::size_t count)
{
    Table part;
    part.columns.assign(table.columns.begin(), table.columns.begin() + static_cast<std::ptrdiff_t>(count + 1));
    for (std::size_t k = 0; k < table.count(); ++k) {
        const std::span<const double> row = table.row(k).first(count + 1);
        part.numbers.insert(part.numbers.end(), row.begin(), row.end());
    }
    return part;
}

/// A run with everything that can be compared, and without what nobody asked for.
struct WholeRun {
    RunOutcome outcome;
    Table whole;
};

WholeRun run_of(SceneRun& run, std::size_t asked)
{
    WholeRun result{run.integrate(), {}};
    result.whole = result.outcome.table;
    result.outcome.table = first_columns(result.whole, asked);
    return result;
}

/// An object of both runs, as JSON already; without a target there is nothing to compare the source with.
std::string both_runs(const RunOutcome& source, const std::string& target)
{
    return with_member(with_member("{}", "source", report_json(source)), "target", target);
}

std::string report_of(const Options& options, const RunOutcome& source, const RunOutcome& target,
                      const RunComparison& comparison)
{
    std::string text = both_runs(source, report_json(target));
    text = with_member(std::move(text), "defect", to_json(defect_record(comparison, false)));
    if (options.has("reconstruct"))
        text = with_member(std::move(text), "reconstruction", to_json(defect_record(comparison, true)));
    return text + "\n";
}

std::string report_of_source(const RunOutcome& source)
{
    return with_member(both_runs(source, "null"), "defect", "null") + "\n";
}

/// `known`: the names of both models.
void tell(const Options& options, const RunOutcome& source, const RunOutcome& target, const RunComparison& comparison,
          const std::vector<std::string>& known)
{
    const std::string csv = to_csv(comparison.table, known);
    const std::string report = report_of(options, source, target, comparison);
    if (options.has("output"))
        write_file(options.get("output"), options.get("output").ends_with(".json") ? report : csv);
    if (options.as_json()) {
        write_standard_output(report);
    } else {
        if (!options.has("output")) write_standard_output(csv);
        write_standard_error(report_text(source) + report_text(target) + defect_text(comparison));
    }
    write_standard_error(run_warnings(source) + run_warnings(target));
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

/// Starts of the lifts are those of the source.
void add_lifts(const LiftedTarget& lifted, const SceneRun& source, Scene& image, Projection& projection)
{
    projection.add_lifts(lifted.names);
    for (std::size_t i = 0; i < lifted.names.size(); ++i) {
        const auto start = static_cast<double>(source.input().initial[i]);
        image.initial.push_back({lifted.names[i], number(Rational(start)), {}});
    }
}

/// Reports the run of the source alone, which came to no row that an image could be compared at.
ExitCode tell_alone(const Options& options, const RunOutcome& source)
{
    if (options.as_json())
        write_standard_output(report_of_source(source));
    else
        write_standard_error(report_text(source));
    return ExitCode::refuted;
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
    const MethodEntry& method = method_of(options, scene);
    const std::size_t asked = observe_states(from.model, scene);

    SceneRun source(options, from, std::move(scene), method, options.has("at") && !options.has("t-end"));
    const InterruptsHeld held; // between programs, which they reach: rows are written first
    const WholeRun here = run_of(source, asked);
    if (is_interrupted(here.outcome))
        return leave_rows(options, here.outcome.table, known, report_of_source(here.outcome), here.outcome.t);
    if (here.whole.count() == 0) return tell_alone(options, here.outcome);

    LiftedTarget lifted;
    if (reconstruct) {
        lifted = lifted_target(to.model, map, source.values().parameters);
        to.model = lifted.model;
    }
    Projection projection(std::move(map), source.form(), source.values());
    Scene image = image_scene(source, here.whole, to.model, projection);
    if (reconstruct) add_lifts(lifted, source, image, projection);
    const std::size_t states = observe_states(to.model, image);
    SceneRun target(options, to, std::move(image), method, false);
    const WholeRun there = run_of(target, states);

    const RunComparison comparison = compare(projection, here.whole, there.whole);
    if (is_interrupted(there.outcome))
        return leave_rows(options, comparison.table, known, report_of(options, here.outcome, there.outcome, comparison),
                          there.outcome.t);
    tell(options, here.outcome, there.outcome, comparison, known);
    const bool done = succeeded(here.outcome.status) && succeeded(there.outcome.status);
    return done ? ExitCode::done : ExitCode::refuted;
}

} // namespace lagen
