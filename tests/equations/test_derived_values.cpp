// SPDX-License-Identifier: GPL-2.0-or-later
/// The derived formulas as numbers: against reference points that share no code with lagen.
#include "elaborate/build_algebroid.hpp"
#include "equations/derivations.hpp"
#include "equations/numbers.hpp"
#include "model/read_model.hpp"
#include "support/reference_case.hpp"
#include "support/tolerances.hpp"

#include <catch2/catch.hpp>

using namespace lagen;

namespace {

struct Point {
    Values values; ///< parameters, state and momenta
    Values rates;  ///< d(state)/dt
};

Point read_point(const ReferenceCase& reference, const Model& model, const ReferencePoint& given)
{
    Point point;
    for (const auto& [name, value] : reference.parameters) point.values[name] = std::stod(value);
    std::vector<std::string> lanes = reference.base;
    lanes.insert(lanes.end(), reference.fibre.begin(), reference.fibre.end());
    for (std::size_t k = 0; k < lanes.size(); ++k) {
        point.values[lanes[k]] = std::stod(given.state[k]);
        point.rates[lanes[k]] = std::stod(given.state_dot[k]);
    }
    for (std::size_t a = 0; a < model.fibre.momenta.size(); ++a)
        point.values[model.fibre.momenta[a].name] = std::stod(given.momenta[a]);
    return point;
}

const double rounding = tolerance::roundoff(450);

} // namespace

TEST_CASE("kinematics, momenta, accelerations and energy of every reference case hold at its points")
{
    std::size_t equations = 0;
    for (const ReferenceCase& reference : read_reference_cases()) {
        INFO(reference.name);
        const Model model = read_model_text(reference.name + ".toml", model_text(reference));
        const EquationSet set = derive_lagrange(model, build_algebroid(model));
        REQUIRE(set.blocks.size() == 5);
        for (const ReferencePoint& given : reference.points) {
            const Point point = read_point(reference, model, given);
            Numbers number(point.values);
            for (const Equation& equation : set.blocks[0].equations)
                CHECK(number.right(equation) == Approx(point.rates.at(equation.symbol))
                                                    .margin(rounding * number.scale(equation, point.rates))
                                                    .epsilon(rounding));
            for (const Equation& equation : set.blocks[1].equations)
                CHECK(number.right(equation) ==
                      Approx(point.values.at(equation.symbol)).margin(rounding).epsilon(rounding));
            for (const Equation& equation : set.blocks[3].equations) {
                double left = 0;
                for (const TermGroup& mass : equation.mass) left += number(mass.value) * point.rates.at(mass.label);
                CHECK(std::abs(left - number.right(equation)) <= rounding * number.scale(equation, point.rates));
                ++equations;
            }
            const Equation& energy = set.blocks[4].equations.at(0);
            CHECK(number.right(energy) == Approx(std::stod(given.energy)).epsilon(rounding));
        }
    }
    CHECK(equations > 300);
}
