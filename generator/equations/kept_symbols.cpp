// SPDX-License-Identifier: GPL-2.0-or-later
/// Names for trees, the chain rule over them, and the list of what they stand for.
#include "equations/kept_symbols.hpp"

#include "expression/find_part.hpp"
#include "expression/rewrite.hpp"
#include "symbolic/shortest_form.hpp"
#include "typeset/latex_names.hpp"

#include <algorithm>
#include <cstdlib>
#include <tuple>

namespace lagen {

bool is_rough(const TreeNode& node)
{
    return node.kind == TreeKind::compare ||
           (node.kind == TreeKind::call && (!entry_of(node.function).smooth || node.function == Function::select));
}

namespace {

/// 1 and 10 of "[1,10]".
std::vector<long> indices_of(const std::string& index)
{
    std::vector<long> indices;
    for (std::size_t k = index.find_first_of("[,"); k < index.size() - 1; k = index.find_first_of("[,", k + 1))
        indices.push_back(std::strtol(index.c_str() + k + 1, nullptr, 10));
    return indices;
}

constexpr std::size_t short_definition = 7;  ///< nodes of what is not worth a name
constexpr std::size_t short_derivative = 12; ///< likewise
constexpr std::size_t most_derivatives = 40; ///< with names: more take long, and nobody reads them

bool is_smooth(const Tree& tree)
{
    return !any_part(tree, [](const Tree& part) { return is_rough(*part); });
}

/// Names that no definition on points of the base depends on.
std::set<std::string> moving_names(const Model& model)
{
    std::set<std::string> names;
    for (const std::vector<Symbol>* list : {&model.fibre.coordinates, &model.fibre.momenta, &ambient_fibre(model)})
        for (const Symbol& symbol : *list) names.insert(symbol.name);
    if (model.control)
        for (const Symbol& symbol : model.control->controls) names.insert(symbol.name);
    for (const Input& input : model.inputs) names.insert(input.symbol.name);
    for (const FirstOrderState& state : model.states) names.insert(state.symbol.name);
    return names;
}

bool holds_any(const Tree& tree, const std::set<std::string>& names)
{
    return find_name({tree}, [&](const std::string& each) { return names.contains(each); }) != nullptr;
}

void insert_behind(std::vector<std::string>& list, const std::string& behind, const std::string& name)
{
    const auto found = std::ranges::find(list, behind);
    list.insert(found == list.end() ? found : found + 1, name);
}

} // namespace

KeptSymbols::KeptSymbols(const Model& model, const DefinitionChoice& choice, const std::set<std::string>& substituted,
                         std::function<Tree(const Tree&)> prepared, SymbolTable& symbols, Order& order)
    : model_(model), choice_(choice), prepared_(std::move(prepared)), symbols_(symbols), order_(order)
{
    if (choice.kept) take_definitions(substituted);
}

void KeptSymbols::take_definitions(const std::set<std::string>& substituted)
{
    const std::set<std::string> moving = moving_names(model_);
    for (const Definition& definition : model_.definitions) {
        if (!definition.parameters.empty() || choice_.dropped.contains(definition.name)) continue;
        ArrayValue value = model_.columns.close_array(name(definition.name, definition.where), true);
        if (value.shape.rank == Rank::matrix) continue;
        for (Tree& entry : value.entries) entry = prepared_(entry);
        const auto all = [&](auto property) { return std::ranges::all_of(value.entries, property); };
        if (all([](const Tree& entry) { return written_nodes(entry) <= short_definition; })) continue;
        if (!all([&](const Tree& entry) { return is_smooth(entry) && !holds_any(entry, substituted); })) continue;
        for (std::size_t k = 0; k < value.entries.size(); ++k) {
            Kept kept;
            kept.stem = definition.name;
            kept.index = entry_name("", value.shape, k);
            kept.family = value.entries.size();
            kept.tree = value.entries[k];
            if (written_nodes(kept.tree) > short_definition) {
                by_tree_.try_emplace(identity_(kept.tree), kept_.size());
                if (kept.tree->kind == TreeKind::negate) // whose sign may have gone into another one
                    by_negative_.try_emplace(identity_(kept.tree->arguments[0]), kept_.size());
            }
            kept.of_points = !holds_any(value.entries[k], moving);
            append(std::move(kept));
        }
    }
}

void KeptSymbols::append(Kept kept)
{
    const std::string name = kept.name();
    std::vector<std::string>& list = kept.of_points ? order_.parameters : order_.variables;
    insert_behind(list, kept.behind, name);
    if (kept.by.empty()) kept.root = kept_.size();
    kept.symbol = symbols_.symbol(name);
    index_.emplace(name, kept_.size());
    kept_.push_back(std::move(kept));
}

/// The name of the definition that a tree is, or -1 times; null where it is none but `own`, or none at all.
Tree KeptSymbols::name_of(const Tree& tree, std::optional<std::size_t> own)
{
    const std::size_t identity = identity_(tree);
    const auto found = by_tree_.find(identity), opposite = by_negative_.find(identity);
    if (found != by_tree_.end() && own != found->second) return name(kept_[found->second].name());
    if (opposite != by_negative_.end() && own != opposite->second) return negate(name(kept_[opposite->second].name()));
    return {};
}

Tree KeptSymbols::folded(const Tree& tree)
{
    if (by_tree_.empty()) return tree;
    return rewrite(tree, [&](const Tree& node) { return name_of(node, {}); });
}

GiNaC::ex KeptSymbols::value_of(std::size_t k)
{
    if (!kept_[k].value) {
        const Tree root = kept_[k].tree;
        const Tree inner = rewrite(root, [&](const Tree& node) { return node == root ? Tree{} : name_of(node, k); });
        kept_[k].value = to_ginac(inner, symbols_);
    }
    return *kept_[k].value;
}

std::vector<std::size_t> KeptSymbols::symbols_in(const GiNaC::ex& f) const
{
    std::set<std::size_t> found;
    if (index_.empty()) return {};
    for (auto node = f.preorder_begin(); node != f.preorder_end(); ++node) {
        if (!GiNaC::is_a<GiNaC::symbol>(*node)) continue;
        const auto known = index_.find(GiNaC::ex_to<GiNaC::symbol>(*node).get_name());
        if (known != index_.end()) found.insert(known->second);
    }
    return {found.begin(), found.end()};
}

GiNaC::ex KeptSymbols::derivative(const GiNaC::ex& f, const GiNaC::ex& symbol)
{
    GiNaC::exvector terms{f.diff(GiNaC::ex_to<GiNaC::symbol>(symbol))};
    for (const std::size_t k : symbols_in(f)) {
        const GiNaC::ex slope = rate(k, symbol);
        if (!slope.is_zero()) terms.push_back(f.diff(GiNaC::ex_to<GiNaC::symbol>(kept_[k].symbol)) * slope);
    }
    return GiNaC::ex(GiNaC::dynallocate<GiNaC::add>(terms));
}

/// The derivative of what symbol k stands for, written out.
const Tree& KeptSymbols::slope_of(std::size_t k, const GiNaC::ex& symbol)
{
    const std::pair key(k, GiNaC::ex_to<GiNaC::symbol>(symbol).get_name());
    if (const auto known = slopes_.find(key); known != slopes_.end()) return known->second;
    Tree slope = shortest_form(derivative(value_of(k), symbol), symbols_, order_);
    if (const Tree in_names = folded(slope); in_names != slope) // x/r of r = sqrt(x^2 + y^2)
        slope = shortest_form(to_ginac(in_names, symbols_), symbols_, order_);
    return slopes_.emplace(key, slope).first->second;
}

/// True of a derivative that is worth a symbol; in a family of variables all that are not zero are, or none.
bool KeptSymbols::has_long_slope(std::size_t k, const GiNaC::ex& symbol)
{
    const auto is_short = [&](const GiNaC::ex& variable) {
        return written_nodes(slope_of(k, variable)) <= short_derivative;
    };
    if (is_short(symbol)) return false;
    const std::string name = GiNaC::ex_to<GiNaC::symbol>(symbol).get_name();
    const std::size_t open = name.find('[');
    if (open == std::string::npos) return true;
    return std::ranges::none_of(order_.variables, [&](const std::string& each) {
        if (!each.starts_with(name.substr(0, open + 1)) || each == name) return false;
        const GiNaC::ex variable = symbols_.symbol(each);
        return value_of(k).has(variable) && is_short(variable);
    });
}

/// Mixed derivatives are one symbol, whatever comes first.
GiNaC::ex KeptSymbols::rate(std::size_t k, const GiNaC::ex& symbol)
{
    Kept next;
    next.by = kept_[k].by;
    next.by.push_back(GiNaC::ex_to<GiNaC::symbol>(symbol).get_name());
    std::ranges::sort(next.by);
    next.root = kept_[k].root;
    std::string key = std::to_string(next.root);
    for (const std::string& each : next.by) key += " " + each;
    if (const auto known = rates_.find(key); known != rates_.end()) return known->second;
    next.value = to_ginac(slope_of(k, symbol), symbols_);
    GiNaC::ex result = *next.value;
    if (const std::optional<GiNaC::ex> known = known_as(result)) {
        result = *known;
    } else if (has_long_slope(k, symbol)) {
        const Kept& root = kept_[next.root];
        next.stem = root.stem;
        for (const std::string& each : next.by) next.stem += "_" + each;
        next.index = root.index;
        next.stem = free_stem(next.stem, next.index);
        next.family = root.family;
        next.behind = kept_[k].name();
        if (!choice_.dropped.contains(next.stem)) {
            if (++derivatives_ > most_derivatives) throw TooMuchToRead();
            next.of_points = kept_[k].of_points;
            append(std::move(next));
            result = kept_.back().symbol;
        }
    }
    rates_.emplace(key, result);
    return result;
}

/// D or -D where that is a definition: w2 for dw1/dpsi.
std::optional<GiNaC::ex> KeptSymbols::known_as(const GiNaC::ex& value)
{
    if (!GiNaC::is_a<GiNaC::add>(value)) return {};
    for (std::size_t k = 0; k < kept_.size(); ++k) {
        if (!kept_[k].tree || written_nodes(kept_[k].tree) <= short_definition) continue;
        for (const int sign : {1, -1})
            if (expanded_length(value - sign * value_of(k)) == std::optional<std::size_t>(0))
                return GiNaC::ex(sign * kept_[k].symbol);
    }
    return {};
}

std::string KeptSymbols::free_stem(std::string stem, const std::string& index) const
{
    const auto taken = [&](const std::string& name) {
        return index_.contains(name) || std::ranges::find(order_.parameters, name) != order_.parameters.end() ||
               std::ranges::find(order_.variables, name) != order_.variables.end();
    };
    while (taken(stem + index)) stem += "_";
    return stem;
}

GiNaC::ex KeptSymbols::along_fibre(const GiNaC::ex& f, const GiNaC::exvector& y)
{
    GiNaC::exvector terms;
    for (const GiNaC::ex& each : y) terms.push_back(each * f.diff(GiNaC::ex_to<GiNaC::symbol>(each)));
    for (const std::size_t k : symbols_in(f))
        if (const GiNaC::ex slope = along_fibre(k, y); !slope.is_zero())
            terms.push_back(f.diff(GiNaC::ex_to<GiNaC::symbol>(kept_[k].symbol)) * slope);
    return GiNaC::ex(GiNaC::dynallocate<GiNaC::add>(terms));
}

GiNaC::ex KeptSymbols::along_fibre(std::size_t k, const GiNaC::exvector& y)
{
    if (const auto known = along_fibre_.find(k); known != along_fibre_.end()) return known->second;
    const GiNaC::ex slope = along_fibre(value_of(k), y);
    GiNaC::ex result = slope;
    for (const int degree : {0, 1, 2})
        if (const auto rest = expanded_length(slope - degree * value_of(k)); rest && *rest == 0) {
            result = degree * kept_[k].symbol;
            break;
        }
    along_fibre_.emplace(k, result);
    return result;
}

bool KeptSymbols::depends_on(const GiNaC::ex& f, const GiNaC::ex& symbol)
{
    if (f.has(symbol)) return true;
    return std::ranges::any_of(symbols_in(f), [&](std::size_t k) { return depends_on(value_of(k), symbol); });
}

bool KeptSymbols::vanishes(GiNaC::ex f)
{
    for (std::vector<std::size_t> inside = symbols_in(f); !inside.empty(); inside = symbols_in(f)) {
        GiNaC::exmap values;
        for (const std::size_t k : inside) values[kept_[k].symbol] = value_of(k);
        f = f.subs(values, GiNaC::subs_options::no_pattern);
    }
    return expanded_length(f) == std::optional<std::size_t>(0);
}

GiNaC::ex KeptSymbols::named(const std::string& name, const GiNaC::ex& value)
{
    if (!choice_.kept) return value;
    const Tree tree = shortest_form(value, symbols_, order_);
    if (written_nodes(tree) <= short_definition || choice_.dropped.contains(name)) return value;
    Kept kept;
    kept.stem = free_stem(name, "");
    kept.value = to_ginac(tree, symbols_);
    append(std::move(kept));
    return kept_.back().symbol;
}

std::vector<WhereEntry> KeptSymbols::where(const EquationSet& equations)
{
    std::set<std::size_t> used;
    std::vector<std::size_t> pending;
    const auto use = [&](std::size_t k) {
        if (used.insert(k).second) pending.push_back(k);
    };
    const auto use_names = [&](const Tree& tree) {
        for (const std::string& each : names_in(tree))
            if (const auto known = index_.find(each); known != index_.end()) use(known->second);
    };
    for (const auto* list : {&equations.given, &equations.blocks})
        for (const EquationBlock& block : *list) for_each_tree(block, use_names);
    std::map<std::size_t, Tree> values;
    while (!pending.empty()) {
        const std::size_t k = pending.back();
        pending.pop_back();
        values[k] = shortest_form(value_of(k), symbols_, order_);
        use_names(values[k]);
        for (std::size_t other = 0; other < kept_.size(); ++other) // a vector of the model is shown whole
            if (kept_[other].by.empty() && kept_[other].stem == kept_[k].stem) use(other);
    }
    std::vector<WhereEntry> entries;
    for (const auto& [k, value] : values) entries.push_back({kept_[k].name(), value, kept_[k].family});
    std::ranges::stable_sort(entries, {}, [&](const WhereEntry& entry) {
        const Kept& kept = kept_[index_.at(entry.symbol)];
        if (kept.by.empty()) return std::tuple(false, std::string(), std::vector<long>());
        const std::size_t open = std::min(entry.symbol.find('['), entry.symbol.size());
        return std::tuple(true, entry.symbol.substr(0, open), indices_of(entry.symbol.substr(open)));
    });
    return entries;
}

void KeptSymbols::append_latex(EquationSet& equations) const
{
    for (const Symbol& note : model_.notes)
        if (!note.latex.empty() && index_.contains(note.name)) equations.symbols.push_back({note.name, note.latex});
    const LatexNames names(equations.symbols);
    for (const Kept& kept : kept_) {
        if (kept.by.empty() || !kept.index.empty()) continue;
        std::string below;
        for (const std::string& each : kept.by) below += (below.empty() ? "" : ",") + names.symbol(each);
        equations.symbols.push_back({kept.name(), with_below(names.symbol(kept_[kept.root].stem), below)});
    }
}

} // namespace lagen
