// SPDX-License-Identifier: GPL-2.0-or-later
/// Closing trees: names to symbols, definitions to their closed bodies, within bounds. The walk keeps its own stack:
/// chains of definitions are as deep as a user makes them.
#include "expression/expansion.hpp"

#include "expression/name_hints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

namespace lagen {

namespace {

constexpr std::size_t deepest = 2000;
/// An operation, the application below it and the definition behind that take an entry of the stack each.
constexpr std::size_t tallest_stack = 3 * deepest;
constexpr std::size_t most_operations = 1'000'000;

/// The bounds of the parser; several definitions may stand inside one another.
const ParseLimits limits{.height = deepest};

/// What the names of one body mean: for a function, its parameters are its arguments' closed trees.
struct Body {
    const Definition* definition = nullptr; ///< null: an expression outside of the definitions
    std::vector<ClosedTree> arguments;
    std::unordered_map<const TreeNode*, ClosedTree> done; ///< by address; looked up, never iterated
};

const ClosedTree* find_argument(const Body& body, const std::string& name)
{
    if (!body.definition) return nullptr;
    const std::vector<std::string>& parameters = body.definition->parameters;
    const auto found = std::find(parameters.begin(), parameters.end(), name);
    return found == parameters.end() ? nullptr : &body.arguments[static_cast<std::size_t>(found - parameters.begin())];
}

ClosedTree leaf(const Tree& tree)
{
    return {tree, measure(*tree, {}, limits)};
}

/// The node itself where its arguments are closed already, else a copy with closed arguments.
ClosedTree operation(const Tree& tree, std::vector<ClosedTree> arguments)
{
    std::vector<Measure> measures;
    measures.reserve(arguments.size());
    bool changed = false;
    for (std::size_t k = 0; k < arguments.size(); ++k) {
        changed = changed || arguments[k].tree != tree->arguments[k];
        measures.push_back(std::move(arguments[k].measure));
    }
    if (!changed) return {tree, measure(*tree, measures, limits)};
    auto copy = std::make_shared<TreeNode>(*tree);
    for (std::size_t k = 0; k < arguments.size(); ++k) copy->arguments[k] = std::move(arguments[k].tree);
    Measure size = measure(*copy, measures, limits);
    return {std::move(copy), std::move(size)};
}

} // namespace

/// One walk. `enter` gives the closed tree at once where it can, else it leaves a frame; `advance` takes the last frame
/// one step further.
class Expansion::Closing {
  public:
    Closing(Expansion& expansion, const Scope& scope) : expansion_(expansion), scope_(scope) {}

    ClosedTree close(const Tree& tree) { return run(enter(tree, std::make_shared<Body>())); }

    ClosedTree expand_all(const Definition& definition, std::vector<ClosedTree> arguments)
    {
        return run(expand(definition, std::move(arguments), definition.where));
    }

  private:
    using Result = std::optional<ClosedTree>; ///< nothing: a frame was left that will give it

    /// An operation or application whose arguments are being closed, or (`expands`) a definition whose body is.
    struct Frame {
        Tree tree; ///< null for a definition
        std::shared_ptr<Body> body;
        std::vector<ClosedTree> arguments;
        bool expands = false;
        Key key;
    };

    ClosedTree run(Result result)
    {
        while (!frames_.empty()) {
            if (result) frames_.back().arguments.push_back(std::move(*result));
            result = advance();
        }
        return std::move(*result);
    }

    Result enter(const Tree& tree, const std::shared_ptr<Body>& body);
    Result enter_name(const Tree& tree, const Body& body);
    Result advance();
    Result finish_operation();
    Result expand(const Definition& definition, std::vector<ClosedTree> arguments, const SourceRange& use);
    const Definition& function_of(const TreeNode& node, const Body& body) const;
    void push(Frame frame, const SourceRange& where);
    void refuse_cycle(const Definition& definition, const SourceRange& use) const;
    [[noreturn]] void unknown(const TreeNode& node, const Body& body, bool as_function) const;

    Expansion& expansion_;
    const Scope& scope_;
    std::vector<Frame> frames_;
    std::vector<const Definition*> active_; ///< of the frames that expand
};

Expansion::Closing::Result Expansion::Closing::enter(const Tree& tree, const std::shared_ptr<Body>& body)
{
    if (tree->kind == TreeKind::name || tree->kind == TreeKind::pi) return enter_name(tree, *body);
    if (tree->arguments.empty() && tree->kind != TreeKind::apply) return leaf(tree);
    const auto known = body->done.find(tree.get());
    if (known != body->done.end()) return known->second;
    if (tree->kind == TreeKind::apply) (void)function_of(*tree, *body); // its mistakes come before its arguments'
    push({tree, body, {}, false, {}}, tree->where);
    return std::nullopt;
}

Expansion::Closing::Result Expansion::Closing::enter_name(const Tree& tree, const Body& body)
{
    const std::string& text = tree->kind == TreeKind::pi ? "pi" : tree->name;
    if (const ClosedTree* argument = find_argument(body, text)) return *argument;
    if (scope_.has_symbol(text)) return leaf(tree->kind == TreeKind::pi ? name(text, tree->where) : tree);
    const Definition* definition = scope_.find_definition(text);
    if (!definition && tree->kind == TreeKind::pi) return leaf(tree);
    if (!definition) unknown(*tree, body, false);
    if (!definition->parameters.empty())
        throw ModelError(
            fmt::format("the function {} stands without arguments", quote(text)), tree->where,
            fmt::format("its arguments stand in parentheses: {}({})", text, fmt::join(definition->parameters, ", ")));
    return expand(*definition, {}, tree->where);
}

/// Starts the expansion of a definition, or finds it done.
Expansion::Closing::Result Expansion::Closing::expand(const Definition& definition, std::vector<ClosedTree> arguments,
                                                      const SourceRange& use)
{
    Key key{definition.name, {}};
    for (const ClosedTree& argument : arguments) key.second.push_back(expansion_.identity_(argument.tree));
    const auto known = expansion_.expanded_.find(key);
    if (known != expansion_.expanded_.end()) return known->second;
    refuse_cycle(definition, use);
    auto body = std::make_shared<Body>();
    body->definition = &definition;
    body->arguments = std::move(arguments);
    push({nullptr, std::move(body), {}, true, std::move(key)}, use);
    active_.push_back(&definition);
    return std::nullopt;
}

Expansion::Closing::Result Expansion::Closing::advance()
{
    Frame& top = frames_.back();
    if (top.expands) {
        if (top.arguments.empty()) return enter(top.body->definition->body, top.body);
        ClosedTree result = std::move(top.arguments[0]);
        expansion_.expanded_.emplace(std::move(top.key), result);
        active_.pop_back();
        frames_.pop_back();
        return result;
    }
    const std::size_t wanted = top.tree->arguments.size();
    if (top.arguments.size() < wanted) return enter(top.tree->arguments[top.arguments.size()], top.body);
    if (top.tree->kind == TreeKind::apply && top.arguments.size() == wanted) // the expansion itself is one entry more
        return expand(function_of(*top.tree, *top.body), top.arguments, top.tree->where);
    return finish_operation();
}

Expansion::Closing::Result Expansion::Closing::finish_operation()
{
    Frame& top = frames_.back();
    const bool inside = top.body->definition != nullptr;
    if (inside && ++expansion_.operations_ > most_operations)
        throw ModelError(fmt::format("the definitions expand to more than {} operations", most_operations),
                         top.tree->where, "a function is expanded once for each distinct list of its arguments");
    ClosedTree result = top.tree->kind == TreeKind::apply ? std::move(top.arguments.back())
                                                          : operation(top.tree, std::move(top.arguments));
    // Only a shared node can be asked for again: one hold is the parent's, one this frame's.
    if (top.tree.use_count() > 2) top.body->done.emplace(top.tree.get(), result);
    frames_.pop_back();
    return result;
}

void Expansion::Closing::push(Frame frame, const SourceRange& where)
{
    if (frames_.size() >= tallest_stack)
        throw ModelError(fmt::format("the definitions used here are nested more than {} operations deep", deepest),
                         where, "shorten the chain of definitions");
    frames_.push_back(std::move(frame));
}

/// The definition that an application stands for, with the right number of arguments.
const Definition& Expansion::Closing::function_of(const TreeNode& node, const Body& body) const
{
    const Definition* definition = scope_.find_definition(node.name);
    const bool is_value = find_argument(body, node.name) || scope_.has_symbol(node.name) ||
                          (definition && definition->parameters.empty());
    if (is_value)
        throw ModelError(fmt::format("{} is not a function", quote(node.name)), node.where,
                         fmt::format("a product is written with '*': {}*(...)", node.name));
    if (!definition) unknown(node, body, true);
    const std::size_t wanted = definition->parameters.size();
    const std::size_t given = node.arguments.size();
    if (given != wanted)
        throw ModelError(fmt::format("{} takes {} argument{}, and {} {} given", node.name, wanted,
                                     wanted == 1 ? "" : "s", given, given == 1 ? "is" : "are"),
                         node.where,
                         fmt::format("it is defined as {}({})", node.name, fmt::join(definition->parameters, ", ")));
    return *definition;
}

void Expansion::Closing::refuse_cycle(const Definition& definition, const SourceRange& use) const
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

void Expansion::Closing::unknown(const TreeNode& node, const Body& body, bool as_function) const
{
    std::vector<std::string> known;
    if (body.definition && !as_function) known = body.definition->parameters;
    if (!as_function)
        for (const Scope::Symbol& symbol : scope_.symbols_) known.push_back(symbol.name);
    for (const Definition& definition : scope_.definitions_)
        if (definition.parameters.empty() != as_function) known.push_back(definition.name);
    throw ModelError(fmt::format("unknown {} {}", as_function ? "function" : "symbol", quote(node.name)), node.where,
                     as_function ? hint_for_function(node.name, known) : hint_for_symbol(node.name, known));
}

ClosedTree Expansion::close(const Scope& scope, const Tree& tree)
{
    return Closing(*this, scope).close(tree);
}

void Expansion::check(const Scope& scope, const Definition& definition)
{
    std::vector<ClosedTree> arguments;
    for (const std::string& parameter : definition.parameters)
        arguments.push_back(leaf(name(parameter, definition.where)));
    (void)Closing(*this, scope).expand_all(definition, std::move(arguments));
}

} // namespace lagen
