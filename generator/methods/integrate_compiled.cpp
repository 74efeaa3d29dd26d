// SPDX-License-Identifier: GPL-2.0-or-later
#include "methods/integrate_compiled.hpp"

#include "lagen_run/driver.hpp"
#include "methods/method_list.hpp"

#include <stdexcept>
#include <utility>

namespace lagen {

namespace {

const ListedMethod* find(const std::string& type)
{
    for (const auto family : {fixed_step_methods(), pair_methods(), verner_methods(), nystrom_methods(),
                              implicit_methods(), splitting_methods(), taylor_methods()})
        for (const ListedMethod& each : family)
            if (type == each.type) return &each;
    return nullptr;
}

} // namespace

std::optional<KernelsAsked> integrates_compiled(const std::string& type)
{
    const ListedMethod* found = find(type);
    return found == nullptr ? std::nullopt : std::optional(found->asks);
}

std::string integrate_compiled(const std::string& path, const std::string& type, const detail::RunJob& job,
                               const detail::RowTaker& rows, const volatile std::sig_atomic_t* signal,
                               detail::RunReport& report)
{
    CompiledModel::Loaded loaded = CompiledModel::load(path);
    if (loaded.status != LoadStatus::ok) return to_text(loaded.status);
    const auto run = [&](auto method) {
        detail::RunPlan<CompiledModel> plan;
        plan.model = std::move(loaded.model);
        if constexpr (requires { method.lanes; }) method.lanes = plan.model.lanes();
        if (!detail::make_plan(job, plan, method)) throw std::invalid_argument("the job is that of another model");
        report = detail::run_plan(plan, method, job, rows, signal);
    };
    std::visit(run, find(type)->method);
    return {};
}

} // namespace lagen
