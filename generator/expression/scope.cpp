// SPDX-License-Identifier: GPL-2.0-or-later
/// Declaring names, and what a closed tree may contain.
#include "expression/scope.hpp"

#include "expression/expansion.hpp"
#include "expression/parse.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

void Scope::require_new(const std::string& name, const SourceRange& where) const
{
    if (find_function(name))
        throw ModelError(fmt::format("{} is a built-in function and cannot be declared", quote(name)), where,
                         "choose another name");
    const auto symbol = symbol_index_.find(name);
    const Definition* definition = find_definition(name);
    if (symbol == symbol_index_.end() && !definition) return;
    const SourceRange& first = definition ? definition->where : symbols_[symbol->second].where;
    const std::string at = place(first);
    throw ModelError(fmt::format("{} is declared twice", quote(name)), where,
                     at.empty() ? "" : fmt::format("the first declaration is at {}", at));
}

void Scope::declare(const std::string& symbol, const SourceRange& where)
{
    require_new(symbol, where);
    symbol_index_.emplace(symbol, symbols_.size());
    symbols_.push_back({symbol, where});
    expansion_.reset();
}

void Scope::define(Definition definition)
{
    require_new(definition.name, definition.where);
    const std::vector<std::string>& parameters = definition.parameters;
    for (auto parameter = parameters.begin(); parameter != parameters.end(); ++parameter) {
        if (find_function(*parameter))
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

bool Scope::has_symbol(const std::string& name) const
{
    return symbol_index_.contains(name);
}

const Definition* Scope::find_definition(const std::string& name) const
{
    const auto found = definition_index_.find(name);
    return found == definition_index_.end() ? nullptr : &definitions_[found->second];
}

Tree Scope::close(const Tree& tree, bool nonsmooth) const
{
    if (!expansion_) expansion_ = std::make_shared<Expansion>();
    const ClosedTree closed = expansion_->close(*this, tree);
    const TreeNode* refused = closed.measure.nonsmooth;
    if (refused && !nonsmooth)
        throw ModelError(fmt::format("the function '{}' is not smooth", entry_of(refused->function).name),
                         refused->where, "min, max, sign and if stand in forces, observables and events only");
    return closed.tree;
}

Scope Scope::with(const std::vector<std::string>& symbols) const
{
    Scope wider = *this;
    for (const std::string& symbol : symbols)
        if (!has_symbol(symbol) && !find_definition(symbol) && !wider.has_symbol(symbol)) wider.declare(symbol, {});
    return wider;
}

void Scope::check_definitions() const
{
    if (!expansion_) expansion_ = std::make_shared<Expansion>();
    for (const Definition& definition : definitions_) expansion_->check(*this, definition);
}

} // namespace lagen
