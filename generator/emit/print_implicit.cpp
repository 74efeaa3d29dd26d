// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/print_function.hpp"
#include "emit/print_kernel.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

namespace {

/// `array[k] = value;`
FunctionRequest storing_to(const KernelModule& module, const ModuleNames& names,
                           std::function<std::string(std::size_t, const std::string&)> store)
{
    return {module, names, "", false, false, "", false, std::move(store)};
}

/// The unknowns stand in the argument `unknowns`, not in a solved block.
void load_own_unknowns(TextBlock& out, Body& body, const ModuleNames& names, const ImplicitBlock& block)
{
    for (std::size_t k = 0; k < block.unknowns.size(); ++k)
        if (reads(body, block.unknowns[k]))
            out.line(fmt::format("const S {} = unknowns[{}];", names.locals.inputs.at(block.unknowns[k]), k));
    const auto is_own = [&](std::size_t id) { return std::ranges::count(block.unknowns, static_cast<NodeId>(id)) > 0; };
    std::erase_if(body.inputs, is_own);
    std::erase_if(body.parts.front().lines,
                  [&](const BodyLine& line) { return line.kind == BodyLine::Kind::load && is_own(line.index); });
}

} // namespace

void print_implicit(TextBlock& out, const KernelModule& module, const ModuleNames& names, const ImplicitBlock& block,
                    KernelNeeds& needs)
{
    const std::size_t size = block.unknowns.size();
    std::vector<NodeId> inner = block.residuals;
    inner.insert(inner.end(), block.jacobian.begin(), block.jacobian.end());
    const auto body_of = [&](const std::vector<NodeId>& outputs) {
        return print_body({*module.graph, names.locals, outputs, {}, names.moving, Checking::none, {}, 0});
    };
    const Body guess = body_of(block.guess);
    Body iteration = body_of(inner);
    needs.linear = needs.newton = true;
    out.blank();
    out.comment(block.documentation);
    out.comment("By Newton's method; answers newton_diverged, and NaN in z, where it finds no solution to round-off.");
    const bool reads_time = reads(guess, module.time) || reads(iteration, module.time);
    const bool reads_lanes = reads_lane(guess, module) || reads_lane(iteration, module);
    open_block(out, fmt::format("[[nodiscard]] status_t<S> solve_{}({}S t, {}const State& s, std::array<S, {}>& z) "
                                "const noexcept",
                                block.name, maybe_unused(reads_time), maybe_unused(reads_lanes), size));
    open_block(out, "");
    print_lines(out, guess, storing_to(module, names, [](std::size_t k, const std::string& value) {
                    return fmt::format("z[{}] = {};", k, value);
                }));
    close_block(out);
    out.line(fmt::format("return newton(z, [&](const std::array<S, {0}>& unknowns, std::array<S, {0}>& residual, "
                         "std::array<S, {1}>& derivative) noexcept {{",
                         size, size * size));
    out.indent(1);
    load_own_unknowns(out, iteration, names, block);
    print_lines(out, iteration, storing_to(module, names, [size](std::size_t k, const std::string& value) {
                    return k < size ? fmt::format("residual[{}] = {};", k, value)
                                    : fmt::format("derivative[{}] = {};", k - size, value);
                }));
    out.indent(-1);
    out.line("});");
    close_block(out);
}

} // namespace lagen
