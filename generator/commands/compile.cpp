// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen compile`: a model as a shared object, which lagen::CompiledModel and other programs load.
#include "machine/compile.hpp"
#include "commands/line/command.hpp"
#include "commands/line/scene_options.hpp"
#include "machine/write_file.hpp"
#include "model/scene_form.hpp"
#include "scene/scene_program.hpp"

#include <fmt/core.h>

#include <optional>
#include <utility>

namespace lagen {

namespace {

const CommandSyntax compile_syntax{
    "compile",
    "MODEL",
    "Compiles the kernels of a model into a shared object behind the C interface of lagen/compiled_model.h.",
    {{"output,o", "FILE", "the shared object (required)"},
     {"form", "FORM", "lagrange, hamilton or pontryagin; without it that of the scene, or of the model"},
     {"scene", "NAME", "with the events and the observed expressions of this scene"},
     {"with", "KERNELS", "kernels beside those that every header has, e.g. taylor,event_series"},
     option::set,
     option::unchecked}};

/// A discrete motion has no right-hand side, which a compiled model is.
void require_rates(const Options& options, const Model& model, const std::string& form)
{
    if (!form_named(form).steps) return;
    const std::string found = fmt::format(
        "the {} form of model '{}' makes steps, and a compiled model is a right-hand side", form, model.name);
    if (options.has("form")) throw UsageError(found);
    throw UsageError(found, "`lagen generate` writes its header; --form takes another form");
}

} // namespace

ExitCode run_compile(Arguments arguments)
{
    const Options options(compile_syntax, arguments);
    if (options.help()) return ExitCode::done;
    if (!options.has("output")) throw UsageError("the shared object needs a name: -o FILE.so");
    if (options.has("form")) (void)options.choice("form", form_names());
    const CheckedModel checked = loaded(options);
    require_writable(options.get("output"));
    GenerateRequest request;
    request.form = options.has("form") ? options.get("form") : default_form(checked.model);
    std::optional<Scene> scene;
    if (options.has("scene")) {
        scene = find_scene(checked.model, options.get("scene"));
        if (!options.has("form")) request.form = form_of(checked.model, *scene);
        scene = in_form(checked.model, *scene, request.form);
    }
    require_rates(options, checked.model, request.form);
    warn(warnings_of(checked, request.form));
    if (scene) request.scene = &*scene;
    request.keeps_values = true;
    request.with = split_list(options.get("with"));
    Generated generated = generate(checked, request);
    ProgramText text{std::move(generated.header), model_text(generated.module.name, true)};
    text.options = rounding_options();
    text.is_model = true;
    write_file(options.get("output"), content_of_file(compile_programs({text})[0]));
    return ExitCode::done;
}

} // namespace lagen
