// SPDX-License-Identifier: GPL-2.0-or-later
/// Arithmetic modulo 2^61 - 1, node by node.
#include "proof/modular.hpp"

#include <gmpxx.h>

#include <map>
#include <optional>

namespace lagen::proof {

namespace {

using Residue = std::uint64_t;
constexpr Residue prime = (Residue{1} << 61) - 1;

Residue add(Residue a, Residue b)
{
    const Residue sum = a + b;
    return sum >= prime ? sum - prime : sum;
}

Residue negate(Residue a)
{
    return a == 0 ? 0 : prime - a;
}

/// By halves of 31 and 30 bits: 2^61 = 1.
Residue multiply(Residue a, Residue b)
{
    constexpr Residue low31 = (Residue{1} << 31) - 1, low30 = (Residue{1} << 30) - 1;
    const Residue a1 = a >> 31, a0 = a & low31, b1 = b >> 31, b0 = b & low31;
    const Residue middle = a1 * b0 + a0 * b1; // times 2^31
    const Residue high = 2 * a1 * b1;         // 2^62 = 2
    const Residue sum = high + (middle >> 30) + ((middle & low30) << 31) + a0 * b0 % prime;
    return (sum >> 61) + (sum & prime) >= prime ? (sum >> 61) + (sum & prime) - prime : (sum >> 61) + (sum & prime);
}

Residue power(Residue a, Residue exponent)
{
    Residue result = 1;
    for (; exponent > 0; exponent >>= 1, a = multiply(a, a))
        if (exponent & 1U) result = multiply(result, a);
    return result;
}

std::optional<Residue> inverse(Residue a)
{
    return a == 0 ? std::nullopt : std::optional(power(a, prime - 2));
}

Residue mixed(Residue x)
{
    x += 0x9e3779b97f4a7c15ULL;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
    return (x ^ (x >> 31)) % prime;
}

/// prime = 3 modulo 4: a^((prime + 1)/4) is the root of a square that is a square itself, hence multiplicative.
std::optional<Residue> square_root(Residue a)
{
    const Residue root = power(a, (prime + 1) / 4);
    return multiply(root, root) == a ? std::optional(root) : std::nullopt;
}

std::optional<Residue> residue_of(const Rational& q)
{
    const mpz_class p = (mpz_class(1) << 61) - 1;
    mpz_class above, below;
    mpz_fdiv_r(above.get_mpz_t(), q.get_num_mpz_t(), p.get_mpz_t());
    mpz_fdiv_r(below.get_mpz_t(), q.get_den_mpz_t(), p.get_mpz_t());
    const std::optional<Residue> factor = inverse(below.get_ui());
    return factor ? std::optional(multiply(above.get_ui(), *factor)) : std::nullopt;
}

std::optional<Residue> value_of(const Graph& graph, NodeId node, const std::map<NodeId, Residue>& values, Residue seed)
{
    const auto operands = graph.operands(node);
    const Op op = graph.op(node);
    if (op == Op::constant) return residue_of(graph.value(node));
    if (op == Op::pi || op == Op::input) return mixed(seed * 1'000'003 + node);
    const Residue a = values.at(operands[0]), b = operands.size() > 1 ? values.at(operands[1]) : 0;
    switch (op) {
    case Op::add: return add(a, b);
    case Op::subtract: return add(a, negate(b));
    case Op::negate: return negate(a);
    case Op::multiply: return multiply(a, b);
    case Op::divide: {
        const std::optional<Residue> factor = inverse(b);
        return factor ? std::optional(multiply(a, *factor)) : std::nullopt;
    }
    case Op::power: {
        const auto exponent = static_cast<std::int64_t>(static_cast<std::int32_t>(graph.payload(node)));
        const Residue magnitude = power(a, static_cast<Residue>(exponent < 0 ? -exponent : exponent));
        return exponent < 0 ? inverse(magnitude) : std::optional(magnitude);
    }
    case Op::sqrt: return square_root(a);
    case Op::sin:
    case Op::cos:
    case Op::tan: {
        const Residue t = mixed(a ^ 0x5bd1e995), square = multiply(t, t);
        const Residue sine = add(t, t), cosine = add(1, negate(square));
        const std::optional<Residue> below = inverse(op == Op::tan ? cosine : add(1, square));
        return below ? std::optional(multiply(op == Op::cos ? cosine : sine, *below)) : std::nullopt;
    }
    default: break;
    }
    Residue hash = mixed(static_cast<Residue>(op) * 7919 + graph.payload(node));
    for (const NodeId operand : operands) hash = mixed(hash * 31 + values.at(operand));
    return hash;
}

} // namespace

std::size_t modular_zeros(const Graph& graph, NodeId node, std::size_t points)
{
    const std::vector<NodeId> order = reachable(graph, std::vector<NodeId>{node});
    std::size_t zeros = 0;
    // A root has no residue at every second point: more points are tried than are wanted.
    for (Residue seed = 1; seed <= 64 * points && zeros < points; ++seed) {
        std::map<NodeId, Residue> values;
        bool defined = true;
        for (const NodeId id : order) {
            const std::optional<Residue> value = value_of(graph, id, values, seed);
            defined = value.has_value();
            if (!defined) break;
            values[id] = *value;
        }
        if (!defined) continue;
        if (values.at(node) != 0) return 0;
        ++zeros;
    }
    return zeros;
}

} // namespace lagen::proof
