// SPDX-License-Identifier: GPL-2.0-or-later
/// A form back to nodes: numerators over denominators, powers by shared squares, signs absorbed into differences.
#include "graph/form.hpp"

#include <cstdlib>
#include <map>
#include <set>

namespace lagen {
namespace {

class Builder {
  public:
    Builder(const Form& form, Graph& graph) : form_(form), graph_(graph), nodes_(form.algebra.size())
    {
        for (const Place& place : live_places(form))
            for (const Term& term : at(form, place))
                for (const Factor& factor : term.monomial) exponents_[factor.atom].insert(std::abs(factor.exponent));
    }

    void build(AtomId id)
    {
        const Atom& atom = form_.algebra[id];
        switch (atom.op) {
        case Op::input:
        case Op::pi: nodes_[id] = atom.payload; break;
        case Op::add:
        case Op::multiply: nodes_[id] = sum(atom.operands[0]); break;
        case Op::factor: break; // built with its solve
        case Op::solve: solve(id); break;
        case Op::component: nodes_[id] = solutions_.at(only_atom(atom.operands[0]))[atom.payload]; break;
        case Op::select:
            nodes_[id] = graph_.select(sum(atom.operands[0]), sum(atom.operands[1]), sum(atom.operands[2]));
            break;
        default:
            nodes_[id] = atom.operands.size() == 1
                             ? graph_.apply(atom.op, sum(atom.operands[0]))
                             : graph_.apply(atom.op, sum(atom.operands[0]), sum(atom.operands[1]));
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

    NodeId product(const Rational& coefficient, const Monomial& monomial)
    {
        NodeId above = graph_.constant(coefficient);
        NodeId below = graph_.constant(1);
        for (const Factor& factor : monomial) {
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

} // namespace lagen
