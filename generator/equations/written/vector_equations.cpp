// SPDX-License-Identifier: GPL-2.0-or-later
#include "equations/written/vector_equations.hpp"

#include "equations/written/equation_tree.hpp"
#include "equations/written/vector_terms.hpp"
#include "symbolic/shortest_form.hpp"

#include <algorithm>

namespace lagen {
namespace {

constexpr std::size_t most_terms = 400; ///< of an expanded component that is looked at

bool is_number(const Tree& tree, int value)
{
    return tree->kind == TreeKind::number && tree->number == value;
}

/// coefficient * vector, signs outside and divisors below.
Tree times(const Tree& coefficient, const VectorTerm& term)
{
    const Tree& vector = term.tree;
    if (is_number(coefficient, 1)) return vector;
    if (coefficient->kind == TreeKind::negate || (coefficient->kind == TreeKind::number && coefficient->number < 0)) {
        const Tree positive =
            coefficient->kind == TreeKind::negate ? coefficient->arguments[0] : number(-coefficient->number);
        if (term.opposite != nullptr) return times(positive, {term.opposite, nullptr, {}});
        return negate(times(positive, term));
    }
    if (coefficient->kind == TreeKind::number && coefficient->number.get_den() != 1) {
        const Rational& value = coefficient->number;
        return divide(times(number(Rational(value.get_num())), term), number(Rational(value.get_den())));
    }
    if (coefficient->kind == TreeKind::divide)
        return divide(times(coefficient->arguments[0], term), coefficient->arguments[1]);
    std::vector<Tree> factors{coefficient};
    if (coefficient->kind == TreeKind::multiply) factors = coefficient->arguments;
    if (vector->kind == TreeKind::multiply)
        factors.insert(factors.end(), vector->arguments.begin(), vector->arguments.end());
    else
        factors.push_back(vector);
    return multiply(factors);
}

/// The tree is that of a rational number.
Rational value_of(const Tree& tree)
{
    return tree->kind == TreeKind::negate   ? Rational(-value_of(tree->arguments[0]))
           : tree->kind == TreeKind::divide ? Rational(value_of(tree->arguments[0]) / value_of(tree->arguments[1]))
                                            : tree->number;
}

/// Roots of sums and sums that divide, by names: expanding a product leaves what is below them as it is, (x - y)^2.
class HiddenRoots : public GiNaC::map_function {
  public:
    HiddenRoots(SymbolTable& symbols, const Order& order) : symbols_(symbols), order_(order) {}

    GiNaC::ex hidden(const GiNaC::ex& expression) { return (*this)(expression); }
    [[nodiscard]] GiNaC::ex shown(const GiNaC::ex& expression) const { return expression.subs(values_); }

    GiNaC::ex operator()(const GiNaC::ex& part) override;

  private:
    SymbolTable& symbols_;
    const Order& order_;
    GiNaC::exmap values_;
};

GiNaC::ex HiddenRoots::operator()(const GiNaC::ex& part)
{
    const bool root = GiNaC::is_a<GiNaC::power>(part) && GiNaC::is_a<GiNaC::add>(part.op(0)) &&
                      !part.op(1).info(GiNaC::info_flags::posint);
    if (!root) return part.map(*this);
    const GiNaC::ex name = symbols_.symbol("(" + to_text(from_ginac(part, symbols_, order_)) + ")");
    values_[name] = part;
    return name;
}

/// A value by its scalar factors, each with the polynomials in entries that it multiplies.
struct ScalarFactor {
    GiNaC::ex factor;
    Polynomials value;
};
using ByFactor = std::map<std::string, ScalarFactor>;

class VectorWriting {
  public:
    VectorWriting(const EquationSet& equations, const VectorNames& names) : names_(names), entries_(entry_names(names))
    {
        for (const SymbolText& symbol : equations.symbols) order_.variables.push_back(symbol.name);
        for (const WhereEntry& entry : equations.where) order_.variables.push_back(entry.symbol);
    }

    /// The equations of a block; nothing where none is of vectors.
    std::vector<Equation> written(const EquationBlock& block)
    {
        std::vector<Equation> result;
        bool any = false;
        for (std::size_t e = 0; e < block.equations.size(); ++e) {
            std::optional<Equation> found = vector_equation(block.equations, e);
            any = any || found;
            if (found) {
                result.push_back(*found);
                e += 2;
                continue;
            }
            found = scalar_equation(block.equations[e]);
            any = any || found;
            result.push_back(found ? *found : block.equations[e]);
        }
        return any ? result : std::vector<Equation>();
    }

    /// True where a name stands for a vector and for a diagonal matrix at once.
    [[nodiscard]] bool is_ambiguous() const
    {
        return std::ranges::any_of(diagonals_, [&](const std::string& each) { return used_.contains(each); });
    }

    /// The values of names of the written equations.
    [[nodiscard]] std::vector<VectorText> vectors() const
    {
        std::vector<VectorText> result;
        const auto trees = [](const auto& entries) {
            std::vector<Tree> list;
            for (const std::string& entry : entries) list.push_back(name(entry));
            return list;
        };
        for (const VectorName& vector : names_.vectors) {
            const std::array<std::string, 3>& entries = vector.entries;
            if (diagonals_.contains(vector.name)) result.push_back({vector.name, trees(entries), true});
            if (used_.contains(vector.name) && !vector.family) result.push_back({vector.name, trees(entries)});
        }
        for (std::size_t k = 0; k < 3; ++k)
            if (used_.contains(names_.basis[k]))
                result.push_back({names_.basis[k], {number(k == 0), number(k == 1), number(k == 2)}});
        return result;
    }

  private:
    /// The vector whose entries the left sides of three equations are.
    [[nodiscard]] const VectorName* left_vector(const std::vector<Equation>& equations, std::size_t first) const
    {
        if (first + 3 > equations.size() || equations[first].symbol.empty()) return nullptr;
        const auto known = std::ranges::find_if(
            names_.vectors, [&](const VectorName& vector) { return vector.entries[0] == equations[first].symbol; });
        if (known == names_.vectors.end()) return nullptr;
        for (std::size_t k = 0; k < 3; ++k) {
            const Equation& equation = equations[first + k];
            if (equation.symbol != known->entries[k] || equation.left != equations[first].left || !is_plain(equation))
                return nullptr;
        }
        return &*known;
    }

    std::optional<Equation> vector_equation(const std::vector<Equation>& equations, std::size_t first)
    {
        const VectorName* left = left_vector(equations, first);
        if (left == nullptr) return std::nullopt;
        ByFactor right, mass;
        for (std::size_t k = 0; k < 3; ++k) {
            const Equation& equation = equations[first + k];
            for (const TermGroup& group : equation.groups)
                if (!split(group.value, k, 3, right)) return std::nullopt;
            for (const TermGroup& entry : equation.mass)
                if (std::ranges::find(left->entries, entry.label) == left->entries.end() ||
                    !split(multiply({entry.value, name(entry.label)}), k, 3, mass))
                    return std::nullopt;
        }
        Equation result{equations[first].left, left->name, {}, {}};
        const std::optional<std::vector<Term>> masses =
            sum_of(mass, [&](const Polynomials&) { return VectorTerms::of_rate(names_, *left); });
        const std::optional<std::vector<Term>> terms =
            sum_of(right, [&](const Polynomials& value) { return VectorTerms(names_, value); });
        if (!masses || !terms || !is_geometric(*terms)) return std::nullopt;
        for (const Term& term : *masses) {
            VectorTerm matrix{number(1), nullptr, {}};
            if (term.vector.tree->kind == TreeKind::multiply) matrix.tree = term.vector.tree->arguments[0];
            result.mass.push_back({left->name, is_number(matrix.tree, 1) ? term.factor : times(term.factor, matrix)});
        }
        if (result.mass.size() == 1 && is_number(result.mass[0].value, 1)) result.mass.clear();
        for (const Term& term : *terms) result.groups.push_back({"", times(term.factor, term.vector)});
        used_.insert(left->name);
        note_names(*masses);
        note_names(*terms);
        return result;
    }

    /// Products of components in a scalar; nothing where there are none.
    std::optional<Equation> scalar_equation(const Equation& equation)
    {
        if (!is_plain(equation) || !equation.mass.empty() || equation.groups.empty()) return std::nullopt;
        ByFactor value;
        for (const TermGroup& group : equation.groups)
            if (!split(group.value, 0, 1, value)) return std::nullopt;
        ByFactor products;
        GiNaC::ex rest = 0;
        for (auto& [text, part] : value) {
            if (const auto constant = part.value[0].find(Monomial()); constant != part.value[0].end()) { // g . g - 1
                rest += part.factor * to_number(constant->second);
                part.value[0].erase(constant);
            }
            if (VectorTerms(names_, part.value).sum_of(part.value))
                products.emplace(text, part);
            else
                rest += part.factor * polynomial(part.value[0]);
        }
        const auto terms = sum_of(products, [&](const Polynomials& each) { return VectorTerms(names_, each); });
        if (!terms || terms->empty()) return std::nullopt;
        Equation result = equation;
        result.groups.clear();
        for (const Term& term : *terms) result.groups.push_back({"", times(term.factor, term.vector)});
        if (!rest.is_zero()) result.groups.push_back({"", shortest_form(rest, symbols_, order_)});
        note_names(*terms);
        return result;
    }

    struct Term {
        Tree factor;
        VectorTerm vector;
    };

    /// A basis vector by itself stands only beside vectors that are multiplied (three joints of an arm are no vector),
    /// and two are no shorter than components.
    static bool is_geometric(const std::vector<Term>& terms)
    {
        std::set<std::size_t> bases;
        bool bare = false;
        bool product = false;
        for (const Term& term : terms) {
            product = product || term.vector.is_product();
            if (term.vector.basis == 0) continue;
            bases.insert(term.vector.basis);
            bare = bare || !term.vector.is_product();
        }
        return bases.size() <= 1 && (!bare || product);
    }

    struct Collected {
        GiNaC::ex factor;
        VectorTerm vector;
    };

    /// Adds a factor of a vector to what is known of it.
    static void collect(std::vector<Collected>& collected, const GiNaC::ex& factor, const VectorTerm& vector)
    {
        const std::string written = to_text(vector.tree);
        const auto known = std::ranges::find_if(
            collected, [&](const Collected& each) { return to_text(each.vector.tree) == written; });
        if (known == collected.end())
            collected.push_back({factor, vector});
        else
            known->factor += factor;
    }

    static GiNaC::ex to_number(const Rational& value) { return GiNaC::numeric(value.get_str().c_str()); }

    /// Several terms as one, divided by the coefficient of the first.
    static VectorTerm sum_of_terms(const VectorTerms& terms, const std::map<std::size_t, Rational>& sum)
    {
        VectorTerm whole{nullptr, nullptr, {}};
        std::vector<Tree> written;
        for (const auto& [k, rational] : sum) {
            written.push_back(times(number(rational / sum.begin()->second), terms[k]));
            whole.vectors.insert(terms[k].vectors.begin(), terms[k].vectors.end());
            whole.diagonals.insert(terms[k].diagonals.begin(), terms[k].diagonals.end());
            if (terms[k].basis != 0) whole.basis = terms[k].basis;
        }
        whole.tree = add(written);
        return whole;
    }

    /// The value as terms: those with one vector together, or by their factors where that is much shorter, as for the
    /// forces of bodies, m M (x - y)/|x - y|^3.
    template <class TermsOf>
    std::optional<std::vector<Term>> sum_of(const ByFactor& value, const TermsOf& terms_of)
    {
        std::vector<Collected> by_vector, by_factor;
        for (const auto& [text, part] : value) {
            const VectorTerms terms = terms_of(part.value);
            const auto sum = terms.sum_of(part.value);
            if (!sum) return std::nullopt;
            for (const auto& [k, rational] : *sum) collect(by_vector, part.factor * to_number(rational), terms[k]);
            if (sum->size() > 1)
                collect(by_factor, part.factor * to_number(sum->begin()->second), sum_of_terms(terms, *sum));
            else
                for (const auto& [k, rational] : *sum) collect(by_factor, part.factor * to_number(rational), terms[k]);
        }
        std::vector<Term> vectors = written_terms(by_vector);
        if (by_vector.size() < 3) return vectors;
        std::vector<Term> factors = written_terms(by_factor);
        return 3 * length_of(factors) < 2 * length_of(vectors) ? factors : vectors;
    }

    std::vector<Term> written_terms(const std::vector<Collected>& collected)
    {
        std::vector<Term> result;
        for (const Collected& each : collected)
            result.push_back({shortest_form(each.factor, symbols_, order_), each.vector});
        std::ranges::stable_sort(result, {}, [](const Term& term) { return !term.vector.is_product(); });
        return result;
    }

    static std::size_t length_of(const std::vector<Term>& terms)
    {
        std::size_t length = 0;
        for (const Term& term : terms) length += to_text(times(term.factor, term.vector)).size();
        return length;
    }

    /// Adds the terms of component k; nothing where there are too many.
    bool split(const Tree& tree, std::size_t k, std::size_t components, ByFactor& value)
    {
        const GiNaC::ex whole = roots_.hidden(to_ginac(tree, symbols_));
        const std::optional<std::size_t> length = expanded_length(whole);
        if (!length || *length > most_terms) return false;
        const GiNaC::ex expanded = whole.expand();
        if (!GiNaC::is_a<GiNaC::add>(expanded)) return split_term(expanded, k, components, value);
        for (const GiNaC::ex& term : expanded)
            if (!split_term(term, k, components, value)) return false;
        return true;
    }

    bool split_term(const GiNaC::ex& term, std::size_t k, std::size_t components, ByFactor& value)
    {
        Monomial monomial;
        Rational coefficient = 1;
        GiNaC::ex rest = 1;
        const auto take = [&](const GiNaC::ex& factor) {
            if (GiNaC::is_a<GiNaC::numeric>(factor)) {
                coefficient *= value_of(from_ginac(factor, symbols_, order_));
                return;
            }
            const GiNaC::ex base = GiNaC::is_a<GiNaC::power>(factor) ? factor.op(0) : factor;
            const GiNaC::ex exponent = GiNaC::is_a<GiNaC::power>(factor) ? factor.op(1) : GiNaC::ex(1);
            if (GiNaC::is_a<GiNaC::symbol>(base) && exponent.info(GiNaC::info_flags::posint)) {
                const std::string& symbol = symbols_.name_of(GiNaC::ex_to<GiNaC::symbol>(base));
                if (entries_.contains(symbol)) {
                    monomial.insert(monomial.end(),
                                    static_cast<std::size_t>(GiNaC::ex_to<GiNaC::numeric>(exponent).to_int()), symbol);
                    return;
                }
            }
            rest *= factor;
        };
        if (GiNaC::is_a<GiNaC::mul>(term))
            for (const GiNaC::ex& factor : term) take(factor);
        else
            take(term);
        std::ranges::sort(monomial);
        rest = roots_.shown(rest);
        ScalarFactor& part = value[to_text(shortest_form(rest, symbols_, order_))];
        part.factor = rest;
        part.value.resize(components);
        Rational& entry = part.value[k][monomial];
        entry += coefficient;
        if (sgn(entry) == 0) part.value[k].erase(monomial);
        return true;
    }

    [[nodiscard]] GiNaC::ex polynomial(const Polynomial& value)
    {
        GiNaC::ex sum = 0;
        for (const auto& [monomial, coefficient] : value) {
            GiNaC::ex term = GiNaC::numeric(coefficient.get_str().c_str());
            for (const std::string& entry : monomial) term *= symbols_.symbol(entry);
            sum += term;
        }
        return sum;
    }

    void note_names(const std::vector<Term>& terms)
    {
        for (const Term& term : terms) {
            used_.insert(term.vector.vectors.begin(), term.vector.vectors.end());
            diagonals_.insert(term.vector.diagonals.begin(), term.vector.diagonals.end());
        }
    }

    const VectorNames& names_;
    std::set<std::string> entries_;
    SymbolTable symbols_;
    Order order_;
    HiddenRoots roots_{symbols_, order_};
    std::set<std::string> used_, diagonals_; ///< names that written equations have
};

} // namespace

void write_vectors(EquationSet& equations, const Model& model)
{
    VectorNames names = vector_names(equations, model);
    if (names.vectors.empty()) return;
    for (;;) {
        VectorWriting writing(equations, names);
        std::vector<std::pair<EquationBlock*, std::vector<Equation>>> blocks;
        for (auto* list : {&equations.given, &equations.blocks})
            for (EquationBlock& block : *list) blocks.emplace_back(&block, writing.written(block));
        if (writing.is_ambiguous()) { // three numbered parameters are a vector here, and no matrix
            std::erase_if(names.matrices, [](const MatrixName& matrix) { return matrix.diagonal; });
            continue;
        }
        for (auto& [block, written] : blocks) block->written = std::move(written);
        equations.vectors = writing.vectors();
        for (const VectorName& vector : names.vectors)
            if (!vector.latex.empty()) equations.symbols.push_back({vector.name, vector.latex});
        return;
    }
}

} // namespace lagen
