// SPDX-License-Identifier: GPL-2.0-or-later
#include "graph/rounded_sweep.hpp"

#include "graph/operators.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <numbers>

namespace lagen {

namespace {

/// z = A^-1 b by elimination with row exchanges; `round` follows every operation. NaN where a pivot vanishes.
template <class Round>
std::vector<double> eliminate(std::vector<double> a, std::vector<double> b, const Round& round)
{
    const std::size_t n = b.size();
    for (std::size_t k = 0; k < n; ++k) {
        std::size_t pivot = k;
        for (std::size_t i = k + 1; i < n; ++i)
            if (std::abs(a[i * n + k]) > std::abs(a[pivot * n + k])) pivot = i;
        if (!(std::abs(a[pivot * n + k]) > 0)) return std::vector<double>(n, std::numeric_limits<double>::quiet_NaN());
        std::swap(b[k], b[pivot]);
        for (std::size_t j = k; pivot != k && j < n; ++j) std::swap(a[k * n + j], a[pivot * n + j]);
        for (std::size_t i = k + 1; i < n; ++i) {
            const double factor = round(a[i * n + k] / a[k * n + k]);
            for (std::size_t j = k + 1; j < n; ++j) a[i * n + j] = round(a[i * n + j] - round(factor * a[k * n + j]));
            b[i] = round(b[i] - round(factor * b[k]));
        }
    }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t j = i + 1; j < n; ++j) b[i] = round(b[i] - round(a[i * n + j] * b[j]));
        b[i] = round(b[i] / a[i * n + i]);
    }
    return b;
}

template <class Round>
class Sweep {
  public:
    Sweep(const Graph& graph, std::size_t size, const std::vector<double>& inputs, const Round& round)
        : graph_(graph), round_(round), values_(size)
    {
        for (std::size_t k = 0; k < graph.inputs().size(); ++k)
            if (graph.inputs()[k] < size) values_[graph.inputs()[k]] = inputs[k];
    }

    void visit(NodeId id)
    {
        const auto operands = graph_.operands(id);
        switch (graph_.op(id)) {
        case Op::input:
        case Op::factor: return;
        case Op::constant: values_[id] = round_(graph_.value(id).get_d()); return;
        case Op::pi: values_[id] = round_(std::numbers::pi); return;
        case Op::solve: {
            std::vector<double> right;
            for (const NodeId entry : operands.subspan(1)) right.push_back(values_[entry]);
            std::vector<double> matrix;
            for (const NodeId entry : graph_.operands(operands[0])) matrix.push_back(values_[entry]);
            solutions_[id] = eliminate(std::move(matrix), std::move(right), round_);
            return;
        }
        case Op::component: values_[id] = solutions_.at(operands[0])[graph_.payload(id)]; return;
        case Op::power:
            values_[id] = power(values_[operands[0]], static_cast<std::int32_t>(graph_.payload(id)));
            return;
        default: break;
        }
        double x[3]{};
        for (std::size_t k = 0; k < operands.size(); ++k) x[k] = values_[operands[k]];
        values_[id] = round_(operator_of(graph_.op(id)).value_double(x, static_cast<std::int32_t>(graph_.payload(id))));
    }

    [[nodiscard]] std::vector<double> values() && { return std::move(values_); }

  private:
    /// By squaring, rounded as it goes: otherwise a power would be better than its product.
    [[nodiscard]] double power(double x, std::int32_t n) const
    {
        double result = 1;
        for (std::int64_t rest = std::abs(std::int64_t{n}); rest != 0; rest /= 2, x = round_(x * x))
            if (rest % 2 != 0) result = round_(result * x);
        return n < 0 ? round_(1 / result) : result;
    }

    const Graph& graph_;
    const Round& round_;
    std::vector<double> values_;
    std::map<NodeId, std::vector<double>> solutions_;
};

template <class Round>
std::vector<double> sweep_with(const Graph& graph, const std::vector<NodeId>& nodes, const std::vector<double>& inputs,
                               const Round& round)
{
    Sweep<Round> walk(graph, nodes.empty() ? 0 : std::size_t{nodes.back()} + 1, inputs, round);
    for (const NodeId id : nodes) walk.visit(id);
    return std::move(walk).values();
}

} // namespace

double to_24_bits(double x)
{
    const double scaled = x * 536870913.0; // 2^29 + 1
    return scaled - (scaled - x);
}

std::vector<double> sweep(const Graph& graph, const std::vector<NodeId>& nodes, const std::vector<double>& inputs,
                          bool rounded)
{
    if (rounded) return sweep_with(graph, nodes, inputs, [](double x) { return to_24_bits(x); });
    return sweep_with(graph, nodes, inputs, [](double x) { return x; });
}

} // namespace lagen
