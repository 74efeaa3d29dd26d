// SPDX-License-Identifier: GPL-2.0-or-later
/// Hints for unknown names: other languages' spellings, slips of the hand, a short list.
#include "expression/name_hints.hpp"

#include "expression/derivative.hpp"
#include "text/alphabet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace lagen {

namespace {

struct Foreign {
    std::string_view name;
    const char* hint;
};

constexpr const char* infinity_hint =
    "infinity is no number: the open end of a control's bounds is \"-inf\" below and \"inf\" above";

constexpr std::array foreign_symbols{
    Foreign{"π", "the constant is written pi"},
    Foreign{"Pi", "the constant is written pi"},
    Foreign{"PI", "the constant is written pi"},
    Foreign{"M_PI", "the constant is written pi"},
    Foreign{"e", "the exponential function is written exp(x)"},
    Foreign{"inf", infinity_hint},
    Foreign{"infinity", infinity_hint},
};

/// Quantities that a model may use under names of its own.
constexpr std::array quantities{std::pair{"E", "energy"}, std::pair{"H", "hamiltonian"}, std::pair{"L", "lagrangian"}};

constexpr std::array foreign_functions{
    Foreign{"ln", "the natural logarithm is written log(x)"},
    Foreign{"log10", "log is the natural logarithm: log(x)/log(10)"},
    Foreign{"log2", "log is the natural logarithm: log(x)/log(2)"},
    Foreign{"pow", "a power is written x^y"},
    Foreign{"cbrt", "a cube root is written x^(1/3)"},
    Foreign{"hypot", "this is written sqrt(x^2 + y^2)"},
    Foreign{"arcsin", "did you mean 'asin'?"},
    Foreign{"arccos", "did you mean 'acos'?"},
    Foreign{"arctan", "did you mean 'atan'?"},
    Foreign{"arctan2", "did you mean 'atan2'?"},
    Foreign{"fabs", "did you mean 'abs'?"},
    Foreign{"sgn", "did you mean 'sign'?"},
    Foreign{"sec", "this is written 1/cos(x)"},
    Foreign{"csc", "this is written 1/sin(x)"},
    Foreign{"cot", "this is written cos(x)/sin(x)"},
    Foreign{"skew", "the skew matrix of a vector is written hat(x)"},
    Foreign{"inv", "an inverse is written inverse(A)"},
    Foreign{"coth", "this is written cosh(x)/sinh(x)"},
    Foreign{"asinh", "this is written log(x + sqrt(x^2 + 1))"},
    Foreign{"acosh", "this is written log(x + sqrt(x^2 - 1))"},
    Foreign{"atanh", "this is written log((1 + x)/(1 - x))/2"},
};

/// "heading a, b, c", cut after twenty names.
std::string listing(const char* heading, const std::vector<std::string>& known)
{
    constexpr std::size_t most = 20;
    const std::vector<std::string> shown(known.begin(),
                                         known.begin() + static_cast<std::ptrdiff_t>(std::min(most, known.size())));
    return fmt::format("{}{}{}", heading, fmt::join(shown, ", "), known.size() > most ? ", ..." : "");
}

} // namespace

std::string hint_for_symbol(const std::string& name, const std::vector<std::string>& known)
{
    const auto plain = without_two_dots(name);
    if (name.find("\u0308") != std::string::npos || (plain && std::ranges::find(known, *plain) != known.end()))
        return "two dots are an acceleration, which follows from the equations";
    const std::string nearest = nearest_name(name, known);
    if (!nearest.empty()) return fmt::format("did you mean '{}'?", nearest);
    for (const Foreign& entry : foreign_symbols)
        if (entry.name == name) return entry.hint;
    for (const auto& [letter, quantity] : quantities)
        if (name == letter && std::ranges::find(known, quantity) != known.end())
            return fmt::format("did you mean '{}'?", quantity);
    return known.empty() ? fmt::format("sizes are declared first: [sizes] {} = 3", name)
                         : listing("known names are ", known);
}

std::string hint_for_function(const std::string& name, std::vector<std::string> known)
{
    for (const Foreign& entry : foreign_functions)
        if (entry.name == name) return entry.hint;
    for (const FunctionEntry& entry : function_table()) known.emplace_back(entry.name);
    for (const DerivativeEntry& entry : derivative_table()) known.emplace_back(entry.name);
    const std::string nearest = nearest_name(name, known);
    if (!nearest.empty()) return fmt::format("did you mean '{}'?", nearest);
    return listing("known functions are ", known);
}

} // namespace lagen
