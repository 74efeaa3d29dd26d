// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/print_header.hpp"

#include "emit/print_banner.hpp"
#include "emit/print_function.hpp"
#include "emit/print_kernel.hpp"
#include "emit/spell.hpp"
#include "graph/calculus/differentiate.hpp"
#include "text/comma_list.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

namespace {

std::string unit_text(const Quantity& quantity)
{
    std::string text = comment_text(quantity.text);
    if (!quantity.unit.empty()) text += (text.empty() ? "[" : " [") + comment_text(quantity.unit) + "]";
    return text;
}

/// `S name = value; ///< text [unit]` a line, comments one below the other; above the line where it would be too long.
void print_members(TextBlock& out, const std::vector<std::string>& names, const std::vector<std::string>& values,
                   const std::vector<Quantity>& quantities)
{
    constexpr std::size_t widest = 60;
    constexpr std::size_t longest = 100; ///< code and text of a line, with room for its indentation
    out.indent(1);
    std::vector<std::string> lines;
    std::size_t width = 0;
    for (std::size_t k = 0; k < names.size(); ++k) {
        lines.push_back(fmt::format("S {} = {};", names[k], values[k]));
        if (lines.back().size() <= widest) width = std::max(width, lines.back().size());
    }
    for (std::size_t k = 0; k < names.size(); ++k) {
        const std::string text = unit_text(quantities[k]);
        const std::size_t column = std::max(lines[k].size(), width);
        const bool above = column + text.size() > longest; // a comment that is broken would not be one
        if (above && !text.empty()) out.comment(text);
        if (above || text.empty())
            out.line(lines[k]);
        else
            out.line(lines[k] + std::string(column - lines[k].size(), ' ') + " ///< " + text);
    }
    out.indent(-1);
}

std::string default_value(const KernelModule& module, NodeId node, Includes& includes)
{
    if (module.graph->is_constant(node)) return print_literal(module.graph->value(node)).text;
    const LocalNames none;
    const NodeId outputs[] = {node};
    const Body body = write_body({*module.graph, none, outputs, {}, {}, Checking::none});
    includes.merge(includes_of(body));
    std::string text = "[] { ";
    for (const std::string& declaration : using_declarations(body)) text += declaration + " ";
    for (const Statement& statement : body.parts.front()) {
        if (statement.kind == Statement::Kind::store)
            text += "return S(" + spell(statement.expressions[0]).text + "); ";
        else
            for (const std::string& line : spell(statement)) text += line + " ";
    }
    return text + "}()";
}

void print_parameters(TextBlock& out, const KernelModule& module, const ModuleNames& names, Includes& includes)
{
    out.blank();
    out.comment("Physical parameters with the defaults of the model.");
    if (names.parameters.empty()) return out.line("struct Parameters {} parameters;");
    std::vector<std::string> values;
    for (std::size_t k = 0; k < module.parameters.size(); ++k)
        values.push_back(k < module.parameter_defaults.size()
                             ? default_value(module, module.parameter_defaults[k], includes)
                             : "S(0)");
    out.line("struct Parameters {");
    print_members(out, names.parameters, values, module.parameters);
    out.line("} parameters;");
}

/// Inputs with their defaults at those of the parameters.
void print_inputs(TextBlock& out, const KernelModule& module, const ModuleNames& names, Includes& includes)
{
    if (module.inputs.empty()) return;
    std::vector<std::pair<NodeId, NodeId>> known;
    for (std::size_t k = 0; k < module.parameter_defaults.size(); ++k)
        known.emplace_back(module.parameters[k].input, module.parameter_defaults[k]);
    std::vector<std::string> values;
    for (const NodeId value : substitute(*module.graph, module.input_defaults, known))
        values.push_back(default_value(module, value, includes));
    out.blank();
    out.comment(
        "What acts from outside, with the defaults of the model: set them before each step, and they are held.");
    out.line("struct Inputs {");
    print_members(out, names.inputs, values, module.inputs);
    out.line("} inputs;");
}

void print_group(TextBlock& out, const LaneGroup& group, const std::vector<std::string>& members)
{
    if (group.lanes.empty()) return;
    out.blank();
    out.comment(group.text);
    out.line(fmt::format("struct {} {{", group.type));
    print_members(out, members, std::vector<std::string>(members.size(), "S(0)"), group.lanes);
    out.line("};");
}

/// state(base, fibre), with groups that are empty left out.
void print_state(TextBlock& out, const KernelModule& module, const ModuleNames& names)
{
    std::vector<std::string> arguments;
    for (const LaneGroup& group : module.groups)
        if (!group.lanes.empty()) arguments.push_back(fmt::format("const {}& {}", group.type, group.role));
    if (arguments.empty()) return;
    out.blank();
    out.comment("A state by names; members left out are zero.");
    open_block(out, fmt::format("[[nodiscard]] static State state({}) noexcept", comma_list(arguments)));
    out.line("State s;");
    std::size_t lane = 0;
    for (std::size_t k = 0; k < module.groups.size(); ++k)
        for (const std::string& member : names.groups[k])
            out.line(fmt::format("s[{}] = {}.{};", lane++, module.groups[k].role, member));
    out.line("return s;");
    close_block(out);
}

std::string name_array(const std::string& array, const std::vector<Quantity>& quantities)
{
    std::vector<std::string> literals;
    for (const Quantity& quantity : quantities) literals.push_back(string_literal(quantity.name));
    return fmt::format("static constexpr std::array<const char*, {}> {} = {{{}}};", literals.size(), array,
                       comma_list(literals));
}

/// The number of the parameter that is the step of a discrete motion.
std::optional<std::size_t> step_parameter(const KernelModule& module)
{
    for (const Kernel& kernel : module.kernels)
        if (module.step && kernel.name == "step")
            for (std::size_t k = 0; k < module.parameters.size(); ++k)
                if (nodes_of(kernel)[0] == module.parameters[k].input) return k;
    return {};
}

void print_constants(TextBlock& out, const KernelModule& module)
{
    const std::vector<Quantity> lanes = lanes_of(module);
    out.line("using Scalar = S;");
    out.comment("Lanes of State: base coordinates, then the others.");
    out.line(fmt::format("static constexpr int dimension = {};", lanes.size()));
    for (const LaneGroup& group : module.groups)
        out.line(fmt::format("static constexpr int {}_dimension = {};", group.role, group.lanes.size()));
    if (module.step) {
        out.line(fmt::format("static constexpr int horizontal = {};", module.step->horizontal));
        out.line(fmt::format("static constexpr int group_order = {};", module.step->order));
        out.line(fmt::format("static constexpr bool cayley = {};", module.step->cayley));
        if (const auto k = step_parameter(module))
            out.line(fmt::format("static constexpr std::size_t step_parameter = {};", *k));
    }
    if (module.second_order.kind != SecondOrder::Kind::no)
        out.line(fmt::format("static constexpr SecondOrder second_order = SecondOrder::{};",
                             module.second_order.kind == SecondOrder::Kind::general ? "general" : "velocity_free"));
    out.line(fmt::format("using State = Eigen::Matrix<S, {}, 1>;", lanes.size()));
    out.blank();
    out.line(fmt::format("static constexpr const char* model_name = {};", string_literal(module.model)));
    out.line(fmt::format("static constexpr const char* model_hash = {};", string_literal(module.hash)));
    out.line(name_array("state_names", lanes));
    out.line(name_array("parameter_names", module.parameters));
    if (!module.inputs.empty()) out.line(name_array("input_names", module.inputs));
}

void print_flows(TextBlock& out, const KernelModule& module)
{
    if (module.flows.count == 0) return;
    out.blank();
    out.comment("The flow of part 0, 1, ..; the fields of all parts add up to the right-hand side.");
    out.line(fmt::format("static constexpr int flows = {};", module.flows.count));
    out.line("template <int part>");
    open_block(out, "[[nodiscard]] status_t<S> flow(S t, const State& s, S h, State& ds) const noexcept");
    out.line("static_assert(part >= 0 && part < flows);");
    for (std::size_t k = 0; k < module.flows.count; ++k)
        out.line(fmt::format("if constexpr (part == {0}) return flow_{0}(t, s, h, ds);", k));
    close_block(out);
}

void print_group_motion(TextBlock& out, const KernelModule& module)
{
    for (const char* name : {"algebra_element", "algebra_action", "algebra_bracket"})
        if (!has_kernel(module, name)) return;
    std::vector<std::string> moved;
    for (const bool lane : module.motion.moved) moved.emplace_back(lane ? "true" : "false");
    out.blank();
    out.comment(
        "Elements of the Lie algebra of the group that moves these lanes of State, for lagen::Rkmk4 and its like.");
    out.line(fmt::format("static constexpr int algebra_dimension = {};", module.motion.dimension));
    out.line(
        fmt::format("static constexpr std::array<bool, {}> moved_by_group = {{{}}};", moved.size(), comma_list(moved)));
}

/// What keeps matrices on their groups from step to step.
void print_matrices(TextBlock& out, const KernelModule& module, Includes& includes)
{
    if (module.matrices.empty()) return;
    includes.insert("lagen/group/stay_on_group.hpp");
    std::vector<std::string> calls;
    for (std::size_t k = 0; k < module.matrices.size(); ++k) {
        const GroupLanes& matrix = module.matrices[k];
        std::vector<std::string> entries;
        for (const GroupLanes::Entry& each : matrix.generators)
            entries.push_back(
                fmt::format("{{{}, {}, {}, {}}}", each.generator, each.row, each.column, each.value.get_d()));
        out.blank();
        out.comment(fmt::format("Entries of the generators of {}, the group of {}: number, row, column, value.",
                                comment_text(matrix.group), comment_text(matrix.name)));
        out.line(fmt::format("static constexpr std::array<GroupEntry, {}> group_generators_{} = {{{{{}}}}};",
                             entries.size(), k, comma_list(entries)));
        calls.push_back(
            fmt::format("stay_on_group<{}>(group_generators_{}, s0, s1, {});", matrix.size, k, matrix.first));
    }
    out.blank();
    out.comment("Moves the matrices of s1, which a step or its interpolation reached from s0, onto their groups.");
    open_block(out, "static void stay_on_groups(const State& s0, State& s1) noexcept");
    for (const std::string& call : calls) out.line(call);
    close_block(out);
}

/// Parameters or inputs by number, for programs that know them by their names only. `what`: "parameter".
void print_access(TextBlock& out, const std::string& what, const char* type, const std::vector<std::string>& names)
{
    if (names.empty()) return;
    std::vector<std::string> members;
    for (const std::string& name : names) members.push_back(fmt::format("&{}::{}", type, name));
    out.blank();
    out.comment(fmt::format("The {0} {0}_names[k], k < {0}_names.size().", what));
    out.line(fmt::format("[[nodiscard]] S& {}(std::size_t k) noexcept", what));
    out.line("{");
    out.indent(1);
    out.line(
        fmt::format("constexpr std::array<S {}::*, {}> members = {{{}}};", type, members.size(), comma_list(members)));
    out.line(fmt::format("return {}s.*members[k];", what));
    out.indent(-1);
    out.line("}");
}

} // namespace

std::string print_header(const KernelModule& module)
{
    const ModuleNames names = name_module(module);
    Includes includes;
    TextBlock kernels;
    kernels.indent(1);
    print_constants(kernels, module);
    print_parameters(kernels, module, names, includes);
    print_access(kernels, "parameter", "Parameters", names.parameters);
    print_inputs(kernels, module, names, includes);
    print_access(kernels, "input", "Inputs", names.inputs);
    print_guess(kernels, module, names);
    for (std::size_t k = 0; k < module.groups.size(); ++k) print_group(kernels, module.groups[k], names.groups[k]);
    print_state(kernels, module, names);
    print_parameter_status(kernels, module, names, includes);
    for (const ImplicitBlock& block : module.implicit) print_implicit(kernels, module, names, block, includes);
    print_follow(kernels, module, names);
    for (const Kernel& kernel : module.kernels) print_kernel(kernels, module, names, kernel, includes);
    print_group_motion(kernels, module);
    print_flows(kernels, module);
    print_matrices(kernels, module, includes);

    TextBlock out;
    print_banner(out, module);
    out.line("#pragma once");
    out.blank();
    out.line("#include \"lagen/kernel.hpp\"");
    for (const std::string& include : includes) out.line(fmt::format("#include \"{}\"", include));
    out.blank();
    for (const char* header : {"Eigen/Core", "array", "cmath", "cstddef"}) {
        out.line(fmt::format("#include <{}>", header));
        if (std::string_view(header) == "Eigen/Core") out.blank();
    }
    out.blank();
    out.line("namespace lagen::models {");
    out.blank();
    out.comment(module.title.empty() ? module.model : comment_text(module.title));
    out.line("template <class S>");
    out.line(fmt::format("class {} {{", names.class_name));
    out.line("  public:");
    std::string text = out.text() + kernels.text();
    text += "};\n\n} // namespace lagen::models\n";
    return text;
}

} // namespace lagen
