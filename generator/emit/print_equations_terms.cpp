// SPDX-License-Identifier: GPL-2.0-or-later
/// Terms of a right side, and their lines.
#include "emit/print_equations_terms.hpp"

#include <algorithm>

namespace lagen {

SignedTree without_sign(const Tree& tree)
{
    if (tree->kind == TreeKind::negate) return {true, tree->arguments[0]};
    if (tree->kind == TreeKind::number && tree->number < 0) return {true, number(-tree->number)};
    return {false, tree};
}

bool is_one(const Tree& tree)
{
    return tree->kind == TreeKind::number && tree->number == 1;
}

bool raised_by_name(const Tree& tree)
{
    if (tree->kind != TreeKind::power || tree->arguments[0]->kind != TreeKind::call) return false;
    const Tree& exponent = tree->arguments[1];
    if (exponent->kind != TreeKind::number || exponent->number.get_den() != 1 || exponent->number < 2) return false;
    return entry_of(tree->arguments[0]->function).raised_by_name;
}

std::vector<SignedTree> right_side_terms(const Equation& equation)
{
    std::vector<SignedTree> terms;
    for (const TermGroup& group : equation.groups) {
        if (!group.basis.empty()) {
            terms.push_back(without_sign(group.value));
            terms.back().basis = group.basis;
            continue;
        }
        if (group.value->kind != TreeKind::add) {
            terms.push_back(without_sign(group.value));
            continue;
        }
        for (const Tree& term : group.value->arguments) terms.push_back(without_sign(term));
    }
    const auto positive =
        std::find_if(terms.begin(), terms.end(), [](const SignedTree& term) { return !term.negative; });
    if (positive != terms.end()) std::rotate(terms.begin(), positive, positive + 1);
    return terms;
}

std::vector<std::string> wrap_terms(const std::vector<std::pair<bool, std::string>>& terms, std::size_t first,
                                    std::size_t later, std::size_t width, std::size_t (*measure)(std::string_view))
{
    std::vector<std::string> lines(1);
    std::size_t used = first;
    for (const auto& [negative, text] : terms) {
        const bool leading = lines.size() == 1 && lines.back().empty();
        const std::string piece = leading ? (negative ? "-" + text : text) : (negative ? "- " : "+ ") + text;
        const std::size_t columns = measure(piece) + 1;
        if (!leading && used + columns > width) {
            lines.push_back(piece);
            used = later + columns;
            continue;
        }
        lines.back() += (leading ? "" : " ") + piece;
        used += columns;
    }
    return lines;
}

std::size_t columns_of(std::string_view text)
{
    std::size_t columns = 0;
    for (std::size_t k = 0; k < text.size(); ++k) {
        const auto byte = static_cast<unsigned char>(text[k]);
        const auto next = static_cast<unsigned char>(k + 1 < text.size() ? text[k + 1] : 0);
        const bool continuation = (byte & 0xC0U) == 0x80U;
        const bool combining = byte == 0xCC || (byte == 0xCD && next < 0xB0); // U+0300 .. U+036F
        if (!continuation && !combining) ++columns;
    }
    return columns;
}

} // namespace lagen
