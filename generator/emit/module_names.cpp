// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/module_names.hpp"

#include "emit/print_header.hpp"

#include <algorithm>
#include <string_view>

namespace lagen {

namespace {

/// Names that mean something inside every member function of every class.
constexpr std::string_view class_scope[] = {
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
    "result",
    "parameters",
    "parameter",
    "state",
    "state_names",
    "parameter_names",
    "dimension",
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
    "stumpff_orders",
};

/// Kernels of any form, what classes hold beside them, and arguments of their functions.
constexpr std::string_view members[] = {
    "rhs",
    "jacobian",
    "input_jacobian",
    "variational",
    "taylor",
    "event_series",
    "domain_series",
    "flows",
    "mass_matrix",
    "momentum",
    "inverse_dynamics",
    "velocity",
    "controls",
    "energy",
    "power",
    "hamiltonian",
    "lagrangian",
    "ambient_velocity",
    "reaction",
    "moving_energy",
    "cost",
    "constraints",
    "casimirs",
    "domain",
    "observables",
    "invariants",
    "lagrangian_hessian",
    "hamiltonian_hessian",
    "step",
    "forward",
    "arrow_equation",
    "explicit_step",
    "cayley_coordinates",
    "algebra_matrix",
    "in_algebra",
    "element",
    "algebra_element",
    "algebra_action",
    "algebra_bracket",
    "events",
    "jumps",
    "input",
    "inputs",
    "base",
    "fibre",
    "k",
    "SecondOrder",
    "second_order",
    "moved_by_group",
    "step_parameter",
    "group_order",
    "horizontal",
    "arrow",
    "cayley",
    "cayley_step",
    "states",
    "flow",
    "part",
    "out",
    "mu",
    "xi",
    "eta",
    "x",
    "N",
    "R",
};

bool is_member(std::string_view name)
{
    if (name.ends_with("dimension") || name.starts_with("group_generators_")) return true;
    for (const std::string_view suffix : {"_names", "_rows", "_columns", "_values", "_sums"})
        if (name.ends_with(suffix)) name.remove_suffix(suffix.size());
    return std::ranges::count(members, name) + std::ranges::count(class_scope, name) > 0;
}

/// These, and those of this class.
std::set<std::string> class_scope_names(const KernelModule& module, const std::string& class_name)
{
    std::set<std::string> names(std::begin(class_scope), std::end(class_scope));
    names.insert(class_name);
    for (const Kernel& kernel : module.kernels) {
        names.insert(kernel.name);
        for (const char* suffix : {"_names", "_rows", "_columns", "_values", "_sums"})
            names.insert(kernel.name + suffix);
        if (!kernel.directions.empty())
            names.insert({kernel.name + "_point", kernel.name + "_sweep", "known", "v", "dv", "columns", "columns_t",
                          "sweep_columns"});
        for (const KernelInput& input : kernel.inputs) names.insert({input.name, copy_of(input)});
        if (returns_value(kernel)) continue;
        for (const KernelOutput& output : kernel.outputs) names.insert(output.name);
    }
    if (!module.inputs.empty()) names.insert({"inputs", "input", "input_names", "Inputs"});
    for (const LaneGroup& group : module.groups) names.insert(group.role + "_dimension");
    if (module.second_order.kind != SecondOrder::Kind::no) names.insert("second_order");
    if (!module.motion.moved.empty()) names.insert({"algebra_dimension", "moved_by_group"});
    if (module.flows.count > 0) names.insert({"flows", "flow", "part"});
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

/// Inputs inside functions: the member's name, with a '_' where it would hide something.
void name_local(NodeId input, std::string name, LocalNames& locals)
{
    while (locals.taken.contains(name)) name += name.back() == '_' ? "1_" : "_";
    locals.taken.insert(name);
    locals.inputs[input] = std::move(name);
}

/// Locals for the unknowns of implicit blocks.
void name_unknowns(const KernelModule& module, ModuleNames& names)
{
    std::vector<NodeId> unknowns;
    std::vector<std::string> texts;
    for (const ImplicitBlock& block : module.implicit)
        for (const NodeId id : block.unknowns) {
            unknowns.push_back(id);
            texts.push_back(module.graph->input_name(id));
        }
    const std::vector<std::string> members = cpp_names(texts);
    for (std::size_t k = 0; k < unknowns.size(); ++k) {
        names.guess[unknowns[k]] = members[k];
        name_local(unknowns[k], members[k], names.locals);
    }
}

/// Locals for what kernels read beside the lanes of the module: a number is the argument itself.
void name_arguments(const KernelModule& module, LocalNames& locals)
{
    for (const Kernel& kernel : module.kernels)
        for (const KernelInput& input : kernel.inputs) {
            std::vector<std::string> texts;
            for (const Quantity& entry : input.entries) texts.push_back(entry.name);
            const std::vector<std::string> spelled = cpp_names(texts);
            for (std::size_t k = 0; k < texts.size(); ++k) {
                const NodeId id = input.entries[k].input;
                if (locals.inputs.contains(id)) continue;
                if (input.shape.rank == 0)
                    locals.inputs[id] = input.name;
                else
                    name_local(id, spelled[k], locals);
            }
        }
}

} // namespace

std::string class_name(const std::string& module_name)
{
    const std::string spelled = cpp_names({module_name}).front();
    return is_member(spelled) ? spelled + '_' : spelled;
}

ModuleNames name_module(const KernelModule& module)
{
    std::vector<const std::vector<Quantity>*> lists = {&module.parameters, &module.inputs};
    for (const LaneGroup& group : module.groups) lists.push_back(&group.lanes);
    std::vector<std::string> all;
    for (const auto* list : lists)
        for (const Quantity& quantity : *list) all.push_back(quantity.name);
    const std::vector<std::string> spelled = cpp_names(all);
    ModuleNames names;
    names.class_name = class_name(module.name);
    names.locals.taken = class_scope_names(module, names.class_name);
    names.locals.inputs[module.time] = "t";
    auto next = spelled.begin();
    for (const auto* list : lists) {
        const auto first = next;
        next += static_cast<std::ptrdiff_t>(list->size());
        auto& spelled_names = list == &module.parameters ? names.parameters
                              : list == &module.inputs   ? names.inputs
                                                         : names.groups.emplace_back();
        spelled_names.assign(first, next);
        for (std::size_t k = 0; k < list->size(); ++k)
            name_local((*list)[k].input, first[static_cast<std::ptrdiff_t>(k)], names.locals);
    }
    name_unknowns(module, names);
    name_arguments(module, names.locals);
    const auto is_parameter = [&](NodeId id) {
        return std::ranges::any_of(module.parameters,
                                   [id](const Quantity& parameter) { return parameter.input == id; });
    };
    for (const NodeId id : module.graph->inputs())
        if (!is_parameter(id)) names.moving.push_back(id);
    return names;
}

std::vector<std::vector<NodeId>> families_of(const KernelModule& module)
{
    std::vector<std::vector<NodeId>> families;
    const auto add = [&](const std::vector<Quantity>& quantities) {
        std::vector<NodeId>& family = families.emplace_back();
        for (const Quantity& each : quantities) family.push_back(each.input);
    };
    add(module.parameters);
    if (!module.inputs.empty()) add(module.inputs);
    for (const LaneGroup& group : module.groups) add(group.lanes);
    return families;
}

std::string copy_of(const KernelInput& input)
{
    return input.name + "_before";
}

bool returns_value(const Kernel& kernel)
{
    return !kernel.checks && kernel.outputs.size() == 1 && !kernel.outputs[0].sparse;
}

} // namespace lagen
