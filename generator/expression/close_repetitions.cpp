// SPDX-License-Identifier: GPL-2.0-or-later
/// sum(i, from, to, body) and product(..), written out. A sum up to n continues the sum up to n - 1 where that is there
/// already, so that nested sums along a chain of n links have of the order of n operations, not n^2.
#include "expression/closing.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

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

/// Of this repetition with those inside it, bounded.
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
