// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen check`: decides every claim of the models named.
#include "advice/advise.hpp"
#include "commands/line/command.hpp"
#include "commands/line/options.hpp"
#include "commands/machine/places.hpp"
#include "commands/machine/write_file.hpp"
#include "commands/report_check.hpp"
#include "commands/report_morphism.hpp"
#include "elaborate/elaborate.hpp"
#include "elaborate/make_frame.hpp"
#include "elaborate/require_values.hpp"
#include "expression/parse.hpp"
#include "model/families.hpp"
#include "model/read_file.hpp"
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
     {"set", "NAME=VALUE", "a parameter's value (may be repeated)"},
     {"format,f", "FORMAT", "text or json", "text"}}};

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

/// A report to `text` or, where there is one, to `json`.
struct Output {
    std::string& text;
    JsonWriter* json;
};

ExitCode check_model(const Model& model, const Options& options, const Output& output)
{
    require_arrows(model);
    const std::vector<NamedTree> claims = extra_invariants(options, model);
    require_values(claims);
    refuse_inputs_in(model, claims);
    const System system = elaborate(model);
    Report verified = verify(system, claims);
    advise(system, verified);
    if (verified.control.maximum.kind == ControlMaximum::Kind::stationary)
        write_standard_error(fmt::format("warning: {}\n", stationary_controls));
    if (output.json != nullptr)
        report_json(*output.json, model.name, verified);
    else
        output.text += report_text(model.name, verified);
    return code_of(verified.structure.verdict);
}

ExitCode check_morphism(const MorphismFile& file, const Options& options, const Output& output)
{
    if (options.has("invariant"))
        throw UsageError("lagen check: --invariant is of a model, and " + quote(file.file->name) + " is a morphism");
    const VerifiedMorphism verified = verify_morphism(file);
    if (output.json != nullptr)
        morphism_json(*output.json, verified);
    else
        output.text += morphism_text(verified);
    return code_of(verdict_of(verified));
}

/// One file; what is wrong with it goes to standard error.
ExitCode check_one(const std::string& path, const Options& options, std::string& text, JsonWriter* json)
{
    try {
        const std::string place = model_path(path);
        const auto file = std::make_shared<const SourceFile>(SourceFile{place, read_file(place)});
        const Output output{text, json};
        if (is_morphism(file))
            return check_morphism(read_morphism(file, options.settings(), choosers()), options, output);
        return check_model(read_model_text(place, file->text, options.settings(), choosers()), options, output);
    } catch (const Error& error) {
        const std::string said = error.what();
        write_standard_error(said + (said.ends_with('\n') ? "" : "\n"));
        if (json != nullptr)
            json->begin_object()
                .key("model")
                .value(path)
                .key("verdict")
                .value("error")
                .key("message")
                .value(said)
                .end_object();
        return error.code();
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
    const bool as_json = options.choice("format", {"text", "json"}) == "json";
    const bool list = options.positional().size() > 1;
    JsonWriter json;
    std::string text;
    ExitCode code = ExitCode::done;
    if (as_json && list) json.begin_array();
    for (const std::string& path : options.positional())
        code = worst(code, check_one(path, options, text, as_json ? &json : nullptr));
    if (as_json && list) json.end_array();
    write_standard_output(as_json ? json.text() + "\n" : text);
    return code;
}

} // namespace lagen
