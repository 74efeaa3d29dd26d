// SPDX-License-Identifier: GPL-2.0-or-later
#include "problem.hpp"

#include "graph/calculus/differentiate.hpp"

#include <catch2/catch.hpp>

using namespace lagen;
using namespace lagen::test;

namespace {

/// A frame e_a = A(a, i) d/dx^i of T R^3 and its structure functions, by C^c_ab = (e_a(A(b, i)) - e_b(A(a, i))) A^-1(i,
/// c).
class Frame {
  public:
    Frame(Problem& problem, const std::vector<std::string>& entries) : graph_(problem.graph)
    {
        for (const auto& text : entries) A_.push_back(problem.node(text));
        for (const char* name : {"x", "y", "z"}) x_.push_back(graph_.input(name));
        const NodeId determinant =
            graph_.add(graph_.add(graph_.multiply(A(0, 0), minor(0, 0)), graph_.multiply(A(0, 1), minor(0, 1))),
                       graph_.multiply(A(0, 2), minor(0, 2)));
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t c = 0; c < 3; ++c) inverse_.push_back(graph_.divide(minor(c, i), determinant));
        for (std::size_t a = 0; a < 3; ++a)
            for (std::size_t b = 0; b < 3; ++b)
                for (std::size_t c = 0; c < 3; ++c) {
                    NodeId sum = graph_.constant(0);
                    for (std::size_t i = 0; i < 3; ++i)
                        sum = graph_.add(sum, graph_.multiply(bracket(a, b, i), inverse_[3 * i + c]));
                    C_.push_back(sum);
                }
    }

    NodeId A(std::size_t a, std::size_t i) const { return A_[3 * a + i]; }
    NodeId C(std::size_t c, std::size_t a, std::size_t b) const { return C_[9 * a + 3 * b + c]; }
    void perturb(NodeId amount) { C_[9 * 0 + 3 * 1 + 2] = graph_.add(C(2, 0, 1), amount); }

    /// rho_a(f)
    NodeId derivative(std::size_t a, NodeId f)
    {
        const std::pair<NodeId, NodeId> seeds[] = {{x_[0], A(a, 0)}, {x_[1], A(a, 1)}, {x_[2], A(a, 2)}};
        return directional(graph_, std::vector<NodeId>{f}, seeds)[0];
    }
    NodeId bracket(std::size_t a, std::size_t b, std::size_t i)
    {
        return graph_.subtract(derivative(a, A(b, i)), derivative(b, A(a, i)));
    }
    NodeId anchor_residual(std::size_t a, std::size_t b, std::size_t i)
    {
        NodeId sum = bracket(a, b, i);
        for (std::size_t c = 0; c < 3; ++c) sum = graph_.subtract(sum, graph_.multiply(A(c, i), C(c, a, b)));
        return sum;
    }
    NodeId jacobi_residual(std::size_t v)
    {
        NodeId sum = graph_.constant(0);
        const std::size_t cycles[3][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}};
        for (const auto& [a, b, c] : cycles) {
            sum = graph_.add(sum, derivative(a, C(v, b, c)));
            for (std::size_t m = 0; m < 3; ++m) sum = graph_.add(sum, graph_.multiply(C(m, b, c), C(v, a, m)));
        }
        return sum;
    }

  private:
    /// The cofactor of A(a, i).
    NodeId minor(std::size_t a, std::size_t i)
    {
        const std::size_t p = (a + 1) % 3, q = (a + 2) % 3, j = (i + 1) % 3, k = (i + 2) % 3;
        return graph_.subtract(graph_.multiply(A(p, j), A(q, k)), graph_.multiply(A(p, k), A(q, j)));
    }

    Graph& graph_;
    std::vector<NodeId> A_, x_, inverse_, C_;
};

} // namespace

TEST_CASE("the structure equations of frames of T R^3 are proved, and one perturbed structure function is refuted")
{
    const std::vector<std::string> frames[] = {
        {"1", "y", "0", "0", "1/(1 + x^2)", "z", "x", "0", "1"},
        {"x", "y", "1", "1/(x + y)", "z", "0", "0", "x/(1 + z^2)", "y"},
        {"cos(z)", "sin(z)", "0", "-sin(z)", "cos(z)", "x", "0", "exp(y)", "1"},
        {"1", "0", "y*cos(x + z)", "0", "sin(x - y)", "0", "z", "0", "2 + sin(y)^2"},
        {"1", "log(x)", "0", "0", "sqrt(x^2 + y^2)", "1", "0", "0", "x"},
    };
    for (const auto& entries : frames) {
        Problem problem({{"x", "y", "z"}, {}, {}, {}, {}});
        Frame frame(problem, entries);
        INFO(entries[0] << ", " << entries[1] << ", ...");
        for (std::size_t i = 0; i < 3; ++i) {
            const Decision anchor = problem.decider->decide(frame.anchor_residual(0, 1, i));
            CHECK(to_text(anchor.status) == std::string("proved"));
            const Decision jacobi = problem.decider->decide(frame.jacobi_residual(i));
            INFO(jacobi.evidence << jacobi.residual);
            CHECK(to_text(jacobi.status) == std::string("proved"));
        }
        frame.perturb(problem.node("x/10^18"));
        const Decision anchor = problem.decider->decide(frame.anchor_residual(0, 1, 2));
        CHECK(to_text(anchor.status) == std::string("refuted"));
    }
}
