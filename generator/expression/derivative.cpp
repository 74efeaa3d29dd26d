// SPDX-License-Identifier: GPL-2.0-or-later
/// The walk over a tree, and functions that are linear as they are written. Closed trees are at most 2000 levels deep,
/// so plain recursion is safe. The rule of each operation and function stands below.
#include "expression/derivative.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

namespace lagen {

namespace {

constexpr std::array derivative_rows{
    DerivativeEntry{Derivative::diff, "diff", 2, "diff(f, q) is the derivative of f by the symbol q"},
    DerivativeEntry{Derivative::grad, "grad", 2, "grad(f, q) is the vector of derivatives of f by the symbols of q"},
    DerivativeEntry{Derivative::jacobian, "jacobian", 2,
                    "jacobian(f, q) has a row for each entry of f and a column for each symbol of q"},
    DerivativeEntry{Derivative::rate, "Dt", 1, "Dt(X) is the rate of X along the motion"},
};

/// Degrees in some symbols of trees that are sums of terms of one degree: 0, 1, or `other`; 0 itself has any.
class HomogeneousDegrees {
  public:
    enum Degree { any = -1, constant = 0, linear = 1, other = 2 };

    explicit HomogeneousDegrees(const std::set<std::string>& symbols) : symbols_(symbols) {}

    Degree of(const Tree& tree)
    {
        return Fold<Degree>()(
            tree, [this](const Tree& part, const std::vector<Degree>& parts) { return of_node(*part, parts); });
    }

  private:
    Degree of_node(const TreeNode& node, const std::vector<Degree>& parts) const
    {
        switch (node.kind) {
        case TreeKind::number: return node.number == 0 ? any : constant;
        case TreeKind::name: return symbols_.contains(node.name) ? linear : constant;
        case TreeKind::negate: return parts[0];
        case TreeKind::divide: return parts[1] == constant ? parts[0] : other;
        case TreeKind::multiply: {
            int degree = 0;
            for (const Degree part : parts) {
                if (part == any) return any;
                degree += part;
            }
            return degree > linear ? other : static_cast<Degree>(degree);
        }
        case TreeKind::add: {
            Degree degree = any;
            for (const Degree part : parts) {
                if (part == any) continue;
                if (degree != any && degree != part) return other;
                degree = part;
            }
            return degree;
        }
        default:
            return std::ranges::all_of(parts, [](Degree part) { return part == any || part == constant; }) ? constant
                                                                                                           : other;
        }
    }

    const std::set<std::string>& symbols_;
};

} // namespace

std::span<const DerivativeEntry> derivative_table()
{
    return derivative_rows;
}

const DerivativeEntry* find_derivative(std::string_view name)
{
    const auto found = std::ranges::find(derivative_rows, name, &DerivativeEntry::name);
    return found == derivative_rows.end() ? nullptr : &*found;
}

std::string rate_name(const std::string& symbol)
{
    return symbol + '\'';
}

bool is_rate_name(std::string_view name)
{
    return name.ends_with('\'');
}

ClosedTree Gradients::measured(const Tree& tree)
{
    return {tree, measures_(tree, [this](const Tree& part, const std::vector<Measure>& sizes) {
                maker_.count();
                return measure(*part, sizes, closing_limits());
            })};
}

const Gradients::Partials& Gradients::of(const Tree& tree)
{
    if (const auto known = partials_.find(tree.get()); known != partials_.end()) return known->second;
    for (const Tree& argument : tree->arguments) (void)of(argument);
    return partials_.emplace(tree.get(), partials_of_node(*tree, measured(tree))).first->second;
}

Gradients::Partials Gradients::partials_of_node(const TreeNode& node, const ClosedTree& value)
{
    Partials result;
    if (node.kind == TreeKind::name && is_wanted_(node)) {
        const auto place = std::ranges::find(symbols_, node.name);
        result.emplace(static_cast<std::size_t>(place - symbols_.begin()), maker_.number(1));
        if (place == symbols_.end()) symbols_.push_back(node.name);
    }
    if (node.kind == TreeKind::compare) return result; // what happens at a jump is not looked at
    std::map<std::size_t, std::vector<ClosedTree>> terms;
    for (const Tree& argument : node.arguments)
        for (const auto& [symbol, partial] : of(argument)) terms[symbol].push_back(partial);
    if (node.kind == TreeKind::add) {
        for (auto& [symbol, parts] : terms) result.emplace(symbol, maker_.add(std::move(parts)));
        return result;
    }
    if (terms.empty()) return result;
    std::vector<ClosedTree> arguments;
    for (const Tree& argument : node.arguments) arguments.push_back(measured(argument));
    for (const auto& term : terms) {
        const std::size_t symbol = term.first;
        std::vector<const ClosedTree*> derivatives;
        for (const Tree& argument : node.arguments) {
            const Partials& partials = of(argument);
            const auto found = partials.find(symbol);
            derivatives.push_back(found == partials.end() ? nullptr : &found->second);
        }
        ClosedTree partial = chain_rule(maker_, value, arguments, derivatives);
        if (!is_number(partial, 0)) result.emplace(symbol, std::move(partial));
    }
    return result;
}

std::optional<std::vector<Tree>> linear_coefficients(const Tree& tree, const std::vector<std::string>& symbols)
{
    const std::set<std::string> wanted(symbols.begin(), symbols.end());
    const HomogeneousDegrees::Degree degree = HomogeneousDegrees(wanted).of(tree);
    if (degree != HomogeneousDegrees::linear && degree != HomogeneousDegrees::any) return std::nullopt;
    Budget budget{0, "the expression is longer than {} operations when its sums and arrays are written out", ""};
    TreeIdentity identity;
    SignedIdentity signed_identity(identity);
    const Maker maker(budget, signed_identity, tree->where);
    Gradients gradients(maker, [&](const TreeNode& name) { return wanted.contains(name.name); });
    const Gradients::Partials& partials = gradients.of(tree);
    std::vector<Tree> out(symbols.size());
    for (std::size_t k = 0; k < symbols.size(); ++k) {
        const auto place = std::ranges::find(gradients.symbols(), symbols[k]);
        const auto partial = partials.find(static_cast<std::size_t>(place - gradients.symbols().begin()));
        if (partial != partials.end()) out[k] = partial->second.tree;
    }
    return out;
}

// The rule of each operation and function.

namespace {

using Arguments = std::span<const ClosedTree>;
using Derivatives = std::span<const ClosedTree* const>;

/// The makers of one node's derivative.
struct Rules {
    const Maker& make;
    const ClosedTree& node;
    Arguments a;
    Derivatives d;

    [[nodiscard]] ClosedTree or_zero(std::size_t k) const { return d[k] != nullptr ? *d[k] : make.number(0); }
    [[nodiscard]] ClosedTree one_plus(ClosedTree x) const { return make.add({make.number(1), std::move(x)}); }
    /// 1 - x^2
    [[nodiscard]] ClosedTree complement(const ClosedTree& x) const
    {
        return make.subtract(make.number(1), make.square(x));
    }
    [[nodiscard]] ClosedTree compare(Comparison comparison) const
    {
        return make.operation(lagen::compare(comparison, a[0].tree, a[1].tree), {a[0], a[1]});
    }
    [[nodiscard]] ClosedTree select(ClosedTree condition, ClosedTree yes, ClosedTree no) const
    {
        return make.call(Function::select, {std::move(condition), std::move(yes), std::move(no)});
    }

    [[nodiscard]] ClosedTree product() const
    {
        std::vector<ClosedTree> terms;
        for (std::size_t k = 0; k < a.size(); ++k) {
            if (d[k] == nullptr) continue;
            std::vector<ClosedTree> factors(a.begin(), a.end());
            factors[k] = *d[k];
            terms.push_back(make.multiply(std::move(factors)));
        }
        return make.add(std::move(terms));
    }

    /// (da - (a/b) db)/b
    [[nodiscard]] ClosedTree quotient() const
    {
        if (d[1] == nullptr) return make.divide(*d[0], a[1]);
        return make.divide(make.subtract(or_zero(0), make.multiply({node, *d[1]})), a[1]);
    }

    /// n a^(n-1)
    [[nodiscard]] ClosedTree slope_of_power() const
    {
        if (!a[1].measure.constant)
            return make.multiply({a[1], make.join(TreeKind::power, {a[0], make.add({a[1], make.number(-1)})})});
        const Rational n = a[1].measure.factor;
        if (n == 0 || n == 1) return make.number(n);
        if (n == 2) return make.multiply({make.number(2), a[0]});
        return make.multiply({make.number(n), make.join(TreeKind::power, {a[0], make.number(n - 1)})});
    }
    [[nodiscard]] ClosedTree power() const
    {
        std::vector<ClosedTree> terms;
        if (d[0] != nullptr) terms.push_back(make.multiply({slope_of_power(), *d[0]}));
        if (d[1] != nullptr) terms.push_back(make.multiply({node, make.call(Function::log, {a[0]}), *d[1]}));
        return make.add(std::move(terms));
    }

    /// (x dy - y dx)/(x^2 + y^2) of atan2(y, x).
    [[nodiscard]] ClosedTree angle() const
    {
        const ClosedTree above = make.subtract(make.multiply({a[1], or_zero(0)}), make.multiply({a[0], or_zero(1)}));
        return make.divide(above, make.add({make.square(a[1]), make.square(a[0])}));
    }

    /// c_k' = (k c_{k+2} - c_{k+1})/2
    [[nodiscard]] ClosedTree slope_of_stumpff() const
    {
        constexpr long largest = 30;
        const long k = a[0].tree->number.get_num().get_si();
        if (k > largest)
            make.fail(fmt::format("the derivative of stumpff({}, z) is taken", k),
                      fmt::format("derivatives of stumpff(k, z) are known for k up to {}", largest));
        const auto c = [&](long order) { return make.call(Function::stumpff, {make.number(order), a[1]}); };
        const ClosedTree above = make.subtract(make.multiply({make.number(k), c(k + 2)}), c(k + 1));
        return make.divide(above, make.number(2));
    }

    /// 2/sqrt(pi) exp(-u^2)
    [[nodiscard]] ClosedTree slope_of_erf() const
    {
        const Tree pi = constant_pi(make.where());
        const ClosedTree root = make.call(Function::sqrt, {{pi, measure(*pi, {}, closing_limits())}});
        const ClosedTree bell = make.call(Function::exp, {make.negate(make.square(a[0]))});
        return make.multiply({make.divide(make.number(2), root), bell});
    }

    /// The derivative of a function of one argument by it.
    [[nodiscard]] ClosedTree slope() const
    {
        const ClosedTree& u = a[0];
        const ClosedTree one = make.number(1);
        const auto call = [&](Function function) { return make.call(function, {u}); };
        const auto root = [&](ClosedTree x) { return make.call(Function::sqrt, {std::move(x)}); };
        switch (node.tree->function) {
        case Function::sin: return call(Function::cos);
        case Function::cos: return make.negate(call(Function::sin));
        case Function::tan: return one_plus(make.square(node));
        case Function::asin: return make.divide(one, root(complement(u)));
        case Function::acos: return make.negate(make.divide(one, root(complement(u))));
        case Function::atan: return make.divide(one, one_plus(make.square(u)));
        case Function::sinh: return call(Function::cosh);
        case Function::cosh: return call(Function::sinh);
        case Function::tanh: return complement(node);
        case Function::exp: return node;
        case Function::log: return make.divide(one, u);
        case Function::sqrt: return make.divide(one, make.multiply({make.number(2), node}));
        case Function::abs: return make.divide(u, node);
        case Function::erf: return slope_of_erf();
        default: throw InternalError("the derivative of a function that has none");
        }
    }

    [[nodiscard]] ClosedTree call() const
    {
        switch (node.tree->function) {
        case Function::atan2: return angle();
        case Function::stumpff: return make.multiply({slope_of_stumpff(), *d[1]});
        case Function::minimum: return select(compare(Comparison::less_equal), or_zero(0), or_zero(1));
        case Function::maximum: return select(compare(Comparison::greater_equal), or_zero(0), or_zero(1));
        case Function::sign: return make.number(0);
        case Function::select: return select(a[0], or_zero(1), or_zero(2));
        default: return make.multiply({slope(), *d[0]});
        }
    }

    /// A z = b: A dz = db - dA z.
    [[nodiscard]] ClosedTree solution() const
    {
        const std::size_t m = solve_order(a.size());
        const std::vector<ClosedTree> matrix(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(m * m));
        const std::vector<ClosedTree> right(a.begin() + static_cast<std::ptrdiff_t>(m * m), a.end());
        const std::size_t wanted = node.tree->number.get_num().get_ui();
        std::vector<ClosedTree> z(m);
        std::vector<ClosedTree> changed;
        for (std::size_t i = 0; i < m; ++i) {
            std::vector<ClosedTree> terms{or_zero(m * m + i)};
            for (std::size_t j = 0; j < m; ++j) {
                const ClosedTree* entry = d[i * m + j];
                if (entry == nullptr) continue;
                if (!z[j].tree) z[j] = j == wanted ? node : make.solve(matrix, right, j);
                terms.push_back(make.negate(make.multiply({*entry, z[j]})));
            }
            changed.push_back(make.add(std::move(terms)));
        }
        return make.solve(matrix, changed, wanted);
    }
};

} // namespace

ClosedTree chain_rule(const Maker& maker, const ClosedTree& node, std::span<const ClosedTree> arguments,
                      std::span<const ClosedTree* const> derivatives)
{
    const Rules rules{maker, node, arguments, derivatives};
    switch (node.tree->kind) {
    case TreeKind::negate: return maker.negate(*derivatives[0]);
    case TreeKind::multiply: return rules.product();
    case TreeKind::divide: return rules.quotient();
    case TreeKind::power: return rules.power();
    case TreeKind::call: return rules.call();
    case TreeKind::solve: return rules.solution();
    default: throw InternalError("the derivative of a tree that is not closed");
    }
}

} // namespace lagen
