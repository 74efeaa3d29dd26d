// SPDX-License-Identifier: GPL-2.0-or-later
/// The functions of the expression language: what the language and the printers of equations know of each stands in
/// its one row here. What mathematics knows of it stands in the operator table, graph/operators.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace lagen {

/// Functions built into the language. `minimum`, `maximum`, `sign` and `select` (spelled min max sign if) are not
/// smooth: legal in forces, observables and events only.
enum class Function {
    sin,
    cos,
    tan,
    asin,
    acos,
    atan,
    atan2,
    sinh,
    cosh,
    tanh,
    exp,
    log,
    sqrt,
    abs,
    minimum,
    maximum,
    sign,
    select,
    stumpff, ///< stumpff(k, z) = sum_j (-z)^j / (2j+k)!, k a literal 0 .. 32; what exp(hat(v)) and its derivatives need
    erf,     ///< 2/sqrt(pi) times the integral of exp(-s^2) from 0 to x
    // Functions of vectors and matrices are gone after closing.
    dot,
    cross,
    norm,
    trace,
    transpose,
    det,
    inverse,
    diag,
    identity,
    hat,
    vee,
    cay,
};

/// f(-x) = f(x), f(-x) = -f(x), or neither.
enum class Parity { none, even, odd };

struct FunctionEntry {
    Function function = Function::sin;
    const char* name = "";
    std::size_t arity = 1;
    bool smooth = true; ///< false: allowed in observables, forces and events only
    bool array = false; ///< takes or gives vectors or matrices; closing replaces it by scalars
    Parity parity = Parity::none;
    bool raised_by_name = false; ///< a power of it is written with the exponent behind the name: sin^2(x)
    const char* latex = "";      ///< empty: written with signs of its own, or gone after closing
};

namespace function_rows {

constexpr FunctionEntry function(Function f, const char* name, const char* latex, Parity parity, bool raised = false)
{
    return {f, name, 1, true, false, parity, raised, latex};
}

constexpr FunctionEntry kinked(Function f, const char* name, std::size_t arity, const char* latex)
{
    return {f, name, arity, false, false, Parity::none, false, latex};
}

constexpr FunctionEntry of_arrays(Function f, const char* name, std::size_t arity = 1)
{
    return {f, name, arity, true, true, Parity::none, false, ""};
}

} // namespace function_rows

/// Every built-in function, in the order of the enumeration.
inline constexpr std::array function_rows_in_order{
    function_rows::function(Function::sin, "sin", "\\sin", Parity::odd, true),
    function_rows::function(Function::cos, "cos", "\\cos", Parity::even, true),
    function_rows::function(Function::tan, "tan", "\\tan", Parity::odd, true),
    function_rows::function(Function::asin, "asin", "\\arcsin", Parity::odd),
    function_rows::function(Function::acos, "acos", "\\arccos", Parity::none),
    function_rows::function(Function::atan, "atan", "\\arctan", Parity::odd),
    FunctionEntry{Function::atan2, "atan2", 2, true, false, Parity::none, false, "\\operatorname{atan2}"},
    function_rows::function(Function::sinh, "sinh", "\\sinh", Parity::odd, true),
    function_rows::function(Function::cosh, "cosh", "\\cosh", Parity::even, true),
    function_rows::function(Function::tanh, "tanh", "\\tanh", Parity::odd, true),
    function_rows::function(Function::exp, "exp", "\\exp", Parity::none),
    function_rows::function(Function::log, "log", "\\log", Parity::none),
    function_rows::function(Function::sqrt, "sqrt", "", Parity::none),
    function_rows::function(Function::abs, "abs", "", Parity::even),
    function_rows::kinked(Function::minimum, "min", 2, "\\min"),
    function_rows::kinked(Function::maximum, "max", 2, "\\max"),
    function_rows::kinked(Function::sign, "sign", 1, "\\operatorname{sign}"),
    function_rows::kinked(Function::select, "if", 3, "\\operatorname{if}"),
    FunctionEntry{Function::stumpff, "stumpff", 2, true, false, Parity::none, false, ""},
    function_rows::function(Function::erf, "erf", "\\operatorname{erf}", Parity::odd),
    function_rows::of_arrays(Function::dot, "dot", 2),
    function_rows::of_arrays(Function::cross, "cross", 2),
    function_rows::of_arrays(Function::norm, "norm"),
    function_rows::of_arrays(Function::trace, "trace"),
    function_rows::of_arrays(Function::transpose, "transpose"),
    function_rows::of_arrays(Function::det, "det"),
    function_rows::of_arrays(Function::inverse, "inverse"),
    function_rows::of_arrays(Function::diag, "diag"),
    function_rows::of_arrays(Function::identity, "identity"),
    function_rows::of_arrays(Function::hat, "hat"),
    function_rows::of_arrays(Function::vee, "vee"),
    function_rows::of_arrays(Function::cay, "cay"),
};

[[nodiscard]] constexpr std::span<const FunctionEntry> function_table()
{
    return function_rows_in_order;
}

[[nodiscard]] constexpr const FunctionEntry& entry_of(Function function)
{
    return function_rows_in_order[static_cast<std::size_t>(function)];
}

static_assert([] {
    for (std::size_t k = 0; k < function_table().size(); ++k)
        if (function_table()[k].function != static_cast<Function>(k)) return false;
    return function_table().back().function == Function::cay;
}()); // in the order of the enumeration, to its last entry

[[nodiscard]] const FunctionEntry* find_function(std::string_view name); ///< nullptr where there is none; "tr" is trace
/// A name that stands for something of the language where parentheses follow: a built-in function, sum, product.
[[nodiscard]] bool is_function_name(std::string_view name);
/// A name that a model cannot declare. The array functions, sum and product can be: without parentheses the declared
/// name is meant.
[[nodiscard]] bool is_reserved_name(std::string_view name);

enum class Comparison { less, less_equal, greater, greater_equal, equal, not_equal };

/// "<", "<=", ">", ">=", "==", "!=".
[[nodiscard]] constexpr const char* spelling(Comparison comparison)
{
    switch (comparison) {
    case Comparison::less: return "<";
    case Comparison::less_equal: return "<=";
    case Comparison::greater: return ">";
    case Comparison::greater_equal: return ">=";
    case Comparison::equal: return "==";
    case Comparison::not_equal: return "!=";
    }
    return "?";
}

} // namespace lagen
