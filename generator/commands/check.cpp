// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen check`: decides every claim of the models named.
#include "commands/report/check.hpp"
#include "advice/advise.hpp"
#include "commands/line/command.hpp"
#include "commands/line/options.hpp"
#include "commands/report/morphism.hpp"
#include "elaborate/elaborate.hpp"
#include "elaborate/make_frame.hpp"
#include "elaborate/require_values.hpp"
#include "expression/parse.hpp"
#include "machine/places.hpp"
#include "machine/write_file.hpp"
#include "model/families.hpp"
#include "model/read_values.hpp"
#include "scene/evaluate_scene.hpp"

#include <fmt/core.h>

namespace lagen {

namespace {

const CommandSyntax check_syntax{
    "check",
    "MODEL...",
    "Decides the structure equations, tangency, Casimirs and invariants, and what a morphism file claims: each "
    "proved, refuted at a point, or undecided.",
    {{"invariant", "EXPR", "decide also whether this function is conserved (may be repeated)"},
     option::set,
     option::format}};

std::vector<NamedTree> extra_invariants(const Options& options, const Model& model)
{
    std::vector<NamedTree> invariants;
    const Scope& scope = model.observer;
    for (const std::string& text : options.all("invariant")) {
        const Tree tree = parse_expression(whole_text("<--invariant>", text));
        const ArrayValue value = scope.close_array(tree);
        for (std::size_t k = 0; k < value.entries.size(); ++k)
            invariants.push_back({value_name(text, value.shape, k), value.entries[k], tree->where});
    }
    return invariants;
}

/// First arrows are claims too: that they lie in the groupoid.
void require_arrows(const Model& model)
{
    for (const Scene& scene : model.scenes)
        if (!scene.element.empty()) (void)evaluate_scene(model, scene);
}

/// The answer for one file, as text or as a record, with its exit code.
struct Answer {
    ExitCode code;
    std::string text;
    Record record;
};

Answer check_model(const Model& model, const Options& options)
{
    require_arrows(model);
    const std::vector<NamedTree> claims = extra_invariants(options, model);
    require_values(claims);
    refuse_inputs_in(model, claims);
    const System system = elaborate(model);
    Report verified = verify(system, claims);
    advise(system, verified);
    if (verified.control.maximum.kind == ControlMaximum::Kind::stationary) warn(stationary_controls);
    return {code_of(verified.structure.verdict), report_text(model.name, verified), record_of(model.name, verified)};
}

Answer check_morphism(const MorphismFile& file, const Options& options)
{
    if (options.has("invariant"))
        throw UsageError("--invariant is of a model, and " + quote(file.file->name) + " is a morphism");
    const VerifiedMorphism verified = verify_morphism(file);
    return {code_of(verdict_of(verified)), morphism_text(verified), record_of(verified)};
}

/// One file; what is wrong with it goes to standard error.
Answer check_one(const std::string& path, const Options& options)
{
    try {
        const std::string place = model_path(path);
        const auto file = std::make_shared<const SourceFile>(SourceFile{place, read_file(place)});
        if (is_morphism(file)) return check_morphism(read_morphism(file, options.settings(), choosers()), options);
        return check_model(read_model_text(place, file->text, options.settings(), choosers()), options);
    } catch (const UsageError&) { // the same for every file
        throw;
    } catch (const Error& error) {
        const std::string said = error.what();
        write_standard_error(said + (said.ends_with('\n') ? "" : "\n"));
        return {error.code(), "", {{"model", path}, {"verdict", "error"}, {"message", said}}};
    }
}

} // namespace

ExitCode worst(ExitCode a, ExitCode b)
{
    for (const ExitCode code : {ExitCode::interrupted, ExitCode::machine, ExitCode::usage, ExitCode::model_error,
                                ExitCode::refuted, ExitCode::undecided})
        if (a == code || b == code) return code;
    return ExitCode::done;
}

ExitCode run_check(Arguments arguments)
{
    const Options options(check_syntax, arguments);
    if (options.help()) return ExitCode::done;
    const bool as_json = options.as_json();
    Record records = Record::array();
    std::string text;
    ExitCode code = ExitCode::done;
    for (const std::string& path : options.positional()) {
        Answer answer = check_one(path, options);
        code = worst(code, answer.code);
        text += answer.text;
        records.push_back(std::move(answer.record));
    }
    write_standard_output(as_json ? to_json(records.size() > 1 ? records : records[0]) + "\n" : text);
    return code;
}

} // namespace lagen
