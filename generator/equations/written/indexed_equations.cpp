// SPDX-License-Identifier: GPL-2.0-or-later
#include "equations/written/indexed_equations.hpp"

#include "equations/written/equation_tree.hpp"
#include "equations/written/indexed_sums.hpp"

#include <algorithm>
#include <map>

namespace lagen {
namespace {

constexpr std::size_t fewest = 3;       ///< equations that are worth one with indices
constexpr std::size_t most_indices = 2; ///< of a name that run
constexpr std::size_t guessed_from = 3; ///< equations: that of i = 1 does not show that j != i is left out of a sum

/// An equation on its way: the letters of its ranges are "$1", "$2" for the first, the second index of the left side.
struct Draft {
    Equation equation; ///< but for what `tree` has
    Tree tree;
};

class Joining {
  public:
    Joining(const EquationSet& equations, const Model& model) : sums_(names_of(equations))
    {
        std::set<std::string> taken;
        for (const Size& size : model.sizes) taken.insert(size.name);
        for (const SymbolText& symbol : equations.symbols) {
            taken.insert(symbol.name);
            taken.insert(symbol.latex.substr(0, symbol.latex.find('_'))); // k of kappa = { latex = "k" }
        }
        for (const std::string& each : names_of(equations)) taken.insert(each.substr(0, each.find('[')));
        for (const char* letter : {"i", "j", "k", "l", "n", "p", "q", "r", "s", "a", "b", "c", "d"})
            if (!taken.contains(letter)) letters_.emplace_back(letter);
    }

    /// The equations with sums and ranges; nothing where none has any.
    std::vector<Equation> joined(const std::vector<Equation>& equations)
    {
        std::vector<Draft> drafts;
        for (const Equation& equation : equations) drafts.push_back(draft_of(equation));
        drafts = joined_runs(drafts);
        std::vector<Equation> result;
        bool any = drafts.size() < equations.size();
        for (const Draft& draft : drafts) {
            result.push_back(finished(draft));
            any = any || has_sums(tree_of(result.back()));
        }
        return any ? result : std::vector<Equation>();
    }

  private:
    static std::set<std::string> names_of(const EquationSet& equations)
    {
        std::set<std::string> names;
        const auto take = [&](const Tree& tree) {
            for (const std::string& each : names_in(tree)) names.insert(each);
        };
        for (const auto* blocks : {&equations.given, &equations.blocks})
            for (const EquationBlock& block : *blocks)
                for (const auto* list : {&block.equations, &block.written})
                    for (const Equation& equation : *list) take(tree_of(equation));
        for (const WhereEntry& entry : equations.where) {
            names.insert(entry.symbol);
            take(entry.value);
        }
        return names;
    }

    Draft draft_of(const Equation& equation)
    {
        const Tree tree = tree_of(equation);
        if (!is_plain(equation)) return {equation, tree};
        sums_.begin_equation();
        std::vector<Tree> mass, terms;
        for (const Tree& entry : tree->arguments[1]->arguments) mass.push_back(sums_.joined(entry));
        mass = joined_mass(mass);
        for (const Tree& group : tree->arguments[2]->arguments) {
            if (group->kind == TreeKind::add)
                terms.insert(terms.end(), group->arguments.begin(), group->arguments.end());
            else
                terms.push_back(group);
        }
        for (Tree& term : terms) term = sums_.joined(term);
        const Tree joined = array_of({tree->arguments[0], array_of(mass), array_of(sums_.joined_terms(terms))});
        const bool has_letters = sums_inside(joined) + most_indices <= letters_.size();
        return {equation, has_sums(joined) && has_letters ? joined : tree};
    }

    /// I[i] w[i]' + J sum_j w[j]' for a row (I[1] + J) w[1]' + J w[2]' + ..: sums in masses are taken apart where that
    /// leaves fewer terms.
    std::vector<Tree> joined_mass(const std::vector<Tree>& mass)
    {
        std::vector<Tree> apart;
        for (const Tree& entry : mass) {
            if (!is_mass_times_rate(entry) || entry->arguments[0]->kind != TreeKind::add) {
                apart.push_back(entry);
                continue;
            }
            for (const Tree& term : entry->arguments[0]->arguments)
                apart.push_back(times_rate(term, entry->arguments[1]));
        }
        std::vector<Tree> whole = sums_.joined_terms(mass), parts = sums_.joined_terms(apart);
        return parts.size() < whole.size() ? parts : whole;
    }

    /// Runs along one index, and those of these along another. Rows of two are joined where their columns are.
    std::vector<Draft> joined_runs(const std::vector<Draft>& drafts)
    {
        std::vector<Draft> best = joined_runs(drafts, fewest);
        const auto has_rows = [](const Draft& draft) { return shape_of(draft.tree->arguments[0]).slots.size() == 2; };
        const auto stands_for = [](const Draft& draft) {
            std::size_t count = 1;
            for (const IndexRange& range : draft.equation.ranges) count *= range.to - range.from + 1;
            return count;
        };
        if (std::ranges::none_of(best, has_rows)) return best;
        std::vector<Draft> pairs = joined_runs(drafts, 2);
        const bool shorter = pairs.size() < best.size() && std::ranges::none_of(pairs, [&](const Draft& draft) {
                                 return stands_for(draft) > 1 && stands_for(draft) < fewest;
                             });
        return shorter ? pairs : best;
    }

    std::vector<Draft> joined_runs(std::vector<Draft> drafts, std::size_t least)
    {
        for (std::size_t before = 0; before != drafts.size();) {
            before = drafts.size();
            std::vector<Draft> result;
            for (std::size_t first = 0; first < drafts.size();) {
                std::size_t count = 1;
                std::optional<Draft> run = longest_run(drafts, first, least, count);
                result.push_back(run ? std::move(*run) : drafts[first]);
                first += count;
            }
            drafts = std::move(result);
        }
        return drafts;
    }

    std::optional<Draft> longest_run(const std::vector<Draft>& drafts, std::size_t first, std::size_t least,
                                     std::size_t& count)
    {
        if (first + least > drafts.size() || !is_plain(drafts[first].equation)) return std::nullopt;
        std::optional<IndexPattern> longest;
        std::size_t length = 1;
        const std::vector<std::optional<long>> indices = running_indices(drafts[first], drafts[first + 1]);
        for (std::size_t slot = 0; slot < std::min(indices.size(), letters_.size()); ++slot)
            for (std::size_t from = 0; from < guessed_from; ++from) {
                if (!indices[slot] || first + length == drafts.size() || first + from + 1 >= drafts.size()) continue;
                const long value = *indices[slot] + static_cast<long>(from);
                for (IndexPattern& pattern :
                     patterns_of(drafts, first + from, "$" + std::to_string(slot + 1), value, slot + 1)) {
                    pattern.value = *indices[slot];
                    std::size_t reached = 0;
                    while (first + reached < drafts.size() &&
                           fits(pattern, drafts[first], drafts[first + reached], reached))
                        ++reached;
                    if (reached <= length) continue;
                    length = reached;
                    longest = std::move(pattern);
                }
            }
        if (length < least) return std::nullopt;
        Draft result{drafts[first].equation, longest->tree};
        const auto from = static_cast<std::size_t>(longest->value);
        result.equation.ranges.insert(result.equation.ranges.begin(), {longest->letter, from, from + length - 1});
        count = length;
        return result;
    }

    /// The indices of the left side that are greater by one in the next equation, in their places; of "0 = .." that in
    /// which the right sides differ.
    static std::vector<std::optional<long>> running_indices(const Draft& draft, const Draft& next)
    {
        if (draft.equation.left == LeftSide::zero) {
            const auto common = common_pattern(draft.tree, shape_of(draft.tree), shape_of(next.tree), "$1");
            return {common ? common->value : 1};
        }
        const std::vector<IndexSlot> here = shape_of(draft.tree->arguments[0]).slots;
        const std::vector<IndexSlot> there = shape_of(next.tree->arguments[0]).slots;
        std::vector<std::optional<long>> indices;
        for (std::size_t slot = 0; slot < here.size() && here.size() == there.size() && slot < most_indices; ++slot) {
            const std::optional<long> value = index_number(here[slot].text);
            indices.push_back(value && index_number(there[slot].text) == *value + 1 ? value : std::nullopt);
        }
        return indices;
    }

    /// All that the first equation may be with a letter for the index of its left side that has this value.
    std::vector<IndexPattern> patterns_of(const std::vector<Draft>& drafts, std::size_t first,
                                          const std::string& letter, long value, std::size_t place)
    {
        std::vector<IndexPattern> patterns;
        const Tree& tree = drafts[first].tree;
        const auto common = common_pattern(tree, shape_of(tree), shape_of(drafts[first + 1].tree), letter);
        if (common && common->value == value) patterns.push_back(*common);
        if (!has_sums(tree)) return patterns;
        for (const std::size_t where : {std::size_t{0}, place}) { // the letter for indices in any place, or in this one
            std::vector<Tree> parts{lifted(tree->arguments[0], letter, value, where)[0]};
            for (const std::size_t list : {1U, 2U}) {
                std::vector<Tree> entries;
                for (const Tree& entry : tree->arguments[list]->arguments) {
                    const std::vector<Tree> guesses = lifted(entry, letter, value, where);
                    Reach best;
                    entries.push_back(guesses[0]);
                    for (const Tree& guess : guesses) {
                        const Reach reach = reach_of({guess, letter, value}, drafts, first, list);
                        if (reach <= best) continue;
                        best = reach;
                        entries.back() = guess;
                    }
                }
                parts.push_back(array_of(entries));
            }
            patterns.push_back({array_of(parts), letter, value});
        }
        return patterns;
    }

    /// Equations from the first on that have the terms of a pattern among theirs, and all these terms.
    struct Reach {
        std::size_t equations = 0, terms = 0;

        friend auto operator<=>(const Reach&, const Reach&) = default;
    };
    Reach reach_of(const IndexPattern& pattern, const std::vector<Draft>& drafts, std::size_t first, std::size_t list)
    {
        Reach reach;
        for (std::size_t k = first; k < drafts.size() && is_plain(drafts[k].equation); ++k) {
            const Tree here = at_index(pattern.tree, pattern.letter, pattern.value + static_cast<long>(k - first));
            const std::optional<Keys> part = sums_.knows_names(here) ? sums_.keys().of(here) : std::nullopt;
            const std::optional<Keys> whole = keys_of(drafts[k].tree->arguments[list]);
            if (!part || !whole || !std::ranges::includes(*whole, *part)) break;
            ++reach.equations;
            reach.terms += part->size();
        }
        return reach;
    }

    std::optional<Keys> keys_of(const Tree& list)
    {
        return list->arguments.empty() ? std::optional<Keys>(Keys()) : sums_.keys().of(add(list->arguments));
    }

    /// True where the pattern is, `by` further on, this equation.
    bool fits(const IndexPattern& pattern, const Draft& first, const Draft& draft, std::size_t by)
    {
        if (!is_plain(draft.equation) || draft.equation.left != first.equation.left ||
            draft.equation.ranges != first.equation.ranges)
            return false;
        const Tree here = at_index(pattern.tree, pattern.letter, pattern.value + static_cast<long>(by));
        if (same_tree(here, draft.tree)) return true;
        return here->arguments[0]->name == draft.tree->arguments[0]->name && has_sums(here) &&
               sums_.knows_names(here) && same_terms(here->arguments[1], draft.tree->arguments[1]) &&
               same_terms(here->arguments[2], draft.tree->arguments[2]);
    }

    bool same_terms(const Tree& a, const Tree& b)
    {
        const std::optional<Keys> first = keys_of(a), second = keys_of(b);
        return first && second && *first == *second;
    }

    /// With letters for the marks of indices.
    Equation finished(const Draft& draft)
    {
        Equation result = draft.equation;
        std::size_t taken = 0;
        std::map<std::string, std::string> letters;
        for (IndexRange& range : result.ranges) {
            const std::size_t slot = static_cast<std::size_t>(range.letter[1] - '1');
            taken = std::max(taken, slot + 1);
            letters[range.letter] = letters_[slot];
            range.letter = letters_[slot];
        }
        std::vector<Tree> parts{draft.tree->arguments[0]};
        for (const std::size_t list : {1U, 2U}) {
            std::vector<Tree> entries;
            for (const Tree& entry : draft.tree->arguments[list]->arguments) {
                const Tree whole = sums_.finished(entry);
                if (whole->kind == TreeKind::add && entry->kind == TreeKind::sum_over)
                    entries.insert(entries.end(), whole->arguments.begin(), whole->arguments.end());
                else
                    entries.push_back(whole);
            }
            parts.push_back(array_of(entries));
        }
        const Tree whole = array_of(parts);
        if (!has_sums(whole) && result.ranges.empty()) return draft.equation;
        return with_tree(result, with_letters(whole, letters, taken));
    }

    Tree with_letters(const Tree& tree, const std::map<std::string, std::string>& letters, std::size_t taken) const
    {
        const auto text = [&](const std::string& index) {
            std::string result;
            for (std::size_t k = 0; k < index.size(); ++k) {
                const auto known =
                    index[k] == '#' || index[k] == '$' ? letters.find(index.substr(k, 2)) : letters.end();
                result += known == letters.end() ? std::string(1, index[k]) : known->second;
                if (known != letters.end()) ++k;
            }
            return result;
        };
        if (tree->kind == TreeKind::name) return name(text(tree->name));
        TreeNode node = *tree;
        if (node.kind != TreeKind::sum_over) {
            for (Tree& argument : node.arguments) argument = with_letters(argument, letters, taken);
            return std::make_shared<const TreeNode>(std::move(node));
        }
        std::map<std::string, std::string> inner = letters;
        inner[tree->name] = letters_[taken];
        node.name = letters_[taken];
        for (std::size_t k = 0; k < node.arguments.size(); ++k)
            node.arguments[k] =
                k == 2 ? with_letters(tree->arguments[2], inner, taken + 1) : name(text(tree->arguments[k]->name));
        return std::make_shared<const TreeNode>(std::move(node));
    }

    SumWriting sums_;
    std::vector<std::string> letters_; ///< of the first index, the second, ..
};

} // namespace

void write_by_index(EquationSet& equations, const Model& model)
{
    Joining joining(equations, model);
    for (auto* blocks : {&equations.given, &equations.blocks})
        for (EquationBlock& block : *blocks) {
            std::vector<Equation> joined = joining.joined(block.written.empty() ? block.equations : block.written);
            if (!joined.empty()) block.written = std::move(joined);
        }
    std::vector<Equation> where;
    for (const WhereEntry& entry : equations.where)
        where.push_back({LeftSide::symbol, entry.symbol, {}, {{"", entry.value}}});
    equations.written_where = joining.joined(where);
}

} // namespace lagen
