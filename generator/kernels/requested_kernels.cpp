// SPDX-License-Identifier: GPL-2.0-or-later
#include "kernels/requested_kernels.hpp"

#include "kernels/kernel_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace lagen {

namespace {

bool is_among(const std::vector<std::string>& names, const std::string& name)
{
    return std::ranges::find(names, name) != names.end();
}

/// Series of events and of a domain need those.
bool has_what_it_needs(const KernelRow& row, const std::vector<std::string>& names)
{
    if (row.name == std::string_view("event_series")) return is_among(names, "events");
    return row.name != std::string_view("domain_series") || is_among(names, "domain");
}

[[noreturn]] void refuse(const std::string& found, const std::string& name, const std::vector<std::string>& names)
{
    const std::string near = nearest_name(name, names);
    throw Error(ExitCode::usage, with_hint(fmt::format("error: {} {}", found, fmt::join(names, ", ")),
                                           near.empty() ? "" : fmt::format("did you mean '{}'?", near)));
}

} // namespace

const std::vector<std::string>& kernel_names()
{
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const KernelRow& row : kernel_table())
            if (!is_among(all, row.name)) all.emplace_back(row.name);
        return all;
    }();
    return names;
}

bool is_requested(const KernelRequest& request, FormKind form, const std::string& name)
{
    if (is_among(request.without, name)) return false;
    if (is_among(request.with, name)) return true;
    if (!request.only.empty()) return is_among(request.only, name);
    return std::ranges::any_of(kernel_table(), [&](const KernelRow& row) {
        return !row.on_request && name == row.name && has_form(row, form);
    });
}

void refuse_unknown(const KernelRequest& request)
{
    for (const auto* names : {&request.only, &request.with})
        for (const std::string& name : *names)
            if (!is_among(kernel_names(), name))
                refuse(fmt::format("there is no kernel '{}'; there are", name), name, kernel_names());
}

void require_requested(const KernelModule& module, const Model& model, const System& system, const Report& report,
                       const KernelRequest& request)
{
    std::vector<std::string> asked = request.only;
    asked.insert(asked.end(), request.with.begin(), request.with.end());
    for (const std::string& name : asked) {
        if (has_kernel(module, name) || (name == "flows" && module.flows.count > 0)) continue;
        if (name == "flows" && !module.flows.obstacle.empty())
            throw MathematicsError(
                fmt::format("model '{}' is no sum of exact flows: {}", model.name, module.flows.obstacle));
        KernelRequest every;
        every.form = module.form;
        every.scene = request.scene;
        std::vector<std::string> names;
        for (const Kernel& kernel : form_kernels(model, system, report, every).kernels) names.push_back(kernel.name);
        const FormKind form = form_named(module.form).kind;
        for (const KernelRow& row : kernel_table())
            if (row.on_request && has_form(row, form) && has_what_it_needs(row, names)) names.emplace_back(row.name);
        refuse(fmt::format("the {} form of model '{}' has no kernel '{}'; it has", module.form, model.name, name), name,
               names);
    }
}

} // namespace lagen
