// SPDX-License-Identifier: GPL-2.0-or-later
#include "pipeline.hpp"

#include "content_hash.hpp"
#include "emit/print_equations.hpp"
#include "emit/print_header.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>

namespace lagen {

namespace {

std::string names_of(const Check& check)
{
    std::string text;
    for (const std::string& index : check.indices) text += (text.empty() ? "" : ", ") + index;
    return text.empty() ? check.name : fmt::format("{} ({})", check.name, text);
}

std::vector<std::string> lines_of(const std::string& text)
{
    std::vector<std::string> lines;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        lines.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return lines;
}

/// The first check with this status, as "anchor (w1, w2, g3), residual 2*g3".
std::string first_with(const VerifiedAlgebroid& verified, ProofStatus status)
{
    for (const Check& check : verified.checks)
        if (check.decision.status == status)
            return fmt::format("{}, residual {}", names_of(check), check.decision.residual);
    return verified.note;
}

} // namespace

CheckedModel load(const std::string& path, const std::vector<Setting>& settings, bool unchecked)
{
    CheckedModel checked;
    checked.model = read_model(path, settings);
    checked.verified = verify(checked.model);
    const VerifiedAlgebroid& verified = checked.verified;
    if (verified.verdict == Verdict::invalid) {
        const std::string what = first_with(verified, ProofStatus::refuted);
        if (!unchecked) {
            throw MathematicsError(fmt::format(
                "error: model '{}' is refuted: {}\nhint: see `lagen check {}`; --unchecked goes on all the same",
                checked.model.name, what, path));
        }
        checked.warnings.push_back(fmt::format("this model is REFUTED and was generated with --unchecked: {}", what));
    } else if (verified.verdict == Verdict::undecided) {
        checked.warnings.push_back(
            fmt::format("this model is not proved: {} is undecided", first_with(verified, ProofStatus::undecided)));
    }
    return checked;
}

Generated generate(const CheckedModel& checked, const GenerateRequest& request)
{
    const Model& model = checked.model;
    KernelRequest kernels;
    kernels.only = request.only;
    kernels.scene = request.scene;
    Generated generated;
    generated.module = lagrange_kernels(model, checked.verified, kernels);
    KernelModule& module = generated.module;
    module.hash = ContentHash().add(model.file->text).hex16();
    module.regenerate = fmt::format("lagen generate {} -o {}.hpp",
                                    std::filesystem::path(model.file->name).filename().string(), module.name);
    module.warnings = checked.warnings;
    module.equations = lines_of(print_text(derive_lagrange(model, checked.verified.algebroid)));
    generated.header = print_header(module);
    return generated;
}

} // namespace lagen
