// SPDX-License-Identifier: GPL-2.0-or-later
#include "equations/written/indexed_sums.hpp"

#include <algorithm>
#include <cstdlib>

namespace lagen {
namespace {

constexpr std::size_t most_joined = 200;      ///< terms of a sum that is looked at
constexpr std::size_t most_in_vain = 150'000; ///< characters of terms that were expanded for guesses that failed
constexpr std::size_t of_each_equation = most_in_vain / 10;
constexpr std::size_t worth = 10;       ///< of such characters to each that is joined
constexpr long most_values = 1000;      ///< of an index, on either side of one that is known
constexpr std::size_t sign_length = 11; ///< characters of "sum_{i=1..3} "
constexpr std::size_t fewest_terms = 3; ///< of a sum that is written over an index

/// The product without products and signs of factors inside.
Tree product_of(const std::vector<Tree>& factors)
{
    bool negative = false;
    std::vector<Tree> flat;
    for (const Tree& factor : factors) {
        const bool minus = factor->kind == TreeKind::negate;
        const Tree& positive = minus ? factor->arguments[0] : factor;
        negative = negative != minus;
        if (positive->kind == TreeKind::multiply)
            flat.insert(flat.end(), positive->arguments.begin(), positive->arguments.end());
        else
            flat.push_back(positive);
    }
    return negative ? negate(multiply(flat)) : multiply(flat);
}

void append_terms(const Tree& tree, bool negative, std::vector<Tree>& terms)
{
    if (tree->kind == TreeKind::negate) return append_terms(tree->arguments[0], !negative, terms);
    if (tree->kind != TreeKind::add) return terms.push_back(negative ? negate(tree) : tree);
    for (const Tree& term : tree->arguments) append_terms(term, negative, terms);
}

bool contains(Keys whole, const Keys& part)
{
    return std::ranges::all_of(part, [&](const std::string& key) {
        const auto known = whole.find(key);
        if (known == whole.end()) return false;
        whole.erase(known);
        return true;
    });
}

void take_out(Keys& whole, const Keys& part)
{
    for (const std::string& key : part) whole.erase(whole.find(key));
}

/// True where an index is a letter of ranges or of sums around the term.
bool has_letters(const Tree& tree)
{
    const IndexShape shape = shape_of(tree);
    return std::ranges::any_of(
        shape.slots, [](const IndexSlot& slot) { return slot.text.find_first_of("#$") != std::string::npos; });
}

/// A sum with what has no letters in front of it, the sign too: - G sum_i m[i] r[i].
Tree with_factors_in_front(IndexedSum sum)
{
    if (sum.body->kind == TreeKind::negate) {
        sum.body = sum.body->arguments[0];
        return negate(with_factors_in_front(sum));
    }
    const bool fraction = sum.body->kind == TreeKind::divide;
    const Tree product = fraction ? sum.body->arguments[0] : sum.body;
    const Tree divisor = fraction ? sum.body->arguments[1] : nullptr;
    if (product->kind != TreeKind::multiply) return tree_of(sum);
    std::vector<Tree> outside, inside;
    for (const Tree& factor : product->arguments) (has_letters(factor) ? inside : outside).push_back(factor);
    if (outside.empty() || inside.empty()) return tree_of(sum);
    sum.body = inside.size() == 1 ? inside[0] : multiply(inside);
    if (fraction) sum.body = divide(sum.body, divisor);
    outside.push_back(tree_of(sum));
    return multiply(outside);
}

} // namespace

bool SumWriting::knows_names(const Tree& tree) const
{
    if (tree->kind == TreeKind::name) {
        const bool indexed = tree->name.ends_with(']');
        const bool open = tree->name.find('#') != std::string::npos || tree->name.find('$') != std::string::npos;
        return !indexed || open || names_.contains(tree->name);
    }
    const auto known = [&](const Tree& argument) { return knows_names(argument); };
    if (tree->kind == TreeKind::sum_over)
        if (const auto terms = terms_of(indexed_sum(tree)); terms && !std::ranges::all_of(*terms, known)) return false;
    return std::ranges::all_of(tree->arguments, known);
}

void SumWriting::begin_equation()
{
    in_vain_ = std::min(in_vain_, most_in_vain - of_each_equation);
}

Tree SumWriting::joined(const Tree& tree)
{
    if (tree->arguments.empty() || tree->kind == TreeKind::sum_over) return tree;
    TreeNode node = *tree;
    for (Tree& argument : node.arguments) argument = joined(argument);
    if (node.kind == TreeKind::add) {
        node.arguments = joined_terms(std::move(node.arguments));
        if (node.arguments.size() == 1) return node.arguments[0];
    }
    return std::make_shared<const TreeNode>(std::move(node));
}

std::vector<Tree> SumWriting::joined_terms(std::vector<Tree> terms)
{
    const auto has_indices = [](const Tree& term) { return !shape_of(term).slots.empty(); };
    if (in_vain_ > most_in_vain || terms.size() > most_joined || std::ranges::count_if(terms, has_indices) < 2)
        return terms;
    std::vector<Item> items;
    for (const Tree& term : terms) {
        const std::optional<Keys> keys = keys_.of(term);
        if (!keys) return terms;
        items.push_back({term, *keys});
    }
    Keys available;
    for (const Item& item : items) available.insert(item.keys.begin(), item.keys.end());
    bool any = false;
    for (bool found = true; found && items.size() > 1;) {
        found = false;
        for (const bool from_one : {false, true}) {
            std::vector<Candidate> candidates;
            for (const IndexPattern& pattern : patterns_of(items, from_one)) {
                if (in_vain_ > most_in_vain) return terms;
                const std::size_t before = keys_.expanded();
                if (auto candidate = extended(pattern, available))
                    candidates.push_back(std::move(*candidate));
                else
                    in_vain_ += keys_.expanded() - before;
            }
            std::ranges::stable_sort(candidates, std::ranges::greater(), &Candidate::members);
            for (const Candidate& candidate : candidates) {
                if (!replace(items, candidate)) continue;
                found = true;
                in_vain_ -= std::min(in_vain_, worth * candidate.members * to_text(candidate.sum).size());
            }
            if (found) break;
        }
        any = any || found;
    }
    if (!any) return terms;
    std::vector<Tree> result;
    for (const Item& item : items) result.push_back(item.tree);
    return result;
}

/// Patterns come from two items of one form, or from one item that has a sum; each stands once.
std::vector<IndexPattern> SumWriting::patterns_of(const std::vector<Item>& items, bool from_one)
{
    std::vector<IndexPattern> patterns;
    std::set<std::string> known;
    const auto take = [&](IndexPattern pattern) {
        if (known.insert(to_text(pattern.tree)).second) patterns.push_back(std::move(pattern));
    };
    const auto letter_of = [](const Tree& tree) { return "#" + std::to_string(sums_inside(tree) + 1); };
    if (from_one) {
        for (const Item& item : items)
            if (has_sums(item.tree))
                for (IndexPattern& pattern : lifted_patterns(item.tree, letter_of(item.tree))) take(std::move(pattern));
        return patterns;
    }
    std::map<std::string, std::vector<std::pair<const Item*, IndexShape>>> by_form;
    for (const Item& item : items)
        if (IndexShape shape = shape_of(item.tree); !shape.form.empty() && !shape.slots.empty()) {
            const std::string form = shape.form;
            by_form[form].emplace_back(&item, std::move(shape));
        }
    for (const auto& [form, same] : by_form)
        for (std::size_t a = 0; a < same.size(); ++a)
            for (std::size_t b = a + 1; b < same.size(); ++b)
                if (auto pattern = common_pattern(same[a].first->tree, same[a].second, same[b].second,
                                                  letter_of(same[a].first->tree))) {
                    take(std::move(*pattern));
                    break;
                }
    return patterns;
}

SumWriting::Instance SumWriting::try_at(const IndexPattern& pattern, long value, const Keys& available, Keys& taken)
{
    const Tree instance = at_index(pattern.tree, pattern.letter, value);
    if (!knows_names(instance)) return Instance::no_names;
    const std::optional<Keys> keys = keys_.of(instance);
    if (!keys) return Instance::no_value;
    if (keys->empty()) return Instance::zero;
    Keys all = taken;
    all.insert(keys->begin(), keys->end());
    if (!contains(available, all)) return Instance::other;
    taken = std::move(all);
    return Instance::term;
}

std::optional<SumWriting::Candidate> SumWriting::extended(const IndexPattern& pattern, const Keys& available)
{
    Candidate candidate;
    if (try_at(pattern, pattern.value, available, candidate.keys) != Instance::term) return std::nullopt;
    candidate.members = 1;
    long ends[] = {pattern.value, pattern.value};
    std::optional<long> gap;
    for (const long step : {1L, -1L}) {
        long& end = ends[step < 0 ? 0 : 1];
        for (;;) {
            const long value = end + step;
            const Instance here = try_at(pattern, value, available, candidate.keys);
            if (here == Instance::no_names || std::abs(value - pattern.value) > most_values) break;
            if (here == Instance::other || here == Instance::no_value) {
                if (gap || try_at(pattern, value + step, available, candidate.keys) != Instance::term) break;
                ++candidate.members;
                end = value + step;
                gap = value;
                continue;
            }
            if (here == Instance::term) ++candidate.members;
            end = value;
        }
    }
    if (candidate.members < 2) return std::nullopt;
    for (const long step : {-1L, 1L}) { // m/(x[1] - x[j]) at j = 1
        long& end = ends[step < 0 ? 0 : 1];
        if (!gap && try_at(pattern, end + step, available, candidate.keys) == Instance::no_value) gap = end += step;
    }
    IndexedSum sum{pattern.letter, std::to_string(ends[0]), std::to_string(ends[1]), std::nullopt, pattern.tree};
    if (gap) sum.excluded = std::to_string(*gap);
    candidate.sum = tree_of(sum);
    return candidate;
}

/// Takes the items out that the sum has as terms, if it has them whole.
bool SumWriting::replace(std::vector<Item>& items, const Candidate& candidate)
{
    Keys open = candidate.keys;
    std::vector<Item> left;
    std::size_t place = items.size();
    for (const Item& item : items) {
        if (contains(open, item.keys) && !item.keys.empty()) {
            take_out(open, item.keys);
            place = std::min(place, left.size());
        } else {
            left.push_back(item);
        }
    }
    if (!open.empty() || left.size() + 2 > items.size()) return false;
    left.insert(left.begin() + static_cast<long>(place), {candidate.sum, candidate.keys});
    items = std::move(left);
    return true;
}

Tree SumWriting::finished(const Tree& tree)
{
    if (tree->arguments.empty()) return tree;
    if (tree->kind != TreeKind::sum_over) {
        TreeNode node = *tree;
        node.arguments.clear();
        for (const Tree& argument : tree->arguments) {
            const Tree part = finished(argument);
            if (node.kind == TreeKind::add)
                append_terms(part, false, node.arguments);
            else
                node.arguments.push_back(part);
        }
        if (node.kind == TreeKind::negate && node.arguments[0]->kind == TreeKind::negate)
            return node.arguments[0]->arguments[0];
        if (node.kind == TreeKind::multiply) return product_of(node.arguments);
        return std::make_shared<const TreeNode>(std::move(node));
    }
    IndexedSum sum = indexed_sum(tree);
    std::optional<std::vector<Tree>> terms = terms_of(sum);
    if (terms && !terms->empty()) {
        const auto counts = [&](const std::string& value) {
            const Tree term = at_index(sum.body, sum.letter, value);
            if (has_letters(without_sums(term))) return true;
            const auto keys = keys_.of(term);
            return sum.excluded != value && keys && !keys->empty();
        };
        while (sum.from != sum.to && !counts(sum.from)) sum.from = with_offset(sum.from, 1);
        while (sum.from != sum.to && !counts(sum.to)) sum.to = with_offset(sum.to, -1);
        terms = terms_of(sum);
        const Tree whole = terms->size() == 1 ? (*terms)[0] : add(*terms);
        const std::size_t length = sign_length + to_text(sum.body).size();
        if (terms->size() < fewest_terms || 3 * length > 2 * to_text(whole).size()) return finished(whole);
    }
    if (sum.excluded == sum.from) sum.from = with_offset(sum.from, 1);
    if (sum.excluded == sum.to) sum.to = with_offset(sum.to, -1);
    if (sum.excluded && (with_offset(*sum.excluded, 1) == sum.from || with_offset(*sum.excluded, -1) == sum.to))
        sum.excluded.reset();
    sum.body = finished(sum.body);
    return with_factors_in_front(sum);
}

} // namespace lagen
