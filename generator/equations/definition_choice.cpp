// SPDX-License-Identifier: GPL-2.0-or-later
/// Which definitions of a model stay symbols in its derived equations. Uses of names are counted in what was derived
/// with them.
#include "equations/kept_symbols.hpp"

#include "expression/find_part.hpp"
#include "expression/fold.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>

namespace lagen {
namespace {

constexpr std::size_t most_nodes = 5000; ///< of a tree that are counted

} // namespace

std::size_t written_nodes(const Tree& tree)
{
    return Fold<std::size_t>()(tree, [](const Tree&, const std::vector<std::size_t>& counts) {
        return std::min(std::accumulate(counts.begin(), counts.end(), std::size_t{1}), most_nodes);
    });
}

void for_each_tree(const EquationBlock& block, const std::function<void(const Tree&)>& visit)
{
    for (const Equation& equation : block.equations)
        for (const auto* groups : {&equation.mass, &equation.groups})
            for (const TermGroup& group : *groups) visit(group.value);
}

namespace {

constexpr std::size_t one_page = 4000; ///< characters; what is longer is compared with the form without symbols
constexpr std::size_t long_value = 60; ///< nodes; so much is not written into equations in place of names

std::string stem_of(const std::string& name)
{
    return name.substr(0, name.find('['));
}

/// Occurrences of the stems of `where` in one tree, each place counted.
void count_names(const Tree& tree, std::map<std::string, std::size_t>& counts)
{
    std::vector<const TreeNode*> pending{tree.get()};
    std::size_t nodes = 0;
    while (!pending.empty() && nodes++ < 100 * most_nodes) {
        const TreeNode* node = pending.back();
        pending.pop_back();
        if (node->kind == TreeKind::name)
            if (const auto known = counts.find(stem_of(node->name)); known != counts.end()) ++known->second;
        for (const Tree& argument : node->arguments) pending.push_back(argument.get());
    }
}

/// Symbols that do not pay for their names.
std::set<std::string> needless(const EquationSet& set)
{
    std::map<std::string, std::size_t> none, most, all, size;
    for (const WhereEntry& entry : set.where) {
        none[stem_of(entry.symbol)] = 0;
        size[stem_of(entry.symbol)] += written_nodes(entry.value);
    }
    most = all = none;
    const auto take = [&](std::map<std::string, std::size_t> counts) {
        for (const auto& [name, count] : counts) {
            most[name] = std::max(most[name], count);
            all[name] += count;
        }
    };
    for (const EquationBlock& block : set.blocks) {
        std::map<std::string, std::size_t> counts = none;
        for_each_tree(block, [&](const Tree& tree) { count_names(tree, counts); });
        take(std::move(counts));
    }
    std::map<std::string, std::size_t> counts = none;
    for (const WhereEntry& entry : set.where) count_names(entry.value, counts);
    take(std::move(counts));
    std::set<std::string> names;
    for (const auto& [name, count] : most)
        if (count < 2 && all.at(name) < 3 && size.at(name) * all.at(name) < long_value) names.insert(name);
    return names;
}

/// Characters of all that is derived.
std::size_t written_length(const EquationSet& set)
{
    std::size_t length = 0;
    for (const EquationBlock& block : set.blocks)
        for_each_tree(block, [&](const Tree& tree) { length += to_text(tree).size(); });
    for (const WhereEntry& entry : set.where) length += to_text(entry.value).size();
    return length;
}

/// Derived again without the names that do not pay, until all do.
EquationSet with_symbols(const std::function<EquationSet(const DefinitionChoice&)>& derivation, DefinitionChoice choice)
{
    for (;;) {
        EquationSet set = derivation(choice);
        const std::size_t before = choice.dropped.size();
        choice.dropped.merge(needless(set));
        if (choice.dropped.size() == before) return set;
    }
}

/// True where it has a sine or a cosine, or one of the names.
bool is_circular(const Tree& tree, const std::set<std::string>& names)
{
    return any_part(tree, [&](const Tree& part) {
        return (part->kind == TreeKind::name && names.contains(stem_of(part->name))) ||
               (part->kind == TreeKind::call && (part->function == Function::sin || part->function == Function::cos));
    });
}

/// The definitions that are made of sines and cosines, the places of joints: written out, sin^2 + cos^2 and the
/// addition theorems may leave less than their names do.
std::set<std::string> circular_definitions(const EquationSet& set, const Model& model)
{
    std::set<std::string> definitions, circular;
    for (const Definition& each : model.definitions) definitions.insert(each.name);
    for (std::size_t before = 1; before != circular.size();) {
        before = circular.size();
        for (const WhereEntry& entry : set.where)
            if (definitions.contains(stem_of(entry.symbol)) && is_circular(entry.value, circular))
                circular.insert(stem_of(entry.symbol));
    }
    return circular;
}

} // namespace

EquationSet with_definitions(const Model& model, Definitions definitions,
                             const std::function<EquationSet(const DefinitionChoice&)>& derivation)
{
    if (definitions == Definitions::expanded) return derivation({});
    std::optional<EquationSet> set;
    try {
        set = with_symbols(derivation, {.kept = true});
    } catch (const TooMuchToRead&) {
    } catch (const MathematicsError&) { // in symbols something divides by what is zero
    }
    if (!set) return derivation({});
    std::size_t length = written_length(*set);
    // Names that the user gave stay unless much is gained.
    const auto take_shorter = [&](DefinitionChoice choice) {
        try {
            EquationSet written_out = choice.kept ? with_symbols(derivation, choice) : derivation(choice);
            const std::size_t shorter = written_length(written_out);
            if (shorter > choice.longest) return;
            set = std::move(written_out);
            length = shorter;
        } catch (const TooMuchToRead&) {
        } catch (const MathematicsError&) { // too large without symbols
        }
    };
    if (const std::set<std::string> circular = circular_definitions(*set, model); !circular.empty())
        take_shorter({.kept = true, .dropped = circular, .longest = length * 2 / 3});
    if (!set->where.empty() && length > one_page) take_shorter({.longest = length - 1});
    return std::move(*set);
}

} // namespace lagen
