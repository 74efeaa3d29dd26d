// SPDX-License-Identifier: GPL-2.0-or-later
#include "support/constrained_case.hpp"

#include "support/json.hpp"

#include <algorithm>
#include <filesystem>

namespace lagen {

namespace {

namespace fs = std::filesystem;

ConstrainedCase read_case(const json::Value& file)
{
    const json::Value &model = file["model"], &ambient = model["ambient"];
    ConstrainedCase constrained;
    constrained.reference = read_reference_case(file, ambient);
    constrained.reference.fibre = model["fibre"].texts();
    constrained.ambient = ambient["fibre"].texts();
    for (const json::Value& row : model["sections"].entries) constrained.sections.push_back(row.texts());
    if (model.has("drift")) constrained.drift = model["drift"].texts();
    constrained.constraints = model["constraints"].texts();
    for (const json::Value& point : file["points"].entries)
        constrained.points.push_back({point["ambient_velocity"].texts(), point["reaction"].texts(),
                                      point[point.has("moving_energy") ? "moving_energy" : "energy"].text});
    constrained.bracket = file["integrable"]["bracket"].texts();
    return constrained;
}

std::string quoted_list(const std::vector<std::string>& texts)
{
    std::string list;
    for (const std::string& text : texts) list += (list.empty() ? "\"" : ", \"") + text + "\"";
    return "[" + list + "]";
}

/// "{ Y = 'value', .. }" of the entries that are not 0.
std::string table_of(const std::vector<std::string>& names, const std::vector<std::string>& values)
{
    std::string table;
    for (std::size_t a = 0; a < values.size(); ++a)
        if (values[a] != "0") table += (table.empty() ? " " : ", ") + names[a] + " = \"" + values[a] + "\"";
    return "{" + table + " }";
}

} // namespace

std::vector<ConstrainedCase> read_constrained_cases()
{
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(fs::path(LAGEN_SOURCE_DIR) / "tests" / "data" / "nonholonomic"))
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::vector<ConstrainedCase> cases;
    for (const fs::path& file : files) cases.push_back(read_case(json::read_file(file.string())));
    return cases;
}

std::string model_text(const ConstrainedCase& constrained)
{
    ReferenceCase ambient = constrained.reference; // whose [algebroid] is that of [algebroid.of]
    ambient.fibre = constrained.ambient;
    ambient.lagrangian.clear();
    ambient.initial.clear();
    std::string text = model_text(ambient);
    const auto replace = [&](const std::string& old, const std::string& with) {
        for (std::size_t at = text.find(old); at != std::string::npos; at = text.find(old, at + with.size()))
            text.replace(at, old.size(), with);
    };
    const std::string fibre = "[fibre]\ncoordinates = " + quoted_list(constrained.ambient) + "\n";
    replace(fibre, "[fibre]\ncoordinates = " + quoted_list(constrained.reference.fibre) + "\n");
    replace("[algebroid.", "[algebroid.of.");
    std::string head = "[algebroid]\nkind = \"nonholonomic\"\n";
    head += "constraints = " + quoted_list(constrained.constraints) + "\n";
    if (!constrained.drift.empty()) head += "drift = " + table_of(constrained.ambient, constrained.drift) + "\n";
    head += "[algebroid.sections]\n";
    for (std::size_t alpha = 0; alpha < constrained.sections.size(); ++alpha)
        head += constrained.reference.fibre[alpha] + " = " +
                table_of(constrained.ambient, constrained.sections[alpha]) + "\n";
    head += "[algebroid.of]\nfibre = " + quoted_list(constrained.ambient) + "\nkind = \"general\"\n";
    replace("[algebroid]\nkind = \"general\"\n", head);
    text += "[lagrangian]\nL = \"" + constrained.reference.lagrangian + "\"\n\n[scene.default]\n";
    std::vector<std::string> names = constrained.reference.base;
    names.insert(names.end(), constrained.reference.fibre.begin(), constrained.reference.fibre.end());
    text += "initial = {";
    for (std::size_t k = 0; k < names.size(); ++k)
        text += (k == 0 ? " " : ", ") + names[k] + " = \"" + constrained.reference.initial[k] + "\"";
    text += " }\nobserve = " + quoted_list(names) + "\nduration = " + constrained.reference.t_end + "\nat = [";
    for (const ReferenceSample& sample : constrained.reference.samples)
        text += (text.back() == '[' ? "" : ", ") + sample.t;
    return text + "]\n";
}

} // namespace lagen
