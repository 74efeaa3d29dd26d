// SPDX-License-Identifier: GPL-2.0-or-later
/// Statements are free of C++: the printer below makes plain C of them, which is compiled by a C compiler and run.
#include "../support/golden.hpp"
#include "emit/write_body.hpp"
#include "graph/core/evaluate.hpp"
#include "graph/core/operators.hpp"
#include "hand_built.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>

using namespace lagen;
using namespace lagen::testing;

namespace {

std::string in_c(const Expression& e)
{
    const auto operand = [&](std::size_t k) { return in_c(e.operands[k]); };
    switch (e.op) {
    case Op::constant: return fmt::format("({:a})", e.value.get_d());
    case Op::input: return e.entry ? fmt::format("{}[{}]", e.name, *e.entry) : e.name;
    case Op::negate: return "(-" + operand(0) + ")";
    case Op::abs: return "fabs(" + operand(0) + ")";
    case Op::power: {
        std::string product = operand(0);
        const auto exponent = static_cast<int>(e.payload);
        for (int k = 1; k < std::abs(exponent); ++k) product += " * " + operand(0);
        return exponent > 0 ? "(" + product + ")" : "(1 / (" + product + "))";
    }
    default: break;
    }
    if (e.operands.size() == 2) return fmt::format("({} {} {})", operand(0), operator_of(e.op).spelling, operand(1));
    return fmt::format("{}({})", operator_of(e.op).spelling, operand(0));
}

std::string array_in_c(const std::string& name, const std::string& pattern, const Statement& statement)
{
    std::string entries;
    for (const Expression& each : statement.expressions)
        entries += fmt::format(fmt::runtime(pattern), in_c(each)) + ", ";
    return fmt::format("const double {}[] = {{{}}};", name, entries);
}

std::string in_c(const Statement& statement, const Graph& graph)
{
    using Kind = Statement::Kind;
    const auto argument = [&](std::size_t k) { return in_c(statement.expressions[k]); };
    const auto name = [&](std::size_t k) { return statement.names[k]; };
    switch (statement.kind) {
    case Kind::load: {
        const auto& inputs = graph.inputs();
        const auto place = std::ranges::find(inputs, statement.node) - inputs.begin();
        return fmt::format("const double {} = in[{}];", graph.input_name(statement.node), place);
    }
    case Kind::define: return fmt::format("const double {} = {};", name(0), argument(0));
    case Kind::angles:
        if (statement.expressions.size() == 1)
            return fmt::format("const double {0} = sin({2}), {1} = cos({2});", name(0), name(1), argument(0));
        return array_in_c(name(0), "sin({})", statement) + array_in_c(name(1), "cos({})", statement);
    case Kind::roots: return array_in_c(name(0), "sqrt({})", statement);
    case Kind::reciprocals: return array_in_c(name(0), "1 / ({})", statement);
    case Kind::check:
        if (statement.expressions.size() == 1) return fmt::format("if ({} == 0) failed = 1;", argument(0));
        return fmt::format("if ({} <= {} * DBL_EPSILON * {}) failed = 1;", argument(0), statement.index, argument(1));
    case Kind::store: return fmt::format("out[{}] = {};", statement.index, argument(0));
    case Kind::keep: return fmt::format("work[{}] = {};", statement.index, argument(0));
    case Kind::recall: return fmt::format("const double {} = work[{}];", name(0), statement.index);
    case Kind::terms:
    case Kind::stumpff:
    case Kind::factor:
    case Kind::solve: break;
    }
    FAIL("this printer knows no such statement");
    return {};
}

/// A function a part, which answers whether a check failed.
std::string body_in_c(const Body& body, const Graph& graph)
{
    std::string text = "#include <float.h>\n#include <math.h>\n#include <stdio.h>\n\n";
    for (std::size_t k = 0; k < body.parts.size(); ++k) {
        text += fmt::format("static int part{}(const double* in, double* out, double* work)\n{{\n", k);
        text += "    int failed = 0;\n    (void)in; (void)out; (void)work;\n";
        for (const Statement& statement : body.parts[k]) text += "    " + in_c(statement, graph) + "\n";
        text += "    return failed;\n}\n\n";
    }
    return text;
}

/// The values that a C program computes for these outputs, behind whether a check failed.
std::vector<double> run_in_c(const Graph& graph, const std::vector<NodeId>& outputs,
                             const std::map<std::string, double>& point, std::size_t longest_part)
{
    LocalNames names;
    for (const NodeId id : graph.inputs()) {
        names.inputs[id] = graph.input_name(id);
        names.taken.insert(graph.input_name(id));
    }
    const Body body = write_body({graph, names, outputs, {}, graph.inputs(), Checking::state, {}, longest_part});
    CHECK((body.parts.size() > 1) == (longest_part > 0));
    std::string text = body_in_c(body, graph);
    text += "int main(void)\n{\n    const double in[] = {";
    for (const NodeId id : graph.inputs()) text += fmt::format("{:a}, ", point.at(graph.input_name(id)));
    text +=
        fmt::format("}};\n    double out[{}], work[{}];\n    int failed = 0;\n", outputs.size(), body.workspace + 1);
    for (std::size_t k = 0; k < body.parts.size(); ++k)
        text += fmt::format("    failed |= part{}(in, out, work);\n", k);
    text +=
        fmt::format("    printf(\"%d\\n\", failed);\n    for (int k = 0; k < {}; ++k) printf(\"%.17g\\n\", out[k]);\n",
                    outputs.size());
    const std::string where = std::string(LAGEN_BINARY_DIR) + "/compiled/plain_c";
    std::filesystem::create_directories(where);
    write_text(where + "/main.c", text + "    return 0;\n}\n");
    const Shell build = run_shell("cc -std=c99 -Wall -Wextra -Wpedantic -Wshadow -Werror '" + where + "/main.c' -o '" +
                                  where + "/main' -lm");
    INFO(build.output);
    REQUIRE(build.status == 0);
    std::istringstream out(run_shell("'" + where + "/main'").output);
    std::vector<double> values(outputs.size() + 1, NAN);
    for (double& value : values) out >> value;
    return values;
}

} // namespace

TEST_CASE("another printer makes C of a kernel with batches and a factorisation, whole and in parts", "[emit][compile]")
{
    KernelModule module = solve_module("solved", std::vector<std::vector<bool>>(4, std::vector<bool>(4, true)),
                                       MatrixStructure::positive_definite);
    Graph& g = *module.graph;
    std::vector<NodeId> outputs = nodes_of(module.kernels[0]);
    outputs.erase(outputs.begin(), outputs.begin() + 10);
    NodeId chain = outputs[0];
    for (const NodeId id : std::vector<NodeId>(g.inputs().begin() + 1, g.inputs().end())) {
        const NodeId root = g.apply(Op::sqrt, g.add(g.power(id, 2), g.constant(Rational(1, 8))));
        outputs.push_back(g.divide(g.apply(Op::cos, id), root));
        chain = g.add(g.multiply(chain, g.apply(Op::sin, id)), g.power(g.subtract(root, outputs[1]), 7));
        outputs.push_back(chain);
    }
    std::map<std::string, double> point;
    for (const NodeId id : g.inputs()) {
        const std::string& name = g.input_name(id);
        point[name] =
            0.25 + 0.0625 * static_cast<double>(point.size()) + (name[0] == 'a' && name[1] == name[3] ? 4 : 0);
    }
    const std::vector<double> expected = evaluate<double>(g, outputs, point);
    for (const std::size_t longest : {0U, 8U}) {
        const std::vector<double> found = run_in_c(g, outputs, point, longest);
        CHECK(found[0] == 0);
        for (std::size_t k = 0; k < expected.size(); ++k)
            CHECK(std::abs(found[k + 1] - expected[k]) <= 1e-13 * (1 + std::abs(expected[k])));
    }
    for (const char* row : {"a0_0", "a1_0", "a2_0", "a3_0"}) point[row] = 0; // singular
    CHECK(run_in_c(g, outputs, point, 0)[0] == 1);
}
