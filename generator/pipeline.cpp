// SPDX-License-Identifier: GPL-2.0-or-later
#include "pipeline.hpp"

#include "analysis/leaf.hpp"
#include "elaborate/bind_parameters.hpp"
#include "elaborate/make_frame.hpp"
#include "emit/print_header.hpp"
#include "graph/core/evaluate.hpp"
#include "graph/core/lower.hpp"
#include "graph/simplify/simplify.hpp"
#include "model/scene_form.hpp"
#include "text/activity.hpp"
#include "text/comma_list.hpp"
#include "text/content_hash.hpp"
#include "typeset/print_equations.hpp"
#include "verify/control_maximum.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace lagen {

namespace {

std::string names_of(const Check& check)
{
    return check.indices.empty() ? check.name : fmt::format("{} ({})", check.name, comma_list(check.indices));
}

std::vector<std::string> lines_of(const std::string& text)
{
    std::vector<std::string> lines;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        lines.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return lines;
}

/// Terms of L or H, multiplied out: equations made of more take longer than all kernels, and nobody reads them.
constexpr std::size_t most_readable_terms = 1'500;

bool is_readable(const System& system)
{
    return std::ranges::all_of(std::vector{system.lagrangian, system.hamiltonian}, [&](std::optional<NodeId> function) {
        return !function || expanded_terms(system.graph, *function, most_readable_terms) < most_readable_terms;
    });
}

/// For the head of the header; equations that are too long for a person do not keep a machine from its kernels.
std::vector<std::string> readable_equations(const CheckedModel& checked, const std::string& form,
                                            const std::string& command)
{
    if (!is_readable(checked.system))
        return {fmt::format("The equations are too long to be written out here: {} -o FILE writes them.", command)};
    try {
        const Activity activity("equations for the reader of the header");
        EquationSet equations = derive(form, checked.model, checked.system, checked.report);
        equations.given.clear(); // the model stands in the header too
        return lines_of(print_text(equations, LongLines::whole));
    } catch (const MathematicsError& error) {
        return {fmt::format("The equations are not written out here: {}.", error.message())};
    }
}

constexpr std::size_t longest_residual = 100; ///< bytes in a message, which is one line

/// A residual in a message.
std::string short_residual(const std::string& residual)
{
    return residual.size() <= longest_residual ? residual : fmt::format("of {} characters", residual.size());
}

/// The first check with this status, as "anchor (w1, w2, g3), residual 2*g3"; of the maximum of H more is said
/// elsewhere.
std::string first_with(const StructureReport& structure, ProofStatus status)
{
    for (const Check& check : structure.checks)
        if (check.decision.status == status && check.name != "maximum")
            return check.decision.residual.empty()
                       ? names_of(check)
                       : fmt::format("{}, residual {}", names_of(check), short_residual(check.decision.residual));
    return structure.note;
}

/// The model's content: its file, the files that it includes, and what the command line changed in it.
std::string hash_of(const CheckedModel& checked)
{
    ContentHash hash;
    hash.add(checked.model.file->text);
    for (const auto& file : checked.model.included) hash.add(file->text);
    for (const Setting& setting : checked.settings)
        hash.add(setting.binds ? "bind " + setting.name : setting.name).add(setting.value.text);
    return hash.hex16();
}

/// A word as a shell reads it, on one line: it stands in a comment of the header.
std::string shell_word(std::string text)
{
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 0x20) c = ' ';
    const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=.,/";
    if (!text.empty() && text.find_first_not_of(plain) == std::string::npos) return text;
    std::string quoted = "'";
    for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

/// `lagen VERB FILE` with what was set, and the form where it is not the model's own.
std::string command_on(const CheckedModel& checked, const char* verb, const std::string& form)
{
    const std::string file = std::filesystem::path(checked.model.file->name).filename().string();
    std::string command = fmt::format("lagen {} {}", verb, shell_word(file));
    for (const Setting& setting : checked.settings)
        command += (setting.binds ? " --bind " : " --set ") +
                   shell_word(setting.gives_value() ? setting.name + "=" + setting.value.text : setting.name);
    if (form != default_form(checked.model)) command += " --form " + form;
    return command;
}

/// With every option that changes the header; files by their names alone, so that the bytes are the same in every
/// folder. `name` is that of the header where the request has none.
std::string regenerate_command(const CheckedModel& checked, const GenerateRequest& request,
                               const std::string& kernels_form, const std::string& name)
{
    std::string command = command_on(checked, "generate", kernels_form);
    for (const auto& [option, kernels] : {std::pair(" --only ", &request.only), std::pair(" --with ", &request.with)})
        if (!kernels->empty()) command += option + shell_word(fmt::format("{}", fmt::join(*kernels, ",")));
    if (request.time_scale != nullptr) command += " --time-scale " + shell_word(to_text(request.time_scale));
    if (checked.unchecked && checked.report.structure.verdict == Verdict::invalid) command += " --unchecked";
    const std::string output = std::filesystem::path(request.output).filename().string();
    return fmt::format("{} -o {}", command, shell_word(output.empty() ? name + ".hpp" : output));
}

/// A scene's program is told every parameter: defaults and hash in its header would make a new program of each change
/// of a number.
void forget_values(KernelModule& module)
{
    for (NodeId& value : module.input_defaults) value = module.graph->constant(0);
    for (NodeId& value : module.parameter_defaults) value = module.graph->constant(0);
    module.hash = std::string(16, '0');
}

} // namespace

CheckedModel read(const std::string& path, const std::vector<Setting>& settings, bool unchecked)
{
    CheckedModel checked;
    checked.model = read_model(path, settings, choosers());
    checked.settings = settings;
    checked.unchecked = unchecked;
    return checked;
}

CheckedModel read_text(const std::string& name, std::string text)
{
    CheckedModel checked;
    checked.model = read_model_text(name, std::move(text), {}, choosers());
    return checked;
}

std::vector<std::string> require_unrefuted(const char* noun, const std::string& name, const std::string& file,
                                           const StructureReport& structure, bool unchecked)
{
    if (structure.verdict == Verdict::valid) return {};
    const bool refuted = structure.verdict == Verdict::invalid;
    const std::string what = first_with(structure, refuted ? ProofStatus::refuted : ProofStatus::undecided);
    if (refuted && !unchecked)
        throw MathematicsError(fmt::format("{} '{}' is refuted: {}", noun, name, what),
                               fmt::format("see `lagen check {}`; --unchecked goes on all the same", file));
    if (what.empty()) return {};
    if (refuted) return {fmt::format("this {} is REFUTED: {}", noun, what)};
    return {fmt::format("this {} is not proved: {}{}", noun, what, what == structure.note ? "" : " is undecided")};
}

/// A start that is moved stays on its leaf (analysis/leaf.hpp).
void find_casimirs_for_starts(CheckedModel& checked)
{
    Base& base = checked.model.base;
    if (base.constraints.empty() || std::ranges::none_of(checked.model.scenes, &Scene::project)) return;
    Graph graph = checked.system.graph;
    const Leaves leaves = leaves_of(graph, checked.system);
    for (std::size_t k = base.casimirs.size(); k < leaves.casimirs.size(); ++k)
        base.found_casimirs.push_back(to_tree(graph, leaves.casimirs[k]));
}

void prove(CheckedModel& checked)
{
    const Model& model = checked.model;
    checked.system = elaborate(model);
    checked.report = verify(checked.system);
    const Report& verified = checked.report;
    const StructureReport& structure = verified.structure;
    if (structure.verdict == Verdict::invalid && !checked.unchecked &&
        first_with(structure, ProofStatus::refuted).empty())
        require_maximum(model.name, verified.control.maximum);
    checked.warnings = require_unrefuted("model", model.name, model.file->name, structure, checked.unchecked);
    if (verified.control.maximum.kind == ControlMaximum::Kind::stationary)
        checked.warnings.push_back(stationary_controls);
    find_casimirs_for_starts(checked);
}

CheckedModel load(const std::string& path, const std::vector<Setting>& settings, bool unchecked)
{
    CheckedModel checked = read(path, settings, unchecked);
    settle_domain(checked.model);
    prove(checked);
    return checked;
}

std::vector<std::string> warnings_of(const CheckedModel& checked, const std::string& form)
{
    std::vector<std::string> warnings = checked.warnings;
    if (const std::vector<std::string> values = proved_values(checked, form); !values.empty())
        warnings.push_back(proved_for_alone(values));
    return warnings;
}

std::vector<std::string> proved_values(const CheckedModel& checked, const std::string& form)
{
    std::vector<std::string> values;
    if (!is_form(form, FormKind::hamilton) || checked.system.hamiltonian) return values;
    for (const auto& [parameter, value] : checked.report.mechanics.regularity.legendre_values)
        values.push_back(
            fmt::format("{} = {}", checked.system.graph.input_name(parameter), to_text(checked.system.graph, value)));
    return values;
}

std::string proved_for_alone(const std::vector<std::string>& values)
{
    return fmt::format("that the momenta fix the velocities is proved for {} alone", fmt::join(values, ", "));
}

bool set_parameters(System& system, const std::vector<long double>& values)
{
    bool differ = false;
    for (std::size_t k = 0; k < values.size(); ++k) {
        NodeId& value = system.parameter_values[k].second;
        const NodeId node[] = {value};
        const auto wanted = static_cast<double>(values[k]);
        if (evaluate<double>(system.graph, node, {})[0] == wanted) continue;
        value = system.graph.constant(Rational(wanted));
        differ = true;
    }
    return differ;
}

void set_parameters(CheckedModel& checked, const std::vector<long double>& values)
{
    if (!rests_on_values(checked.report.mechanics.regularity)) return;
    if (set_parameters(checked.system, values)) checked.report.mechanics.regularity = verify_regularity(checked.system);
}

Generated generate(const CheckedModel& checked, const GenerateRequest& request)
{
    const Model& model = checked.model;
    KernelRequest kernels;
    kernels.form = request.form.empty() ? default_form(model) : request.form;
    kernels.only = request.only;
    kernels.with = request.with;
    kernels.without = request.without;
    kernels.flows = request.flows;
    kernels.time_scale = request.time_scale;
    kernels.scene = request.scene;
    Generated generated;
    if (request.report) kernels.reports = &generated.reports;
    generated.module = form_kernels(model, checked.system, checked.report, kernels);
    KernelModule& module = generated.module;
    module.hash = hash_of(checked);
    module.regenerate = regenerate_command(checked, request, kernels.form,
                                           kernels.form == default_form(model) ? model.name : module.name);
    module.derive = command_on(checked, "derive", kernels.form);
    module.warnings = warnings_of(checked, kernels.form);
    if (request.scene == nullptr)
        module.equations = readable_equations(checked, kernels.form, module.derive);
    else if (!request.keeps_values)
        forget_values(module);
    const Activity activity("writing the header");
    generated.header = print_header(module);
    return generated;
}

} // namespace lagen
