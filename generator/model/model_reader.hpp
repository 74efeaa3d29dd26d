// SPDX-License-Identifier: GPL-2.0-or-later
/// The stages of reading a model, in the order in which read_model calls them: names are declared first, so that
/// expressions may use what stands later in the file.
#pragma once

#include "model/model.hpp"
#include "model/names.hpp"
#include "model/rate_names.hpp"
#include "model/read_model.hpp"
#include "model/toml_document.hpp"

#include <initializer_list>

namespace lagen {

/// The files that are being read: each includes the next by `of`. Shared by all readers of one read_model.
struct IncludeTrail {
    std::vector<std::string> open; ///< their paths, normalised
    std::size_t read = 0;          ///< how many have been read in all
    const Choosers* choosers = nullptr;
};

/// A file that `of` names, read as a model of its own. Its algebroid block is a leaf of the including model's.
struct IncludedModel {
    const TomlValue* of = nullptr; ///< the string that names it
    Model model;
    std::vector<std::size_t> base;          ///< its base coordinates among the model's
    std::map<std::string, Tree> renamed;    ///< names of the file that are others in the model
    std::map<std::string, Tree> velocities; ///< its fibre coordinates by the model's
    bool fibre_is_hidden = false;           ///< they are none of the model's names
};

struct AlgebroidDraft;

/// The blocks that make a mechanical system or a control problem of an algebroid; null where absent.
struct MechanicsBlocks {
    const TomlEntry* lagrangian = nullptr;
    const TomlEntry* hamiltonian = nullptr;
    const TomlEntry* forces = nullptr;
    const TomlEntry* dissipation = nullptr;
    const TomlEntry* control = nullptr;
};

/// A model in the making.
struct ModelReader {
    Model model;
    Names names;
    const std::vector<Setting>* settings = nullptr;
    IncludeTrail* trail = nullptr;
    bool is_probe = false;                  ///< read as far as its base alone, without a fibre
    bool is_tangent = false;                ///< of a probe: the algebroid is read as the tangent bundle of the base
    const TomlEntry* fibre = nullptr;       ///< the [fibre] block
    const TomlEntry* algebroid = nullptr;   ///< the [algebroid] block
    const TomlEntry* groupoid = nullptr;    ///< the [groupoid] block
    const TomlEntry* discrete = nullptr;    ///< the [discrete] block
    const TomlEntry* inputs = nullptr;      ///< the [inputs] block
    const TomlEntry* states = nullptr;      ///< the [states] block
    const TomlEntry* reconstruct = nullptr; ///< the [reconstruct] block
    std::shared_ptr<const AlgebroidDraft> draft;
    std::optional<std::vector<std::size_t>> own_constraints; ///< of a level set: those of [base] that are kept
    std::vector<IncludedModel> included;               ///< in the order of the file; the same file may stand here twice
    std::vector<std::string> parameter_names;          ///< what each entry of [parameters] declares: "m" for "m[1..7]"
    std::vector<std::pair<Excerpt, Tree>> casimirs;    ///< as parsed
    std::vector<std::pair<Excerpt, Tree>> observables; ///< as parsed
    std::vector<std::pair<Excerpt, Tree>> invariants;  ///< as parsed
    MechanicsBlocks mechanics;
    Tree lagrangian, hamiltonian, dissipation;    ///< as parsed; null where absent
    Tree discrete_lagrangian;                     ///< likewise
    std::vector<ComponentEntry> inherited_forces; ///< of included files, over the model's names
    std::vector<CoordinateRate> rates;            ///< once the entries of the algebroid are read
    Scope mechanical; ///< the model's scope with momenta, controls, inputs and first-order states
    Scope observer;   ///< the model's scope with momenta, observables, invariants and built-in quantities
    Scope arrows;     ///< the observer's with the coordinates of an arrow of the groupoid and the step

    /// The closed form of `tree`, in which only names of the given roles may occur (others: ModelError). `what` is the
    /// subject of the message: "the value of parameter 'm'".
    [[nodiscard]] Tree close(const Tree& tree, std::initializer_list<Role> roles, const std::string& what) const
    {
        return close_in(model.scope, tree, roles, what);
    }
    /// The same for an expression that may be a vector or a matrix.
    [[nodiscard]] ArrayValue close_array(const Tree& tree, std::initializer_list<Role> roles,
                                         const std::string& what) const
    {
        return close_array_in(model.scope, tree, roles, what, false);
    }
    /// The same for what may use momenta or controls; `nonsmooth`: min max sign if are legal.
    [[nodiscard]] Tree close_mechanical(const Tree& tree, std::initializer_list<Role> roles,
                                        const std::string& what) const
    {
        return close_in(mechanical, tree, roles, what);
    }
    [[nodiscard]] ArrayValue close_mechanical_array(const Tree& tree, std::initializer_list<Role> roles,
                                                    const std::string& what, bool nonsmooth) const
    {
        return close_array_in(mechanical, tree, roles, what, nonsmooth);
    }
    /// The same for what may use the coordinates of an arrow.
    [[nodiscard]] ArrayValue close_arrow(const Tree& tree, std::initializer_list<Role> roles,
                                         const std::string& what) const
    {
        return close_array_in(arrows, tree, roles, what, false);
    }
    /// The same in the observer's scope, where min max sign if are legal and every role is; of an array the
    /// coordinates of an arrow are too.
    [[nodiscard]] Tree close_observed(const Tree& tree) const { return observer.close(tree, true); }
    [[nodiscard]] ArrayValue close_observed_array(const Tree& tree) const { return arrows.close_array(tree, true); }

    /// The same in any scope.
    [[nodiscard]] ArrayValue close_array_in(const Scope& scope, const Tree& tree, std::initializer_list<Role> roles,
                                            const std::string& what, bool nonsmooth) const;

  private:
    [[nodiscard]] Tree close_in(const Scope& scope, const Tree& tree, std::initializer_list<Role> roles,
                                const std::string& what) const;
};

/// The model of a text that was reached by `trail`.
[[nodiscard]] Model read_model_text(const std::string& name, std::string text, const std::vector<Setting>& settings,
                                    IncludeTrail& trail);

// Declarations (no expression is closed yet).
void read_header(ModelReader& reader, const TomlEntry* name, const TomlEntry* title, const std::string& file_name);
void read_sizes(ModelReader& reader, const TomlEntry* block, const std::vector<Setting>& settings);
void declare_parameters(ModelReader& reader, const TomlEntry* block);
void declare_base(ModelReader& reader, const TomlEntry* block);
/// The kind and the group of [groupoid].
void declare_groupoid(ModelReader& reader);
/// The kinds of [algebroid] and its inner tables, their fibres and bases; what included files declare joins the model.
/// Where `block` is null the algebroid is that of the groupoid.
void read_algebroid_kind(ModelReader& reader, const TomlEntry* block);
/// The coordinates Y of a nonholonomic model. Throws ModelError for blocks that do not go with it.
void declare_ambient(ModelReader& reader);
/// Whether a nonholonomic model has `constraints` and no `sections`: its fibre coordinates are some of the Y then.
[[nodiscard]] bool has_constraints_alone(const ModelReader& reader);
/// Those that the chooser finds; nothing where there is none.
[[nodiscard]] std::optional<std::vector<Symbol>> chosen_coordinates(const ModelReader& reader);
/// Made by the reading's FrameMaker.
[[nodiscard]] LevelSetFrame frame_of_level_set(const ModelReader& reader, const LevelSetRequest& request);
/// The fibre coordinates are these Y. Throws ModelError.
void keep_coordinates(ModelReader& reader, const std::vector<Symbol>& names);
/// Throws ModelError where the model is nonholonomic: it has no such blocks.
void refuse_nonholonomic(const ModelReader& reader, const TomlEntry& block);
/// Names of the fibre coordinates where [fibre] leaves them out; nothing where the kind has no default.
[[nodiscard]] std::optional<std::vector<Symbol>> default_fibre(const ModelReader& reader);
/// Throws ModelError where the fibre has not as many coordinates as the kind of the algebroid requires.
void require_rank(const ModelReader& reader, const SourceRange& where);
void declare_fibre(ModelReader& reader, const TomlEntry* block);
void declare_definitions(ModelReader& reader, const TomlEntry* block);
void declare_control(ModelReader& reader);
/// `total_cost`, the last first-order state of a control problem, and `cost` in what observes; each where the model
/// does not have the name.
void declare_total_cost(ModelReader& reader);
void define_cost(ModelReader& reader);
/// The group of `entry`, a name, and its generators; `what` calls the entry in messages.
void read_named_group(const ModelReader& reader, GroupoidBlock& block, const TomlEntry& entry, const std::string& what);
/// The names of [inputs].
void declare_inputs(ModelReader& reader);
/// The names of [states] and of [reconstruct].
void declare_states(ModelReader& reader);
void declare_reconstructions(ModelReader& reader);
void declare_quantities(ModelReader& reader, const TomlEntry* observables, const TomlEntry* invariants);
/// The names of [forms].
void declare_forms(ModelReader& reader, const TomlEntry* block);
/// L, H and R, parsed.
void declare_mechanics(ModelReader& reader);
/// The step of [discrete], its scheme and its L, parsed; once mechanics is declared.
void declare_discrete(ModelReader& reader);
void build_scopes(ModelReader& reader);
/// The generators of the groupoid's group, and the coordinates of its arrows; called by build_scopes once parameters
/// and definitions can be closed.
void declare_arrows(ModelReader& reader);
/// The entries of [algebroid]; called by build_scopes once the model's scope has symbols and definitions. The inner
/// fibre coordinates of frames and the ambient velocities of subbundles join the scope as definitions.
void read_algebroid(ModelReader& reader);

// Expressions.
void read_parameters(ModelReader& reader, const TomlEntry* block, const std::vector<Setting>& settings);
void read_base(ModelReader& reader, const TomlEntry* block);
void read_mechanics(ModelReader& reader);
void read_control(ModelReader& reader);
void read_inputs(ModelReader& reader);
void read_states(ModelReader& reader);
/// The rates of the entries, once the connection is read.
void read_reconstructions(ModelReader& reader);
void read_action(ModelReader& reader);
void read_discrete(ModelReader& reader);
[[nodiscard]] ControlBoundary read_boundary(const ModelReader& reader, const TomlEntry& block);
void read_quantities(ModelReader& reader);
void read_forms(ModelReader& reader, const TomlEntry* block);
/// Sections, and their momenta as observables; once observables and mechanics are read.
void read_symmetries(ModelReader& reader, const TomlEntry* block);
/// Once mechanics is read.
void read_hamilton_jacobi(ModelReader& reader, const TomlEntry* block);
void read_about(ModelReader& reader, const TomlEntry* block);
void read_scenes(ModelReader& reader, const TomlEntry* block, const std::vector<Setting>& settings);
void read_scene_events(const ModelReader& reader, Scene& scene, const TomlEntry& block);

/// Index of `name` among `symbols`, or symbols.size().
[[nodiscard]] std::size_t index_of(const std::vector<Symbol>& symbols, const std::string& name);
[[nodiscard]] std::vector<std::string> names_of(const std::vector<Symbol>& symbols);

/// A named value as one entry of `list`, or one an entry where it is a vector or matrix: name[1], name[2], ..
void append_entries(std::vector<NamedTree>& list, const Excerpt& key, const ArrayValue& value);

} // namespace lagen
