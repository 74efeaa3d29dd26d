// SPDX-License-Identifier: GPL-2.0-or-later
/// Trees to GiNaC, each shared sub-tree once.
#include "expression/fold.hpp"
#include "symbolic/ginac_door.hpp"
#include "symbolic/ginac_ring.hpp"

#include <algorithm>

namespace lagen {

GiNaC::realsymbol SymbolTable::symbol(const std::string& name)
{
    const auto known = symbols_.find(name);
    if (known != symbols_.end()) return known->second;
    const GiNaC::realsymbol fresh(name);
    names_.emplace(fresh, name);
    symbols_.emplace(name, fresh);
    return fresh;
}

const std::string& SymbolTable::name_of(const GiNaC::symbol& symbol) const
{
    const auto known = names_.find(symbol);
    if (known == names_.end()) throw InternalError("a symbol came back from GiNaC that was never sent there");
    return known->second;
}

namespace {

// Functions that GiNaC does not have.

GiNaC::ex erf_at_zero(const GiNaC::ex& x);
GiNaC::ex bell(const GiNaC::ex& x, unsigned argument);
GiNaC::ex stumpff_at_zero(const GiNaC::ex& k, const GiNaC::ex& z);
GiNaC::ex stumpff_slope(const GiNaC::ex& k, const GiNaC::ex& z, unsigned argument);

/// erf(x): erf(0) = 0, erf' = 2/sqrt(pi) exp(-x^2).
DECLARE_FUNCTION_1P(erf)
REGISTER_FUNCTION(erf, eval_func(erf_at_zero).derivative_func(bell))

/// stumpff(k, z): c_k(0) = 1/k!, c_k' = (k c_{k+2} - c_{k+1})/2; k is a number.
DECLARE_FUNCTION_2P(stumpff)
REGISTER_FUNCTION(stumpff, eval_func(stumpff_at_zero).derivative_func(stumpff_slope))

GiNaC::ex erf_at_zero(const GiNaC::ex& x)
{
    return x.is_zero() ? GiNaC::ex(0) : erf(x).hold();
}

GiNaC::ex bell(const GiNaC::ex& x, unsigned)
{
    return 2 / GiNaC::sqrt(GiNaC::Pi) * GiNaC::exp(-GiNaC::pow(x, 2));
}

GiNaC::ex stumpff_at_zero(const GiNaC::ex& k, const GiNaC::ex& z)
{
    if (z.is_zero()) return 1 / GiNaC::factorial(GiNaC::ex_to<GiNaC::numeric>(k));
    return stumpff(k, z).hold();
}

GiNaC::ex stumpff_slope(const GiNaC::ex& k, const GiNaC::ex& z, unsigned argument)
{
    if (argument != 1) throw InternalError("the order of a Stumpff function is no variable");
    return (k * stumpff(k + 2, z) - stumpff(k + 1, z)) / 2;
}

GiNaC::numeric to_numeric(const Rational& value)
{
    const GiNaC::numeric numerator(value.get_num().get_str().c_str());
    const GiNaC::numeric denominator(value.get_den().get_str().c_str());
    return numerator / denominator;
}

GiNaC::ex apply_function(const TreeNode& node, const std::vector<GiNaC::ex>& a)
{
    switch (node.function) {
    case Function::sin: return GiNaC::sin(a[0]);
    case Function::cos: return GiNaC::cos(a[0]);
    case Function::tan: return GiNaC::tan(a[0]);
    case Function::asin: return GiNaC::asin(a[0]);
    case Function::acos: return GiNaC::acos(a[0]);
    case Function::atan: return GiNaC::atan(a[0]);
    case Function::atan2: return GiNaC::atan2(a[0], a[1]);
    case Function::sinh: return GiNaC::sinh(a[0]);
    case Function::cosh: return GiNaC::cosh(a[0]);
    case Function::tanh: return GiNaC::tanh(a[0]);
    case Function::exp: return GiNaC::exp(a[0]);
    case Function::log: return GiNaC::log(a[0]);
    case Function::sqrt: return GiNaC::sqrt(a[0]);
    case Function::abs: return GiNaC::abs(a[0]);
    case Function::stumpff: return stumpff(a[0], a[1]);
    case Function::erf: return erf(a[0]);
    case Function::minimum:
    case Function::maximum:
    case Function::sign:
    case Function::select: break;
    case Function::dot:
    case Function::cross:
    case Function::norm:
    case Function::trace:
    case Function::transpose:
    case Function::det:
    case Function::inverse:
    case Function::diag:
    case Function::identity:
    case Function::hat:
    case Function::vee:
    case Function::cay: throw InternalError("a function of vectors went to GiNaC");
    }
    throw MathematicsError(std::string("the function ") + entry_of(node.function).name +
                           " is not smooth, so that nothing is derived from it symbolically");
}

/// Component k of A^-1 b by Cramer's rule: `a` holds the n*n entries of A by rows, then b.
GiNaC::ex solve_explicitly(const std::vector<GiNaC::ex>& a, std::size_t k)
{
    constexpr std::size_t largest_order = 4;
    const std::size_t n = solve_order(a.size());
    if (n > largest_order)
        throw MathematicsError("the solution of " + std::to_string(n) +
                               " coupled linear equations is not written out: a formula that a person could read "
                               "exists up to " +
                               std::to_string(largest_order));
    const std::vector<GiNaC::ex> matrix(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(n * n));
    const GiNaC::ex whole = determinant(GinacRing{matrix, n}, n);
    if (whole.is_zero()) throw MathematicsError("the matrix of a linear system has no inverse: its determinant is 0");
    const std::vector<GiNaC::ex> b(a.end() - static_cast<std::ptrdiff_t>(n), a.end());
    return numerator(GinacRing{matrix, n}, k, b) / whole;
}

class ToGinac {
  public:
    explicit ToGinac(SymbolTable& symbols) : symbols_(symbols) {}

    GiNaC::ex operator()(const Tree& tree)
    {
        return done_(tree, [this](const Tree& part,
                                  const std::vector<Done>& arguments) { return finished(*part, arguments); })
            .value;
    }

  private:
    struct Done {
        GiNaC::ex value;
        std::size_t size; ///< nodes when written out, saturated
    };

    Done finished(const TreeNode& node, const std::vector<Done>& arguments)
    {
        GiNaC::exvector values;
        std::size_t size = 1;
        for (const Done& done : arguments) {
            values.push_back(done.value);
            size = std::min(size + done.size, symbolic_size_limit + 1);
        }
        if (size > symbolic_size_limit)
            throw MathematicsError(
                "the expression has more than " + std::to_string(symbolic_size_limit) +
                " terms and factors when it is written out, too many for a formula that a person could read");
        return {value_of(node, values), size};
    }

    GiNaC::ex value_of(const TreeNode& node, const std::vector<GiNaC::ex>& a)
    {
        switch (node.kind) {
        case TreeKind::number: return to_numeric(node.number);
        case TreeKind::pi: return GiNaC::Pi;
        case TreeKind::name: return symbols_.symbol(node.name);
        case TreeKind::negate: return -a[0];
        case TreeKind::add: return GiNaC::ex(GiNaC::dynallocate<GiNaC::add>(a));
        case TreeKind::multiply: return GiNaC::ex(GiNaC::dynallocate<GiNaC::mul>(a));
        case TreeKind::divide:
            if (a[1].is_zero())
                throw MathematicsError("division by " + to_text(node.arguments[1]) + ", which is zero everywhere");
            return a[0] / a[1];
        case TreeKind::power: return GiNaC::pow(a[0], a[1]);
        case TreeKind::call: return apply_function(node, a);
        case TreeKind::solve: return solve_explicitly(a, node.number.get_num().get_ui());
        default: break;
        }
        throw MathematicsError("a comparison or a function of the model stands where a smooth expression is needed");
    }

    SymbolTable& symbols_;
    Fold<Done> done_;
};

} // namespace

GiNaC::ex to_ginac(const Tree& tree, SymbolTable& symbols)
{
    return with_ginac("an expression has no value", [&] { return ToGinac(symbols)(tree); });
}

} // namespace lagen
