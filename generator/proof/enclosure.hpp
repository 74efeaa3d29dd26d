// SPDX-License-Identifier: GPL-2.0-or-later
/// Certified enclosures of graph nodes in ball arithmetic (Arb), and exact rational values where every operation is
/// rational.
#pragma once

#include "graph/core/graph.hpp"

#include <arb.h>

#include <map>
#include <optional>

namespace lagen::proof {

/// A real number with a rigorous error bound; "not finite" where nothing certain is known.
class Ball {
  public:
    Ball() { arb_init(ball_); }
    Ball(const Ball& other) : Ball() { arb_set(ball_, other.ball_); }
    Ball(Ball&& other) noexcept : Ball() { arb_swap(ball_, other.ball_); }
    Ball& operator=(Ball other) noexcept
    {
        arb_swap(ball_, other.ball_);
        return *this;
    }
    ~Ball() { arb_clear(ball_); }
    Ball(const Rational& value, slong precision);

    [[nodiscard]] arb_ptr get() { return ball_; }
    [[nodiscard]] arb_srcptr get() const { return ball_; }
    [[nodiscard]] bool is_finite() const { return arb_is_finite(ball_) != 0; }
    [[nodiscard]] bool excludes_zero() const { return is_finite() && arb_contains_zero(ball_) == 0; }
    [[nodiscard]] bool is_positive() const { return is_finite() && arb_is_positive(ball_) != 0; }
    /// An upper bound of |x|; infinite where x is not finite.
    [[nodiscard]] double bound() const;
    [[nodiscard]] double middle() const; ///< rounded to nearest

  private:
    arb_t ball_;
};

/// What the inputs are at a point, at a precision.
using BallInputs = std::map<NodeId, Ball>;
using ExactInputs = std::map<NodeId, Rational>;

/// The nodes that some roots need, in order, ready to be evaluated at many points.
class Evaluation {
  public:
    Evaluation(const Graph& graph, std::vector<NodeId> roots);

    /// Enclosures of the roots; comparisons are 1 or 0 where certain, else not finite. A branch of select that is
    /// certainly not taken is ignored; squares, moduli and what is made of them are nowhere below 0.
    [[nodiscard]] std::vector<Ball> enclose(const BallInputs& inputs, slong precision) const;
    /// Exact values of the roots; nothing where an operation is not rational, divides by 0 or outgrows 20000 bits.
    [[nodiscard]] std::optional<std::vector<Rational>> exactly(const ExactInputs& inputs) const;
    [[nodiscard]] const std::vector<NodeId>& inputs() const { return inputs_; }
    [[nodiscard]] std::size_t size() const { return order_.size(); }

  private:
    [[nodiscard]] Ball enclose_node(NodeId node, const std::vector<Ball>& values, slong precision) const;
    [[nodiscard]] Ball enclose_component(NodeId node, const std::vector<Ball>& values, slong precision) const;
    [[nodiscard]] bool is_nonnegative(NodeId node) const;
    [[nodiscard]] bool exact_node(NodeId node, const std::vector<Rational>& values, Rational& result) const;
    template <class Value>
    [[nodiscard]] const Value& operand(NodeId node, std::size_t k, const std::vector<Value>& values) const
    {
        return values[slots_.at(graph_.operands(node)[k])];
    }

    const Graph& graph_;
    std::vector<NodeId> roots_;
    std::vector<NodeId> order_;
    std::vector<NodeId> inputs_;
    std::map<NodeId, std::size_t> slots_;
    std::vector<bool> nonnegative_; ///< by slot: wherever it is defined, as its operation and operands show
};

/// c_k(z) = sum_j (-z)^j / (2j+k)!, accurate for balls around 0 and of either sign.
[[nodiscard]] Ball enclose_stumpff(unsigned k, const Ball& z, slong precision);

} // namespace lagen::proof
