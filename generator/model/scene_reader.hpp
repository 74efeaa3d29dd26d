// SPDX-License-Identifier: GPL-2.0-or-later
/// The parts of reading a scene.
#pragma once

#include "model/model_reader.hpp"
#include "model/table_reader.hpp"

#include <functional>

namespace lagen {

/// What `block` says, on top of `scene` (empty, or the scene that it is like). Parameters set on the command line win
/// over the scene's.
[[nodiscard]] Scene read_scene(const ModelReader& reader, Scene scene, const TomlEntry& block,
                               const std::vector<Setting>& settings);

/// Runs `read`. A mistake in any scene keeps the whole model from being read, so that its message says which it is.
void saying_which(const std::string& scene, const std::function<void()>& read);

/// [scene.NAME.plot] of every scene, in the order of the blocks.
void read_plots(ModelReader& reader, const std::vector<TomlEntry>& blocks);

void read_initial(const ModelReader& reader, Scene& scene, const TomlEntry& block);
/// `element`, `next` and `steps`.
void read_first_arrow(const ModelReader& reader, Scene& scene, TableReader& table);
void read_scene_parameters(const ModelReader& reader, Scene& scene, const TomlEntry& block);

/// `inputs`: values over the state, or the path of a table.
void read_scene_inputs(const ModelReader& reader, Scene& scene, const TomlEntry& entry);

/// Throws ModelError unless `initial` has every base coordinate, and every fibre coordinate or every momentum.
void require_complete(const ModelReader& reader, const Scene& scene);

/// Of a discrete scene: throws ModelError unless `initial` has every base coordinate, and the first arrow is given, or
/// every momentum, or (where there is a Lagrangian) every fibre coordinate.
void require_first_arrow(const ModelReader& reader, const Scene& scene);

/// Throws ModelError where the scene's parameter values close a cycle.
void require_acyclic_scene(const ModelReader& reader, const Scene& scene);

/// A closed expression over parameters.
[[nodiscard]] Tree over_parameters(const ModelReader& reader, const TomlValue& value, const std::string& what);

} // namespace lagen
