// SPDX-License-Identifier: GPL-2.0-or-later
/// Reading the model file that `of` names, relative to the file that names it.
#include "model/algebroid_draft.hpp"

#include "model/read_file.hpp"
#include "model/read_values.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace lagen {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_files = 64;

/// The same text for the same file, however it is spelled.
std::string identity_of(const fs::path& path)
{
    std::error_code error;
    const fs::path whole = fs::weakly_canonical(path, error);
    return error ? path.lexically_normal().string() : whole.string();
}

void require_no_cycle(const IncludeTrail& trail, const std::string& identity, const SourceRange& where)
{
    const auto first = std::ranges::find(trail.open, identity);
    if (first == trail.open.end()) return;
    std::string cycle;
    for (auto each = first; each != trail.open.end(); ++each) cycle += fs::path(*each).filename().string() + " -> ";
    throw ModelError(
        fmt::format("the models include each other in a cycle: {}{}", cycle, fs::path(identity).filename().string()),
        where, "a file may not be part of itself");
}

/// Bytes of a file that must be there; messages point at the text that names it.
std::string content_of(const fs::path& path, const SourceRange& where)
{
    std::error_code error;
    if (fs::exists(path, error) && !fs::is_regular_file(path, error) && !fs::is_directory(path, error)) {
        throw ModelError(fmt::format("{} is not a regular file", quote(path.string())), where);
    }
    try {
        return read_file(path.string());
    } catch (const ModelError& failure) {
        throw ModelError(failure.diagnostic().message, where, "'of' is relative to the file that it stands in");
    }
}

/// Settings of the command line and sizes of the including model that the file has as sizes of its own.
std::vector<Setting> size_settings(const ModelReader& reader, const std::shared_ptr<const SourceFile>& file)
{
    std::vector<Setting> out;
    const TomlValue document = parse_toml(file);
    const TomlEntry* sizes = find_entry(document, "sizes");
    if (sizes == nullptr) return out;
    for (const TomlEntry& size : sizes->value.entries) {
        for (const Size& outer : reader.model.sizes)
            if (outer.name == size.name())
                out.push_back({outer.name, whole_text("<sizes>", std::to_string(outer.value))});
        for (const Setting& setting : *reader.settings)
            if (setting.name == size.name()) out.push_back(setting);
    }
    return out;
}

void list_once(std::vector<std::shared_ptr<const SourceFile>>& files, const std::shared_ptr<const SourceFile>& file)
{
    const auto same = [&](const auto& each) { return each->name == file->name; };
    if (std::ranges::none_of(files, same)) files.push_back(file);
}

} // namespace

std::size_t include_model(ModelReader& reader, const TomlValue& of)
{
    const fs::path name = read_text(of, "an entry of 'of'");
    if (name.empty()) throw ModelError("'of' names no file", of.where);
    const fs::path path = (fs::path(reader.model.file->name).parent_path() / name).lexically_normal();
    IncludeTrail& trail = *reader.trail;
    if (trail.open.empty()) trail.open.push_back(identity_of(reader.model.file->name));
    const std::string identity = identity_of(path);
    require_no_cycle(trail, identity, of.where);
    if (++trail.read > most_files) {
        throw ModelError(fmt::format("the model includes more than {} files", most_files), of.where);
    }
    auto file = std::make_shared<const SourceFile>(SourceFile{path.string(), content_of(path, of.where)});
    trail.open.push_back(identity);
    IncludedModel included;
    included.of = &of;
    included.model = read_model_text(file->name, file->text, size_settings(reader, file), trail);
    trail.open.pop_back();
    const Scope& scope = included.model.scope;
    const auto is_pi = [](const Definition& definition) { return definition.name == "pi"; };
    const bool has_pi = scope.has_symbol("pi") || scope.find_family("pi") || scope.find_size("pi").has_value() ||
                        std::ranges::any_of(included.model.definitions, is_pi);
    if (!has_pi) included.renamed.emplace("pi", constant_pi()); // whatever the including model calls pi
    list_once(reader.model.included, included.model.file);
    for (const auto& each : included.model.included) list_once(reader.model.included, each);
    reader.included.push_back(std::move(included));
    return reader.included.size() - 1;
}

} // namespace lagen
