// SPDX-License-Identifier: GPL-2.0-or-later
/// The whole story in one place; pipeline.cpp is the only file besides the commands that knows every stage.
///
///   model file --read_model--> Model --elaborate--> System --verify--> Report (--advise--> with hints)
///                                     --derive------> EquationSet --print_text/latex/json--> what a person reads
///                                     --form_kernels--> KernelModule --print_header--> header --> runtime
#pragma once

#include "elaborate/elaborate.hpp"
#include "equations/derive.hpp"
#include "graph/kernel.hpp"
#include "kernels/form_kernels.hpp"
#include "model/read_model.hpp"
#include "verify/verify.hpp"

namespace lagen {

/// A model with its verdict, as every command but `check` needs it.
struct CheckedModel {
    Model model;
    System system;
    Report report;
    std::vector<std::string> warnings; ///< undecided, or refuted but asked to go on
    std::vector<Setting> settings;     ///< what the command line changed
    bool unchecked = false;            ///< a refuted model was to go on
};

/// Reads and verifies; a refuted model throws MathematicsError unless `unchecked`.
[[nodiscard]] CheckedModel load(const std::string& path, const std::vector<Setting>& settings, bool unchecked);

/// The two halves of `load`: what is read has no system yet, and nothing of it is decided.
[[nodiscard]] CheckedModel read(const std::string& path, const std::vector<Setting>& settings, bool unchecked);
/// The same of a text, which says `name` where it is wrong.
[[nodiscard]] CheckedModel read_text(const std::string& name, std::string text);
void prove(CheckedModel& checked);

/// What is not proved of a model or a morphism (`noun`), as warnings; one that is refuted throws MathematicsError
/// unless `unchecked`. `file` is for the hint.
[[nodiscard]] std::vector<std::string> require_unrefuted(const char* noun, const std::string& name,
                                                         const std::string& file, const StructureReport& structure,
                                                         bool unchecked);

/// `warnings`, and what holds of this form alone.
[[nodiscard]] std::vector<std::string> warnings_of(const CheckedModel& checked, const std::string& form);

/// "c = 3/5" for each parameter for whose value alone the equations of this form are proved.
[[nodiscard]] std::vector<std::string> proved_values(const CheckedModel& checked, const std::string& form);
/// The sentence that says so.
[[nodiscard]] std::string proved_for_alone(const std::vector<std::string>& values);

/// Gives the parameters other values, in order of declaration; false where they had them already.
bool set_parameters(System& system, const std::vector<long double>& values);
/// The same, and decides anew what was not shown for all values.
void set_parameters(CheckedModel& checked, const std::vector<long double>& values);

struct GenerateRequest {
    std::string form;                 ///< empty: default_form(model)
    std::vector<std::string> only;    ///< kernels; empty: all that are not made on request alone
    std::vector<std::string> with;    ///< and these
    std::vector<std::string> without; ///< but not these
    bool flows = false;               ///< as in KernelRequest
    Tree time_scale = nullptr;        ///< as in KernelRequest
    std::string output;               ///< the file that the header is for; empty: one that bears the model's name
    bool report = false;              ///< what simplification tried
    const Scene* scene = nullptr;     ///< with this scene's events and observed expressions
    bool keeps_values = false;        ///< of a scene: else defaults and hash are 0, for a program that is told them
};

/// The header text, and the module that it was printed from.
struct Generated {
    KernelModule module;
    std::string header;
    std::vector<KernelReport> reports; ///< where they were asked for
};
[[nodiscard]] Generated generate(const CheckedModel& checked, const GenerateRequest& request);

} // namespace lagen
