// SPDX-License-Identifier: GPL-2.0-or-later
/// Names of a model as C++ identifiers.
#include "emit/identifiers.hpp"
#include "emit/macro_names.hpp"
#include "emit/print_header.hpp"

#include <algorithm>

namespace lagen {

namespace {

/// Keywords and alternative tokens of C++20.
constexpr std::string_view keywords[] = {
    "alignas",     "alignof",   "and",        "and_eq",    "asm",      "auto",         "bitand",
    "bitor",       "bool",      "break",      "case",      "catch",    "char",         "char8_t",
    "char16_t",    "char32_t",  "class",      "compl",     "concept",  "const",        "consteval",
    "constexpr",   "constinit", "const_cast", "continue",  "co_await", "co_return",    "co_yield",
    "decltype",    "default",   "delete",     "do",        "double",   "dynamic_cast", "else",
    "enum",        "explicit",  "export",     "extern",    "false",    "float",        "for",
    "friend",      "goto",      "if",         "inline",    "int",      "long",         "mutable",
    "namespace",   "new",       "noexcept",   "not",       "not_eq",   "nullptr",      "operator",
    "or",          "or_eq",     "private",    "protected", "public",   "register",     "reinterpret_cast",
    "requires",    "return",    "short",      "signed",    "sizeof",   "static",       "static_assert",
    "static_cast", "struct",    "switch",     "template",  "this",     "thread_local", "throw",
    "true",        "try",       "typedef",    "typeid",    "typename", "union",        "unsigned",
    "using",       "virtual",   "void",       "volatile",  "wchar_t",  "while",        "xor",
    "xor_eq",
};

/// Functions and macros in small letters that <cmath>, <complex.h>, <cstdlib> and their like may put into the global
/// namespace.
// clang-format off
constexpr std::string_view library[] = {
    "DOMAIN", "SING", "PLOSS", "TLOSS", "assert", "major", "minor", "signgam", "complex", "imaginary", "abs", "acos",
    "acosh", "asin", "asinh", "atan", "atan2", "atanh", "cbrt", "ceil", "copysign", "cos", "cosh", "div", "drem",
    "erf", "erfc", "exp", "exp10", "exp2", "expm1", "fabs", "fdim", "finite", "floor", "fma", "fmax", "fmin", "fmod",
    "frexp", "gamma", "hypot", "ilogb", "index", "isinf", "isnan", "j0", "j1", "jn", "labs", "ldexp", "lgamma",
    "llrint", "llround", "log", "log10", "log1p", "log2", "logb", "lrint", "lround", "modf", "nan", "nearbyint",
    "nextafter", "nexttoward", "pow", "pow10", "remainder", "remquo", "rint", "round", "scalb", "scalbln", "scalbn",
    "significand", "sin", "sincos", "sinh", "sqrt", "tan", "tanh", "tgamma", "time", "trunc", "y0", "y1", "yn",
};
// clang-format on

/// Types and namespaces that the header itself uses.
constexpr std::string_view own[] = {
    "S",     "Scalar", "State",    "Base",  "Fibre", "Momenta", "Parameters",
    "Eigen", "Status", "StatusOf", "lagen", "std",   "t",
};

bool is_reserved(std::string_view name)
{
    return std::ranges::count(keywords, name) + std::ranges::count(library, name) + std::ranges::count(own, name) > 0 ||
           is_macro_name(name);
}

} // namespace

std::vector<std::string> cpp_names(const std::vector<std::string>& names)
{
    return identifiers(names, is_reserved);
}

} // namespace lagen
