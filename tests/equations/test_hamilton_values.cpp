// SPDX-License-Identifier: GPL-2.0-or-later
/// Hamilton's equations as numbers: against reference points that share no code with lagen.
#include "elaborate/build_algebroid.hpp"
#include "equations/derivations.hpp"
#include "equations/numbers.hpp"
#include "model/read_model.hpp"
#include "support/reference_case.hpp"
#include "support/tolerances.hpp"

#include <catch2/catch.hpp>

using namespace lagen;

namespace {

const double hamilton_rounding = tolerance::roundoff(2000);

bool is_implicit(const EquationSet& set)
{
    return set.blocks.at(0).title.find("velocities below") != std::string::npos;
}

/// The equations have y, which stands for y(x, mu); its value is that of the point.
bool is_in_velocities(const EquationSet& set)
{
    return block_of(set, "kinematics").formula == "ẋ^i = ρ^i_a y^a";
}

/// Rates along the right sides of a block: d(symbol)/dt.
void check_rates(Numbers& number, const EquationBlock& block, const Values& rates)
{
    for (const Equation& equation : block.equations) {
        INFO(block.title << ": " << equation.symbol);
        const double scale = number.scale(equation, rates);
        CHECK(std::abs(number.right(equation) - rates.at(equation.symbol)) <= hamilton_rounding * scale);
    }
}

} // namespace

TEST_CASE("Hamilton's equations from every reference Lagrangian have its velocities, rates and energy at its points")
{
    std::size_t explicit_cases = 0;
    std::size_t implicit_cases = 0;
    for (const ReferenceCase& reference : read_reference_cases()) {
        INFO(reference.name);
        const Model model = read_model_text(reference.name + ".toml", model_text(reference));
        const EquationSet set = derive_hamilton(model, build_algebroid(model));
        ++(is_implicit(set) ? implicit_cases : explicit_cases);
        for (const ReferencePoint& given : reference.points) {
            Values values;
            Values rates;
            Values velocities;
            for (const auto& [name, value] : reference.parameters) values[name] = std::stod(value);
            for (std::size_t i = 0; i < reference.base.size(); ++i) {
                values[reference.base[i]] = std::stod(given.state[i]);
                rates[reference.base[i]] = std::stod(given.state_dot[i]);
            }
            for (std::size_t a = 0; a < reference.fibre.size(); ++a) {
                const std::string& momentum = model.fibre.momenta[a].name;
                velocities[reference.fibre[a]] = std::stod(given.state[reference.base.size() + a]);
                values[momentum] = velocities[momentum] = std::stod(given.momenta[a]);
                rates[momentum] = std::stod(given.momenta_dot[a]);
            }
            Values with_velocities = values;
            with_velocities.insert(velocities.begin(), velocities.end());
            Numbers number(is_implicit(set) ? with_velocities : values);
            check_rates(number, block_of(set, "velocities"), velocities);
            Numbers moving(is_in_velocities(set) ? with_velocities : values);
            if (!reference.base.empty()) check_rates(moving, block_of(set, "kinematics"), rates);
            check_rates(moving, block_of(set, "equations of motion"), rates);
            const Equation& H = set.blocks[0].equations.at(0);
            CHECK(std::abs(number.right(H) - std::stod(given.energy)) <= hamilton_rounding * number.scale(H, {}));
        }
    }
    CHECK(implicit_cases == 1); // the relativistic oscillator
    CHECK(explicit_cases == 40);
}
