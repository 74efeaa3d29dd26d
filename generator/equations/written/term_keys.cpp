// SPDX-License-Identifier: GPL-2.0-or-later
#include "equations/written/term_keys.hpp"

#include "equations/written/index_shape.hpp"
#include "expression/rewrite.hpp"
#include "symbolic/shortest_form.hpp"

#include <algorithm>

namespace lagen {
namespace {

constexpr std::size_t most_keys = 400;
constexpr std::size_t most_characters = 20'000'000; ///< of all terms that are expanded, so that the time is bounded
constexpr const char* no_value = "?";               ///< the key of what has none

/// Products of vectors as names: what they mean is no matter of their terms.
Tree with_opaque_products(const Tree& tree)
{
    return rewrite(tree,
                   [](const Tree& part) { return part->kind == TreeKind::apply ? name(to_text(part)) : nullptr; });
}

} // namespace

std::optional<Keys> TermKeys::of(const Tree& tree)
{
    Keys keys;
    if (!append(without_sums(tree), false, keys)) return std::nullopt;
    return keys;
}

bool TermKeys::append(const Tree& tree, bool negative, Keys& keys)
{
    if (tree->kind == TreeKind::negate) return append(tree->arguments[0], !negative, keys);
    if (tree->kind == TreeKind::add) {
        for (const Tree& term : tree->arguments)
            if (!append(term, negative, keys)) return false;
        return true;
    }
    const std::vector<std::string>& texts = keys_of(negative ? negate(tree) : tree);
    if (keys.size() + texts.size() > most_keys || std::ranges::find(texts, no_value) != texts.end()) return false;
    keys.insert(texts.begin(), texts.end());
    return true;
}

const std::vector<std::string>& TermKeys::keys_of(const Tree& term)
{
    const auto [entry, is_new] = known_.emplace(to_text(term), std::vector<std::string>());
    std::vector<std::string>& texts = entry->second;
    if (!is_new) return texts;
    expanded_ += entry->first.size();
    if (expanded_ > most_characters) {
        texts = {no_value};
        return texts;
    }
    const auto append_key = [&](const GiNaC::ex& part) { texts.push_back(to_text(from_ginac(part, symbols_, {}))); };
    try {
        GiNaC::ex whole = to_ginac(with_opaque_products(term), symbols_);
        if (const auto length = expanded_length(whole); length && *length <= most_keys) whole = whole.expand();
        if (GiNaC::is_a<GiNaC::add>(whole))
            for (const GiNaC::ex& part : whole) append_key(part);
        else if (!whole.is_zero())
            append_key(whole);
    } catch (const MathematicsError&) {
        texts = {no_value};
    }
    return texts;
}

} // namespace lagen
