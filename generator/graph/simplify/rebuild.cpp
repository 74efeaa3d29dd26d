// SPDX-License-Identifier: GPL-2.0-or-later
/// A form back to nodes: numerators over denominators, powers by shared squares, signs absorbed into differences.
#include "graph/core/operators.hpp"
#include "graph/simplify/form.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>

namespace lagen {
namespace {

class Builder {
  public:
    Builder(const Form& form, Graph& graph)
        : form_(form), graph_(graph), nodes_(form.algebra.size()), latest_(form.algebra.size())
    {
        for (const Place& place : live_places(form))
            for (const Term& term : at(form, place))
                for (const Factor& factor : term.monomial) exponents_[factor.atom].insert(std::abs(factor.exponent));
    }

    void build(AtomId id)
    {
        const Atom& atom = form_.algebra[id];
        latest_[id] = latest_input(atom);
        switch (kind_of(atom.op)) {
        case OpKind::leaf: nodes_[id] = atom.payload; break;
        case OpKind::sum: // the form has no other
        case OpKind::product: nodes_[id] = sum(atom.operands[0]); break;
        case OpKind::system:
            if (atom.op == Op::solve) solve(id); // its factor with it
            if (atom.op == Op::component) nodes_[id] = solutions_.at(only_atom(atom.operands[0]))[atom.payload];
            break;
        case OpKind::quotient:
        case OpKind::power:
        case OpKind::function:
        case OpKind::comparison:
        case OpKind::choice: {
            std::vector<NodeId> operands;
            for (const Polynomial& operand : atom.operands) operands.push_back(sum(operand));
            nodes_[id] = graph_.make(atom.op, atom.payload, operands);
        }
        }
    }

    /// Positive terms first, so that a sign costs an operation only where every term has one.
    NodeId sum(const Polynomial& polynomial)
    {
        NodeId total = graph_.constant(0);
        for (const bool positive : {true, false})
            for (const Term& term : polynomial)
                if ((sgn(term.coefficient) > 0) == positive) {
                    const NodeId size = product(abs(term.coefficient), term.monomial);
                    total = positive ? graph_.add(total, size) : graph_.subtract(total, size);
                }
        return total;
    }

  private:
    static AtomId only_atom(const Polynomial& polynomial) { return polynomial.at(0).monomial.at(0).atom; }

    /// 1 + the input, last in order of declaration, that the atom depends on; 0 where there is none.
    [[nodiscard]] NodeId latest_input(const Atom& atom) const
    {
        if (atom.op == Op::input) return atom.payload + 1;
        NodeId latest = 0;
        for (const Polynomial& operand : atom.operands)
            for (const Term& term : operand)
                for (const Factor& factor : term.monomial) latest = std::max(latest, latest_[factor.atom]);
        return latest;
    }

    /// Factors by the latest input that they depend on, so that products of parameters, declared before the state,
    /// come first: a compiler moves them out of loops.
    const Monomial& ordered(const Monomial& monomial)
    {
        const auto [place, inserted] = orders_.try_emplace(monomial, monomial);
        Monomial& order = place->second;
        if (!inserted) return order;
        std::ranges::stable_sort(order, {}, [this](const Factor& factor) { return latest_[factor.atom]; });
        if (order.size() > 2) take_turns(order[order.size() - 2], order[order.size() - 1]);
        return order;
    }

    /// Of two inputs at the end of a product, the one that stood last more often comes first: cyclic rows read
    /// a w2 w3, b w3 w1, c w1 w2, one shape that vectorises (heavy top by g++ 12 -O2: 58 instructions, 63 otherwise).
    void take_turns(Factor& first, Factor& last)
    {
        const auto is_plain = [this](const Factor& f) {
            return f.exponent == 1 && form_.algebra[f.atom].op == Op::input;
        };
        if (!is_plain(first) || !is_plain(last)) return;
        if (turns_[last.atom] > turns_[first.atom]) std::swap(first, last);
        --turns_[first.atom];
        ++turns_[last.atom];
    }

    NodeId product(const Rational& coefficient, const Monomial& monomial)
    {
        NodeId above = graph_.constant(coefficient);
        NodeId below = graph_.constant(1);
        for (const Factor& factor : ordered(monomial)) {
            NodeId& side = factor.exponent > 0 ? above : below;
            side = graph_.multiply(side, power(factor.atom, std::abs(factor.exponent)));
        }
        return graph_.divide(above, below);
    }

    /// x^n as the product of two powers that are needed anyway, where there are such.
    NodeId power(AtomId atom, int n)
    {
        const auto& needed = exponents_[atom];
        if (n > 2)
            for (const int low : needed) {
                if (2 * low > n) break;
                if (low == 1 && n - low == 1) continue;
                if (needed.contains(n - low) && low != n - low)
                    return graph_.multiply(power(atom, low), power(atom, n - low));
            }
        return graph_.power(nodes_[atom], n);
    }

    void solve(AtomId id)
    {
        const Atom& atom = form_.algebra[id];
        const Atom& factor = form_.algebra[only_atom(atom.operands[0])];
        std::vector<NodeId> matrix;
        std::vector<NodeId> right;
        for (const Polynomial& entry : factor.operands) matrix.push_back(sum(entry));
        for (std::size_t k = 1; k < atom.operands.size(); ++k) right.push_back(sum(atom.operands[k]));
        solutions_[id] = graph_.solve(matrix, right, static_cast<MatrixStructure>(factor.payload));
    }

    const Form& form_;
    Graph& graph_;
    std::vector<NodeId> nodes_;
    std::vector<NodeId> latest_; ///< by atom: latest_input
    std::map<Monomial, Monomial> orders_;
    std::map<AtomId, int> turns_; ///< how much oftener an input stands last than last but one
    std::map<AtomId, std::vector<NodeId>> solutions_;
    std::map<AtomId, std::set<int>> exponents_;
};

} // namespace

std::vector<NodeId> rebuild(const Form& form, Graph& graph)
{
    Builder builder(form, graph);
    for (const AtomId atom : live_atoms(form)) builder.build(atom);
    std::vector<NodeId> result;
    for (const Polynomial& root : form.roots) result.push_back(builder.sum(root));
    return result;
}

// Walks over a form.
namespace {

void append_atoms(const Polynomial& polynomial, std::vector<AtomId>& atoms)
{
    for (const Term& term : polynomial)
        for (const Factor& factor : term.monomial) atoms.push_back(factor.atom);
}

} // namespace

std::vector<AtomId> live_atoms(const Form& form)
{
    enum class Mark : std::uint8_t { unseen, open, done };
    struct Visit {
        AtomId atom;
        std::vector<AtomId> below;
        std::size_t next;
    };
    std::vector<Mark> marks(form.algebra.size(), Mark::unseen);
    std::vector<AtomId> order;
    std::vector<AtomId> starts;
    for (const Polynomial& root : form.roots) append_atoms(root, starts);
    std::vector<Visit> stack;
    const auto enter = [&](AtomId id) {
        if (marks[id] == Mark::done) return;
        if (marks[id] == Mark::open) throw FormRefused{};
        marks[id] = Mark::open;
        Visit visit{id, {}, 0};
        for (const Polynomial& operand : form.algebra[id].operands) append_atoms(operand, visit.below);
        stack.push_back(std::move(visit));
    };
    for (const AtomId start : starts) {
        enter(start);
        while (!stack.empty()) {
            Visit& visit = stack.back();
            if (visit.next < visit.below.size()) {
                enter(visit.below[visit.next++]);
                continue;
            }
            marks[visit.atom] = Mark::done;
            order.push_back(visit.atom);
            stack.pop_back();
        }
    }
    return order;
}

std::vector<Place> live_places(const Form& form)
{
    std::vector<Place> places;
    for (const AtomId atom : live_atoms(form))
        for (std::size_t k = 0; k < form.algebra[atom].operands.size(); ++k) places.push_back({false, atom, k});
    for (std::size_t k = 0; k < form.roots.size(); ++k) places.push_back({true, 0, k});
    return places;
}

Polynomial& at(Form& form, const Place& place)
{
    return place.root ? form.roots[place.operand] : form.algebra.operands(place.atom)[place.operand];
}

const Polynomial& at(const Form& form, const Place& place)
{
    return place.root ? form.roots[place.operand] : form.algebra[place.atom].operands[place.operand];
}

} // namespace lagen
