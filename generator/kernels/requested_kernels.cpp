// SPDX-License-Identifier: GPL-2.0-or-later
#include "kernels/requested_kernels.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

namespace {

/// Those that are made only where they are asked for by name.
const std::vector<std::string> on_request{"variational", "lagrangian_hessian", "hamiltonian_hessian"};

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
    static const std::vector<std::string> names{
        "rhs",         "jacobian",   "variational",        "mass_matrix",         "momentum", "velocity",    "controls",
        "energy",      "power",      "hamiltonian",        "lagrangian",          "cost",     "constraints", "domain",
        "observables", "invariants", "lagrangian_hessian", "hamiltonian_hessian", "events"};
    return names;
}

bool is_requested(const std::vector<std::string>& only, const std::string& name)
{
    return only.empty() ? !is_among(on_request, name) : is_among(only, name);
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
        names.emplace_back("variational");
        if (module.form == "lagrange") names.emplace_back("lagrangian_hessian");
        if (module.form == "hamilton") names.emplace_back("hamiltonian_hessian");
        refuse(fmt::format("the {} form of model '{}' has no kernel '{}'; it has", module.form, model.name, name), name,
               names);
    }
}

} // namespace lagen
