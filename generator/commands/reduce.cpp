// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen reduce`: of a morphism file the proof that the equations of its source project onto those of its target, with
/// both; of a model its cyclic coordinates, or its Routh reduction by some of them.
#include "commands/line/command.hpp"
#include "commands/line/options.hpp"
#include "commands/reduce/by_group.hpp"
#include "commands/reduce/routh_document.hpp"
#include "commands/report_check.hpp"
#include "commands/report_morphism.hpp"
#include "commands/scene/scene_options.hpp"
#include "elaborate/elaborate_morphism.hpp"
#include "elaborate/make_frame.hpp"
#include "machine/places.hpp"
#include "machine/write_file.hpp"
#include "model/read_file.hpp"
#include "pipeline.hpp"
#include "typeset/print_equations.hpp"
#include "verify/cyclic.hpp"
#include "verify/verify_reduction.hpp"
#include "verify/verify_routh.hpp"

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

std::vector<std::string> rows_in(const std::vector<Check>& checks)
{
    std::vector<std::string> rows;
    for (const Check& check : checks)
        if (std::ranges::find(rows, row_of(check)) == rows.end()) rows.push_back(row_of(check));
    return rows;
}

/// "  lagrange        g1, g2, g3, w1: proved", a line a form and a status.
std::string components_text(const std::vector<Check>& checks)
{
    std::string text;
    for (const std::string& row : rows_in(checks))
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
    write_file(options.has("output") ? options.get("output") : "-", text.ends_with('\n') ? text : text + "\n");
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
        for (const std::string& row : rows_in(checks))
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

/// Throws MathematicsError with the defect of a coordinate that is none.
void require_cyclic(const Model& model, const StructureReport& report, const std::vector<std::size_t>& coordinates)
{
    for (const Check& check : report.checks)
        for (const std::size_t k : coordinates)
            if (check.indices[0] == model.base.coordinates[k].name && check.decision.status == ProofStatus::refuted)
                throw MathematicsError(
                    fmt::format(
                        "model '{}' is not to be reduced by '{}', which is not cyclic: {} depends on it, with the "
                        "derivative {}",
                        model.name, check.indices[0], check.indices[1], check.decision.residual),
                    "lagen reduce without --routh lists the cyclic coordinates");
}

/// Writes the file of a reduced model where its function is not refuted, with what is `said` of it.
ExitCode write_reduced(const Options& options, const std::string& model,
                       const std::pair<const char*, std::string>& function, const std::string& document,
                       const std::string& said, const StructureReport& report)
{
    const bool writes = !document.empty() && (report.verdict != Verdict::invalid || options.has("unchecked"));
    if (options.as_json()) {
        Record record = {{"model", model}, {"verdict", to_text(report.verdict)}};
        if (!document.empty()) record.update({{function.first, function.second}, {"file", document}});
        add_structure(record, report);
        write_file("-", to_json(record) + "\n");
        if (options.has("output") && writes) write_file(options.get("output"), document);
    } else {
        write_standard_error(said);
        if (writes) write_result(options, document);
    }
    return code_of(report.verdict);
}

/// R is what is read back from the file, and proved to have the motions of L.
ExitCode reduce_by_routh(const Options& options, const std::string& path)
{
    const CheckedModel checked = load(path, options.settings(), options.has("unchecked"));
    const Model& model = checked.model;
    require_apart(options, model);
    warn(checked.warnings);
    for (const Scene& scene : model.scenes) require_no_jumps(scene, "Routh's reductions are made");
    const std::vector<std::size_t> cyclic = coordinates_to_reduce(model, split_list(options.get("routh")));
    const StructureReport free_of = cyclic_coordinates(checked.system);
    require_cyclic(model, free_of, cyclic);
    Graph graph = checked.system.graph;
    const Routhian made = routhian(graph, checked.system, cyclic);
    const RouthianText text = routhian_text(model, checked.system, graph, made);
    const std::vector<Tree> factors = singular_factors_of_momenta(graph, checked.system, made);
    const std::string document = routh_document(model, options.settings(), cyclic, text, factors);
    const Model reduced = read_model_text(model.name + "_routh.toml", document);
    std::vector<std::string> where;
    for (const Tree& factor : factors) where.push_back(to_text(factor) + " != 0");
    const StructureReport report = verify_routh(graph, checked.system, made, elaborate(reduced), free_of, where);
    std::string said =
        fmt::format("{}: reduced by {}: {}\n", model.name, options.get("routh"), to_text(report.verdict));
    for (std::size_t j = 0; j < cyclic.size(); ++j)
        said += fmt::format("  {} = {}\n", model.fibre.coordinates[cyclic[j]].name, to_text(text.velocities[j]));
    said += fmt::format("  R = {}\n", to_text(text.value));
    for (const Check& check : report.checks) // where momenta do not jump
        for (const std::string& each : check.where)
            if (std::ranges::find(where, each) == where.end()) where.push_back(each);
    if (!where.empty()) said += fmt::format("  where {}\n", fmt::join(where, " and "));
    said += failures_text(report);
    return write_reduced(options, model.name, {"routhian", to_text(text.value)}, document, said, report);
}

/// L likewise.
ExitCode reduce_by_group(const Options& options, const std::string& path)
{
    if (!options.has("action")) throw UsageError("--group needs --action, how an element W moves the coordinates");
    const CheckedModel checked = load(path, options.settings(), options.has("unchecked"));
    require_apart(options, checked.model);
    warn(checked.warnings);
    const GroupQuotient made = quotient_by_group(checked, options.settings(), options.get("group"),
                                                 options.get("action"), options.get("slice"));
    return write_reduced(options, checked.model.name, {"lagrangian", made.lagrangian}, made.document,
                         fmt::format("{}: reduced by {}: {}\n{}{}", checked.model.name, options.get("group"),
                                     to_text(made.report.verdict), made.said, failures_text(made.report)),
                         made.report);
}

/// "ph" of each coordinate that is proved to be cyclic.
std::vector<std::string> cyclic_names(const StructureReport& report)
{
    std::vector<std::string> names;
    for (const Check& check : report.checks)
        if (check.decision.status == ProofStatus::proved) names.push_back(check.indices[0]);
    return names;
}

ExitCode list_cyclic(const Options& options, const std::string& path)
{
    const CheckedModel checked = load(path, options.settings(), options.has("unchecked"));
    require_apart(options, checked.model);
    warn(checked.warnings);
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
    if (options.has("routh")) return reduce_by_routh(options, path);
    if (options.has("group")) return reduce_by_group(options, path);
    return list_cyclic(options, path);
}

} // namespace lagen
