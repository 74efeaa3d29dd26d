// SPDX-License-Identifier: GPL-2.0-or-later
/// The interpreter in floating point: one sweep over the reachable nodes.
#include "graph/evaluate.hpp"

#include "graph/operators.hpp"

#include <mpfr.h>

#include <cmath>
#include <limits>
#include <type_traits>

namespace lagen {
namespace {

template <class Scalar>
Scalar rounded(mpfr_srcptr value)
{
    if constexpr (std::is_same_v<Scalar, float>)
        return mpfr_get_flt(value, MPFR_RNDN);
    else if constexpr (std::is_same_v<Scalar, double>)
        return mpfr_get_d(value, MPFR_RNDN);
    else
        return mpfr_get_ld(value, MPFR_RNDN);
}

/// The nearest Scalar to a constant or to pi: one rounding, at the precision of Scalar.
template <class Scalar>
Scalar rounded(const Graph& graph, NodeId id)
{
    mpfr_t value;
    mpfr_init2(value, std::numeric_limits<Scalar>::digits);
    if (graph.op(id) == Op::pi)
        mpfr_const_pi(value, MPFR_RNDN);
    else
        mpfr_set_q(value, graph.value(id).get_mpq_t(), MPFR_RNDN);
    const auto result = rounded<Scalar>(value);
    mpfr_clear(value);
    return result;
}

template <class Scalar>
Value<Scalar> value_of(Op op)
{
    const Operator& entry = operator_of(op);
    if constexpr (std::is_same_v<Scalar, float>)
        return entry.value_float;
    else if constexpr (std::is_same_v<Scalar, double>)
        return entry.value_double;
    else
        return entry.value_long_double;
}

/// P A = L U by rows with partial pivoting; `regular` is false where a pivot is 0 or not a number.
template <class Scalar>
struct Factorisation {
    std::vector<Scalar> lu;
    std::vector<std::size_t> order; ///< row of A that stands in row i of L U
    bool regular = true;
};

template <class Scalar>
Factorisation<Scalar> factorise(std::vector<Scalar> a, std::size_t n)
{
    Factorisation<Scalar> result;
    result.order.resize(n);
    for (std::size_t i = 0; i < n; ++i) result.order[i] = i;
    for (std::size_t k = 0; k < n; ++k) {
        std::size_t pivot = k;
        for (std::size_t i = k + 1; i < n; ++i)
            if (std::abs(a[i * n + k]) > std::abs(a[pivot * n + k])) pivot = i;
        if (!(std::abs(a[pivot * n + k]) > 0)) result.regular = false;
        for (std::size_t j = 0; pivot != k && j < n; ++j) std::swap(a[k * n + j], a[pivot * n + j]);
        std::swap(result.order[k], result.order[pivot]);
        for (std::size_t i = k + 1; i < n; ++i) {
            const Scalar factor = a[i * n + k] /= a[k * n + k];
            for (std::size_t j = k + 1; j < n; ++j) a[i * n + j] -= factor * a[k * n + j];
        }
    }
    result.lu = std::move(a);
    return result;
}

template <class Scalar>
std::vector<Scalar> substitute(const Factorisation<Scalar>& f, const std::vector<Scalar>& b)
{
    const std::size_t n = b.size();
    std::vector<Scalar> z(n, std::numeric_limits<Scalar>::quiet_NaN());
    if (!f.regular) return z;
    for (std::size_t i = 0; i < n; ++i) {
        z[i] = b[f.order[i]];
        for (std::size_t j = 0; j < i; ++j) z[i] -= f.lu[i * n + j] * z[j];
    }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t j = i + 1; j < n; ++j) z[i] -= f.lu[i * n + j] * z[j];
        z[i] /= f.lu[i * n + i];
    }
    return z;
}

/// The sweep: scalar values by node id; factorisations and solutions in their own tables.
template <class Scalar>
class Interpreter {
  public:
    Interpreter(const Graph& graph, const std::map<std::string, Scalar>& inputs) : graph_(graph), inputs_(inputs) {}

    void visit(NodeId id)
    {
        gather(id);
        switch (graph_.op(id)) {
        case Op::constant:
        case Op::pi: values_[id] = rounded<Scalar>(graph_, id); break;
        case Op::input: values_[id] = input(id); break;
        case Op::factor: {
            const auto n = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(operands_.size()))));
            factors_.emplace(id, factorise(operands_, n));
            break;
        }
        case Op::solve:
            operands_.erase(operands_.begin()); // the factor node
            solutions_.emplace(id, substitute(factors_.at(graph_.operands(id)[0]), operands_));
            break;
        case Op::component: values_[id] = solutions_.at(graph_.operands(id)[0])[graph_.payload(id)]; break;
        default:
            values_[id] =
                value_of<Scalar>(graph_.op(id))(operands_.data(), static_cast<std::int32_t>(graph_.payload(id)));
        }
    }

    void resize(std::size_t size) { values_.resize(size); }
    [[nodiscard]] Scalar value(NodeId id) const { return values_[id]; }

  private:
    void gather(NodeId id)
    {
        operands_.clear();
        for (const NodeId operand : graph_.operands(id)) operands_.push_back(values_[operand]);
    }

    [[nodiscard]] Scalar input(NodeId id) const
    {
        const auto found = inputs_.find(graph_.input_name(id));
        if (found == inputs_.end())
            throw InternalError("evaluate() has no value for the input " + graph_.input_name(id));
        return found->second;
    }

    const Graph& graph_;
    const std::map<std::string, Scalar>& inputs_;
    std::vector<Scalar> values_;
    std::vector<Scalar> operands_;
    std::map<NodeId, Factorisation<Scalar>> factors_;
    std::map<NodeId, std::vector<Scalar>> solutions_;
};

} // namespace

template <class Scalar>
std::vector<Scalar> evaluate(const Graph& graph, std::span<const NodeId> outputs,
                             const std::map<std::string, Scalar>& inputs)
{
    Interpreter<Scalar> interpreter(graph, inputs);
    const auto nodes = reachable(graph, outputs);
    interpreter.resize(nodes.empty() ? 0 : std::size_t{nodes.back()} + 1);
    for (const NodeId id : nodes) interpreter.visit(id);
    std::vector<Scalar> result;
    for (const NodeId id : outputs) result.push_back(interpreter.value(id));
    return result;
}

template std::vector<float> evaluate(const Graph&, std::span<const NodeId>, const std::map<std::string, float>&);
template std::vector<double> evaluate(const Graph&, std::span<const NodeId>, const std::map<std::string, double>&);
template std::vector<long double> evaluate(const Graph&, std::span<const NodeId>,
                                           const std::map<std::string, long double>&);

} // namespace lagen
