// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/print_kernel.hpp"

#include "emit/spell.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

namespace {

/// Beyond this many rows or columns no dense Jacobian is offered: Eigen keeps fixed-size matrices on the stack.
constexpr std::size_t largest_dense = 32;

std::vector<NodeId> outputs_of(const Kernel& kernel)
{
    std::vector<NodeId> nodes;
    for (const KernelEntry& entry : kernel.output.entries) nodes.push_back(entry.node);
    return nodes;
}

std::string maybe_unused(bool used)
{
    return used ? "" : "[[maybe_unused]] ";
}

bool reads(const Body& body, NodeId id)
{
    return std::ranges::count(body.inputs, id) > 0;
}

/// The blocks whose unknowns the body reads.
std::vector<const ImplicitBlock*> blocks_of(const Body& body, const KernelModule& module)
{
    std::vector<const ImplicitBlock*> blocks;
    for (const ImplicitBlock& block : module.implicit)
        if (std::ranges::any_of(block.unknowns, [&](NodeId id) { return reads(body, id); })) blocks.push_back(&block);
    return blocks;
}

bool reads_lane(const Body& body, const KernelModule& module)
{
    const auto any = [&](const std::vector<Quantity>& group) {
        return std::ranges::any_of(group, [&](const Quantity& q) { return reads(body, q.input); });
    };
    return any(module.base) || any(module.fibre);
}

bool reads_state(const Body& body, const KernelModule& module)
{
    return reads_lane(body, module) || !blocks_of(body, module).empty();
}

/// "S t, const State& s" with what the body leaves unread marked.
std::string arguments(const Body& body, const KernelModule& module)
{
    return fmt::format("{}S t, {}const State& s",
                       maybe_unused(reads(body, module.time) || !blocks_of(body, module).empty()),
                       maybe_unused(reads_state(body, module)));
}

void load(TextBlock& out, const Body& body, const ModuleNames& names, const KernelModule& module)
{
    std::size_t lane = 0;
    for (const auto* group : {&module.base, &module.fibre})
        for (const Quantity& quantity : *group) {
            if (reads(body, quantity.input))
                out.line(fmt::format("const S {} = s[{}];", names.locals.inputs.at(quantity.input), lane));
            ++lane;
        }
    for (std::size_t k = 0; k < module.parameters.size(); ++k) {
        const NodeId input = module.parameters[k].input;
        if (reads(body, input))
            out.line(fmt::format("const S {} = parameters.{};", names.locals.inputs.at(input), names.parameters[k]));
    }
}

/// Solves the implicit blocks that the body reads; answers whether a `status` was declared.
bool solve_blocks(TextBlock& out, const Body& body, const ModuleNames& names, const KernelModule& module,
                  bool returns_status)
{
    bool declared = false;
    for (const ImplicitBlock* block : blocks_of(body, module)) {
        out.line(fmt::format("std::array<S, {}> solved_{};", block->unknowns.size(), block->name));
        const std::string call = fmt::format("solve_{}(t, s, solved_{})", block->name, block->name);
        if (!returns_status)
            out.line(fmt::format("static_cast<void>({});", call));
        else if (declared)
            out.line(fmt::format("status = StatusOf<S>::first(status, {});", call));
        else
            out.line(fmt::format("{} status = {};", body.has_status ? "auto" : "const auto", call));
        declared = declared || returns_status;
        for (std::size_t k = 0; k < block->unknowns.size(); ++k)
            if (reads(body, block->unknowns[k]))
                out.line(fmt::format("const S {} = solved_{}[{}];", names.locals.inputs.at(block->unknowns[k]),
                                     block->name, k));
    }
    return declared;
}

/// Everything up to the stores. Answers whether a `status` was declared.
bool print_statements(TextBlock& out, const Body& body, const ModuleNames& names, const KernelModule& module,
                      bool returns_status = false)
{
    for (const std::string& function : body.functions) out.line(using_declaration(function));
    load(out, body, names, module);
    bool declared = solve_blocks(out, body, names, module, returns_status);
    if (body.has_status && !declared) out.line("auto status = StatusOf<S>::good();");
    declared = declared || body.has_status;
    for (const std::string& statement : body.statements) out.line(statement);
    return declared;
}

void print_documentation(TextBlock& out, const Kernel& kernel)
{
    for (const std::string& line : kernel.documentation) out.comment(line);
}

void open(TextBlock& out, const std::string& signature)
{
    if (!signature.empty()) out.line(signature);
    out.line("{");
    out.indent(1);
}

void close(TextBlock& out)
{
    out.indent(-1);
    out.line("}");
}

bool is_full(const KernelOutput& output)
{
    return output.entries.size() == output.rows * output.columns;
}

void print_right_hand_side(TextBlock& out, const KernelModule& module, const Kernel& kernel, const Body& body,
                           const ModuleNames& names)
{
    const std::string& target = kernel.output.name;
    const bool writes = kernel.output.rows > 0;
    open(out, fmt::format("[[nodiscard]] status_t<S> {}({}, {}State& {}) const noexcept", kernel.name,
                          arguments(body, module), maybe_unused(writes), target));
    const bool has_status = print_statements(out, body, names, module, true);
    std::vector<std::string> values(kernel.output.rows, "S(0)");
    for (std::size_t k = 0; k < body.values.size(); ++k) values[kernel.output.entries[k].row] = body.values[k];
    for (std::size_t row = 0; row < values.size(); ++row)
        out.line(fmt::format("{}[{}] = {};", target, row, values[row]));
    out.line(has_status ? "return status;" : "return StatusOf<S>::good();");
    close(out);
}

/// The directional derivative along v.
void print_directional(TextBlock& out, const KernelModule& module, const Kernel& kernel, const Body& body,
                       const ModuleNames& names)
{
    const bool reads_v =
        std::ranges::any_of(module.direction, [&](const Quantity& entry) { return reads(body, entry.input); });
    const bool writes = kernel.output.rows > 0;
    open(out, fmt::format("[[nodiscard]] status_t<S> {}({}, {}const State& v, {}State& {}) const noexcept", kernel.name,
                          arguments(body, module), maybe_unused(reads_v), maybe_unused(writes), kernel.output.name));
    for (std::size_t lane = 0; lane < module.direction.size(); ++lane)
        if (reads(body, module.direction[lane].input))
            out.line(fmt::format("const S {} = v[{}];", names.locals.inputs.at(module.direction[lane].input), lane));
    const bool has_status = print_statements(out, body, names, module, true);
    for (std::size_t k = 0; k < body.values.size(); ++k)
        out.line(fmt::format("{}[{}] = {};", kernel.output.name, kernel.output.entries[k].row, body.values[k]));
    out.line(has_status ? "return status;" : "return StatusOf<S>::good();");
    close(out);
}

void print_scalar(TextBlock& out, const KernelModule& module, const Kernel& kernel, const Body& body,
                  const ModuleNames& names)
{
    open(out, fmt::format("[[nodiscard]] S {}({}) const noexcept", kernel.name, arguments(body, module)));
    print_statements(out, body, names, module);
    out.line(fmt::format("return {};", body.values.empty() ? "S(0)" : body.values.front()));
    close(out);
}

/// A name array where entries have names, and a column or a matrix by value.
void print_array(TextBlock& out, const KernelModule& module, const Kernel& kernel, const Body& body,
                 const ModuleNames& names)
{
    const KernelOutput& output = kernel.output;
    const bool column = kernel.shape == KernelShape::vector;
    const std::string type = fmt::format("Eigen::Matrix<S, {}, {}>", output.rows, column ? 1 : output.columns);
    open(out, fmt::format("[[nodiscard]] {} {}({}) const noexcept", type, kernel.name, arguments(body, module)));
    print_statements(out, body, names, module);
    out.line(is_full(output) ? type + " result;" : fmt::format("{} result = {}::Zero();", type, type));
    for (std::size_t k = 0; k < body.values.size(); ++k) {
        const KernelEntry& entry = output.entries[k];
        out.line(column ? fmt::format("result[{}] = {};", entry.row, body.values[k])
                        : fmt::format("result({}, {}) = {};", entry.row, entry.column, body.values[k]));
    }
    out.line("return result;");
    close(out);
}

void print_pattern(TextBlock& out, const Kernel& kernel)
{
    std::vector<std::string> rows;
    std::vector<std::string> columns;
    for (const KernelEntry& entry : kernel.output.entries) {
        rows.push_back(std::to_string(entry.row));
        columns.push_back(std::to_string(entry.column));
    }
    out.comment(fmt::format("Where the entries of {}_values stand, by rows, counted from 0.", kernel.name));
    out.line(
        fmt::format("static constexpr std::array<int, {}> {}_rows = {{{}}};", rows.size(), kernel.name, joined(rows)));
    out.line(fmt::format("static constexpr std::array<int, {}> {}_columns = {{{}}};", rows.size(), kernel.name,
                         joined(columns)));
    out.blank();
}

void print_dense(TextBlock& out, const Kernel& kernel)
{
    const std::string type = fmt::format("Eigen::Matrix<S, {}, {}>", kernel.output.rows, kernel.output.columns);
    const std::size_t count = kernel.output.entries.size();
    out.blank();
    out.comment(fmt::format("The same as a dense matrix, shape ({}, {}).", kernel.output.rows, kernel.output.columns));
    open(out, fmt::format("[[nodiscard]] {} {}(S t, const State& s) const noexcept", type, kernel.name));
    out.line(fmt::format("std::array<S, {}> values;", count));
    out.line(fmt::format("{}_values(t, s, values);", kernel.name));
    out.line(fmt::format("{} result = {}::Zero();", type, type));
    if (count > 0)
        out.line(fmt::format("for (std::size_t k = 0; k < {}; ++k) result({}_rows[k], {}_columns[k]) = values[k];",
                             count, kernel.name, kernel.name));
    out.line("return result;");
    close(out);
}

void print_sparse(TextBlock& out, const KernelModule& module, const Kernel& kernel, const Body& body,
                  const ModuleNames& names)
{
    const std::size_t count = kernel.output.entries.size();
    print_pattern(out, kernel);
    print_documentation(out, kernel);
    open(out, fmt::format("void {}_values({}, {}std::array<S, {}>& values) const noexcept", kernel.name,
                          arguments(body, module), maybe_unused(count > 0), count));
    print_statements(out, body, names, module);
    for (std::size_t k = 0; k < count; ++k) out.line(fmt::format("values[{}] = {};", k, body.values[k]));
    close(out);
    if (kernel.output.rows <= largest_dense && kernel.output.columns <= largest_dense) print_dense(out, kernel);
}

void print_entry_names(TextBlock& out, const Kernel& kernel)
{
    if (kernel.entry_names.empty()) return;
    std::vector<std::string> literals;
    for (const std::string& name : kernel.entry_names) literals.push_back(string_literal(name));
    out.line(fmt::format("static constexpr std::array<const char*, {}> {}_names = {{{}}};", literals.size(),
                         kernel.name, joined(literals)));
}

} // namespace

void print_kernel(TextBlock& out, const KernelModule& module, const ModuleNames& names, const Kernel& kernel,
                  KernelNeeds& needs)
{
    const std::vector<NodeId> outputs = outputs_of(kernel);
    const bool has_status = kernel.shape == KernelShape::right_hand_side || kernel.shape == KernelShape::directional;
    LocalNames locals = names.locals;
    locals.taken.insert(kernel.output.name);
    const Body body = print_body(
        {*module.graph, locals, outputs, kernel.pivots, names.moving, has_status ? Checking::state : Checking::none});
    needs.linear = needs.linear || body.has_status || body.has_pivoting;
    out.blank();
    print_entry_names(out, kernel);
    if (kernel.shape != KernelShape::sparse) print_documentation(out, kernel);
    switch (kernel.shape) {
    case KernelShape::right_hand_side: return print_right_hand_side(out, module, kernel, body, names);
    case KernelShape::scalar: return print_scalar(out, module, kernel, body, names);
    case KernelShape::vector:
    case KernelShape::matrix: return print_array(out, module, kernel, body, names);
    case KernelShape::sparse: return print_sparse(out, module, kernel, body, names);
    case KernelShape::directional: return print_directional(out, module, kernel, body, names);
    }
}

void print_parameter_status(TextBlock& out, const KernelModule& module, const ModuleNames& names, KernelNeeds& needs)
{
    const std::vector<bool> moves = depends_on(*module.graph, names.moving);
    std::vector<NodeId> checked;
    const auto add = [&](NodeId id) {
        if (!moves[id] && std::ranges::find(checked, id) == checked.end()) checked.push_back(id);
    };
    for (const Kernel& kernel : module.kernels) {
        if (kernel.shape != KernelShape::right_hand_side) continue;
        for (const NodeId id : kernel.pivots) add(id);
        for (const NodeId id : reachable(*module.graph, outputs_of(kernel)))
            if (module.graph->op(id) == Op::factor) add(id);
    }
    const Body body = print_body({*module.graph, names.locals, {}, checked, names.moving, Checking::parameters});
    needs.linear = needs.linear || body.has_status || body.has_pivoting;
    out.blank();
    out.comment("What of the right-hand side depends on the parameters alone: singular_mass_matrix where a matrix or a "
                "divisor");
    out.comment("made of them has no inverse. Call it once after the parameters are set; integrate() does.");
    open(out, "[[nodiscard]] status_t<S> parameter_status() const noexcept");
    print_statements(out, body, names, module);
    out.line(body.has_status ? "return status;" : "return StatusOf<S>::good();");
    close(out);
}

void print_implicit(TextBlock& out, const KernelModule& module, const ModuleNames& names, const ImplicitBlock& block,
                    KernelNeeds& needs)
{
    const std::size_t size = block.unknowns.size();
    std::vector<NodeId> inner = block.residuals;
    inner.insert(inner.end(), block.jacobian.begin(), block.jacobian.end());
    const auto body_of = [&](const std::vector<NodeId>& outputs) {
        return print_body({*module.graph, names.locals, outputs, {}, names.moving, Checking::none});
    };
    const Body guess = body_of(block.guess);
    Body iteration = body_of(inner);
    needs.linear = needs.newton = true;
    out.blank();
    out.comment(block.documentation);
    out.comment("By Newton's method; answers newton_diverged, and NaN in z, where it finds no solution to round-off.");
    const bool reads_time = reads(guess, module.time) || reads(iteration, module.time);
    const bool reads_lanes = reads_lane(guess, module) || reads_lane(iteration, module);
    open(out, fmt::format("[[nodiscard]] status_t<S> solve_{}({}S t, {}const State& s, std::array<S, {}>& z) const "
                          "noexcept",
                          block.name, maybe_unused(reads_time), maybe_unused(reads_lanes), size));
    open(out, "");
    print_statements(out, guess, names, module);
    for (std::size_t k = 0; k < size; ++k) out.line(fmt::format("z[{}] = {};", k, guess.values[k]));
    close(out);
    out.line(fmt::format("return newton(z, [&](const std::array<S, {0}>& unknowns, std::array<S, {0}>& residual, "
                         "std::array<S, {1}>& derivative) noexcept {{",
                         size, size * size));
    out.indent(1);
    for (std::size_t k = 0; k < size; ++k)
        if (reads(iteration, block.unknowns[k]))
            out.line(fmt::format("const S {} = unknowns[{}];", names.locals.inputs.at(block.unknowns[k]), k));
    std::erase_if(iteration.inputs, [&](NodeId id) { return std::ranges::count(block.unknowns, id) > 0; });
    print_statements(out, iteration, names, module);
    for (std::size_t k = 0; k < inner.size(); ++k)
        out.line(k < size ? fmt::format("residual[{}] = {};", k, iteration.values[k])
                          : fmt::format("derivative[{}] = {};", k - size, iteration.values[k]));
    out.indent(-1);
    out.line("});");
    close(out);
}

} // namespace lagen
