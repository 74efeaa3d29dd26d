// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/print_kernel.hpp"

#include "emit/print_function.hpp"
#include "emit/print_series.hpp"
#include "emit/spell.hpp"
#include "graph/calculus/substitute.hpp"
#include "graph/core/operators.hpp"
#include "text/comma_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

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

/// Steps of a part of a long function. Compilers are linear in the length of such parts.
constexpr std::size_t longest_part = 500;

constexpr std::size_t longest_comment = 100; ///< bytes of a line of conditions

/// Beyond this many rows or columns no dense Jacobian is offered: Eigen keeps fixed-size matrices on the stack.
constexpr std::size_t largest_dense = 32;

bool is_full(const KernelOutput& output)
{
    return output.entries.size() == output.shape.rows * output.shape.columns;
}

std::string matrix_type(const ArrayShape& shape)
{
    return fmt::format("Eigen::Matrix<S, {}, {}>", shape.rows, shape.columns);
}

std::string type_of(const KernelOutput& output, bool by_value)
{
    if (output.sparse) return fmt::format("std::array<S, {}>", output.entries.size());
    if (output.shape.rank == 0) return "S";
    return has_lanes(output.role) && !by_value ? "State" : matrix_type(output.shape);
}

/// The place of the entry `k` of an output that is called `name`.
std::string place_of(const KernelOutput& output, const std::string& name, std::size_t k)
{
    if (output.sparse) return fmt::format("{}[{}]", name, k);
    const KernelEntry& entry = output.entries[k];
    if (output.shape.rank == 0) return name;
    return output.shape.rank == 1 ? fmt::format("{}[{}]", name, entry.row)
                                  : fmt::format("{}({}, {})", name, entry.row, entry.column);
}

/// By rows and by columns, from either end; which is best depends on the recursion behind them. The entries of a vector
/// stand in their order.
std::vector<std::vector<std::size_t>> arrangements_of(const Kernel& kernel)
{
    if (kernel.outputs.size() != 1 || kernel.outputs[0].shape.columns < 2) return {};
    const std::vector<KernelEntry>& entries = kernel.outputs[0].entries;
    std::vector<std::size_t> given(entries.size());
    std::iota(given.begin(), given.end(), std::size_t{0});
    std::vector<std::size_t> by_columns = given;
    std::ranges::stable_sort(by_columns, {}, [&](std::size_t k) { return entries[k].column; });
    return {by_columns, {by_columns.rbegin(), by_columns.rend()}, {given.rbegin(), given.rend()}};
}

/// A kernel as a function, by the rule of graph/kernel.hpp.
class KernelPrinter {
  public:
    /// `lines`: what stands in the place of the body, where that is not empty.
    KernelPrinter(TextBlock& out, const KernelModule& module, const ModuleNames& names, const Kernel& kernel,
                  const Body& body, std::vector<std::string> lines = {})
        : out_(out), kernel_(kernel), body_(body), lines_(std::move(lines)),
          returned_(returns_value(kernel)), request_{module,        names, kernel.name, kernel.checks.has_value(),
                                                     kernel.inputs, {},    {}}
    {
        if (is_sparse()) request_.name += "_values";
        for (const KernelOutput& output : kernel.outputs) {
            const bool used = output.shape.rows > 0 && !(output.sparse && output.entries.empty());
            request_.outputs.push_back({type_of(output, returned_), returned_ ? "result" : output.name, used,
                                        has_lanes(output.role) && !returned_});
        }
        request_.store = [this](std::size_t k, const std::string& value) { return store(k, value); };
    }

    void print()
    {
        for (const KernelOutput& output : kernel_.outputs) print_constants(output);
        print_parts(out_, body_, request_);
        for (const std::string& line : kernel_.documentation) out_.comment(line);
        if (kernel_.checks && !kernel_.checks->failures.empty() && has_checks(body_))
            out_.comment(kernel_.checks->failures);
        open_block(out_, signature());
        begin_outputs();
        for (const std::string& line : lines_) out_.line(line);
        const bool has_status = lines_.empty() && print_lines(out_, body_, request_);
        end_outputs();
        if (kernel_.checks) out_.line(has_status ? "return status;" : "return StatusOf<S>::good();");
        if (returned_ && !returns_at_once()) out_.line("return result;");
        close_block(out_);
        if (is_sparse()) print_dense();
    }

  private:
    [[nodiscard]] bool is_sparse() const { return kernel_.outputs.size() == 1 && kernel_.outputs[0].sparse; }

    /// A number of a whole body.
    [[nodiscard]] bool returns_at_once() const
    {
        return returned_ && kernel_.outputs[0].shape.rank == 0 && body_.parts.size() == 1;
    }

    [[nodiscard]] std::string signature() const
    {
        FunctionRequest arguments = request_;
        if (returned_) arguments.outputs.clear();
        const std::string type = kernel_.checks ? "[[nodiscard]] status_t<S>"
                                 : returned_    ? "[[nodiscard]] " + request_.outputs[0].type
                                                : "void";
        return fmt::format("{} {}({}) const noexcept", type, request_.name, arguments_of(body_, arguments));
    }

    [[nodiscard]] std::string store(std::size_t k, const std::string& value) const
    {
        if (returns_at_once()) return fmt::format("return {};", value);
        std::size_t output = 0;
        for (; k >= kernel_.outputs[output].entries.size(); ++output) k -= kernel_.outputs[output].entries.size();
        return fmt::format("{} = {};", place_of(kernel_.outputs[output], request_.outputs[output].name, k), value);
    }

    /// Where the entries of a sparse output stand, and the names of those of a vector.
    void print_constants(const KernelOutput& output)
    {
        const std::string name = kernel_.outputs.size() == 1 ? kernel_.name : kernel_.name + "_" + output.name;
        if (!output.entry_names.empty()) {
            std::vector<std::string> literals;
            for (const std::string& entry : output.entry_names) literals.push_back(string_literal(entry));
            out_.line(fmt::format("static constexpr std::array<const char*, {}> {}_names = {{{}}};", literals.size(),
                                  name, comma_list(literals)));
        }
        if (!output.sparse) return;
        std::vector<std::string> rows;
        std::vector<std::string> columns;
        for (const KernelEntry& entry : output.entries) {
            rows.push_back(std::to_string(entry.row));
            columns.push_back(std::to_string(entry.column));
        }
        out_.comment(fmt::format("Where the entries of {} stand, by rows, counted from 0.",
                                 is_sparse() ? request_.name : output.name));
        for (const auto& [suffix, places] : {std::pair("rows", rows), std::pair("columns", columns)})
            out_.line(fmt::format("static constexpr std::array<int, {}> {}_{} = {{{}}};", places.size(), name, suffix,
                                  comma_list(places)));
        out_.blank();
    }

    /// Zeros in arrays of which some entries are not written; those of a state wait until it has been read.
    void begin_outputs()
    {
        for (std::size_t k = 0; k < kernel_.outputs.size(); ++k) {
            const KernelOutput& output = kernel_.outputs[k];
            const auto& [type, name, used, overlaps] = request_.outputs[k];
            const bool zeros = !overlaps && !output.sparse && !is_full(output);
            if (returns_at_once()) continue;
            if (returned_)
                out_.line(!zeros                   ? fmt::format("{} {};", type, name)
                          : output.shape.rank == 0 ? fmt::format("{} {} = S(0);", type, name)
                                                   : fmt::format("{0} {1} = {0}::Zero();", type, name));
            else if (zeros)
                out_.line(output.shape.rank == 0 ? name + " = S(0);" : name + ".setZero();");
        }
    }

    void end_outputs()
    {
        if (returns_at_once() && kernel_.outputs[0].entries.empty()) out_.line("return S(0);");
        for (std::size_t k = 0; k < kernel_.outputs.size(); ++k) {
            const KernelOutput& output = kernel_.outputs[k];
            if (!request_.outputs[k].overlaps) continue;
            std::vector<bool> written(output.shape.rows, false);
            for (const KernelEntry& entry : output.entries) written[entry.row] = true;
            for (std::size_t row = 0; row < written.size(); ++row)
                if (!written[row]) out_.line(fmt::format("{}[{}] = S(0);", output.name, row));
        }
    }

    /// The sparse output as a matrix, where that is small.
    void print_dense()
    {
        const KernelOutput& output = kernel_.outputs[0];
        if (output.shape.rows > largest_dense || output.shape.columns > largest_dense) return;
        const std::string type = matrix_type(output.shape);
        std::vector<std::string> types;
        std::vector<std::string> names;
        for (const KernelInput& input : kernel_.inputs) {
            types.push_back(type_of(input) + " " + input.name);
            names.push_back(input.name);
        }
        out_.blank();
        out_.comment(
            fmt::format("The same as a dense matrix, shape ({}, {}).", output.shape.rows, output.shape.columns));
        open_block(out_, fmt::format("[[nodiscard]] {} {}({}) const noexcept", type, kernel_.name, comma_list(types)));
        out_.line(fmt::format("{} values;", request_.outputs[0].type));
        out_.line(fmt::format("{}({}, values);", request_.name, comma_list(names)));
        out_.line(fmt::format("{0} result = {0}::Zero();", type));
        if (!output.entries.empty())
            out_.line(fmt::format("for (std::size_t k = 0; k < {0}; ++k) result({1}_rows[k], {1}_columns[k]) = "
                                  "values[k];",
                                  output.entries.size(), kernel_.name));
        out_.line("return result;");
        close_block(out_);
    }

    TextBlock& out_;
    const Kernel& kernel_;
    const Body& body_;
    std::vector<std::string> lines_;
    bool returned_; ///< the output, by value
    FunctionRequest request_;
};

/// What the kernels of a module are, for the documentation of what they have in common.
const char* noun_of(ModuleKind kind)
{
    switch (kind) {
    case ModuleKind::vector_field: return "the right-hand side";
    case ModuleKind::step: return "a step";
    case ModuleKind::boundary_problem: return "the boundary problem";
    }
    throw InternalError("a module of no kind");
}

/// "left_domain unless a > 0, b > 0.", broken between conditions.
void print_conditions(TextBlock& out, const std::vector<std::string>& conditions)
{
    std::string line = "left_domain unless";
    for (const std::string& condition : conditions) {
        if (line.size() + condition.size() > longest_comment) {
            out.comment(line);
            line.clear();
        }
        line += (line.empty() ? "" : " ") + condition + (&condition == &conditions.back() ? "." : ",");
    }
    if (!conditions.empty()) out.comment(line);
}

} // namespace

void print_kernel(TextBlock& out, const KernelModule& module, const ModuleNames& names, const Kernel& kernel,
                  Includes& includes)
{
    if (kernel.recurrence) return print_series(out, module, names, kernel, includes);
    if (!kernel.directions.empty()) {
        out.blank();
        Body body; // reads everything
        body.inputs = module.graph->inputs();
        std::vector<std::string> lines = print_columns(out, module, names, kernel, longest_part, includes);
        return KernelPrinter(out, module, names, kernel, body, std::move(lines)).print();
    }
    const std::vector<NodeId> outputs = nodes_of(kernel);
    const std::vector<NodeId> pivots = kernel.checks ? kernel.checks->pivots : std::vector<NodeId>{};
    const Body body =
        write_body({*module.graph, names.locals, outputs, pivots, names.moving,
                    kernel.checks ? Checking::state : Checking::none, arrangements_of(kernel), longest_part});
    includes.merge(includes_of(body));
    out.blank();
    KernelPrinter(out, module, names, kernel, body).print();
}

void print_parameter_status(TextBlock& out, const KernelModule& module, const ModuleNames& names, Includes& includes)
{
    const std::vector<bool> moves = depends_on(*module.graph, names.moving);
    std::vector<NodeId> checked;
    const auto add = [&](NodeId id) {
        if (!moves[id] && std::ranges::find(checked, id) == checked.end()) checked.push_back(id);
    };
    for (const Kernel& kernel : module.kernels) {
        if (!kernel.checks) continue;
        for (const NodeId id : kernel.checks->pivots) add(id);
        for (const NodeId id : reachable(*module.graph, nodes_of(kernel)))
            if (module.graph->op(id) == Op::factor) add(id);
    }
    std::vector<NodeId> conditions;
    std::vector<std::string> texts;
    for (const auto& [text, node] : module.parameter_conditions) {
        conditions.push_back(node);
        texts.push_back(text);
    }
    const Body body =
        write_body({*module.graph, names.locals, conditions, checked, names.moving, Checking::parameters});
    includes.merge(includes_of(body));
    const bool checks = has_checks(body);
    const bool has_status = checks || !conditions.empty();
    out.blank();
    out.comment(fmt::format("What of {} depends on the parameters alone. Call it once after they are set; integrate() "
                            "does.",
                            noun_of(module.kind)));
    if (checks) out.comment("Answers singular_mass_matrix where a matrix or a divisor made of them has no inverse.");
    print_conditions(out, texts);
    open_block(out, "[[nodiscard]] status_t<S> parameter_status() const noexcept");
    if (has_status && !checks) out.line("auto status = StatusOf<S>::good();");
    print_lines(out, body, {module, names, "parameter_status", true, {}, {}, [](std::size_t, const std::string& value) {
                                return fmt::format("StatusOf<S>::fail(status, !({} > S(0)), Status::left_domain);",
                                                   value);
                            }});
    out.line(has_status ? "return status;" : "return StatusOf<S>::good();");
    close_block(out);
}

} // namespace lagen
