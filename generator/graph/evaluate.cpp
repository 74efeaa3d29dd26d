// SPDX-License-Identifier: GPL-2.0-or-later
/// The interpreter in floating point: one sweep over the reachable nodes.
#include "graph/evaluate.hpp"

#include "graph/dense_lu.hpp"
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
