// SPDX-License-Identifier: GPL-2.0-or-later
/// Kernels of other inputs than (t, s), and of several outputs: the residual of a step with its Jacobian, a matrix that
/// turns a state.
#include "../support/golden.hpp"
#include "emit/print_header.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/core/evaluate.hpp"
#include "hand_built.hpp"

#include <cmath>
#include <filesystem>
#include <sstream>

using namespace lagen;
using namespace lagen::testing;

namespace {

KernelInput array_input(Graph& graph, const std::string& name, ArrayRole role, ArrayShape shape,
                        const std::vector<std::string>& entries)
{
    KernelInput input{name, role, shape, {}};
    for (const std::string& entry : entries) input.entries.push_back(declare(graph, entry));
    return input;
}

/// The midpoint rule of a pendulum, F = x1 - x0 - h f((x0 + x1)/2), with dF/dx1; and R s for a matrix R.
KernelModule step_module()
{
    KernelModule module = pendulum_module();
    Graph& g = *module.graph;
    module.name = "stepped";
    module.kind = ModuleKind::step;
    const NodeId ratio = g.divide(module.parameters[2].input, module.parameters[1].input);
    const KernelInput x0 = array_input(g, "xk", ArrayRole::state, {1, 2, 1}, {"th0", "v0"});
    const KernelInput x1 = array_input(g, "xk1", ArrayRole::state, {1, 2, 1}, {"th1", "v1"});
    const KernelInput h = array_input(g, "h", ArrayRole::value, {}, {"h"});
    const auto middle = [&](std::size_t k) {
        return g.divide(g.add(x0.entries[k].input, x1.entries[k].input), g.constant(2));
    };
    const std::vector<NodeId> slope{middle(1), g.negate(g.multiply(ratio, g.apply(Op::sin, middle(0))))};
    KernelOutput residual{"residual", {1, 2, 1}, {}, ArrayRole::tangent};
    std::vector<NodeId> unknowns;
    for (std::size_t k = 0; k < 2; ++k) {
        unknowns.push_back(x1.entries[k].input);
        const NodeId difference = g.subtract(x1.entries[k].input, x0.entries[k].input);
        residual.entries.push_back({k, 0, g.subtract(difference, g.multiply(h.entries[0].input, slope[k]))});
    }
    KernelOutput derivative{"derivative", {2, 2, 2}, {}};
    const std::vector<NodeId> outputs{residual.entries[0].node, residual.entries[1].node};
    const std::vector<NodeId> entries = joined_rows(jacobian(g, outputs, unknowns));
    for (std::size_t k = 0; k < 4; ++k) derivative.entries.push_back({k / 2, k % 2, entries[k]});
    module.kernels = {{.name = "step", .inputs = {x0, x1, h}, .outputs = {residual, derivative}}};
    module.kernels[0].checks.emplace();
    module.kernels[0].checks->pivots = {h.entries[0].input};
    module.kernels[0].documentation = {"F = xk1 - xk - h f((xk + xk1)/2) and dF/dxk1."};

    const KernelInput turn = array_input(g, "R", ArrayRole::value, {2, 2, 2}, {"R11", "R12", "R21", "R22"});
    std::vector<NodeId> turned;
    for (std::size_t k = 0; k < 4; k += 2)
        turned.push_back(g.add(g.multiply(turn.entries[k].input, base_of(module)[0].input),
                               g.multiply(turn.entries[k + 1].input, fibre_of(module)[0].input)));
    module.kernels.push_back(vector_kernel(module, "turned", turned));
    module.kernels[1].inputs[0] = turn;
    return module;
}

const char* const step_program = R"(#include "stepped.hpp"
#include "lagen/lanes/pack.hpp"

#include <cstdio>

template class lagen::models::stepped<lagen::Pack<double, 4>>;

int main()
{
    using M = lagen::models::stepped<double>;
    M m;
    m.parameters.l = 0.75;
    M::State x0 = M::state({.th = 0.5}, {.v = -0.25});
    M::State x1 = M::state({.th = 0.375}, {.v = -1.5});
    M::State residual;
    Eigen::Matrix<double, 2, 2> derivative;
    const lagen::Status status = m.step(x0, x1, 0.125, residual, derivative);
    std::printf("%d %d\n", status == lagen::Status::ok, m.step(x0, x1, 0.0, residual, derivative) == lagen::Status::ok);
    (void)m.step(x0, x1, 0.125, x1, derivative);
    for (double value : {x1[0], x1[1], derivative(0, 0), derivative(0, 1), derivative(1, 0), derivative(1, 1)})
        std::printf("%.17g\n", value);
    Eigen::Matrix<double, 2, 2> R;
    R << 0, 2, 3, 4;
    const auto turned = m.turned(R, x0);
    std::printf("%.17g\n%.17g\n", turned[0], turned[1]);
}
)";

} // namespace

TEST_CASE("a kernel of two states and a step gives a residual and its Jacobian as the interpreter does",
          "[emit][compile]")
{
    const KernelModule module = step_module();
    const std::map<std::string, double> point{{"th0", 0.5}, {"v0", -0.25}, {"th1", 0.375}, {"v1", -1.5}, {"h", 0.125},
                                              {"m", 1},     {"l", 0.75},   {"g", 9.81},    {"th", 0.5},  {"v", -0.25},
                                              {"R11", 0},   {"R12", 2},    {"R21", 3},     {"R22", 4},   {"t", 0}};
    std::vector<double> expected;
    for (const Kernel& kernel : module.kernels)
        for (const double value : evaluate<double>(*module.graph, nodes_of(kernel), point)) expected.push_back(value);
    REQUIRE(expected.size() == 8);
    CHECK(std::abs(expected[4]) > 0.1);
    const std::string where = std::string(LAGEN_BINARY_DIR) + "/compiled/step";
    std::filesystem::create_directories(where);
    write_text(where + "/stepped.hpp", print_header(module));
    write_text(where + "/main.cpp", step_program);
    for (const std::string compiler : {"g++", "clang++"}) {
        if (run_shell(compiler + " --version").status != 0) continue;
        const Shell build =
            run_shell(compiler +
                      " -std=c++20 -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror -I" LAGEN_SOURCE_DIR
                      "/runtime/include $(pkg-config --cflags eigen3 | sed s/-I/-isystem/) '" +
                      where + "/main.cpp' -o '" + where + "/main'");
        INFO(build.output);
        REQUIRE(build.status == 0);
        std::istringstream out(run_shell("'" + where + "/main'").output);
        int good = 0, at_rest = 1;
        out >> good >> at_rest;
        CHECK(good == 1);
        CHECK(at_rest == 0); // the pivot h
        for (const double value : expected) {
            double found = NAN;
            out >> found;
            CHECK(std::abs(found - value) <= 1e-15 * (1 + std::abs(value)));
        }
    }
}

TEST_CASE("a signature follows from what a kernel reads, computes and checks", "[emit]")
{
    const std::string text = print_header(step_module());
    CHECK(text.find("[[nodiscard]] status_t<S> step(const State& xk, const State& xk1, S h, State& residual,") !=
          std::string::npos);
    CHECK(text.find("Eigen::Matrix<S, 2, 1> turned(const Eigen::Matrix<S, 2, 2>& R, const State& s) const noexcept") !=
          std::string::npos);
    CHECK(text.find("const S R11 = R(0, 0), R12 = R(0, 1);\n") != std::string::npos);
    CHECK(text.find("/// What of a step depends on the parameters alone") != std::string::npos);
}
