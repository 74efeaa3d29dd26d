// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/run_record.hpp"

#include "graph/core/graph.hpp"
#include "machine/compile.hpp"
#include "machine/compile_cache.hpp"
#include "machine/places.hpp"
#include "mechanics/discrete.hpp"
#include "model/families.hpp"
#include "model/read_curve.hpp"
#include "model/scene_form.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace lagen {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view first_line = "what lagen " LAGEN_VERSION " proved and compiled, packed\n";

/// The program that runs: its place, size and time.
void add_lagen(ContentHash& hash)
{
    std::error_code ignored;
    const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
    hash.add(program.string()).add(std::to_string(fs::file_size(program, ignored)));
    hash.add(std::to_string(fs::last_write_time(program, ignored).time_since_epoch().count()));
}

} // namespace

RunRecord record_of(const CheckedModel& checked, const KernelModule& module, const std::vector<long double>& parameters)
{
    RunRecord record;
    record.warnings = checked.warnings;
    record.names = names_of(checked.model, module);
    record.energy_changes = form_named(module.form).steps ? !keeps_energy(checked.system) : has_kernel(module, "power");
    record.searches =
        std::ranges::any_of(module.implicit, [](const ImplicitBlock& block) { return block.follows && !block.angles; });
    if (!rests_on_values(checked.report.mechanics.regularity)) return record;
    record.decided_for = parameters;
    record.proved_for = proved_values(checked, module.form);
    return record;
}

void add_model(ContentHash& hash, const Model& model)
{
    hash.add(lines_of_code(model.file->text, "#"));
    for (const auto& file : model.included) hash.add(lines_of_code(file->text, "#"));
    for (const Size& size : model.sizes) hash.add(size.name).add(std::to_string(size.value));
    if (std::ranges::any_of(model.parameters, &Parameter::bound))
        for (const Parameter& parameter : model.parameters)
            hash.add(parameter.bound ? "constant" : "").add(to_text(parameter.value));
}

bool add_scene(ContentHash& hash, const Model& model, const Scene& scene)
{
    bool whole = true;
    const auto add_tree = [&](const std::string& name, const Tree& tree) {
        const std::string text = tree == nullptr ? "" : to_text(tree);
        whole = whole && !text.ends_with("...");
        hash.add(name).add(text);
    };
    const auto add_all = [&](const char* what, const std::vector<NamedTree>& trees) {
        hash.add(what).add(std::to_string(trees.size()));
        for (const NamedTree& tree : trees) add_tree(tree.name, tree.value);
    };
    hash.add(scene.form).add(scene.stepped_by).add(model.discrete ? model.discrete->scheme : "");
    add_all(scene.observe ? "observe" : "all", scene.observe.value_or(std::vector<NamedTree>()));
    add_all("plot", plot_coordinates(scene));
    add_all(scene.input_table ? "table" : "inputs", scene.inputs);
    hash.add(std::to_string(scene.events.size()));
    for (const Event& event : scene.events) {
        add_tree(event.name, event.when);
        add_all("jump", event.jump);
    }
    add_tree("time scale", scene.time_scale);
    for (const FirstOrderState& state : model.states) add_tree(state.symbol.name, state.rate); // commands add some
    return whole;
}

std::string kept_file(ContentHash hash)
try {
    hash.add(std::string(first_line));
    add_lagen(hash);
    add_compilation(hash);
    return fmt::format("{}/{}.run", cache_folder(), hash.hex32());
} catch (const MachineError&) {
    return "";
}

std::optional<RunRecord> find_record(const std::string& file)
{
    std::optional<RunRecord> record = kept<RunRecord>(file, first_line);
    // Compiled code is only ever run from the folder of the record.
    if (!record || fs::path(record->program).parent_path() != fs::path(file).parent_path()) return std::nullopt;
    return use_cached(record->program) ? record : std::nullopt;
}

void keep_record(const std::string& file, const RunRecord& record)
{
    keep(file, first_line, record);
}

bool is_decided_for(const RunRecord& record, const std::vector<long double>& parameters)
{
    return record.decided_for.empty() || record.decided_for == parameters;
}

bool is_proved_for(const RunRecord& record, const Model& model, const std::vector<long double>& parameters)
{
    constexpr long double nearly = 1.0L / proved_value_parts;
    const std::vector<Symbol> symbols = free_parameters(model);
    for (const std::string& each : record.proved_for) {
        const auto symbol = std::ranges::find(symbols, each.substr(0, each.find(" = ")), &Symbol::name);
        const auto k = static_cast<std::size_t>(symbol - symbols.begin());
        const long double value = record.decided_for.at(k);
        if (!(std::fabs(parameters.at(k) - value) < nearly * (value == 0 ? 1 : std::fabs(value)))) return false;
    }
    return true;
}

} // namespace lagen
