// SPDX-License-Identifier: GPL-2.0-or-later
/// Order conditions of the splittings in 50 digits: word by word of drifts and kicks, or tree by tree where x' is
/// affine in y; and what each of them takes: kinetic energies that are not quadratic, rates that depend on time.
#include "convergence/order_of_ends.hpp"
#include "lagen/integrate.hpp"
#include "support/nystrom_trees.hpp"
#include "support/tolerances.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <catch2/catch.hpp>

namespace splitting = lagen::splitting;

namespace {

using Wide = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;
using Quad = boost::multiprecision::cpp_bin_float_quad;
using Weights = std::vector<Wide>;

const Wide exact_to("1e-37");

template <class Splitting>
Weights weights()
{
    Weights list;
    for (const auto& weight : Splitting::weights) list.push_back(weight.template as<Wide>());
    return list;
}

/// The coefficient of a word in exp(w_1 A) exp(w_2 B) exp(w_3 A) .., its letters the bits of `word`: 1 for the kind
/// that comes first.
Wide coefficient(const Weights& w, unsigned word, unsigned length)
{
    Weights sums(length + 1, Wide(0));
    sums[0] = 1;
    for (std::size_t k = 0; k < w.size(); ++k)
        for (unsigned end = length; end > 0; --end) { // from the longest beginning, which the others do not need
            Wide term = 1;
            for (unsigned start = end; start-- > 0 && ((word >> start) & 1U) == (k % 2 == 0 ? 1U : 0U);) {
                term *= w[k] / Wide(end - start);
                sums[end] += sums[start] * term;
            }
        }
    return sums[length];
}

/// The largest difference to exp(A + B) over all words of this length.
Wide worst_word(const Weights& w, unsigned length)
{
    Wide exact = 1, worst = 0;
    for (unsigned k = 2; k <= length; ++k) exact /= Wide(k);
    for (unsigned word = 0; word < 1U << length; ++word)
        worst = std::max<Wide>(worst, abs(coefficient(w, word, length) - exact));
    return worst;
}

/// The largest error over the trees of a Nystrom method up to `order`, of both rates and positions.
template <class Splitting>
Wide worst_tree(std::size_t from, std::size_t to)
{
    lagen::support::NystromRows<Wide> rows;
    Weights b, bbar;
    Wide reach = 0;
    const Weights w = weights<Splitting>();
    for (std::size_t k = 0; k < w.size(); ++k) {
        if ((k % 2 == 0) != Splitting::kick_first) {
            reach += w[k];
            continue;
        }
        Weights row;
        for (std::size_t j = 0; j < b.size(); ++j) row.push_back(b[j] * (reach - rows.c[j]));
        rows.abar.push_back(row);
        rows.c.push_back(reach);
        b.push_back(w[k]);
    }
    for (std::size_t j = 0; j < b.size(); ++j) bbar.push_back(b[j] * (1 - rows.c[j]));
    const lagen::support::NystromTrees<Wide> trees(to, false);
    const auto phi = elementary_weights(rows, trees.list());
    Wide worst = from == 1 ? Wide(abs(reach - 1)) : Wide(0);
    for (const bool twice : {false, true})
        worst = std::max<Wide>(worst,
                               worst_nystrom_residual(phi, trees.list(), twice ? bbar : b, from, to, twice, Wide(1)));
    return worst;
}

template <class Splitting>
void check_words()
{
    const Weights w = weights<Splitting>();
    constexpr auto order = static_cast<unsigned>(Splitting::order);
    for (unsigned length = 1; length <= order; ++length) CHECK(worst_word(w, length) < exact_to);
    CHECK(worst_word(w, order + 1) > 1e-8);
    static_assert(!Splitting::affine);
}

template <class Splitting>
void check_trees()
{
    constexpr auto order = static_cast<std::size_t>(Splitting::order);
    CHECK(worst_tree<Splitting>(1, order) < exact_to);
    CHECK(worst_tree<Splitting>(order + 1, order + 1) > 1e-8);
    // [V, [V, [V, T]]] and what is made of it; of degree 4 a palindrome has none.
    CHECK(worst_word(weights<Splitting>(), order == 4 ? 4 : 5) > 1e-6);
    static_assert(Splitting::affine);
}

/// H = sqrt(1 + p^2) - cos q.
struct Relativistic {
    using Scalar = Quad;
    using State = Eigen::Matrix<Quad, 2, 1>;
    static constexpr int dimension = 2, base_dimension = 1;
    lagen::Status rhs(Scalar, const State& s, State& ds) const noexcept
    {
        const Scalar q = s[0], p = s[1];
        ds[0] = p / sqrt(1 + p * p);
        ds[1] = -sin(q);
        return lagen::Status::ok;
    }
};

/// H = (1 + sin(t)/2) p^2/2 - (1 + cos(3 t)/3) cos q.
struct Clocked {
    using Scalar = Quad;
    using State = Eigen::Matrix<Quad, 2, 1>;
    static constexpr int dimension = 2, base_dimension = 1;
    lagen::Status rhs(Scalar t, const State& s, State& ds) const noexcept
    {
        const Scalar q = s[0], p = s[1];
        ds[0] = (1 + sin(t) / 2) * p;
        ds[1] = -(1 + cos(3 * t) / 3) * sin(q);
        return lagen::Status::ok;
    }
};

/// Of the end at t = 4, against that of a quarter of the shortest step.
template <class Model, class Method>
double order_on(int coarsest)
{
    const auto end = [](int steps) {
        const auto run =
            lagen::integrate(Model{}, {Quad(1), Quad(0.75)}, {Quad(0), Quad(4)}, Method{.step = 4.0 / steps});
        REQUIRE(run.status() == lagen::Status::ok);
        return run.state;
    };
    return lagen::testing::order_of_ends(end, coarsest, 4);
}

using lagen::testing::near;

template <class Model, class Method>
lagen::Status status_on()
{
    return lagen::integrate(Model{}, {Quad(1), Quad(0.75)}, {Quad(0), Quad(1)}, Method{.step = 0.5}).status();
}

} // namespace

TEST_CASE("Splittings satisfy the conditions of every word of drifts and kicks up to their order in 37 digits")
{
    check_words<splitting::LeapfrogDkd>();
    check_words<splitting::LeapfrogKdk>();
    check_words<splitting::BlanesMoan4>();
    check_words<splitting::Srkn4>();
    check_words<splitting::Yoshida6>();
    check_words<splitting::BlanesMoan6>();
    check_words<splitting::KahanLi8>();
}

TEST_CASE("Splittings of Nystrom's kind satisfy the conditions of every tree, and not of every word")
{
    check_trees<splitting::McLachlan4>();
    check_trees<splitting::Srkn6>();
}

/// Of leapfrogs, log S(w h) = sum of (w h)^k Y_k over odd k: words of weight 10 in Y_1, Y_3, .., with all of A and B
/// there would be 1024.
TEST_CASE("The 35 leapfrogs of order 10 satisfy the conditions of every word of a symmetric method's series")
{
    std::vector<Wide> lengths;
    for (std::size_t k = 1; k < splitting::Sofroniou10::weights.size(); k += 2)
        lengths.push_back(splitting::Sofroniou10::weights[k].as<Wide>());
    REQUIRE(lengths.size() == 35);
    const auto worst = [&](int degree) {
        Wide largest = 0;
        const auto visit = [&](const auto& self, std::vector<int> word, int rest) -> void {
            for (int k = 1; k <= rest; k += 2) {
                auto longer = word;
                longer.push_back(k);
                self(self, longer, rest - k);
            }
            if (rest > 0) return;
            std::vector<Wide> sums(word.size() + 1, Wide(0));
            sums[0] = 1;
            for (const Wide& w : lengths)
                for (std::size_t end = word.size(); end > 0; --end) {
                    Wide term = 1;
                    for (std::size_t start = end; start-- > 0;) {
                        term *= pow(w, word[start]) / Wide(end - start);
                        sums[end] += sums[start] * term;
                    }
                }
            Wide exact = std::ranges::all_of(word, [](int k) { return k == 1; }) ? 1 : 0;
            for (std::size_t k = 2; k <= word.size(); ++k) exact /= Wide(k);
            largest = std::max<Wide>(largest, abs(sums.back() - exact));
        };
        visit(visit, {}, degree);
        return largest;
    };
    for (int degree = 1; degree <= 10; ++degree) CHECK(worst(degree) < exact_to);
    CHECK(worst(11) > 1e-9);
}

TEST_CASE("Splittings have their order where the kinetic energy is not quadratic, or refuse it")
{
    CHECK_THAT((order_on<Relativistic, lagen::LeapfrogDkd>(64)), near(2));
    CHECK_THAT((order_on<Relativistic, lagen::BlanesMoan4>(16)), near(4));
    CHECK_THAT((order_on<Relativistic, lagen::Srkn4>(64)), near(4));
    CHECK_THAT((order_on<Relativistic, lagen::Yoshida6>(16)), near(6));
    CHECK_THAT((order_on<Relativistic, lagen::BlanesMoan6>(16)), near(6));
    CHECK_THAT((order_on<Relativistic, lagen::KahanLi8>(32)), near(8));
    CHECK_THAT((order_on<Relativistic, lagen::Sofroniou10>(16)), near(10));
    CHECK(status_on<Relativistic, lagen::McLachlan4>() == lagen::Status::not_separable);
    CHECK(status_on<Relativistic, lagen::Srkn6>() == lagen::Status::not_separable);
}

// With one clock for drifts and kicks every one of them has order 1 here.
TEST_CASE("Splittings have their order where both rates depend on time")
{
    CHECK_THAT((order_on<Clocked, lagen::LeapfrogKdk>(64)), near(2));
    CHECK_THAT((order_on<Clocked, lagen::BlanesMoan4>(32)), near(4));
    CHECK_THAT((order_on<Clocked, lagen::BlanesMoan6>(16)), near(6));
    CHECK_THAT((order_on<Clocked, lagen::KahanLi8>(16)), near(8));
}
