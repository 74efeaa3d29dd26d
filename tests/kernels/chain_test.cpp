// SPDX-License-Identifier: GPL-2.0-or-later
/// A long chain of pendulums in absolute and in joint angles: two kernels, eliminated along two trees, one motion.
#include "kernels/models.hpp"
#include "support/tolerances.hpp"

using namespace lagen;
using namespace lagen::testing;

namespace {

constexpr std::size_t links = 16;

KernelModule chain_of(const std::string& file, std::size_t length = links)
{
    const std::string path = std::string(LAGEN_SOURCE_DIR) + file;
    KernelRequest request;
    request.only = {"rhs", "mass_matrix"};
    return kernels_of(read_model(path, {Setting{"n", whole_text("--set", std::to_string(length))}}), request);
}

std::string entry(const std::string& name, std::size_t k)
{
    return name + "[" + std::to_string(k + 1) + "]";
}

bool has_factorisation(const KernelModule& module, const std::string& kernel)
{
    const std::vector<NodeId> below = reachable(*module.graph, nodes_of(find_kernel(module, kernel)));
    return std::ranges::any_of(below, [&](NodeId id) { return module.graph->op(id) == Op::factor; });
}

} // namespace

TEST_CASE("what the rows of a chain of two are divided by are divisors of its right-hand side")
{
    const KernelModule module = chain_of("/models/chain.toml", 2);
    std::vector<std::string> names;
    for (const NodeId pivot : find_kernel(module, "rhs").checks->pivots)
        names.push_back(module.graph->input_name(pivot));
    CHECK(names == std::vector<std::string>{"m[2]", "l[1]", "l[2]"});
    CHECK(!find_kernel(module, "mass_matrix").checks);
}

TEST_CASE("a chain of 16 has one motion in absolute and in joint angles, and needs no factorisation")
{
    const KernelModule absolute = chain_of("/models/chain.toml");
    const KernelModule relative = chain_of("/tests/data/models/chain_relative.toml");
    CHECK(!has_factorisation(absolute, "rhs"));
    CHECK(!has_factorisation(relative, "rhs"));
    std::mt19937 random(4);
    for (int sample = 0; sample < 5; ++sample) {
        Values one{{"t", 0}, {"g", 9.81}};
        Values two = one;
        double angle = 0;
        double rate = 0;
        for (std::size_t k = 0; k < links; ++k) {
            const auto draw = [&](double low, double high) {
                return low + (high - low) * static_cast<double>(random()) / 4294967295.0;
            };
            one[entry("m", k)] = two[entry("m", k)] = draw(0.5, 2);
            one[entry("l", k)] = two[entry("l", k)] = draw(0.5, 1);
            angle += two[entry("q", k)] = draw(-1, 1);
            rate += two[entry("w", k)] = draw(-1, 1);
            one[entry("a", k)] = angle;
            one[entry("w", k)] = rate;
        }
        const std::vector<double> a = values_of(absolute, "rhs", one);
        const std::vector<double> q = values_of(relative, "rhs", two);
        double size = 0;
        double difference = 0;
        double sum = 0;
        for (std::size_t k = links; k < 2 * links; ++k) {
            sum += q[k];
            size = std::max(size, std::abs(a[k]));
            difference = std::max(difference, std::abs(sum - a[k]));
        }
        CHECK(size > 1);
        CHECK(difference < tolerance::roundoff(4096) * size);
    }
}

TEST_CASE("the accelerations of a chain of 16 solve the dense system of its mass matrix")
{
    const KernelModule chain = chain_of("/models/chain.toml");
    Values at = random_point(chain, 11);
    const std::vector<double> W = values_of(chain, "mass_matrix", at);
    const std::vector<double> moving = values_of(chain, "rhs", at);
    REQUIRE(W.size() == links * links);
    // W (ydot(g) - ydot(0)) is the force of gravity, -g l_i sin a_i (m_i + ... + m_n), at any rates.
    const double g = at["g"];
    at["g"] = 0;
    const std::vector<double> weightless = values_of(chain, "rhs", at);
    double mass = 0;
    for (std::size_t i = links; i-- > 0;) {
        mass += at[entry("m", i)];
        double force = 0;
        double size = 0;
        for (std::size_t j = 0; j < links; ++j) {
            const double difference = moving[links + j] - weightless[links + j];
            force += W[i * links + j] * difference;
            size += std::abs(W[i * links + j]) * (std::abs(moving[links + j]) + std::abs(weightless[links + j]));
        }
        const double expected = -g * at[entry("l", i)] * std::sin(at[entry("a", i)]) * mass;
        CHECK(std::abs(expected) > 0.05);
        CHECK(std::abs(force - expected) < tolerance::roundoff(256) * size);
    }
}
