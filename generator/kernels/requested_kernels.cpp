// SPDX-License-Identifier: GPL-2.0-or-later
#include "kernels/requested_kernels.hpp"

#include "kernels/kernel_table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

namespace {

bool is_among(const std::vector<std::string>& names, const std::string& name)
{
    return std::ranges::find(names, name) != names.end();
}

[[noreturn]] void refuse(const std::string& found, const std::string& name, const std::vector<std::string>& names)
{
    const std::string near = nearest_name(name, names);
    throw Error(ExitCode::usage, fmt::format("error: {} {}{}", found, fmt::join(names, ", "),
                                             near.empty() ? "" : fmt::format("\nhint: did you mean '{}'?", near)));
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

bool is_requested(const std::vector<std::string>& only, const std::string& name)
{
    if (!only.empty()) return is_among(only, name);
    return std::ranges::none_of(kernel_table(),
                                [&](const KernelRow& row) { return row.on_request && name == row.name; });
}

void refuse_unknown(const std::vector<std::string>& only)
{
    for (const std::string& name : only)
        if (!is_among(kernel_names(), name))
            refuse(fmt::format("there is no kernel '{}'; there are", name), name, kernel_names());
}

void require_requested(const KernelModule& module, const Model& model, const System& system, const Report& report,
                       const KernelRequest& request)
{
    for (const std::string& name : request.only) {
        if (has_kernel(module, name)) continue;
        KernelRequest every;
        every.form = module.form;
        every.scene = request.scene;
        std::vector<std::string> names;
        for (const Kernel& kernel : form_kernels(model, system, report, every).kernels) names.push_back(kernel.name);
        const FormKind form = form_named(module.form).kind;
        for (const KernelRow& row : kernel_table())
            if (row.on_request && row.form.value_or(form) == form) names.emplace_back(row.name);
        refuse(fmt::format("the {} form of model '{}' has no kernel '{}'; it has", module.form, model.name, name), name,
               names);
    }
}

} // namespace lagen
