// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen models`: the example models, with their scenes.
#include "commands/line/command.hpp"
#include "commands/line/options.hpp"
#include "elaborate/make_frame.hpp"
#include "machine/places.hpp"
#include "machine/write_file.hpp"
#include "text/comma_list.hpp"
#include "text/record.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>

namespace lagen {

namespace {

const CommandSyntax models_syntax{"models", "", "Lists the example models and their scenes.", {option::format}};

std::vector<std::string> model_files(const std::string& folder)
{
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".toml") files.push_back(entry.path().string());
    std::sort(files.begin(), files.end());
    return files;
}

Record record_of(const std::string& file, const Model& model)
{
    return {{"model", model.name},
            {"title", model.title},
            {"file", file},
            {"scenes", list_of(model.scenes, [](const Scene& scene) { return scene.name; })}};
}

std::string model_line(const Model& model, std::size_t width)
{
    return fmt::format("  {:<{}}  {} [{}]\n", model.name, width, model.title, comma_list(model.scenes, &Scene::name));
}

} // namespace

ExitCode run_models(Arguments arguments)
{
    const Options options(models_syntax, arguments);
    if (options.help()) return ExitCode::done;
    const bool as_json = options.as_json();
    const std::string folder = models_folder();
    if (folder.empty()) throw MachineError("the example models were not found", "set LAGEN_MODELS to their folder");
    Record records = Record::array();
    std::vector<Model> models;
    std::size_t longest = 0;
    for (const std::string& file : model_files(folder)) {
        models.push_back(read_model(file, {}, choosers()));
        longest = std::max(longest, models.back().name.size());
        records.push_back(record_of(file, models.back()));
    }
    std::string text = fmt::format("in {}:\n", folder);
    for (const Model& model : models) text += model_line(model, longest);
    write_standard_output(as_json ? to_json(records) + "\n" : text);
    return ExitCode::done;
}

} // namespace lagen
