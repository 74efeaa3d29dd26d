// SPDX-License-Identifier: GPL-2.0-or-later
/// Names of families and of their entries, by their texts: "x[3]" and "W[1,2]" are what closed trees contain.
#include "model/families.hpp"

#include "expression/parse_family.hpp"
#include "model/complaints.hpp"
#include "model/read_values.hpp"

#include <algorithm>
#include <fmt/format.h>

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
    if (begin == end || end - begin > most_digits || text[begin] == '0') return 0;
    std::size_t value = 0;
    for (; begin < end; ++begin) {
        if (text[begin] < '0' || text[begin] > '9') return 0;
        value = 10 * value + static_cast<std::size_t>(text[begin] - '0');
    }
    return value;
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

std::vector<std::size_t> numbers_from(std::size_t first, std::size_t count)
{
    std::vector<std::size_t> out(count);
    for (std::size_t k = 0; k < count; ++k) out[k] = first + k;
    return out;
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
    throw complain::names_no(owner, key.text, noun, key.range(0, key.text.size()),
                             hint ? hint(key.text) : hint_for_key(symbols, spelled, fmt::format("{}s", noun).c_str()));
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
        if (run && run->name == wanted && is_whole(symbols, k, *run))
            return ResolvedKey{wanted, run->shape, numbers_from(k, run->count)};
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
        throw complain::names_no(owner, found.name, fmt::format("single {}", noun), key.range(0, key.text.size()),
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
        if (run && !is_whole(symbols, k, *run)) {
            throw ModelError(fmt::format("'{}' would be an entry of the family '{}' without all the others",
                                         symbols[k].name, run->name),
                             symbols[k].where, "name the coordinates: [fibre] coordinates = [..]");
        }
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

std::vector<Excerpt> sides_of(const Excerpt& key)
{
    std::vector<Excerpt> out;
    std::size_t begin = 0;
    int depth = 0;
    for (std::size_t k = 0; k <= key.text.size(); ++k) {
        const char c = k < key.text.size() ? key.text[k] : ',';
        if (c == '[') ++depth;
        if (c == ']') --depth;
        if (c != ',' || (depth > 0 && k < key.text.size())) continue;
        out.push_back(trimmed(key, begin, k));
        begin = k + 1;
    }
    return out;
}

namespace {

FamilyRole family_role(Role role)
{
    switch (role) {
    case Role::parameter: return FamilyRole::parameter;
    case Role::base: return FamilyRole::base;
    case Role::fibre: return FamilyRole::fibre;
    case Role::ambient: return FamilyRole::ambient;
    case Role::momentum: return FamilyRole::momentum;
    case Role::control: return FamilyRole::control;
    case Role::state: return FamilyRole::state;
    case Role::input: return FamilyRole::input;
    case Role::element: return FamilyRole::element;
    case Role::next: return FamilyRole::next;
    default: throw InternalError("a family of a role that has none");
    }
}

/// The number of symbols that play this role so far.
std::size_t count_of(const Model& model, Role role)
{
    switch (role) {
    case Role::parameter: return model.parameters.size();
    case Role::base: return model.base.coordinates.size();
    case Role::fibre: return model.fibre.coordinates.size();
    case Role::ambient: return 0; // they stand in the block of the inner algebroid
    case Role::control: return model.control ? model.control->controls.size() : 0;
    case Role::state: return model.states.size();
    case Role::input: return model.inputs.size();
    case Role::element: return model.groupoid->element.size();
    case Role::next: return model.groupoid->next.size();
    default: return model.fibre.momenta.size();
    }
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

DeclaredKey read_declaration(const ModelReader& reader, const Excerpt& key)
{
    const SourceRange where = key.range(0, key.text.size());
    if (!has_bracket(key.text)) return {key.text, {}, {Symbol{key.text, where, {}, {}, {}}}};
    const FamilyDeclaration family = parse_family(key);
    DeclaredKey out{family.name, close_shape(family, reader.model.scope), {}};
    for (std::size_t k = 0; k < out.shape.size(); ++k)
        out.symbols.push_back(Symbol{entry_name(out.name, out.shape, k), where, {}, {}, {}});
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

namespace {

template <class Records>
std::vector<Symbol> symbols_of(const Records& records)
{
    std::vector<Symbol> out;
    for (const auto& each : records) out.push_back(each.symbol);
    return out;
}

} // namespace

std::vector<Symbol> parameter_symbols(const Model& model)
{
    return symbols_of(model.parameters);
}

std::vector<Symbol> state_symbols(const Model& model)
{
    return symbols_of(model.states);
}

std::vector<Symbol> input_symbols(const Model& model)
{
    return symbols_of(model.inputs);
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
    const std::size_t first = count_of(reader.model, role);
    for (const SymbolGroup& group : group_symbols(symbols)) {
        const SourceRange& where = symbols[group.first].where;
        if (group.shape.rank == Rank::scalar) {
            reader.names.declare(group.name, role, where);
            continue;
        }
        reader.names.declare_family(group.name, group.shape, role, where);
        reader.model.families.push_back(Family{group.name, family_role(role), group.shape, first + group.first, where});
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

void add_to_scope(Scope& scope, const Model& model, const std::vector<Symbol>& symbols, FamilyRole role)
{
    const auto family_at = [&](std::size_t k) {
        return std::find_if(model.families.begin(), model.families.end(),
                            [&](const Family& each) { return each.role == role && each.first == k; });
    };
    for (std::size_t k = 0; k < symbols.size();) {
        const auto family = family_at(k);
        if (family == model.families.end()) {
            scope.declare(symbols[k].name, symbols[k].where);
            ++k;
        } else {
            scope.declare_family(family->name, family->shape, family->where);
            k += family->shape.size();
        }
    }
}

} // namespace lagen
