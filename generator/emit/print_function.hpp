// SPDX-License-Identifier: GPL-2.0-or-later
/// A function body as text: what it reads, the implicit blocks that it solves, its lines; a long one as a function that
/// calls its parts in turn.
#pragma once

#include "emit/module_names.hpp"
#include "emit/text_block.hpp"

#include <functional>

namespace lagen {

struct FunctionRequest {
    const KernelModule& module;
    const ModuleNames& names;
    std::string name;             ///< of the member function
    bool returns_status = false;  ///< else implicit blocks say by NaN that they found nothing
    bool reads_direction = false; ///< has an argument `v`
    std::string output;           ///< "State& ds": what the parts store to
    bool output_is_state = false; ///< may be the same object as the state that is read
    std::function<std::string(std::size_t, const std::string&)> store; ///< "ds[3] = w2 * w3;"
    const ImplicitBlock* own = nullptr; ///< whose unknowns stand in an argument `unknowns`
};

[[nodiscard]] bool reads(const Body& body, NodeId id);
/// A lane of the state, or an unknown of an implicit block, which is found from the state.
[[nodiscard]] bool reads_lane(const Body& body, const KernelModule& module);

/// "S t, const State& s" with what the body leaves unread marked.
[[nodiscard]] std::string state_arguments(const Body& body, const KernelModule& module);
[[nodiscard]] std::string maybe_unused(bool used);

/// An opening brace under `signature`, and a closing one.
void open_block(TextBlock& out, const std::string& signature);
void close_block(TextBlock& out);

/// The parts of a long body as private member functions; nothing where it is whole.
void print_parts(TextBlock& out, const Body& body, const FunctionRequest& request);

/// Everything between the braces, or before the `return`. Answers whether a `status` was declared.
bool print_lines(TextBlock& out, const Body& body, const FunctionRequest& request);

} // namespace lagen
