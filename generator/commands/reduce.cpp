// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen reduce`: of a morphism file the proof that the equations of its source project onto those of its target, with
/// both; of a model its cyclic coordinates, or its Routh reduction by some of them.
#include "commands/line/command.hpp"
#include "commands/line/options.hpp"
#include "commands/line/scene_options.hpp"
#include "commands/report/check.hpp"
#include "commands/report/morphism.hpp"
#include "elaborate/elaborate_morphism.hpp"
#include "elaborate/make_frame.hpp"
#include "machine/places.hpp"
#include "machine/write_file.hpp"
#include "model/read_values.hpp"
#include "pipeline.hpp"
#include "reduction/by_group.hpp"
#include "reduction/by_routh.hpp"
#include "text/comma_list.hpp"
#include "typeset/print_equations.hpp"
#include "verify/cyclic.hpp"
#include "verify/verify_reduction.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

namespace {

const CommandSyntax reduce_syntax{
    "reduce",
    "MORPHISM",
    "Proves, component by component, that the equations of the source of a morphism project onto those of its target, "
    "and what else the morphism carries: variations, lifts of solutions, constraints; prints both. Of a model: lists "
    "its cyclic coordinates, or reduces it by some of them or by a group.",
    {{"routh", "X,..", "of a model: Routh's reduction by these cyclic coordinates, proved and written as a model file"},
     {"group", "GROUP",
      "of a model: the quotient by this group, SO(3), SE(2), R^2, .., proved and written as a model file"},
     {"action", "X=EXPR,..", "its right action x.W on the coordinates, W an element; those left out stay"},
     {"slice", "X=EXPR,..", "where its orbits are cut (else coordinates at their values in the first scene, or 0)"},
     option::output,
     option::set,
     {"unchecked", nullptr, "go on although the morphism, or a model, is refuted"},
     option::format}};

/// Both sides in the forms that were compared.
struct Sides {
    std::vector<EquationSet> source, target;
};

/// The row of a check: the first index of `projects` and `paths`, which names a form; `constraint` itself, which is
/// none.
std::string row_of(const Check& check)
{
    return check.name == "constraint" ? check.name : check.indices[0];
}

/// "  lagrange        g1, g2, g3, w1: proved", a line a form and a status.
std::string components_text(const std::vector<Check>& checks)
{
    std::string text;
    for (const std::string& row : distinct(checks, row_of))
        for (const ProofStatus status : {ProofStatus::proved, ProofStatus::refuted, ProofStatus::undecided}) {
            std::vector<std::string> components;
            for (const Check& check : checks)
                if (row_of(check) == row && check.decision.status == status)
                    components.push_back(check.name == row ? fmt::format("{}", fmt::join(check.indices, " "))
                                                           : check.indices[1]);
            if (!components.empty())
                text += labelled(row, fmt::format("{}: {}", fmt::join(components, ", "), to_text(status)));
        }
    return text;
}

const char* said_of(Verdict verdict)
{
    switch (verdict) {
    case Verdict::valid: return "project onto";
    case Verdict::invalid: return "do not project onto";
    case Verdict::undecided: break;
    }
    return "are not shown to project onto";
}

std::string reduction_text(const VerifiedMorphism& verified, const ReductionReport& reduction, const Sides& sides)
{
    const StructureReport& report = reduction.projects;
    std::string text = fmt::format("{}: the equations of {} {} those of {}\n", verified.name, verified.source_name,
                                   said_of(report.verdict), verified.target_name);
    text += components_text(report.checks) + components_text(reduction.paths);
    if (!report.note.empty()) text += fmt::format("  note: {}\n", report.note);
    text += failures_text(report);
    for (const std::vector<EquationSet>* list : {&sides.source, &sides.target})
        for (const EquationSet& equations : *list) text += "\n" + print_text(equations);
    return text;
}

Record reduction_record(const VerifiedMorphism& verified, const ReductionReport& reduction, const Sides& sides)
{
    const StructureReport& report = reduction.projects;
    Record record = {{"model", verified.name}, {"verdict", to_text(report.verdict)}};
    add_structure(record, report);
    record["paths"] = checks_record(reduction.paths);
    add_unless_empty(record, "note", report.note);
    const auto equations = [](const EquationSet& each) { return record_of(each); };
    record["source"] = list_of(sides.source, equations);
    record["target"] = list_of(sides.target, equations);
    return record;
}

void write_result(const Options& options, const std::string& text)
{
    write_file(options.output(), text.ends_with('\n') ? text : text + "\n");
}

ExitCode reduce_morphism(const Options& options, const MorphismFile& file)
{
    require_apart(options, file);
    const VerifiedMorphism verified = verify_morphism(file);
    const bool unchecked = options.has("unchecked");
    warn_of_morphism(verified, file.file->name, unchecked);
    const SystemMorphism map = elaborate_whole(file);
    Sides sides;
    const bool is_json = options.as_json();
    const auto add = [&](std::vector<EquationSet>& list, const Model& model, const System& system, const Report& known,
                         const std::vector<Check>& checks) {
        warn(require_unrefuted("model", model.name, model.file->name, known.structure, unchecked));
        for (const std::string& row : distinct(checks, row_of))
            if (row != "constraint") {
                EquationSet equations = derive(row, model, system, known, {}, Definitions::kept);
                list.push_back(is_json ? std::move(equations) : with_written_blocks(std::move(equations), model));
            }
    };
    const ReductionReport report = verify_reduction(map);
    add(sides.source, source_of(file), map.source, verified.source, report.projects.checks);
    add(sides.target, target_of(file), map.target, verified.target, report.projects.checks);
    write_result(options, is_json ? to_json(reduction_record(verified, report, sides))
                                  : reduction_text(verified, report, sides));
    return code_of(report.projects.verdict);
}

/// Writes the file of a reduced model where its function, called `key` in JSON, is not refuted.
ExitCode write_reduced(const Options& options, const std::string& model, const std::string& by, const char* key,
                       const ReducedModel& made)
{
    const Verdict verdict = made.report.verdict;
    const bool writes = !made.document.empty() && (verdict != Verdict::invalid || options.has("unchecked"));
    if (options.as_json()) {
        Record record = {{"model", model}, {"verdict", to_text(verdict)}};
        if (!made.document.empty()) record.update({{key, made.lagrangian}, {"file", made.document}});
        add_structure(record, made.report);
        write_file("-", to_json(record) + "\n");
        if (options.has("output") && writes) write_file(options.get("output"), made.document);
    } else {
        write_standard_error(fmt::format("{}: reduced by {}: {}\n{}{}", model, by, to_text(verdict), made.said,
                                         failures_text(made.report)));
        if (writes) write_result(options, made.document);
    }
    return code_of(verdict);
}

/// NAME=VALUE, .. of an option.
std::vector<Setting> listed(const Options& options, const char* name)
{
    std::vector<Setting> settings;
    for (const std::string& each : split_list(options.get(name))) settings.push_back(read_setting(name, each));
    return settings;
}

CheckedModel load_to_reduce(const Options& options)
{
    CheckedModel checked = loaded(options);
    warn(checked.warnings);
    return checked;
}

ExitCode reduce_by_routh(const Options& options)
{
    const CheckedModel checked = load_to_reduce(options);
    for (const Scene& scene : checked.model.scenes) require_no_jumps(scene, "Routh's reductions are made");
    return write_reduced(options, checked.model.name, options.get("routh"), "routhian",
                         reduce_by_routh(checked, split_list(options.get("routh"))));
}

ExitCode reduce_by_group(const Options& options)
{
    if (!options.has("action")) throw UsageError("--group needs --action, how an element W moves the coordinates");
    const CheckedModel checked = load_to_reduce(options);
    const GroupRequest request{options.get("group"), listed(options, "action"), listed(options, "slice"),
                               options.get("slice")};
    return write_reduced(options, checked.model.name, request.group, "lagrangian", quotient_by_group(checked, request));
}

/// "ph" of each coordinate that is proved to be cyclic.
std::vector<std::string> cyclic_names(const StructureReport& report)
{
    std::vector<std::string> names;
    for (const Check& check : report.checks)
        if (check.decision.status == ProofStatus::proved) names.push_back(check.indices[0]);
    return names;
}

ExitCode list_cyclic(const Options& options)
{
    const CheckedModel checked = load_to_reduce(options);
    const System& system = checked.system;
    if (!system.lagrangian && !system.hamiltonian)
        throw MathematicsError(
            fmt::format("model '{}' has neither L nor H that could be free of a coordinate", checked.model.name),
            "cyclic coordinates are those of [lagrangian] or [hamiltonian]");
    const StructureReport report = cyclic_coordinates(system);
    const std::vector<std::string> names = cyclic_names(report);
    if (options.as_json()) {
        Record record = {{"model", checked.model.name}, {"cyclic", names}};
        add_structure(record, report);
        write_result(options, to_json(record));
    } else {
        const std::string list = names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
        write_result(options,
                     fmt::format("{}: cyclic coordinates: {}\n{}", checked.model.name, list, failures_text(report)));
    }
    const bool open = std::ranges::any_of(
        report.checks, [](const Check& check) { return check.decision.status == ProofStatus::undecided; });
    return open ? ExitCode::undecided : ExitCode::done;
}

} // namespace

ExitCode run_reduce(Arguments arguments)
{
    const Options options(reduce_syntax, arguments);
    if (options.help()) return ExitCode::done;
    (void)options.as_json();
    if (options.has("output")) require_writable(options.get("output"));
    const std::string path = model_path(options.positional()[0]);
    const auto file = std::make_shared<const SourceFile>(SourceFile{path, read_file(path)});
    for (const char* other : {"action", "slice"})
        if (options.has(other) && !options.has("group")) throw UsageError(fmt::format("--{} goes with --group", other));
    if (options.has("routh") && options.has("group"))
        throw UsageError("--routh and --group are two reductions: one after the other");
    if (is_morphism(file)) {
        for (const char* of_models : {"routh", "group"})
            if (options.has(of_models))
                throw UsageError(fmt::format("--{} takes a model, and this is a morphism", of_models));
        return reduce_morphism(options, read_morphism(file, options.settings(), choosers()));
    }
    if (options.has("routh")) return reduce_by_routh(options);
    if (options.has("group")) return reduce_by_group(options);
    return list_cyclic(options);
}

} // namespace lagen
