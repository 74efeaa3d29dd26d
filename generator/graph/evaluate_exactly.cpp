// SPDX-License-Identifier: GPL-2.0-or-later
/// The interpreter over the rationals: exact, or no answer.
#include "expression/evaluate_stumpff.hpp"
#include "graph/evaluate.hpp"

#include <cmath>
#include <optional>

namespace lagen {
namespace {

/// Larger numbers than this are no answer either: repeated squaring doubles the digits with every node.
constexpr std::size_t most_bits = std::size_t{1} << 20U;

using Exact = std::optional<Rational>;

Exact quotient(const Rational& a, const Rational& b)
{
    if (sgn(b) == 0) return std::nullopt;
    return Rational(a / b);
}

Exact integer_power(const Rational& a, std::int64_t n)
{
    const auto magnitude = static_cast<std::size_t>(n < 0 ? -n : n);
    if (bits_of(a) > most_bits / magnitude && a != 0 && abs(a) != 1) return std::nullopt;
    Rational result;
    mpz_pow_ui(result.get_num_mpz_t(), a.get_num_mpz_t(), magnitude);
    mpz_pow_ui(result.get_den_mpz_t(), a.get_den_mpz_t(), magnitude);
    return n < 0 ? quotient(1, result) : Exact(result);
}

Exact truth(bool condition)
{
    return Rational(condition ? 1 : 0);
}

Exact apply(Op op, const std::vector<Rational>& x, std::uint32_t payload)
{
    switch (op) {
    case Op::add: return Rational(x[0] + x[1]);
    case Op::subtract: return Rational(x[0] - x[1]);
    case Op::multiply: return Rational(x[0] * x[1]);
    case Op::divide: return quotient(x[0], x[1]);
    case Op::negate: return Rational(-x[0]);
    case Op::power: return integer_power(x[0], static_cast<std::int32_t>(payload));
    case Op::abs: return Rational(abs(x[0]));
    case Op::sign: return Rational(sgn(x[0]));
    case Op::minimum: return x[0] <= x[1] ? x[0] : x[1];
    case Op::maximum: return x[0] >= x[1] ? x[0] : x[1];
    case Op::less: return truth(x[0] < x[1]);
    case Op::less_equal: return truth(x[0] <= x[1]);
    case Op::greater: return truth(x[0] > x[1]);
    case Op::greater_equal: return truth(x[0] >= x[1]);
    case Op::equal: return truth(x[0] == x[1]);
    case Op::not_equal: return truth(x[0] != x[1]);
    case Op::select: return x[0] != 0 ? x[1] : x[2];
    case Op::stumpff: return x[0] == 0 ? Exact(stumpff_at_zero(payload)) : std::nullopt;
    default: return std::nullopt;
    }
}

/// z = A^-1 b by Gauss-Jordan elimination; empty where A is singular.
std::vector<Rational> eliminate(std::vector<Rational> a, std::vector<Rational> b)
{
    const std::size_t n = b.size();
    for (std::size_t k = 0; k < n; ++k) {
        std::size_t pivot = k;
        while (pivot < n && a[pivot * n + k] == 0) ++pivot;
        if (pivot == n) return {};
        std::swap(b[k], b[pivot]);
        for (std::size_t j = 0; j < n; ++j) std::swap(a[k * n + j], a[pivot * n + j]);
        for (std::size_t i = 0; i < n; ++i) {
            if (i == k || a[i * n + k] == 0) continue;
            const Rational factor = a[i * n + k] / a[k * n + k];
            for (std::size_t j = k; j < n; ++j) a[i * n + j] -= factor * a[k * n + j];
            b[i] -= factor * b[k];
        }
    }
    for (std::size_t k = 0; k < n; ++k) b[k] /= a[k * n + k];
    return b;
}

class ExactInterpreter {
  public:
    ExactInterpreter(const Graph& graph, std::size_t size, const std::map<std::string, Rational>& inputs)
        : graph_(graph), inputs_(inputs), values_(size)
    {
    }

    [[nodiscard]] const Rational& value(NodeId id) const { return values_[id]; }

    /// False where the node has no rational value.
    bool visit(NodeId id)
    {
        std::vector<Rational> x;
        if (graph_.op(id) != Op::solve && graph_.op(id) != Op::factor)
            for (const NodeId operand : graph_.operands(id)) x.push_back(values_[operand]);
        Exact result;
        switch (graph_.op(id)) {
        case Op::constant: result = graph_.value(id); break;
        case Op::input: result = input(id); break;
        case Op::factor: return true;
        case Op::solve: return visit_solve(id);
        case Op::component: result = solutions_.at(graph_.operands(id)[0])[graph_.payload(id)]; break;
        default: result = apply(graph_.op(id), x, graph_.payload(id));
        }
        if (!result || bits_of(*result) > most_bits) return false;
        values_[id] = std::move(*result);
        return true;
    }

  private:
    [[nodiscard]] Rational input(NodeId id) const
    {
        const auto found = inputs_.find(graph_.input_name(id));
        if (found == inputs_.end())
            throw InternalError("evaluate_exactly() has no value for the input " + graph_.input_name(id));
        return found->second;
    }

    bool visit_solve(NodeId id)
    {
        std::vector<Rational> a;
        std::vector<Rational> b;
        for (const NodeId entry : graph_.operands(graph_.operands(id)[0])) a.push_back(values_[entry]);
        for (const NodeId entry : graph_.operands(id).subspan(1)) b.push_back(values_[entry]);
        auto z = eliminate(std::move(a), std::move(b));
        const bool regular = !z.empty();
        solutions_.emplace(id, std::move(z));
        return regular;
    }

    const Graph& graph_;
    const std::map<std::string, Rational>& inputs_;
    std::vector<Rational> values_;
    std::map<NodeId, std::vector<Rational>> solutions_;
};

} // namespace

std::vector<Rational> evaluate_exactly(const Graph& graph, std::span<const NodeId> outputs,
                                       const std::map<std::string, Rational>& inputs)
{
    const auto nodes = reachable(graph, outputs);
    ExactInterpreter interpreter(graph, nodes.empty() ? 0 : std::size_t{nodes.back()} + 1, inputs);
    for (const NodeId id : nodes)
        if (!interpreter.visit(id)) return {};
    std::vector<Rational> result;
    for (const NodeId id : outputs) result.push_back(interpreter.value(id));
    return result;
}

} // namespace lagen
