// SPDX-License-Identifier: GPL-2.0-or-later
/// Families in the model reader: keys that name several symbols at once, and values that fill them.
#pragma once

#include "model/complaints.hpp"
#include "model/model_reader.hpp"

#include <optional>

namespace lagen {

/// The things that a key names: a symbol or a single entry ("y", "x[3]": a scalar), or a family with all its entries
/// ("x").
struct ResolvedKey {
    std::string name; ///< as declared; "x[ 3 ]" is "x[3]"
    Shape shape;
    std::vector<std::size_t> indices; ///< shape.size() numbers in the list of symbols, by rows
};

/// The symbols that `key` names among `symbols` (families stand in them entry by entry); nothing where it names none of
/// them.
[[nodiscard]] std::optional<ResolvedKey> resolve_key(const std::vector<Symbol>& symbols, const std::string& key);

/// The same where it must name one: ModelError "OWNER names 'KEY', which is no NOUN". With a scope an index may be an
/// expression over sizes: "x[n]".
[[nodiscard]] ResolvedKey require_key(const std::vector<Symbol>& symbols, const Excerpt& key, const std::string& owner,
                                      const char* noun, const Scope* scope = nullptr,
                                      const ModelReader::Hint& hint = {});

/// The same where it must name a single one; its number.
[[nodiscard]] std::size_t require_entry(const std::vector<Symbol>& symbols, const Excerpt& key,
                                        const std::string& owner, const char* noun, const Scope* scope = nullptr);

/// A key, and the values of its running indices as numbers.
struct RunningKey {
    ResolvedKey key;
    std::map<std::string, Tree> indices;
};
/// The same, where an index that is a new name runs: "x[j]" is x[1], x[2], .. with j = 1, 2, ..; "W[1,j]" is a row.
[[nodiscard]] std::vector<RunningKey> require_keys(const std::vector<Symbol>& symbols, const Excerpt& key,
                                                   const std::string& owner, const char* noun, const Scope& scope,
                                                   const ModelReader::Hint& hint = {});

/// Calls take(k, value, item) for each of `symbols` that a table by their names gives; `values` of an item and what its
/// key names are one a symbol. Throws ModelError: a key that names none of them, a symbol given twice.
template <class Values, class Take>
void read_table(const Item& table, const std::vector<Symbol>& symbols, const char* noun, const Scope& scope,
                Values values, Take take, const ModelReader::Hint& hint = {})
{
    std::map<std::size_t, std::string> given; // by which key
    for (const Item& item : table.items())
        for (const RunningKey& each : require_keys(symbols, item.key(), table.title(), noun, scope, hint)) {
            const auto all = values(item, each);
            for (std::size_t k = 0; k < all.size(); ++k) {
                const std::size_t place = each.key.indices[k];
                if (const auto [first, fresh] = given.try_emplace(place, item.name()); !fresh)
                    throw complain::twice_by(item.title_of(symbols[place].name), first->second, item.name(),
                                             item.where());
                take(place, all[k], item);
            }
        }
}

/// The text to write instead of a key that names none of `symbols`: the entries of its family, a name like it, or some
/// of the names there are.
[[nodiscard]] std::string hint_for_key(const std::vector<Symbol>& symbols, const std::string& key, const char* noun);

/// The family of an entry: "x" of "x[3]", "W" of "W[1,2]"; any other name itself.
[[nodiscard]] std::string family_name(const std::string& name);

/// The coordinate of the target: "x_next" for "x", "x_next[1]" for "x[1]".
[[nodiscard]] std::string next_name(const std::string& name);

/// True where `key` is `name` itself, or the family that `name` is an entry of.
[[nodiscard]] bool names_entry(const std::string& key, const std::string& name);

/// The names of `symbols` as they were declared: the entries of a family together as the family's name.
[[nodiscard]] std::vector<std::string> declared_names(const std::vector<Symbol>& symbols);

/// `count` entries from number `first` on.
template <class Entry>
[[nodiscard]] std::vector<Entry> part_of(const std::vector<Entry>& list, std::size_t first, std::size_t count)
{
    const auto begin = list.begin() + static_cast<std::ptrdiff_t>(first);
    return {begin, begin + static_cast<std::ptrdiff_t>(count)};
}

/// The first entry whose name is that of one of `symbols`; null where there is none.
[[nodiscard]] const NamedTree* first_of(const std::vector<NamedTree>& entries, const std::vector<Symbol>& symbols);

/// Replaces the entries of the same names, appends the others.
void put_all(std::vector<NamedTree>& list, std::vector<NamedTree> entries);

/// The entries at these places.
template <class Entry>
[[nodiscard]] std::vector<Entry> entries_at(const std::vector<Entry>& list, const std::vector<std::size_t>& places)
{
    std::vector<Entry> out;
    for (const std::size_t place : places) out.push_back(list.at(place));
    return out;
}

/// New symbols in the places of `symbols`, called as `name_of` says of their names.
template <class NameOf>
[[nodiscard]] std::vector<Symbol> with_names(const std::vector<Symbol>& symbols, NameOf name_of)
{
    std::vector<Symbol> out;
    for (const Symbol& each : symbols) out.push_back(Symbol{name_of(each.name), each.where, {}, {}, {}});
    return out;
}

/// A symbol, or the entries of a vector or matrix.
[[nodiscard]] std::vector<Symbol> symbols_called(const std::string& name, const Shape& shape, const SourceRange& where);

/// One key of a declaration: "y", "x[1..n]" or "W[1..3,1..3]", by the sizes of the model.
struct DeclaredKey {
    std::string name;
    Shape shape;
    std::vector<Symbol> symbols; ///< its entries in order, or itself
};
[[nodiscard]] DeclaredKey read_declaration(const ModelReader& reader, const Excerpt& key);

/// The names and families of a list, entry by entry.
[[nodiscard]] std::vector<Symbol> read_names(const ModelReader& reader, const Item& list);

/// The number 0, as it is written.
[[nodiscard]] bool is_plain_zero(const Tree& tree);

/// The key of a setting, with its indices as closing spells them: "x[n]" is "x[8]" where n is 8.
[[nodiscard]] std::string key_of(const ModelReader& reader, const Setting& setting);
/// Where messages say that it stands.
[[nodiscard]] const char* option_of(const Setting& setting);

/// Numbers of `values` such that each comes after those whose names it uses. Throws ModelError where some depend on
/// each other in a cycle, which is listed; `noun` calls them in the message: "parameters".
[[nodiscard]] std::vector<std::size_t> dependency_order(const std::vector<NamedTree>& values, const char* noun);

/// A symbol, or the family that consecutive symbols x[1], x[2], .. make.
struct SymbolGroup {
    std::string name;
    Shape shape;
    std::size_t first; ///< its number in the list
};

/// `symbols` in groups, in order. Throws ModelError where a family is not whole: x[2] without x[1].
[[nodiscard]] std::vector<SymbolGroup> group_symbols(const std::vector<Symbol>& symbols);

/// Declares `symbols`, which join the model's list of this role behind those that it has already, and the families that
/// they make.
void declare_symbols(ModelReader& reader, const std::vector<Symbol>& symbols, Role role);

/// Calls visit(role, symbol) for each symbol that a model declares, role by role.
template <class AnyModel, class Visit>
void for_each_symbol(AnyModel& model, Visit visit)
{
    const auto list = [&](Role role, auto& symbols) {
        for (auto& symbol : symbols) visit(role, symbol);
    };
    const auto records = [&](Role role, auto& all) {
        for (auto& each : all) visit(role, each.symbol);
    };
    records(Role::parameter, model.parameters);
    list(Role::base, model.base.coordinates);
    list(Role::fibre, model.fibre.coordinates);
    if (is_nonholonomic(model)) list(Role::ambient, model.algebroid.of[0].fibre);
    list(Role::momentum, model.fibre.momenta);
    if (model.control) list(Role::control, model.control->controls);
    records(Role::input, model.inputs);
    records(Role::state, model.states);
    if (!model.groupoid) return;
    list(Role::element, model.groupoid->element);
    list(Role::next, model.groupoid->next);
}

/// The symbols of these roles, in that order.
[[nodiscard]] std::vector<Symbol> symbols_of(const Model& model, Roles roles);
/// Throws ModelError where an invariant depends on an input: nothing is known of the rates of those.
void refuse_inputs_in(const Model& model, const std::vector<NamedTree>& invariants);
/// The parameters that are not bound.
[[nodiscard]] std::vector<Symbol> free_parameters(const Model& model);
/// True where the step of [discrete] is a symbol of its own, none of the parameters.
[[nodiscard]] bool has_own_step(const Model& model);

/// Declares the symbols of these roles and their families in `scope`.
void add_to_scope(Scope& scope, const Model& model, Roles roles);

/// `value` as one closed tree an entry of a symbol or family of the shape `wanted`: entry by entry, or one scalar for
/// all. `what` opens the message where the shapes differ, e.g. "the value of parameter 'm'"; `scalar_hint` ends it
/// where a scalar is wanted.
[[nodiscard]] std::vector<Tree> fit_values(const ArrayValue& value, const Shape& wanted, const std::string& what,
                                           const SourceRange& where, const std::string& scalar_hint = {});

} // namespace lagen
