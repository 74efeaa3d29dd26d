// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/report_operations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

namespace lagen {

namespace {

constexpr std::size_t most_terms = 3; ///< of each kernel
constexpr double least_share = 0.05;  ///< of a kernel's weight, for a term that is shown

using Passes = std::span<const PassReport>;

bool same(const OperationCount& a, const OperationCount& b)
{
    return a.additions == b.additions && a.multiplications == b.multiplications && a.divisions == b.divisions &&
           a.functions == b.functions && a.solves == b.solves && a.weight == b.weight;
}

/// The rows of one kernel; one that repeats the operations of the row before it is left out.
class OperationRows {
  public:
    OperationRows(const std::string& name, const OperationCount& count) : last_(count) { print(name, count); }

    void add(const std::string& name, const OperationCount& count)
    {
        if (!same(last_, count)) print(name, count);
        last_ = count;
    }

    void print(const std::string& name, const OperationCount& count)
    {
        text_ += fmt::format("{:<66}{:>6} {:>6} {:>6} {:>9} {:>6} {:>8.0f}\n", name, count.additions,
                             count.multiplications, count.divisions, count.functions, count.solves, count.weight);
    }

    [[nodiscard]] const std::string& text() const { return text_; }

  private:
    std::string text_;
    OperationCount last_;
};

/// The passes of the search that ended in what was kept. Where linear systems were solved through the terms of a
/// Hessian and as they are, there were two: the first ends in that.
Passes search_of(const SimplifyReport& report)
{
    const Passes all(report.passes);
    std::size_t begin = 0;
    for (std::size_t k = 0; k < all.size(); ++k) {
        const bool solved = all[k].stage == Stage::eliminated;
        if (solved && same(all[k].after, report.kept)) return all.first(k + 1);
        const bool ends = solved || all[k].stage == Stage::mixed;
        if (ends && k + 1 < all.size()) begin = k + 1;
    }
    return all.subspan(begin);
}

/// The passes over one form: the first that came to the operations of the lightest, else the lightest that was tried.
Passes passes_of_kept(Passes search)
{
    const auto lightest =
        std::ranges::find_if(search, [](const PassReport& pass) { return pass.stage == Stage::lightest; });
    Passes best;
    for (std::size_t begin = 0; begin < search.size();) {
        std::size_t end = begin + 1;
        while (end < search.size() && search[end].form == search[begin].form) ++end;
        const Passes form = search.subspan(begin, end - begin);
        begin = end;
        if (form[0].stage != Stage::pass) continue;
        if (lightest != search.end() && same(form.back().after, lightest->after)) return form;
        if (best.empty() || form.back().after.weight < best.back().after.weight) best = form;
    }
    return best;
}

std::string costliest_text(const SimplifyReport& report)
{
    std::string text;
    for (std::size_t k = 0; k < std::min(report.costliest.size(), most_terms); ++k) {
        const CostlyTerm& term = report.costliest[k];
        if (term.weight < least_share * report.kept.weight) break;
        text += fmt::format("    weighs {:.0f}, used {}: {}\n", term.weight,
                            term.uses == 1 ? "once" : fmt::format("{} times", term.uses), term.text);
    }
    return text;
}

std::string summary_of(const KernelReport& kernel)
{
    const SimplifyReport& report = kernel.report;
    if (same(report.written, report.kept))
        return OperationRows(kernel.kernel + ", kept as written", report.kept).text() + costliest_text(report);
    OperationRows rows(kernel.kernel + ", as written", report.written);
    const Passes search = search_of(report);
    const Passes form = passes_of_kept(search);
    bool shown = false;
    for (const PassReport& pass : search) {
        if (pass.stage != Stage::pass || shown || form.empty() || pass.form != form[0].form) continue;
        rows.add("  " + pass.form, form[0].before);
        for (const PassReport& each : form) rows.add("    " + each.pass, each.after);
        shown = true;
    }
    for (const PassReport& pass : search)
        if (pass.stage != Stage::pass) rows.add("  " + pass.form, pass.after);
    rows.print("  kept", report.kept);
    return rows.text() + costliest_text(report);
}

} // namespace

std::string operations_text(const std::vector<KernelReport>& reports)
{
    std::string text = fmt::format("{:<66}{:>6} {:>6} {:>6} {:>9} {:>6} {:>8}\n", "operations", "+ -", "*", "/",
                                   "functions", "solves", "weight");
    for (const KernelReport& kernel : reports) text += summary_of(kernel);
    return text;
}

} // namespace lagen
