// SPDX-License-Identifier: GPL-2.0-or-later
/// GiNaC to sorted form: the one door through which anything comes back.
#include "symbolic/sorted_form.hpp"

#include <algorithm>
#include <cstdio>
#include <sstream>

namespace lagen {
namespace {

/// GiNaC nests as deep as the user's tree; a bound keeps the recursion off the end of the stack.
constexpr std::size_t depth_limit = 4000;

Rational to_rational(const GiNaC::numeric& value)
{
    if (!value.is_rational()) throw MathematicsError("a number that is not a real rational came out of the derivation");
    std::ostringstream text;
    text << GiNaC::dflt << value;
    Rational result(text.str());
    result.canonicalize();
    return result;
}

SortedTerm numeric_term(const Rational& value)
{
    SortedTerm one = sorted_product({});
    one.coefficient = value;
    return one;
}

SortedTerm factor_term(std::string key, bool constant, Tree base)
{
    SortedTerm term;
    term.coefficient = 1;
    term.factors.push_back({std::move(key), constant, std::move(base), 1, {}});
    return sorted_product({term});
}

bool is_constant(const SortedTerm& term)
{
    return std::all_of(term.factors.begin(), term.factors.end(),
                       [](const SortedFactor& factor) { return factor.constant; });
}

std::string whole_key(const SortedTerm& term)
{
    return term.coefficient.get_str() + "*" + term.key;
}

class Sorter {
  public:
    Sorter(const SymbolTable& symbols, const Order& order) : symbols_(symbols)
    {
        for (const std::string& name : order.parameters) ranks_.emplace(name, rank_key('1', ranks_.size()));
        for (const std::string& name : order.variables) ranks_.emplace(name, rank_key('3', ranks_.size()));
    }

    SortedTerm operator()(const GiNaC::ex& e)
    {
        const auto known = done_.find(e);
        if (known != done_.end()) return known->second;
        if (++depth_ > depth_limit)
            throw MathematicsError("an expression nests deeper than " + std::to_string(depth_limit) + " levels");
        SortedTerm term = sorted(e);
        --depth_;
        done_.emplace(e, term);
        return term;
    }

  private:
    static std::string rank_key(char group, std::size_t rank)
    {
        char key[24];
        std::snprintf(key, sizeof key, "%c%08zu", group, rank);
        return key;
    }

    SortedTerm sorted(const GiNaC::ex& e)
    {
        if (GiNaC::is_a<GiNaC::numeric>(e)) return numeric_term(to_rational(GiNaC::ex_to<GiNaC::numeric>(e)));
        if (GiNaC::is_a<GiNaC::symbol>(e)) return symbol_term(GiNaC::ex_to<GiNaC::symbol>(e));
        if (e.is_equal(GiNaC::Pi)) {
            TreeNode pi;
            pi.kind = TreeKind::pi;
            return factor_term("0", true, std::make_shared<const TreeNode>(std::move(pi)));
        }
        if (GiNaC::is_a<GiNaC::power>(e)) return power_term(e.op(0), e.op(1));
        if (GiNaC::is_a<GiNaC::function>(e)) return function_term(e);
        std::vector<SortedTerm> parts;
        if (GiNaC::is_a<GiNaC::add>(e) || GiNaC::is_a<GiNaC::mul>(e))
            for (std::size_t k = 0; k < e.nops(); ++k) parts.push_back((*this)(e.op(k)));
        if (GiNaC::is_a<GiNaC::add>(e)) return sorted_sum(parts);
        if (GiNaC::is_a<GiNaC::mul>(e)) return sorted_product(parts);
        throw MathematicsError("the derivation left an expression that the language cannot write");
    }

    SortedTerm symbol_term(const GiNaC::symbol& symbol)
    {
        const std::string& text = symbols_.name_of(symbol);
        const auto rank = ranks_.find(text);
        const std::string key = rank == ranks_.end() ? "3z" + text : rank->second;
        return factor_term(key, key[0] == '1', name(text));
    }

    /// Integer powers go into every factor; other powers keep their base whole, as (x^2)^(1/2) is not x.
    SortedTerm power_term(const GiNaC::ex& basis, const GiNaC::ex& exponent)
    {
        SortedTerm base = (*this)(basis);
        if (!GiNaC::is_a<GiNaC::numeric>(exponent)) {
            const SortedTerm raised = (*this)(exponent);
            const bool constant = is_constant(base) && is_constant(raised);
            return factor_term((constant ? "2^" : "4^") + whole_key(base) + "^" + whole_key(raised), constant,
                               power(tree_of(base), tree_of(raised)));
        }
        const Rational value = to_rational(GiNaC::ex_to<GiNaC::numeric>(exponent));
        if (value.get_den() == 1) return integer_power(std::move(base), value);
        const bool plain = base.coefficient == 1 && base.factors.size() == 1 && base.factors[0].exponent == 1;
        if (plain) {
            base.factors[0].exponent = value;
            return sorted_product({base});
        }
        const bool constant = is_constant(base);
        SortedTerm term = factor_term((constant ? "2r" : "5r") + whole_key(base), constant, tree_of(base));
        term.factors[0].exponent = value;
        return sorted_product({term});
    }

    static SortedTerm integer_power(SortedTerm base, const Rational& exponent)
    {
        const long n = exponent.get_num().fits_slong_p() ? exponent.get_num().get_si() : 0;
        if (n == 0 || n > 100'000 || n < -100'000)
            throw MathematicsError("the exponent " + exponent.get_str() + " is out of range");
        Rational coefficient;
        mpz_pow_ui(coefficient.get_num().get_mpz_t(), base.coefficient.get_num().get_mpz_t(),
                   static_cast<unsigned long>(std::labs(n)));
        mpz_pow_ui(coefficient.get_den().get_mpz_t(), base.coefficient.get_den().get_mpz_t(),
                   static_cast<unsigned long>(std::labs(n)));
        if (n < 0 && coefficient == 0) throw MathematicsError("the derivation divides by zero");
        base.coefficient = n < 0 ? Rational(1 / coefficient) : coefficient;
        for (SortedFactor& factor : base.factors) factor.exponent *= n;
        return sorted_product({base});
    }

    SortedTerm function_term(const GiNaC::ex& e)
    {
        const std::string text = GiNaC::ex_to<GiNaC::function>(e).get_name();
        const FunctionEntry* const entry = find_function(text); // GiNaC's names are those of the language
        if (entry == nullptr)
            throw MathematicsError("the derivation left the function " + text + ", which the language does not have");
        std::vector<Tree> arguments;
        std::string key = function_key(entry->function);
        bool constant = true;
        bool negative = false;
        for (std::size_t k = 0; k < e.nops(); ++k) {
            SortedTerm argument = (*this)(e.op(k));
            if (entry->parity != Parity::none && argument.coefficient < 0) {
                argument.coefficient = -argument.coefficient;
                negative = entry->parity == Parity::odd;
            }
            constant = constant && is_constant(argument);
            key += "<" + whole_key(argument) + ">";
            arguments.push_back(tree_of(argument));
        }
        SortedTerm term =
            factor_term((constant ? "2f" : "4f") + key, constant, call(entry->function, std::move(arguments)));
        if (negative) term.coefficient = -1;
        return term;
    }

    const SymbolTable& symbols_;
    std::map<std::string, std::string> ranks_;
    std::map<GiNaC::ex, SortedTerm, GiNaC::ex_is_less> done_; ///< looked up, never iterated: its order is GiNaC's
    std::size_t depth_ = 0;
};

} // namespace

std::string function_key(Function function)
{
    return std::to_string(100 + static_cast<int>(function));
}

SortedTerm sort_expression(const GiNaC::ex& expression, const SymbolTable& symbols, const Order& order)
{
    return Sorter(symbols, order)(expression);
}

Tree from_ginac(const GiNaC::ex& expression, const SymbolTable& symbols, const Order& order)
{
    return tree_of(sort_expression(expression, symbols, order));
}

} // namespace lagen
