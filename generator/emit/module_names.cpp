// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/module_names.hpp"

#include "emit/print_header.hpp"

namespace lagen {

namespace {

/// Names that mean something inside every member function.
std::set<std::string> class_scope_names(const KernelModule& module, const std::string& class_name)
{
    std::set<std::string> names{class_name,
                                "S",
                                "Scalar",
                                "State",
                                "t",
                                "s",
                                "ds",
                                "values",
                                "status",
                                "select",
                                "work",
                                "at",
                                "along",
                                "result",
                                "parameters",
                                "parameter",
                                "state",
                                "state_names",
                                "parameter_names",
                                "dimension",
                                "base_dimension",
                                "fibre_dimension",
                                "model_name",
                                "model_hash",
                                "status_t",
                                "parameter_status",
                                "singular_tolerance",
                                "PivotedLu",
                                "sincos",
                                "arithmetic",
                                "square_roots",
                                "reciprocals",
                                "stumpff",
                                "stumpff_orders"};
    for (const Kernel& kernel : module.kernels) {
        names.insert(kernel.name);
        for (const char* suffix : {"_names", "_rows", "_columns", "_values"}) names.insert(kernel.name + suffix);
    }
    if (!module.direction.empty()) names.insert({"v", "dv"});
    if (!module.implicit.empty())
        names.insert({"z", "newton", "bracket", "lower", "upper", "unknowns", "residual", "derivative", "size",
                      "inside", "require_positive"});
    for (const ImplicitBlock& block : module.implicit) {
        names.insert("solve_" + block.name);
        names.insert("solved_" + block.name);
        if (block.angles) names.insert({"b", "c", "nearest_angles"});
        if (block.follows)
            names.insert({"guess", "Guess", "follow", "same", "curvature", "from", "matrix", "number_or"});
    }
    return names;
}

/// Loads of inputs inside functions: the member's name, with a '_' where it would hide something.
void name_locals(const std::vector<Quantity>& quantities, const std::vector<std::string>& members, LocalNames& locals)
{
    for (std::size_t k = 0; k < quantities.size(); ++k) {
        std::string name = members[k];
        while (locals.taken.contains(name)) name += name.back() == '_' ? "1_" : "_";
        locals.taken.insert(name);
        locals.inputs[quantities[k].input] = name;
    }
}

/// Locals for the unknowns of implicit blocks and for the entries of a direction.
void name_unknowns(const KernelModule& module, ModuleNames& names)
{
    std::vector<Quantity> unknowns;
    for (const ImplicitBlock& block : module.implicit)
        for (const NodeId id : block.unknowns) unknowns.push_back({module.graph->input_name(id), "", "", id});
    std::vector<std::string> texts;
    for (const Quantity& unknown : unknowns) {
        texts.push_back(unknown.name);
        names.moving.push_back(unknown.input);
    }
    const std::vector<std::string> members = cpp_names(texts);
    for (std::size_t k = 0; k < unknowns.size(); ++k) names.guess[unknowns[k].input] = members[k];
    name_locals(unknowns, members, names.locals);
    std::vector<std::string> tangents;
    for (const std::vector<std::string>* group : {&names.base, &names.fibre})
        for (const std::string& member : *group) tangents.push_back("d_" + member);
    if (!module.direction.empty()) name_locals(module.direction, tangents, names.locals);
    for (const Quantity& quantity : module.direction) names.moving.push_back(quantity.input);
}

} // namespace

ModuleNames name_module(const KernelModule& module)
{
    std::vector<std::string> all;
    for (const auto* group : {&module.parameters, &module.base, &module.fibre})
        for (const Quantity& quantity : *group) all.push_back(quantity.name);
    const std::vector<std::string> spelled = cpp_names(all);
    ModuleNames names;
    names.class_name = cpp_names({module.name}).front();
    auto next = spelled.begin();
    const auto take = [&](std::size_t count) {
        const auto first = next;
        next += static_cast<std::ptrdiff_t>(count);
        return std::vector<std::string>(first, next);
    };
    names.parameters = take(module.parameters.size());
    names.base = take(module.base.size());
    names.fibre = take(module.fibre.size());
    names.locals.taken = class_scope_names(module, names.class_name);
    names.locals.inputs[module.time] = "t";
    names.moving.push_back(module.time);
    for (const auto* group : {&module.base, &module.fibre})
        for (const Quantity& quantity : *group) names.moving.push_back(quantity.input);
    name_locals(module.parameters, names.parameters, names.locals);
    name_locals(module.base, names.base, names.locals);
    name_locals(module.fibre, names.fibre, names.locals);
    name_unknowns(module, names);
    return names;
}

} // namespace lagen
