// SPDX-License-Identifier: GPL-2.0-or-later
/// Terms of a right side, and their lines.
#include "typeset/print_equations_terms.hpp"

#include "text/alphabet.hpp"

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

bool is_vector_product(const Tree& tree)
{
    return tree->kind == TreeKind::apply;
}

bool is_indexed_sum(const Tree& tree)
{
    return tree->kind == TreeKind::sum_over;
}

const std::vector<Equation>& written_equations(const EquationBlock& block)
{
    return block.written.empty() ? block.equations : block.written;
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

std::string one_line(const SignedTexts& terms)
{
    std::string text;
    for (const auto& [negative, term] : terms)
        text += (text.empty() ? (negative ? "-" : "") : (negative ? " - " : " + ")) + term;
    return text;
}

std::vector<std::string> wrap_terms(const SignedTexts& terms, std::size_t first, std::size_t later, std::size_t width,
                                    std::size_t (*measure)(std::string_view))
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

namespace {

/// Where a line of at most `width` columns is best broken: the space there. At the beginning, where nowhere.
std::size_t best_break(const std::string& line, std::size_t width)
{
    std::size_t best = 0, columns = 0, depth = 0, best_depth = 0;
    for (std::size_t k = 0; k < line.size(); ++k) {
        if (begins_character(line[k])) ++columns; // a combining mark too: no line is wider
        if (columns > width) break;
        if (line[k] == '(' || line[k] == '[') ++depth;
        if ((line[k] == ')' || line[k] == ']') && depth > 0) --depth;
        const bool sign = line.compare(k, 3, " + ") == 0 || line.compare(k, 3, " - ") == 0;
        const bool behind_sign = k > 0 && (line[k - 1] == '+' || line[k - 1] == '-');
        if (line[k] != ' ' || behind_sign || columns < width / 2) continue;
        const std::size_t cost = 2 * depth + (sign ? 0 : 3);
        if (best != 0 && cost > best_depth) continue;
        best = k;
        best_depth = cost;
    }
    return best;
}

} // namespace

std::vector<std::string> with_inner_breaks(const std::vector<std::string>& lines, std::size_t first, std::size_t later,
                                           std::size_t width)
{
    std::vector<std::string> result;
    for (std::string line : lines) {
        for (;;) {
            const std::size_t room = width - std::min(width, result.empty() ? first : later);
            const std::size_t at = columns_of(line) > room ? best_break(line, room) : 0;
            if (at == 0) break;
            result.push_back(line.substr(0, line.find_last_not_of(' ', at) + 1));
            line = line.substr(line.find_first_not_of(' ', at));
        }
        result.push_back(line);
    }
    return result;
}

std::vector<std::string> wrap_entries(const std::vector<std::string>& entries, const char* open, const char* close,
                                      std::size_t first, std::size_t later, std::size_t width,
                                      std::size_t (*measure)(std::string_view))
{
    std::vector<std::string> lines{open};
    std::size_t used = first + 1;
    for (std::size_t k = 0; k < entries.size(); ++k) {
        const std::string piece = entries[k] + (k + 1 < entries.size() ? "," : close);
        const std::size_t columns = measure(piece) + 1;
        if (k > 0 && used + columns > width) {
            lines.push_back(piece);
            used = later + columns;
            continue;
        }
        lines.back() += (k == 0 ? "" : " ") + piece;
        used += columns;
    }
    return lines;
}

std::vector<WhereItem> where_items(const EquationSet& equations)
{
    std::vector<WhereItem> items;
    for (const VectorText& vector : equations.vectors) items.push_back({vector.name, vector.entries, vector.diagonal});
    std::vector<Equation> entries = equations.written_where;
    if (entries.empty())
        for (const WhereEntry& entry : equations.where)
            entries.push_back({LeftSide::symbol, entry.symbol, {}, {{"", entry.value}}});
    const auto value_of = [](const Equation& entry) {
        std::vector<Tree> terms;
        for (const TermGroup& group : entry.groups) terms.push_back(group.value);
        return terms.size() == 1 ? terms[0] : add(terms);
    };
    for (std::size_t k = 0; k < entries.size(); ++k) {
        const auto known = std::ranges::find(equations.where, entries[k].symbol, &WhereEntry::symbol);
        const std::size_t size = known == equations.where.end() ? 1 : known->family;
        const std::string stem = entries[k].symbol.substr(0, entries[k].symbol.find('['));
        bool whole = size > 1 && k + size <= entries.size();
        for (std::size_t entry = 0; whole && entry < size; ++entry)
            whole = entries[k + entry].symbol == stem + "[" + std::to_string(entry + 1) + "]";
        items.push_back({whole ? stem : entries[k].symbol, {}, false, entries[k].ranges});
        for (std::size_t entry = 0; entry < (whole ? size : 1); ++entry)
            items.back().values.push_back(value_of(entries[k + entry]));
        if (whole) k += size - 1;
    }
    return items;
}

} // namespace lagen
