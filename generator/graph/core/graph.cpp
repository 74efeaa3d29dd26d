// SPDX-License-Identifier: GPL-2.0-or-later
/// Leaves, hash-consing and reading of the graph. Arithmetic, functions and linear algebra have their own files.
#include "graph/core/graph.hpp"
#include "graph/core/operators.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace lagen {
namespace {

/// FNV-1a over the words of a node: the same on every machine.
class Hash {
  public:
    void mix(std::uint32_t word) { state_ = (state_ ^ word) * 0x100000001b3ULL; }
    [[nodiscard]] std::size_t value() const { return static_cast<std::size_t>(state_ ^ (state_ >> 32U)); }

  private:
    std::uint64_t state_ = 0xcbf29ce484222325ULL;
};

} // namespace

NodeId Graph::intern(Op op, std::span<const NodeId> operands, std::uint32_t payload)
{
    const bool commutes = operator_of(op).commutative;
    Hash hash;
    hash.mix(static_cast<std::uint32_t>(op));
    hash.mix(payload);
    if (commutes) {
        hash.mix(std::min(operands[0], operands[1]));
        hash.mix(std::max(operands[0], operands[1]));
    } else {
        for (const NodeId id : operands) hash.mix(id);
    }
    for (auto [it, end] = table_.equal_range(hash.value()); it != end; ++it) {
        const NodeId id = it->second;
        if (ops_[id] != op || payloads_[id] != payload) continue;
        const auto held = this->operands(id);
        if (commutes ? std::ranges::is_permutation(held, operands) : std::ranges::equal(held, operands)) return id;
    }
    const auto id = static_cast<NodeId>(ops_.size());
    if (ops_.size() >= UINT32_MAX - 1) throw InternalError("the graph is full: more than 2^32 nodes");
    const std::vector<NodeId> copy(operands.begin(), operands.end()); // `operands` may point into operands_
    if (first_.empty()) first_.push_back(0);
    ops_.push_back(op);
    payloads_.push_back(payload);
    operands_.insert(operands_.end(), copy.begin(), copy.end());
    if (operands_.size() > UINT32_MAX) throw InternalError("the graph is full: more than 2^32 operands");
    first_.push_back(static_cast<NodeId>(operands_.size()));
    table_.emplace(hash.value(), id);
    return id;
}

NodeId Graph::constant(const Rational& value)
{
    Rational canonical = value; // mpq_class(2, 4) is not 1/2 until it is told so
    canonical.canonicalize();
    const auto [it, inserted] = constant_ids_.try_emplace(canonical.get_str(62), 0);
    if (inserted) {
        constants_.push_back(std::move(canonical));
        it->second = intern(Op::constant, {}, static_cast<std::uint32_t>(constants_.size() - 1));
    }
    return it->second;
}

NodeId Graph::pi()
{
    return intern(Op::pi, {}, 0);
}

NodeId Graph::input(const std::string& name)
{
    const auto [it, inserted] = input_ids_.try_emplace(name, 0);
    if (inserted) {
        names_.push_back(name);
        it->second = intern(Op::input, {}, static_cast<std::uint32_t>(names_.size() - 1));
        inputs_.push_back(it->second);
    }
    return it->second;
}

void Graph::bind(const std::string& name, NodeId value)
{
    if (!input_ids_.emplace(name, value).second) throw InternalError(fmt::format("'{}' is bound too late", name));
}

std::span<const NodeId> Graph::operands(NodeId id) const
{
    return {operands_.data() + first_[id], static_cast<std::size_t>(first_[id + 1] - first_[id])};
}

const Rational& Graph::value(NodeId id) const
{
    if (!is_constant(id)) throw InternalError("value() of a node that is not a constant");
    return constants_[payloads_[id]];
}

const std::string& Graph::input_name(NodeId id) const
{
    if (ops_[id] != Op::input) throw InternalError("input_name() of a node that is not an input");
    return names_[payloads_[id]];
}

bool Graph::is_zero(NodeId id) const
{
    return is_constant(id) && sgn(constants_[payloads_[id]]) == 0;
}
bool Graph::is_one(NodeId id) const
{
    return is_constant(id) && constants_[payloads_[id]] == 1;
}

NodeId Graph::sum(std::span<const NodeId> terms)
{
    NodeId total = constant(0);
    for (const NodeId term : terms) total = add(total, term);
    return total;
}

NodeId Graph::product(std::span<const NodeId> factors)
{
    NodeId total = constant(1);
    for (const NodeId factor : factors) total = multiply(total, factor);
    return total;
}

std::vector<NodeId> reachable(const Graph& graph, std::span<const NodeId> roots)
{
    if (roots.empty()) return {};
    constexpr std::size_t bits = 64;
    std::vector<std::uint64_t> marked(*std::ranges::max_element(roots) / bits + 1, 0);
    const auto mark = [&](NodeId id) { marked[id / bits] |= std::uint64_t{1} << id % bits; };
    for (const NodeId root : roots) mark(root);
    // Operands have smaller ids, so one downward sweep marks everything; words without marks are passed over at once.
    std::size_t count = 0;
    for (std::size_t word = marked.size(); word-- > 0;)
        for (std::uint64_t open = ~std::uint64_t{0}; (marked[word] & open) != 0;) {
            const auto bit = static_cast<std::size_t>(std::bit_width(marked[word] & open)) - 1;
            open = (std::uint64_t{1} << bit) - 1; // operands of the same word stand below
            ++count;
            for (const NodeId operand : graph.operands(static_cast<NodeId>(word * bits + bit))) mark(operand);
        }
    std::vector<NodeId> result;
    result.reserve(count);
    for (std::size_t word = 0; word < marked.size(); ++word)
        for (std::uint64_t rest = marked[word]; rest != 0; rest &= rest - 1)
            result.push_back(static_cast<NodeId>(word * bits + static_cast<std::size_t>(std::countr_zero(rest))));
    return result;
}

std::vector<NodeId> certainly_needed(const Graph& graph, std::span<const NodeId> roots)
{
    std::vector<bool> certain(graph.size(), false);
    for (const NodeId root : roots) certain[root] = true;
    std::vector<NodeId> result = reachable(graph, roots);
    for (std::size_t k = result.size(); k-- > 0;) {
        if (!certain[result[k]]) continue;
        const auto operands = graph.operands(result[k]);
        for (const NodeId operand : graph.op(result[k]) == Op::select ? operands.first(1) : operands)
            certain[operand] = true;
    }
    std::erase_if(result, [&](NodeId node) { return !certain[node]; });
    return result;
}

std::vector<bool> depends_on(const Graph& graph, std::span<const NodeId> inputs)
{
    std::vector<bool> depends(graph.size(), false);
    for (const NodeId id : inputs) depends[id] = true;
    for (NodeId id = 0; id < graph.size(); ++id)
        for (const NodeId operand : graph.operands(id))
            if (depends[operand]) depends[id] = true;
    return depends;
}

bool depends_on_any(const Graph& graph, std::span<const NodeId> nodes, std::span<const NodeId> inputs)
{
    const std::vector<NodeId> below = reachable(graph, nodes);
    return std::ranges::any_of(inputs, [&](NodeId input) { return std::ranges::binary_search(below, input); });
}

} // namespace lagen
