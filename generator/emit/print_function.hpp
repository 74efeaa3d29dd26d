// SPDX-License-Identifier: GPL-2.0-or-later
/// A function body as text: what it reads, the implicit blocks that it solves, its lines; a long one as a function that
/// calls its parts in turn.
#pragma once

#include "emit/module_names.hpp"
#include "emit/text_block.hpp"

#include <functional>
#include <span>

namespace lagen {

struct OutputArgument {
    std::string type; ///< "State"
    std::string name; ///< "ds"
    bool used = true;
    bool overlaps = false; ///< may be the same object as a state or a tangent that is read
};

struct FunctionRequest {
    const KernelModule& module;
    const ModuleNames& names;
    std::string name;            ///< of the member function
    bool returns_status = false; ///< else implicit blocks say by NaN that they found nothing
    std::span<const KernelInput> inputs = {};
    std::vector<OutputArgument> outputs = {};                          ///< what the parts store to
    std::function<std::string(std::size_t, const std::string&)> store; ///< "ds[3] = w2 * w3;"
};

/// For the documentation of a function with groups of terms.
inline constexpr const char* about_terms = "v0, v1, ..: terms that are alike, a lane each (lagen/lanes/terms.hpp).";

[[nodiscard]] bool reads(const Body& body, NodeId id);
[[nodiscard]] bool reads(const Body& body, const KernelInput& input);
[[nodiscard]] std::string maybe_unused(bool used);

/// The unknowns of a block as an array.
[[nodiscard]] KernelInput unknowns_of(const ImplicitBlock& block, std::string name);

/// The type of an argument: S, State, std::array or a matrix of Eigen.
[[nodiscard]] std::string type_of(const KernelInput& input);

/// "S t, const State& s, State& ds" with what the body leaves unread marked.
[[nodiscard]] std::string arguments_of(const Body& body, const FunctionRequest& request);

/// An opening brace under `signature`, and a closing one.
void open_block(TextBlock& out, const std::string& signature);
void close_block(TextBlock& out);

/// The parts of a long body as private member functions; nothing where it is whole.
void print_parts(TextBlock& out, const Body& body, const FunctionRequest& request);

/// Everything between the braces, or before the `return`. Answers whether a `status` was declared.
bool print_lines(TextBlock& out, const Body& body, const FunctionRequest& request);

} // namespace lagen
