// SPDX-License-Identifier: GPL-2.0-or-later
/// Making closed nodes, with the zeros and ones of arrays folded.
#include "expression/closed.hpp"

#include "expression/special_angles.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

namespace {

constexpr std::size_t most_operations = 1'000'000;

/// The count of an operation of so many arguments: a sum of n terms is n - 1 additions.
std::size_t cost(std::size_t arguments)
{
    return arguments > 2 ? arguments - 1 : 1;
}

} // namespace

const ParseLimits& closing_limits()
{
    static const ParseLimits limits{.product_degree = ParseLimits{}.degree, .height = deepest_closed};
    return limits;
}

Value scalar(ClosedTree tree)
{
    auto value = std::make_shared<Closed>();
    value->entries.push_back(std::move(tree));
    return value;
}

std::optional<long> integer_of(const Closed& value)
{
    if (value.shape.rank != Rank::scalar || !value.entries[0].measure.constant) return std::nullopt;
    const Rational& number = value.entries[0].measure.factor;
    if (number.get_den() != 1 || !number.get_num().fits_slong_p()) return std::nullopt;
    return number.get_num().get_si();
}

void Budget::spend(std::size_t operations, const SourceRange& where)
{
    spent += operations;
    if (spent > most_operations) throw ModelError(fmt::format(fmt::runtime(message), most_operations), where, hint);
}

ClosedTree Maker::operation(const Tree& tree, std::vector<ClosedTree> arguments) const
{
    if (tree->kind == TreeKind::call)
        if (!arguments.empty())
            if (const auto value = value_at_turn(tree->function, arguments[0].tree)) return number(*value);
    std::vector<Measure> measures;
    measures.reserve(arguments.size());
    bool changed = false;
    for (std::size_t k = 0; k < arguments.size(); ++k) {
        changed = changed || arguments[k].tree != tree->arguments[k];
        measures.push_back(std::move(arguments[k].measure));
    }
    if (!changed) return {tree, measure(*tree, measures, closing_limits())};
    auto copy = std::make_shared<TreeNode>(*tree);
    for (std::size_t k = 0; k < arguments.size(); ++k) copy->arguments[k] = std::move(arguments[k].tree);
    Measure size = measure(*copy, measures, closing_limits());
    return {std::move(copy), std::move(size)};
}

ClosedTree Maker::make(TreeNode node, std::vector<ClosedTree> arguments) const
{
    budget_.spend(cost(arguments.size()), where_);
    auto tree = std::make_shared<TreeNode>(std::move(node));
    tree->where = where_;
    std::vector<Measure> measures;
    measures.reserve(arguments.size());
    tree->arguments.reserve(arguments.size());
    for (ClosedTree& argument : arguments) {
        tree->arguments.push_back(std::move(argument.tree));
        measures.push_back(std::move(argument.measure));
    }
    Measure size = measure(*tree, measures, closing_limits());
    return {std::move(tree), std::move(size)};
}

ClosedTree Maker::make(TreeKind kind, std::vector<ClosedTree> arguments) const
{
    TreeNode node;
    node.kind = kind;
    return make(std::move(node), std::move(arguments));
}

ClosedTree Maker::number(const Rational& value) const
{
    const Tree tree = lagen::number(value, where_);
    return {tree, measure(*tree, {}, closing_limits())};
}

ClosedTree Maker::negate(const ClosedTree& a) const
{
    if (a.tree->kind == TreeKind::number) return number(-a.tree->number);
    if (a.tree->kind == TreeKind::negate) {
        Measure inner = a.measure; // one operation less, and the sign of the factor turned back
        inner.factor = -inner.factor;
        return {a.tree->arguments[0], std::move(inner)};
    }
    return make(TreeKind::negate, {a});
}

ClosedTree Maker::add(std::vector<ClosedTree> terms) const
{
    std::erase_if(terms, [](const ClosedTree& term) { return is_number(term, 0); });
    if (terms.size() < 2) count(); // what is folded is work as well
    if (terms.empty()) return number(0);
    if (terms.size() == 1) return std::move(terms[0]);
    return make(TreeKind::add, std::move(terms));
}

ClosedTree Maker::multiply(std::vector<ClosedTree> factors) const
{
    bool negative = false;
    const auto is_negative = [](const Tree& tree) {
        return tree->kind == TreeKind::negate || (tree->kind == TreeKind::number && tree->number < 0);
    };
    for (ClosedTree& factor : factors)
        for (; is_negative(factor.tree); negative = !negative) factor = negate(factor);
    for (const ClosedTree& factor : factors)
        if (is_number(factor, 0)) {
            count();
            return number(0);
        }
    std::erase_if(factors, [](const ClosedTree& factor) { return is_number(factor, 1); });
    if (factors.size() < 2) count();
    ClosedTree product = factors.empty()       ? number(1)
                         : factors.size() == 1 ? std::move(factors[0])
                                               : make(TreeKind::multiply, std::move(factors));
    return negative ? negate(product) : product;
}

ClosedTree Maker::divide(const ClosedTree& a, const ClosedTree& b) const
{
    if (is_number(b, 1)) return a;
    if (a.tree->kind == TreeKind::negate) return negate(divide({a.tree->arguments[0], negate(a).measure}, b));
    if (is_number(a, 0) && !(b.measure.constant && b.measure.factor == 0)) return a;
    return make(TreeKind::divide, {a, b});
}

ClosedTree Maker::square(const ClosedTree& a) const
{
    const ClosedTree base = a.tree->kind == TreeKind::negate ? negate(a) : a;
    if (base.tree->kind == TreeKind::number) return number(base.tree->number * base.tree->number);
    return make(TreeKind::power, {base, number(2)});
}

ClosedTree Maker::call(Function function, std::vector<ClosedTree> arguments) const
{
    TreeNode node;
    node.kind = TreeKind::call;
    node.function = function;
    return make(std::move(node), std::move(arguments));
}

ClosedTree Maker::solve(std::vector<ClosedTree> matrix, const std::vector<ClosedTree>& right, std::size_t k) const
{
    TreeNode node;
    node.kind = TreeKind::solve;
    node.number = Rational(static_cast<unsigned long>(k));
    matrix.insert(matrix.end(), right.begin(), right.end());
    return make(std::move(node), std::move(matrix));
}

const ClosedTree& Maker::entry(Closed& value, std::size_t k) const
{
    if (value.family.empty()) return entries(value)[k];
    if (value.entries.empty()) value.entries.resize(value.shape.size());
    ClosedTree& slot = value.entries[k];
    if (!slot.tree) {
        const Tree tree = name(entry_name(value.family, value.shape, k), where_);
        slot = {tree, measure(*tree, {}, closing_limits())};
    }
    return slot;
}

const std::vector<ClosedTree>& Maker::entries(Closed& value) const
{
    if (!value.family.empty())
        for (std::size_t k = 0; k < value.shape.size(); ++k) (void)entry(value, k);
    if (!value.inverse_of || !value.entries.empty()) return value.entries;
    // Column j of the inverse solves A z = e_j.
    const std::size_t m = value.shape.rows;
    const std::vector<ClosedTree>& matrix = entries(*value.inverse_of);
    if (m == 1) {
        value.entries.push_back(divide(number(1), matrix[0]));
        return value.entries;
    }
    std::vector<ClosedTree> inverse(m * m);
    for (std::size_t column = 0; column < m; ++column) {
        std::vector<ClosedTree> unit(m, number(0));
        unit[column] = number(1);
        for (std::size_t row = 0; row < m; ++row) inverse[row * m + column] = solve(matrix, unit, row);
    }
    value.entries = std::move(inverse);
    return value.entries;
}

void Maker::fail(const std::string& message, const std::string& hint) const
{
    throw ModelError(message, where_, hint);
}

void require_size(const Maker& maker, const Shape& shape)
{
    if (is_too_large(shape))
        maker.fail(fmt::format("{} is too large", to_text(shape)),
                   fmt::format("a vector or matrix has at most {} entries", most_array_entries));
}

Value array_value(const Maker& maker, const Shape& shape, std::vector<ClosedTree> entries)
{
    require_size(maker, shape);
    maker.count(shape.size());
    auto value = std::make_shared<Closed>();
    value->shape = shape;
    value->entries = std::move(entries);
    return value;
}

Shape vector_shape(std::size_t n)
{
    return {Rank::vector, n, 1};
}

Shape matrix_shape(std::size_t rows, std::size_t columns)
{
    return {Rank::matrix, rows, columns};
}

bool is_number(const ClosedTree& entry, long value)
{
    return entry.tree->kind == TreeKind::number && entry.tree->number == value;
}

} // namespace lagen
