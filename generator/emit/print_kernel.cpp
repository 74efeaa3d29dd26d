// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/print_kernel.hpp"

#include "emit/print_function.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace lagen {

namespace {

/// Steps of a part of a long function. Compilers are linear in the length of such parts.
constexpr std::size_t longest_part = 500;

constexpr std::size_t longest_comment = 100; ///< bytes of a line of conditions

/// Beyond this many rows or columns no dense Jacobian is offered: Eigen keeps fixed-size matrices on the stack.
constexpr std::size_t largest_dense = 32;

std::vector<NodeId> outputs_of(const Kernel& kernel)
{
    std::vector<NodeId> nodes;
    for (const KernelEntry& entry : kernel.output.entries) nodes.push_back(entry.node);
    return nodes;
}

void print_documentation(TextBlock& out, const Kernel& kernel)
{
    for (const std::string& line : kernel.documentation) out.comment(line);
}

bool is_full(const KernelOutput& output)
{
    return output.entries.size() == output.rows * output.columns;
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
    open_block(out, fmt::format("[[nodiscard]] {} {}(S t, const State& s) const noexcept", type, kernel.name));
    out.line(fmt::format("std::array<S, {}> values;", count));
    out.line(fmt::format("{}_values(t, s, values);", kernel.name));
    out.line(fmt::format("{} result = {}::Zero();", type, type));
    if (count > 0)
        out.line(fmt::format("for (std::size_t k = 0; k < {}; ++k) result({}_rows[k], {}_columns[k]) = values[k];",
                             count, kernel.name, kernel.name));
    out.line("return result;");
    close_block(out);
}

void print_entry_names(TextBlock& out, const Kernel& kernel)
{
    if (kernel.entry_names.empty()) return;
    std::vector<std::string> literals;
    for (const std::string& name : kernel.entry_names) literals.push_back(string_literal(name));
    out.line(fmt::format("static constexpr std::array<const char*, {}> {}_names = {{{}}};", literals.size(),
                         kernel.name, joined(literals)));
}

/// By rows and by columns, from either end; which is best depends on the recursion behind them. The entries of a vector
/// stand in their order.
std::vector<std::vector<std::size_t>> arrangements_of(const KernelOutput& output)
{
    if (output.columns < 2) return {};
    std::vector<std::size_t> by_columns(output.entries.size());
    std::iota(by_columns.begin(), by_columns.end(), std::size_t{0});
    std::ranges::stable_sort(by_columns, {}, [&](std::size_t k) { return output.entries[k].column; });
    std::vector<std::vector<std::size_t>> orders = {by_columns};
    std::vector<std::size_t> given(by_columns.size());
    std::iota(given.begin(), given.end(), std::size_t{0});
    orders.emplace_back(by_columns.rbegin(), by_columns.rend());
    orders.emplace_back(given.rbegin(), given.rend());
    return orders;
}

/// What all shapes of kernels have in common.
class KernelPrinter {
  public:
    KernelPrinter(TextBlock& out, const KernelModule& module, const ModuleNames& names, const Kernel& kernel,
                  const Body& body)
        : out_(out), module_(module), names_(names), kernel_(kernel), body_(body)
    {
    }

    void print()
    {
        switch (kernel_.shape) {
        case KernelShape::right_hand_side:
        case KernelShape::directional: return print_derivative();
        case KernelShape::scalar: return print_scalar();
        case KernelShape::vector:
        case KernelShape::matrix: return print_array();
        case KernelShape::sparse: return print_sparse();
        }
    }

  private:
    [[nodiscard]] FunctionRequest request(const std::string& output) const
    {
        FunctionRequest request{module_, names_, kernel_.name, false, false, output, false, {}, nullptr};
        return request;
    }

    [[nodiscard]] std::string arguments() const { return state_arguments(body_, module_); }

    /// Of the state, or of a perturbation of it along v.
    void print_derivative()
    {
        const bool directional = kernel_.shape == KernelShape::directional;
        const std::string& target = kernel_.output.name;
        FunctionRequest function = request("State& " + target);
        function.returns_status = function.output_is_state = true;
        function.reads_direction = directional;
        function.store = [&](std::size_t k, const std::string& value) {
            return fmt::format("{}[{}] = {};", target, kernel_.output.entries[k].row, value);
        };
        print_parts(out_, body_, function);
        print_documentation(out_, kernel_);
        const bool reads_v =
            body_.parts.size() > 1 ||
            std::ranges::any_of(module_.direction, [&](const Quantity& entry) { return reads(body_, entry.input); });
        open_block(out_, fmt::format("[[nodiscard]] status_t<S> {}({}, {}{}State& {}) const noexcept", kernel_.name,
                                     arguments(), directional ? maybe_unused(reads_v) + "const State& v, " : "",
                                     maybe_unused(kernel_.output.rows > 0), target));
        const bool has_status = print_lines(out_, body_, function);
        std::vector<bool> written(kernel_.output.rows, false);
        for (const KernelEntry& entry : kernel_.output.entries) written[entry.row] = true;
        for (std::size_t row = 0; row < written.size(); ++row)
            if (!written[row]) out_.line(fmt::format("{}[{}] = S(0);", target, row));
        out_.line(has_status ? "return status;" : "return StatusOf<S>::good();");
        close_block(out_);
    }

    void print_scalar()
    {
        const bool whole = body_.parts.size() == 1;
        FunctionRequest function = request("S& result");
        function.store = [&](std::size_t, const std::string& value) {
            return fmt::format("{} {};", whole ? "return" : "result =", value);
        };
        print_parts(out_, body_, function);
        print_documentation(out_, kernel_);
        open_block(out_, fmt::format("[[nodiscard]] S {}({}) const noexcept", kernel_.name, arguments()));
        if (!whole) out_.line("S result;");
        print_lines(out_, body_, function);
        if (kernel_.output.entries.empty()) out_.line("return S(0);");
        if (!whole) out_.line("return result;");
        close_block(out_);
    }

    /// A column or a matrix by value.
    void print_array()
    {
        const KernelOutput& output = kernel_.output;
        const bool column = kernel_.shape == KernelShape::vector;
        const std::string type = fmt::format("Eigen::Matrix<S, {}, {}>", output.rows, column ? 1 : output.columns);
        FunctionRequest function = request(type + "& result");
        function.store = [&](std::size_t k, const std::string& value) {
            const KernelEntry& entry = output.entries[k];
            return column ? fmt::format("result[{}] = {};", entry.row, value)
                          : fmt::format("result({}, {}) = {};", entry.row, entry.column, value);
        };
        print_parts(out_, body_, function);
        print_documentation(out_, kernel_);
        open_block(out_, fmt::format("[[nodiscard]] {} {}({}) const noexcept", type, kernel_.name, arguments()));
        out_.line(is_full(output) ? type + " result;" : fmt::format("{} result = {}::Zero();", type, type));
        print_lines(out_, body_, function);
        out_.line("return result;");
        close_block(out_);
    }

    void print_sparse()
    {
        const std::size_t count = kernel_.output.entries.size();
        print_pattern(out_, kernel_);
        FunctionRequest function = request(fmt::format("std::array<S, {}>& values", count));
        function.name += "_values";
        function.store = [](std::size_t k, const std::string& value) {
            return fmt::format("values[{}] = {};", k, value);
        };
        print_parts(out_, body_, function);
        print_documentation(out_, kernel_);
        open_block(out_, fmt::format("void {}({}, {}std::array<S, {}>& values) const noexcept", function.name,
                                     arguments(), maybe_unused(count > 0), count));
        print_lines(out_, body_, function);
        close_block(out_);
        if (kernel_.output.rows <= largest_dense && kernel_.output.columns <= largest_dense) print_dense(out_, kernel_);
    }

    TextBlock& out_;
    const KernelModule& module_;
    const ModuleNames& names_;
    const Kernel& kernel_;
    const Body& body_;
};

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
                  KernelNeeds& needs)
{
    const std::vector<NodeId> outputs = outputs_of(kernel);
    const bool has_status = kernel.shape == KernelShape::right_hand_side || kernel.shape == KernelShape::directional;
    LocalNames locals = names.locals;
    locals.taken.insert(kernel.output.name);
    BodyRequest request{*module.graph,
                        locals,
                        outputs,
                        kernel.pivots,
                        names.moving,
                        has_status ? Checking::state : Checking::none,
                        arrangements_of(kernel.output),
                        longest_part};
    const Body body = print_body(request);
    needs.linear = needs.linear || body.has_status || body.has_pivoting;
    out.blank();
    print_entry_names(out, kernel);
    KernelPrinter(out, module, names, kernel, body).print();
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
    std::vector<NodeId> conditions;
    std::vector<std::string> texts;
    for (const auto& [text, node] : module.parameter_conditions) {
        conditions.push_back(node);
        texts.push_back(text);
    }
    const Body body =
        print_body({*module.graph, names.locals, conditions, checked, names.moving, Checking::parameters});
    needs.linear = needs.linear || body.has_status || body.has_pivoting;
    const bool has_status = body.has_status || !conditions.empty();
    out.blank();
    out.comment("What of the right-hand side depends on the parameters alone: singular_mass_matrix where a matrix or a "
                "divisor");
    out.comment("made of them has no inverse. Call it once after the parameters are set; integrate() does.");
    print_conditions(out, texts);
    open_block(out, "[[nodiscard]] status_t<S> parameter_status() const noexcept");
    if (has_status && !body.has_status) out.line("auto status = StatusOf<S>::good();");
    print_lines(out, body,
                {module, names, "parameter_status", true, false, "", false,
                 [](std::size_t, const std::string& value) {
                     return fmt::format("StatusOf<S>::fail(status, !({} > S(0)), Status::left_domain);", value);
                 },
                 nullptr});
    out.line(has_status ? "return status;" : "return StatusOf<S>::good();");
    close_block(out);
}

} // namespace lagen
