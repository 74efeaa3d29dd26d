// SPDX-License-Identifier: GPL-2.0-or-later
#include "expression/fixed_axis.hpp"

#include "expression/fold.hpp"

namespace lagen {

namespace {

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

} // namespace

ClosedTree number_of(const Maker& maker, const SignedRoot& value)
{
    const std::optional<Rational> root = rational_root(value.square);
    const ClosedTree size = root ? maker.number(*root) : maker.call(Function::sqrt, {maker.number(value.square)});
    return value.sign < 0 ? maker.negate(size) : size;
}

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

} // namespace lagen
