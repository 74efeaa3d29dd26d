// SPDX-License-Identifier: GPL-2.0-or-later
#include "reduction/by_group.hpp"

#include "equations/symbolic_model.hpp"
#include "expression/parse.hpp"
#include "expression/rewrite.hpp"
#include "geometry/named_algebra.hpp"
#include "graph/calculus/determinant.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/calculus/places.hpp"
#include "graph/calculus/transplant.hpp"
#include "graph/core/lower.hpp"
#include "mechanics/quotient.hpp"
#include "model/families.hpp"
#include "model/plain_names.hpp"
#include "model/read_model.hpp"
#include "text/usage_error.hpp"
#include "verify/judge.hpp"
#include "verify/proof_setting.hpp"
#include "verify/verify_quotient.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>

namespace lagen {

namespace {

// The model file of a quotient TQ/G: the file of the whole model with what the reduction changes. Coordinates that the
// slice fixes and velocities that the group moves become definitions, with the values that they have on the slice, so
// that what is invariant stands as it did; what is not is left out.

/// The parts of a reduction by a group.
struct GroupReduction {
    const CheckedModel& whole;
    const Model& model;
    const System& system;
    Graph& graph; ///< a copy of the system's, with what is derived
    const InfinitesimalAction& action;
    const Quotient& quotient;
    std::string group, algebra;                   ///< "SO(3)", "so(3)"
    std::function<bool(NodeId)> is_invariant;     ///< of a function of t, x and y
    std::function<bool(NodeId)> is_invariant_set; ///< of the set f > 0 of a function of x
};

class QuotientDocument {
  public:
    /// Keeps a reference.
    explicit QuotientDocument(const GroupReduction& reduction);

    /// The reduced Lagrangian as it is derived, in the names of the file.
    [[nodiscard]] const Tree& lagrangian() const { return lagrangian_; }
    /// "v_x = u_x - w*y" of each coordinate and velocity that is defined.
    [[nodiscard]] const std::vector<std::pair<std::string, std::string>>& definitions() const { return definitions_; }
    /// The file with `lagrangian` for L.
    [[nodiscard]] std::string text(const Tree& lagrangian);

  private:
    void choose_names(const std::vector<Symbol>& symbols, bool fibre);
    [[nodiscard]] std::string unused(std::string name);
    [[nodiscard]] Tree shown(NodeId node) const;
    [[nodiscard]] bool is_in_names_of_whole(const Tree& tree) const;
    [[nodiscard]] bool is_kept(const Tree& tree) const;
    [[nodiscard]] std::vector<std::string> domain() const;
    void put_algebroid();
    void drop_claims();
    bool move_start(const Scene& scene, TomlValue& table) const;
    void move_scenes();

    const GroupReduction& reduction_;
    ReducedDocument document_;
    std::vector<std::string> taken_;
    std::vector<std::string> x_, u_, w_;         ///< names of free coordinates, of their velocities, of generators
    std::map<std::string, Tree> values_;         ///< what names of the whole stand for on the slice
    std::vector<std::string> base_, velocities_; ///< declarations
    std::vector<std::pair<std::string, std::string>> definitions_;
    Tree lagrangian_;
};

/// "x[1..3]"
std::string declaration_of(const SymbolGroup& group)
{
    switch (group.shape.rank) {
    case Rank::scalar: break;
    case Rank::vector: return fmt::format("{}[1..{}]", group.name, group.shape.size());
    case Rank::matrix: return fmt::format("{}[1..{},1..{}]", group.name, group.shape.rows, group.shape.columns);
    }
    return group.name;
}

/// The values of a family as an array.
std::string array_text(const SymbolGroup& group, const std::vector<std::string>& entries)
{
    if (group.shape.rank == Rank::scalar) return entries[0];
    if (group.shape.rank == Rank::vector) return fmt::format("[{}]", fmt::join(entries, ", "));
    std::vector<std::string> rows;
    const auto columns = static_cast<std::ptrdiff_t>(group.shape.columns);
    for (auto row = entries.begin(); row != entries.end(); row += columns)
        rows.push_back(fmt::format("[{}]", fmt::join(row, row + columns, ", ")));
    return fmt::format("[{}]", fmt::join(rows, ", "));
}

QuotientDocument::QuotientDocument(const GroupReduction& reduction)
    : reduction_(reduction), document_(reduction.whole, "by " + reduction.group), taken_(symbol_names(reduction.model))
{
    document_.write_out_rates(reduction.model);
    for (const Definition& each : reduction.model.definitions) taken_.push_back(each.name);
    for (const NodeId each : reduction.quotient.w) w_.push_back(reduction.graph.input_name(each));
    taken_.insert(taken_.end(), w_.begin(), w_.end());
    choose_names(reduction.model.base.coordinates, false);
    choose_names(reduction.model.fibre.coordinates, true);
    lagrangian_ = shown(reduction.quotient.lagrangian);
    put_algebroid();
    TomlValue& definitions = document_.at("definitions");
    for (const auto& [name, value] : definitions_) entry_in(definitions, name) = toml_string(value);
    drop_claims();
    move_scenes();
}

std::string QuotientDocument::unused(std::string name)
{
    while (std::ranges::find(taken_, name) != taken_.end()) name += '_';
    taken_.push_back(name);
    return name;
}

/// A coordinate or a velocity keeps its name where its value on the slice is itself, and those of its whole family are.
/// The others are defined, and what a definition needs has a name of its own: x_2 of x[2], u_x where v_x is moved.
void QuotientDocument::choose_names(const std::vector<Symbol>& symbols, bool fibre)
{
    const Quotient& quotient = reduction_.quotient;
    const Algebroid& tangent = reduction_.system.algebroid;
    std::vector<NodeId> nodes = fibre ? quotient.velocity : tangent.x;
    if (!fibre)
        for (std::size_t k = 0; k < quotient.slice.frozen.size(); ++k)
            nodes[quotient.slice.frozen[k]] = quotient.slice.values[k];
    const std::vector<NodeId>& own = fibre ? tangent.y : tangent.x;
    for (const SymbolGroup& group : group_symbols(symbols)) {
        const std::size_t end = group.first + group.shape.size();
        const bool stays = std::equal(nodes.begin() + static_cast<std::ptrdiff_t>(group.first),
                                      nodes.begin() + static_cast<std::ptrdiff_t>(end),
                                      own.begin() + static_cast<std::ptrdiff_t>(group.first));
        if (stays) (fibre ? velocities_ : base_).push_back(declaration_of(group));
        for (std::size_t i = group.first; i < end; ++i) {
            if (std::ranges::find(quotient.free, i) == quotient.free.end()) continue;
            std::string free = symbols[i].name;
            if (!stays) {
                const bool moves = nodes[i] != own[i];
                const std::string& of = (moves ? reduction_.model.base.coordinates : symbols)[i].name;
                const std::string wanted = (moves ? "u_" : "") + plain_name(of);
                free = !moves && group.shape.rank == Rank::scalar ? of : unused(wanted);
                (fibre ? velocities_ : base_).push_back(free);
            }
            (fibre ? u_ : x_).push_back(free);
            values_[symbols[i].name] = name(free);
        }
        if (stays) continue;
        // The nodes are over inputs of the whole, whose free ones have their new names by now.
        std::vector<std::string> entries;
        std::vector<std::pair<std::string, Tree>> defined;
        for (std::size_t i = group.first; i < end; ++i) {
            defined.emplace_back(symbols[i].name, shown(nodes[i]));
            entries.push_back(to_text(defined.back().second));
        }
        definitions_.emplace_back(group.name, array_text(group, entries));
        for (auto& [symbol, value] : defined)
            if (!fibre) values_[symbol] = value;
    }
}

/// A node over the m, u, w.
Tree QuotientDocument::shown(NodeId node) const
{
    return replace_names(to_tree(reduction_.graph, node), values_);
}

bool QuotientDocument::is_in_names_of_whole(const Tree& tree) const
{
    const Model& model = reduction_.model;
    for (const std::string& each : names_in(tree)) {
        const auto is_it = [&](const std::vector<Symbol>& symbols) {
            return std::ranges::find(symbols, each, &Symbol::name) != symbols.end();
        };
        if (!is_it(model.base.coordinates) && !is_it(model.fibre.coordinates) &&
            !is_it(symbols_of(model, Role::parameter)) && each != reduction_.graph.input_name(reduction_.system.time) &&
            each != "energy")
            return false;
    }
    return true;
}

/// True where a function in the names of the whole is one on the quotient.
bool QuotientDocument::is_kept(const Tree& tree) const
{
    return is_in_names_of_whole(tree) && reduction_.is_invariant(Lowering(reduction_.graph)(tree));
}

std::vector<std::string> QuotientDocument::domain() const
{
    std::vector<std::string> texts;
    for (const Tree& condition : reduction_.model.base.domain) {
        const Tree difference = add({condition->arguments[0], negate(condition->arguments[1])});
        if (!is_in_names_of_whole(difference) || !reduction_.is_invariant_set(Lowering(reduction_.graph)(difference)))
            throw MathematicsError(fmt::format("the domain of model '{}' is not shown to be invariant under {}: {}",
                                               reduction_.model.name, reduction_.group, to_text(condition)),
                                   "a symmetry of the motions is one of the domain too; a condition f > 0 is invariant "
                                   "where the generators change f by a factor that is a number");
        const auto folded = [&](const Tree& side) {
            return to_tree(reduction_.graph, Lowering(reduction_.graph)(replace_names(side, values_)));
        };
        const Tree on_slice =
            compare(condition->comparison, folded(condition->arguments[0]), folded(condition->arguments[1]));
        if (!names_in(on_slice).empty()) texts.push_back(to_text(on_slice)); // else it is one of numbers
    }
    if (const NodeId divisor = reduction_.quotient.determinant; !reduction_.graph.is_constant(divisor)) {
        const Tree tree = shown(divisor);
        texts.push_back(to_text(tree->kind == TreeKind::negate ? tree->arguments[0] : tree) + " != 0");
    }
    return texts;
}

void QuotientDocument::put_algebroid()
{
    TomlValue& base = document_.at("base");
    document_.erase("base", {"coordinates", "domain"});
    if (!base_.empty()) entry_in(base, "coordinates") = toml_list(base_);
    if (const std::vector<std::string> conditions = domain(); !conditions.empty())
        entry_in(base, "domain") = toml_list(conditions);
    std::vector<std::string> sections = velocities_;
    sections.insert(sections.end(), w_.begin(), w_.end());
    document_.forget("fibre");
    entry_in(document_.at("fibre"), "coordinates") = toml_list(sections);
    document_.forget("algebroid");
    TomlValue& algebroid = document_.at("algebroid");
    entry_in(algebroid, "kind") = toml_string(base_.empty() ? "lie_algebra" : "atiyah");
    entry_in(algebroid, "algebra") = toml_string(reduction_.algebra);
}

void QuotientDocument::drop_claims()
{
    document_.drop({"symmetries", "forms", "hamilton_jacobi", "states", "reconstruct"});
    for (const NamedTree& each : reduction_.model.invariants)
        if (!is_kept(each.value)) document_.drop("invariants", each.name, fmt::format("the invariant {}", each.name));
    for (const NamedTree& each : reduction_.model.observables)
        if (!is_kept(each.value)) document_.drop("observables", each.name, fmt::format("the observable {}", each.name));
}

/// True where the scene starts on the slice; the start of the quotient is put into its table.
bool QuotientDocument::move_start(const Scene& scene, TomlValue& table) const
{
    const Quotient& quotient = reduction_.quotient;
    const Model& model = reduction_.model;
    Graph& graph = reduction_.graph;
    Replacements start;
    for (const bool fibre : {false, true}) {
        const std::vector<Symbol>& symbols = fibre ? model.fibre.coordinates : model.base.coordinates;
        for (std::size_t i = 0; i < symbols.size(); ++i) {
            const auto given = std::ranges::find(scene.initial, symbols[i].name, &NamedTree::name);
            if (given == scene.initial.end()) return false;
            start.emplace_back((fibre ? reduction_.system.algebroid.y : reduction_.system.algebroid.x)[i],
                               Lowering(graph)(given->value));
        }
    }
    for (std::size_t k = 0; k < quotient.slice.frozen.size(); ++k) {
        const std::size_t i = quotient.slice.frozen[k];
        const NodeId here[] = {reduction_.system.algebroid.x[i]};
        std::vector<NodeId> functions{*reduction_.system.lagrangian};
        for (const std::vector<NodeId>& field : reduction_.action.fields)
            functions.insert(functions.end(), field.begin(), field.end());
        // All values of a cyclic coordinate are one.
        if (start[i].second != quotient.slice.values[k] && depends_on_any(graph, functions, here)) return false;
    }
    try {
        const std::vector<NodeId> u = substitute(graph, quotient.base, start);
        const std::vector<NodeId> w = substitute(graph, quotient.group, start);
        TomlValue initial;
        const auto put = [&](const std::string& to, NodeId value) {
            entry_in(initial, to) = toml_string(to_text(to_tree(graph, value)));
        };
        for (std::size_t j = 0; j < x_.size(); ++j) put(x_[j], start[quotient.free[j]].second);
        for (std::size_t j = 0; j < u_.size(); ++j) put(u_[j], u[j]);
        for (std::size_t b = 0; b < w_.size(); ++b) put(w_[b], w[b]);
        entry_in(table, "initial") = std::move(initial);
    } catch (const DivisionByZero&) {
        return false;
    }
    return true;
}

/// A scene keeps its invariant columns; one that does not start on the slice is left out.
void QuotientDocument::move_scenes()
{
    std::vector<std::string> gone;
    for (const Scene& scene : reduction_.model.scenes) {
        TomlValue& table = document_.scene(scene.name);
        const auto like = std::ranges::find(table.entries, "like", &TomlEntry::name);
        const bool follows =
            like != table.entries.end() && std::ranges::find(gone, like->value.text.text) != gone.end();
        if (follows || !move_start(scene, table)) {
            gone.push_back(scene.name);
            document_.drop("scene", scene.name, fmt::format("the scene {}", scene.name));
            continue;
        }
        for (const char* key : {"rest", "project", "observe", "events", "plot", "time_scale"})
            std::erase_if(table.entries, [&](const TomlEntry& each) { return each.name() == key; });
        std::vector<std::string> observed;
        for (const NamedTree& each : scene.observe.value_or(std::vector<NamedTree>{}))
            if (is_kept(each.value)) observed.push_back(each.name);
        if (!observed.empty()) entry_in(table, "observe") = toml_list(observed);
    }
}

std::string QuotientDocument::text(const Tree& lagrangian)
{
    entry_in(document_.at("lagrangian"), "L") = toml_string(to_text(lagrangian));
    std::vector<std::string> slice;
    for (std::size_t k = 0; k < reduction_.quotient.slice.frozen.size(); ++k)
        slice.push_back(fmt::format("{} = {}",
                                    reduction_.model.base.coordinates[reduction_.quotient.slice.frozen[k]].name,
                                    to_text(to_tree(reduction_.graph, reduction_.quotient.slice.values[k]))));
    return document_.text(
        fmt::format("# The quotient of {} by {}, cut by the slice {}. A motion is a point of the slice moved\n"
                    "# by {}, and {} are the components of g^-1 g'.\n",
                    std::filesystem::path(reduction_.model.file->name).filename().string(), reduction_.group,
                    fmt::join(slice, ", "), reduction_.action.is_abelian ? "g" : "g^-1", fmt::join(w_, ", ")));
}

// Where the orbits of a group are cut: which coordinates stay, and at what values.

/// Choices of coordinates that are looked at.
constexpr std::size_t most_choices = 2000;

using FixedNodes = std::vector<std::optional<NodeId>>; // of each coordinate; nothing where it cannot be fixed

FixedNodes start_values(Graph& graph, const Model& model)
{
    FixedNodes values(model.base.coordinates.size());
    if (model.scenes.empty()) return values;
    const Scene& scene = find_scene(model, "");
    for (std::size_t i = 0; i < values.size(); ++i)
        if (const auto given = std::ranges::find(scene.initial, model.base.coordinates[i].name, &NamedTree::name);
            given != scene.initial.end())
            values[i] = Lowering(graph)(given->value);
    return values;
}

/// Values of coordinates by name; those that are not named are free.
FixedNodes named_values(Graph& graph, const Model& model, const std::vector<Setting>& slice)
{
    FixedNodes values(model.base.coordinates.size());
    const std::vector<Symbol> parameters = symbols_of(model, Role::parameter);
    for (const Setting& setting : slice) {
        const SourceRange where = setting.value.range(0, setting.value.text.size());
        const auto found = std::ranges::find(model.base.coordinates, setting.name, &Symbol::name);
        if (found == model.base.coordinates.end())
            refuse(fmt::format("'{}' of --slice is no coordinate of model '{}'", setting.name, model.name), where);
        const Tree value = model.observer.close(parse_expression(setting.value));
        for (const std::string& used : names_in(value))
            if (std::ranges::find(parameters, used, &Symbol::name) == parameters.end())
                refuse(fmt::format("'{}' in --slice is no parameter of model '{}'", used, model.name), where);
        values[static_cast<std::size_t>(found - model.base.coordinates.begin())] = Lowering(graph)(value);
    }
    return values;
}

/// The slice that is asked for. Without it: as many coordinates as the group has dimensions, at their
/// values in the first scene (that called default, where there is one), else at 0, such that the orbits cross it: where
/// possible at every point, else at the start of that scene. Throws UsageError for one that names others, and
/// MathematicsError where there is none.
Slice choose_slice(Graph& graph, const CheckedModel& checked, const InfinitesimalAction& action,
                   const GroupRequest& request)
{
    const Model& model = checked.model;
    const System& whole = checked.system;
    const std::size_t size = action.fields.size();
    std::vector<FixedNodes> offers;
    if (request.slice.empty())
        offers = {start_values(graph, model), FixedNodes(whole.n(), graph.constant(0))};
    else
        offers = {named_values(graph, model, request.slice)};
    Replacements start; // a slice that orbits cross there is better than one that they touch
    for (std::size_t i = 0; i < whole.n(); ++i)
        if (offers[0][i]) start.emplace_back(whole.algebroid.x[i], *offers[0][i]);
    std::optional<Slice> crossed, touched;
    Judge judge(graph, proof_setting(graph, whole), {});
    const auto vanishes = [&](NodeId f) { return judge.decide(f).status != ProofStatus::refuted; };
    for (const FixedNodes& values : offers) {
        if (size > whole.n()) break;
        Places choice = first_places(size);
        std::size_t tried = 0;
        do {
            Slice slice{choice, {}};
            for (const std::size_t k : choice)
                if (values[k]) slice.values.push_back(*values[k]);
            if (size > determinant_limit || slice.values.size() < size) continue;
            try {
                const NodeId only[] = {slice_determinant(graph, whole, action, slice)};
                if (graph.is_constant(only[0]) && !graph.is_zero(only[0])) return slice;
                if (crossed || vanishes(only[0])) continue;
                if (!touched) touched = slice;
                if (!vanishes(substitute(graph, only, start)[0])) crossed = slice;
            } catch (const DivisionByZero&) { // the field has no value there
            }
        } while (++tried < most_choices && next_places(choice, whole.n()));
    }
    if (crossed) return *crossed;
    if (touched) return *touched;
    throw MathematicsError(
        fmt::format("no slice {}of its coordinates cuts the orbits of {} on model '{}' in points: the group has "
                    "dimension {}",
                    request.slice.empty() ? "" : fmt::format("'{}' ", request.slice_text), request.group, model.name,
                    size),
        "the group acts freely where orbits are as large as it is; --slice 'x=1, y=0' names coordinates and values");
}

void require_quotient(const Model& model, const System& system)
{
    require_tangent_lagrangian(model, "a reduction by a group");
    if (!system.forces.empty() || !system.constraints.empty() || !system.inputs.empty())
        throw MathematicsError(
            fmt::format(
                "model '{}' has forces, constraints or inputs, which a reduction by a group does not carry over",
                model.name),
            "leave them out, or write the quotient with its morphism: lagen reduce MORPHISM");
}

/// "w1", "w2", ..: one a generator, that nothing else is called; "w" of one.
std::vector<std::string> generator_names(const Model& model, std::size_t count)
{
    std::vector<std::string> taken = symbol_names(model), names;
    for (const Definition& each : model.definitions) taken.push_back(each.name);
    for (std::size_t b = 1; b <= count; ++b) {
        names.push_back(count == 1 ? "w" : fmt::format("w{}", b));
        while (std::ranges::find(taken, names.back()) != taken.end()) names.back() += '_';
    }
    return names;
}

/// The coordinates of `model` with a section a generator, whose groupoid is the action.
Model read_action_model(const CheckedModel& whole, const GroupRequest& request, const std::vector<std::string>& w)
{
    const Model& model = whole.model;
    ReducedDocument document(whole, "to an action");
    document.keep({"parameters", "sizes", "base"});
    document.at("name") = toml_string("action");
    document.erase("base", {"domain"});
    std::vector<std::string> conditions;
    for (const Tree& each : model.base.domain) conditions.push_back(to_text(each));
    if (!conditions.empty()) entry_in(document.at("base"), "domain") = toml_list(conditions);
    entry_in(document.at("fibre"), "coordinates") = toml_list(w);
    TomlValue& groupoid = document.at("groupoid");
    entry_in(groupoid, "kind") = toml_string("action");
    entry_in(groupoid, "group") = toml_string(request.group);
    TomlValue& moved = entry_in(groupoid, "action");
    for (const Setting& each : request.action) entry_in(moved, each.name) = toml_string(each.value.text);
    for (const Symbol& each : model.base.coordinates) // what is not named stays
        if (std::ranges::none_of(moved.entries, [&](const TomlEntry& e) { return names_entry(e.name(), each.name); }))
            entry_in(moved, each.name) = toml_string(each.name);
    return read_model_text("--action", document.text("# The action\n"));
}

InfinitesimalAction infinitesimal(Graph& graph, const System& whole, const System& moving)
{
    std::map<NodeId, NodeId> inputs;
    for (std::size_t i = 0; i < whole.n(); ++i) inputs[moving.algebroid.x[i]] = whole.algebroid.x[i];
    InfinitesimalAction action{{}, true};
    for (std::size_t b = 0; b < moving.r(); ++b) {
        Graph own = moving.graph;
        std::vector<NodeId> field;
        for (std::size_t i = 0; i < whole.n(); ++i)
            field.push_back(Algebroid::entry(own, moving.algebroid.anchor[b], i));
        action.fields.push_back(transplant(graph, own, field, inputs));
        for (std::size_t c = 0; c < moving.r(); ++c)
            action.is_abelian = action.is_abelian && moving.algebroid.C(b, c).empty();
    }
    return action;
}

void add_checks(StructureReport& to, const StructureReport& from)
{
    to.checks.insert(to.checks.end(), from.checks.begin(), from.checks.end());
    to.trivial += from.trivial;
    to.verdict = verdict_of(to);
}

} // namespace

ReducedModel quotient_by_group(const CheckedModel& checked, const GroupRequest& request)
{
    const Model& model = checked.model;
    const System& whole = checked.system;
    require_quotient(model, whole);
    const std::optional<NamedAlgebra> algebra = algebra_of_group(request.group);
    const std::vector<std::string> names = generator_names(model, algebra ? algebra->basis.size() : 1);
    const Model acting = read_action_model(checked, request, names);
    const System moving = elaborate(acting);

    ReducedModel made;
    add_checks(made.report, verify_right_action(moving));
    if (made.report.verdict == Verdict::invalid) {
        made.said = "  x.W is no right action\n";
        return made;
    }
    Graph graph = whole.graph;
    const InfinitesimalAction fields = infinitesimal(graph, whole, moving);
    add_checks(made.report, verify_symmetry(graph, whole, fields, names));
    if (made.report.verdict == Verdict::invalid) {
        made.said = "  the action does not leave L as it is\n";
        return made;
    }

    std::vector<NodeId> w;
    for (const std::string& each : names) w.push_back(graph.input(each));
    const Quotient divided = quotient(graph, whole, fields, choose_slice(graph, checked, fields, request), w);
    const GroupReduction reduction{checked,
                                   model,
                                   whole,
                                   graph,
                                   fields,
                                   divided,
                                   request.group,
                                   algebra ? algebra->name : "",
                                   [&](NodeId f) { return is_invariant(graph, whole, fields, f); },
                                   [&](NodeId f) { return is_invariant_set(graph, whole, fields, f); }};
    QuotientDocument document(reduction);
    const std::string name = model.name + "_quotient.toml";
    const Model draft = read_model_text(name, document.text(document.lagrangian()));
    const System drafted = elaborate(draft);
    SymbolicModel symbolic(draft, drafted.written.algebroid, {});
    const Tree lagrangian = symbolic.shortest(symbolic.lower(draft.lagrangian));
    made.document = document.text(lagrangian);
    made.lagrangian = to_text(lagrangian);
    add_checks(made.report,
               verify_quotient(graph, whole, fields, divided, elaborate(read_model_text(name, made.document))));
    for (const auto& [defined, value] : document.definitions()) made.said += fmt::format("  {} = {}\n", defined, value);
    made.said += fmt::format("  L = {}\n", made.lagrangian);
    return made;
}

} // namespace lagen
