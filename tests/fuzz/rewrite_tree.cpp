// SPDX-License-Identifier: GPL-2.0-or-later
/// Identities that hold wherever both sides are defined, each a line, applied at a place by choice. The second side of
/// each is defined nowhere else than the first: one applied after another then still gives what equals the first.
#include "fuzz/grow_tree.hpp"

namespace lagen::fuzz {

namespace {

Tree one(Function function, Tree a)
{
    return call(function, {std::move(a)});
}

Tree half(Tree a)
{
    return divide(std::move(a), number(2));
}

Tree square(Tree a)
{
    return power(std::move(a), number(2));
}

Tree minus(Tree a, Tree b)
{
    return add({std::move(a), negate(std::move(b))});
}

/// The first argument, and the sum or product of the others.
std::pair<Tree, Tree> split(const Tree& tree)
{
    const std::vector<Tree> rest(tree->arguments.begin() + 1, tree->arguments.end());
    if (rest.size() == 1) return {tree->arguments[0], rest[0]};
    return {tree->arguments[0], tree->kind == TreeKind::add ? add(rest) : multiply(rest)};
}

bool is_sum(const Tree& tree)
{
    return tree->kind == TreeKind::add && tree->arguments.size() > 1;
}

Tree rewrite_sine(const Tree& a)
{
    if (!is_sum(a)) return multiply({number(2), one(Function::sin, half(a)), one(Function::cos, half(a))});
    const auto [u, v] = split(a);
    return add({multiply({one(Function::sin, u), one(Function::cos, v)}),
                multiply({one(Function::cos, u), one(Function::sin, v)})});
}

Tree rewrite_cosine(const Tree& a)
{
    if (!is_sum(a)) return minus(number(1), multiply({number(2), square(one(Function::sin, half(a)))}));
    const auto [u, v] = split(a);
    return minus(multiply({one(Function::cos, u), one(Function::cos, v)}),
                 multiply({one(Function::sin, u), one(Function::sin, v)}));
}

Tree rewrite_exponential(const Tree& a)
{
    if (!is_sum(a)) return divide(number(1), one(Function::exp, negate(a)));
    const auto [u, v] = split(a);
    return multiply({one(Function::exp, u), one(Function::exp, v)});
}

Tree rewrite_logarithm(const Tree& a)
{
    if (a->kind == TreeKind::divide)
        return minus(one(Function::log, a->arguments[0]), one(Function::log, a->arguments[1]));
    if (a->kind == TreeKind::multiply && a->arguments.size() > 1) {
        const auto [u, v] = split(a);
        return add({one(Function::log, u), one(Function::log, v)});
    }
    // Not log(a^2)/2, which is defined for a < 0 too: exp(log a) could become |a|.
    return divide(one(Function::log, power(a, number(3))), number(3));
}

Tree rewrite_stumpff(const Tree& order, const Tree& z)
{
    const long k = order->number.get_num().get_si();
    Rational inverse = 1;
    for (long j = 2; j <= k; ++j) inverse /= j;
    return minus(number(inverse), multiply({z, call(Function::stumpff, {number(k + 2), z})}));
}

Tree rewrite_call(const Tree& tree)
{
    const std::vector<Tree>& a = tree->arguments;
    const auto exponential = [&](const Tree& b) { return one(Function::exp, b); };
    switch (tree->function) {
    case Function::sin: return rewrite_sine(a[0]);
    case Function::cos: return rewrite_cosine(a[0]);
    case Function::tan: return divide(one(Function::sin, a[0]), one(Function::cos, a[0]));
    case Function::asin: return minus(half(constant_pi()), one(Function::acos, a[0]));
    case Function::acos: return minus(half(constant_pi()), one(Function::asin, a[0]));
    case Function::atan: return one(Function::asin, divide(a[0], one(Function::sqrt, add({number(1), square(a[0])}))));
    case Function::atan2:
        return multiply(
            {number(2),
             one(Function::atan, divide(a[0], add({one(Function::sqrt, add({square(a[0]), square(a[1])})), a[1]})))});
    case Function::sinh: return half(minus(exponential(a[0]), exponential(negate(a[0]))));
    case Function::cosh: return half(add({exponential(a[0]), exponential(negate(a[0]))}));
    case Function::tanh: return divide(one(Function::sinh, a[0]), one(Function::cosh, a[0]));
    case Function::exp: return rewrite_exponential(a[0]);
    case Function::log: return rewrite_logarithm(a[0]);
    case Function::sqrt: return power(a[0], number(Rational(1, 2)));
    case Function::abs: return one(Function::sqrt, square(a[0]));
    case Function::minimum: return half(minus(add(a), one(Function::abs, minus(a[0], a[1]))));
    case Function::maximum: return half(add({a[0], a[1], one(Function::abs, minus(a[0], a[1]))}));
    case Function::sign: return divide(a[0], one(Function::abs, a[0]));
    case Function::select: return negate(call(Function::select, {a[0], negate(a[1]), negate(a[2])}));
    case Function::stumpff: return rewrite_stumpff(a[0], a[1]);
    case Function::erf: return negate(one(Function::erf, negate(a[0])));
    default: return tree;
    }
}

Tree rewrite_product(const Tree& tree)
{
    const auto [u, v] = split(tree);
    if (is_sum(v)) {
        std::vector<Tree> terms;
        for (const Tree& term : v->arguments) terms.push_back(multiply({u, term}));
        return add(terms);
    }
    // u v = ((u + v)^2 - (u - v)^2) / 4
    return divide(minus(square(add({u, v})), square(minus(u, v))), number(4));
}

Tree rewrite_power(const Tree& tree)
{
    const Tree& base = tree->arguments[0];
    const Tree& exponent = tree->arguments[1];
    if (exponent->kind != TreeKind::number) return one(Function::exp, multiply({exponent, one(Function::log, base)}));
    return multiply({power(base, number(exponent->number - 1)), base});
}

/// sin(asin a) and the like: any expression as a function of its inverse.
Tree wrap(Choices& choices, const Tree& tree)
{
    switch (choices.below(9)) {
    case 0: return one(Function::sin, one(Function::asin, tree));
    case 1: return one(Function::tan, one(Function::atan, tree));
    case 2: return one(Function::exp, one(Function::log, tree));
    case 3: return one(Function::log, one(Function::exp, tree));
    case 4: return square(one(Function::sqrt, tree));
    case 5: return minus(add({tree, name("y")}), name("y"));
    case 6: return divide(multiply({tree, name("x")}), name("x"));
    case 7:
        return multiply({tree, add({square(one(Function::sin, name("z"))), square(one(Function::cos, name("z")))})});
    default: return divide(number(1), divide(number(1), tree));
    }
}

Tree apply_identity(Choices& choices, const Tree& tree)
{
    if (choices.below(3) == 0) return wrap(choices, tree);
    switch (tree->kind) {
    case TreeKind::call: return rewrite_call(tree);
    case TreeKind::multiply: return tree->arguments.size() > 1 ? rewrite_product(tree) : tree;
    case TreeKind::divide: return multiply({tree->arguments[0], power(tree->arguments[1], number(-1))});
    case TreeKind::power: return rewrite_power(tree);
    case TreeKind::add: return add(std::vector<Tree>(tree->arguments.rbegin(), tree->arguments.rend()));
    default: return wrap(choices, tree);
    }
}

} // namespace

Tree rewritten(Choices& choices, const Tree& tree)
{
    const bool closed = tree->arguments.empty() || tree->kind == TreeKind::compare;
    if (closed || choices.below(3) == 0) return tree->kind == TreeKind::compare ? tree : apply_identity(choices, tree);
    std::size_t place = choices.below(tree->arguments.size());
    // The order of a Stumpff function and the exponent of a power are literals.
    if (tree->kind == TreeKind::call && tree->function == Function::stumpff) place = 1;
    if (tree->kind == TreeKind::power) place = 0;
    auto changed = std::make_shared<TreeNode>(*tree);
    changed->arguments[place] = rewritten(choices, tree->arguments[place]);
    return changed;
}

} // namespace lagen::fuzz
