// SPDX-License-Identifier: GPL-2.0-or-later
#include "equations/written/every_size.hpp"

#include "equations/written/equation_tree.hpp"
#include "equations/written/index_shape.hpp"
#include "equations/written/term_keys.hpp"
#include "expression/parse.hpp"
#include "expression/rewrite.hpp"

#include <algorithm>
#include <set>
#include <span>

namespace lagen {
namespace {

constexpr long least_shown = 4; ///< the size at which equations are written by indices: three terms may be none
constexpr std::size_t most_parts = 5000; ///< of an expression with its definitions written out

using Letters = std::set<std::string>;

bool is_name(const Tree& tree, const std::string& text)
{
    return tree->kind == TreeKind::name && tree->name == text;
}

/// letter + offset
bool is_shifted(const Tree& tree, const std::string& letter, long offset)
{
    if (offset == 0) return is_name(tree, letter);
    return tree->kind == TreeKind::add && tree->arguments.size() == 2 && is_name(tree->arguments[0], letter) &&
           same_tree(tree->arguments[1], offset > 0 ? number(offset) : negate(number(-offset)));
}

/// Counts the letters that stand in one product of a function of every size.
class LetterCount {
  public:
    /// `size`: what n is as a number; nothing where only its name is.
    LetterCount(const Model& model, std::optional<long> size)
        : model_(model), size_(size), size_name_(model.sizes[0].name)
    {
    }

    /// Nothing where the expression, over these letters, is no such function.
    std::optional<std::size_t> of(const Tree& tree, const Letters& letters)
    {
        const std::size_t count = count_of(tree, letters);
        return is_one_ ? std::optional(count) : std::nullopt;
    }

  private:
    std::size_t none()
    {
        is_one_ = false;
        return 0;
    }

    std::size_t count_of(const Tree& tree, const Letters& letters)
    {
        if (!is_one_ || ++parts_ > most_parts) return none();
        const std::vector<Tree>& parts = tree->arguments;
        switch (tree->kind) {
        case TreeKind::number:
        case TreeKind::pi: return 0;
        case TreeKind::name: return of_name(*tree, letters);
        case TreeKind::index: return of_entry(*tree, letters);
        case TreeKind::apply: return of_application(*tree, letters);
        case TreeKind::sum_over: return of_sum(*tree, letters);
        case TreeKind::negate: return count_of(parts[0], letters);
        case TreeKind::add: {
            std::size_t most = 0;
            for (const Tree& term : parts) most = std::max(most, count_of(term, letters));
            return most;
        }
        case TreeKind::multiply: {
            std::size_t all = 0;
            for (const Tree& factor : parts) all += count_of(factor, letters);
            return all;
        }
        case TreeKind::divide: return count_of(parts[1], letters) == 0 ? count_of(parts[0], letters) : none();
        case TreeKind::power: return of_power(parts[0], parts[1], letters);
        case TreeKind::call:
            return std::ranges::all_of(parts, [&](const Tree& part) { return count_of(part, letters) == 0; }) ? 0
                                                                                                              : none();
        default: return none();
        }
    }

    std::size_t of_power(const Tree& base, const Tree& exponent, const Letters& letters)
    {
        const std::size_t count = count_of(base, letters);
        if (count == 0) return count_of(exponent, letters) == 0 ? 0 : none();
        const bool expands = exponent->kind == TreeKind::number && exponent->number >= 1 && exponent->number <= 4 &&
                             exponent->number.get_den() == 1;
        return expands ? count * exponent->number.get_num().get_ui() : none();
    }

    /// A number that is no index: n alone, and a family as a whole, tell sizes apart.
    std::size_t of_name(const TreeNode& node, const Letters& letters)
    {
        const bool is_family = std::ranges::find(model_.families, node.name, &Family::name) != model_.families.end();
        if (letters.contains(node.name) || node.name == size_name_ || is_family) return none();
        const auto known = std::ranges::find(model_.definitions, node.name, &Definition::name);
        if (known == model_.definitions.end()) return 0;
        return known->parameters.empty() ? count_of(known->body, {}) : none();
    }

    std::size_t of_entry(const TreeNode& node, const Letters& letters)
    {
        const auto is_letter = [&](const Tree& index) {
            return index->kind == TreeKind::name && letters.contains(index->name);
        };
        const auto indices = std::span(node.arguments).subspan(1);
        const bool is_entry = node.arguments[0]->kind == TreeKind::name && std::ranges::all_of(indices, is_letter);
        return is_entry ? 0 : none();
    }

    std::size_t of_application(const TreeNode& node, const Letters& letters)
    {
        const auto known = std::ranges::find(model_.definitions, node.name, &Definition::name);
        if (known == model_.definitions.end() || known->parameters.size() != node.arguments.size()) return none();
        for (const Tree& argument : node.arguments)
            if (argument->kind != TreeKind::name || !letters.contains(argument->name)) return none();
        return count_of(known->body, Letters(known->parameters.begin(), known->parameters.end()));
    }

    [[nodiscard]] bool is_size(const Tree& tree, long less) const
    {
        if (tree->kind == TreeKind::number) return size_ && tree->number == *size_ - less;
        return less == 0 && is_name(tree, size_name_);
    }

    /// True of a sum over a second letter that is empty where the first, `letter`, is 1 (or n).
    [[nodiscard]] bool is_empty_at(const Tree& tree, const std::string& letter, bool first) const
    {
        const std::vector<Tree>& parts = tree->arguments;
        const auto is_inside = [&](const Tree& part) { return is_empty_at(part, letter, first); };
        if (tree->kind == TreeKind::negate || tree->kind == TreeKind::divide) return is_inside(parts[0]);
        if (tree->kind == TreeKind::multiply) return std::ranges::any_of(parts, is_inside);
        if (tree->kind != TreeKind::sum_over) return false;
        return first ? is_number(parts[0], 1) && is_shifted(parts[1], letter, -1)
                     : is_shifted(parts[0], letter, 1) && is_size(parts[1], 0);
    }

    static bool is_number(const Tree& tree, long value)
    {
        return tree->kind == TreeKind::number && tree->number == value;
    }

    std::size_t of_sum(const TreeNode& sum, const Letters& letters)
    {
        const Tree &from = sum.arguments[0], &to = sum.arguments[1], &body = sum.arguments[2];
        if (sum.arguments.size() > 3 || letters.contains(sum.name)) return none();
        const auto is_letter = [&](const Tree& bound, long offset) {
            return std::ranges::any_of(letters, [&](const std::string& each) {
                return is_shifted(bound, each, 0) || is_shifted(bound, each, offset);
            });
        };
        const bool greatest =
            from->kind == TreeKind::call && from->function == Function::maximum &&
            std::ranges::all_of(from->arguments, [&](const Tree& each) { return is_letter(each, 0); });
        if (!is_number(from, 1) && !is_letter(from, 1) && !greatest &&
            !(is_number(from, 2) && is_empty_at(body, sum.name, true)))
            return none();
        if (!is_size(to, 0) && !is_letter(to, -1) && !(is_size(to, 1) && is_empty_at(body, sum.name, false)))
            return none();
        Letters inside = letters;
        inside.insert(sum.name);
        return 1 + count_of(body, inside);
    }

    const Model& model_;
    std::optional<long> size_;
    std::string size_name_;
    bool is_one_ = true;
    std::size_t parts_ = 0;
};

/// True where nothing stands in the equations but L, whose families run to the one size.
bool has_one_size(const Model& model)
{
    const auto is_bound = [](const Parameter& parameter) { return parameter.bound; };
    return model.sizes.size() == 1 && model.lagrangian && model.algebroid.kind == AlgebroidKind::tangent &&
           model.forces.empty() && !model.dissipation && !model.control && !model.discrete && model.inputs.empty() &&
           model.states.empty() && model.invariants.empty() && model.base.constraints.empty() &&
           model.base.casimirs.empty() && std::ranges::none_of(model.parameters, is_bound);
}

/// L as it is written; null where the file does not show it.
Tree written_lagrangian(const Model& model)
{
    std::string text = source_text(model.lagrangian_where);
    if (text.size() < 2 || (text[0] != '"' && text[0] != '\'') || text.back() != text[0]) return nullptr;
    text = text.substr(1, text.size() - 2);
    if (text.find_first_of("\"'\\") != std::string::npos) return nullptr;
    return parse_expression(whole_text("L", text));
}

/// With sums to another size.
Tree resized(const Tree& tree, long size, long other)
{
    if (tree->arguments.empty()) return tree;
    TreeNode node = *tree;
    for (Tree& argument : node.arguments) argument = resized(argument, size, other);
    if (node.kind == TreeKind::sum_over)
        if (const std::optional<long> to = index_number(node.arguments[1]->name); to && *to + 1 >= size)
            node.arguments[1] = name(std::to_string(*to - size + other));
    return std::make_shared<const TreeNode>(std::move(node));
}

/// Equations at one size as they are at another.
class Resizing {
  public:
    Resizing(const Model& model, EquationSet equations, long size)
        : model_(model), equations_(std::move(equations)), size_(size)
    {
    }

    /// True where all are functions of every size, with fewer letters than `size`.
    [[nodiscard]] bool is_of_every_size()
    {
        const auto is_one = [&](const EquationBlock& block) {
            return std::ranges::all_of(shown(block),
                                       [&](const Equation& equation) { return is_of_every_size(equation); });
        };
        return equations_.where.empty() && equations_.vectors.empty() && equations_.statements.empty() &&
               std::ranges::all_of(equations_.given, is_one) && std::ranges::all_of(equations_.blocks, is_one);
    }

    /// True where they are those that were derived at the other size.
    [[nodiscard]] bool agrees(const EquationSet& derived, long other)
    {
        const auto same = [&](const EquationBlock& a, const EquationBlock& b) {
            return a.title == b.title && same_equations(shown(a), b.equations, other);
        };
        return std::ranges::equal(equations_.given, derived.given, same) &&
               std::ranges::equal(equations_.blocks, derived.blocks, same);
    }

    [[nodiscard]] EquationSet at(long other)
    {
        for (auto* blocks : {&equations_.given, &equations_.blocks})
            for (EquationBlock& block : *blocks) {
                if (block.written.empty()) continue;
                block.equations.clear();
                for (Equation& equation : block.written) {
                    equation = with_tree(equation, resized(tree_of(equation), size_, other));
                    for (IndexRange& range : equation.ranges) range.to = static_cast<std::size_t>(other);
                }
            }
        return std::move(equations_);
    }

  private:
    static const std::vector<Equation>& shown(const EquationBlock& block)
    {
        return block.written.empty() ? block.equations : block.written;
    }

    [[nodiscard]] bool is_of_every_size(const Equation& equation) const
    {
        if (!is_plain(equation) || equation.ranges.size() > 1) return false;
        Letters letters;
        for (const IndexRange& range : equation.ranges) {
            if (range.from != 1 || range.to != static_cast<std::size_t>(size_)) return false;
            letters.insert(range.letter);
        }
        const Tree tree = rewrite(tree_of(equation), [](const Tree& part) { // rates have the indices of their names
            const bool is_rate = part->kind == TreeKind::name && part->name.starts_with(rate_mark);
            return is_rate ? name(part->name.substr(1)) : nullptr;
        });
        std::vector<Tree> all = tree->arguments[1]->arguments;
        all.insert(all.end(), tree->arguments[2]->arguments.begin(), tree->arguments[2]->arguments.end());
        if (equation.left != LeftSide::zero) all.push_back(tree->arguments[0]);
        return std::ranges::all_of(all, [&](const Tree& part) {
            if (any_excluded(part)) return false;
            const Tree parsed = parse_expression(whole_text("equation", to_text(part)));
            const auto count = LetterCount(model_, size_).of(parsed, letters);
            return count && *count + letters.size() < static_cast<std::size_t>(size_);
        });
    }

    /// A sum without one value is none that the language has.
    static bool any_excluded(const Tree& tree)
    {
        return (tree->kind == TreeKind::sum_over && tree->arguments.size() > 3) ||
               std::ranges::any_of(tree->arguments, any_excluded);
    }

    bool same_equations(const std::vector<Equation>& written, const std::vector<Equation>& derived, long other)
    {
        std::size_t next = 0;
        for (const Equation& equation : written) {
            const Tree tree = resized(tree_of(equation), size_, other);
            const long count = equation.ranges.empty() ? 1 : other;
            for (long value = 1; value <= count; ++value, ++next) {
                const Tree here = equation.ranges.empty() ? tree : at_index(tree, equation.ranges[0].letter, value);
                if (next == derived.size() || !is_plain(derived[next]) || derived[next].left != equation.left)
                    return false;
                const Tree there = tree_of(derived[next]);
                if (!same_tree(here->arguments[0], there->arguments[0])) return false;
                for (const std::size_t list : {1U, 2U})
                    if (!same_terms(here->arguments[list]->arguments, there->arguments[list]->arguments)) return false;
            }
        }
        return next == derived.size();
    }

    bool same_terms(const std::vector<Tree>& a, const std::vector<Tree>& b)
    {
        const std::optional<Keys> first = keys_.of(add(a)), second = keys_.of(add(b));
        return first && second && *first == *second;
    }

    const Model& model_;
    EquationSet equations_;
    long size_;
    TermKeys keys_;
};

} // namespace

std::optional<EquationSet> equations_of_every_size(const Model& model,
                                                   const std::function<EquationSet(long size)>& derive_at)
{
    if (!has_one_size(model)) return std::nullopt;
    const Tree lagrangian = written_lagrangian(model);
    if (!lagrangian) return std::nullopt;
    const auto letters = LetterCount(model, std::nullopt).of(lagrangian, {});
    if (!letters) return std::nullopt;
    const long shown = std::max(least_shown, static_cast<long>(*letters) + 1);
    if (model.sizes[0].value <= shown) return std::nullopt;
    Resizing equations(model, derive_at(shown), shown);
    if (!equations.is_of_every_size()) return std::nullopt;
    for (long size = 1; size < shown; ++size)
        if (!equations.agrees(derive_at(size), size)) return std::nullopt;
    return equations.at(model.sizes[0].value);
}

} // namespace lagen
