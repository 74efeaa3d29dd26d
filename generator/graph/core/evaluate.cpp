// SPDX-License-Identifier: GPL-2.0-or-later
/// The interpreter in floating point: one sweep over the reachable nodes.
#include "graph/core/evaluate.hpp"

#include "graph/core/sweep.hpp"

#include <limits>
#include <mpfr.h>
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
ValueAt<Scalar> value_of(Op op)
{
    const ScalarValues& values = operator_of(op).value;
    if constexpr (std::is_same_v<Scalar, float>)
        return values.in_float;
    else if constexpr (std::is_same_v<Scalar, double>)
        return values.in_double;
    else
        return values.in_long_double;
}

template <class Scalar>
struct FloatField : Arithmetic<Scalar> {
    const std::map<std::string, Scalar>& inputs;

    explicit FloatField(const std::map<std::string, Scalar>& values) : inputs(values) {}

    bool leaf(const Graph& graph, NodeId id, Scalar& value) const
    {
        value = graph.op(id) == Op::input ? input_value(graph, id, inputs) : rounded<Scalar>(graph, id);
        return true;
    }

    bool operation(Op op, std::uint32_t payload, const Scalar* x, Scalar& value) const
    {
        value = value_of<Scalar>(op)(x, static_cast<std::int32_t>(payload));
        return true;
    }
};

} // namespace

template <class Scalar>
std::vector<Scalar> evaluate(const Graph& graph, std::span<const NodeId> outputs,
                             const std::map<std::string, Scalar>& inputs)
{
    Sweep interpreter(graph, FloatField<Scalar>(inputs));
    interpreter.visit(reachable(graph, outputs));
    std::vector<Scalar> result;
    for (const NodeId id : outputs) result.push_back(interpreter.value(id));
    return result;
}

template std::vector<float> evaluate(const Graph&, std::span<const NodeId>, const std::map<std::string, float>&);
template std::vector<double> evaluate(const Graph&, std::span<const NodeId>, const std::map<std::string, double>&);
template std::vector<long double> evaluate(const Graph&, std::span<const NodeId>,
                                           const std::map<std::string, long double>&);

// The interpreter over the rationals: exact, or no answer.
namespace {

/// Larger numbers than this are no answer either: repeated squaring doubles the digits with every node.
constexpr std::size_t most_bits = std::size_t{1} << 20U;

struct ExactField : Arithmetic<Rational> {
    const std::map<std::string, Rational>& inputs;

    explicit ExactField(const std::map<std::string, Rational>& values) : inputs(values) {}

    bool leaf(const Graph& graph, NodeId id, Rational& value) const
    {
        if (graph.op(id) == Op::pi) return false;
        value = graph.is_constant(id) ? graph.value(id) : input_value(graph, id, inputs);
        return true;
    }

    bool operation(Op op, std::uint32_t payload, const Rational* x, Rational& value) const
    {
        auto result = exact_value(op, x, payload, most_bits);
        if (!result || bits_of(*result) > most_bits) return false;
        value = std::move(*result);
        return true;
    }
};

} // namespace

std::vector<Rational> evaluate_exactly(const Graph& graph, std::span<const NodeId> outputs,
                                       const std::map<std::string, Rational>& inputs)
{
    Sweep interpreter(graph, ExactField(inputs));
    if (!interpreter.visit(reachable(graph, outputs))) return {};
    std::vector<Rational> result;
    for (const NodeId id : outputs) result.push_back(interpreter.value(id));
    return result;
}

} // namespace lagen
