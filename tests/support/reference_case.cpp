// SPDX-License-Identifier: GPL-2.0-or-later
#include "support/reference_case.hpp"

#include "support/json.hpp"

#include <algorithm>
#include <filesystem>
#include <sstream>

namespace lagen {

namespace {

namespace fs = std::filesystem;

const fs::path data_folder = fs::path(LAGEN_SOURCE_DIR) / "tests" / "data";

std::vector<std::vector<std::string>> read_rows(const json::Value& value)
{
    std::vector<std::vector<std::string>> rows;
    for (const json::Value& row : value.entries) rows.push_back(row.texts());
    return rows;
}

std::vector<ReferenceBracket> read_brackets(const json::Value& value)
{
    const auto index = [](const json::Value& entry) { return static_cast<std::size_t>(std::stoul(entry.text)) - 1; };
    std::vector<ReferenceBracket> brackets;
    for (const json::Value& entry : value.entries)
        brackets.push_back({index(entry[0]), index(entry[1]), index(entry[2]), entry[3].text});
    return brackets;
}

} // namespace

ReferenceCase read_reference_case(const json::Value& file, const json::Value& model)
{
    ReferenceCase reference;
    reference.name = file["name"].text;
    reference.description = file["description"].text;
    reference.base = model["base"].texts();
    reference.fibre = model["fibre"].texts();
    reference.rho = read_rows(model["rho"]);
    reference.brackets = read_brackets(model["C"]);
    reference.lagrangian = model["lagrangian"].text;
    for (const std::string& name : file["model"]["parameters"].texts())
        reference.parameters.emplace_back(name, file["parameters"][name].text);
    reference.t0 = file["t0"].text;
    reference.t_end = file["t_end"].text;
    reference.initial = file["initial_state"].texts();
    for (const json::Value& sample : file["samples"].entries)
        reference.samples.push_back({sample["t"].text, sample["state"].texts(), {}});
    for (const json::Value& point : file["points"].entries)
        reference.points.push_back({point["state"].texts(), point["state_dot"].texts(), point["momenta"].texts(),
                                    point["energy"].text, point["momenta_dot"].texts()});
    return reference;
}

namespace {

ReferenceCase read_algebroid(const json::Value& entry, const std::string& name)
{
    ReferenceCase algebroid;
    algebroid.name = name;
    algebroid.base = entry["base"].texts();
    for (unsigned long a = 1; a <= std::stoul(entry["rank"].text); ++a)
        algebroid.fibre.push_back("e" + std::to_string(a));
    algebroid.rho = read_rows(entry["rho"]);
    algebroid.brackets = read_brackets(entry["C"]);
    return algebroid;
}

ReferenceDefinition read_definition(const json::Value& entry)
{
    ReferenceDefinition definition;
    definition.algebroid = read_algebroid(entry, entry["id"].text);
    for (const std::string& name : entry["parameters"].texts()) definition.algebroid.parameters.emplace_back(name, "1");
    definition.valid = entry["truth"].text == "valid";
    definition.failing = entry["failing"].texts();
    return definition;
}

std::string name_list(const std::vector<std::string>& names)
{
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "\"" : ", \"") + name + "\"";
    return "[" + text + "]";
}

/// "a = { x = 'value', ... }" for each key that has entries.
void write_entries(std::ostringstream& out, const std::string& key,
                   const std::vector<std::pair<std::string, std::string>>& entries)
{
    if (entries.empty()) return;
    out << key << " = {";
    for (std::size_t k = 0; k < entries.size(); ++k)
        out << (k == 0 ? " " : ", ") << entries[k].first << " = \"" << entries[k].second << '"';
    out << " }\n";
}

void write_algebroid(std::ostringstream& out, const ReferenceCase& reference)
{
    out << "[algebroid]\nkind = \"general\"\n\n[algebroid.anchor]\n";
    for (std::size_t a = 0; a < reference.fibre.size(); ++a) {
        std::vector<std::pair<std::string, std::string>> entries;
        for (std::size_t i = 0; i < reference.base.size(); ++i)
            if (reference.rho[i][a] != "0") entries.emplace_back(reference.base[i], reference.rho[i][a]);
        write_entries(out, reference.fibre[a], entries);
    }
    out << "\n[algebroid.bracket]\n";
    std::vector<std::string> done;
    for (const ReferenceBracket& bracket : reference.brackets) {
        const std::string key = "\"" + reference.fibre[bracket.a] + "," + reference.fibre[bracket.b] + "\"";
        if (std::find(done.begin(), done.end(), key) != done.end()) continue;
        done.push_back(key);
        std::vector<std::pair<std::string, std::string>> entries;
        for (const ReferenceBracket& other : reference.brackets)
            if (other.a == bracket.a && other.b == bracket.b)
                entries.emplace_back(reference.fibre[other.c], other.value);
        write_entries(out, key, entries);
    }
    out << '\n';
}

bool is_relativistic(const ReferenceCase& reference)
{
    return reference.name.find("relativistic") != std::string::npos;
}

/// Inertias, weights, the speed of light: H has a maximum in the controls, or L a Legendre transform, where they are
/// positive.
void write_positive_parameters(std::ostringstream& out, const ReferenceCase& reference)
{
    std::vector<std::string> conditions;
    for (const auto& [name, value] : reference.parameters)
        if (value.find_first_of("123456789") != std::string::npos && value.find('-') == std::string::npos)
            conditions.push_back(name + " > 0");
    out << "domain = " << name_list(conditions) << '\n';
}

/// [control], where the case is a control problem.
void write_control(std::ostringstream& out, const ReferenceCase& reference)
{
    if (reference.controls.empty()) return;
    out << "[control]\ncontrols = " << name_list(reference.controls) << "\ncost = \"" << reference.cost << "\"\n";
    std::vector<std::pair<std::string, std::string>> sigma;
    for (std::size_t a = 0; a < reference.fibre.size(); ++a)
        if (reference.sigma.at(a) != "0") sigma.emplace_back(reference.fibre[a], reference.sigma[a]);
    write_entries(out, "sigma", sigma);
    out << '\n';
}

/// All states of the case are observed, so that every form of the equations gives the same columns.
void write_scene(std::ostringstream& out, const ReferenceCase& reference)
{
    out << "[scene.default]\n";
    std::vector<std::string> names = reference.base;
    const std::vector<std::string>& others = reference.controls.empty() ? reference.fibre : reference.momenta;
    names.insert(names.end(), others.begin(), others.end());
    std::vector<std::string> observed = names;
    observed.insert(observed.end(), reference.controls.begin(), reference.controls.end());
    out << "observe = " << name_list(observed) << '\n';
    std::vector<std::pair<std::string, std::string>> initial;
    for (std::size_t k = 0; k < names.size(); ++k) initial.emplace_back(names[k], reference.initial.at(k));
    write_entries(out, "initial", initial);
    out << "start = \"" << reference.t0 << "\"\nduration = \"" << reference.t_end << " - (" << reference.t0 << ")\"\n";
}

} // namespace

std::vector<ReferenceCase> read_reference_cases()
{
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(data_folder / "continuous")) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::vector<ReferenceCase> cases;
    for (const fs::path& file : files) {
        const json::Value read = json::read_file(file.string());
        cases.push_back(read_reference_case(read, read["model"]));
    }
    return cases;
}

std::string model_text(const ReferenceCase& reference)
{
    std::ostringstream out;
    out << "name = \"" << reference.name << "\"\n\n[parameters]\n";
    for (const auto& [name, value] : reference.parameters) out << name << " = \"" << value << "\"\n";
    if (!reference.base.empty()) out << "\n[base]\ncoordinates = " << name_list(reference.base) << '\n';
    if (!reference.base.empty() && (!reference.controls.empty() || is_relativistic(reference)))
        write_positive_parameters(out, reference);
    out << "\n[fibre]\ncoordinates = " << name_list(reference.fibre) << '\n';
    if (!reference.momenta.empty()) out << "momenta = " << name_list(reference.momenta) << '\n';
    out << '\n';
    write_algebroid(out, reference);
    if (!reference.lagrangian.empty()) out << "[lagrangian]\nL = \"" << reference.lagrangian << "\"\n\n";
    write_control(out, reference);
    if (!reference.initial.empty()) write_scene(out, reference);
    return out.str();
}

std::vector<ReferenceDefinition> read_reference_definitions()
{
    std::vector<ReferenceDefinition> definitions;
    const json::Value file = json::read_file((data_folder / "definitions" / "definitions.json").string());
    for (const json::Value& entry : file.entries) definitions.push_back(read_definition(entry));
    return definitions;
}

std::vector<ReferenceCase> read_control_cases()
{
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(data_folder / "bvp")) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::vector<ReferenceCase> cases;
    for (const fs::path& path : files) {
        const json::Value file = json::read_file(path.string());
        const json::Value& model = file["model"];
        ReferenceCase reference;
        reference.name = file["name"].text;
        reference.description = file["description"].text;
        reference.base = model["base"].texts();
        reference.momenta = model["momenta"].texts();
        for (const std::string& momentum : reference.momenta) reference.fibre.push_back("y_" + momentum);
        reference.rho = read_rows(model["rho"]);
        reference.brackets = read_brackets(model["C"]);
        reference.controls = model["controls"].texts();
        reference.sigma = model["sigma"].texts();
        reference.cost = model["cost"].text;
        reference.hamiltonian = file["invariants"][0]["value"].text;
        for (const std::string& name : model["parameters"].texts())
            reference.parameters.emplace_back(name, file["parameters"][name].text);
        for (const json::Value& sample : file["samples"].entries)
            reference.samples.push_back({sample["t"].text, sample["state"].texts(), sample["u"].texts()});
        reference.t0 = reference.samples.front().t;
        reference.t_end = reference.samples.back().t;
        reference.initial = reference.samples.front().state;
        cases.push_back(std::move(reference));
    }
    return cases;
}

std::vector<ReferenceCase> read_morphism_algebroids()
{
    std::vector<ReferenceCase> algebroids;
    const json::Value file = json::read_file((data_folder / "definitions" / "morphisms.json").string());
    for (const json::Value& entry : file.entries)
        for (const char* side : {"source", "target"})
            algebroids.push_back(read_algebroid(entry[side], entry["id"].text + "_" + side));
    return algebroids;
}

} // namespace lagen
