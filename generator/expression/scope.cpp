// SPDX-License-Identifier: GPL-2.0-or-later
/// Declaring names, and what a closed tree may contain.
#include "expression/scope.hpp"

#include "expression/derivative.hpp"
#include "expression/expansion.hpp"
#include "expression/parse.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>

namespace lagen {

namespace {

/// [row] or [row,column] at the end of an entry's name.
struct EntryIndices {
    Rank rank = Rank::vector;
    std::size_t row = 0, column = 1;
};

/// Reads "[12]" or "[1,2]" exactly as entry_name writes them: no spaces, no leading zeros.
std::optional<EntryIndices> indices_of(std::string_view name)
{
    EntryIndices result;
    const std::size_t open = name.find('[');
    const char* at = name.data() + open + 1;
    const char* end = name.data() + name.size() - 1;
    if (at == end || *at == '0') return std::nullopt;
    auto read = std::from_chars(at, end, result.row);
    if (read.ec != std::errc()) return std::nullopt;
    if (read.ptr == end) return result;
    if (*read.ptr != ',' || read.ptr + 1 == end || read.ptr[1] == '0') return std::nullopt;
    result.rank = Rank::matrix;
    read = std::from_chars(read.ptr + 1, end, result.column);
    return read.ec == std::errc() && read.ptr == end ? std::optional<EntryIndices>(result) : std::nullopt;
}

} // namespace

UnknownSymbol::UnknownSymbol(std::string name, const SourceRange& where, const std::string& hint, bool explained)
    : ModelError(fmt::format("unknown symbol {}", quote(name)), where, hint), name_(std::move(name)),
      explained_(explained)
{
}

const SourceRange* Scope::find_declaration(const std::string& name) const
{
    if (const Definition* definition = find_definition(name)) return &definition->where;
    if (const auto symbol = symbol_index_.find(name); symbol != symbol_index_.end())
        return &symbols_[symbol->second].where;
    if (const auto family = family_index_.find(name); family != family_index_.end())
        return &families_[family->second].where;
    if (const auto size = size_index_.find(name); size != size_index_.end()) return &sizes_[size->second].where;
    return nullptr;
}

void Scope::require_new(const std::string& name, const SourceRange& where) const
{
    if (is_reserved_name(name))
        throw ModelError(fmt::format("{} is a built-in function and cannot be declared", quote(name)), where,
                         "choose another name");
    const SourceRange* first = find_declaration(name);
    if (!first) return;
    const std::string at = place(*first);
    throw ModelError(fmt::format("{} is declared twice", quote(name)), where,
                     at.empty() ? "" : fmt::format("the first declaration is at {}", at));
}

void Scope::declare(const std::string& symbol, const SourceRange& where)
{
    require_new(symbol, where);
    symbol_index_.emplace(symbol, symbols_.size());
    symbols_.push_back({symbol, where});
    order_.push_back(symbol);
    expansion_.reset();
}

void Scope::declare_family(const std::string& name, const Shape& shape, const SourceRange& where)
{
    if (shape.rank == Rank::scalar) return declare(name, where);
    require_new(name, where);
    family_index_.emplace(name, families_.size());
    families_.push_back({name, shape, where});
    order_.push_back(name);
    expansion_.reset();
}

void Scope::declare_size(const std::string& name, long value, const SourceRange& where)
{
    require_new(name, where);
    size_index_.emplace(name, sizes_.size());
    sizes_.push_back({name, value, where});
    order_.push_back(name);
    expansion_.reset();
}

void Scope::explain(const std::string& name, const std::string& hint)
{
    explanations_[name] = hint;
}

void Scope::list_last(const std::string& name)
{
    last_.insert(name);
}

void Scope::define(Definition definition)
{
    require_new(definition.name, definition.where);
    const std::vector<std::string>& parameters = definition.parameters;
    if (!parameters.empty() && is_function_name(definition.name))
        throw ModelError(fmt::format("{} is a built-in function and cannot be defined", quote(definition.name)),
                         definition.where, "choose another name");
    for (auto parameter = parameters.begin(); parameter != parameters.end(); ++parameter) {
        if (is_reserved_name(*parameter))
            throw ModelError(fmt::format("{} is a built-in function and cannot be a parameter", quote(*parameter)),
                             definition.where, "choose another name");
        if (std::find(parameters.begin(), parameter, *parameter) != parameter)
            throw ModelError(fmt::format("the parameter {} stands twice", quote(*parameter)), definition.where,
                             "the parameters of a function have different names");
    }
    definition_index_.emplace(definition.name, definitions_.size());
    definitions_.push_back(std::move(definition));
    expansion_.reset();
}

/// Entries are looked up by the text that entry_name gives them.
bool Scope::has_symbol(const std::string& name) const
{
    if (symbol_index_.contains(name)) return true;
    if (!name.ends_with(']')) return false;
    const Shape* shape = find_family(name.substr(0, name.find('[')));
    if (!shape) return false;
    const std::optional<EntryIndices> indices = indices_of(name);
    return indices && indices->rank == shape->rank && indices->row >= 1 && indices->row <= shape->rows &&
           indices->column >= 1 && indices->column <= shape->columns;
}

bool Scope::has_name(const std::string& name) const
{
    return has_symbol(name) || family_index_.contains(name) || size_index_.contains(name);
}

const Shape* Scope::find_family(const std::string& name) const
{
    const auto found = family_index_.find(name);
    return found == family_index_.end() ? nullptr : &families_[found->second].shape;
}

std::optional<long> Scope::find_size(const std::string& name) const
{
    const auto found = size_index_.find(name);
    return found == size_index_.end() ? std::nullopt : std::optional<long>(sizes_[found->second].value);
}

std::vector<std::string> Scope::value_names() const
{
    std::vector<std::string> names = order_;
    for (const Definition& definition : definitions_)
        if (definition.parameters.empty() && !is_rate_name(definition.name)) names.push_back(definition.name);
    std::stable_partition(names.begin(), names.end(),
                          [this](const std::string& name) { return !last_.contains(name); });
    return names;
}

std::string Scope::entry_meant(const std::string& name) const
{
    const std::size_t length = name.find_last_not_of("0123456789") + 1;
    if (length == 0 || length == name.size()) return {};
    const std::string digits = name.substr(length);
    const std::string family = name.substr(0, name[length - 1] == '_' ? length - 1 : length);
    for (const std::string& stem : {name.substr(0, length), family}) {
        std::string entry = fmt::format("{}[{}]", stem, digits);
        if (has_symbol(entry)) return entry;
        if (digits.size() == 2) entry = fmt::format("{}[{},{}]", stem, digits[0], digits[1]);
        if (has_symbol(entry)) return entry;
    }
    return {};
}

const Definition* Scope::find_definition(const std::string& name) const
{
    const auto found = definition_index_.find(name);
    return found == definition_index_.end() ? nullptr : &definitions_[found->second];
}

ArrayValue Scope::close_array(const Tree& tree, bool nonsmooth) const
{
    if (!expansion_) expansion_ = std::make_shared<Expansion>();
    const Value value = expansion_->close(*this, tree);
    ArrayValue result{value->shape, {}};
    for (const ClosedTree& entry : expansion_->entries(value, tree->where)) {
        const TreeNode* refused = entry.measure.nonsmooth;
        if (refused && !nonsmooth)
            throw ModelError(fmt::format("the function '{}' is not smooth", entry_of(refused->function).name),
                             refused->where, "min, max, sign and if stand in forces, observables and events only");
        result.entries.push_back(entry.tree);
    }
    return result;
}

Tree Scope::close(const Tree& tree, bool nonsmooth) const
{
    const ArrayValue value = close_array(tree, nonsmooth);
    if (value.shape.rank == Rank::scalar) return value.entries[0];
    throw ModelError(fmt::format("{} stands where a scalar is required", to_text(value.shape)), tree->where,
                     value.shape.rank == Rank::vector ? "an entry is written x[1], a norm norm(x)"
                                                      : "an entry is written W[1,2]");
}

std::optional<long> Scope::integer(const Tree& tree) const
{
    if (!expansion_) expansion_ = std::make_shared<Expansion>();
    return integer_of(*expansion_->close(*this, tree));
}

Scope Scope::with(const std::vector<std::string>& symbols) const
{
    Scope wider = *this;
    for (const std::string& symbol : symbols)
        if (!wider.has_name(symbol) && !wider.find_definition(symbol)) wider.declare(symbol, {});
    return wider;
}

void Scope::check_definitions() const
{
    if (!expansion_) expansion_ = std::make_shared<Expansion>();
    // A body that is closed for parameters of unknown shape says nothing of other uses: it is kept apart.
    Expansion functions;
    for (const Definition& definition : definitions_)
        if (!is_rate_name(definition.name)) // closed already
            (definition.parameters.empty() ? *expansion_ : functions).check(*this, definition);
}

} // namespace lagen
