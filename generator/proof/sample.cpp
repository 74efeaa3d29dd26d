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

// Points on the constraint set: each constraint h(v) = a v^k + b v + c is solved for its coordinate, from its values
// at v = 0, 1 and -1; exactly where the root is rational, else in ball arithmetic.

namespace {

bool rational_root(const Rational& radicand, unsigned degree, Rational& root)
{
    if (sgn(radicand) < 0 && degree % 2 == 0) return false;
    mpz_class above, below;
    const bool exact = mpz_root(above.get_mpz_t(), radicand.get_num_mpz_t(), degree) != 0 &&
                       mpz_root(below.get_mpz_t(), radicand.get_den_mpz_t(), degree) != 0;
    root = exact ? Rational(above, below) : Rational(0);
    return exact;
}

/// x^(1/degree), of either sign for odd degrees.
void real_root(arb_ptr z, arb_srcptr x, unsigned degree, slong precision)
{
    if (degree % 2 == 1 && arb_is_negative(x) != 0) {
        arb_neg(z, x);
        arb_root_ui(z, z, degree, precision);
        arb_neg(z, z);
    } else {
        arb_root_ui(z, x, degree, precision);
    }
}

} // namespace

std::optional<Rational> Sampler::solve_exactly(std::size_t k, const ExactInputs& inputs, bool upper) const
{
    const SolvedConstraint& solved = constraints_[k];
    ExactInputs all = inputs;
    Rational values[3]; // of h at 0, 1, -1
    const int places[3] = {0, 1, -1};
    for (int j = 0; j < 3; ++j) {
        all[solved.variable] = places[j];
        const auto value = equations_[k].exactly(all);
        if (!value) return std::nullopt;
        values[j] = (*value)[0];
    }
    Rational root;
    if (solved.pure) {
        const Rational leading = values[1] - values[0];
        if (sgn(leading) == 0 || !rational_root(-values[0] / leading, solved.degree, root)) return std::nullopt;
        return solved.degree % 2 == 0 && !upper ? Rational(-root) : root;
    }
    const Rational a = (values[1] + values[2]) / 2 - values[0], b = (values[1] - values[2]) / 2;
    if (sgn(a) == 0 || !rational_root(b * b - 4 * a * values[0], 2, root)) return std::nullopt;
    if (!upper) root = -root;
    return Rational((root - b) / (2 * a));
}

Ball Sampler::enclose_root(std::size_t k, BallInputs& inputs, bool upper, slong precision) const
{
    const SolvedConstraint& solved = constraints_[k];
    std::vector<Ball> values; // of h at 0, 1, -1
    for (const int place : {0, 1, -1}) {
        inputs[solved.variable] = Ball(Rational(place), precision);
        values.push_back(equations_[k].enclose(inputs, precision)[0]);
    }
    Ball a, b, root;
    if (solved.pure) {
        arb_sub(a.get(), values[1].get(), values[0].get(), precision);
        arb_div(a.get(), values[0].get(), a.get(), precision);
        arb_neg(a.get(), a.get());
        real_root(root.get(), a.get(), solved.degree, precision);
        if (solved.degree % 2 == 0 && !upper) arb_neg(root.get(), root.get());
        return root;
    }
    arb_add(a.get(), values[1].get(), values[2].get(), precision);
    arb_mul_2exp_si(a.get(), a.get(), -1);
    arb_sub(a.get(), a.get(), values[0].get(), precision);
    arb_sub(b.get(), values[1].get(), values[2].get(), precision);
    arb_mul_2exp_si(b.get(), b.get(), -1);
    Ball discriminant, product;
    arb_mul(discriminant.get(), b.get(), b.get(), precision);
    arb_mul(product.get(), a.get(), values[0].get(), precision);
    arb_mul_2exp_si(product.get(), product.get(), 2);
    arb_sub(discriminant.get(), discriminant.get(), product.get(), precision);
    arb_sqrt(root.get(), discriminant.get(), precision);
    if (!upper) arb_neg(root.get(), root.get());
    arb_sub(root.get(), root.get(), b.get(), precision);
    arb_mul_2exp_si(a.get(), a.get(), 1);
    arb_div(root.get(), root.get(), a.get(), precision);
    return root;
}

BallInputs Sampler::enclosures(const SamplePoint& point, const std::vector<NodeId>& more, slong precision) const
{
    BallInputs inputs;
    for (const auto& [input, value] : exact_values(point, more)) inputs[input] = Ball(value, precision);
    for (std::size_t k = 0; k < constraints_.size(); ++k) {
        const NodeId variable = constraints_[k].variable;
        if (point.exact.count(variable) > 0) continue;
        const Ball root = enclose_root(k, inputs, point.upper[k], precision);
        inputs[variable] = root;
    }
    return inputs;
}

// The search for points that random tries miss: x > 1000, 0 < x < 1e-6, 1 < x^2 + y^2 < 1.0001, chains x < y < z. One
// input after another runs over a ladder of magnitudes, and the gap between two rungs that satisfy different
// conditions is bisected.

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
