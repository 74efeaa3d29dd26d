// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/chart/contestants.hpp"

#include "emit/print_header.hpp"

#include <fmt/core.h>

#include <map>
#include <string_view>

namespace lagen {

namespace {

enum class Kinship { explicit_steps, pair, nystrom, series, implicit, splitting };

Kinship kinship_of(const MethodEntry& method)
{
    const std::string_view name = method.name;
    if (method.separable_only) return Kinship::splitting;
    if (method.series) return Kinship::series;
    if (method.system != SecondOrder::Kind::no) return Kinship::nystrom;
    if (name.starts_with("gauss") || name.starts_with("radau")) return Kinship::implicit;
    return method.adaptive ? Kinship::pair : Kinship::explicit_steps;
}

bool has_base(const KernelModule& module)
{
    for (const LaneGroup& group : module.groups)
        if (group.role == "base") return !group.lanes.empty();
    return false;
}

} // namespace

std::string obstacle_to(const MethodEntry& method, const ChartProblem& problem)
{
    const KernelModule& module = problem.module;
    if (method.separable_only && !has_base(module))
        return fmt::format("{} splits a system x' = f(y), y' = g(x), and model '{}' has no base coordinates x",
                           method.name, module.model);
    if (method.series) return problem.no_series;
    const SecondOrder& found = module.second_order;
    if (method.system == SecondOrder::Kind::no || found.kind == method.system ||
        found.kind == SecondOrder::Kind::velocity_free)
        return "";
    return fmt::format("{} integrates {}, and in model '{}' {}", method.name, system_of(method), module.model,
                       found.obstacle);
}

std::vector<MethodFamily> method_families(const ChartProblem& problem, std::vector<LeftOutMethod>& left_out)
{
    std::map<Kinship, MethodFamily> families;
    for (const MethodEntry& method : method_table()) {
        const std::string obstacle = obstacle_to(method, problem);
        if (obstacle.empty())
            families[kinship_of(method)].methods.push_back(&method);
        else
            left_out.push_back({method.name, obstacle});
    }
    std::vector<MethodFamily> list;
    for (auto& [kinship, family] : families) list.push_back(std::move(family));
    return list;
}

ProgramText family_program(const ChartProblem& problem, const MethodFamily& family)
{
    std::string types, names;
    for (const MethodEntry* method : family.methods) {
        types += fmt::format(", lagen::{}", method->type);
        names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", method->name);
    }
    return {problem.header,
            fmt::format("#include \"model.hpp\"\n#include \"lagen_chart/points.hpp\"\nint main(int argc, char** "
                        "argv)\n{{\n    return lagen::chart_points<lagen::models::{}<double>{}>({{{}}}, argc, "
                        "argv);\n}}\n",
                        cpp_names({problem.module.name})[0], types, names),
            {}};
}

} // namespace lagen
