// SPDX-License-Identifier: GPL-2.0-or-later
/// Kernels: named functions on a graph, as the header printer and the interpreter see them. No mechanics in here.
#pragma once

#include "graph/series/taylor.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lagen {

/// A named quantity of a module: a parameter, a lane of the state, an entry of an input.
struct Quantity {
    std::string name; ///< in the model; the header alters what C++ cannot bear
    std::string text; ///< what it is; may be empty
    std::string unit; ///< may be empty
    NodeId input = 0; ///< its input node
};

/// The extent of a number (rank 0), a column (rank 1) or a matrix (rank 2).
struct ArrayShape {
    int rank = 0;
    std::size_t rows = 1;
    std::size_t columns = 1;
};

/// What an array is to a kernel. A state and a tangent (a rate, a perturbation) have an entry a lane of the module.
enum class ArrayRole { time, state, tangent, value };

[[nodiscard]] inline bool has_lanes(ArrayRole role)
{
    return role == ArrayRole::state || role == ArrayRole::tangent;
}

/// An argument that a kernel reads. Parameters are none: they belong to the module.
struct KernelInput {
    std::string name; ///< as in C++: "t", "s", "xk1", "h"
    ArrayRole role = ArrayRole::value;
    ArrayShape shape;
    std::vector<Quantity> entries; ///< by rows
};

/// One entry of an output array.
struct KernelEntry {
    std::size_t row = 0;
    std::size_t column = 0;
    NodeId node = 0;
};

/// An array that a kernel computes. Entries that are not listed are zero. Rows and columns count from 0.
struct KernelOutput {
    std::string name; ///< as in C++ ("ds", "values")
    ArrayShape shape;
    std::vector<KernelEntry> entries; ///< by rows
    ArrayRole role = ArrayRole::value;
    bool sparse = false; ///< given by its entries, with constexpr arrays of their rows and columns
    std::vector<std::string> entry_names = {}; ///< of a vector (observables, ..): constexpr NAME_names; may be empty
};

/// What a kernel looks at beside its factorisations: divisors that are 1 x 1 blocks of a matrix. Where one of either
/// has no inverse it answers singular_mass_matrix.
struct KernelChecks {
    std::vector<NodeId> pivots;
    std::string failures = {}; ///< what its docstring says where one of them can fail
};

/// A function of its inputs and of the parameters. In C++ one rule makes its signature of it:
///   with checks                       status_t<S> NAME(inputs, outputs by reference)
///   without, one output, not sparse   its value: S, a column or a matrix
///   else                              void NAME(inputs, outputs by reference)
/// An output may stand in the place of a state or a tangent that is read. A kernel of one sparse output is called
/// NAME_values; NAME gives the same as a dense matrix, where that is small.
/// With directions its one output, sparse, is computed by columns, several at once (emit/print_columns.hpp).
///   with a recurrence                 status_t<S> NAME(inputs, int order, TaylorSeries<S, lanes, most>& x)
/// Its one output is the rate of the state, and x the Taylor coefficients of the motion.
struct Kernel {
    std::string name; ///< as in C++: "rhs", "energy", "momentum", ...
    std::vector<KernelInput> inputs;
    std::vector<KernelOutput> outputs;
    std::optional<KernelChecks> checks = {};
    std::optional<TaylorRecurrence> recurrence = {}; ///< of the output, along the state and time
    /// Inputs, one a column of the output: with the unit vector of a column in their place the node of an entry in it
    /// is its value; linear in them. Entries of one row share their node.
    std::vector<NodeId> directions = {};
    std::vector<std::string> documentation = {}; ///< lines of its docstring: formula, shape, index order, units
};

/// The nodes of all entries of all outputs.
[[nodiscard]] std::vector<NodeId> nodes_of(const Kernel& kernel);

/// Lanes of State that stand together, a struct in C++.
struct LaneGroup {
    std::string type; ///< of the struct: "Base", "Fibre", "Momenta"
    std::string role; ///< "base", "fibre": its argument of state(), and ROLE_dimension
    std::string text; ///< what the struct is
    std::vector<Quantity> lanes;
};

/// What the kernels of a module say together.
enum class ModuleKind {
    vector_field,     ///< rhs(t, s) is the rate of s
    step,             ///< a residual of two states vanishes for a step of a discrete motion
    boundary_problem, ///< residuals at both ends of an interval
};

/// Is State (x, v), as many base coordinates as other lanes, with x' = v lane by lane? And is v' free of v?
struct SecondOrder {
    enum class Kind { no, general, velocity_free };
    Kind kind = Kind::no;
    std::string obstacle; ///< to the next kind, in names of the model: "x' is not p_x", "u' depends on v"
};

/// Is x' free of the base coordinates x and y' of the other lanes y? And is x' affine in y, with coefficients that the
/// parameters alone make?
struct Separation {
    enum class Kind { no, separable, affine };
    Kind kind = Kind::no;
    std::string obstacle; ///< to the next kind, in names of the model: "x' depends on x"
};

/// Kernels flow_0, flow_1, .. of parts that add up to the right-hand side.
struct Flows {
    std::size_t count = 0;
    std::string obstacle = {}; ///< where they were looked for and there are none, in names of the model
};

/// Lanes that are the entries, by rows, of a matrix of a group.
struct GroupLanes {
    struct Entry {
        std::size_t generator, row, column;
        Rational value;
    };
    std::string name;  ///< of the matrix
    std::string group; ///< "SO(3)"
    std::size_t first = 0, size = 0;
    std::vector<Entry> generators; ///< of all of them, but zeros
};

/// Lanes that a group moves linearly, by the kernels algebra_element, algebra_action and algebra_bracket.
struct GroupMotion {
    std::size_t dimension = 0; ///< of its Lie algebra
    std::vector<bool> moved;   ///< of every lane; empty where no group moves any
    std::string obstacle;      ///< in names of the model, where none does
};

/// Of a discrete motion: how the lanes of its arrows are divided.
struct StepNumbers {
    std::size_t horizontal = 0; ///< lanes of x_next - x
    std::size_t order = 0;      ///< order^2 lanes of W - 1
    bool cayley = false;        ///< Cayley's map leads into the group of W
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
    std::vector<Quantity> inputs;           ///< what acts from outside: members beside the parameters
    std::vector<NodeId> input_defaults;     ///< over the parameters, one an input
    std::vector<std::string> constants;     ///< "m = 2": parameters of the model that are constants here
    /// Conditions on the parameters alone, as text, with a node each that is positive where it holds.
    std::vector<std::pair<std::string, NodeId>> parameter_conditions;
    ModuleKind kind = ModuleKind::vector_field;
    std::vector<LaneGroup> groups; ///< of the lanes of State, in their order
    std::vector<GroupLanes> matrices;
    GroupMotion motion;
    SecondOrder second_order;        ///< of the right-hand side
    std::optional<StepNumbers> step; ///< of kind step
    Flows flows;
    std::vector<ImplicitBlock> implicit; ///< unknowns of the kernels at (t, s), in the order in which they are solved
    std::vector<Kernel> kernels;
};

/// The lanes of State.
[[nodiscard]] std::vector<Quantity> lanes_of(const KernelModule& module);

/// `t` and `s`, the arguments of every kernel at a time and a state.
[[nodiscard]] std::vector<KernelInput> point_inputs(const KernelModule& module);

/// What the graph proves of these rates, one a lane of State. What it calls `general` may be velocity_free, where terms
/// cancel that no rule of the graph brings together; never the other way round.
[[nodiscard]] SecondOrder second_order_of(const KernelModule& module, const std::vector<NodeId>& rates);
/// Of a module with a right-hand side; adds derivatives to its graph.
[[nodiscard]] Separation separation_of(const KernelModule& module);

[[nodiscard]] bool has_kernel(const KernelModule& module, const std::string& name);
/// Throws InternalError where the module has none of that name.
[[nodiscard]] const Kernel& kernel_named(const KernelModule& module, const std::string& name);

} // namespace lagen
