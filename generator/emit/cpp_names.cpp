// SPDX-License-Identifier: GPL-2.0-or-later
/// Names of a model as C++ identifiers.
#include "emit/macro_names.hpp"
#include "emit/print_header.hpp"
#include "text/alphabet.hpp"
#include "text/diagnostic.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace lagen {

namespace {

// Names of a model as identifiers of a programming language.

/// Letters of ASCII, digits and '_' are kept, Greek is spelled, everything else is uXXXX; "x[1]" becomes x_1; a leading
/// digit and an empty name gain an 'n' in front. Two underscores in a row are reserved in C++, so runs of them become
/// one.
std::string spell(std::string_view name)
{
    std::string result;
    for (std::size_t at = 0; at < name.size();) {
        const char c = name[at];
        const GreekLetter* greek = greek_letter_at(name, at);
        const CodePoint point = decode_utf8(name, at);
        std::string piece;
        if (c == '_' || is_digit(point.value) || (point.value < 0x80 && is_letter(point.value)))
            piece = c;
        else if (c == '[' || c == ',')
            piece = "_";
        else if (greek != nullptr && !greek->name.empty())
            piece = greek->name;
        else if (c != ']' && c != ' ')
            piece = fmt::format("u{:04X}", static_cast<std::uint32_t>(point.value));
        at += std::max<std::size_t>(point.length, 1);
        if (piece == "_" && !result.empty() && result.back() == '_') continue;
        result += piece;
    }
    if (result.empty() || (result[0] >= '0' && result[0] <= '9')) result.insert(0, "n");
    if (result[0] == '_') result.insert(0, "n"); // reserved at file scope, and _X everywhere
    return result;
}

/// ASCII letters, digits and '_': "x[1]" becomes x_1, Greek is transliterated, other letters become "uXXXX". A reserved
/// name gains a trailing '_'; distinct names stay distinct (a second clash gains another '_'), and one that needs no
/// change keeps its own.
std::vector<std::string> identifiers(const std::vector<std::string>& names,
                                     const std::function<bool(std::string_view)>& is_reserved)
{
    std::set<std::string> plain; // a name that needs no change is never taken by one that does
    for (const std::string& name : names)
        if (spell(name) == name && !is_reserved(name)) plain.insert(name);
    std::set<std::string> taken;
    std::vector<std::string> result;
    for (const std::string& name : names) {
        std::string spelled = spell(name);
        if (is_reserved(spelled)) spelled += '_';
        while (taken.contains(spelled) || (spelled != name && plain.contains(spelled)))
            spelled += spelled.back() == '_' ? "1_" : "_"; // never two underscores in a row
        taken.insert(spelled);
        result.push_back(std::move(spelled));
    }
    return result;
}

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
