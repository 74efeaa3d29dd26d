// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/print_columns.hpp"

#include "emit/spell.hpp"
#include "graph/calculus/substitute.hpp"
#include "graph/core/operators.hpp"
#include "text/comma_list.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

namespace {

/// Rows of a kernel by directions, cut where they begin to depend on these.
struct Sweep {
    Graph graph;
    std::vector<NodeId> known;            ///< nodes free of the directions that the rest reads
    std::vector<std::size_t> rows;        ///< that have entries
    std::vector<NodeId> tangents;         ///< one a row of `rows`, with an input in the place of each of `known`
    std::map<NodeId, std::string> inputs; ///< the names of those, and of the directions
};

bool is_known(const Graph& graph, NodeId id)
{
    return graph.is_constant(id) || graph.op(id) == Op::pi;
}

/// What the nodes that depend on directions read of the others, a matrix by its entries; ascending.
std::vector<NodeId> read_by(const Graph& graph, const std::vector<NodeId>& nodes, const std::vector<bool>& moves)
{
    std::set<NodeId> read;
    const auto add = [&](NodeId id) {
        if (!moves[id] && !is_known(graph, id)) read.insert(id);
    };
    for (const NodeId id : nodes) {
        if (!moves[id]) continue;
        for (const NodeId operand : graph.operands(id))
            if (graph.op(operand) != Op::factor)
                add(operand);
            else
                std::ranges::for_each(graph.operands(operand), add);
    }
    return {read.begin(), read.end()};
}

Sweep sweep_of(const KernelModule& module, const Kernel& kernel)
{
    Sweep sweep{*module.graph, {}, {}, {}, {}};
    Graph& graph = sweep.graph;
    std::map<std::size_t, NodeId> tangents;
    for (const KernelEntry& entry : kernel.outputs[0].entries) tangents[entry.row] = entry.node;
    std::vector<NodeId> outputs;
    for (const auto& [row, node] : tangents) {
        sweep.rows.push_back(row);
        outputs.push_back(node);
    }
    const std::vector<NodeId> nodes = reachable(graph, outputs);
    const std::vector<bool> moves = depends_on(graph, kernel.directions);
    sweep.known = read_by(graph, nodes, moves);
    Rebuilder map(graph, nodes.empty() ? 0 : std::size_t{nodes.back()} + 1);
    for (std::size_t k = 0; k < sweep.known.size(); ++k) {
        const NodeId place = graph.input(fmt::format("known {}", k));
        sweep.inputs[place] = fmt::format("known[{}]", k);
        map.set(sweep.known[k], place);
    }
    for (const NodeId id : nodes)
        if (moves[id] || is_known(graph, id)) map.rebuild(id);
    for (const NodeId node : outputs) sweep.tangents.push_back(map[node]);
    for (std::size_t c = 0; c < kernel.directions.size(); ++c)
        sweep.inputs[kernel.directions[c]] = fmt::format("v[{}]", c);
    return sweep;
}

void print_private(TextBlock& out, const std::string& comment, const Body& body, const FunctionRequest& request)
{
    print_parts(out, body, request);
    out.indent(-1);
    out.line("private:");
    out.indent(1);
    out.comment(comment);
    open_block(out, fmt::format("void {}({}) const noexcept", request.name, arguments_of(body, request)));
    print_lines(out, body, request);
    close_block(out);
    out.indent(-1);
    out.line("public:");
    out.indent(1);
    out.blank();
}

} // namespace

std::vector<std::string> print_columns(TextBlock& out, const KernelModule& module, const ModuleNames& names,
                                       const Kernel& kernel, std::size_t longest_part, Includes& includes)
{
    const Sweep sweep = sweep_of(module, kernel);
    const KernelOutput& output = kernel.outputs[0];
    const std::string known = fmt::format("std::array<S, {}>", sweep.known.size());
    const std::string point = kernel.name + "_point", columns = kernel.name + "_sweep";
    const auto add = [&](const Body& body) { includes.merge(includes_of(body)); };
    includes.insert("lagen/lanes/columns.hpp");

    const Body before =
        write_body({*module.graph, names.locals, sweep.known, {}, names.moving, Checking::none, {}, longest_part});
    add(before);
    print_private(out, fmt::format("What {} reads: all that is the same for every column.", columns), before,
                  {module,
                   names,
                   point,
                   false,
                   kernel.inputs,
                   {{known, "known", !sweep.known.empty()}},
                   [](std::size_t k, const std::string& value) { return fmt::format("known[{}] = {};", k, value); }});

    ModuleNames inside = names;
    inside.locals.inputs = sweep.inputs;
    const Body body = write_body(
        {sweep.graph, inside.locals, sweep.tangents, {}, {}, Checking::none, {}, longest_part, {}, "columns_t<S>"});
    add(body);
    const std::vector<OutputArgument> arguments = {
        {"const " + known, "known", !sweep.known.empty()},
        {fmt::format("const std::array<columns_t<S>, {}>", output.shape.columns), "v", !sweep.rows.empty()},
        {fmt::format("std::array<columns_t<S>, {}>", output.shape.rows), "dv", !sweep.rows.empty()}};
    print_private(out, "Several columns: dv, by rows, along unit vectors v.", body,
                  {module, inside, columns, false, {}, arguments, [&](std::size_t k, const std::string& value) {
                       return fmt::format("dv[{}] = {};", sweep.rows[k], value);
                   }});

    std::vector<std::string> arguments_of_point;
    for (const KernelInput& input : kernel.inputs) arguments_of_point.push_back(input.name);
    arguments_of_point.emplace_back("known");
    return {known + " known;", fmt::format("{}({});", point, comma_list(arguments_of_point)),
            fmt::format("sweep_columns<S, {}, {}, {}_rows, {}_columns>(", output.shape.rows, output.shape.columns,
                        kernel.name, kernel.name),
            fmt::format("    values, [&](const auto& v, auto& dv) {{ {}(known, v, dv); }});", columns)};
}

} // namespace lagen
