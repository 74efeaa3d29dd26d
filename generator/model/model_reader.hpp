// SPDX-License-Identifier: GPL-2.0-or-later
/// The stages of reading a model, in the order in which read_model calls them: names are declared first, so that
/// expressions may use what stands later in the file.
#pragma once

#include "model/model.hpp"
#include "model/names.hpp"
#include "model/read_model.hpp"
#include "model/schema.hpp"

#include <functional>

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

/// xdot^i = rho^i_a y^a of a base coordinate, or of a family of them.
struct CoordinateRate {
    std::string coordinate;
    std::string rate;     ///< "v_x", or "g3*w2 - g2*w3"
    bool is_name = false; ///< `rate` is a fibre coordinate, a family of them or a definition
    std::string momentum; ///< of that fibre coordinate; empty where it is none of the model's
};

struct AlgebroidDraft;

/// A model in the making.
struct ModelReader {
    Model model;
    Names names;
    const std::vector<Setting>* settings = nullptr;
    IncludeTrail* trail = nullptr;
    bool is_probe = false;   ///< read as far as its base alone, without a fibre
    bool is_tangent = false; ///< of a probe: the algebroid is read as the tangent bundle of the base
    TomlEntry document;
    std::shared_ptr<const AlgebroidDraft> draft;
    std::optional<std::vector<std::size_t>> own_constraints; ///< of a level set: those of [base] that are kept
    std::vector<IncludedModel> included; ///< in the order of the file; the same file may stand here twice
    std::vector<NamedTree> casimirs, observables, invariants; ///< as parsed
    Tree lagrangian, dissipation;                             ///< as parsed; null where absent
    std::vector<ComponentEntry> inherited_forces;             ///< of included files, over the model's names
    std::vector<CoordinateRate> rates;                        ///< once the entries of the algebroid are read
    Scope mechanical; ///< the model's scope with momenta, controls, inputs and first-order states
    Scope observer;   ///< the model's scope with momenta, observables, invariants and built-in quantities
    Scope arrows;     ///< the observer's with the coordinates of an arrow of the groupoid and the step

    /// A block of the file; nothing where it is absent.
    [[nodiscard]] Item at(std::string_view block) const;

    /// The closed form of an expression in the narrowest scope that has all names of these roles (others: ModelError).
    /// A fibre coordinate is an ambient one where the model is nonholonomic. `what` is the subject of messages.
    [[nodiscard]] ArrayValue close(const Tree& tree, Roles roles, const std::string& what,
                                   bool nonsmooth = false) const;
    [[nodiscard]] ArrayValue close_in(const Scope& scope, const Tree& tree, Roles roles, const std::string& what,
                                      bool nonsmooth = false, bool scalar = false) const;
    /// The value of an item over the roles of its row: any, or a scalar.
    [[nodiscard]] ArrayValue array(const Item& item) const;
    [[nodiscard]] Tree scalar(const Item& item) const;
    /// The same of a condition or column in a list.
    [[nodiscard]] Tree scalar(const Tree& tree, Roles roles, const std::string& what, bool nonsmooth = false) const;
    /// One tree an entry of this shape: entry by entry, or one scalar for all.
    [[nodiscard]] std::vector<Tree> entries(const Item& item, const Shape& shape, Roles roles) const;

    /// Calls take(k, value, item) for each of `symbols` that a table by their names gives. A key may be a family, an
    /// entry, or x[j] for all entries. Throws ModelError: a key that is no `noun` (with this hint, else the nearest
    /// name), an entry given twice, a value over other roles or of another shape.
    using Take = std::function<void(std::size_t, const Tree&, const Item&)>;
    using Hint = std::function<std::string(const std::string&)>;
    void read_values(const Item& table, const std::vector<Symbol>& symbols, const char* noun, const Take& take,
                     const Hint& hint = {}) const;
    /// Declares the keys of a block, families among them, in this role.
    void declare_keys(const Item& block, Role role);
    /// Calls take(k, value) for the k-th of what the keys of the block declare.
    void read_declared(const Item& block, const std::function<void(std::size_t, const Tree&)>& take) const;

  private:
    [[nodiscard]] Roles legal(Roles roles) const;
    [[nodiscard]] const Scope& scope_for(Roles roles) const;
};

/// The model of a text that was reached by `trail`.
[[nodiscard]] Model read_model_text(const std::string& name, std::string text, const std::vector<Setting>& settings,
                                    IncludeTrail& trail);

// Declarations (no expression is closed yet).
void read_sizes(ModelReader& reader);
/// The kind and the group of [groupoid].
void declare_groupoid(ModelReader& reader);
/// The kinds of [algebroid] and its inner tables, their fibres and bases; what included files declare joins the model.
/// Where there is no such block the algebroid is that of the groupoid.
void read_algebroid_kind(ModelReader& reader);
/// How far a model is known: the kind of its algebroid, all that is declared, its functions.
enum class Known { algebroid, blocks, functions };
/// Throws ModelError where a block or key breaks a rule that can be judged from this stage on.
void require_rules(const ModelReader& reader, Known stage);
/// The first of the sections in whose place a Lie algebra stands; nothing where the algebroid has none.
[[nodiscard]] std::optional<std::size_t> first_vertical(const Model& model);
/// The coordinates Y of a nonholonomic model.
void declare_ambient(ModelReader& reader);
/// True where a nonholonomic model has `constraints` and no `sections`: its fibre coordinates are some of the Y then.
[[nodiscard]] bool has_constraints_alone(const ModelReader& reader);
/// The fibre coordinates that the chooser finds; nothing where there is none.
[[nodiscard]] std::optional<std::vector<Symbol>> chosen_coordinates(const ModelReader& reader);
/// Made by the reading's FrameMaker.
[[nodiscard]] LevelSetFrame frame_of_level_set(const ModelReader& reader, const LevelSetRequest& request);
/// The fibre coordinates are these Y. Throws ModelError.
void keep_coordinates(ModelReader& reader, const std::vector<Symbol>& names);
/// Names of the fibre coordinates where [fibre] leaves them out; nothing where the kind has no default.
[[nodiscard]] std::optional<std::vector<Symbol>> default_fibre(const ModelReader& reader);
/// Throws ModelError where the fibre has not as many coordinates as the kind of the algebroid requires.
void require_rank(const ModelReader& reader, const SourceRange& where);
void declare_fibre(ModelReader& reader);
void declare_control(ModelReader& reader);
/// `total_cost`, the last first-order state of a control problem, and `cost` in what observes; each where the model
/// does not have the name.
void declare_total_cost(ModelReader& reader);
void define_cost(ModelReader& reader);
/// The group that `item` names, and its generators.
void read_named_group(const ModelReader& reader, GroupoidBlock& block, const Item& item);
/// The names of [reconstruct].
void declare_reconstructions(ModelReader& reader);
void declare_mechanics(ModelReader& reader);
/// The step of [discrete] and its scheme; once mechanics is declared.
void declare_discrete(ModelReader& reader);
void build_scopes(ModelReader& reader);
/// The generators of the groupoid's group, and the coordinates of its arrows; called by build_scopes once parameters
/// and definitions can be closed.
void declare_arrows(ModelReader& reader);
/// The entries of [algebroid]; called by build_scopes once the model's scope has symbols and definitions. The inner
/// fibre coordinates of frames and the ambient velocities of subbundles join the scope as definitions.
void read_algebroid(ModelReader& reader);

// Names that a person may have had for rates, such as xdot, dx or p_x.
/// Defines what Dt(X) needs in the model's scope: the rates of t, of the parameters and of the base coordinates, closed
/// over the fibre coordinates (of a nonholonomic model over those of its ambient algebroid). Once the entries of the
/// algebroid are read. The anchor of a groupoid's action is not known here, and then neither are these.
void define_rates(ModelReader& reader);

/// The rates that are short enough to be told. The entries of the model's algebroid must have been read.
[[nodiscard]] std::vector<CoordinateRate> coordinate_rates(const Model& model);

/// The hint for `name` where it is a usual name of a rate, such as xdot; empty where it is none.
[[nodiscard]] std::string hint_for_rate(const std::string& name, const std::vector<CoordinateRate>& rates);

/// The hint for `name` in a function of momenta, where it is a usual name of a rate or of its momentum, such as p_x.
[[nodiscard]] std::string hint_for_momentum(const std::string& name, const std::vector<CoordinateRate>& rates);

/// The same where both are legal.
void explain_rates(Scope& scope, const std::vector<CoordinateRate>& rates);

// Expressions.
void read_parameters(ModelReader& reader);
void read_base(ModelReader& reader);
void read_mechanics(ModelReader& reader);
void read_control(ModelReader& reader);
/// The rates of the entries, once the connection is read.
void read_reconstructions(ModelReader& reader);
void read_action(ModelReader& reader);
void read_discrete(ModelReader& reader);
/// Sections, and their momenta as observables; once observables and mechanics are read.
void read_symmetries(ModelReader& reader);
void read_forms(ModelReader& reader);
void read_about(ModelReader& reader);
void read_scenes(ModelReader& reader);
/// The entries of a table by coordinates of the fibre that are not a plain 0.
[[nodiscard]] std::vector<ComponentEntry> read_components(const ModelReader& reader, const Item& table);

/// The values of a table by names of these.
[[nodiscard]] std::vector<NamedTree> read_given(const ModelReader& reader, const Item& table,
                                                const std::vector<Symbol>& symbols, const char* noun,
                                                const ModelReader::Hint& hint = {});

/// Index of `name` among `symbols`, or symbols.size().
[[nodiscard]] std::size_t index_of(const std::vector<Symbol>& symbols, const std::string& name);
[[nodiscard]] std::vector<std::string> names_of(const std::vector<Symbol>& symbols);

/// A named value as one entry of `list`, or one an entry where it is a vector or matrix: name[1], name[2], ..
void append_entries(std::vector<NamedTree>& list, const NamedTree& named, const ArrayValue& value);

} // namespace lagen
