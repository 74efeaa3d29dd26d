// SPDX-License-Identifier: GPL-2.0-or-later
/// Generated headers through a real compiler: every kernel of every module at given points, in four scalars, with all
/// warnings as errors and without a single allocation.
#pragma once

#include "emit/print_header.hpp"
#include "golden.hpp"
#include "graph/core/evaluate.hpp"
#include "graph/unknowns/solve_unknowns.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>

namespace lagen::testing {

/// Values of the inputs of a module: t, parameters and lanes by name.
using Point = std::map<std::string, double>;

struct CompiledCase {
    KernelModule module;
    std::vector<Point> points;
};

/// A number without loss.
inline std::string hex_literal(double value)
{
    return fmt::format("S({:a})", value);
}

/// Declares the arguments of a kernel beside t and s, and lists all of them.
inline std::string declared_arguments(const Graph& graph, const Kernel& kernel, const Point& point, std::string& list)
{
    std::string text;
    for (const KernelInput& input : kernel.inputs) {
        list += (list.empty() ? "" : ", ") + input.name;
        if (input.role != ArrayRole::value) continue;
        text += fmt::format("Eigen::Matrix<S, {}, 1> {}; ", input.shape.rows, input.name);
        for (std::size_t k = 0; k < input.entries.size(); ++k)
            text += fmt::format("{}[{}] = {}; ", input.name, k,
                                hex_literal(point.at(graph.input_name(input.entries[k].input))));
    }
    return text;
}

inline std::string call_text(const Graph& graph, const Kernel& kernel, const Point& point)
{
    const KernelOutput& output = kernel.outputs[0];
    std::string list;
    const std::string declared = declared_arguments(graph, kernel, point, list);
    if (kernel.checks) {
        const std::string type =
            has_lanes(output.role) ? "typename M::State" : fmt::format("Eigen::Matrix<S, {}, 1>", output.shape.rows);
        std::string text = fmt::format("{}{} ds; check(lagen::StatusOf<S>::all_good(m.{}({}, ds)));", declared, type,
                                       kernel.name, list);
        for (const KernelEntry& entry : output.entries) text += fmt::format(" show(ds[{}]);", entry.row);
        return text;
    }
    if (output.sparse) {
        const std::size_t count = output.entries.size();
        std::string text = fmt::format("std::array<S, {}> v; m.{}_values({}, v);", count, kernel.name, list);
        text += fmt::format(" static_assert(M::{0}_rows.size() == {1} && M::{0}_columns.size() == {1});", kernel.name,
                            count);
        return text + " for (const S& value : v) show(value);";
    }
    if (output.shape.rank == 0) return fmt::format("show(m.{}({}));", kernel.name, list);
    std::string text = fmt::format("{}const auto v = m.{}({});", declared, kernel.name, list);
    for (const KernelEntry& entry : output.entries) text += fmt::format(" show(v({}, {}));", entry.row, entry.column);
    return text;
}

inline const char* program_start()
{
    return R"(#include <cstdio>
#include <cstdlib>
#include <new>

static int allocations = 0;
void* operator new(std::size_t size) { ++allocations; if (void* p = std::malloc(size)) return p; throw std::bad_alloc(); }
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
static void check(bool good) { if (!good) std::printf("status\n"); }
[[maybe_unused]] static void show(float x) { std::printf("%.9g\n", static_cast<double>(x)); }
[[maybe_unused]] static void show(double x) { std::printf("%.17g\n", x); }
[[maybe_unused]] static void show(long double x) { std::printf("%.17g\n", static_cast<double>(x)); }
[[maybe_unused]] static void show(const lagen::Pack<double, 4>& x) { std::printf("%.17g\n", x[0] < x[3] || x[0] > x[3] ? 1e300 : x[0]); }
)";
}

/// A scalar by name, and its epsilon.
struct CompiledScalar {
    std::string type;
    double epsilon;
};
inline const std::vector<CompiledScalar> two_scalars{{"double", 2.3e-16}, {"lagen::Pack<double, 4>", 2.3e-16}};
inline const std::vector<CompiledScalar> four_scalars{
    {"double", 2.3e-16}, {"long double", 2.3e-16}, {"lagen::Pack<double, 4>", 2.3e-16}, {"float", 1.2e-7}};

/// One function template a module that sets every input by name or lane and shows every listed entry.
inline std::string program_text(const std::vector<CompiledCase>& cases, const std::vector<CompiledScalar>& scalars)
{
    std::string text;
    for (const CompiledCase& one : cases) text += fmt::format("#include \"{}.hpp\"\n", one.module.name);
    text += "#include \"lagen/lanes/pack.hpp\"\n";
    text += program_start();
    std::string calls;
    for (const CompiledCase& one : cases) {
        const KernelModule& module = one.module;
        text +=
            fmt::format("template <class S> void try_{0}()\n{{\n    using M = lagen::models::{0}<S>;\n", module.name);
        for (const Point& point : one.points) {
            text +=
                fmt::format("    {{\n        M m; const S t = {}; typename M::State s;\n", hex_literal(point.at("t")));
            for (std::size_t k = 0; k < module.parameters.size(); ++k)
                text +=
                    fmt::format("        m.parameter({}) = {};\n", k, hex_literal(point.at(module.parameters[k].name)));
            for (std::size_t k = 0; k < module.inputs.size(); ++k)
                text += fmt::format("        m.input({}) = {};\n", k, hex_literal(point.at(module.inputs[k].name)));
            std::size_t lane = 0;
            for (const Quantity& quantity : lanes_of(module))
                text += fmt::format("        s[{}] = {};\n", lane++, hex_literal(point.at(quantity.name)));
            text += "        check(lagen::StatusOf<S>::all_good(m.parameter_status()));\n";
            for (const Kernel& kernel : module.kernels)
                text += "        { " + call_text(*module.graph, kernel, point) + " }\n";
            text += "    }\n";
        }
        text += "}\n";
        calls += fmt::format("    try_{}<S>();\n", module.name);
    }
    text += "template <class S> void try_all()\n{\n" + calls + "}\n";
    text += "int main()\n{\n";
    for (const CompiledScalar& scalar : scalars) text += fmt::format("    try_all<{}>();\n", scalar.type);
    return text + "    std::printf(\"allocations %d\\n\", allocations);\n}\n";
}

/// The entries of a kernel; one with directions has the unit vector of an entry's column in their place.
inline std::vector<double> interpreted(const Graph& graph, const Kernel& kernel, Point inputs)
{
    if (kernel.directions.empty()) return evaluate<double>(graph, nodes_of(kernel), inputs);
    std::vector<double> values;
    for (const NodeId direction : kernel.directions) inputs[graph.input_name(direction)] = 0;
    for (const KernelEntry& entry : kernel.outputs[0].entries) {
        double& direction = inputs[graph.input_name(kernel.directions[entry.column])];
        direction = 1;
        const NodeId node[] = {entry.node};
        values.push_back(evaluate<double>(graph, node, inputs).front());
        direction = 0;
    }
    return values;
}

/// The interpreter's answers in the same order.
inline std::vector<double> expected_values(const std::vector<CompiledCase>& cases)
{
    std::vector<double> values;
    for (const CompiledCase& one : cases)
        for (const Point& point : one.points)
            for (const Kernel& kernel : one.module.kernels) {
                Point inputs = point;
                solve_unknowns(*one.module.graph, one.module.implicit, inputs);
                for (const double value : interpreted(*one.module.graph, kernel, inputs)) values.push_back(value);
            }
    return values;
}

/// Compiles with `compiler`, runs, and compares with the interpreter: `roundings` of relative size epsilon are allowed.
inline void compare_compiled(const std::string& folder, const std::string& compiler,
                             const std::vector<CompiledCase>& cases, double roundings,
                             const std::vector<CompiledScalar>& scalars = four_scalars)
{
    const std::string where = std::string(LAGEN_BINARY_DIR) + "/compiled/" + folder + "_" + compiler;
    std::filesystem::create_directories(where);
    for (const CompiledCase& one : cases) write_text(where + "/" + one.module.name + ".hpp", print_header(one.module));
    write_text(where + "/main.cpp", program_text(cases, scalars));
    // Optimised once, by the compiler whose warnings need it.
    const std::string optimise = compiler == "g++" ? "-O1" : "-O0";
    const Shell build =
        run_shell(compiler + " -std=c++20 " + optimise +
                  " -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror -I" + where +
                  " -I" LAGEN_SOURCE_DIR "/runtime/include $(pkg-config --cflags eigen3 | sed s/-I/-isystem/) '" +
                  where + "/main.cpp' -o '" + where + "/main'");
    INFO(build.output);
    REQUIRE(build.status == 0);
    const Shell run = run_shell("'" + where + "/main'");
    REQUIRE(run.status == 0);
    std::istringstream out(run.output);
    const std::vector<double> expected = expected_values(cases);
    REQUIRE(!expected.empty());
    for (const auto& [type, epsilon] : scalars) {
        for (std::size_t k = 0; k < expected.size(); ++k) {
            std::string line;
            std::getline(out, line);
            INFO("value " << k << " in " << type << ": " << line << ", expected " << expected[k]);
            char* end = nullptr;
            const double value = std::strtod(line.c_str(), &end);
            REQUIRE(end != line.c_str());
            if (std::isnan(expected[k]) && std::isnan(value)) continue; // outside of the domain of both
            REQUIRE(std::abs(value - expected[k]) <= roundings * epsilon * (1 + std::abs(expected[k])));
        }
    }
    std::string last;
    std::getline(out, last);
    CHECK(last == "allocations 0");
}

} // namespace lagen::testing
