// SPDX-License-Identifier: GPL-2.0-or-later
#include "equations/written/index_pattern.hpp"

#include <set>

namespace lagen {
namespace {

constexpr std::size_t most_guesses = 64;

std::vector<std::string> texts_of(const IndexShape& shape)
{
    std::vector<std::string> texts;
    for (const IndexSlot& slot : shape.slots) texts.push_back(slot.text);
    return texts;
}

/// What a bound may be where indices with this value become the letter.
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
