// SPDX-License-Identifier: GPL-2.0-or-later
/// The sequence of points and the test of regularity.
#include "proof/sample.hpp"

#include "graph/core/operators.hpp"

#include <algorithm>
#include <array>

namespace lagen::proof {

namespace {

/// A fixed mixing function (splitmix64): the same numbers on every machine.
std::uint64_t mix(std::uint64_t x)
{
    x += 0x9e3779b97f4a7c15ULL;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
    return x ^ (x >> 31);
}

Rational rational(const arf_t value)
{
    fmpq_t fraction;
    fmpq_init(fraction);
    arf_get_fmpq(fraction, value);
    Rational result;
    fmpq_get_mpq(result.get_mpq_t(), fraction);
    fmpq_clear(fraction);
    return result;
}

/// A number that is known by an enclosure alone.
PointValue irrational(const Ball& ball)
{
    constexpr slong digits = 20, precision = 128;
    if (!ball.is_finite()) throw InternalError("a coordinate of a regular point has no value");
    char* text = arb_get_str(ball.get(), digits, ARB_STR_NO_RADIUS);
    std::string decimal = text;
    flint_free(text);
    arf_t end;
    arf_init(end);
    arb_get_lbound_arf(end, ball.get(), precision);
    Rational lower = rational(end);
    arb_get_ubound_arf(end, ball.get(), precision);
    Rational upper = rational(end);
    arf_clear(end);
    return {std::move(decimal), std::move(lower), std::move(upper)};
}

Rational ratio(long above, long below)
{
    Rational q(above, below);
    q.canonicalize();
    return q;
}

Rational small_number(std::uint64_t random)
{
    static constexpr std::array<std::pair<int, int>, 16> table{{{1, 1},
                                                                {2, 1},
                                                                {0, 1},
                                                                {-1, 1},
                                                                {1, 2},
                                                                {3, 1},
                                                                {-2, 1},
                                                                {3, 2},
                                                                {1, 3},
                                                                {-1, 2},
                                                                {2, 3},
                                                                {4, 1},
                                                                {5, 2},
                                                                {-3, 1},
                                                                {3, 4},
                                                                {5, 1}}};
    const auto& [above, below] = table[random % table.size()];
    return ratio(above, below);
}

/// Coordinates of rational points on spheres: 3-4-5, 1-2-2-3, 2-3-6-7, 5-12-13.
Rational spherical_number(std::uint64_t random)
{
    static constexpr std::array<std::pair<int, int>, 20> table{
        {{0, 1}, {3, 5}, {4, 5}, {0, 1},  {-3, 5}, {-4, 5}, {1, 3},  {2, 3},   {-1, 3}, {-2, 3},
         {2, 7}, {3, 7}, {6, 7}, {-2, 7}, {-3, 7}, {-6, 7}, {5, 13}, {12, 13}, {1, 2},  {1, 1}}};
    const auto& [above, below] = table[random % table.size()];
    return ratio(above, below);
}

/// A value that respects the bounds: kept where it does, mirrored or squeezed into them where not.
Rational into_bounds(Rational value, const std::optional<Rational>& low, const std::optional<Rational>& high)
{
    if ((!low || value > *low) && (!high || value < *high)) return value;
    const Rational size = sgn(value) == 0 ? Rational(1) : Rational(abs(value));
    if (low && high) return *low + (*high - *low) * size / (1 + size);
    return low ? Rational(*low + size) : Rational(*high - size);
}

} // namespace

Sampler::Sampler(const Graph& graph, const ProofSetting& setting, const std::vector<SolvedConstraint>& constraints,
                 const ProofBudget& budget)
    : graph_(graph), setting_(setting), constraints_(constraints), budget_(budget),
      conditions_(graph,
                  [&setting] {
                      std::vector<NodeId> all = setting.domain;
                      all.insert(all.end(), setting.defined.begin(), setting.defined.end());
                      return all;
                  }()),
      parts_(graph, [&] {
          std::vector<NodeId> all = setting.domain;
          for (const NonnegativeOperand& operand : nonnegative_operands(graph, setting.defined))
              all.push_back(operand.node);
          signed_parts_ = all.size();
          all.insert(all.end(), setting.defined.begin(), setting.defined.end());
          for (const NodeId part : all) part_inputs_.push_back(Evaluation(graph, {part}).inputs());
          return all;
      }())
{
    for (const SolvedConstraint& solved : constraints) {
        equations_.emplace_back(graph, std::vector<NodeId>{setting.constraints[solved.constraint]});
        for (const NodeId input : equations_.back().inputs()) constrained_[input] = true;
    }
    std::vector<NodeId> all = setting.variables;
    all.insert(all.end(), setting.parameters.begin(), setting.parameters.end());
    // Inputs that the setting does not name are sampled like the others.
    all.insert(all.end(), conditions_.inputs().begin(), conditions_.inputs().end());
    for (const Evaluation& equation : equations_)
        all.insert(all.end(), equation.inputs().begin(), equation.inputs().end());
    for (const NodeId input : all) {
        bool free = places_.count(input) == 0;
        places_.emplace(input, places_.size());
        for (const SolvedConstraint& solved : constraints) free = free && solved.variable != input;
        if (free) free_.push_back(input);
    }
    for (const NodeId input : free_) {
        const bool condition =
            std::find(parts_.inputs().begin(), parts_.inputs().end(), input) != parts_.inputs().end();
        if (condition || constrained_.count(input) > 0) movable_.push_back(input);
    }
    read_bounds();
}

void Sampler::read_bounds()
{
    for (const NodeId node : setting_.domain) {
        const auto operands = graph_.operands(node);
        const auto [below, equal, above] = operator_of(graph_.op(node)).holds;
        if (below == above) continue; // no bound
        if (graph_.op(operands[0]) == Op::input && graph_.is_constant(operands[1])) {
            Bounds& bounds = bounds_[operands[0]];
            (below ? bounds.high : bounds.low) = graph_.value(operands[1]);
        } else if (graph_.op(operands[1]) == Op::input && graph_.is_constant(operands[0])) {
            Bounds& bounds = bounds_[operands[1]];
            (below ? bounds.low : bounds.high) = graph_.value(operands[0]);
        }
    }
}

Rational Sampler::draw(std::size_t number, NodeId input, bool constrained) const
{
    const auto known = places_.find(input);
    const std::size_t place = known != places_.end() ? known->second : 1000 + input;
    const std::uint64_t random = mix(mix(number * 7919 + 17) ^ (place * 104729 + 5));
    const std::uint64_t more = mix(random);
    Rational value;
    if (constrained) {
        value = spherical_number(random);
    } else if (number == 0) {
        value = ratio(static_cast<long>(place % 7 + 1), static_cast<long>(place / 7 + 1));
    } else if (number < 12 || number % 4 == 0) {
        value = small_number(random);
    } else if (number % 4 == 1) {
        value = ratio(static_cast<long>(random % 25) - 12, static_cast<long>(more % 9) + 1);
    } else if (number % 4 == 2) {
        const long below = static_cast<long>(more % 34) + 7;
        value = ratio(static_cast<long>(random % static_cast<std::uint64_t>(2 * below - 1)) - below + 1, below);
    } else {
        value = ratio(static_cast<long>(random % 10001) - 5000, 1000);
    }
    // Coordinates of several units beside parameters of many: cos(x) < 0 on x^2 + y^2 = a needs a > 2.
    const bool large = !constrained && number >= 12 && number % 8 == 7;
    if (large && std::find(setting_.parameters.begin(), setting_.parameters.end(), input) != setting_.parameters.end())
        value *= 16;
    const auto bounds = bounds_.find(input);
    return bounds == bounds_.end() ? value : into_bounds(value, bounds->second.low, bounds->second.high);
}

std::optional<SamplePoint> Sampler::attempt(std::size_t number, bool exact_only) const
{
    SamplePoint point;
    point.number = number + 1'000'003 * budget_.seed;
    for (const NodeId input : free_)
        point.exact[input] = draw(point.number, input, exact_only && constrained_.count(input) > 0);
    for (std::size_t k = 0; k < constraints_.size(); ++k)
        point.upper.push_back(point.number == 0 || mix(point.number * 31 + k) % 2 == 0);
    solve_constraints(point);
    if (exact_only && point.exact.size() < free_.size() + constraints_.size()) return std::nullopt;
    return point;
}

/// Adds the coordinates that constraints determine, where they are rational.
void Sampler::solve_constraints(SamplePoint& point) const
{
    for (std::size_t k = 0; k < constraints_.size(); ++k)
        if (const auto value = solve_exactly(k, point.exact, point.upper[k]))
            point.exact[constraints_[k].variable] = *value;
}

bool Sampler::is_regular(const SamplePoint& point) const
{
    const slong precision = budget_.precision;
    const BallInputs inputs = enclosures(point, conditions_.inputs(), precision);
    for (const auto& [input, ball] : inputs)
        if (!ball.is_finite()) return false;
    const std::vector<Ball> values = conditions_.enclose(inputs, precision);
    for (std::size_t k = 0; k < values.size(); ++k) {
        if (!values[k].is_finite()) return false;
        if (k < setting_.domain.size() && !values[k].excludes_zero()) return false;
    }
    return true;
}

const SamplePoint* Sampler::regular(std::size_t k)
{
    // With constraints, a first round keeps rational points only, a second one takes what comes.
    const std::size_t rounds = constraints_.empty() ? 1 : 2;
    while (found_.size() <= k && next_ < rounds * budget_.tries) {
        const std::size_t number = next_++;
        const std::optional<SamplePoint> point = attempt(number, rounds == 2 && number < budget_.tries);
        if (point && is_regular(*point)) found_.push_back(*point);
    }
    // What chance misses is searched for: few points, and only where there are few.
    while (found_.size() <= k && found_.size() < std::max<std::size_t>(budget_.points, 1) &&
           searched_ < budget_.searches && !movable_.empty()) {
        const std::optional<SamplePoint> point = repaired(searched_++);
        if (point && is_regular(*point)) found_.push_back(*point);
    }
    return k < found_.size() ? &found_[k] : nullptr;
}

ExactInputs Sampler::exact_values(const SamplePoint& point, const std::vector<NodeId>& more) const
{
    ExactInputs values;
    if (!constraints_.empty()) values = point.exact; // coordinates that are solved for need others
    for (const NodeId input : more) {
        if (places_.count(input) == 0)
            values[input] = draw(point.number, input, false);
        else if (const auto at = point.exact.find(input); at != point.exact.end())
            values.insert(*at);
    }
    return values;
}

NamedPoint Sampler::values(const SamplePoint& point, const std::vector<NodeId>& more) const
{
    std::vector<NodeId> order = setting_.variables;
    order.insert(order.end(), setting_.parameters.begin(), setting_.parameters.end());
    for (const NodeId input : more)
        if (places_.count(input) == 0) order.push_back(input);
    const ExactInputs exact = exact_values(point, order);
    const BallInputs balls = enclosures(point, order, budget_.precision);
    NamedPoint result;
    for (const NodeId input : order) {
        const auto at = exact.find(input);
        result.emplace_back(graph_.input_name(input),
                            at != exact.end() ? PointValue(at->second) : irrational(balls.at(input)));
    }
    return result;
}

} // namespace lagen::proof
