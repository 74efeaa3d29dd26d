// SPDX-License-Identifier: GPL-2.0-or-later
#include "closing.hpp"

#include "parsing.hpp"

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include <cmath>
#include <set>

namespace lagen::test {

Definition definition(const std::string& name, const std::string& body, std::vector<std::string> parameters)
{
    const Excerpt text = whole_text(name, body);
    return {name, std::move(parameters), parse_expression(text), text.range(0, body.size())};
}

Scope array_scope(long n)
{
    Scope scope;
    scope.declare_size("n", n, {});
    for (const char* symbol : {"a", "b", "c", "s"}) scope.declare(symbol, {});
    for (const char* vector : {"u", "v", "w"}) scope.declare_family(vector, {Rank::vector, 3, 1}, {});
    scope.declare_family("p", {Rank::vector, 2, 1}, {});
    for (const char* matrix : {"A", "B"}) scope.declare_family(matrix, {Rank::matrix, 3, 3}, {});
    scope.declare_family("M", {Rank::matrix, 2, 2}, {});
    scope.declare_family("R", {Rank::matrix, 2, 3}, {});
    scope.declare_family("x", {Rank::vector, static_cast<std::size_t>(n), 1}, {});
    return scope;
}

namespace {

std::string text_of(const ArrayValue& value)
{
    if (value.shape.rank == Rank::scalar) return to_text(value.entries[0]);
    std::string text = "[";
    for (std::size_t k = 0; k < value.entries.size(); ++k) {
        const bool row = value.shape.rank == Rank::matrix && k % value.shape.columns == 0;
        if (k > 0) text += row ? "], " : ", ";
        if (row) text += "[";
        text += to_text(value.entries[k]);
    }
    return text + (value.shape.rank == Rank::matrix ? "]]" : "]");
}

/// c_k(z) by its series: accurate for the small z of the tests.
double stumpff(double k, double z)
{
    double term = 1 / std::tgamma(k + 1);
    double sum = 0;
    for (int j = 0; j < 40; ++j) {
        sum += term;
        term *= -z / ((2 * j + k + 1) * (2 * j + k + 2));
    }
    return sum;
}

double call_value(Function function, const std::vector<double>& a)
{
    switch (function) {
    case Function::sin: return std::sin(a[0]);
    case Function::cos: return std::cos(a[0]);
    case Function::tan: return std::tan(a[0]);
    case Function::asin: return std::asin(a[0]);
    case Function::acos: return std::acos(a[0]);
    case Function::atan: return std::atan(a[0]);
    case Function::atan2: return std::atan2(a[0], a[1]);
    case Function::sinh: return std::sinh(a[0]);
    case Function::cosh: return std::cosh(a[0]);
    case Function::tanh: return std::tanh(a[0]);
    case Function::exp: return std::exp(a[0]);
    case Function::log: return std::log(a[0]);
    case Function::sqrt: return std::sqrt(a[0]);
    case Function::abs: return std::abs(a[0]);
    case Function::minimum: return std::min(a[0], a[1]);
    case Function::maximum: return std::max(a[0], a[1]);
    case Function::sign: return a[0] < 0 ? -1 : a[0] > 0 ? 1 : 0;
    case Function::select: return a[0] != 0 ? a[1] : a[2];
    case Function::erf: return std::erf(a[0]);
    case Function::stumpff: return stumpff(a[0], a[1]);
    default: FAIL("no value for " << entry_of(function).name);
    }
    return 0;
}

double truth_of(Comparison comparison, double a, double b)
{
    switch (comparison) {
    case Comparison::less: return a < b ? 1 : 0;
    case Comparison::less_equal: return a <= b ? 1 : 0;
    case Comparison::greater: return a > b ? 1 : 0;
    case Comparison::greater_equal: return a >= b ? 1 : 0;
    case Comparison::equal: return a == b ? 1 : 0;
    case Comparison::not_equal: return a != b ? 1 : 0;
    }
    return 0;
}

double solve_value(const TreeNode& node, const std::vector<double>& a)
{
    const auto m = static_cast<Eigen::Index>(std::floor(std::sqrt(static_cast<double>(a.size()))));
    REQUIRE(static_cast<std::size_t>(m * m + m) == a.size());
    Eigen::MatrixXd matrix(m, m);
    Eigen::VectorXd right(m);
    for (Eigen::Index i = 0; i < m; ++i) {
        for (Eigen::Index j = 0; j < m; ++j) matrix(i, j) = a[static_cast<std::size_t>(i * m + j)];
        right(i) = a[static_cast<std::size_t>(m * m + i)];
    }
    return matrix.fullPivLu().solve(right)(node.number.get_num().get_si());
}

} // namespace

std::string closed_text(const Scope& scope, const std::string& text)
{
    try {
        return text_of(scope.close_array(parse(text)));
    } catch (const ModelError& error) {
        return error.what();
    }
}

std::string closing_error(const Scope& scope, const std::string& text)
{
    try {
        return text_of(scope.close_array(parse(text)));
    } catch (const ModelError& error) {
        return error.diagnostic().message;
    }
}

TreeSize size_of(const Tree& tree)
{
    TreeSize size;
    std::set<const TreeNode*> visited;
    std::vector<const TreeNode*> pending{tree.get()};
    while (!pending.empty()) {
        const TreeNode* node = pending.back();
        pending.pop_back();
        if (!visited.insert(node).second) continue;
        ++size.nodes;
        size.arguments += node->arguments.size();
        for (const Tree& argument : node->arguments) pending.push_back(argument.get());
    }
    return size;
}

double value_at(const Tree& tree, const Point& point)
{
    std::vector<double> a;
    for (const Tree& argument : tree->arguments) a.push_back(value_at(argument, point));
    double result = 0;
    switch (tree->kind) {
    case TreeKind::number: return tree->number.get_d();
    case TreeKind::name: return point.at(tree->name);
    case TreeKind::negate: return -a[0];
    case TreeKind::add:
        for (const double term : a) result += term;
        return result;
    case TreeKind::multiply:
        result = 1;
        for (const double factor : a) result *= factor;
        return result;
    case TreeKind::divide: return a[0] / a[1];
    case TreeKind::power: return std::pow(a[0], a[1]);
    case TreeKind::pi: return std::acos(-1.0);
    case TreeKind::compare: return truth_of(tree->comparison, a[0], a[1]);
    case TreeKind::call: return call_value(tree->function, a);
    case TreeKind::solve: return solve_value(*tree, a);
    default: FAIL("not closed: " << to_text(tree));
    }
    return result;
}

} // namespace lagen::test
