// SPDX-License-Identifier: GPL-2.0-or-later
/// Candidates and their lengths.
#include "symbolic/shortest_form.hpp"

#include "symbolic/sorted_form.hpp"

#include <algorithm>
#include <cstdlib>

namespace lagen {

namespace {

// Identities of sin and cos that take terms out of a sum.

/// T cos a cos b +- T sin a sin b = T cos(a -+ b) and T sin a cos b +- T cos a sin b = T sin(a +- b), likewise.
class AngleSums {
  public:
    /// Keeps references.
    AngleSums(const SymbolTable& symbols, const Order& order) : symbols_(symbols), order_(order) {}

    [[nodiscard]] SortedTerm joined(const SortedTerm& sum) const;

  private:
    using Terms = std::map<std::string, SortedTerm>;

    [[nodiscard]] bool join(Terms& terms, const std::string& key) const;
    [[nodiscard]] SortedTerm of_sum(Function function, const SortedFactor& a, const SortedFactor& b, bool plus) const;

    const SymbolTable& symbols_;
    const Order& order_;
};

constexpr std::size_t most_terms = 400; ///< of a sum in which pairs of angles are sought

bool is_sine_or_cosine(const SortedFactor& factor)
{
    return factor.terms.empty() && factor.base->kind == TreeKind::call && factor.exponent > 0 &&
           (factor.base->function == Function::sin || factor.base->function == Function::cos);
}

/// cos for sin and sin for cos of the same argument, to this power.
SortedFactor complement(const SortedFactor& factor, int exponent)
{
    const Function other = factor.base->function == Function::sin ? Function::cos : Function::sin;
    SortedFactor result = factor;
    result.base = call(other, factor.base->arguments);
    result.exponent = exponent;
    result.key.replace(2, function_key(other).size(), function_key(other));
    return result;
}

void add_term(std::map<std::string, SortedTerm>& terms, const SortedTerm& term)
{
    const auto [slot, fresh] = terms.emplace(term.key, term);
    if (!fresh) slot->second.coefficient += term.coefficient;
    if (slot->second.coefficient == 0) terms.erase(slot);
}

/// One use of T sin^2 + T cos^2 = T or of T - T sin^2 = T cos^2 (and with cos); false where there is none.
bool join_squares(std::map<std::string, SortedTerm>& terms)
{
    for (const auto& [key, term] : terms)
        for (const SortedFactor& factor : term.factors) {
            if (!is_sine_or_cosine(factor) || factor.exponent < 2) continue;
            SortedFactor square = factor;
            square.exponent = 2;
            const SortedTerm rest = divided(term, {square});
            const SortedTerm partner = sorted_product({rest, product_of({complement(factor, 2)}, 1)});
            const auto beside = terms.find(partner.key);
            const auto whole = terms.find(rest.key);
            const bool sum = beside != terms.end() && beside->second.coefficient == term.coefficient;
            const bool difference = whole != terms.end() && whole->second.coefficient == -term.coefficient;
            if (!sum && !difference) continue;
            SortedTerm joined = sum ? rest : partner;
            joined.coefficient = sum ? Rational(term.coefficient) : Rational(-term.coefficient);
            const std::string used = key;
            terms.erase(sum ? beside : whole);
            terms.erase(used);
            add_term(terms, joined);
            return true;
        }
    return false;
}

std::map<std::string, SortedTerm> by_keys(const SortedTerm& sum)
{
    std::map<std::string, SortedTerm> terms;
    for (const SortedTerm& term : terms_in(sum)) terms.emplace(term.key, term);
    return terms;
}

SortedTerm sum_of(const std::map<std::string, SortedTerm>& terms)
{
    std::vector<SortedTerm> list;
    for (const auto& [key, term] : terms) list.push_back(term);
    return sorted_sum(list);
}

/// The sum with T sin^2 + T cos^2 = T and T - T sin^2 = T cos^2 (and with cos) used as often as there is one: every use
/// takes a term away.
SortedTerm with_joined_squares(const SortedTerm& sum)
{
    std::map<std::string, SortedTerm> terms = by_keys(sum);
    while (join_squares(terms)) {
    }
    return sum_of(terms);
}

/// function(a +- b) of the arguments of two factors.
SortedTerm AngleSums::of_sum(Function function, const SortedFactor& a, const SortedFactor& b, bool plus) const
{
    SymbolTable symbols = symbols_;
    const GiNaC::ex first = to_ginac(a.base->arguments[0], symbols), second = to_ginac(b.base->arguments[0], symbols);
    const GiNaC::ex angle = plus ? first + second : first - second;
    return sort_expression(function == Function::sin ? GiNaC::sin(angle) : GiNaC::cos(angle), symbols_, order_);
}

/// One use with the term that has this key and another one; false where there is none.
bool AngleSums::join(Terms& terms, const std::string& key) const
{
    const SortedTerm term = terms.at(key);
    for (std::size_t i = 0; i < term.factors.size(); ++i)
        for (std::size_t j = i + 1; j < term.factors.size(); ++j) {
            SortedFactor a = term.factors[i], b = term.factors[j];
            if (!is_sine_or_cosine(a) || !is_sine_or_cosine(b)) continue;
            a.exponent = b.exponent = 1;
            const SortedTerm rest = divided(term, {a, b});
            const SortedTerm partner = sorted_product({rest, product_of({complement(a, 1), complement(b, 1)}, 1)});
            const auto other = terms.find(partner.key);
            if (other == terms.end() || partner.key == key || // sin a cos a is a pair with itself
                abs(other->second.coefficient) != abs(term.coefficient))
                continue;
            const bool same = other->second.coefficient == term.coefficient;
            Rational coefficient = term.coefficient;
            SortedTerm angle;
            if (a.base->function == b.base->function) {
                angle = of_sum(Function::cos, a, b, !same);
                if (a.base->function == Function::sin) coefficient = other->second.coefficient; // that of cos cos
            } else {
                const bool sine_first = a.base->function == Function::sin;
                angle = of_sum(Function::sin, sine_first ? a : b, sine_first ? b : a, same);
            }
            terms.erase(other);
            terms.erase(key);
            SortedTerm joined = sorted_product({rest, angle});
            joined.coefficient *= coefficient / rest.coefficient;
            add_term(terms, joined);
            return true;
        }
    return false;
}

SortedTerm AngleSums::joined(const SortedTerm& sum) const
{
    Terms terms = by_keys(sum);
    if (terms.size() > most_terms) return sum;
    for (bool changed = true; changed;) {
        changed = false;
        std::vector<std::string> keys;
        for (const auto& [key, term] : terms) keys.push_back(key);
        for (const std::string& key : keys)
            if (terms.contains(key) && join(terms, key)) changed = true;
    }
    return sum_of(terms);
}

constexpr double term_limit = 2000;        ///< of an expanded sum
constexpr std::size_t factor_terms = 40;   ///< of a polynomial handed to GiNaC::factor
constexpr std::size_t node_limit = 50'000; ///< of an expanded sum
constexpr int factor_degree = 16;          ///< its total degree, summed over its symbols
constexpr std::size_t factor_symbols = 10; ///< with more, unlucky points of GiNaC's own dice take it minutes
constexpr std::size_t parenthesis_cost = 2;

/// A bound of the number of terms after expansion.
double expanded_terms(const GiNaC::ex& e)
{
    if (GiNaC::is_a<GiNaC::add>(e)) {
        double sum = 0;
        for (std::size_t k = 0; k < e.nops(); ++k) sum += expanded_terms(e.op(k));
        return sum;
    }
    if (GiNaC::is_a<GiNaC::mul>(e)) {
        double product = 1;
        for (std::size_t k = 0; k < e.nops() && product <= term_limit; ++k) product *= expanded_terms(e.op(k));
        return product;
    }
    if (GiNaC::is_a<GiNaC::power>(e) && e.op(1).info(GiNaC::info_flags::posint)) {
        const double inner = expanded_terms(e.op(0));
        double product = 1;
        for (GiNaC::numeric n = 0; n < GiNaC::ex_to<GiNaC::numeric>(e.op(1)) && product <= term_limit && inner > 1; ++n)
            product *= inner;
        return product;
    }
    return 1;
}

/// Functions and roots replaced by symbols, so that polynomial algorithms apply; the same one by the same symbol.
class Atoms {
  public:
    GiNaC::ex hide(const GiNaC::ex& e)
    {
        if (GiNaC::is_a<GiNaC::numeric>(e) || GiNaC::is_a<GiNaC::symbol>(e)) return e;
        if (GiNaC::is_a<GiNaC::add>(e) || GiNaC::is_a<GiNaC::mul>(e)) {
            GiNaC::exvector parts;
            for (std::size_t k = 0; k < e.nops(); ++k) parts.push_back(hide(e.op(k)));
            if (GiNaC::is_a<GiNaC::add>(e)) return GiNaC::ex(GiNaC::dynallocate<GiNaC::add>(parts));
            return GiNaC::ex(GiNaC::dynallocate<GiNaC::mul>(parts));
        }
        if (GiNaC::is_a<GiNaC::power>(e)) {
            if (e.op(1).info(GiNaC::info_flags::integer)) return GiNaC::pow(hide(e.op(0)), e.op(1));
            // b^(p/q) = (b^(1/q))^p: one atom for all powers of one root
            if (GiNaC::is_a<GiNaC::numeric>(e.op(1)) && e.op(1).info(GiNaC::info_flags::rational)) {
                const GiNaC::numeric exponent = GiNaC::ex_to<GiNaC::numeric>(e.op(1));
                const GiNaC::ex root = GiNaC::pow(e.op(0), GiNaC::numeric(1) / exponent.denom());
                return GiNaC::pow(atom(root), exponent.numer());
            }
        }
        return atom(e);
    }

    [[nodiscard]] GiNaC::ex show(const GiNaC::ex& e) const { return e.subs(back_, GiNaC::subs_options::no_pattern); }

  private:
    GiNaC::ex atom(const GiNaC::ex& e)
    {
        const auto known = forward_.find(e);
        if (known != forward_.end()) return known->second;
        const GiNaC::realsymbol symbol;
        forward_.emplace(e, symbol);
        back_[symbol] = e;
        return symbol;
    }

    GiNaC::exmap forward_, back_;
};

/// True where an expression is short when it is written out: in a sum of many terms each may have long divisors.
bool has_few_nodes(const GiNaC::ex& e)
{
    std::size_t nodes = 0;
    for (auto node = e.preorder_begin(); node != e.preorder_end(); ++node)
        if (++nodes > node_limit) return false;
    return true;
}

std::size_t terms_of(const GiNaC::ex& e)
{
    return GiNaC::is_a<GiNaC::add>(e) ? e.nops() : 1;
}

bool may_factor(const GiNaC::ex& polynomial)
{
    if (terms_of(polynomial) > factor_terms) return false;
    int degree = 0;
    GiNaC::exset symbols;
    for (auto node = polynomial.preorder_begin(); node != polynomial.preorder_end(); ++node)
        if (GiNaC::is_a<GiNaC::symbol>(*node)) symbols.insert(*node);
    for (const GiNaC::ex& symbol : symbols) degree += polynomial.degree(symbol);
    return degree <= factor_degree && symbols.size() <= factor_symbols;
}

/// GiNaC::factor leaves sums inside its factors in groups of its own choice; expanded, each factor is unique up to
/// sign.
GiNaC::ex with_expanded_factors(const GiNaC::ex& e)
{
    if (GiNaC::is_a<GiNaC::mul>(e)) {
        GiNaC::exvector parts;
        for (std::size_t k = 0; k < e.nops(); ++k) parts.push_back(with_expanded_factors(e.op(k)));
        return GiNaC::ex(GiNaC::dynallocate<GiNaC::mul>(parts));
    }
    if (GiNaC::is_a<GiNaC::power>(e)) return GiNaC::pow(e.op(0).expand(), e.op(1));
    return e.expand();
}

/// Numerator and denominator factored; nothing where that would cost too much.
std::optional<GiNaC::ex> factored(const GiNaC::ex& e)
{
    Atoms atoms;
    const GiNaC::ex hidden = atoms.hide(e);
    if (expanded_terms(hidden) > factor_terms) return {};
    if (!has_short_fraction(hidden)) return {};
    const GiNaC::ex fraction = hidden.numer_denom();
    const GiNaC::ex above = fraction.op(0).expand();
    const GiNaC::ex below = fraction.op(1).expand();
    if (!may_factor(above) || !may_factor(below)) return {};
    return atoms.show(with_expanded_factors(GiNaC::factor(above)) / with_expanded_factors(GiNaC::factor(below)));
}

/// The common part of two products: the factors of `a` with the smaller of both exponents.
std::vector<SortedFactor> common_factors(const std::vector<SortedFactor>& a, const std::vector<SortedFactor>& b)
{
    std::vector<SortedFactor> common;
    for (const SortedFactor& factor : a) {
        const auto other = std::find_if(b.begin(), b.end(),
                                        [&](const SortedFactor& candidate) { return candidate.key == factor.key; });
        if (other == b.end() || (factor.exponent < 0) != (other->exponent < 0)) continue;
        common.push_back(factor);
        if (abs(other->exponent) < abs(factor.exponent)) common.back().exponent = other->exponent;
    }
    return common;
}

/// A sum with the factors that all terms share drawn out in front.
SortedTerm with_common_factor(const std::vector<SortedTerm>& terms)
{
    std::vector<SortedFactor> common = terms.front().factors;
    for (const SortedTerm& term : terms) common = common_factors(common, term.factors);
    std::vector<SortedTerm> rest;
    for (const SortedTerm& term : terms) rest.push_back(divided(term, common));
    return sorted_product({sorted_sum(rest), product_of(common, 1)});
}

/// Terms with the same monomial in the variables together: (I2 - I3) w2 w3 - mgl g2.
SortedTerm collected(const SortedTerm& expanded)
{
    std::map<std::string, std::pair<SortedTerm, std::vector<SortedTerm>>> groups;
    for (const SortedTerm& term : terms_in(expanded)) {
        std::vector<SortedFactor> variable;
        for (const SortedFactor& factor : term.factors)
            if (!factor.constant) variable.push_back(factor);
        const SortedTerm monomial = product_of(variable, 1);
        auto& group = groups.try_emplace(monomial.key, monomial, std::vector<SortedTerm>{}).first->second;
        group.second.push_back(divided(term, variable));
    }
    std::vector<SortedTerm> sums;
    for (const auto& [key, group] : groups)
        sums.push_back(sorted_product({group.first, with_common_factor(group.second)}));
    return sorted_sum(sums);
}

/// A product whose sums are collected each for itself.
SortedTerm with_collected_factors(const SortedTerm& product)
{
    std::vector<SortedTerm> parts = {product_of({}, product.coefficient)};
    for (const SortedFactor& factor : product.factors) {
        const bool sum = !factor.terms.empty() && factor.exponent == 1;
        const SortedTerm part = product_of({factor}, 1);
        parts.push_back(sum ? collected(part) : part);
    }
    return sorted_product(parts);
}

/// A term to a whole power; not of 0 to a negative one.
SortedTerm raised(SortedTerm term, long exponent)
{
    Rational coefficient = 1;
    for (long k = 0; k < std::abs(exponent); ++k) coefficient *= term.coefficient;
    term.coefficient = exponent < 0 ? Rational(1 / coefficient) : coefficient;
    for (SortedFactor& factor : term.factors) factor.exponent *= exponent;
    return sorted_product({term});
}

/// A product with sin^2 + cos^2 = 1 and the addition theorems used in each sum that is one of its factors.
SortedTerm with_joined_factors(const SortedTerm& product, const AngleSums& angles)
{
    std::vector<SortedTerm> parts = {product_of({}, product.coefficient)};
    for (const SortedFactor& factor : product.factors) {
        SortedTerm part = product_of({factor}, 1);
        if (!factor.terms.empty() && factor.exponent.get_den() == 1 && abs(factor.exponent) <= factor_degree) {
            SortedFactor sum = factor;
            sum.exponent = 1;
            const SortedTerm joined = angles.joined(with_joined_squares(product_of({sum}, 1)));
            if (joined.coefficient != 0) part = raised(joined, factor.exponent.get_num().get_si());
        }
        parts.push_back(std::move(part));
    }
    return sorted_product(parts);
}

std::size_t cost_of(const Tree& tree)
{
    const std::string text = to_text(tree);
    const auto parentheses = std::count(text.begin(), text.end(), '(');
    return text.size() + parenthesis_cost * static_cast<std::size_t>(parentheses);
}

/// Keeps the first of the cheapest trees offered.
class Shortest {
  public:
    void offer(Tree tree)
    {
        const std::size_t cost = cost_of(tree);
        if (best_ && cost >= cost_) return;
        best_ = std::move(tree);
        cost_ = cost;
    }
    [[nodiscard]] const Tree& best() const { return best_; }

  private:
    Tree best_;
    std::size_t cost_ = 0;
};

} // namespace

Tree shortest_form(const GiNaC::ex& expression, const SymbolTable& symbols, const Order& order)
{
    return with_ginac("an expression could not be rewritten", [&] {
        Shortest shortest;
        const AngleSums angles(symbols, order);
        const GiNaC::ex sum = expanded_terms(expression) <= term_limit ? expression.expand() : GiNaC::ex();
        if (expanded_terms(expression) <= term_limit && has_few_nodes(sum)) {
            const SortedTerm expanded = sort_expression(sum, symbols, order);
            const SortedTerm squares = with_joined_squares(expanded);
            for (const SortedTerm& form : {expanded, squares, angles.joined(squares)}) {
                const SortedTerm common = with_common_factor(terms_in(form));
                if (common.key != form.key) shortest.offer(tree_of(common));
                shortest.offer(tree_of(collected(form)));
                shortest.offer(tree_of(form));
            }
            if (const std::optional<GiNaC::ex> product = factored(expression)) {
                const SortedTerm sorted = sort_expression(*product, symbols, order);
                shortest.offer(tree_of(sorted));
                shortest.offer(tree_of(with_collected_factors(sorted)));
                shortest.offer(tree_of(with_joined_factors(sorted, angles)));
            }
        }
        shortest.offer(from_ginac(expression, symbols, order));
        return shortest.best();
    });
}

std::optional<std::size_t> expanded_length(const GiNaC::ex& expression)
{
    if (expanded_terms(expression) > term_limit) return {};
    const GiNaC::ex expanded = expression.expand();
    return expanded.is_zero() ? 0 : terms_of(expanded);
}

} // namespace lagen
