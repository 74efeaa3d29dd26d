// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/sympy_names.hpp"

#include "emit/identifiers.hpp"
#include "emit/sympy_program.hpp"

#include <algorithm>

namespace lagen {
namespace {

bool is_reserved_in_sympy(std::string_view name)
{
    return std::ranges::find(sympy_program::reserved, name) != std::end(sympy_program::reserved);
}

void append_new(std::vector<std::string>& names, const std::string& name)
{
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
}

void collect_symbols(SympyNames& names, const EquationModule& module)
{
    for (const NamedTree& parameter : module.parameters) append_new(names.declared, parameter.name);
    for (const ModuleSymbols& group : module.groups)
        for (const std::string& symbol : group.symbols) append_new(names.declared, symbol);
    names.moving = module.state;
    const auto is_new = [&](const std::string& name) {
        return name != "t" && std::ranges::find(names.declared, name) == names.declared.end();
    };
    for (const EquationBlock& block : module.equations.blocks)
        for (const Equation& equation : block.equations) {
            if (equation.left == LeftSide::time_derivative && equation.mass.empty())
                append_new(names.moving, equation.symbol);
            for (const TermGroup& entry : equation.mass) append_new(names.moving, entry.label);
            for (const auto* groups : {&equation.mass, &equation.groups})
                for (const TermGroup& group : *groups)
                    for (const std::string& used : names_in(group.value))
                        if (is_new(used)) append_new(names.written, used);
        }
    for (const EquationBlock& block : module.equations.blocks)
        for (const Equation& equation : block.equations)
            if (equation.left == LeftSide::symbol && is_new(equation.symbol) &&
                std::ranges::find(names.written, equation.symbol) == names.written.end())
                append_new(names.assigned, equation.symbol);
}

} // namespace

SympyNames sympy_names(const EquationModule& module)
{
    SympyNames names;
    collect_symbols(names, module);
    std::vector<std::string> all;
    for (const auto* symbols : {&names.declared, &names.written, &names.assigned})
        all.insert(all.end(), symbols->begin(), symbols->end());
    const std::size_t count = all.size();
    for (const NamedTree& definition : module.definitions) all.push_back(definition.name);
    for (const std::string& symbol : names.moving) all.push_back(symbol + "_dot");
    const std::vector<std::string> variables = identifiers(all, is_reserved_in_sympy);
    auto next = variables.begin();
    for (std::size_t k = 0; k < count; ++k) names.symbol.emplace(all[k], *next++);
    names.symbol.emplace("t", "t");
    for (std::size_t k = 0; k < module.definitions.size(); ++k) names.definition.push_back(*next++);
    for (const std::string& symbol : names.moving) names.rate.emplace(symbol, *next++);
    return names;
}

std::string sympy_name(std::string name)
{
    std::ranges::replace(name, '^', '_');
    return identifiers({name}, is_reserved_in_sympy).front();
}

} // namespace lagen
