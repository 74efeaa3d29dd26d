// SPDX-License-Identifier: GPL-2.0-or-later
#include "methods/integrate_compiled.hpp"

#include "lagen_run/driver.hpp"
#include "methods/method_list.hpp"

#include <utility>

namespace lagen {

namespace {

const ListedMethod* find(const std::string& type)
{
    for (const auto family :
         {fixed_step_methods(), pair_methods(), verner_methods(), nystrom_methods(), implicit_methods()})
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

CompiledRun integrate_compiled(const std::string& path, const std::string& type, const detail::DriveArguments& given,
                               const std::function<void(std::string_view)>& rows,
                               const volatile std::sig_atomic_t* signal)
{
    CompiledRun run;
    CompiledModel::Loaded loaded = CompiledModel::load(path);
    if (loaded.status != LoadStatus::ok) {
        run.not_loaded = to_text(loaded.status);
        return run;
    }
    std::visit(
        [&](auto method) {
            detail::DrivePlan<CompiledModel> plan;
            plan.model = std::move(loaded.model);
            method.lanes = plan.model.lanes();
            run.complaint = detail::make_plan(given, plan, method);
            if (!run.complaint.empty()) return;
            Status status = Status::ok;
            run.report = detail::run_plan(plan, method, given, rows, signal, status);
            run.interrupted = status == Status::interrupted;
        },
        find(type)->method);
    return run;
}

} // namespace lagen
