// SPDX-License-Identifier: GPL-2.0-or-later
/// Closing trees: names to symbols, definitions to their closed bodies, within bounds.
#include "expression/expansion.hpp"

#include "expression/name_hints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace lagen {

namespace {

constexpr std::size_t deepest = 2000;
/// An operation, the name below it and the definition behind the name take a level each.
constexpr std::size_t deepest_walk = 3 * deepest;
constexpr std::size_t most_nodes = 1'000'000;

/// The bounds of the parser; several definitions may stand inside one another.
const ParseLimits limits{.height = deepest};

std::optional<std::size_t> parameter_index(const Body& body, const std::string& name)
{
    if (!body.definition) return std::nullopt;
    const std::vector<std::string>& parameters = body.definition->parameters;
    const auto found = std::find(parameters.begin(), parameters.end(), name);
    if (found == parameters.end()) return std::nullopt;
    return static_cast<std::size_t>(found - parameters.begin());
}

} // namespace

/// Counts one level of recursion for as long as it lives.
class Expansion::Level {
  public:
    Level(Expansion& expansion, const SourceRange& where) : expansion_(expansion)
    {
        if (expansion.depth_ >= deepest_walk)
            throw ModelError(fmt::format("the definitions used here are nested more than {} operations deep", deepest),
                             where, "shorten the chain of definitions");
        ++expansion_.depth_;
    }
    ~Level() { --expansion_.depth_; }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;

  private:
    Expansion& expansion_;
};

ClosedTree Expansion::close(const Scope& scope, const Tree& tree)
{
    // An error may have left a call half way.
    scope_ = &scope;
    depth_ = 0;
    active_.clear();
    Body body;
    return close_node(tree, body);
}

void Expansion::check(const Scope& scope, const Definition& definition)
{
    scope_ = &scope;
    depth_ = 0;
    active_.clear();
    std::vector<ClosedTree> arguments;
    for (const std::string& parameter : definition.parameters) {
        const Tree symbol = name(parameter, definition.where);
        arguments.push_back({symbol, measure(*symbol, {}, limits)});
    }
    (void)expand(definition, std::move(arguments), definition.where);
}

ClosedTree Expansion::close_node(const Tree& tree, Body& body)
{
    const auto known = body.done.find(tree.get());
    if (known != body.done.end()) return known->second;
    const Level level(*this, tree->where);
    ClosedTree result;
    switch (tree->kind) {
    case TreeKind::pi:
    case TreeKind::name: result = close_name(tree, body); break;
    case TreeKind::apply: result = close_application(tree, body); break;
    default: result = close_operation(tree, body); break;
    }
    // Only a shared node can be asked for again.
    if (tree.use_count() > 1 && !tree->arguments.empty()) body.done.emplace(tree.get(), result);
    return result;
}

ClosedTree Expansion::leaf(const Tree& tree) const
{
    return {tree, measure(*tree, {}, limits)};
}

ClosedTree Expansion::close_name(const Tree& tree, const Body& body)
{
    const std::string& text = tree->kind == TreeKind::pi ? "pi" : tree->name;
    if (const auto parameter = parameter_index(body, text)) return body.arguments[*parameter];
    if (scope_->has_symbol(text)) return leaf(tree->kind == TreeKind::pi ? name(text, tree->where) : tree);
    const Definition* definition = scope_->find_definition(text);
    if (!definition && tree->kind == TreeKind::pi) return leaf(tree);
    if (!definition) unknown(*tree, body, false);
    if (!definition->parameters.empty())
        throw ModelError(
            fmt::format("the function {} stands without arguments", quote(text)), tree->where,
            fmt::format("its arguments stand in parentheses: {}({})", text, fmt::join(definition->parameters, ", ")));
    return expand(*definition, {}, tree->where);
}

ClosedTree Expansion::close_application(const Tree& tree, Body& body)
{
    const Definition* definition = scope_->find_definition(tree->name);
    const bool is_value = parameter_index(body, tree->name) || scope_->has_symbol(tree->name) ||
                          (definition && definition->parameters.empty());
    if (is_value)
        throw ModelError(fmt::format("{} is not a function", quote(tree->name)), tree->where,
                         fmt::format("a product is written with '*': {}*(...)", tree->name));
    if (!definition) unknown(*tree, body, true);
    const std::size_t wanted = definition->parameters.size();
    const std::size_t given = tree->arguments.size();
    if (given != wanted)
        throw ModelError(fmt::format("{} takes {} argument{}, and {} {} given", tree->name, wanted,
                                     wanted == 1 ? "" : "s", given, given == 1 ? "is" : "are"),
                         tree->where,
                         fmt::format("it is defined as {}({})", tree->name, fmt::join(definition->parameters, ", ")));
    return expand(*definition, close_arguments(tree, body), tree->where);
}

std::vector<ClosedTree> Expansion::close_arguments(const Tree& tree, Body& body)
{
    std::vector<ClosedTree> arguments;
    arguments.reserve(tree->arguments.size());
    for (const Tree& argument : tree->arguments) arguments.push_back(close_node(argument, body));
    return arguments;
}

/// The node itself where its arguments are closed already, else a copy with closed arguments.
ClosedTree Expansion::close_operation(const Tree& tree, Body& body)
{
    std::vector<ClosedTree> arguments = close_arguments(tree, body);
    std::vector<Measure> measures;
    measures.reserve(arguments.size());
    bool changed = false;
    for (std::size_t k = 0; k < arguments.size(); ++k) {
        changed = changed || arguments[k].tree != tree->arguments[k];
        measures.push_back(std::move(arguments[k].measure));
    }
    if (body.definition && ++nodes_ > most_nodes)
        throw ModelError(fmt::format("the definitions expand to more than {} operations", most_nodes), tree->where,
                         "a function is expanded once for each distinct list of its arguments");
    if (!changed) return {tree, measure(*tree, measures, limits)};
    auto copy = std::make_shared<TreeNode>(*tree);
    for (std::size_t k = 0; k < arguments.size(); ++k) copy->arguments[k] = std::move(arguments[k].tree);
    Measure size = measure(*copy, measures, limits);
    return {std::move(copy), std::move(size)};
}

ClosedTree Expansion::expand(const Definition& definition, std::vector<ClosedTree> arguments, const SourceRange& use)
{
    const Level level(*this, use);
    std::pair<std::string, std::vector<std::size_t>> key{definition.name, {}};
    if (definition.parameters.empty()) {
        const auto known = named_.find(definition.name);
        if (known != named_.end()) return known->second;
    } else {
        for (const ClosedTree& argument : arguments) key.second.push_back(identity_(argument.tree));
        const auto known = applied_.find(key);
        if (known != applied_.end()) return known->second;
    }
    refuse_cycle(definition, use);
    active_.push_back(&definition);
    Body body{&definition, std::move(arguments), {}};
    ClosedTree result = close_node(definition.body, body);
    active_.pop_back();
    if (definition.parameters.empty())
        named_.emplace(definition.name, result);
    else
        applied_.emplace(std::move(key), result);
    return result;
}

void Expansion::refuse_cycle(const Definition& definition, const SourceRange& use) const
{
    const auto first = std::find(active_.begin(), active_.end(), &definition);
    if (first == active_.end()) return;
    constexpr std::size_t most = 8;
    std::string cycle;
    for (auto step = first; step != active_.end(); ++step) {
        if (static_cast<std::size_t>(step - first) == most) {
            cycle += "... -> ";
            break;
        }
        cycle += (*step)->name;
        cycle += " -> ";
    }
    throw ModelError(fmt::format("the definition of {} refers to itself", quote(definition.name)), use,
                     fmt::format("the cycle is {}{}", cycle, definition.name));
}

void Expansion::unknown(const TreeNode& node, const Body& body, bool as_function) const
{
    std::vector<std::string> known;
    if (body.definition && !as_function) known = body.definition->parameters;
    if (!as_function)
        for (const Scope::Symbol& symbol : scope_->symbols_) known.push_back(symbol.name);
    for (const Definition& definition : scope_->definitions_)
        if (definition.parameters.empty() != as_function) known.push_back(definition.name);
    throw ModelError(fmt::format("unknown {} {}", as_function ? "function" : "symbol", quote(node.name)), node.where,
                     as_function ? hint_for_function(node.name, known) : hint_for_symbol(node.name, known));
}

} // namespace lagen
