// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/print_sympy.hpp"

#include "emit/print_equations_terms.hpp"
#include "emit/print_literal.hpp"
#include "emit/sympy_names.hpp"
#include "emit/sympy_program.hpp"
#include "emit/sympy_writer.hpp"
#include "emit/text_block.hpp"
#include "expression/alphabet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace lagen {
namespace {

constexpr std::size_t sympy_width = 120;

using Texts = std::vector<std::string>;

/// The terms with their signs, on lines of `width` columns: the first begins at column `first`, others at `margin`.
std::string sum_of(const SignedTexts& terms, std::size_t first, std::size_t margin, std::size_t width)
{
    std::string text;
    for (const std::string& line : wrap_terms(terms, first, margin, width, columns_of))
        text += (text.empty() ? "" : "\n" + std::string(margin, ' ')) + line;
    return text;
}

Tree sum_of_groups(const Equation& equation)
{
    std::vector<Tree> values;
    for (const TermGroup& group : equation.groups) values.push_back(group.value);
    return values.size() == 1 ? values[0] : add(values);
}

/// A name as a symbol of its own, which no variable holds.
std::string symbol_called(const std::string& name)
{
    return fmt::format("sp.Symbol(\"{}\")", sympy_name(name));
}

class SympyModule {
  public:
    explicit SympyModule(const EquationModule& module)
        : module_(module), names_(sympy_names(module)), writer_(names_.symbol, module.equations.model)
    {
    }

    std::string print()
    {
        print_head();
        print_symbols();
        print_structure();
        print_equations();
        print_motion();
        return text_;
    }

  private:
    void line(const std::string& text) { text_ += text + "\n"; }

    void list(const std::string& prefix, const Texts& items, const std::string& suffix)
    {
        if (items.empty()) return line(prefix + suffix);
        TextBlock block;
        block.list(prefix, items, suffix);
        text_ += block.text();
    }

    /// A text of sympy_program with '$' replaced.
    void program(std::string_view text, const std::string& replacement = {})
    {
        for (const char c : text.substr(1)) c == '$' ? text_ += replacement : text_ += c;
    }

    [[nodiscard]] const std::string& variable(const std::string& symbol) const { return names_.symbol.at(symbol); }

    [[nodiscard]] Texts variables_of(const Texts& symbols) const
    {
        Texts variables;
        for (const std::string& symbol : symbols) variables.push_back(variable(symbol));
        return variables;
    }

    [[nodiscard]] Texts rates_of(const Texts& symbols) const
    {
        Texts variables;
        for (const std::string& symbol : symbols) variables.push_back(names_.rate.at(symbol));
        return variables;
    }

    void print_tuple(const std::string& name, const Texts& items)
    {
        list(name + " = (", items, items.size() == 1 ? ",)" : ")");
    }

    void declare(const Texts& variables)
    {
        if (variables.size() == 1) line(fmt::format("{0} = sp.Symbol(\"{0}\", real=True)", variables[0]));
        if (variables.size() < 2) return;
        const std::string names = joined(variables);
        const std::string whole = fmt::format("{0} = sp.symbols(\"{0}\", real=True)", names);
        if (whole.size() <= sympy_width) return line(whole);
        Texts quoted;
        for (const std::string& name : variables) quoted.push_back('"' + name + '"');
        list("(", variables, ") = sp.symbols((");
        list("    ", quoted, "), real=True)");
    }

    /// name = tree, in parentheses where it takes several lines.
    void assign(const std::string& name, const Tree& tree)
    {
        const std::string value = writer_.write_value(tree);
        const std::size_t first = name.size() + 3;
        if (first + value.size() <= sympy_width) return line(name + " = " + value);
        Equation terms;
        terms.groups = {{"", tree}};
        line(name + " = (" + sum_of(terms_of(terms), first + 1, first + 1, sympy_width) + ")");
    }

    /// The signed terms of a right side.
    [[nodiscard]] SignedTexts terms_of(const Equation& equation)
    {
        SignedTexts terms;
        for (const SignedTree& term : right_side_terms(equation)) {
            std::string text = writer_.write(term.tree, SympyHold::product);
            for (const std::string& name : term.basis) text += "*" + symbol_called("e_" + name);
            terms.emplace_back(term.negative, std::move(text));
        }
        return terms.empty() ? SignedTexts{{false, "0"}} : terms;
    }

    void print_head()
    {
        const EquationSet& set = module_.equations;
        line("# SPDX-License-Identifier: MIT");
        line("# " + plain_text(set.title.empty() ? set.model : set.title));
        line(fmt::format("\"\"\"The equations of the model {}, form {}, for SymPy.\n", set.model, set.form));
        line(
            "`lagen derive --format sympy` wrote this module; docs/python.md of lagen says what is in it. It is yours");
        line("to use under the MIT licence, whatever the licence of the generator.\n\"\"\"");
        program(sympy_program::imports);
    }

    void print_symbols()
    {
        std::set<std::string> seen;
        Texts parameters, entries;
        for (const NamedTree& parameter : module_.parameters) {
            seen.insert(parameter.name);
            parameters.push_back(variable(parameter.name));
            entries.push_back(parameters.back() + ": " + writer_.write_value(parameter.value));
        }
        line("\n# parameters, and their values");
        declare(parameters);
        list("parameters = {", entries, "}");
        for (const ModuleSymbols& group : module_.groups) {
            line("\n# " + group.text);
            Texts fresh;
            for (const std::string& symbol : group.symbols)
                if (seen.insert(symbol).second) fresh.push_back(variable(symbol));
            declare(fresh);
            print_tuple(group.name, variables_of(group.symbols));
        }
        entries.clear();
        for (const std::string& symbol : names_.declared)
            entries.push_back(fmt::format("\"{}\": {}", symbol, variable(symbol)));
        line("\n# by their names in the model");
        list("symbols = {", entries, "}");
        if (!names_.written.empty()) line("\n# defined by equations");
        declare(variables_of(names_.written));
        if (names_.moving.empty()) return;
        line("\n# rates");
        declare(rates_of(names_.moving));
        print_tuple("state", variables_of(module_.state));
        print_tuple("rates", rates_of(module_.state));
    }

    template <class Entries>
    [[nodiscard]] Texts structure_entries(const Entries& entries)
    {
        Texts texts;
        for (const auto& [index, value] : entries)
            texts.push_back(fmt::format("({}): {}", fmt::join(index, ", "), writer_.write(value)));
        return texts;
    }

    void print_structure()
    {
        if (!module_.definitions.empty()) line("\n# definitions");
        Texts entries;
        for (std::size_t k = 0; k < module_.definitions.size(); ++k) {
            assign(names_.definition[k], module_.definitions[k].value);
            writer_.define(module_.definitions[k].value, names_.definition[k]);
            entries.push_back(fmt::format("\"{}\": {}", module_.definitions[k].name, names_.definition[k]));
        }
        if (!entries.empty()) list("definitions = {", entries, "}");
        const std::size_t n = module_.groups[0].symbols.size(), r = module_.rank;
        line("\n# the anchor rho[i, a] and the structure functions C[c, a, b] of the algebroid");
        list(fmt::format("rho = sp.ImmutableSparseMatrix({}, {}, {{", n, r), structure_entries(module_.rho), "})");
        list("C = sp.ImmutableSparseNDimArray({", structure_entries(module_.C), fmt::format("}}, ({0}, {0}, {0}))", r));
        if (!module_.constraints.empty()) {
            entries.clear();
            for (const Tree& constraint : module_.constraints) entries.push_back(writer_.write_value(constraint));
            line("\n# zero on the base");
            print_tuple("constraints", entries);
        }
        if (!module_.functions.empty()) line("");
        for (const NamedTree& function : module_.functions) assign(function.name, function.value);
    }

    /// Whether the equation defines a function that no other one uses: a variable holds it.
    [[nodiscard]] bool is_assigned(const Equation& equation) const
    {
        return equation.left == LeftSide::symbol &&
               std::ranges::find(names_.assigned, equation.symbol) != names_.assigned.end();
    }

    [[nodiscard]] std::string left_of(const Equation& equation) const
    {
        const auto applied = [](const std::string& function, const Texts& arguments) {
            return fmt::format("sp.Function(\"{}\")({})", function, joined(arguments));
        };
        switch (equation.left) {
        case LeftSide::time_derivative: return names_.rate.at(equation.symbol);
        case LeftSide::symbol:
            return is_assigned(equation) ? symbol_called(equation.symbol) : variable(equation.symbol);
        case LeftSide::zero: return "0";
        case LeftSide::bracket: return applied("bracket", {variable(equation.symbol), variable(equation.other)});
        case LeftSide::component: {
            Texts arguments; // sections, or functions
            for (const std::string& name : equation.arguments)
                arguments.push_back(names_.symbol.contains(name) ? variable(name) : symbol_called(name));
            return applied(sympy_name(equation.symbol), arguments);
        }
        case LeftSide::section: return symbol_called("e_" + equation.symbol);
        case LeftSide::commutator:
            return applied("commutator", {symbol_called("e_" + equation.symbol), symbol_called("e_" + equation.other)});
        case LeftSide::differential:
        case LeftSide::form: break;
        }
        throw InternalError("an equation of forms in a module for SymPy");
    }

    void print_equation(const Equation& equation)
    {
        SignedTexts left;
        for (const TermGroup& entry : equation.mass) {
            const SignedTree mass = without_sign(entry.value);
            const std::string factor = is_one(mass.tree) ? "" : writer_.write(mass.tree, SympyHold::product) + "*";
            left.emplace_back(mass.negative, factor + names_.rate.at(entry.label));
        }
        if (left.empty()) left.emplace_back(false, left_of(equation));
        const SignedTexts right =
            is_assigned(equation) ? SignedTexts{{false, variable(equation.symbol)}} : terms_of(equation);
        const std::string relation = equation.relation == Relation::equal      ? "    Eq("
                                     : equation.relation == Relation::at_least ? "    sp.Ge("
                                                                               : "    sp.Le(";
        const std::string whole = relation + one_line(left) + ", " + one_line(right) + "),";
        if (columns_of(whole) <= sympy_width) return line(whole);
        const std::size_t margin = relation.size();
        line(relation + sum_of(left, margin, margin, sympy_width - 1) + ",\n" + std::string(margin, ' ') +
             sum_of(right, margin, margin, sympy_width - 2) + "),");
    }

    void print_equations()
    {
        line("\nequations = {}");
        for (const EquationBlock& block : module_.equations.blocks) {
            if (block.equations.empty()) continue;
            line("\n# " + block.formula);
            for (const Equation& equation : block.equations)
                if (is_assigned(equation)) assign(variable(equation.symbol), sum_of_groups(equation));
            line(fmt::format("equations[\"{}\"] = [", block.title));
            for (const Equation& equation : block.equations) print_equation(equation);
            line("]");
        }
        if (!module_.equations.statements.empty()) line("");
        for (const DecidedStatement& statement : module_.equations.statements)
            line(fmt::format("# {}: {}", statement.status, statement.formula));
    }

    /// name = {symbol: formula} of the equations in these blocks.
    void print_formulas(const char* name, const std::vector<std::size_t>& blocks)
    {
        Texts titles;
        for (const std::size_t block : blocks)
            titles.push_back(fmt::format("equations[\"{}\"]", module_.equations.blocks[block].title));
        line(fmt::format("{} = {{e.lhs: e.rhs for e in {}}}", name,
                         titles.empty() ? "()" : fmt::format("{}", fmt::join(titles, " + "))));
    }

    void print_motion()
    {
        const auto& blocks = module_.equations.blocks;
        const auto brackets = std::ranges::find_if(blocks, [](const EquationBlock& block) {
            return !block.equations.empty() && block.equations[0].left == LeftSide::bracket;
        });
        if (brackets != blocks.end()) program(sympy_program::poisson, brackets->title);
        if (module_.state.empty()) return;
        line("\n\n# the rates: explicit, or mass * rates = force");
        print_formulas("auxiliary", module_.auxiliary);
        print_formulas("explicit", module_.rates);
        const bool has_mass = !module_.velocities.empty();
        if (has_mass) program(sympy_program::accelerations, blocks[module_.accelerations].title);
        program(sympy_program::rates);
        program(has_mass ? sympy_program::implicit_rhs : sympy_program::explicit_rhs);
    }

    const EquationModule& module_;
    SympyNames names_;
    SympyWriter writer_;
    std::string text_;
};

} // namespace

std::string print_sympy(const EquationModule& module)
{
    return SympyModule(module).print();
}

} // namespace lagen
