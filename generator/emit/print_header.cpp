// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/print_header.hpp"

#include "emit/print_banner.hpp"
#include "emit/print_kernel.hpp"

#include <fmt/format.h>

namespace lagen {

namespace {

std::string unit_text(const Quantity& quantity)
{
    std::string text = comment_text(quantity.text);
    if (!quantity.unit.empty()) text += (text.empty() ? "[" : " [") + comment_text(quantity.unit) + "]";
    return text.empty() ? "" : " ///< " + text;
}

/// `S name = value; ///< text [unit]`. A default that is not a rational number is computed in the scalar itself.
void print_member(TextBlock& out, const std::string& name, const std::string& value, const Quantity& quantity)
{
    out.line(fmt::format("S {} = {};", name, value) + unit_text(quantity));
}

std::string default_value(const KernelModule& module, NodeId node)
{
    if (module.graph->is_constant(node)) return print_literal(module.graph->value(node)).text;
    const LocalNames none;
    const NodeId outputs[] = {node};
    const Body body = print_body({*module.graph, none, outputs, {}, {}, Checking::none});
    std::string text = "[] { ";
    for (const std::string& function : body.functions) text += fmt::format("using std::{}; ", function);
    for (const std::string& statement : body.statements) text += statement + " ";
    return text + "return S(" + body.values.front() + "); }()";
}

void print_parameters(TextBlock& out, const KernelModule& module, const ModuleNames& names)
{
    out.blank();
    out.comment("Physical parameters with the defaults of the model.");
    out.line("struct Parameters {");
    out.indent(1);
    for (std::size_t k = 0; k < module.parameters.size(); ++k) {
        const std::string value = k < module.parameter_defaults.size() ? default_value(module, module.parameter_defaults[k]) : "S(0)";
        print_member(out, names.parameters[k], value, module.parameters[k]);
    }
    out.indent(-1);
    out.line("} parameters;");
}

void print_group(TextBlock& out, const std::string& type, const std::vector<Quantity>& quantities, const std::vector<std::string>& members,
                 const std::string& text)
{
    if (quantities.empty()) return;
    out.blank();
    out.comment(text);
    out.line(fmt::format("struct {} {{", type));
    out.indent(1);
    for (std::size_t k = 0; k < quantities.size(); ++k) print_member(out, members[k], "S(0)", quantities[k]);
    out.indent(-1);
    out.line("};");
}

/// state(base, fibre), with the group that is empty left out.
void print_state(TextBlock& out, const KernelModule& module, const ModuleNames& names)
{
    const auto define = [&](const std::string& signature, bool base, bool fibre) {
        out.blank();
        out.comment("A state by names; members left out are zero.");
        out.line(fmt::format("[[nodiscard]] static State state({}) noexcept", signature));
        out.line("{");
        out.indent(1);
        out.line("State s;");
        std::size_t lane = 0;
        for (const std::string& member : names.base) out.line(fmt::format("s[{}] = {};", lane++, base ? "base." + member : "S(0)"));
        for (const std::string& member : names.fibre) out.line(fmt::format("s[{}] = {};", lane++, fibre ? "fibre." + member : "S(0)"));
        out.line("return s;");
        out.indent(-1);
        out.line("}");
    };
    const bool has_base = !module.base.empty();
    const bool has_fibre = !module.fibre.empty();
    if (has_base && has_fibre) define(fmt::format("const Base& base, const {}& fibre", module.fibre_name), true, true);
    if (has_base && !has_fibre) define("const Base& base", true, false);
    if (!has_base && has_fibre) define(fmt::format("const {}& fibre", module.fibre_name), false, true);
}

std::string name_array(const std::string& array, const std::vector<const std::vector<Quantity>*>& groups)
{
    std::vector<std::string> literals;
    for (const auto* group : groups)
        for (const Quantity& quantity : *group) literals.push_back(string_literal(quantity.name));
    return fmt::format("static constexpr std::array<const char*, {}> {} = {{{}}};", literals.size(), array, joined(literals));
}

void print_constants(TextBlock& out, const KernelModule& module)
{
    const std::size_t n = module.base.size();
    const std::size_t r = module.fibre.size();
    out.line("using Scalar = S;");
    out.line(fmt::format("static constexpr int dimension = {};       // lanes of State", n + r));
    out.line(fmt::format("static constexpr int base_dimension = {};  // the first of them", n));
    out.line(fmt::format("static constexpr int fibre_dimension = {}; // the others", r));
    out.line(fmt::format("using State = Eigen::Matrix<S, {}, 1>;", n + r));
    out.blank();
    out.line(fmt::format("static constexpr const char* model_name = {};", string_literal(module.model)));
    out.line(fmt::format("static constexpr const char* model_hash = {};", string_literal(module.hash)));
    out.line(name_array("state_names", {&module.base, &module.fibre}));
    out.line(name_array("parameter_names", {&module.parameters}));
}

/// Parameters by number, for programs that know them by parameter_names only.
void print_parameter_access(TextBlock& out, const ModuleNames& names)
{
    if (names.parameters.empty()) return;
    std::vector<std::string> members;
    for (const std::string& name : names.parameters) members.push_back("&Parameters::" + name);
    out.blank();
    out.comment("The parameter parameter_names[k], k < parameter_names.size().");
    out.line("[[nodiscard]] S& parameter(std::size_t k) noexcept");
    out.line("{");
    out.indent(1);
    out.line(fmt::format("constexpr std::array<S Parameters::*, {}> members = {{{}}};", members.size(), joined(members)));
    out.line("return parameters.*members[k];");
    out.indent(-1);
    out.line("}");
}

} // namespace

std::string print_header(const KernelModule& module)
{
    const ModuleNames names = name_module(module);
    KernelNeeds needs;
    TextBlock kernels;
    kernels.indent(1);
    print_constants(kernels, module);
    print_parameters(kernels, module, names);
    print_parameter_access(kernels, names);
    print_group(kernels, "Base", module.base, names.base, "Base coordinates, the first lanes of State.");
    print_group(kernels, module.fibre_name, module.fibre, names.fibre, "The other lanes of State.");
    print_state(kernels, module, names);
    print_parameter_status(kernels, module, names, needs);
    for (const Kernel& kernel : module.kernels) print_kernel(kernels, module, names, kernel, needs);

    TextBlock out;
    print_banner(out, module);
    out.line("#pragma once");
    out.blank();
    out.line("#include \"lagen/kernel.hpp\"");
    if (needs.linear) out.line("#include \"lagen/linear.hpp\"");
    out.blank();
    for (const char* header : {"Eigen/Core", "array", "cmath", "cstddef"}) {
        out.line(fmt::format("#include <{}>", header));
        if (std::string_view(header) == "Eigen/Core") out.blank();
    }
    out.blank();
    out.line("namespace lagen::models {");
    out.blank();
    out.comment(module.title.empty() ? module.model : module.title);
    out.line("template <class S>");
    out.line(fmt::format("class {} {{", names.class_name));
    out.line("  public:");
    std::string text = out.text() + kernels.text();
    text += "};\n\n} // namespace lagen::models\n";
    return text;
}

} // namespace lagen
