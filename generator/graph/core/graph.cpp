// SPDX-License-Identifier: GPL-2.0-or-later
/// Leaves, hash-consing and reading of the graph; then arithmetic, functions and linear systems, each with its local
/// rules.
#include "graph/core/graph.hpp"

#include "expression/evaluate_stumpff.hpp"
#include "expression/linear_algebra.hpp"
#include "graph/core/operators.hpp"
#include "graph/core/special_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>

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

// Sums, products, quotients and integer powers, with their local rules. Every rule is exact in floating point too, or
// folds exact constants.
namespace {

/// Constants are folded up to this size; beyond it the operation stays (x = x * x in a loop doubles the digits).
constexpr std::size_t folded_bits = std::size_t{1} << 16U;

bool foldable(const Graph& graph, NodeId a, NodeId b)
{
    return graph.is_constant(a) && graph.is_constant(b) &&
           bits_of(graph.value(a)) + bits_of(graph.value(b)) <= folded_bits;
}

bool is_negative(const Graph& graph, NodeId id)
{
    return graph.is_constant(id) && sgn(graph.value(id)) < 0;
}

} // namespace

NodeId Graph::add(NodeId a, NodeId b)
{
    if (is_zero(a)) return b;
    if (is_zero(b)) return a;
    if (foldable(*this, a, b)) return constant(Rational(value(a) + value(b)));
    if (a == b) return multiply(constant(2), a);
    if (ops_[b] == Op::negate) return subtract(a, operands(b)[0]);
    if (ops_[a] == Op::negate) return subtract(b, operands(a)[0]);
    if (is_negative(*this, b)) return subtract(a, constant(Rational(-value(b))));
    if (is_negative(*this, a)) return subtract(b, constant(Rational(-value(a))));
    const NodeId pair[] = {a, b};
    return intern(Op::add, pair, 0);
}

NodeId Graph::subtract(NodeId a, NodeId b)
{
    if (is_zero(b)) return a;
    if (is_zero(a)) return negate(b);
    if (a == b) return constant(0);
    if (foldable(*this, a, b)) return constant(Rational(value(a) - value(b)));
    if (ops_[b] == Op::negate) return add(a, operands(b)[0]);
    if (ops_[a] == Op::negate) return negate(add(operands(a)[0], b));
    if (is_negative(*this, b)) return add(a, constant(Rational(-value(b))));
    const NodeId pair[] = {a, b};
    return intern(Op::subtract, pair, 0);
}

NodeId Graph::negate(NodeId a)
{
    if (is_constant(a)) return constant(Rational(-value(a)));
    if (ops_[a] == Op::negate) return operands(a)[0];
    if (ops_[a] == Op::subtract) return subtract(operands(a)[1], operands(a)[0]);
    const NodeId only[] = {a};
    return intern(Op::negate, only, 0);
}

NodeId Graph::multiply(NodeId a, NodeId b)
{
    if (is_zero(a) || is_zero(b)) return constant(0);
    if (is_one(a)) return b;
    if (is_one(b)) return a;
    if (foldable(*this, a, b)) return constant(Rational(value(a) * value(b)));
    if (is_constant(b)) std::swap(a, b);
    if (is_negative(*this, a)) return negate(multiply(constant(Rational(-value(a))), b));
    if (ops_[a] == Op::negate) return negate(multiply(operands(a)[0], b));
    if (ops_[b] == Op::negate) return negate(multiply(a, operands(b)[0]));
    if (a == b) return power(a, 2);
    if (is_constant(a) && ops_[b] == Op::multiply)
        for (const std::size_t k : {std::size_t{0}, std::size_t{1}})
            if (const NodeId inner = operands(b)[k]; foldable(*this, a, inner)) {
                const NodeId rest = operands(b)[1 - k];
                return multiply(constant(Rational(value(a) * value(inner))), rest);
            }
    const NodeId pair[] = {a, b};
    return intern(Op::multiply, pair, 0);
}

NodeId Graph::divide(NodeId a, NodeId b)
{
    if (is_zero(b))
        throw DivisionByZero("division by zero: the divisor is the constant 0, a divisor other than 0 is required");
    if (is_zero(a) || is_one(b)) return a;
    if (a == b) return constant(1);
    if (foldable(*this, a, b)) return constant(Rational(value(a) / value(b)));
    if (is_negative(*this, b)) return negate(divide(a, constant(Rational(-value(b)))));
    if (is_negative(*this, a)) return negate(divide(constant(Rational(-value(a))), b));
    if (ops_[a] == Op::negate) return negate(divide(operands(a)[0], b));
    if (ops_[b] == Op::negate) return negate(divide(a, operands(b)[0]));
    // 0/b is 0 where it stands alone, and so it is as a choice.
    if (ops_[a] == Op::select && (is_zero(operands(a)[1]) || is_zero(operands(a)[2]))) {
        const NodeId of[] = {operands(a)[0], operands(a)[1], operands(a)[2]};
        return select(of[0], divide(of[1], b), divide(of[2], b));
    }
    // Both overflow where their quotient does not.
    if (ops_[a] == Op::sinh && ops_[b] == Op::cosh && operands(a)[0] == operands(b)[0])
        return apply(Op::tanh, operands(a)[0]);
    const NodeId pair[] = {a, b};
    return intern(Op::divide, pair, 0);
}

NodeId Graph::power(NodeId a, int exponent)
{
    if (exponent == 0) return constant(1);
    if (exponent == 1) return a;
    if (is_zero(a) && exponent < 0)
        throw DivisionByZero("division by zero: 0^" + std::to_string(exponent) + ", a base other than 0 is required");
    const auto magnitude = static_cast<std::size_t>(exponent < 0 ? -std::int64_t{exponent} : std::int64_t{exponent});
    if (is_zero(a) || is_one(a)) return a;
    if (is_constant(a) && bits_of(value(a)) <= folded_bits / magnitude)
        return constant(*rules::exact_power(value(a), exponent, folded_bits));
    if (ops_[a] == Op::negate) {
        const NodeId positive = power(operands(a)[0], exponent);
        return exponent % 2 == 0 ? positive : negate(positive);
    }
    if (ops_[a] == Op::sqrt && exponent % 2 == 0) return power(operands(a)[0], exponent / 2);
    if (exponent % 2 == 0 && (ops_[a] == Op::divide || ops_[a] == Op::multiply))
        if (const auto square = rules::special_square(*this, a)) return power(constant(*square), exponent / 2);
    if (ops_[a] == Op::power) {
        const std::int64_t product = std::int64_t{exponent} * static_cast<std::int32_t>(payloads_[a]);
        if (product > -INT32_MAX && product < INT32_MAX) return power(operands(a)[0], static_cast<int>(product));
    }
    const NodeId only[] = {a};
    return intern(Op::power, only, static_cast<std::uint32_t>(exponent));
}

// Elementary functions, comparisons and selection, with the exact values at constants that are certain.

namespace {

constexpr std::size_t any_length = std::numeric_limits<std::size_t>::max();

} // namespace

NodeId Graph::apply(Op op, NodeId a)
{
    if (op == Op::negate) return negate(a);
    if (operator_of(op).arity != 1 || operator_of(op).notation != Notation::call || op == Op::stumpff)
        throw InternalError(std::string("apply(op, a) wants a function of one operand, not ") + operator_of(op).name);
    if (is_constant(a))
        if (const auto known = exact_value(op, &value(a), 0, any_length)) return constant(*known);
    if (const auto known = rules::special_value(*this, op, a)) return *known;
    if (op == Op::abs && (ops_[a] == Op::abs || ops_[a] == Op::sqrt)) return a;
    if (op == Op::abs && ops_[a] == Op::negate) return apply(op, operands(a)[0]);
    if (ops_[a] == Op::power && (op == Op::abs || op == Op::sqrt)) {
        // |x^n| = |x|^n, x^n where n is even; sqrt(x^2n) = |x^n|
        const auto n = static_cast<std::int32_t>(payloads_[a]);
        const NodeId base = operands(a)[0];
        if (op == Op::abs) return n % 2 == 0 ? a : power(apply(Op::abs, base), n);
        if (n % 2 == 0) return apply(Op::abs, power(base, n / 2));
    }
    const NodeId only[] = {a};
    return intern(op, only, 0);
}

NodeId Graph::apply(Op op, NodeId a, NodeId b)
{
    if (op == Op::add) return add(a, b);
    if (op == Op::subtract) return subtract(a, b);
    if (op == Op::multiply) return multiply(a, b);
    if (op == Op::divide) return divide(a, b);
    if (operator_of(op).arity != 2)
        throw InternalError(std::string("apply(op, a, b) wants a function of two operands, not ") +
                            operator_of(op).name);
    if (op == Op::real_power && is_constant(b)) {
        // Integer exponents are powers, half-integer ones powers of the root: both defined where a^b is.
        const Rational& exponent = value(b);
        const bool half = exponent.get_den() == 2;
        if ((half || exponent.get_den() == 1) && exponent.get_num().fits_sint_p()) {
            const auto n = static_cast<int>(exponent.get_num().get_si());
            return half ? power(apply(Op::sqrt, a), n) : power(a, n);
        }
    }
    if (op == Op::real_power && is_one(a)) return a;
    if (is_constant(a) && is_constant(b)) {
        const Rational both[] = {value(a), value(b)};
        if (const auto known = exact_value(op, both, 0, any_length)) return constant(*known);
    }
    if (op == Op::atan2)
        if (const auto known = rules::special_angle(*this, a, b)) return *known;
    if ((op == Op::minimum || op == Op::maximum) && a == b) return a;
    const NodeId pair[] = {a, b};
    return intern(op, pair, 0);
}

NodeId Graph::stumpff(unsigned k, NodeId z)
{
    if (k > largest_stumpff_order)
        throw MathematicsError("stumpff(" + std::to_string(k) + ", z) is beyond the order " +
                               std::to_string(largest_stumpff_order) + ", the highest there is");
    if (is_zero(z)) return constant(stumpff_at_zero(k));
    const NodeId only[] = {z};
    return intern(Op::stumpff, only, k);
}

NodeId Graph::select(NodeId condition, NodeId a, NodeId b)
{
    if (a == b) return a;
    if (is_constant(condition)) return is_zero(condition) ? b : a;
    const NodeId operands[] = {condition, a, b};
    return intern(Op::select, operands, 0);
}

NodeId Graph::make(Op op, std::uint32_t payload, std::span<const NodeId> operands)
{
    switch (kind_of(op)) {
    case OpKind::leaf:
    case OpKind::system: break;
    case OpKind::power: return power(operands[0], static_cast<std::int32_t>(payload));
    case OpKind::choice: return select(operands[0], operands[1], operands[2]);
    case OpKind::sum:
    case OpKind::product:
    case OpKind::quotient:
    case OpKind::function:
    case OpKind::comparison:
        if (op == Op::stumpff) return stumpff(payload, operands[0]);
        return operands.size() == 1 ? apply(op, operands[0]) : apply(op, operands[0], operands[1]);
    }
    throw InternalError(std::string("no node is made of ") + operator_of(op).name + " alone");
}

// Linear systems as nodes: split into blocks that do not touch, one factorisation a block.
namespace {

/// One block with everything where some part is not square (the matrix is singular by structure).
std::vector<CoupledBlock> square_blocks(const Graph& graph, std::span<const NodeId> matrix, std::size_t n)
{
    std::vector<CoupledBlock> blocks =
        coupled_blocks(n, [&](std::size_t i, std::size_t j) { return graph.is_zero(matrix[i * n + j]); });
    if (std::ranges::all_of(blocks, [](const CoupledBlock& b) { return b.rows.size() == b.columns.size(); }))
        return blocks;
    CoupledBlock whole;
    whole.rows.resize(n);
    std::iota(whole.rows.begin(), whole.rows.end(), std::size_t{0});
    whole.columns = whole.rows;
    return {whole};
}

} // namespace

std::vector<std::vector<NodeId>>
Graph::solve(std::span<const NodeId> matrix, const std::vector<std::vector<NodeId>>& columns, MatrixStructure structure)
{
    const std::size_t n = columns.empty() ? 0 : columns.front().size();
    for (const auto& column : columns)
        if (column.size() != n || matrix.size() != n * n)
            throw InternalError("solve() wants n*n entries of the matrix and n of every right-hand side");
    std::vector<std::vector<NodeId>> result(columns.size(), std::vector<NodeId>(n, constant(0)));
    const std::vector<NodeId> entries(matrix.begin(), matrix.end());
    for (const CoupledBlock& block : square_blocks(*this, entries, n)) {
        const std::size_t size = block.rows.size();
        if (size == 1) {
            const NodeId divisor = entries[block.rows[0] * n + block.columns[0]];
            for (std::size_t k = 0; k < columns.size(); ++k)
                result[k][block.columns[0]] = divide(columns[k][block.rows[0]], divisor);
            continue;
        }
        std::vector<NodeId> part;
        for (const std::size_t i : block.rows)
            for (const std::size_t j : block.columns) part.push_back(entries[i * n + j]);
        const auto kept = block.rows == block.columns ? structure : MatrixStructure::general;
        const NodeId factor = intern(Op::factor, part, static_cast<std::uint32_t>(kept));
        for (std::size_t k = 0; k < columns.size(); ++k) {
            std::vector<NodeId> operands{factor};
            for (const std::size_t i : block.rows) operands.push_back(columns[k][i]);
            if (std::all_of(operands.begin() + 1, operands.end(), [&](NodeId b) { return is_zero(b); })) continue;
            const NodeId solution[] = {intern(Op::solve, operands, 0)};
            for (std::size_t j = 0; j < size; ++j)
                result[k][block.columns[j]] = intern(Op::component, solution, static_cast<std::uint32_t>(j));
        }
    }
    return result;
}

void Graph::remember_hessian(std::span<const NodeId> matrix, std::span<const NodeId> variables, NodeId value)
{
    const std::size_t n = variables.size();
    if (matrix.size() != n * n) throw InternalError("remember_hessian() wants n*n entries for n variables");
    const std::vector<NodeId> entries(matrix.begin(), matrix.end());
    for (const CoupledBlock& block : square_blocks(*this, entries, n)) {
        if (block.rows.size() < 2 || block.rows != block.columns) continue;
        std::vector<NodeId> part;
        HessianOrigin origin{value, {}};
        for (const std::size_t i : block.rows) {
            origin.variables.push_back(variables[i]);
            for (const std::size_t j : block.columns) part.push_back(entries[i * n + j]);
        }
        const auto structure = static_cast<std::uint32_t>(MatrixStructure::positive_definite);
        hessians_.insert_or_assign(intern(Op::factor, part, structure), std::move(origin));
    }
}

const HessianOrigin* Graph::hessian_origin(NodeId factor) const
{
    const auto found = hessians_.find(factor);
    return found == hessians_.end() ? nullptr : &found->second;
}

std::vector<NodeId> Graph::solve(std::span<const NodeId> matrix, std::span<const NodeId> right,
                                 MatrixStructure structure)
{
    const std::vector<NodeId> column(right.begin(), right.end());
    return solve(matrix, std::vector<std::vector<NodeId>>{column}, structure).front();
}

} // namespace lagen
