// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen explain`: the least model of a scene, rule by rule, and as a model file.
#include "commands/line/command.hpp"
#include "commands/line/options.hpp"
#include "commands/line/scene_options.hpp"
#include "machine/places.hpp"
#include "machine/write_file.hpp"
#include "reduction/least_scene.hpp"

namespace lagen {

namespace {

const CommandSyntax explain_syntax{"explain",
                                   "MODEL",
                                   "Finds the least system whose motion provably gives everything that a scene "
                                   "watches, and says what it leaves out and why.",
                                   {option::scene,
                                    option::set,
                                    option::initial,
                                    {"output,o", "FILE.toml", "write the least model there, as a model file"},
                                    option::unchecked,
                                    option::format}};

} // namespace

ExitCode run_explain(Arguments arguments)
{
    const Options options(explain_syntax, arguments);
    if (options.help()) return ExitCode::done;
    const bool as_json = options.as_json();
    if (options.has("output")) require_writable(options.get("output"));
    const CheckedModel checked =
        load(model_path(options.positional()[0]), options.settings(), options.has("unchecked"));
    require_apart(options, checked.model);
    const Scene scene = scene_of(options, checked.model, options.named("initial"));
    require_least(checked.model, scene);
    warn(warnings_of(checked, scene.form));
    const LeastScene least = least_scene(checked, scene, options.has("output"));
    if (options.has("output")) {
        if (!least.unwritten.empty())
            throw MathematicsError("the least model cannot be written as a system of first order: " + least.unwritten);
        write_file(options.get("output"), least.document);
    }
    write_standard_output(as_json ? to_json(least.record) + "\n" : least.text);
    return ExitCode::done;
}

} // namespace lagen
