// SPDX-License-Identifier: GPL-2.0-or-later
/// Rates and velocities as functions of the model's own fibre coordinates: xdot^i = rho^i_a y^a, the fibre coordinates
/// of inner frames, w_b = y^a A_a^b, and the ambient velocities of subbundles, v_x = rho^x_a y^a; and the names that a
/// person may have had for rates. Inner and ambient velocities are definitions that L, forces, observables and
/// invariants may use.
#include "expression/derivative.hpp"
#include "model/algebroid_draft.hpp"
#include "model/families.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace lagen {

namespace {

constexpr std::size_t longest_rate = 60;

std::vector<std::string> rate_spellings(const std::string& x)
{
    return {x + "dot", x + "_dot", "d" + x, "dot_" + x, "v_" + x, "v" + x, "d" + x + "dt", "d" + x + "_dt"};
}

std::vector<std::string> momentum_spellings(const std::string& x)
{
    return {"p_" + x, "p" + x, "mu_" + x};
}

bool is_among(const std::vector<std::string>& spellings, const std::string& name)
{
    return std::ranges::find(spellings, name) != spellings.end();
}

/// Without places: a mistake is where a rate is used, not where its symbols are declared.
std::vector<Tree> trees_of(const std::vector<Symbol>& symbols)
{
    std::vector<Tree> out;
    for (const Symbol& symbol : symbols) out.push_back(name(symbol.name));
    return out;
}

/// y[k] for the coordinate places[k].
void place_rates(std::vector<Tree>& rates, const std::vector<std::size_t>& places, const std::vector<Tree>& y)
{
    for (std::size_t k = 0; k < std::min(places.size(), y.size()); ++k) rates[places[k]] = y[k];
}

/// True where a minus stands before `tree`, and the tree behind it.
std::pair<bool, Tree> sign_and_size(const Tree& tree)
{
    if (tree->kind == TreeKind::negate) return {true, tree->arguments[0]};
    if (tree->kind == TreeKind::number && tree->number < 0) return {true, number(-tree->number)};
    return {false, tree};
}

using Terms = std::vector<std::vector<Tree>>;

/// Null where there are no terms.
std::vector<Tree> sums_of(const Terms& terms)
{
    std::vector<Tree> sums;
    for (const std::vector<Tree>& each : terms) sums.push_back(each.empty() ? nullptr : sum_of(each));
    return sums;
}

/// rho^i_a y^a by the anchor's entries, and by a representation -(A_a x)^i y^a.
std::vector<Tree> anchored_rates(const Model& model, const AlgebroidBlock& block, const std::vector<Tree>& y)
{
    Terms terms(model.base.coordinates.size());
    for (const AnchorEntry& entry : block.anchor)
        if (entry.section < y.size()) terms[entry.coordinate].push_back(product_of(entry.value, y[entry.section]));
    const std::size_t n = block.base.size();
    for (std::size_t a = 0; a < std::min(block.representation.size(), y.size()); ++a)
        for (std::size_t k = 0; k < n * n; ++k) {
            const Tree& entry = block.representation[a].entries[k];
            if (is_plain_zero(entry)) continue;
            const Tree x = name(model.base.coordinates[block.base[k % n]].name);
            const auto [negative, size] = sign_and_size(entry);
            const Tree term = product_of(product_of(size, x), y[a]);
            terms[block.base[k / n]].push_back(negative ? term : negate(term));
        }
    return sums_of(terms);
}

/// The inner fibre coordinates of a frame, w_b = y^a A_a^b.
std::vector<Tree> inner_fibre_values(const AlgebroidBlock& block, const std::vector<Tree>& y)
{
    Terms terms(block.of[0].fibre.size());
    for (const SectionEntry& entry : block.sections)
        terms[entry.inner].push_back(product_of(entry.value, y[entry.section]));
    std::vector<Tree> sums;
    for (const std::vector<Tree>& each : terms) sums.push_back(sum_of(each));
    return sums;
}

/// The names that rates are told by: those that stand for functions of y, or y alone.
enum class RateTerms { names, fibre };

/// rho^i_a y^a, one a coordinate of the model; null where it is zero or the block does not say it in so many words.
std::vector<Tree> rates_of(const Model& model, const AlgebroidBlock& block, const std::vector<Tree>& y, RateTerms in)
{
    std::vector<Tree> rates(model.base.coordinates.size());
    const bool by_names = in == RateTerms::names;
    switch (block.kind) {
    case AlgebroidKind::tangent: place_rates(rates, block.over, y); break;
    case AlgebroidKind::groupoid:
    case AlgebroidKind::atiyah: place_rates(rates, block.base, y); break;
    case AlgebroidKind::level_set:
    case AlgebroidKind::subbundle:
        if (!by_names) return anchored_rates(model, block, y);
        for (const std::size_t i : block.base) rates[i] = name("v_" + model.base.coordinates[i].name);
        break;
    case AlgebroidKind::nonholonomic: return rates_of(model, block.of[0], trees_of(block.of[0].fibre), in);
    case AlgebroidKind::frame:
        return rates_of(model, block.of[0], by_names ? trees_of(block.of[0].fibre) : inner_fibre_values(block, y), in);
    case AlgebroidKind::prolongation: {
        const std::size_t rank = block.of[0].fibre.size(), n = block.of[0].base.size();
        if (y.size() != 2 * rank) break;
        rates = rates_of(model, block.of[0], part_of(y, 0, rank), in);
        place_rates(rates, part_of(block.base, n, block.base.size() - n), part_of(y, rank, rank));
        break;
    }
    case AlgebroidKind::product: {
        std::size_t first = 0;
        for (const AlgebroidBlock& factor : block.of) {
            if (y.size() < first + factor.fibre.size()) break; // they have no names here
            const std::vector<Tree> more = rates_of(model, factor, part_of(y, first, factor.fibre.size()), in);
            for (std::size_t i = 0; i < rates.size(); ++i)
                if (more[i]) rates[i] = more[i];
            first += factor.fibre.size();
        }
        break;
    }
    case AlgebroidKind::general:
    case AlgebroidKind::action: return anchored_rates(model, block, y);
    default: break;
    }
    return rates;
}

/// The one name that the rates of a coordinate, or of a family in its order, are; empty where they are none.
std::string common_name(const std::vector<Tree>& rates, const Shape& shape)
{
    if (rates[0]->kind != TreeKind::name) return {};
    const std::string first = shape.rank == Rank::scalar ? rates[0]->name : family_name(rates[0]->name);
    for (std::size_t k = 0; k < rates.size(); ++k)
        if (rates[k]->kind != TreeKind::name || rates[k]->name != entry_name(first, shape, k)) return {};
    return first;
}

std::string momentum_of(const Model& model, const Tree& rate, const Shape& shape)
{
    const std::size_t a = index_of(model.fibre.coordinates, rate->name);
    if (a >= model.fibre.momenta.size()) return {};
    const std::string& momentum = model.fibre.momenta[a].name;
    return shape.rank == Rank::scalar ? momentum : family_name(momentum);
}

std::string meant(const std::string& name)
{
    return fmt::format("did you mean '{}'?", name);
}

std::string hint_of(const CoordinateRate& rate)
{
    return rate.is_name ? meant(rate.rate)
                        : fmt::format("by the anchor the rate of '{}' is {}", rate.coordinate, rate.rate);
}

/// The symbols, group by group, become definitions with these values.
void define_velocities(ModelReader& reader, const std::vector<Symbol>& symbols, const std::vector<Tree>& values)
{
    for (const SymbolGroup& group : group_symbols(symbols)) {
        const std::vector<Tree> entries = part_of(values, group.first, group.shape.size());
        const SourceRange& where = symbols[group.first].where;
        reader.names.declare(group.name, Role::velocity, where);
        reader.model.scope.define(Definition{group.name, {}, array_tree(group.shape, entries), where});
    }
}

/// v_x of the base coordinates; those that a level set keeps are coordinates of its fibre already.
void define_ambient(ModelReader& reader, const AlgebroidBlock& block, const std::vector<Tree>& y)
{
    const std::vector<Tree> rates = anchored_rates(reader.model, block, y);
    const std::vector<Symbol> all = velocities_of(coordinates_of(reader.model, block));
    std::vector<Symbol> symbols;
    std::vector<Tree> values;
    for (std::size_t k = 0; k < all.size(); ++k) {
        if (block.kind == AlgebroidKind::level_set && index_of(block.fibre, all[k].name) < block.fibre.size()) continue;
        symbols.push_back(all[k]);
        values.push_back(rates[block.base[k]] ? rates[block.base[k]] : number(0));
    }
    define_velocities(reader, symbols, values);
}

void define_below(ModelReader& reader, const AlgebroidDraft* draft, const AlgebroidBlock& block,
                  const std::vector<Tree>& y, bool named)
{
    if (draft != nullptr && !draft->kind) {
        IncludedModel& included = reader.included[draft->included]; // its names are not this model's
        const std::vector<Symbol>& own = included.model.fibre.coordinates;
        for (std::size_t a = 0; named && a < own.size(); ++a) included.velocities.insert_or_assign(own[a].name, y[a]);
        draft = nullptr;
    }
    const auto inner = [&](std::size_t k) {
        return draft != nullptr && k < draft->of.size() ? &draft->of[k] : nullptr;
    };
    switch (block.kind) {
    case AlgebroidKind::level_set:
    case AlgebroidKind::subbundle:
        if (named) define_ambient(reader, block, y);
        return;
    case AlgebroidKind::frame: {
        std::vector<Tree> w;
        if (named) {
            w = inner_fibre_values(block, y);
            define_velocities(reader, block.of[0].fibre, w);
        }
        return define_below(reader, inner(0), block.of[0], w, named);
    }
    case AlgebroidKind::nonholonomic:
    case AlgebroidKind::prolongation:
        return define_below(reader, inner(0), block.of[0], trees_of(block.of[0].fibre), named && !block.dual);
    case AlgebroidKind::product: {
        std::size_t first = 0;
        for (std::size_t k = 0; k < block.of.size(); ++k) {
            const std::size_t rank = named ? block.of[k].fibre.size() : 0;
            define_below(reader, inner(k), block.of[k], part_of(y, first, rank), named);
            first += rank;
        }
        return;
    }
    default: return;
    }
}

void append_velocity_names(std::vector<std::string>& names, const Model& model, const AlgebroidBlock& block)
{
    if (block.kind == AlgebroidKind::subbundle || block.kind == AlgebroidKind::level_set)
        for (const std::string& each : declared_names(velocities_of(coordinates_of(model, block))))
            names.push_back(each);
    for (const AlgebroidBlock& inner : block.of) {
        for (const std::string& each : declared_names(inner.fibre)) names.push_back(each);
        append_velocity_names(names, model, inner);
    }
}

} // namespace

Tree product_of(const Tree& value, const Tree& y)
{
    const bool negative = value->kind == TreeKind::negate && value->arguments[0]->kind == TreeKind::number;
    if (value->kind == TreeKind::number && value->number == 1) return y;
    if (negative && value->arguments[0]->number == 1) return negate(y);
    return multiply({value, y});
}

Tree sum_of(const std::vector<Tree>& terms)
{
    if (terms.empty()) return number(0);
    return terms.size() == 1 ? terms[0] : add(terms);
}

Tree array_tree(const Shape& shape, const std::vector<Tree>& entries)
{
    if (shape.rank == Rank::scalar) return entries.at(0);
    auto rows = std::make_shared<TreeNode>();
    rows->kind = TreeKind::array;
    rows->where = entries.empty() ? SourceRange{} : entries[0]->where;
    rows->arguments = entries;
    if (shape.rank == Rank::vector) return rows;
    rows->arguments.clear();
    for (std::size_t i = 0; i < shape.rows; ++i) {
        const std::vector<Tree> row = part_of(entries, i * shape.columns, shape.columns);
        rows->arguments.push_back(array_tree({Rank::vector, shape.columns, 1}, row));
    }
    return rows;
}

std::vector<std::string> velocity_names(const Model& model)
{
    std::vector<std::string> names;
    append_velocity_names(names, model, model.algebroid);
    return names;
}

void define_inner_velocities(ModelReader& reader)
{
    const AlgebroidBlock& block = reader.model.algebroid;
    define_below(reader, reader.draft.get(), block, trees_of(block.fibre), true);
}

std::vector<CoordinateRate> coordinate_rates(const Model& model)
{
    std::vector<CoordinateRate> out;
    const std::vector<Tree> all = rates_of(model, model.algebroid, trees_of(model.algebroid.fibre), RateTerms::names);
    for (const SymbolGroup& group : group_symbols(model.base.coordinates)) {
        const std::vector<Tree> rates = part_of(all, group.first, group.shape.size());
        if (std::ranges::find(rates, nullptr) != rates.end()) continue;
        CoordinateRate rate{group.name, common_name(rates, group.shape), true, {}};
        if (!rate.rate.empty()) {
            rate.momentum = momentum_of(model, rates[0], group.shape);
        } else if (group.shape.rank == Rank::scalar) {
            rate.rate = to_text(rates[0]);
            rate.is_name = false;
        }
        if (!rate.rate.empty() && rate.rate.size() <= longest_rate) out.push_back(std::move(rate));
    }
    return out;
}

void define_rates(ModelReader& reader)
{
    const Model& model = reader.model;
    const AlgebroidBlock& block = model.algebroid;
    if (reader.is_probe && !is_nonholonomic(model)) return; // it has no fibre
    if (block.kind == AlgebroidKind::groupoid && model.groupoid->kind == GroupoidKind::action) return;
    const auto define = [&](const Symbol& symbol, const Tree& rate) {
        reader.model.scope.define({rate_name(symbol.name), {}, rate, symbol.where});
    };
    define(Symbol{"t", {}, {}, {}, {}}, number(1));
    for (const Parameter& parameter : model.parameters) define(parameter.symbol, number(0));
    const std::vector<Tree> rates = rates_of(model, block, trees_of(block.fibre), RateTerms::fibre);
    for (std::size_t i = 0; i < rates.size(); ++i) define(model.base.coordinates[i], rates[i] ? rates[i] : number(0));
}

std::string hint_for_rate(const std::string& name, const std::vector<CoordinateRate>& rates)
{
    for (const CoordinateRate& each : rates)
        if (is_among(rate_spellings(each.coordinate), name)) return hint_of(each);
    return {};
}

std::string hint_for_momentum(const std::string& name, const std::vector<CoordinateRate>& rates)
{
    for (const CoordinateRate& each : rates) {
        if (each.momentum.empty()) continue;
        if (is_among(momentum_spellings(each.coordinate), name)) return meant(each.momentum);
        if (is_among(rate_spellings(each.coordinate), name))
            return fmt::format("momenta stand here: that of '{}' is '{}'", each.rate, each.momentum);
    }
    return {};
}

void explain_rates(Scope& scope, const std::vector<CoordinateRate>& rates)
{
    for (const CoordinateRate& each : rates) {
        for (const std::string& spelling : rate_spellings(each.coordinate)) scope.explain(spelling, hint_of(each));
        for (const std::string& spelling : momentum_spellings(each.coordinate))
            if (!each.momentum.empty()) scope.explain(spelling, meant(each.momentum));
    }
}

} // namespace lagen
