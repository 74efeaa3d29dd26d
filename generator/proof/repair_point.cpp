// SPDX-License-Identifier: GPL-2.0-or-later
/// The search for points that random tries miss: x > 1000, 0 < x < 1e-6, 1 < x^2 + y^2 < 1.0001, chains x < y < z. One
/// input after another runs over a ladder of magnitudes, and the gap between two rungs that satisfy different
/// conditions is bisected.
#include "proof/sample.hpp"

#include <algorithm>

namespace lagen::proof {

namespace {

constexpr int decades = 9;                ///< the ladder reaches from 1e-9 to 1e9 on both sides of 0
constexpr int most_halvings = 48;         ///< of one gap
constexpr std::size_t most_gaps = 8;      ///< bisected for one input
constexpr slong search_precision = 128;   ///< bits: conditions are looked at, not certified
constexpr std::size_t most_rounds = 4;    ///< over all inputs
constexpr std::size_t most_values = 4000; ///< evaluations of all conditions in one search

using Met = std::vector<bool>; ///< which conditions hold

std::size_t count(const Met& met)
{
    return static_cast<std::size_t>(std::count(met.begin(), met.end(), true));
}

std::size_t count_either(const Met& a, const Met& b)
{
    std::size_t sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] || b[k] ? 1 : 0;
    return sum;
}

/// 0, and 1, 2, 5 times powers of ten with both signs, ascending; among them `centre` and an even grid around it.
std::vector<Rational> ladder(const Rational& centre)
{
    std::vector<Rational> rungs{0, centre};
    Rational size = 1;
    for (int k = 0; k < decades; ++k) size /= 10;
    for (int k = -decades; k <= decades; ++k, size *= 10)
        for (const int digit : {1, 2, 5}) {
            rungs.emplace_back(size * digit);
            rungs.emplace_back(-size * digit);
        }
    for (int k = 1; k <= 24; ++k)
        for (const int sign : {-1, 1}) {
            Rational step(27 * k * sign, 100);
            step.canonicalize();
            rungs.emplace_back(centre + step);
        }
    std::sort(rungs.begin(), rungs.end());
    rungs.erase(std::unique(rungs.begin(), rungs.end()), rungs.end());
    return rungs;
}

/// One search: moves inputs as long as that makes more conditions hold.
class Search {
  public:
    Search(const std::function<Met(const ExactInputs&)>& look, ExactInputs values)
        : look_(look), values_(std::move(values)), met_(look(values_))
    {
    }

    [[nodiscard]] bool settled() const { return count(met_) == met_.size(); }
    [[nodiscard]] bool exhausted() const { return looked_ > most_values; }
    [[nodiscard]] const ExactInputs& values() const { return values_; }

    void move(NodeId input)
    {
        struct Rung {
            Rational value;
            Met met;
        };
        std::vector<Rung> rungs;
        for (const Rational& value : ladder(values_.at(input))) {
            rungs.push_back({value, try_value(input, value)});
            if (settled() || exhausted()) return;
        }
        // As many conditions as before, but others: from there the next sweep goes on.
        const Rung* other = nullptr;
        for (const Rung& rung : rungs)
            if (count(rung.met) == count(met_) && rung.met != met_ &&
                (other == nullptr || abs(rung.value) < abs(other->value)))
                other = &rung;
        std::size_t gaps = 0;
        for (std::size_t k = 0; k + 1 < rungs.size() && gaps < most_gaps; ++k) {
            if (count_either(rungs[k].met, rungs[k + 1].met) <= count(met_)) continue;
            ++gaps;
            bisect(input, rungs[k].value, rungs[k].met, rungs[k + 1].value);
            if (settled() || exhausted()) return;
        }
        if (other == nullptr || count(other->met) < count(met_)) return;
        values_[input] = other->value;
        met_ = other->met;
    }

  private:
    Met try_value(NodeId input, const Rational& value)
    {
        ++looked_;
        ExactInputs changed = values_;
        changed[input] = value;
        Met met = look_(changed);
        if (count(met) > count(met_)) {
            met_ = met;
            values_ = std::move(changed);
        }
        return met;
    }

    void bisect(NodeId input, Rational low, const Met& low_met, Rational high)
    {
        for (int k = 0; k < most_halvings && !settled() && !exhausted(); ++k) {
            const Rational middle = (low + high) / 2;
            const std::size_t before = count(met_);
            const Met met = try_value(input, middle);
            if (count(met_) > before) return;
            (met == low_met ? low : high) = middle;
        }
    }

    const std::function<Met(const ExactInputs&)>& look_;
    ExactInputs values_;
    Met met_;
    std::size_t looked_ = 0;
};

} // namespace

std::vector<bool> Sampler::conditions_met(const SamplePoint& point) const
{
    SamplePoint solved = point;
    solve_constraints(solved);
    const BallInputs inputs = enclosures(solved, parts_.inputs(), search_precision);
    Met met;
    for (const SolvedConstraint& constraint : constraints_) met.push_back(inputs.at(constraint.variable).is_finite());
    const std::vector<Ball> values = parts_.enclose(inputs, search_precision);
    for (std::size_t k = 0; k < values.size(); ++k) {
        const bool holds = k < setting_.domain.size() ? values[k].excludes_zero()
                           : k < signed_parts_        ? values[k].is_positive()
                                                      : values[k].is_finite();
        met.push_back(holds);
    }
    return met;
}

bool Sampler::concerns_only(std::size_t part, const std::set<NodeId>& inputs) const
{
    const auto& needed = part_inputs_[part];
    return std::all_of(needed.begin(), needed.end(), [&](NodeId input) { return inputs.count(input) > 0; });
}

std::optional<SamplePoint> Sampler::repaired(std::size_t number) const
{
    std::optional<SamplePoint> start = attempt(number, false);
    if (!start) return std::nullopt;
    for (const SolvedConstraint& solved : constraints_) start->exact.erase(solved.variable);
    std::vector<NodeId> order = movable_;
    if (number % 2 != 0) std::reverse(order.begin(), order.end());
    // First one input after another, so that each answers to those before it only: chains x < y < z.
    std::set<NodeId> placed;
    const std::function<Met(const ExactInputs&)> look = [&](const ExactInputs& values) {
        SamplePoint point = *start;
        point.exact = values;
        Met met = conditions_met(point);
        for (std::size_t k = 0; k < met.size() && placed.size() < order.size(); ++k)
            if (k >= constraints_.size() && !concerns_only(k - constraints_.size(), placed)) met[k] = true;
        return met;
    };
    for (const NodeId input : constraints_.empty() ? order : std::vector<NodeId>()) {
        placed.insert(input);
        Search search(look, start->exact);
        if (!search.settled()) search.move(input);
        start->exact = search.values();
    }
    placed.insert(order.begin(), order.end());
    Search search(look, start->exact);
    for (std::size_t round = 0; round < most_rounds && !search.settled() && !search.exhausted(); ++round)
        for (const NodeId input : order) {
            if (search.settled() || search.exhausted()) break;
            search.move(input);
        }
    if (!search.settled()) return std::nullopt;
    start->exact = search.values();
    solve_constraints(*start);
    return start;
}

} // namespace lagen::proof
