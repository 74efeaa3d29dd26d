// SPDX-License-Identifier: GPL-2.0-or-later
/// The parts of reading a scene, and the values that its tables give and leave out.
#pragma once

#include "model/families.hpp"

#include <set>

namespace lagen {

/// Replaces the entries of the same names, appends the others.
void put_all(std::vector<NamedTree>& list, std::vector<NamedTree> entries);

/// Symbols without a value; a family that has none at all by its name.
struct Missing {
    std::size_t count = 0; ///< of symbols
    std::vector<std::string> names;

    void add(const Missing& more);
    [[nodiscard]] std::string text() const;
};

[[nodiscard]] Missing missing_of(const std::vector<Symbol>& symbols, const std::set<std::string>& given);

/// The names of the entries.
[[nodiscard]] std::set<std::string> given_names(const std::vector<NamedTree>& entries);

/// The scene of `block`, on top of `scene` (empty, or the scene that it is like). Parameters set on the command line
/// win over the scene's.
[[nodiscard]] Scene read_scene(const ModelReader& reader, Scene scene, const Item& block);
void read_scene_events(const ModelReader& reader, Scene& scene, const Item& block);
/// `element`, `next` and `steps`.
void read_first_arrow(const ModelReader& reader, Scene& scene, const Item& block);
/// In a discrete scene: throws ModelError unless `initial` has every base coordinate, and the first arrow is given, or
/// every momentum, or (where there is a Lagrangian) every fibre coordinate.
void require_first_arrow(const ModelReader& reader, const Scene& scene);

/// Base coordinates, fibre coordinates, momenta and first-order states: what a start and a jump may set.
[[nodiscard]] std::vector<Symbol> settable_symbols(const Model& model);
/// The values of a table by names of these.
[[nodiscard]] std::vector<NamedTree> read_given(const ModelReader& reader, const Item& table,
                                                const std::vector<Symbol>& symbols, const char* noun,
                                                const ModelReader::Hint& hint = {});

/// Runs `read`. A mistake in any scene keeps the whole model from being read, so that its message says which it is.
void saying_which(const std::string& scene, const std::function<void()>& read);

/// [scene.NAME.plot] of every scene, in the order of the blocks.
void read_plots(ModelReader& reader, const std::vector<Item>& blocks);

} // namespace lagen
