// SPDX-License-Identifier: GPL-2.0-or-later
/// Laws that hold for every model in every form that it has.
#include "models.hpp"

#include "../support/tolerances.hpp"

#include <cmath>

using namespace lagen;
using namespace lagen::testing;

namespace {

/// The lanes with their rates, and t with rate 1.
std::vector<std::pair<NodeId, NodeId>> along_the_motion(const KernelModule& module)
{
    const std::vector<NodeId> rhs = nodes_of(find_kernel(module, "rhs"));
    std::vector<std::pair<NodeId, NodeId>> seeds{{module.time, module.graph->constant(1)}};
    std::size_t lane = 0;
    for (const Quantity& quantity : lanes_of(module)) seeds.emplace_back(quantity.input, rhs[lane++]);
    return seeds_through(*module.graph, module.implicit, std::move(seeds));
}

double largest(const std::vector<double>& values)
{
    double size = 0;
    for (const double value : values) size = std::max(size, std::abs(value));
    return size;
}

} // namespace

TEST_CASE("energy changes by the power of forces and explicit time in every form of every model", "[kernels]")
{
    std::size_t powered = 0;
    for (const std::string& file : model_files())
        for (const KernelModule& module : kernels_of_file(file)) {
            INFO(module.name);
            if (module.form == "first_order") continue; // it has no energy
            Graph& graph = *module.graph;
            const char* const energy = module.form == "pontryagin" ? "hamiltonian" : "energy";
            std::vector<NodeId> rate =
                directional(graph, nodes_of(find_kernel(module, energy)), along_the_motion(module));
            if (has_kernel(module, "power")) {
                ++powered;
                rate[0] = graph.subtract(rate[0], nodes_of(find_kernel(module, "power"))[0]);
            }
            for (unsigned seed = 1; seed < 4; ++seed) {
                Values point = random_point(module, seed);
                const double size = largest(values_of(module, "rhs", point));
                REQUIRE(size > 0);
                solve_unknowns(graph, module.implicit, point);
                CHECK(std::abs(evaluate<double>(graph, rate, point)[0]) <=
                      tolerance::roundoff(4096) * (1 + size) * (1 + size));
            }
        }
    CHECK(powered > 0);
}

TEST_CASE("brackets that are differences have no power", "[kernels]")
{
    for (const char* bracket : {"x - 1", "1 - x", "x^2 - x", "sin(x) - y"}) {
        INFO(bracket);
        const KernelModule module = kernels_of_text(
            std::string("[base]\ncoordinates = ['x', 'y']\n[fibre]\ncoordinates = ['s', 'a', 'b']\n[algebroid]\n"
                        "kind = 'general'\n[algebroid.anchor]\ns = { x = 1 }\n[algebroid.bracket]\n's,a' = { b = '") +
            bracket + "' }\n[lagrangian]\nL = '(s^2 + a^2 + b^2)/2'\n");
        CHECK_FALSE(has_kernel(module, "power"));
    }
}

TEST_CASE("the Hamiltonian form moves as the Lagrangian form does", "[kernels]")
{
    std::size_t compared = 0;
    for (const std::string& file : model_files()) {
        const std::vector<KernelModule>& forms = kernels_of_file(file);
        if (forms.size() < 2 || forms[0].form != "lagrange") continue;
        const KernelModule& lagrange = forms[0];
        const KernelModule& hamilton = forms[1];
        INFO(file);
        REQUIRE(hamilton.form == "hamilton");
        const Values point = random_point(lagrange, 5);
        Values other = point;
        const std::vector<double> momenta = values_of(lagrange, "momentum", point);
        for (std::size_t a = 0; a < momenta.size(); ++a) other[hamilton.groups[1].lanes[a].name] = momenta[a];
        const std::vector<double> velocity = values_of(hamilton, "velocity", other);
        for (std::size_t a = 0; a < momenta.size(); ++a)
            CHECK(std::abs(velocity[a] - point.at(lagrange.groups[1].lanes[a].name)) <=
                  tolerance::roundoff(4096) * (1 + largest(velocity)));
        // d/dt p(x, y) along the Lagrangian motion is mudot.
        Graph& graph = *lagrange.graph;
        const std::vector<NodeId> rate =
            directional(graph, nodes_of(find_kernel(lagrange, "momentum")), along_the_motion(lagrange));
        const std::vector<double> expected = evaluate<double>(graph, rate, point);
        const std::vector<double> ds = values_of(hamilton, "rhs", other);
        for (std::size_t a = 0; a < expected.size(); ++a)
            CHECK(std::abs(ds[hamilton.groups[0].lanes.size() + a] - expected[a]) <=
                  tolerance::roundoff(1U << 16U) * (1 + largest(expected) + largest(ds)));
        ++compared;
    }
    CHECK(compared >= 25);
}

TEST_CASE("the Jacobian of every form of every model agrees with central differences of order 4", "[kernels]")
{
    for (const std::string& file : model_files())
        for (const KernelModule& module : kernels_of_file(file)) {
            INFO(module.name);
            const Kernel& jacobian = find_kernel(module, "jacobian");
            const Values point = random_point(module, 11);
            std::vector<std::string> lanes;
            for (const Quantity& quantity : lanes_of(module)) lanes.push_back(quantity.name);
            const std::vector<double> values = values_of(module, "jacobian", point);
            std::vector<std::vector<double>> dense(lanes.size(), std::vector<double>(lanes.size(), 0.0));
            for (std::size_t k = 0; k < values.size(); ++k)
                dense[jacobian.outputs[0].entries[k].row][jacobian.outputs[0].entries[k].column] = values[k];
            const double h = 1e-4;
            for (std::size_t column = 0; column < lanes.size(); ++column) {
                const auto at = [&](double steps) {
                    Values moved = point;
                    moved[lanes[column]] += steps * h;
                    return values_of(module, "rhs", moved);
                };
                const std::vector<double> above = at(1), below = at(-1), far_above = at(2), far_below = at(-2);
                for (std::size_t row = 0; row < lanes.size(); ++row) {
                    const double slope = (8 * (above[row] - below[row]) - (far_above[row] - far_below[row])) / (12 * h);
                    CHECK(std::abs(dense[row][column] - slope) <= tolerance::difference * (10 + std::abs(slope)));
                }
            }
        }
}
