// SPDX-License-Identifier: GPL-2.0-or-later
#include "equations/written/index_shape.hpp"

#include "expression/find_part.hpp"
#include "expression/fold.hpp"
#include "expression/rewrite.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <functional>
#include <set>
#include <utility>

namespace lagen {
namespace {

constexpr std::size_t most_shape_nodes = 4000; ///< of an expression that is looked at

bool is_sum(const Tree& tree)
{
    return tree->kind == TreeKind::sum_over;
}

/// Gives back what is put for the index.
using IndexMap = std::function<std::string(const IndexSlot&)>;

std::string mapped_name(const std::string& name, const IndexMap& map)
{
    std::string result, index;
    std::size_t place = 1;
    bool inside = false;
    for (const char c : name) {
        const bool ends = inside && (c == ',' || c == ']');
        if (ends) result += map({std::exchange(index, {}), place++});
        (inside && !ends ? index : result) += c;
        inside = c == '[' || (inside && c != ']');
    }
    return result;
}

Tree mapped(const Tree& tree, const IndexMap& map)
{
    if (tree->kind == TreeKind::name) {
        const std::string text = mapped_name(tree->name, map);
        return text == tree->name ? tree : name(text);
    }
    if (tree->arguments.empty()) return tree;
    TreeNode node = *tree;
    for (std::size_t k = 0; k < node.arguments.size(); ++k) {
        const bool bound = node.kind == TreeKind::sum_over && k != 2;
        node.arguments[k] = bound ? name(map({tree->arguments[k]->name, 0})) : mapped(tree->arguments[k], map);
    }
    return std::make_shared<const TreeNode>(std::move(node));
}

void append_form(const Tree& tree, std::string& form, std::size_t& nodes)
{
    if (++nodes > most_shape_nodes) return;
    form += fmt::format("{}/{}", static_cast<int>(tree->kind), tree->arguments.size());
    switch (tree->kind) {
    case TreeKind::number: form += tree->number.get_str(); break;
    case TreeKind::name: form += mapped_name(tree->name, [](const IndexSlot&) { return std::string(); }); break;
    case TreeKind::call: form += entry_of(tree->function).name; break;
    case TreeKind::compare: form += std::to_string(static_cast<int>(tree->comparison)); break;
    case TreeKind::solve: form += tree->number.get_str(); break;
    case TreeKind::apply:
    case TreeKind::sum_over: form += tree->name; break;
    default: break;
    }
    form += ';';
    for (std::size_t k = 0; k < tree->arguments.size(); ++k)
        if (tree->kind != TreeKind::sum_over || k == 2) append_form(tree->arguments[k], form, nodes);
}

} // namespace

std::optional<long> index_number(const std::string& text)
{
    const std::size_t sign = text.starts_with('-') ? 1 : 0;
    if (text.size() == sign || text.size() > 9 ||
        !std::all_of(text.begin() + static_cast<long>(sign), text.end(), [](char c) { return c >= '0' && c <= '9'; }))
        return std::nullopt;
    return std::stol(text);
}

std::string with_offset(const std::string& text, long offset)
{
    if (const auto number = index_number(text)) return std::to_string(*number + offset);
    const std::size_t sign = text.find_first_of("+-");
    if (sign != std::string::npos) offset += std::stol(text.substr(sign));
    return offset == 0 ? text.substr(0, sign) : fmt::format("{}{:+}", text.substr(0, sign), offset);
}

std::string index_at(const std::string& text, const std::string& letter, const std::string& value)
{
    if (text.starts_with("max(")) {
        const std::size_t comma = text.find(',');
        const std::string a = index_at(text.substr(4, comma - 4), letter, value);
        const std::string b = index_at(text.substr(comma + 1, text.size() - comma - 2), letter, value);
        const std::optional<long> first = index_number(a), second = index_number(b);
        return first && second ? std::to_string(std::max(*first, *second)) : "max(" + a + "," + b + ")";
    }
    const std::size_t sign = text.find_first_of("+-");
    if (text.substr(0, sign) != letter) return text;
    return with_offset(value, sign == std::string::npos ? 0 : std::stol(text.substr(sign)));
}

IndexShape shape_of(const Tree& tree)
{
    IndexShape shape;
    std::size_t nodes = 0;
    append_form(tree, shape.form, nodes);
    if (nodes > most_shape_nodes) return {};
    mapped(tree, [&](const IndexSlot& slot) {
        shape.slots.push_back(slot);
        return slot.text;
    });
    return shape;
}

Tree with_indices(const Tree& tree, const std::vector<std::string>& texts)
{
    std::size_t next = 0;
    return mapped(tree, [&](const IndexSlot&) { return texts[next++]; });
}

Tree at_index(const Tree& tree, const std::string& letter, const std::string& value)
{
    return mapped(tree, [&](const IndexSlot& slot) { return index_at(slot.text, letter, value); });
}

Tree at_index(const Tree& tree, const std::string& letter, long value)
{
    return at_index(tree, letter, std::to_string(value));
}

Tree tree_of(const IndexedSum& sum)
{
    TreeNode node;
    node.kind = TreeKind::sum_over;
    node.name = sum.letter;
    node.arguments = {name(sum.from), name(sum.to), sum.body};
    if (sum.excluded) node.arguments.push_back(name(*sum.excluded));
    return std::make_shared<const TreeNode>(std::move(node));
}

IndexedSum indexed_sum(const Tree& tree)
{
    IndexedSum sum{tree->name, tree->arguments[0]->name, tree->arguments[1]->name, std::nullopt, tree->arguments[2]};
    if (tree->arguments.size() > 3) sum.excluded = tree->arguments[3]->name;
    return sum;
}

std::optional<std::vector<Tree>> terms_of(const IndexedSum& sum)
{
    const auto letter_of = [](const std::string& text) {
        return index_number(text) ? std::string() : text.substr(0, text.find_first_of("+-"));
    };
    const auto offset_of = [](const std::string& text) {
        const std::size_t sign = text.find_first_of("+-", 1);
        return index_number(text) ? *index_number(text) : sign == std::string::npos ? 0 : std::stol(text.substr(sign));
    };
    const std::string letter = letter_of(sum.from);
    if (letter.starts_with("max(") || letter_of(sum.to) != letter ||
        (sum.excluded && letter_of(*sum.excluded) != letter))
        return std::nullopt;
    std::vector<Tree> terms;
    for (long value = offset_of(sum.from); value <= offset_of(sum.to); ++value)
        if (!sum.excluded || value != offset_of(*sum.excluded))
            terms.push_back(
                at_index(sum.body, sum.letter, letter.empty() ? std::to_string(value) : with_offset(letter, value)));
    return terms;
}

Tree without_sums(const Tree& tree)
{
    return rewrite(tree, [](const Tree& part) -> Tree {
        if (!is_sum(part)) return nullptr;
        const auto terms = terms_of(indexed_sum(part));
        if (!terms) return part;
        if (terms->empty()) return number(0);
        return without_sums(terms->size() == 1 ? (*terms)[0] : add(*terms));
    });
}

bool has_sums(const Tree& tree)
{
    return any_part(tree, is_sum);
}

std::size_t sums_inside(const Tree& tree)
{
    return Fold<std::size_t>()(tree, [](const Tree& part, const std::vector<std::size_t>& heights) {
        const std::size_t below = heights.empty() ? 0 : *std::ranges::max_element(heights);
        return below + (is_sum(part) ? 1 : 0);
    });
}

namespace {

constexpr std::size_t most_guesses = 64;

std::vector<std::string> texts_of(const IndexShape& shape)
{
    std::vector<std::string> texts;
    for (const IndexSlot& slot : shape.slots) texts.push_back(slot.text);
    return texts;
}

/// A bound may be these where indices with this value become the letter.
std::vector<std::string> bound_guesses(const std::string& bound, const std::string& letter, long value)
{
    const std::optional<long> number = index_number(bound);
    if (number) return {with_offset(letter, *number - value), bound};
    return {bound, "max(" + letter + "," + bound + ")"};
}

} // namespace

std::optional<IndexPattern> common_pattern(const Tree& a, const IndexShape& first, const IndexShape& second,
                                           const std::string& letter)
{
    if (first.form.empty() || first.form != second.form) return std::nullopt;
    std::optional<long> base, step;
    for (const bool in_names : {true, false})
        for (std::size_t k = 0; k < first.slots.size(); ++k) {
            if (first.slots[k] == second.slots[k] || (first.slots[k].place != 0) != in_names) continue;
            const std::optional<long> here = index_number(first.slots[k].text),
                                      there = index_number(second.slots[k].text);
            if (!here || !there || (step && *there - *here != *step)) return std::nullopt;
            step = *there - *here;
            if (!base) base = in_names ? here : std::nullopt;
        }
    if (!base) return std::nullopt;
    std::vector<std::string> texts = texts_of(first);
    for (std::size_t k = 0; k < texts.size(); ++k)
        if (first.slots[k] != second.slots[k]) texts[k] = with_offset(letter, *index_number(texts[k]) - *base);
    return IndexPattern{with_indices(a, texts), letter, *base};
}

std::vector<Tree> lifted(const Tree& tree, const std::string& letter, long value, std::size_t place)
{
    const IndexShape shape = shape_of(tree);
    if (shape.form.empty()) return {tree}; // too large to be looked at
    std::vector<std::vector<std::string>> choices{texts_of(shape)};
    for (std::size_t k = 0; k < shape.slots.size(); ++k) {
        const IndexSlot& slot = shape.slots[k];
        if (slot.place != 0) {
            if ((place != 0 && slot.place != place) || index_number(slot.text) != value) continue;
            for (std::vector<std::string>& choice : choices) choice[k] = letter;
            continue;
        }
        const std::vector<std::string> guesses = bound_guesses(slot.text, letter, value);
        const std::size_t known = choices.size();
        if (known * guesses.size() > most_guesses) continue;
        for (std::size_t more = 1; more < guesses.size(); ++more)
            for (std::size_t c = 0; c < known; ++c) {
                choices.push_back(choices[c]);
                choices.back()[k] = guesses[more];
            }
        for (std::size_t c = 0; c < known; ++c) choices[c][k] = guesses[0];
    }
    std::vector<Tree> guesses;
    for (const std::vector<std::string>& choice : choices) guesses.push_back(with_indices(tree, choice));
    return guesses;
}

std::vector<IndexPattern> lifted_patterns(const Tree& tree, const std::string& letter)
{
    const IndexShape shape = shape_of(tree);
    std::set<std::pair<long, std::size_t>> choices;
    for (const IndexSlot& slot : shape.slots) {
        const std::optional<long> value = index_number(slot.text);
        if (slot.place == 0 || !value) continue;
        choices.insert({*value, 0});
        choices.insert({*value, slot.place});
    }
    std::vector<IndexPattern> patterns;
    for (const auto& [value, place] : choices)
        for (Tree& guess : lifted(tree, letter, value, place)) patterns.push_back({std::move(guess), letter, value});
    return patterns;
}

} // namespace lagen
