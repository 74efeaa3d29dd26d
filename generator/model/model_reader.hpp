// SPDX-License-Identifier: GPL-2.0-or-later
/// The stages of reading a model, in the order in which read_model calls them: names are declared first, so that
/// expressions may use what stands later in the file.
#pragma once

#include "model/model.hpp"
#include "model/names.hpp"
#include "model/read_model.hpp"
#include "model/toml_document.hpp"

#include <initializer_list>

namespace lagen {

/// A model in the making.
struct ModelReader {
    Model model;
    Names names;
    std::vector<std::pair<Excerpt, Tree>> casimirs;    ///< as parsed
    std::vector<std::pair<Excerpt, Tree>> observables; ///< as parsed
    std::vector<std::pair<Excerpt, Tree>> invariants;  ///< as parsed
    Tree lagrangian;                                   ///< as parsed; null where absent
    Scope observer; ///< the model's scope with momenta, observables, invariants and built-in quantities

    /// The closed form of `tree`, in which only names of the given roles may occur (others: ModelError). `what` is the
    /// subject of the message: "the value of parameter 'm'".
    [[nodiscard]] Tree close(const Tree& tree, std::initializer_list<Role> roles, const std::string& what) const;
    /// The same in the observer's scope, where min max sign if are legal and every role is.
    [[nodiscard]] Tree close_observed(const Tree& tree) const { return observer.close(tree, true); }
};

// Declarations (no expression is closed yet).
void read_header(ModelReader& reader, const TomlEntry* name, const TomlEntry* title, const std::string& file_name);
void declare_parameters(ModelReader& reader, const TomlEntry* block);
void declare_base(ModelReader& reader, const TomlEntry* block);
void read_algebroid_kind(ModelReader& reader, const TomlEntry* block);
void declare_fibre(ModelReader& reader, const TomlEntry* block);
void declare_definitions(ModelReader& reader, const TomlEntry* block);
void declare_quantities(ModelReader& reader, const TomlEntry* observables, const TomlEntry* invariants,
                        const TomlEntry* lagrangian);
void build_scopes(ModelReader& reader);

// Expressions.
void read_parameters(ModelReader& reader, const TomlEntry* block, const std::vector<Setting>& settings);
void read_base(ModelReader& reader, const TomlEntry* block);
void read_algebroid(ModelReader& reader, const TomlEntry* block);
void read_quantities(ModelReader& reader);
void read_about(ModelReader& reader, const TomlEntry* block);
void read_scenes(ModelReader& reader, const TomlEntry* block, const std::vector<Setting>& settings);
void read_scene_events(const ModelReader& reader, Scene& scene, const TomlEntry& block);

/// Index of `name` among `symbols`, or symbols.size().
[[nodiscard]] std::size_t index_of(const std::vector<Symbol>& symbols, const std::string& name);
[[nodiscard]] std::vector<std::string> names_of(const std::vector<Symbol>& symbols);

/// Throws ModelError where parameters depend on each other in a cycle, which is listed.
void require_acyclic(const std::vector<NamedTree>& parameters);

} // namespace lagen
