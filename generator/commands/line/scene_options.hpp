// SPDX-License-Identifier: GPL-2.0-or-later
/// What the command line of `run` and `sweep` says about the scene and the method.
#pragma once

#include "commands/line/options.hpp"
#include "scene/preparation.hpp"

namespace lagen {

/// The model that is named first, proved, with the parameters of --set and --bind; UsageError where a file that is
/// written is one that is read.
[[nodiscard]] CheckedModel loaded(const Options& options);

/// The scene `name`, without it that of --scene, as --method, --step, --time-scale, --tolerance, --t-end, --at and
/// --set change it, and with `initial` values and curves of the command line: what an option gives has its place there.
/// Without --plot it has no picture. With --at and without --t-end the run is as long as its rows ask for; with
/// --accuracy it has no time scale.
[[nodiscard]] Scene scene_of(const Options& options, const Model& model, const std::vector<Setting>& initial,
                             const std::optional<std::string>& name = {});

/// True where `initial` of the scene has momenta; else it has fibre coordinates, if any.
[[nodiscard]] bool starts_from_momenta(const Model& model, const Scene& scene);

/// The names that `initial` of the scene gives numbers to, or may give.
[[nodiscard]] std::vector<Symbol> initial_symbols(const Model& model, const Scene& scene);

/// A parameter ("set") or an initial value ("initial") that changes from run to run.
struct SweptName {
    std::string option, name;

    [[nodiscard]] bool operator==(const SweptName&) const = default;
};
/// The symbols that the option names: parameters that are not bound, or what the scene starts from.
[[nodiscard]] std::vector<Symbol> swept_symbols(const std::string& option, const Model& model, const Scene& scene);

/// The name as the model has it. Throws ModelError, with the place `where`, where it is not one of a number; `what`
/// would be done with it: "to sweep".
[[nodiscard]] SweptName resolved(const SweptName& given, const Model& model, const Scene& scene, const char* what,
                                 const SourceRange& where);

/// Gives the start of `scene` another value; ModelError where it has none of that name.
void set_initial(const Model& model, Scene& scene, const Setting& setting);

/// The expression of --time-scale, closed over the model's names; null where it is not given.
[[nodiscard]] Tree time_scale_of(const Options& options, const Model& model);

/// Throws where the form of the scene is a motion from step to step: `what` is made of curves.
void require_curve(const Scene& scene, const char* what);
/// The same where there is no least model of the scene: a control is searched for. Throws as evaluate_scene does.
void require_least(const Model& model, const Scene& scene);
/// The same where an event of the scene jumps.
void require_no_jumps(const Scene& scene, const char* what);

} // namespace lagen
