// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/print_function.hpp"

#include "emit/spell.hpp"
#include "text/comma_list.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

namespace {

/// The blocks whose unknowns the body reads and does not find in an argument.
std::vector<const ImplicitBlock*> blocks_of(const Body& body, const FunctionRequest& request)
{
    const auto is_given = [&](NodeId id) {
        return std::ranges::any_of(request.inputs, [id](const KernelInput& input) {
            return std::ranges::find(input.entries, id, &Quantity::input) != input.entries.end();
        });
    };
    std::vector<const ImplicitBlock*> blocks;
    for (const ImplicitBlock& block : request.module.implicit)
        if (std::ranges::any_of(block.unknowns, [&](NodeId id) { return reads(body, id) && !is_given(id); }))
            blocks.push_back(&block);
    return blocks;
}

/// The name of the argument with this role, from which implicit blocks are solved.
const std::string& name_of(const FunctionRequest& request, ArrayRole role)
{
    const auto found = std::ranges::find(request.inputs, role, &KernelInput::role);
    if (found == request.inputs.end()) throw InternalError(request.name + " reads unknowns that it cannot solve for");
    return found->name;
}

bool loads(const BodyPart& part, NodeId id)
{
    return std::ranges::any_of(
        part, [&](const Statement& each) { return each.kind == Statement::Kind::load && each.node == id; });
}

/// Lanes are loaded by groups, a matrix by rows.
std::vector<std::size_t> rows_of(const KernelInput& input, const KernelModule& module)
{
    if (input.shape.rank == 2) return std::vector<std::size_t>(input.shape.rows, input.shape.columns);
    if (!has_lanes(input.role)) return {input.entries.size()};
    std::vector<std::size_t> rows;
    for (const LaneGroup& group : module.groups) rows.push_back(group.lanes.size());
    return rows;
}

/// `const S x = s[3], y = s[4];`: the entries that the part reads, a row a line.
void load_input(TextBlock& out, const BodyPart& part, const FunctionRequest& request, const KernelInput& input)
{
    if (input.shape.rank == 0) return;
    std::size_t k = 0;
    for (const std::size_t count : rows_of(input, request.module)) {
        std::vector<std::string> items;
        for (const std::size_t end = k + count; k < end; ++k) {
            const NodeId id = input.entries[k].input;
            if (!loads(part, id)) continue;
            const std::size_t columns = input.shape.columns;
            items.push_back(fmt::format("{} = {}", request.names.locals.inputs.at(id),
                                        input.shape.rank == 1
                                            ? fmt::format("{}[{}]", input.name, k)
                                            : fmt::format("{}({}, {})", input.name, k / columns, k % columns)));
        }
        if (!items.empty()) out.list("const S ", items, ";");
    }
}

/// What the part reads of the arguments: before anything is stored, which may be in their place.
void load_inputs(TextBlock& out, const BodyPart& part, const FunctionRequest& request)
{
    for (const KernelInput& input : request.inputs) load_input(out, part, request, input);
}

void load_unknowns(TextBlock& out, const Body& body, const BodyPart& part, const FunctionRequest& request)
{
    for (const ImplicitBlock* block : blocks_of(body, request))
        load_input(out, part, request, unknowns_of(*block, "solved_" + block->name));
}

/// Solves the implicit blocks that the body reads; answers whether a `status` was declared.
bool solve_blocks(TextBlock& out, const Body& body, const FunctionRequest& request)
{
    bool declared = false;
    const std::vector<const ImplicitBlock*> blocks = blocks_of(body, request);
    for (const ImplicitBlock* block : blocks) {
        out.line(fmt::format("std::array<S, {}> solved_{};", block->unknowns.size(), block->name));
        const std::string call = fmt::format("solve_{0}({1}, {2}, solved_{0})", block->name,
                                             name_of(request, ArrayRole::time), name_of(request, ArrayRole::state));
        if (!request.returns_status)
            out.line(fmt::format("static_cast<void>({});", call));
        else if (declared)
            out.line(fmt::format("status = StatusOf<S>::first(status, {});", call));
        else
            out.line(
                fmt::format("{} status = {};", has_checks(body) || blocks.size() > 1 ? "auto" : "const auto", call));
        declared = declared || request.returns_status;
    }
    return declared;
}

/// Of the class: its parameters, or its inputs.
struct Members {
    const char* object; ///< "parameters"
    const std::vector<Quantity>& quantities;
    const std::vector<std::string>& names;

    [[nodiscard]] bool holds(NodeId id) const
    {
        return std::ranges::any_of(quantities, [id](const Quantity& each) { return each.input == id; });
    }
};

/// All that the part reads at once: a compiler that finds loads between stores, which might overlap, packs neither. By
/// the names of all members where it reads most of them.
void load_members(TextBlock& out, const BodyPart& part, const FunctionRequest& request, const Members& of)
{
    std::vector<std::string> members;
    std::vector<std::string> items;
    for (std::size_t k = 0; k < of.quantities.size(); ++k) {
        const NodeId input = of.quantities[k].input;
        members.push_back(request.names.locals.inputs.at(input));
        if (loads(part, input)) items.push_back(fmt::format("{} = {}.{}", members.back(), of.object, of.names[k]));
    }
    if (items.size() > 1 && 2 * items.size() >= members.size())
        out.list("const auto [", members, fmt::format("] = {};", of.object));
    else
        out.list("const S ", items, ";");
}

void print_statements(TextBlock& out, const BodyPart& part, const FunctionRequest& request)
{
    const Members all[] = {{"parameters", request.module.parameters, request.names.parameters},
                           {"inputs", request.module.inputs, request.names.inputs}};
    bool loaded[] = {false, false}; // not before the first use: they need no register until then
    for (const Statement& statement : part) {
        if (statement.kind == Statement::Kind::load) {
            for (std::size_t k = 0; k < 2; ++k)
                if (!loaded[k] && all[k].holds(statement.node))
                    loaded[k] = (load_members(out, part, request, all[k]), true);
        } else if (statement.kind == Statement::Kind::store) {
            out.line(request.store(statement.index, spell(statement.expressions[0]).text));
        } else {
            for (const std::string& line : spell(statement)) out.line(line);
        }
    }
}

void print_usings(TextBlock& out, const Body& body)
{
    for (const std::string& declaration : using_declarations(body)) out.line(declaration);
}

std::string part_name(const FunctionRequest& request, std::size_t part)
{
    return fmt::format("{}_part_{}", request.name, part + 1);
}

/// May stand in the place of an output, which is written before all of it has been read.
bool is_overwritten(const KernelInput& input, const FunctionRequest& request)
{
    return has_lanes(input.role) && std::ranges::any_of(request.outputs, &OutputArgument::overlaps);
}

/// "S t, const State& s, ..., std::array<S, 12>& work, State& ds"; without types the arguments of a call.
std::string part_arguments(const Body& body, const FunctionRequest& request, bool types)
{
    std::vector<std::string> arguments;
    const auto add = [&](const std::string& type, const std::string& name) {
        arguments.push_back(types ? "[[maybe_unused]] " + type + " " + name : name);
    };
    for (const KernelInput& input : request.inputs)
        add(type_of(input), !types && is_overwritten(input, request) ? copy_of(input) : input.name);
    for (const ImplicitBlock* block : blocks_of(body, request))
        add(fmt::format("const std::array<S, {}>&", block->unknowns.size()), "solved_" + block->name);
    add(fmt::format("std::array<{}, {}>&", body.type, body.workspace), "work");
    for (const OutputArgument& output : request.outputs) add(output.type + "&", output.name);
    return comma_list(arguments);
}

void call_parts(TextBlock& out, const Body& body, const FunctionRequest& request)
{
    bool told = false;
    for (const KernelInput& input : request.inputs) {
        if (!is_overwritten(input, request)) continue;
        out.line(fmt::format("const State {} = {};{}", copy_of(input), input.name,
                             told ? "" : " // an output may stand in its place"));
        told = true;
    }
    out.line(fmt::format("std::array<{}, {}> work;", body.type, body.workspace));
    for (std::size_t k = 0; k < body.parts.size(); ++k) {
        const std::string call = fmt::format("{}({})", part_name(request, k), part_arguments(body, request, false));
        out.line(has_checks(body.parts[k]) ? fmt::format("status = StatusOf<S>::first(status, {});", call)
                                           : call + ";");
    }
}

} // namespace

bool reads(const Body& body, NodeId id)
{
    return std::ranges::binary_search(body.inputs, id);
}

bool reads(const Body& body, const KernelInput& input)
{
    return std::ranges::any_of(input.entries, [&](const Quantity& entry) { return reads(body, entry.input); });
}

std::string maybe_unused(bool used)
{
    return used ? "" : "[[maybe_unused]] ";
}

KernelInput unknowns_of(const ImplicitBlock& block, std::string name)
{
    KernelInput input{std::move(name), ArrayRole::value, {1, block.unknowns.size(), 1}, {}};
    for (const NodeId id : block.unknowns) input.entries.push_back({{}, {}, {}, id});
    return input;
}

std::string type_of(const KernelInput& input)
{
    if (input.shape.rank == 0) return "S";
    if (has_lanes(input.role)) return "const State&";
    return fmt::format("const Eigen::Matrix<S, {}, {}>&", input.shape.rows, input.shape.columns);
}

std::string arguments_of(const Body& body, const FunctionRequest& request)
{
    const bool cut = body.parts.size() > 1;
    const bool solves = !blocks_of(body, request).empty();
    std::vector<std::string> arguments;
    for (const KernelInput& input : request.inputs) {
        const bool point = input.role == ArrayRole::time || input.role == ArrayRole::state;
        arguments.push_back(fmt::format("{}{} {}", maybe_unused(cut || (solves && point) || reads(body, input)),
                                        type_of(input), input.name));
    }
    for (const OutputArgument& output : request.outputs)
        arguments.push_back(fmt::format("{}{}& {}", maybe_unused(output.used), output.type, output.name));
    return comma_list(arguments);
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
                   fmt::format("[[gnu::noinline]] {} {}({}) const noexcept", has_checks(part) ? "status_t<S>" : "void",
                               part_name(request, k), part_arguments(body, request, true)));
        print_usings(out, body);
        load_inputs(out, part, request);
        load_unknowns(out, body, part, request);
        if (has_checks(part)) out.line("auto status = StatusOf<S>::good();");
        print_statements(out, part, request);
        if (has_checks(part)) out.line("return status;");
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
    if (whole) load_inputs(out, body.parts[0], request);
    bool declared = solve_blocks(out, body, request);
    if (has_checks(body) && !declared) out.line("auto status = StatusOf<S>::good();");
    declared = declared || has_checks(body);
    if (!whole) return call_parts(out, body, request), declared;
    load_unknowns(out, body, body.parts[0], request);
    print_statements(out, body.parts[0], request);
    return declared;
}

} // namespace lagen
