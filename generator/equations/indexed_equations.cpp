// SPDX-License-Identifier: GPL-2.0-or-later
#include "equations/indexed_equations.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <set>

namespace lagen {
namespace {

constexpr std::size_t fewest = 3;        ///< equations that are worth one with an index
constexpr std::size_t most_parts = 4000; ///< of an equation that is looked at

/// An equation as a list: what it is made of, and the indices of its names by themselves.
struct Part {
    std::string text;
    bool is_index = false;

    friend bool operator==(const Part&, const Part&) = default;
};
using Parts = std::vector<Part>;

void append_name(const std::string& name, Parts& parts)
{
    const std::size_t open = name.find('[');
    if (open == std::string::npos || name.back() != ']') {
        parts.push_back({name});
        return;
    }
    parts.push_back({name.substr(0, open + 1)});
    std::string index;
    for (std::size_t k = open + 1; k < name.size(); ++k) {
        if (name[k] != ',' && name[k] != ']') {
            index += name[k];
            continue;
        }
        parts.push_back({index, true});
        index.clear();
    }
}

void append_tree(const Tree& tree, Parts& parts)
{
    if (parts.size() > most_parts) return;
    if (tree->kind == TreeKind::name) return append_name(tree->name, parts);
    if (tree->kind == TreeKind::number) return parts.push_back({tree->number.get_str()});
    std::string head = std::to_string(static_cast<int>(tree->kind)) + "/" + std::to_string(tree->arguments.size());
    if (tree->kind == TreeKind::call) head += entry_of(tree->function).name;
    if (tree->kind == TreeKind::apply) head += tree->name;
    if (tree->kind == TreeKind::compare) head += std::to_string(static_cast<int>(tree->comparison));
    if (tree->kind == TreeKind::solve) head += tree->number.get_str();
    parts.push_back({head});
    for (const Tree& argument : tree->arguments) append_tree(argument, parts);
}

Parts parts_of(const Equation& equation)
{
    Parts parts{{std::to_string(static_cast<int>(equation.left)) + "/" + std::to_string(equation.mass.size()) + "/" +
                 std::to_string(equation.groups.size())}};
    append_name(equation.symbol, parts);
    for (const TermGroup& entry : equation.mass) {
        append_name(entry.label, parts);
        append_tree(entry.value, parts);
    }
    for (const TermGroup& group : equation.groups) append_tree(group.value, parts);
    return parts;
}

bool is_number(const std::string& text)
{
    return !text.empty() && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

/// Gives the indices of an equation's names, in the order of its parts, other texts.
class IndexWriting {
  public:
    explicit IndexWriting(const Parts& parts)
    {
        for (const Part& part : parts)
            if (part.is_index) indices_.push_back(part.text);
    }

    Equation rewritten(Equation equation)
    {
        equation.symbol = rewritten(equation.symbol);
        for (TermGroup& entry : equation.mass) {
            entry.label = rewritten(entry.label);
            entry.value = rewritten(entry.value);
        }
        for (TermGroup& group : equation.groups) group.value = rewritten(group.value);
        return equation;
    }

  private:
    std::string rewritten(const std::string& name)
    {
        Parts parts;
        append_name(name, parts);
        if (parts.size() == 1) return name;
        std::string text = parts[0].text;
        for (std::size_t k = 1; k < parts.size(); ++k) text += (k > 1 ? "," : "") + indices_[next_++];
        return text + "]";
    }

    Tree rewritten(const Tree& tree)
    {
        if (tree->kind == TreeKind::name) return name(rewritten(tree->name));
        TreeNode node = *tree;
        for (Tree& argument : node.arguments) argument = rewritten(argument);
        return std::make_shared<const TreeNode>(std::move(node));
    }

    std::vector<std::string> indices_;
    std::size_t next_ = 0;
};

class Joining {
  public:
    explicit Joining(const EquationSet& equations)
    {
        for (const SymbolText& symbol : equations.symbols) names_.insert(symbol.name);
        for (const WhereEntry& entry : equations.where) names_.insert(entry.symbol.substr(0, entry.symbol.find('[')));
        for (const char* letter : {"i", "j", "k", "l", "n"})
            if (!names_.contains(letter)) letters_.emplace_back(letter);
    }

    /// Once more where families have two indices.
    std::vector<Equation> joined(std::vector<Equation> equations) const
    {
        for (std::size_t before = 0; before != equations.size();) {
            before = equations.size();
            equations = joined_once(equations);
        }
        return equations;
    }

  private:
    std::vector<Equation> joined_once(const std::vector<Equation>& equations) const
    {
        std::vector<Equation> result;
        for (std::size_t first = 0; first < equations.size();) {
            std::size_t count = 1;
            std::optional<Equation> run = longest_run(equations, first, count);
            result.push_back(run ? std::move(*run) : equations[first]);
            first += count;
        }
        return result;
    }

    std::optional<Equation> longest_run(const std::vector<Equation>& equations, std::size_t first,
                                        std::size_t& count) const
    {
        if (first + fewest > equations.size() || !is_plain(equations[first]) || !is_plain(equations[first + 1]))
            return std::nullopt;
        const Parts start = parts_of(equations[first]);
        const Parts second = parts_of(equations[first + 1]);
        const std::optional<std::size_t> slot = running_slot(start, second);
        if (!slot || *slot >= letters_.size()) return std::nullopt;
        std::vector<bool> runs(start.size(), false);
        for (std::size_t k = 0; k < start.size(); ++k) runs[k] = start[k].is_index && start[k].text != second[k].text;
        std::size_t length = 2;
        while (first + length < equations.size() && is_plain(equations[first + length]) &&
               equations[first + length].ranges == equations[first].ranges &&
               parts_of(equations[first + length]) == shifted(start, runs, length))
            ++length;
        if (length < fewest || equations[first + 1].ranges != equations[first].ranges) return std::nullopt;
        const std::string& letter = letters_[*slot];
        const auto from = static_cast<std::size_t>(std::stoul(start[2 + *slot].text));
        Parts pattern = start;
        for (std::size_t k = 0; k < pattern.size(); ++k)
            if (runs[k])
                pattern[k].text = letter_with_offset(letter, std::stol(start[k].text) - static_cast<long>(from));
        Equation result = IndexWriting(pattern).rewritten(equations[first]);
        result.ranges.insert(result.ranges.begin(), {letter, from, from + length - 1});
        count = length;
        return result;
    }

    static bool is_plain(const Equation& equation)
    {
        return (equation.left == LeftSide::time_derivative || equation.left == LeftSide::symbol) &&
               equation.relation == Relation::equal &&
               std::ranges::all_of(equation.groups, [](const TermGroup& group) { return group.basis.empty(); });
    }

    /// Which index of the left side runs from one equation to the next; nothing where the two differ otherwise.
    static std::optional<std::size_t> running_slot(const Parts& start, const Parts& second)
    {
        if (start.size() != second.size() || start.size() > most_parts) return std::nullopt;
        for (std::size_t k = 0; k < start.size(); ++k) {
            if (start[k] == second[k]) continue;
            if (!start[k].is_index || !second[k].is_index || !is_number(start[k].text) || !is_number(second[k].text) ||
                std::stol(second[k].text) != std::stol(start[k].text) + 1)
                return std::nullopt;
        }
        for (std::size_t k = 2; k < start.size() && start[k].is_index; ++k)
            if (start[k].text != second[k].text) return k - 2;
        return std::nullopt;
    }

    static Parts shifted(Parts parts, const std::vector<bool>& runs, std::size_t by)
    {
        for (std::size_t k = 0; k < parts.size(); ++k)
            if (runs[k]) parts[k].text = std::to_string(std::stoul(parts[k].text) + by);
        return parts;
    }

    static std::string letter_with_offset(const std::string& letter, long offset)
    {
        return offset == 0 ? letter : fmt::format("{}{:+}", letter, offset);
    }

    std::set<std::string> names_;
    std::vector<std::string> letters_; ///< of the first index, the second, ..
};

} // namespace

void write_by_index(EquationSet& equations)
{
    const Joining joining(equations);
    for (EquationBlock& block : equations.blocks) {
        const std::vector<Equation>& shown = block.written.empty() ? block.equations : block.written;
        std::vector<Equation> joined = joining.joined(shown);
        if (joined.size() < shown.size()) block.written = std::move(joined);
    }
}

} // namespace lagen
