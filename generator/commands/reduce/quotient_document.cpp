// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/reduce/quotient_document.hpp"

#include "expression/rewrite.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/core/lower.hpp"
#include "model/families.hpp"
#include "model/plain_names.hpp"
#include "text/diagnostic.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace lagen {

namespace {

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

} // namespace

QuotientDocument::QuotientDocument(const GroupReduction& reduction, const std::vector<Setting>& settings)
    : reduction_(reduction), document_(reduction.model, settings, "by " + reduction.group),
      taken_(symbol_names(reduction.model))
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
        if (!is_it(model.base.coordinates) && !is_it(model.fibre.coordinates) && !is_it(parameter_symbols(model)) &&
            each != reduction_.graph.input_name(reduction_.system.time) && each != "energy")
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
            if (given == scene.initial.end() && !(fibre && scene.rest)) return false;
            const NodeId value = given == scene.initial.end() ? graph.constant(0) : Lowering(graph)(given->value);
            start.emplace_back((fibre ? reduction_.system.algebroid.y : reduction_.system.algebroid.x)[i], value);
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

} // namespace lagen
