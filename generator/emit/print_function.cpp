// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/print_function.hpp"

#include "emit/spell.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

namespace {

/// The blocks whose unknowns the body reads, but `own`.
std::vector<const ImplicitBlock*> blocks_of(const Body& body, const KernelModule& module,
                                            const ImplicitBlock* own = nullptr)
{
    std::vector<const ImplicitBlock*> blocks;
    for (const ImplicitBlock& block : module.implicit)
        if (&block != own && std::ranges::any_of(block.unknowns, [&](NodeId id) { return reads(body, id); }))
            blocks.push_back(&block);
    return blocks;
}

bool loads(const BodyPart& part, NodeId id)
{
    return std::ranges::any_of(
        part.lines, [&](const BodyLine& line) { return line.kind == BodyLine::Kind::load && line.index == id; });
}

std::vector<NodeId> inputs_of(const std::vector<Quantity>& quantities)
{
    std::vector<NodeId> inputs;
    for (const Quantity& quantity : quantities) inputs.push_back(quantity.input);
    return inputs;
}

/// `const S x = s[3], y = s[4];`: of the entries of `array` from `first` on, those that the part reads.
void load_array(TextBlock& out, const BodyPart& part, const FunctionRequest& request, const std::vector<NodeId>& inputs,
                const std::string& array, std::size_t first)
{
    std::vector<std::string> items;
    for (std::size_t k = 0; k < inputs.size(); ++k)
        if (loads(part, inputs[k]))
            items.push_back(fmt::format("{} = {}[{}]", request.names.locals.inputs.at(inputs[k]), array, first + k));
    if (!items.empty()) out.list("const S ", items, ";");
}

/// The lanes and the direction that the part reads: before anything is stored, which may be in their
/// place.
void load_state(TextBlock& out, const BodyPart& part, const FunctionRequest& request)
{
    const KernelModule& module = request.module;
    std::size_t first = 0;
    for (const auto* group : {&module.base, &module.fibre}) {
        load_array(out, part, request, inputs_of(*group), "s", first);
        first += group->size();
    }
    if (request.reads_direction) load_array(out, part, request, inputs_of(module.direction), "v", 0);
}

void load_unknowns(TextBlock& out, const BodyPart& part, const FunctionRequest& request)
{
    for (const ImplicitBlock& block : request.module.implicit)
        load_array(out, part, request, block.unknowns, &block == request.own ? "unknowns" : "solved_" + block.name, 0);
}

/// Solves the implicit blocks that the body reads; answers whether a `status` was declared.
bool solve_blocks(TextBlock& out, const Body& body, const FunctionRequest& request)
{
    bool declared = false;
    const std::vector<const ImplicitBlock*> blocks = blocks_of(body, request.module, request.own);
    for (const ImplicitBlock* block : blocks) {
        out.line(fmt::format("std::array<S, {}> solved_{};", block->unknowns.size(), block->name));
        const std::string call = fmt::format("solve_{}(t, s, solved_{})", block->name, block->name);
        if (!request.returns_status)
            out.line(fmt::format("static_cast<void>({});", call));
        else if (declared)
            out.line(fmt::format("status = StatusOf<S>::first(status, {});", call));
        else
            out.line(
                fmt::format("{} status = {};", body.has_status || blocks.size() > 1 ? "auto" : "const auto", call));
        declared = declared || request.returns_status;
    }
    return declared;
}

/// All that the part reads at once: a compiler that finds loads between stores, which might overlap, packs neither. By
/// the names of all members where it reads most of them.
void load_parameters(TextBlock& out, const BodyPart& part, const FunctionRequest& request)
{
    std::vector<std::string> members;
    std::vector<std::string> items;
    for (std::size_t k = 0; k < request.module.parameters.size(); ++k) {
        const NodeId input = request.module.parameters[k].input;
        members.push_back(request.names.locals.inputs.at(input));
        if (loads(part, input))
            items.push_back(fmt::format("{} = parameters.{}", members.back(), request.names.parameters[k]));
    }
    if (items.size() > 1 && 2 * items.size() >= members.size())
        out.list("const auto [", members, "] = parameters;");
    else
        out.list("const S ", items, ";");
}

void print_part_lines(TextBlock& out, const BodyPart& part, const FunctionRequest& request)
{
    const auto is_parameter = [&](std::size_t id) {
        return std::ranges::any_of(request.module.parameters, [&](const Quantity& q) { return q.input == id; });
    };
    bool loaded = false; // not before the first use: they need no register until then
    for (const BodyLine& line : part.lines) {
        if (line.kind == BodyLine::Kind::statement) out.line(line.text);
        if (line.kind == BodyLine::Kind::store) out.line(request.store(line.index, line.text));
        if (line.kind != BodyLine::Kind::load || loaded || !is_parameter(line.index)) continue;
        load_parameters(out, part, request);
        loaded = true;
    }
}

void print_usings(TextBlock& out, const Body& body)
{
    for (const std::string& function : body.functions) out.line(using_declaration(function));
}

std::string part_name(const FunctionRequest& request, std::size_t part)
{
    return fmt::format("{}_part_{}", request.name, part + 1);
}

/// "S t, const State& s, ..., std::array<S, 12>& work, State& ds"; without types the arguments of a call.
std::string part_arguments(const Body& body, const FunctionRequest& request, bool types)
{
    std::string text = types ? "[[maybe_unused]] S t, [[maybe_unused]] const State& s" : "t, ";
    if (!types) text += request.output_is_state ? "at" : "s";
    const auto add = [&](const std::string& type, const std::string& name) {
        text += types ? ", [[maybe_unused]] " + type + " " + name : ", " + name;
    };
    if (request.reads_direction) add("const State&", types || !request.output_is_state ? "v" : "along");
    for (const ImplicitBlock* block : blocks_of(body, request.module))
        add(fmt::format("const std::array<S, {}>&", block->unknowns.size()), "solved_" + block->name);
    add(fmt::format("std::array<S, {}>&", body.workspace), "work");
    const std::size_t name = request.output.rfind(' ') + 1;
    add(request.output.substr(0, name - 1), request.output.substr(name));
    return text;
}

void call_parts(TextBlock& out, const Body& body, const FunctionRequest& request)
{
    if (request.output_is_state) out.line("const State at = s; // the output may stand in the place of the state");
    if (request.output_is_state && request.reads_direction) out.line("const State along = v;");
    out.line(fmt::format("std::array<S, {}> work;", body.workspace));
    for (std::size_t k = 0; k < body.parts.size(); ++k) {
        const std::string call = fmt::format("{}({})", part_name(request, k), part_arguments(body, request, false));
        out.line(body.parts[k].has_status ? fmt::format("status = StatusOf<S>::first(status, {});", call) : call + ";");
    }
}

} // namespace

bool reads(const Body& body, NodeId id)
{
    return std::ranges::binary_search(body.inputs, id);
}

bool reads_lane(const Body& body, const KernelModule& module)
{
    const auto any = [&](const std::vector<Quantity>& group) {
        return std::ranges::any_of(group, [&](const Quantity& q) { return reads(body, q.input); });
    };
    return any(module.base) || any(module.fibre);
}

std::string maybe_unused(bool used)
{
    return used ? "" : "[[maybe_unused]] ";
}

std::string state_arguments(const Body& body, const KernelModule& module)
{
    const bool whole = body.parts.size() > 1 || !blocks_of(body, module).empty();
    return fmt::format("{}S t, {}const State& s", maybe_unused(whole || reads(body, module.time)),
                       maybe_unused(whole || reads_lane(body, module)));
}

void open_block(TextBlock& out, const std::string& signature)
{
    if (!signature.empty()) out.line(signature);
    out.line("{");
    out.indent(1);
}

void close_block(TextBlock& out)
{
    out.indent(-1);
    out.line("}");
}

void print_parts(TextBlock& out, const Body& body, const FunctionRequest& request)
{
    if (body.parts.size() < 2) return;
    out.indent(-1);
    out.line("private:");
    out.indent(1);
    for (std::size_t k = 0; k < body.parts.size(); ++k) {
        const BodyPart& part = body.parts[k];
        if (k > 0) out.blank();
        out.comment(fmt::format("Part {} of {} of {}.", k + 1, body.parts.size(), request.name));
        open_block(out,
                   fmt::format("[[gnu::noinline]] {} {}({}) const noexcept", part.has_status ? "status_t<S>" : "void",
                               part_name(request, k), part_arguments(body, request, true)));
        print_usings(out, body);
        load_state(out, part, request);
        load_unknowns(out, part, request);
        if (part.has_status) out.line("auto status = StatusOf<S>::good();");
        print_part_lines(out, part, request);
        if (part.has_status) out.line("return status;");
        close_block(out);
    }
    out.indent(-1);
    out.line("public:");
    out.indent(1);
    out.blank();
}

bool print_lines(TextBlock& out, const Body& body, const FunctionRequest& request)
{
    const bool whole = body.parts.size() == 1;
    if (whole) print_usings(out, body);
    if (whole) load_state(out, body.parts[0], request);
    bool declared = solve_blocks(out, body, request);
    if (body.has_status && !declared) out.line("auto status = StatusOf<S>::good();");
    declared = declared || body.has_status;
    if (!whole) return call_parts(out, body, request), declared;
    load_unknowns(out, body.parts[0], request);
    print_part_lines(out, body.parts[0], request);
    return declared;
}

} // namespace lagen
