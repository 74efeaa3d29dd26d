// SPDX-License-Identifier: GPL-2.0-or-later
/// Pontryagin's equations as numbers: against reference extremals, and against the coordinate formula with derivatives
/// of H by differences.
#include "equations/numbers.hpp"
#include "expression/parse.hpp"
#include "model/read_model.hpp"
#include "support/model_equations.hpp"
#include "support/reference_case.hpp"
#include "support/tolerances.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <limits>

using namespace lagen;

namespace {

const double extremal_rounding = tolerance::roundoff(500);

/// The value of an expression of the data file.
double value_of(const std::string& text, const Values& values)
{
    return Numbers(values)(parse_expression(whole_text("<data>", text)));
}

/// H = mu_a sigma^a - cost from the texts of the data file.
double hamiltonian(const ReferenceCase& control, const Values& values)
{
    double H = -value_of(control.cost, values);
    for (std::size_t a = 0; a < control.momenta.size(); ++a)
        H += values.at(control.momenta[a]) * value_of(control.sigma[a], values);
    return H;
}

/// -(rho^i_a dH/dx^i + mu_c C^c_ab sigma^b), dH/dx by central differences.
double momentum_rate(const ReferenceCase& control, std::size_t a, const Values& values)
{
    const double step = std::cbrt(std::numeric_limits<double>::epsilon());
    double rate = 0;
    for (std::size_t i = 0; i < control.base.size(); ++i) {
        Values above = values;
        Values below = values;
        above[control.base[i]] += step;
        below[control.base[i]] -= step;
        rate -= value_of(control.rho[i][a], values) * (hamiltonian(control, above) - hamiltonian(control, below)) /
                (2 * step);
    }
    for (const ReferenceBracket& entry : control.brackets) {
        if (entry.a != a && entry.b != a) continue;
        const double sigma = value_of(control.sigma[entry.a == a ? entry.b : entry.a], values);
        const double term = values.at(control.momenta[entry.c]) * value_of(entry.value, values) * sigma;
        rate -= entry.a == a ? term : -term;
    }
    return rate;
}

Values values_at(const ReferenceCase& control, const ReferenceSample& sample)
{
    Values values;
    for (const auto& [name, value] : control.parameters) values[name] = std::stod(value);
    std::vector<std::string> lanes = control.base;
    lanes.insert(lanes.end(), control.momenta.begin(), control.momenta.end());
    for (std::size_t k = 0; k < lanes.size(); ++k) values[lanes[k]] = std::stod(sample.state[k]);
    for (std::size_t A = 0; A < control.controls.size(); ++A)
        values[control.controls[A]] = std::stod(sample.controls[A]);
    return values;
}

} // namespace

TEST_CASE("the optimal controls of every reference problem are those of its extremal, and H is constant along it")
{
    std::size_t instants = 0;
    for (const ReferenceCase& control : read_control_cases()) {
        INFO(control.name);
        const Model model = read_model_text(control.name + ".toml", model_text(control));
        const EquationSet set = derive("pontryagin", model, verify(model));
        for (const ReferenceSample& sample : control.samples) {
            const Values values = values_at(control, sample);
            Numbers number(values);
            for (const Equation& equation : block_of(set, "condition").equations)
                CHECK(std::abs(number.right(equation)) <= extremal_rounding * 20);
            for (const Equation& equation : block_of(set, "optimal controls").equations)
                CHECK(number.right(equation) ==
                      Approx(values.at(equation.symbol)).margin(extremal_rounding).epsilon(extremal_rounding));
            for (const char* title : {"Hamiltonian", "maximal Hamiltonian"}) {
                const Equation& H = block_of(set, title).equations.at(0);
                CHECK(std::abs(number.right(H) - std::stod(control.hamiltonian)) <= extremal_rounding * 40);
            }
            ++instants;
        }
    }
    CHECK(instants >= 40);
}

TEST_CASE("costates move by the coordinate formula with derivatives of H by differences")
{
    double largest = 0;
    for (const ReferenceCase& control : read_control_cases()) {
        INFO(control.name);
        const Model model = read_model_text(control.name + ".toml", model_text(control));
        const EquationSet set = derive("pontryagin", model, verify(model));
        for (const ReferenceSample& sample : control.samples) {
            const Values values = values_at(control, sample);
            Numbers number(values);
            const EquationBlock& motion = block_of(set, "equations of motion");
            for (std::size_t a = 0; a < motion.equations.size(); ++a) {
                const double rate = momentum_rate(control, a, values);
                CHECK(number.right(motion.equations[a]) ==
                      Approx(rate).margin(40 * tolerance::difference).epsilon(tolerance::difference));
                largest = std::max(largest, std::abs(rate));
            }
            for (const Equation& equation : block_of(set, "kinematics").equations) {
                const auto& base = control.base;
                const auto i = static_cast<std::size_t>(std::ranges::find(base, equation.symbol) - base.begin());
                double rate = 0;
                for (std::size_t a = 0; a < control.sigma.size(); ++a)
                    rate += value_of(control.rho[i][a], values) * value_of(control.sigma[a], values);
                CHECK(number.right(equation) == Approx(rate).margin(extremal_rounding).epsilon(extremal_rounding));
            }
        }
    }
    CHECK(largest > 1);
}
