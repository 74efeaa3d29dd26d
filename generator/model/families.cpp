// SPDX-License-Identifier: GPL-2.0-or-later
/// Names of families and of their entries, by their texts: "x[3]" and "W[1,2]" are what closed trees contain.
#include "model/families.hpp"

#include "expression/parse_family.hpp"
#include "model/complaints.hpp"
#include "model/read_values.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>

namespace lagen {

namespace {

/// "x[3]" or "W[1,2]", blanks inside the brackets allowed.
struct EntryName {
    std::string family;
    std::size_t row = 0;
    std::size_t column = 0; ///< 0: of a vector

    [[nodiscard]] std::string text() const
    {
        return column == 0 ? fmt::format("{}[{}]", family, row) : fmt::format("{}[{},{}]", family, row, column);
    }
};

/// The number in bytes [begin, end) of `text`, blanks around it aside; 0 where there is none.
std::size_t read_index(const std::string& text, std::size_t begin, std::size_t end)
{
    constexpr std::size_t most_digits = 6;
    while (begin < end && text[begin] == ' ') ++begin;
    while (end > begin && text[end - 1] == ' ') --end;
    const std::string digits = text.substr(begin, end - begin);
    const bool is_number = !digits.empty() && digits.size() <= most_digits && digits[0] != '0' &&
                           digits.find_first_not_of("0123456789") == std::string::npos;
    return is_number ? std::stoul(digits) : 0;
}

std::optional<EntryName> split_entry(const std::string& name)
{
    const std::size_t open = name.find('[');
    if (open == std::string::npos || open == 0 || name.back() != ']') return std::nullopt;
    const std::size_t close = name.size() - 1;
    const std::size_t comma = name.find(',', open);
    EntryName entry{name.substr(0, open), 0, 0};
    while (!entry.family.empty() && entry.family.back() == ' ') entry.family.pop_back();
    entry.row = read_index(name, open + 1, std::min(comma, close));
    if (comma != std::string::npos) entry.column = read_index(name, comma + 1, close);
    const bool complete = entry.row > 0 && (comma == std::string::npos || entry.column > 0);
    return complete ? std::optional(std::move(entry)) : std::nullopt;
}

/// The entries of one family that stand together from number `first` on; the shape is that of the last of them.
struct Run {
    std::string name;
    Shape shape;
    std::size_t count;
};

std::optional<Run> run_at(const std::vector<Symbol>& symbols, std::size_t first)
{
    std::optional<EntryName> last = split_entry(symbols[first].name);
    if (!last) return std::nullopt;
    Run run{last->family, {}, 1};
    for (; first + run.count < symbols.size(); ++run.count) {
        std::optional<EntryName> next = split_entry(symbols[first + run.count].name);
        if (!next || next->family != run.name) break;
        last = std::move(next);
    }
    run.shape = last->column == 0 ? Shape{Rank::vector, last->row, 1} : Shape{Rank::matrix, last->row, last->column};
    return run;
}

bool is_whole(const std::vector<Symbol>& symbols, std::size_t first, const Run& run)
{
    if (run.count != run.shape.size()) return false;
    for (std::size_t k = 0; k < run.count; ++k) {
        if (symbols[first + k].name != entry_name(run.name, run.shape, k)) return false;
    }
    return true;
}

/// `spelled` is the key with numbers for its indices.
[[noreturn]] void refuse_key(const std::vector<Symbol>& symbols, const Excerpt& key, const std::string& owner,
                             const char* noun, const std::string& spelled, const ModelReader::Hint& hint)
{
    throw complain::names_no(owner, key.text, noun, place_of(key),
                             hint ? hint(key.text) : hint_for_key(symbols, spelled, fmt::format("{}s", noun).c_str()));
}

void append_symbol(Model& model, const Symbol& symbol, Role role)
{
    switch (role) {
    case Role::parameter: model.parameters.push_back(Parameter{symbol, nullptr}); break;
    case Role::base: model.base.coordinates.push_back(symbol); break;
    case Role::fibre: model.fibre.coordinates.push_back(symbol); break;
    case Role::ambient: break;
    case Role::control: model.control->controls.push_back(symbol); break;
    case Role::state: model.states.push_back(FirstOrderState{symbol, nullptr, 0}); break;
    case Role::input: model.inputs.push_back(Input{symbol, nullptr}); break;
    case Role::element: model.groupoid->element.push_back(symbol); break;
    case Role::next: model.groupoid->next.push_back(symbol); break;
    default: model.fibre.momenta.push_back(symbol); break;
    }
}

} // namespace

std::optional<ResolvedKey> resolve_key(const std::vector<Symbol>& symbols, const std::string& key)
{
    const std::optional<EntryName> entry = split_entry(key);
    const std::string wanted = entry ? entry->text() : key;
    for (std::size_t k = 0; k < symbols.size(); ++k) {
        if (symbols[k].name == wanted) return ResolvedKey{wanted, {}, {k}};
        if (entry || !symbols[k].name.starts_with(wanted + "[")) continue;
        const std::optional<Run> run = run_at(symbols, k);
        if (!run || run->name != wanted || !is_whole(symbols, k, *run)) continue;
        ResolvedKey family{wanted, run->shape, std::vector<std::size_t>(run->count)};
        std::iota(family.indices.begin(), family.indices.end(), k);
        return family;
    }
    return std::nullopt;
}

ResolvedKey require_key(const std::vector<Symbol>& symbols, const Excerpt& key, const std::string& owner,
                        const char* noun, const Scope* scope, const ModelReader::Hint& hint)
{
    if (auto found = resolve_key(symbols, scope != nullptr ? entry_key(key, *scope) : key.text))
        return *std::move(found);
    refuse_key(symbols, key, owner, noun, key.text, hint);
}

std::size_t require_entry(const std::vector<Symbol>& symbols, const Excerpt& key, const std::string& owner,
                          const char* noun, const Scope* scope)
{
    const ResolvedKey found = require_key(symbols, key, owner, noun, scope);
    if (found.shape.rank != Rank::scalar)
        throw complain::names_no(owner, found.name, fmt::format("single {}", noun), place_of(key),
                                 fmt::format("for example \"{}\"", symbols[found.indices[0]].name));
    return found.indices[0];
}

std::vector<RunningKey> require_keys(const std::vector<Symbol>& symbols, const Excerpt& key, const std::string& owner,
                                     const char* noun, const Scope& scope, const ModelReader::Hint& hint)
{
    const std::vector<std::string> running = running_indices(key, scope);
    if (std::ranges::all_of(running, [](const std::string& index) { return index.empty(); }))
        return {{require_key(symbols, key, owner, noun, &scope, hint), {}}};
    std::map<std::string, std::size_t> values;
    for (const std::string& index : running)
        if (!index.empty()) values.emplace(index, 1);
    const std::string first = entry_key(key, scope, values);
    const std::optional<ResolvedKey> family = resolve_key(symbols, family_name(first));
    std::vector<RunningKey> out;
    for (std::size_t k = 0; family && k < family->shape.size(); ++k) {
        const std::size_t columns = family->shape.columns;
        std::map<std::string, Tree> trees;
        for (std::size_t place = 0; place < running.size(); ++place) {
            const std::size_t value = (place == 0 ? k / columns : k % columns) + 1;
            if (running[place].empty() || trees.contains(running[place])) continue;
            values[running[place]] = value;
            trees.emplace(running[place], number(static_cast<unsigned long>(value)));
        }
        const std::string entry = entry_key(key, scope, values);
        const bool met = entry == entry_name(family->name, family->shape, k); // of W[j,j] the diagonal, of W[1,j] a row
        if (met) out.push_back({*resolve_key(symbols, entry), std::move(trees)});
    }
    if (out.empty()) refuse_key(symbols, key, owner, noun, first, hint);
    return out;
}

std::string hint_for_key(const std::vector<Symbol>& symbols, const std::string& key, const char* noun)
{
    const std::string family = family_name(key);
    const std::optional<ResolvedKey> known = resolve_key(symbols, family);
    if (!known || (family == key && known->shape.rank == Rank::scalar))
        return hint_for(key, declared_names(symbols), noun);
    const Shape& shape = known->shape;
    if (shape.rank == Rank::scalar) return fmt::format("'{}' has no entries", family);
    return fmt::format("the entries of '{}' are {} to {}", family, entry_name(family, shape, 0),
                       entry_name(family, shape, shape.size() - 1));
}

std::string family_name(const std::string& name)
{
    const std::optional<EntryName> entry = split_entry(name);
    return entry ? entry->family : name;
}

std::string next_name(const std::string& name)
{
    const std::size_t open = name.find('[');
    return name.substr(0, open) + "_next" + (open == std::string::npos ? "" : name.substr(open));
}

bool names_entry(const std::string& key, const std::string& name)
{
    const std::optional<EntryName> entry = split_entry(key);
    return entry ? entry->text() == name : key == name || key == family_name(name);
}

std::vector<std::string> declared_names(const std::vector<Symbol>& symbols)
{
    std::vector<std::string> out;
    for (const Symbol& symbol : symbols) {
        std::string name = family_name(symbol.name);
        if (out.empty() || out.back() != name) out.push_back(std::move(name));
    }
    return out;
}

std::vector<SymbolGroup> group_symbols(const std::vector<Symbol>& symbols)
{
    std::vector<SymbolGroup> out;
    for (std::size_t k = 0; k < symbols.size(); k += out.back().shape.size()) {
        const std::optional<Run> run = run_at(symbols, k);
        if (run && !is_whole(symbols, k, *run))
            throw ModelError(fmt::format("'{}' would be an entry of the family '{}' without all the others",
                                         symbols[k].name, run->name),
                             symbols[k].where, "name the coordinates: [fibre] coordinates = [..]");
        out.push_back(run ? SymbolGroup{run->name, run->shape, k} : SymbolGroup{symbols[k].name, {}, k});
    }
    return out;
}

std::vector<Tree> fit_values(const ArrayValue& value, const Shape& wanted, const std::string& what,
                             const SourceRange& where, const std::string& scalar_hint)
{
    if (value.shape == wanted) return value.entries;
    if (value.shape.rank == Rank::scalar) return std::vector<Tree>(wanted.size(), value.entries[0]);
    throw complain::is_not(what, to_text(value.shape), to_text(wanted), where,
                           wanted.rank == Rank::scalar ? scalar_hint : "one number stands for all entries");
}

DeclaredKey read_declaration(const ModelReader& reader, const Excerpt& key)
{
    const SourceRange where = place_of(key);
    if (!has_bracket(key.text)) return {key.text, {}, symbols_called(key.text, {}, where)};
    const FamilyDeclaration family = parse_family(key);
    const Shape shape = close_shape(family, reader.model.scope);
    return {family.name, shape, symbols_called(family.name, shape, where)};
}

std::vector<Symbol> symbols_called(const std::string& name, const Shape& shape, const SourceRange& where)
{
    std::vector<Symbol> out;
    for (std::size_t k = 0; k < shape.size(); ++k) out.push_back(Symbol{entry_name(name, shape, k), where, {}, {}, {}});
    return out;
}

std::string key_of(const ModelReader& reader, const Setting& setting)
{
    return entry_key(whole_text(option_of(setting), setting.name), reader.model.scope);
}

const char* option_of(const Setting& setting)
{
    return setting.binds ? "<--bind>" : "<--set>";
}

std::vector<Symbol> symbols_of(const Model& model, Roles roles)
{
    std::vector<Symbol> out;
    for_each_symbol(model, [&](Role role, const Symbol& symbol) {
        if (roles.has(role)) out.push_back(symbol);
    });
    return out;
}

std::vector<Symbol> free_parameters(const Model& model)
{
    std::vector<Symbol> out;
    for (const Parameter& parameter : model.parameters)
        if (!parameter.bound) out.push_back(parameter.symbol);
    return out;
}

bool has_own_step(const Model& model)
{
    return model.discrete && std::ranges::none_of(model.parameters, [&](const Parameter& parameter) {
               return parameter.symbol.name == model.discrete->step.name;
           });
}

void declare_symbols(ModelReader& reader, const std::vector<Symbol>& symbols, Role role)
{
    // Ambient coordinates stand in the block of the inner algebroid already.
    const std::size_t first = role == Role::ambient ? 0 : symbols_of(reader.model, role).size();
    for (const SymbolGroup& group : group_symbols(symbols)) {
        const SourceRange& where = symbols[group.first].where;
        if (group.shape.rank == Rank::scalar) {
            reader.names.declare(group.name, role, where);
            continue;
        }
        reader.names.declare_family(group.name, group.shape, role, where);
        reader.model.families.push_back(Family{group.name, role, group.shape, first + group.first, where});
    }
    for (const Symbol& symbol : symbols) append_symbol(reader.model, symbol, role);
}

std::vector<Symbol> read_names(const ModelReader& reader, const Item& list)
{
    std::vector<Symbol> out;
    for (const Excerpt& key : list.texts()) {
        const DeclaredKey declared = read_declaration(reader, key);
        out.insert(out.end(), declared.symbols.begin(), declared.symbols.end());
    }
    return out;
}

std::size_t index_of(const std::vector<Symbol>& symbols, const std::string& name)
{
    return static_cast<std::size_t>(std::ranges::find(symbols, name, &Symbol::name) - symbols.begin());
}

std::vector<std::string> names_of(const std::vector<Symbol>& symbols)
{
    std::vector<std::string> out;
    for (const Symbol& symbol : symbols) out.push_back(symbol.name);
    return out;
}

bool is_plain_zero(const Tree& tree)
{
    return tree->kind == TreeKind::number && tree->number == 0;
}

void add_to_scope(Scope& scope, const Model& model, Roles roles)
{
    for_each_symbol(model, [&](Role role, const Symbol& symbol) {
        if (!roles.has(role)) return;
        const std::string name = family_name(symbol.name);
        const auto family = std::ranges::find_if(
            model.families, [&](const Family& each) { return each.role == role && each.name == name; });
        if (family == model.families.end())
            scope.declare(symbol.name, symbol.where);
        else if (symbol.name == entry_name(name, family->shape, 0))
            scope.declare_family(name, family->shape, family->where);
    });
}

} // namespace lagen
