// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/rate_names.hpp"

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

/// rho^i_a y^a by the anchor's entries, and by a representation -(A_a x)^i y^a.
std::vector<Tree> anchored_rates(const Model& model, const AlgebroidBlock& block, const std::vector<Tree>& y)
{
    std::vector<std::vector<Tree>> terms(model.base.coordinates.size());
    for (const AnchorEntry& entry : block.anchor)
        if (entry.section < y.size()) terms[entry.coordinate].push_back(product_of(entry.value, y[entry.section]));
    const std::size_t n = block.base.size();
    for (std::size_t a = 0; a < std::min(block.representation.size(), y.size()); ++a)
        for (std::size_t k = 0; k < n * n; ++k) {
            const Tree& entry = block.representation[a].entries[k];
            if (entry->kind == TreeKind::number && entry->number == 0) continue;
            const Tree x = name(model.base.coordinates[block.base[k % n]].name);
            const auto [negative, size] = sign_and_size(entry);
            const Tree term = product_of(product_of(size, x), y[a]);
            terms[block.base[k / n]].push_back(negative ? term : negate(term));
        }
    std::vector<Tree> rates(terms.size());
    for (std::size_t i = 0; i < rates.size(); ++i)
        if (!terms[i].empty()) rates[i] = terms[i].size() == 1 ? terms[i][0] : add(terms[i]);
    return rates;
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
        const auto rank = static_cast<std::ptrdiff_t>(block.of[0].fibre.size());
        if (static_cast<std::ptrdiff_t>(y.size()) != 2 * rank) break;
        rates = rates_of(model, block.of[0], {y.begin(), y.begin() + rank}, in);
        const auto bundle = block.base.begin() + static_cast<std::ptrdiff_t>(block.of[0].base.size());
        place_rates(rates, {bundle, block.base.end()}, {y.begin() + rank, y.end()});
        break;
    }
    case AlgebroidKind::product: {
        auto first = y.begin();
        for (const AlgebroidBlock& factor : block.of) {
            if (static_cast<std::size_t>(y.end() - first) < factor.fibre.size()) break; // they have no names here
            const auto next = first + static_cast<std::ptrdiff_t>(factor.fibre.size());
            const std::vector<Tree> more = rates_of(model, factor, {first, next}, in);
            for (std::size_t i = 0; i < rates.size(); ++i)
                if (more[i]) rates[i] = more[i];
            first = next;
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

std::string hint_of(const CoordinateRate& rate)
{
    return rate.is_name ? fmt::format("did you mean '{}'?", rate.rate)
                        : fmt::format("by the anchor the rate of '{}' is {}", rate.coordinate, rate.rate);
}

} // namespace

std::vector<CoordinateRate> coordinate_rates(const Model& model)
{
    std::vector<CoordinateRate> out;
    const std::vector<Tree> all = rates_of(model, model.algebroid, trees_of(model.algebroid.fibre), RateTerms::names);
    for (const SymbolGroup& group : group_symbols(model.base.coordinates)) {
        const auto first = all.begin() + static_cast<std::ptrdiff_t>(group.first);
        const std::vector<Tree> rates(first, first + static_cast<std::ptrdiff_t>(group.shape.size()));
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
        if (is_among(momentum_spellings(each.coordinate), name))
            return fmt::format("did you mean '{}'?", each.momentum);
        if (is_among(rate_spellings(each.coordinate), name))
            return fmt::format("momenta stand here: that of '{}' is '{}'", each.rate, each.momentum);
    }
    return {};
}

void explain_rates(Scope& scope, const std::vector<CoordinateRate>& rates)
{
    for (const CoordinateRate& each : rates) {
        for (const std::string& spelling : rate_spellings(each.coordinate)) scope.explain(spelling, hint_of(each));
        if (each.momentum.empty()) continue;
        for (const std::string& spelling : momentum_spellings(each.coordinate))
            scope.explain(spelling, fmt::format("did you mean '{}'?", each.momentum));
    }
}

} // namespace lagen
