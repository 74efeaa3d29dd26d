// SPDX-License-Identifier: GPL-2.0-or-later
/// Structure equations in numbers: (S0), (S1), (S2) of the definition, and rho_a(h) = 0.
#include "oracle.hpp"

namespace lagen::laws {
namespace {

/// rho, C and their slopes at one point.
class Values {
  public:
    Values(const LocalAlgebroid& algebroid, const Point& point)
        : algebroid_(algebroid), evaluate_(point, algebroid.base)
    {
    }

    [[nodiscard]] bool are_defined()
    {
        for (const std::vector<Formula>* list :
             {&algebroid_.rho, &algebroid_.C, &algebroid_.constraints, &algebroid_.positive})
            for (const Formula& entry : *list) {
                const Jet& jet = evaluate_(entry);
                if (!jet.value.is_finite()) return false;
                for (const Ball& slope : jet.slope)
                    if (!slope.is_finite()) return false;
            }
        for (const SecondOrder& second : algebroid_.second_orders)
            for (const Formula& entry : second.entries)
                if (!evaluate_(entry).value.is_finite()) return false;
        return true;
    }

    const Ball& value(const Formula& f) { return evaluate_(f).value; }
    Ball along(std::size_t a, const Formula& f)
    {
        Ball sum;
        if (f.node().kind == FormulaKind::number) return sum;
        const std::vector<Ball> slope = evaluate_(f).slope;
        for (std::size_t i = 0; i < algebroid_.n(); ++i)
            if (!algebroid_.anchor(i, a).is_zero()) sum = sum + value(algebroid_.anchor(i, a)) * slope[i];
        return sum;
    }

  private:
    const LocalAlgebroid& algebroid_;
    JetEvaluation evaluate_;
};

void append_anchor(std::vector<PointResidual>& list, const LocalAlgebroid& E, Values& at)
{
    for (std::size_t a = 0; a < E.r(); ++a)
        for (std::size_t b = a + 1; b < E.r(); ++b)
            for (std::size_t i = 0; i < E.n(); ++i) {
                Ball sum = at.along(a, E.anchor(i, b)) - at.along(b, E.anchor(i, a));
                for (std::size_t c = 0; c < E.r(); ++c)
                    if (!E.anchor(i, c).is_zero() && !E.bracket(c, a, b).is_zero())
                        sum = sum - at.value(E.anchor(i, c)) * at.value(E.bracket(c, a, b));
                list.push_back({"anchor", {E.fibre[a], E.fibre[b], E.base[i]}, sum});
            }
}

Ball jacobi(const LocalAlgebroid& E, Values& at, const std::size_t (&cycle)[3], std::size_t v)
{
    Ball sum;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t a = cycle[k], b = cycle[(k + 1) % 3], c = cycle[(k + 2) % 3];
        sum = sum + at.along(a, E.bracket(v, b, c));
        for (std::size_t m = 0; m < E.r(); ++m)
            if (!E.bracket(m, b, c).is_zero() && !E.bracket(v, a, m).is_zero())
                sum = sum + at.value(E.bracket(m, b, c)) * at.value(E.bracket(v, a, m));
    }
    return sum;
}

void append_jacobi(std::vector<PointResidual>& list, const LocalAlgebroid& E, Values& at)
{
    for (std::size_t a = 0; a < E.r(); ++a)
        for (std::size_t b = a + 1; b < E.r(); ++b)
            for (std::size_t c = b + 1; c < E.r(); ++c)
                for (std::size_t v = 0; v < E.r(); ++v)
                    list.push_back(
                        {"jacobi", {E.fibre[a], E.fibre[b], E.fibre[c], E.fibre[v]}, jacobi(E, at, {a, b, c}, v)});
}

void append_others(std::vector<PointResidual>& list, const LocalAlgebroid& E, Values& at)
{
    for (const SecondOrder& second : E.second_orders)
        for (std::size_t c = 0; c < E.r(); ++c)
            list.push_back({"antisymmetry",
                            {E.fibre[second.a], E.fibre[second.b], E.fibre[c]},
                            at.value(E.bracket(c, second.a, second.b)) + at.value(second.entries[c])});
    for (const Formula& h : E.constraints)
        for (std::size_t a = 0; a < E.r(); ++a) list.push_back({"tangency", {E.fibre[a], h.text()}, at.along(a, h)});
}

} // namespace

std::optional<std::vector<PointResidual>> residuals_at(const LocalAlgebroid& algebroid, const Point& point)
{
    Values at(algebroid, point);
    if (!at.are_defined()) return std::nullopt;
    std::vector<PointResidual> list;
    append_others(list, algebroid, at);
    append_anchor(list, algebroid, at);
    append_jacobi(list, algebroid, at);
    return list;
}

std::optional<Point> random_point(const LocalAlgebroid& algebroid, Dice& dice)
{
    for (int attempt = 0; attempt < 200; ++attempt) {
        Point point;
        for (const std::string& name : algebroid.base) point[name] = Ball(dice.rational());
        for (const std::string& name : algebroid.parameters) point[name] = Ball(dice.rational());
        // In order: the value of a later one may use an earlier one.
        for (const SolvedCoordinate& solved : algebroid.solved) {
            JetEvaluation evaluate(point, {});
            Ball value = evaluate(solved.value).value;
            if (solved.either_sign && dice.flip()) value = Ball() - value;
            point[solved.coordinate] = value;
        }
        JetEvaluation evaluate(point, {});
        bool good = true;
        for (const auto& [name, value] : point) good = good && value.is_finite();
        for (const Formula& g : algebroid.positive) good = good && evaluate(g).value.is_positive();
        if (good) return point;
    }
    return std::nullopt;
}

Truth truth_of(const LocalAlgebroid& algebroid, Dice& dice, std::size_t points)
{
    std::size_t seen = 0;
    bool small = true;
    for (std::size_t attempt = 0; attempt < 12 * points && seen < points; ++attempt) {
        const std::optional<Point> point = random_point(algebroid, dice);
        if (!point) return Truth::unknown;
        const auto residuals = residuals_at(algebroid, *point);
        if (!residuals) continue;
        ++seen;
        for (const PointResidual& residual : *residuals) {
            if (residual.value.excludes_zero()) return Truth::violated;
            small = small && residual.value.bound() < 1e-60;
        }
    }
    return seen == points && small ? Truth::holds : Truth::unknown;
}

} // namespace lagen::laws
