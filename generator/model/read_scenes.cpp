// SPDX-License-Identifier: GPL-2.0-or-later
/// All [scene.NAME] blocks. `like` is resolved here: a scene starts as a copy of the one that it is like.
#include "model/scene_reader.hpp"

#include "model/read_values.hpp"
#include "model/table_reader.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace lagen {

namespace {

constexpr std::size_t most_scenes = 200; // scenes are copied along 'like'

/// The scene blocks by name, and which of them are read already.
struct SceneBlocks {
    const std::vector<TomlEntry>& entries;
    std::vector<std::string> names;
    std::vector<std::optional<Scene>> done;

    [[nodiscard]] std::size_t index(const std::string& name) const
    {
        return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
    }
};

void require_name(const TomlEntry& entry)
{
    TomlValue name;
    name.kind = TomlKind::string;
    name.where = entry.where();
    name.text = entry.key;
    if (read_text(name, "a scene's name").empty()) throw ModelError("a scene has an empty name", entry.where());
}

/// The index of the scene that `k` is like, if it is like one.
std::optional<std::size_t> liked_by(const SceneBlocks& blocks, std::size_t k)
{
    const std::string& name = blocks.names[k];
    TableReader fields(blocks.entries[k].value, fmt::format("[scene.{}]", name));
    const TomlEntry* like = fields.take("like");
    if (like == nullptr) return std::nullopt;
    const std::string target = read_text(like->value, fmt::format("'like' of scene '{}'", name));
    const std::size_t found = blocks.index(target);
    if (found < blocks.names.size()) return found;
    throw ModelError(fmt::format("scene '{}' is like '{}', which is no scene", name, target), like->value.where,
                     hint_for(target, blocks.names, "scenes"));
}

/// Scene `first` and everything that it is like, the last of the chain first.
void read_chain(const ModelReader& reader, SceneBlocks& blocks, std::size_t first, const std::vector<Setting>& settings)
{
    std::vector<std::size_t> chain;
    std::optional<std::size_t> next = first;
    while (next && !blocks.done[*next]) {
        if (std::find(chain.begin(), chain.end(), *next) != chain.end()) {
            throw ModelError(fmt::format("scene '{}' is like itself, through 'like'", blocks.names[*next]),
                             blocks.entries[*next].where());
        }
        chain.push_back(*next);
        next = liked_by(blocks, *next);
    }
    Scene scene;
    if (next) scene = *blocks.done[*next];
    for (; !chain.empty(); chain.pop_back()) {
        const TomlEntry& block = blocks.entries[chain.back()];
        saying_which(block.name(), [&] { scene = read_scene(reader, std::move(scene), block, settings); });
        blocks.done[chain.back()] = scene;
    }
}

} // namespace

void saying_which(const std::string& scene, const std::function<void()>& read)
{
    try {
        read();
    } catch (const ModelError& error) {
        Diagnostic diagnostic = error.diagnostic();
        const std::string& message = diagnostic.message;
        const bool says = message.find("scene '" + scene + "'") != std::string::npos ||
                          message.find("[scene." + scene) != std::string::npos;
        if (says) throw;
        diagnostic.message = fmt::format("scene '{}': {}", scene, diagnostic.message);
        throw ModelError(diagnostic);
    }
}

void read_scenes(ModelReader& reader, const TomlEntry* block, const std::vector<Setting>& settings)
{
    if (block == nullptr) return;
    const TableReader table(block->value, "[scene]");
    SceneBlocks blocks{block->value.entries, {}, {}};
    if (blocks.entries.size() > most_scenes) {
        throw ModelError(fmt::format("the model has {} scenes, more than {}", blocks.entries.size(), most_scenes),
                         block->where());
    }
    for (const TomlEntry& entry : blocks.entries) {
        require_name(entry);
        blocks.names.push_back(entry.name());
    }
    blocks.done.resize(blocks.entries.size());
    for (std::size_t k = 0; k < blocks.entries.size(); ++k) read_chain(reader, blocks, k, settings);
    for (std::optional<Scene>& scene : blocks.done) reader.model.scenes.push_back(std::move(*scene));
    read_plots(reader, blocks.entries);
}

} // namespace lagen
