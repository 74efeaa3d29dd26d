// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/rate_names.hpp"

#include "model/algebroid_draft.hpp"
#include "model/families.hpp"

#include <algorithm>
#include <array>
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

std::vector<Tree> trees_of(const std::vector<Symbol>& symbols)
{
    std::vector<Tree> out;
    for (const Symbol& symbol : symbols) out.push_back(name(symbol.name, symbol.where));
    return out;
}

/// The y of the block that is the rate of its k-th coordinate; null where there is none.
Tree component(const std::vector<Tree>& y, std::size_t k)
{
    return k < y.size() ? y[k] : nullptr;
}

/// rho^i_a y^a for coordinate i of the model; null where the block does not say it in so many words.
Tree rate_of(const Model& model, const AlgebroidBlock& block, const std::vector<Tree>& y, std::size_t i)
{
    const auto place = [i](const std::vector<std::size_t>& list) {
        return static_cast<std::size_t>(std::ranges::find(list, i) - list.begin());
    };
    switch (block.kind) {
    case AlgebroidKind::tangent: return component(y, place(block.over));
    case AlgebroidKind::atiyah:
        return place(block.base) < block.base.size() ? component(y, place(block.base)) : nullptr;
    case AlgebroidKind::subbundle:
        return place(block.base) < block.base.size() ? name("v_" + model.base.coordinates[i].name) : nullptr;
    case AlgebroidKind::frame: return rate_of(model, block.of[0], trees_of(block.of[0].fibre), i);
    case AlgebroidKind::product: {
        auto first = y.begin();
        for (const AlgebroidBlock& factor : block.of) {
            if (static_cast<std::size_t>(y.end() - first) < factor.fibre.size()) return nullptr; // has no names here
            const auto next = first + static_cast<std::ptrdiff_t>(factor.fibre.size());
            if (Tree rate = rate_of(model, factor, {first, next}, i)) return rate;
            first = next;
        }
        return nullptr;
    }
    case AlgebroidKind::general:
    case AlgebroidKind::action: {
        std::vector<Tree> terms;
        for (const AnchorEntry& entry : block.anchor)
            if (entry.coordinate == i && entry.section < y.size())
                terms.push_back(product_of(entry.value, y[entry.section]));
        return terms.empty() ? nullptr : terms.size() == 1 ? terms[0] : add(terms);
    }
    default: return nullptr;
    }
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

} // namespace

std::vector<CoordinateRate> coordinate_rates(const Model& model)
{
    std::vector<CoordinateRate> out;
    for (const SymbolGroup& group : group_symbols(model.base.coordinates)) {
        std::vector<Tree> rates;
        for (std::size_t k = 0; k < group.shape.size(); ++k)
            rates.push_back(rate_of(model, model.algebroid, trees_of(model.algebroid.fibre), group.first + k));
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

std::string hint_for_rate(const std::string& name, const std::vector<CoordinateRate>& rates)
{
    for (const CoordinateRate& each : rates)
        if (is_among(rate_spellings(each.coordinate), name))
            return each.is_name ? fmt::format("did you mean '{}'?", each.rate)
                                : fmt::format("by the anchor the rate of '{}' is {}", each.coordinate, each.rate);
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
        for (const std::string& spelling : rate_spellings(each.coordinate))
            scope.explain(spelling, hint_for_rate(spelling, rates));
        if (each.momentum.empty()) continue;
        for (const std::string& spelling : momentum_spellings(each.coordinate))
            scope.explain(spelling, hint_for_momentum(spelling, rates));
    }
}

} // namespace lagen
