// SPDX-License-Identifier: GPL-2.0-or-later
/// Closing trees: names to symbols, definitions to their closed bodies, within bounds.
#include "expression/closing.hpp"

#include "expression/name_hints.hpp"
#include "text/alphabet.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

namespace {

/// An operation, the application below it and the definition behind that take an entry of the stack each.
constexpr std::size_t tallest_stack = 3 * deepest_closed;

const Value* find_bound(const OpenBody& body, const std::string& name)
{
    const auto found = std::find_if(body.bound.rbegin(), body.bound.rend(),
                                    [&](const BoundName& entry) { return *entry.name == name; });
    return found == body.bound.rend() ? nullptr : &found->value;
}

Value leaf(const Tree& tree)
{
    return scalar({tree, measure(*tree, {}, closing_limits())});
}

} // namespace

Value Expansion::Closing::run(Result result)
{
    while (!frames_.empty()) {
        if (result) frames_.back().arguments.push_back(std::move(result));
        result = advance();
    }
    return result;
}

Expansion::Closing::Result Expansion::Closing::enter(const Tree& tree, const std::shared_ptr<OpenBody>& body)
{
    if (tree->kind == TreeKind::name || tree->kind == TreeKind::pi) return enter_name(tree, body);
    if (tree->arguments.empty() && tree->kind != TreeKind::apply && tree->kind != TreeKind::array) return leaf(tree);
    if (is_range(*tree) && tree->arguments.empty()) return close_range(tree, {});
    const auto known = body->done.find(tree.get());
    if (known != body->done.end()) return known->second;
    const DerivativeEntry* derivative = derivative_of(*tree);
    if (derivative != nullptr) require_arity(*tree, *derivative);
    if (applies_function(*tree)) (void)function_of(*tree, *body); // its mistakes come before its arguments'
    const bool repeats = tree->kind == TreeKind::sum_over || tree->kind == TreeKind::product_over;
    push({.tree = tree, .body = body, .step = repeats ? Step::repetition : Step::operation}, tree->where);
    return nullptr;
}

Expansion::Closing::Result Expansion::Closing::enter_name(const Tree& tree, const std::shared_ptr<OpenBody>& body)
{
    if (tree->kind == TreeKind::pi && tree->name.empty()) return leaf(tree); // the number, found to be it before
    const std::string& text = tree->name;
    if (const Value* bound = find_bound(*body, text)) return *bound;
    if (scope_.has_symbol(text)) return leaf(tree->kind == TreeKind::pi ? name(text, tree->where) : tree);
    if (const std::optional<long> size = scope_.find_size(text)) return leaf(number(*size, tree->where));
    if (const Shape* shape = scope_.find_family(text)) return family(text, *shape, *body);
    const Definition* definition = scope_.find_definition(text);
    if (!definition && tree->kind == TreeKind::pi) return leaf(constant_pi(tree->where));
    if (!definition) {
        const Tree meant = as_printed(*tree, *body);
        if (!meant) unknown(*tree, *body, false);
        return enter(meant, body);
    }
    if (!definition->parameters.empty())
        throw ModelError(
            fmt::format("the function {} stands without arguments", quote(text)), tree->where,
            fmt::format("its arguments stand in parentheses: {}({})", text, fmt::join(definition->parameters, ", ")));
    return expand(*definition, {}, tree->where);
}

/// The name behind one that equations print: ẋ is Dt(x), x₁ is x1, or x[1] where there is no x1. Null where it is none
/// of these.
Tree Expansion::Closing::as_printed(const TreeNode& node, const OpenBody& body) const
{
    const auto known = [&](const std::string& text) {
        return find_bound(body, text) != nullptr || scope_.has_name(text) || scope_.has_definition(text);
    };
    const std::string plain = with_plain_digits(node.name);
    if (plain != node.name && known(plain)) return name(plain, node.where);
    if (const std::string entry = scope_.entry_meant(plain); plain != node.name && !entry.empty())
        return name(entry, node.where);
    const std::optional<std::string> position = without_dot(plain);
    if (!position || !(known(*position) || !scope_.entry_meant(*position).empty())) return nullptr;
    const std::string entry = known(*position) ? *position : scope_.entry_meant(*position);
    auto rate = std::make_shared<TreeNode>(*application("Dt", {name(entry, node.where)}));
    rate->where = node.where;
    return rate;
}

/// One value a body, so that an entry that is used again is the same tree.
Value Expansion::Closing::family(const std::string& name, const Shape& shape, const OpenBody& body) const
{
    Value& value = (*body.families)[name];
    if (!value) {
        value = std::make_shared<Closed>();
        value->shape = shape;
        value->family = name;
    }
    return value;
}

/// Starts the expansion of a definition, or finds it done.
Expansion::Closing::Result Expansion::Closing::expand(const Definition& definition, std::vector<Value> arguments,
                                                      const SourceRange& use)
{
    Key key{definition.name, {}};
    for (const Value& argument : arguments) key.second.push_back(expansion_.number_of(*argument));
    const auto known = expansion_.expanded_.find(key);
    if (known != expansion_.expanded_.end()) return known->second;
    refuse_cycle(definition, use);
    auto body = std::make_shared<OpenBody>();
    body->definition = &definition;
    for (std::size_t k = 0; k < arguments.size(); ++k)
        body->bound.push_back({&definition.parameters[k], std::move(arguments[k])});
    push({.body = std::move(body), .step = Step::definition, .key = std::move(key)}, use);
    active_.push_back(&definition);
    return nullptr;
}

Expansion::Closing::Result Expansion::Closing::advance()
{
    Frame& top = frames_.back();
    if (top.step == Step::definition)
        return top.arguments.empty() ? enter(top.body->definition->body, top.body) : finish_definition();
    if (top.step == Step::repetition) return advance_repetition();
    const std::size_t wanted = top.tree->arguments.size();
    if (top.arguments.size() < wanted) return enter(top.tree->arguments[top.arguments.size()], top.body);
    if (applies_function(*top.tree) && top.arguments.size() == wanted) // the expansion itself is one entry more
        return expand(function_of(*top.tree, *top.body), top.arguments, top.tree->where);
    return finish_operation();
}

Expansion::Closing::Result Expansion::Closing::finish_definition()
{
    Frame& top = frames_.back();
    Value result = std::move(top.arguments[0]);
    expansion_.expanded_.emplace(std::move(top.key), result);
    active_.pop_back();
    frames_.pop_back();
    return result;
}

Expansion::Closing::Result Expansion::Closing::finish_operation()
{
    Frame& top = frames_.back();
    const Maker make = maker(*top.body, top.tree->where);
    if (top.body->definition || !top.body->bound.empty()) make.count();
    Value result = derivative_of(*top.tree) != nullptr ? differentiate(make, top.tree, top.arguments)
                   : applies_function(*top.tree)       ? std::move(top.arguments.back())
                                                       : combine(make, top.tree, std::move(top.arguments));
    // Only a shared node can be asked for again: one hold is the parent's, one this frame's.
    if (top.tree.use_count() > 2) top.body->done.emplace(top.tree.get(), result);
    frames_.pop_back();
    return result;
}

void Expansion::Closing::push(Frame frame, const SourceRange& where)
{
    if (frames_.size() >= tallest_stack)
        throw ModelError(
            fmt::format("the definitions used here are nested more than {} operations deep", deepest_closed), where,
            "shorten the chain of definitions");
    frames_.push_back(std::move(frame));
}

/// The definition that an application stands for, with the right number of arguments.
const Definition& Expansion::Closing::function_of(const TreeNode& node, const OpenBody& body) const
{
    const Definition* definition = scope_.find_definition(node.name);
    const bool is_value =
        find_bound(body, node.name) || scope_.has_name(node.name) || (definition && definition->parameters.empty());
    if (is_value)
        throw ModelError(fmt::format("{} is not a function", quote(node.name)), node.where,
                         definition
                             ? fmt::format("a function is defined with its arguments: \"{}(q)\" = \"..\"", node.name)
                             : fmt::format("a product is written with '*': {}*(..)", node.name));
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

/// A name that is declared elsewhere, or nearly, has a hint of its own.
void Expansion::Closing::refuse_explained(const TreeNode& node) const
{
    const auto explained = scope_.explanations_.find(node.name);
    const std::string entry = scope_.entry_meant(node.name);
    std::string hint;
    if (explained != scope_.explanations_.end()) hint = explained->second;
    if (hint.empty() && !entry.empty()) hint = fmt::format("did you mean '{}'?", entry);
    if (!hint.empty()) throw UnknownSymbol(node.name, node.where, hint, true);
}

void Expansion::Closing::unknown(const TreeNode& node, const OpenBody& body, bool as_function) const
{
    if (!as_function && is_function_name(node.name))
        throw ModelError(fmt::format("the function {} stands without arguments", quote(node.name)), node.where,
                         fmt::format("arguments stand in parentheses: {}(..)", node.name));
    std::vector<std::string> known;
    if (!as_function) {
        refuse_explained(node);
        for (const BoundName& entry : body.bound) known.push_back(*entry.name);
        for (const std::string& name : scope_.value_names()) known.push_back(name);
        throw UnknownSymbol(node.name, node.where, hint_for_symbol(node.name, known));
    }
    for (const Definition& definition : scope_.definitions_)
        if (!definition.parameters.empty()) known.push_back(definition.name);
    throw ModelError(fmt::format("unknown function {}", quote(node.name)), node.where,
                     hint_for_function(node.name, known));
}

std::size_t Expansion::number_of(Closed& value)
{
    if (value.number) return *value.number;
    std::vector<std::size_t> content;
    if (value.inverse_of) {
        content = {0, number_of(*value.inverse_of)};
    } else if (!value.family.empty()) {
        content = {1, identity_(name(value.family))};
    } else {
        content = {2, static_cast<std::size_t>(value.shape.rank), value.shape.columns, value.open, value.neutral};
        for (const ClosedTree& entry : value.entries) content.push_back(identity_(entry.tree));
    }
    value.number = numbers_.emplace(std::move(content), numbers_.size()).first->second;
    return *value.number;
}

Value Expansion::close(const Scope& scope, const Tree& tree)
{
    return Closing(*this, scope).close(tree);
}

void Expansion::check(const Scope& scope, const Definition& definition)
{
    std::vector<Value> arguments;
    for (const std::string& parameter : definition.parameters) {
        arguments.push_back(leaf(name(parameter, definition.where)));
        arguments.back()->open = true;
    }
    (void)Closing(*this, scope).expand_all(definition, std::move(arguments));
}

std::vector<ClosedTree> Expansion::entries(const Value& value, const SourceRange& where)
{
    Budget budget{0, "the expression is longer than {} operations when its sums and arrays are written out", ""};
    return Maker(budget, signed_identity_, where).entries(*value);
}

// sum(i, from, to, body) and product(..), written out. A sum up to n continues the sum up to n - 1 where that is there
// already, so that nested sums along a chain of n links have of the order of n operations, not n^2.

namespace {

constexpr long longest_range = 100'000;
/// Sums inside one another before one starts anew: trees are bounded in height.
constexpr std::size_t longest_chain = 500;
/// Terms that sums inside sums stand for. Equal ones are one node, so that trees do not show how many there are; but
/// what is made of them, numbers first, grows with each level.
constexpr std::size_t most_terms = 1'000'000'000;

bool is_sum(const TreeNode& node)
{
    return node.kind == TreeKind::sum_over;
}

const char* word_for(const TreeNode& node)
{
    return is_sum(node) ? "sum" : "product";
}

long bound_of(const TreeNode& node, std::size_t which, const Closed& value)
{
    const Tree& written = node.arguments[which];
    const std::optional<long> bound = integer_of(value);
    if (!bound)
        refuse(written,
               fmt::format("the {} bound {} of a {} is not an integer constant", which == 0 ? "lower" : "upper",
                           quote(to_text(written)), word_for(node)),
               "a bound is made of integers, sizes, and the indices of outer sums and products");
    return *bound;
}

std::size_t terms_of(const Closed& value)
{
    std::size_t most = 1;
    for (const ClosedTree& entry : value.entries) most = std::max(most, entry.measure.terms);
    return most;
}

/// The value, which stands for so many terms. A single term is not a new value: it keeps its count.
Value with_terms(Value value, std::size_t terms)
{
    if (terms <= terms_of(*value)) return value;
    value = std::make_shared<Closed>(*value);
    for (ClosedTree& entry : value->entries) entry.measure.terms = terms;
    return value;
}

} // namespace

Expansion::Closing::Result Expansion::Closing::advance_repetition()
{
    Frame& top = frames_.back();
    const TreeNode& node = *top.tree;
    if (!top.repetition && top.arguments.size() < 2) return enter(node.arguments[top.arguments.size()], top.body);
    if (!top.repetition) {
        if (top.arguments[0]->open || top.arguments[1]->open) return open_repetition(top);
        start_repetition(top);
    } else if (top.arguments.size() > 2) {
        top.repetition->terms.emplace(top.next, std::move(top.arguments.back()));
        top.arguments.pop_back();
        ++top.next;
    }
    return next_term(top);
}

/// The bounds, and what is there of this sum already.
void Expansion::Closing::start_repetition(Frame& top)
{
    const TreeNode& node = *top.tree;
    top.from = bound_of(node, 0, *top.arguments[0]);
    top.to = bound_of(node, 1, *top.arguments[1]);
    if (top.to >= top.from && (top.to - longest_range >= top.from || top.from + longest_range <= top.to))
        refuse(top.tree,
               fmt::format("a {} runs from {} to {}, where at most {} indices are allowed", word_for(node), top.from,
                           top.to, longest_range),
               "a sum of this length is beyond what is written out");
    RepetitionKey key{&node, {}};
    const std::set<std::string>& names = names_of(node);
    for (const BoundName& bound : top.body->bound)
        if (*bound.name != node.name && names.contains(*bound.name))
            key.second.push_back(expansion_.number_of(*bound.value));
    top.repetition = &expansion_.repetitions_[std::move(key)];
    top.repetition->alive = top.tree;
    top.before = top.from - 1;
    const auto& results = top.repetition->results[top.from];
    const auto after = results.upper_bound(top.to);
    if (after != results.begin()) top.before = std::prev(after)->first;
    top.next = top.before + 1;
}

/// The names in the body of a sum that may be bound. pi is a name where a function has it for a
/// parameter.
const std::set<std::string>& Expansion::Closing::names_of(const TreeNode& repetition)
{
    const auto [place, fresh] = names_.try_emplace(&repetition);
    if (fresh) {
        for (std::string& name : names_in(repetition.arguments[2])) place->second.insert(std::move(name));
        place->second.insert("pi");
    }
    return place->second;
}

/// Closes the body at the next index that is not there, or finishes.
Expansion::Closing::Result Expansion::Closing::next_term(Frame& top)
{
    auto& terms = top.repetition->terms;
    const bool varies = names_of(*top.tree).contains(top.tree->name);
    for (; top.next <= top.to; ++top.next) {
        if (terms.contains(top.next)) continue;
        if (varies || terms.empty()) break;
        terms.emplace(top.next, terms.begin()->second);
    }
    if (top.next > top.to) return finish_repetition();
    auto body = std::make_shared<OpenBody>();
    body->definition = top.body->definition;
    body->bound = top.body->bound;
    body->families = top.body->families;
    const Tree index = number(top.next, top.tree->where);
    body->bound.push_back({&top.tree->name, scalar({index, measure(*index, {}, closing_limits())})});
    return enter(top.tree->arguments[2], body);
}

Expansion::Closing::Result Expansion::Closing::finish_repetition()
{
    Frame& top = frames_.back();
    const Maker make = maker(*top.body, top.tree->where);
    auto& results = top.repetition->results[top.from];
    Value result;
    if (top.to < top.from) {
        result = scalar(make.number(is_sum(*top.tree) ? 0 : 1));
        result->neutral = is_sum(*top.tree);
    } else if (const auto known = results.find(top.to); known != results.end()) {
        result = known->second.value;
    } else {
        const auto before = results.find(top.before);
        std::size_t chain = before == results.end() ? 1 : before->second.chain + 1;
        if (chain > longest_chain) {
            top.before = top.from - 1;
            chain = 1;
        }
        const std::size_t terms = count_terms(top);
        result = with_terms(join_terms(top, make), terms);
        results.emplace(top.to, Partial{result, chain, terms});
    }
    frames_.pop_back();
    return result;
}

/// The number of terms of this repetition with those inside it, bounded.
std::size_t Expansion::Closing::count_terms(const Frame& top) const
{
    const auto& results = top.repetition->results.at(top.from);
    const auto before = results.find(top.before);
    std::size_t count = before == results.end() ? 0 : before->second.terms;
    for (long k = top.before + 1; k <= top.to; ++k) {
        count += terms_of(*top.repetition->terms.at(k));
        if (count > most_terms)
            refuse(top.tree,
                   fmt::format("this {} stands for more than {} terms when those inside it are written out",
                               word_for(*top.tree), most_terms),
                   "a sum or product inside another is written out for each index of the outer one");
    }
    return count;
}

/// The terms after the partial sum `before`, added to it from left to right.
Value Expansion::Closing::join_terms(const Frame& top, const Maker& make) const
{
    const auto& results = top.repetition->results.at(top.from);
    std::vector<Value> terms;
    if (const auto before = results.find(top.before); before != results.end()) terms.push_back(before->second.value);
    for (long k = top.before + 1; k <= top.to; ++k) terms.push_back(top.repetition->terms.at(k));
    if (terms.size() == 1) return terms[0];
    const bool sum = is_sum(*top.tree);
    const bool open = std::any_of(terms.begin(), terms.end(), [](const Value& term) { return term->open; });
    const bool scalars =
        std::all_of(terms.begin(), terms.end(), [](const Value& term) { return term->shape.rank == Rank::scalar; });
    if (open) return *std::find_if(terms.begin(), terms.end(), [](const Value& term) { return term->open; });
    if (!scalars && !sum) return multiply_values(make, terms);
    if (!scalars) return add_values(make, terms, std::vector<Tree>(terms.size(), top.tree->arguments[2]));
    std::vector<ClosedTree> parts;
    parts.reserve(terms.size());
    for (const Value& term : terms) parts.push_back(make.entry(*term, 0));
    Value result = scalar(make.join(sum ? TreeKind::add : TreeKind::multiply, std::move(parts)));
    const auto neutral = [](const Value& term) { return term->neutral; };
    result->neutral =
        sum ? std::all_of(terms.begin(), terms.end(), neutral) : std::any_of(terms.begin(), terms.end(), neutral);
    return result;
}

/// In the check of a function on its own, bounds may be unknown: the body is closed once, for an unknown index.
Expansion::Closing::Result Expansion::Closing::open_repetition(Frame& top)
{
    if (top.arguments.size() > 2) {
        Value result = std::move(top.arguments[2]);
        if (!result->open) {
            result = std::make_shared<Closed>(*result);
            result->open = true;
            result->number.reset();
        }
        frames_.pop_back();
        return result;
    }
    auto body = std::make_shared<OpenBody>(OpenBody{top.body->definition, top.body->bound, top.body->families, {}});
    const Tree index = name(top.tree->name, top.tree->where);
    Value value = scalar({index, measure(*index, {}, closing_limits())});
    value->open = true;
    body->bound.push_back({&top.tree->name, std::move(value)});
    return enter(top.tree->arguments[2], body);
}

} // namespace lagen
