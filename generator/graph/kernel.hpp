// SPDX-License-Identifier: GPL-2.0-or-later
/// Kernels: named functions on a graph, as the header printer and the interpreter see them. No mechanics in here.
#pragma once

#include "graph/unknowns/implicit.hpp"

#include <memory>
#include <string>
#include <vector>

namespace lagen {

/// One entry of an output array.
struct KernelEntry {
    std::size_t row = 0;
    std::size_t column = 0;
    NodeId node = 0;
};

/// An array that a kernel writes. Entries that are not listed are zero. Rows and columns count from 0.
struct KernelOutput {
    std::string name; ///< as in C++ ("ds", "values")
    std::size_t rows = 1;
    std::size_t columns = 1;
    std::vector<KernelEntry> entries; ///< by rows
};

/// What a kernel returns and takes, in C++.
enum class KernelShape {
    right_hand_side, ///< Status rhs(Scalar t, const State& s, State& ds) const noexcept
    scalar,          ///< Scalar NAME(Scalar t, const State& s) const noexcept
    vector,          ///< Eigen::Matrix<Scalar, rows, 1> NAME(t, s)
    matrix,          ///< Eigen::Matrix<Scalar, rows, columns> NAME(t, s)
    sparse,          ///< void NAME(t, s, values) with constexpr NAME_rows / NAME_columns arrays
    directional,     ///< Status NAME(t, s, const State& v, State& dv): linear in v, KernelModule::direction
};

/// A function of (t, state, parameters) with one output.
struct Kernel {
    std::string name; ///< as in C++: "rhs", "energy", "momentum", ...
    KernelShape shape = KernelShape::scalar;
    KernelOutput output;
    std::vector<std::string> documentation; ///< lines of its docstring: formula, shape, index order, units
    /// Names of the entries of a vector (observables, events, ...); emitted as constexpr NAME_names; may be empty.
    std::vector<std::string> entry_names;
    /// Divisors that are 1 x 1 blocks of a matrix: where one vanishes the kernel answers singular_mass_matrix.
    std::vector<NodeId> pivots;
};

/// A named quantity of a module: parameter or state lane.
struct Quantity {
    std::string name; ///< in the model; the header alters what C++ cannot bear
    std::string text; ///< what it is; may be empty
    std::string unit; ///< may be empty
    NodeId input = 0; ///< its input node
};

/// Everything that one generated class holds.
struct KernelModule {
    std::string name;  ///< class name: model name, with _FORM for forms other than lagrange
    std::string model; ///< model name
    std::string title;
    std::string form;                   ///< its name
    std::string hash;                   ///< of the model's content, 16 hexadecimal digits
    std::string regenerate;             ///< the command that makes this header again
    std::vector<std::string> warnings;  ///< e.g. that the model was not proved
    std::vector<std::string> equations; ///< the equations in UTF-8, a line each, for the banner
    std::string derive;                 ///< the command that prints all of them
    std::shared_ptr<Graph> graph;
    NodeId time = 0; ///< the input t
    std::vector<Quantity> parameters;
    std::vector<NodeId> parameter_defaults; ///< closed nodes without inputs, one a parameter
    /// Conditions on the parameters alone, as text, with a node each that is positive where it holds.
    std::vector<std::pair<std::string, NodeId>> parameter_conditions;
    std::vector<Quantity> base;          ///< first lanes of State
    std::vector<Quantity> fibre;         ///< the other lanes (fibre coordinates, or momenta)
    std::string fibre_name = "Fibre";    ///< the struct of the second group
    std::vector<Quantity> direction;     ///< inputs of a vector v beside the state, a lane each; may be empty
    std::vector<ImplicitBlock> implicit; ///< unknowns of the kernels, in the order in which they are solved
    std::vector<Kernel> kernels;
};

[[nodiscard]] bool has_kernel(const KernelModule& module, const std::string& name);
/// Throws InternalError where the module has none of that name.
[[nodiscard]] const Kernel& kernel_named(const KernelModule& module, const std::string& name);

} // namespace lagen
