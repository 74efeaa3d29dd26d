// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/line/values.hpp"

#include "emit/print_literal.hpp"
#include "expression/parse.hpp"
#include "graph/core/evaluate.hpp"
#include "graph/core/lower.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace lagen {

namespace {

void require_parameters(const Model& model, const std::string& name, const Excerpt& text,
                        const std::vector<Tree>& trees)
{
    for (const Tree& tree : trees)
        for (const std::string& used : names_in(tree))
            if (std::ranges::none_of(model.parameters, [&](const Parameter& each) { return each.symbol.name == used; }))
                throw ModelError(fmt::format("--{} depends on '{}', which is no parameter", name, used),
                                 text.range(0, text.text.size()), "give numbers, or expressions of parameters");
}

} // namespace

ArrayValue option_array(const Model& model, const std::string& name, const Excerpt& text)
{
    ArrayValue value = model.scope.close_array(parse_expression(text));
    require_parameters(model, name, text, value.entries);
    return value;
}

Tree option_tree(const Model& model, const std::string& name, const Excerpt& text)
{
    const Tree tree = model.scope.close(parse_expression(text));
    require_parameters(model, name, text, {tree});
    return tree;
}

double GridAxis::at(std::uint64_t place) const
{
    Rational part(place, std::max<std::uint64_t>(count - 1, 1));
    part.canonicalize();
    return nearest_double(first + (last - first) * part);
}

Rational end_of_range(const Model& model, const std::string& option, const Excerpt& text)
{
    const Tree tree = option_tree(model, option, text);
    const SourceRange where = text.range(0, text.text.size());
    if (!names_in(tree).empty())
        throw ModelError(fmt::format("a range of --{} ends at an expression of '{}', where a number is required",
                                     option, names_in(tree).front()),
                         where);
    Graph graph;
    const NodeId root = Lowering(graph)(tree);
    const std::vector<Rational> exact = evaluate_exactly(graph, {&root, 1}, {});
    const auto value =
        exact.empty() ? static_cast<double>(evaluate<long double>(graph, {&root, 1}, {})[0]) : nearest_double(exact[0]);
    if (!std::isfinite(value))
        throw ModelError(fmt::format("a range of --{} ends at {}, where a finite number is required", option, value),
                         where);
    return exact.empty() ? Rational(value) : exact[0];
}

std::vector<Excerpt> parts_of_range(const Excerpt& text)
{
    std::vector<Excerpt> parts;
    for (std::size_t begin = 0, end = 0; end != std::string::npos; begin = end + 1) {
        end = text.text.find(':', begin);
        parts.push_back(trimmed(text, begin, std::min(end, text.text.size())));
    }
    return parts;
}

std::optional<std::uint64_t> read_whole(const std::string& text)
{
    constexpr std::size_t most_digits = 18;
    std::uint64_t value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || stop != end || text.size() > most_digits) return std::nullopt;
    return value;
}

std::uint64_t whole_option(const Options& options, const std::string& name, std::uint64_t least, std::uint64_t most)
{
    const std::optional<std::uint64_t> value = read_whole(options.get(name));
    if (value && *value >= least && *value <= most) return *value;
    throw UsageError(fmt::format("--{} is '{}', where a whole number from {} {} is required", name, options.get(name),
                                 least, most == UINT64_MAX ? "on" : fmt::format("to {}", most)));
}

} // namespace lagen
