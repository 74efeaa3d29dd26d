// SPDX-License-Identifier: GPL-2.0-or-later
/// The functions of vectors and matrices; hat, vee, exp and cay are smooth at zero.
#include "expression/combine.hpp"

#include "expression/closed.hpp"
#include "expression/fold.hpp"
#include "expression/linear_algebra.hpp"
#include "expression/special_angles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace lagen {

namespace {

constexpr std::size_t largest_determinant = 8;

[[noreturn]] void refuse_argument(const Tree& tree, std::size_t k, const Shape& shape, const char* wanted)
{
    const char* function = entry_of(tree->function).name;
    refuse(tree->arguments[k], fmt::format("an argument of {} is {}", function, to_text(shape)),
           fmt::format("{} takes {}", function, wanted));
}

void require_square(const Tree& tree, const Shape& shape)
{
    if (shape.rank != Rank::matrix || shape.rows != shape.columns) refuse_argument(tree, 0, shape, "a square matrix");
}

ClosedTree product_of(const Maker& maker, const ClosedTree& a, const ClosedTree& b)
{
    return a.tree == b.tree ? maker.square(a) : maker.multiply({a, b});
}

ClosedTree dot_entries(const Maker& maker, const Value& a, const Value& b)
{
    std::vector<ClosedTree> terms;
    for (std::size_t k = 0; k < a->shape.rows; ++k)
        terms.push_back(product_of(maker, maker.entry(*a, k), maker.entry(*b, k)));
    return maker.add(std::move(terms));
}

Value dot(const Maker& maker, const Tree& tree, std::span<const Value> arguments)
{
    for (std::size_t k = 0; k < 2; ++k)
        if (arguments[k]->shape.rank != Rank::vector) refuse_argument(tree, k, arguments[k]->shape, "two vectors");
    if (arguments[0]->shape != arguments[1]->shape)
        refuse(tree,
               fmt::format("dot is taken of {} and {}", to_text(arguments[0]->shape), to_text(arguments[1]->shape)),
               "the two vectors have the same length");
    return scalar(dot_entries(maker, arguments[0], arguments[1]));
}

Value cross(const Maker& maker, const Tree& tree, std::span<const Value> arguments)
{
    for (std::size_t k = 0; k < 2; ++k)
        if (arguments[k]->shape != vector_shape(3)) refuse_argument(tree, k, arguments[k]->shape, "two vectors of 3");
    const std::vector<ClosedTree>& a = maker.entries(*arguments[0]);
    const std::vector<ClosedTree>& b = maker.entries(*arguments[1]);
    std::vector<ClosedTree> entries;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3;
        const std::size_t j = (k + 2) % 3;
        entries.push_back(maker.subtract(maker.multiply({a[i], b[j]}), maker.multiply({a[j], b[i]})));
    }
    return array_value(maker, vector_shape(3), std::move(entries));
}

Value norm(const Maker& maker, const Tree& tree, const Value& v)
{
    if (v->shape.rank != Rank::vector) refuse_argument(tree, 0, v->shape, "a vector");
    return scalar(maker.call(Function::sqrt, {dot_entries(maker, v, v)}));
}

Value trace(const Maker& maker, const Tree& tree, const Value& a)
{
    require_square(tree, a->shape);
    std::vector<ClosedTree> terms;
    for (std::size_t k = 0; k < a->shape.rows; ++k) terms.push_back(maker.entry(*a, k * a->shape.columns + k));
    return scalar(maker.add(std::move(terms)));
}

Value transpose_entries(const Maker& maker, const Value& a)
{
    const std::size_t rows = a->shape.rows;
    const std::size_t columns = a->shape.columns;
    const std::vector<ClosedTree>& entries = maker.entries(*a);
    std::vector<ClosedTree> result;
    for (std::size_t j = 0; j < columns; ++j)
        for (std::size_t i = 0; i < rows; ++i) result.push_back(entries[i * columns + j]);
    return array_value(maker, matrix_shape(columns, rows), std::move(result));
}

Value transpose(const Maker& maker, const Tree& tree, const Value& a)
{
    if (a->shape.rank == Rank::scalar) refuse_argument(tree, 0, a->shape, "a vector or a matrix");
    if (!a->inverse_of) return transpose_entries(maker, a);
    return inverse_matrix(maker, tree, transpose_entries(maker, a->inverse_of)); // stays a solve
}

Value diag(const Maker& maker, const Tree& tree, std::span<const Value> arguments)
{
    std::vector<ClosedTree> diagonal;
    if (arguments.size() == 1 && arguments[0]->shape.rank == Rank::vector) {
        diagonal = maker.entries(*arguments[0]);
    } else {
        for (std::size_t k = 0; k < arguments.size(); ++k) {
            if (arguments[k]->shape.rank != Rank::scalar)
                refuse_argument(tree, k, arguments[k]->shape, "one vector, or scalars");
            diagonal.push_back(maker.entry(*arguments[k], 0));
        }
    }
    const std::size_t n = diagonal.size();
    require_size(maker, matrix_shape(n, n));
    std::vector<ClosedTree> entries(n * n, maker.number(0));
    for (std::size_t k = 0; k < n; ++k) entries[k * n + k] = std::move(diagonal[k]);
    return array_value(maker, matrix_shape(n, n), std::move(entries));
}

Value identity(const Maker& maker, const Tree& tree, const Value& size)
{
    const std::optional<long> n = integer_of(*size);
    if (!n || *n < 1)
        refuse(tree->arguments[0], "the argument of identity is not a positive integer constant",
               "identity(3) is the 3 x 3 identity matrix");
    return identity_matrix(maker, static_cast<std::size_t>(*n));
}

/// Determinants of closed entries; the terms of a minor are summed when it is used first.
struct ClosedRing {
    struct Number {
        std::vector<ClosedTree> terms;
        ClosedTree sum;
    };
    const Maker& maker;
    std::span<const ClosedTree> entries;
    std::size_t n;

    [[nodiscard]] Number zero() const { return {}; }
    [[nodiscard]] Number one() const { return {{}, maker.number(1)}; }
    [[nodiscard]] const ClosedTree& entry(std::size_t i, std::size_t j) const { return entries[i * n + j]; }
    [[nodiscard]] bool is_zero(const ClosedTree& entry) const { return is_number(entry, 0); }
    [[nodiscard]] ClosedTree times(const ClosedTree& entry, Number& minor) const
    {
        return maker.multiply({entry, whole(minor)});
    }
    void add(Number& minor, const ClosedTree& term, int sign) const
    {
        minor.terms.push_back(sign < 0 ? maker.negate(term) : term);
    }
    [[nodiscard]] const ClosedTree& whole(Number& minor) const
    {
        if (minor.sum.tree == nullptr) minor.sum = maker.add(minor.terms);
        return minor.sum;
    }
};

} // namespace

Value inverse_matrix(const Maker& maker, const Tree& tree, const Value& a)
{
    if (a->shape.rank != Rank::matrix || a->shape.rows != a->shape.columns)
        refuse(tree, fmt::format("the inverse of {} is not defined", to_text(a->shape)),
               "the matrix of an inverse is square");
    if (a->inverse_of) return a->inverse_of;
    Value result = array_value(maker, a->shape, {});
    result->inverse_of = a;
    return result;
}

Value identity_matrix(const Maker& maker, std::size_t n)
{
    require_size(maker, matrix_shape(n, n));
    std::vector<ClosedTree> entries(n * n, maker.number(0));
    for (std::size_t k = 0; k < n; ++k) entries[k * n + k] = maker.number(1);
    return array_value(maker, matrix_shape(n, n), std::move(entries));
}

Value determinant(const Maker& maker, const Tree& tree, const Value& a)
{
    require_square(tree, a->shape);
    const std::size_t n = a->shape.rows;
    if (n > largest_determinant)
        refuse(tree, fmt::format("the determinant of {} is too large", to_text(a->shape)),
               fmt::format("a determinant is written out up to {0} x {0}", largest_determinant));
    const ClosedRing ring{maker, maker.entries(*a), n};
    auto whole = lagen::determinant(ring, n);
    return scalar(ring.whole(whole));
}

Value call_on_arrays(const Maker& maker, const Tree& tree, std::span<const Value> arguments)
{
    const Value& first = arguments[0];
    const auto neutral = std::find_if(arguments.begin(), arguments.end(), [](const Value& v) { return v->neutral; });
    switch (tree->function) {
    case Function::dot:
    case Function::cross:
    case Function::norm:
    case Function::trace:
    case Function::transpose:
        if (neutral != arguments.end()) return *neutral;
        break;
    default: break;
    }
    switch (tree->function) {
    case Function::dot: return dot(maker, tree, arguments);
    case Function::cross: return cross(maker, tree, arguments);
    case Function::norm: return norm(maker, tree, first);
    case Function::trace: return trace(maker, tree, first);
    case Function::transpose: return transpose(maker, tree, first);
    case Function::det: return determinant(maker, tree, first);
    case Function::inverse: return inverse_matrix(maker, tree, first);
    case Function::diag: return diag(maker, tree, arguments);
    case Function::identity: return identity(maker, tree, first);
    case Function::hat: return hat(maker, tree, first);
    case Function::vee: return vee(maker, tree, first);
    case Function::exp: return exponential(maker, tree, first);
    case Function::cay: return cayley(maker, tree, first);
    default: break;
    }
    const char* function = entry_of(tree->function).name;
    const auto array =
        std::find_if(arguments.begin(), arguments.end(), [](const Value& v) { return v->shape.rank != Rank::scalar; });
    refuse(tree->arguments[static_cast<std::size_t>(array - arguments.begin())],
           fmt::format("an argument of {} is {}", function, to_text((*array)->shape)),
           fmt::format("{} takes {}scalar{}", function, arguments.size() == 1 ? "a " : "",
                       arguments.size() == 1 ? "" : "s"));
}

namespace {

// Rotation vectors that are an angle times a constant unit vector.

/// v = angle e. The entries of e are square roots of rational numbers with a sign.
struct FixedAxis {
    ClosedTree angle;
    std::array<SignedRoot, 3> e;
};

/// A product taken apart: a number, and the factors above and below the bar that are none.
struct Product {
    SignedRoot number = {};
    std::vector<ClosedTree> above = {}, below = {};
};

class ProductReader {
  public:
    Product read(const Tree& tree)
    {
        Product product;
        read(tree, false, product);
        return product;
    }

  private:
    void read(const Tree& tree, bool below, Product& product)
    {
        if (const auto number = number_in(tree); number && !(below && number->sign == 0)) {
            product.number = product.number * (below ? SignedRoot{number->sign, 1 / number->square} : *number);
            return;
        }
        switch (tree->kind) {
        case TreeKind::negate:
            product.number.sign = -product.number.sign;
            return read(tree->arguments[0], below, product);
        case TreeKind::multiply:
            for (const Tree& factor : tree->arguments) read(factor, below, product);
            return;
        case TreeKind::divide:
            read(tree->arguments[0], below, product);
            return read(tree->arguments[1], !below, product);
        default: (below ? product.below : product.above).push_back({tree, measured(tree)});
        }
    }

    /// A rational number, a square root of one, or a sine or cosine of a special angle.
    std::optional<SignedRoot> number_in(const Tree& tree)
    {
        if (const Measure& size = measured(tree); size.constant) return signed_root(size.factor);
        if (tree->kind == TreeKind::power) {
            const Measure base = measured(tree->arguments[0]), exponent = measured(tree->arguments[1]);
            const bool is_root =
                base.constant && base.factor > 0 && exponent.constant && abs(exponent.factor) == Rational(1, 2);
            if (!is_root) return std::nullopt;
            return SignedRoot{1, exponent.factor > 0 ? base.factor : Rational(1 / base.factor)};
        }
        if (tree->kind != TreeKind::call) return std::nullopt;
        const Tree& argument = tree->arguments[0];
        if (tree->function == Function::sqrt) {
            const Measure& inner = measured(argument);
            if (inner.constant && inner.factor >= 0) return SignedRoot{sgn(inner.factor), inner.factor};
        }
        const bool sine = tree->function == Function::sin;
        if (!sine && tree->function != Function::cos) return std::nullopt;
        const std::optional<Rational> turn = turn_in(argument);
        if (!turn) return std::nullopt;
        return sine ? sine_of_turn(*turn) : cosine_of_turn(*turn);
    }

    /// q of the tree q pi.
    std::optional<Rational> turn_in(const Tree& tree)
    {
        if (const Measure& size = measured(tree); size.constant)
            return size.factor == 0 ? std::optional<Rational>(0) : std::nullopt;
        Product product;
        if (tree->kind == TreeKind::pi) return Rational(1);
        if (tree->kind != TreeKind::negate && tree->kind != TreeKind::multiply && tree->kind != TreeKind::divide)
            return std::nullopt;
        read(tree, false, product);
        const std::optional<Rational> factor = rational_root(product.number.square);
        if (!factor || !product.below.empty() || product.above.size() != 1 ||
            product.above[0].tree->kind != TreeKind::pi)
            return std::nullopt;
        return Rational(product.number.sign * *factor);
    }

    const Measure& measured(const Tree& tree)
    {
        return measures_(tree, [](const Tree& part, const std::vector<Measure>& sizes) {
            return measure(*part, sizes, closing_limits());
        });
    }

    Fold<Measure> measures_;
};

ClosedTree joined(const Maker& maker, const Product& product)
{
    const ClosedTree above = maker.multiply(product.above);
    return product.below.empty() ? above : maker.divide(above, maker.multiply(product.below));
}

/// The number as a tree: rational, or with a square root.
ClosedTree number_of(const Maker& maker, const SignedRoot& value)
{
    const std::optional<Rational> root = rational_root(value.square);
    const ClosedTree size = root ? maker.number(*root) : maker.call(Function::sqrt, {maker.number(value.square)});
    return value.sign < 0 ? maker.negate(size) : size;
}

/// Nothing where the three entries are not seen to be one function times such numbers.
std::optional<FixedAxis> fixed_axis_of(const Maker& maker, const std::vector<ClosedTree>& v)
{
    ProductReader reader;
    FixedAxis result;
    std::optional<SignedNumber> common;
    Rational square = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Product product = reader.read(v[k].tree);
        result.e[k] = product.number;
        if (product.number.sign == 0) continue;
        const ClosedTree function = joined(maker, product);
        const SignedNumber number = maker.identity()(function.tree);
        if (!common) result.angle = function, common = number;
        if (number.sign == 0 || number.number != common->number) return std::nullopt;
        result.e[k].sign *= number.sign * common->sign;
        square += product.number.square;
    }
    if (!common) return std::nullopt;
    for (SignedRoot& entry : result.e) entry.square /= square;
    result.angle = maker.multiply({number_of(maker, {1, square}), result.angle});
    return result;
}

/// The v of a 3 x 3 matrix hat(v), or the s of [[0, -s], [s, 0]], where the matrix is skew as written.
std::optional<std::vector<ClosedTree>> axis_of(const Maker& maker, const Value& a)
{
    const std::size_t n = a->shape.rows;
    if (a->shape.rank != Rank::matrix || n != a->shape.columns || (n != 2 && n != 3)) return std::nullopt;
    const std::vector<ClosedTree>& entries = maker.entries(*a);
    SignedIdentity& signed_number = maker.identity();
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j <= i; ++j) {
            const SignedNumber below = signed_number(entries[i * n + j].tree);
            const SignedNumber above = signed_number(entries[j * n + i].tree);
            const bool opposite = below.sign == -above.sign && (below.sign == 0 || below.number == above.number);
            if (!opposite) return std::nullopt;
        }
    if (n == 2) return std::vector<ClosedTree>{entries[2]};
    return std::vector<ClosedTree>{entries[7], entries[2], entries[3]};
}

/// The end of a message about a matrix of a size that vee and exp take: it is not seen to be skew. "" for other shapes.
const char* unless_skew(const Value& a)
{
    const bool small = a->shape == matrix_shape(2, 2) || a->shape == matrix_shape(3, 3);
    return small ? " that is not seen to be skew" : "";
}

Value hat_of(const Maker& maker, const std::vector<ClosedTree>& v)
{
    const ClosedTree zero = maker.number(0);
    if (v.size() == 1) return array_value(maker, matrix_shape(2, 2), {zero, maker.negate(v[0]), v[0], zero});
    return array_value(
        maker, matrix_shape(3, 3),
        {zero, maker.negate(v[2]), v[1], v[2], zero, maker.negate(v[0]), maker.negate(v[1]), v[0], zero});
}

/// 1 + a v^ + b v^ v^ with v^ v^ = v v^T - |v|^2 1, so that the diagonal is 1 - b (v_j^2 + v_k^2).
Value rotation(const Maker& maker, const std::vector<ClosedTree>& v, const ClosedTree& a, const ClosedTree& b)
{
    const Value v_hat = hat_of(maker, v);
    std::vector<ClosedTree> squares;
    for (const ClosedTree& entry : v) squares.push_back(maker.square(entry));
    std::vector<ClosedTree> entries;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            if (i == j) {
                const ClosedTree others = maker.add({squares[(i + 1) % 3], squares[(i + 2) % 3]});
                entries.push_back(maker.subtract(maker.number(1), maker.multiply({b, others})));
                continue;
            }
            const std::size_t low = std::min(i, j); // v_i v_j is written one way
            const std::size_t high = std::max(i, j);
            entries.push_back(
                maker.add({maker.multiply({a, v_hat->entries[i * 3 + j]}), maker.multiply({b, v[low], v[high]})}));
        }
    return array_value(maker, matrix_shape(3, 3), std::move(entries));
}

/// cos(s) 1 + sin(s) e^ + (1 - cos(s)) e e^T of a unit vector e, where nothing is to be kept from 0/0.
Value rotation_about(const Maker& maker, const FixedAxis& axis)
{
    const ClosedTree c = maker.call(Function::cos, {axis.angle}), s = maker.call(Function::sin, {axis.angle});
    const ClosedTree less = maker.subtract(maker.number(1), c);
    std::vector<ClosedTree> e;
    for (const SignedRoot& entry : axis.e) e.push_back(number_of(maker, entry));
    const Value e_hat = hat_of(maker, e);
    std::vector<ClosedTree> entries;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            const ClosedTree product = number_of(maker, axis.e[i] * axis.e[j]);
            const ClosedTree across = i == j ? product : maker.multiply({less, product});
            const ClosedTree along = i == j ? maker.multiply({maker.number(1 - axis.e[i].square), c})
                                            : maker.multiply({e_hat->entries[i * 3 + j], s});
            entries.push_back(maker.add({along, across}));
        }
    return array_value(maker, matrix_shape(3, 3), std::move(entries));
}

ClosedTree norm_squared(const Maker& maker, const std::vector<ClosedTree>& v)
{
    std::vector<ClosedTree> terms;
    for (const ClosedTree& entry : v) terms.push_back(maker.square(entry));
    return maker.add(std::move(terms));
}

} // namespace

Value hat(const Maker& maker, const Tree& tree, const Value& v)
{
    if (v->shape.rank != Rank::scalar && v->shape != vector_shape(3))
        refuse(tree->arguments[0], fmt::format("an argument of hat is {}", to_text(v->shape)),
               "hat takes a vector of 3, or a scalar for a 2 x 2 matrix");
    return hat_of(maker, maker.entries(*v));
}

Value vee(const Maker& maker, const Tree& tree, const Value& a)
{
    std::optional<std::vector<ClosedTree>> axis = axis_of(maker, a);
    if (!axis)
        refuse(tree->arguments[0], fmt::format("an argument of vee is {}{}", to_text(a->shape), unless_skew(a)),
               "vee takes a 3 x 3 or 2 x 2 matrix whose entries are each other's negatives, such as hat(v)");
    if (axis->size() == 1) return scalar((*axis)[0]);
    return array_value(maker, vector_shape(3), std::move(*axis));
}

Value exponential(const Maker& maker, const Tree& tree, const Value& a)
{
    const std::optional<std::vector<ClosedTree>> axis = axis_of(maker, a);
    if (!axis)
        refuse(tree->arguments[0], fmt::format("an argument of exp is {}{}", to_text(a->shape), unless_skew(a)),
               "exp takes a scalar, or a skew matrix, 3 x 3 or 2 x 2, such as hat(v); cay(A) takes any square matrix");
    const std::vector<ClosedTree>& v = *axis;
    if (v.size() == 1) {
        const ClosedTree c = maker.call(Function::cos, {v[0]});
        const ClosedTree s = maker.call(Function::sin, {v[0]});
        return array_value(maker, matrix_shape(2, 2), {c, maker.negate(s), s, c});
    }
    if (const std::optional<FixedAxis> fixed = fixed_axis_of(maker, v)) return rotation_about(maker, *fixed);
    const ClosedTree z = norm_squared(maker, v);
    return rotation(maker, v, maker.call(Function::stumpff, {maker.number(1), z}),
                    maker.call(Function::stumpff, {maker.number(2), z}));
}

Value cayley(const Maker& maker, const Tree& tree, const Value& a)
{
    if (a->shape.rank != Rank::matrix || a->shape.rows != a->shape.columns)
        refuse(tree->arguments[0], fmt::format("an argument of cay is {}", to_text(a->shape)),
               "cay takes a square matrix");
    const ClosedTree one = maker.number(1);
    const ClosedTree half = maker.number(Rational(1, 2));
    if (const std::optional<std::vector<ClosedTree>> v = axis_of(maker, a)) {
        const ClosedTree quarter = maker.divide(norm_squared(maker, *v), maker.number(4));
        const ClosedTree below = maker.add({one, quarter});
        if (v->size() == 3) return rotation(maker, *v, maker.divide(one, below), maker.divide(half, below));
        const ClosedTree c = maker.divide(maker.subtract(one, quarter), below);
        const ClosedTree s = maker.divide((*v)[0], below);
        return array_value(maker, matrix_shape(2, 2), {c, maker.negate(s), s, c});
    }
    const std::size_t n = a->shape.rows;
    std::vector<ClosedTree> minus, plus;
    const std::vector<ClosedTree>& entries = maker.entries(*a);
    for (std::size_t k = 0; k < n * n; ++k) {
        const ClosedTree part = maker.multiply({half, entries[k]});
        const ClosedTree unit = maker.number(k % (n + 1) == 0 ? 1 : 0);
        minus.push_back(maker.subtract(unit, part));
        plus.push_back(maker.add({unit, part}));
    }
    const Value left = inverse_matrix(maker, tree, array_value(maker, a->shape, std::move(minus)));
    const std::vector<Value> factors{left, array_value(maker, a->shape, std::move(plus))};
    return multiply_values(maker, factors);
}

} // namespace lagen
