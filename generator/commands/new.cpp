// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen new`: a commented model to start from.
#include "commands/line/command.hpp"
#include "commands/line/options.hpp"
#include "machine/places.hpp"
#include "machine/write_file.hpp"
#include "model/schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

namespace lagen {

namespace {

namespace fs = std::filesystem;

/// KIND.toml in the folder `new` of the example models; what lies in KIND/ there is written beside it as NAME_*.toml.
constexpr std::array template_kinds{"tangent",      "lie_algebra", "action",   "general",      "subbundle",
                                    "atiyah",       "level_set",   "frame",    "nonholonomic", "product",
                                    "prolongation", "first_order", "discrete", "control"};

const std::string kind_help =
    fmt::format("{} or {}", fmt::join(template_kinds.begin(), template_kinds.end() - 1, ", "), template_kinds.back());

const CommandSyntax new_syntax{"new",
                               "NAME",
                               "Writes NAME.toml, a commented model of some kind to start from, into the current "
                               "folder, and lagen.schema.json for editors where there is none. Never overwrites a "
                               "file.",
                               {{"kind", "KIND", kind_help.c_str(), "tangent"}}};

constexpr const char* schema_file = "lagen.schema.json"; ///< editors look for it beside the model

/// The text of a template, whose NAME is the name of the model.
std::string filled(const fs::path& file, const std::string& name)
{
    std::string text = content_of_file(file.string());
    constexpr std::string_view place = "NAME";
    for (std::size_t at = 0; (at = text.find(place, at)) != std::string::npos; at += name.size())
        text.replace(at, place.size(), name);
    return text;
}

std::string first_lines(const std::string& name, const std::string& kind)
{
    return fmt::format("#:schema {2}\n"
                       "# Made by `lagen new {0} --kind {1}`. Next:\n"
                       "#   lagen check {0}.toml\n#   lagen derive {0}.toml\n"
                       "#   lagen run {0}.toml -o {0}.csv --plot {0}.svg\n#\n",
                       name, kind, schema_file);
}

} // namespace

ExitCode run_new(Arguments arguments)
{
    const Options options(new_syntax, arguments);
    if (options.help()) return ExitCode::done;
    const std::string& name = options.positional()[0];
    const std::string kind = options.choice("kind", {template_kinds.begin(), template_kinds.end()});
    require_class_name(name, whole_text("<NAME>", name).range(0, name.size()), false);
    const fs::path folder = fs::path(models_folder()) / "new", parts = folder / kind;
    if (!fs::exists(folder))
        throw MachineError("the models to start from were not found",
                           "set LAGEN_MODELS to the folder of the example models, which has them in new/");
    std::vector<std::pair<std::string, std::string>> files{
        {name + ".toml", first_lines(name, kind) + filled(folder / (kind + ".toml"), name)}};
    if (fs::exists(parts))
        for (const auto& part : fs::directory_iterator(parts))
            files.emplace_back(name + "_" + part.path().filename().string(),
                               fmt::format("#:schema {}\n", schema_file) + filled(part.path(), name));
    std::sort(files.begin(), files.end());
    for (const auto& [file, text] : files)
        if (std::error_code ignored; fs::exists(fs::symlink_status(file, ignored)))
            throw UsageError(fmt::format("'{}' is there already, and is not overwritten", file));
    if (std::error_code ignored; !fs::exists(fs::symlink_status(schema_file, ignored)))
        files.emplace_back(schema_file, json_schema_text());
    std::string told;
    for (const auto& [file, text] : files) {
        write_file(file, text);
        told += file + "\n";
    }
    write_standard_output(told);
    return ExitCode::done;
}

} // namespace lagen
