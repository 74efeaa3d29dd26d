// SPDX-License-Identifier: GPL-2.0-or-later
/// What tells an element of a matrix group from other matrices.
#include "geometry/group_relations.hpp"
#include "geometry/named_algebra.hpp"
#include "support/dice.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lagen;

namespace {

/// exp(A) by its series.
RealMatrix exponential(const RealMatrix& A, std::size_t n)
{
    RealMatrix sum(n * n, 0), term(n * n, 0);
    for (std::size_t k = 0; k < n; ++k) term[k * (n + 1)] = 1;
    for (int order = 1; order < 60; ++order) {
        for (std::size_t k = 0; k < n * n; ++k) sum[k] += term[k];
        term = times(term, A, n);
        for (long double& each : term) each /= order;
    }
    return sum;
}

std::vector<RealMatrix> generators_of(const NamedAlgebra& algebra)
{
    std::vector<RealMatrix> out;
    for (const SparseMatrix& each : algebra.basis) {
        RealMatrix& matrix = out.emplace_back();
        for (const Rational& entry : dense(each, algebra.size)) matrix.push_back(entry.get_d());
    }
    return out;
}

} // namespace

TEST_CASE("products of exponentials of the generators obey every relation of the group")
{
    testing::Dice dice(7);
    for (const char* name : {"SO(2)", "SO(3)", "SO(4)", "SO(5)", "SU(2)", "SE(2)", "SE(3)", "SO(2,1)", "SL(2)",
                             "HEIS(3)", "AFF(1)", "GL(2)", "R^3", "SO(3) + R^2", "SL(2) + SO(3)"}) {
        INFO(name);
        const NamedAlgebra algebra = algebra_of_group(name).value();
        const std::vector<RealMatrix> generators = generators_of(algebra);
        const std::size_t n = algebra.size;
        RealMatrix W(n * n, 0);
        for (std::size_t k = 0; k < n; ++k) W[k * (n + 1)] = 1;
        CHECK(group_defect(generators, W, n).size <= 1e-16L);
        for (int factor = 0; factor < 3; ++factor) {
            RealMatrix A(n * n, 0);
            for (const RealMatrix& E : generators) {
                const long double s = (static_cast<long double>(dice.below(200)) - 100) / 60;
                for (std::size_t k = 0; k < n * n; ++k) A[k] += s * E[k];
            }
            W = times(W, exponential(A, n), n);
        }
        CHECK(group_defect(generators, W, n).size <= 1e-15L);
    }
}

TEST_CASE("a matrix outside a group is told by the relation that it misses")
{
    const auto defect = [](const char* name, const RealMatrix& W) {
        const NamedAlgebra algebra = algebra_of_group(name).value();
        const GroupDefect found = group_defect(generators_of(algebra), W, algebra.size);
        return found.size > 1e-6L ? found.relation : "";
    };
    CHECK(defect("SO(2)", {2, 0, 0, 0.5L}) != "");
    CHECK(defect("SO(3)", {1, 0, 0, 0, 1, 0, 0, 0, 1.001L}) == "transpose(W)*W = 1");
    CHECK(defect("SO(3)", {1, 0, 0, 0, 1, 0, 0, 0, -1}) == "det(W) = 1");
    CHECK(defect("SO(3)", {-1, 0, 0, 0, -1, 0, 0, 0, 1}) == "");
    CHECK(defect("SE(2)", {1, 0, 3, 0, 1, 4, 0, 0, 2}) != "");
    CHECK(defect("SE(2)", {1, 0, 3, 0, 1, 4, 0, 0, 1}) == "");
    CHECK(defect("SE(2)", {2, 0, 3, 0, 2, 4, 0, 0, 1}) != "");
    CHECK(defect("SL(2)", {2, 0, 0, 1}) != "");
    CHECK(defect("SL(2)", {2, 0, 0, 0.5L}) == "");
    CHECK(defect("GL(2)", {1, 2, 2, 4}) == "det(W) != 0");
    CHECK(defect("HEIS(3)", {1, 2, 3, 0, 1, 4, 0, 0, 1}) == "");
    CHECK(defect("HEIS(3)", {1, 2, 3, 0, 1, 4, 0.5L, 0, 1}) != "");
    CHECK(defect("R^2", {1, 0, 5, 0, 1, 6, 0, 0, 1}) == "");
    CHECK(defect("SL(2) + SO(3)", {2, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0.5L}) !=
          "");
}

TEST_CASE("of large matrices orthogonality and the determinant are asked")
{
    const NamedAlgebra algebra = algebra_of_group("SO(14)").value();
    const std::vector<RealMatrix> generators = generators_of(algebra);
    RealMatrix W(14 * 14, 0);
    for (std::size_t k = 0; k < 14; ++k) W[k * 15] = k == 3 ? 2 : k == 4 ? 0.5L : 1;
    CHECK(group_defect(generators, W, 14).relation == "transpose(W)*W = 1");
    W[3 * 15] = W[4 * 15] = -1;
    CHECK(group_defect(generators, W, 14).size == 0);
    W[3 * 15] = 1;
    CHECK(group_defect(generators, W, 14).relation == "det(W) = 1");
}

TEST_CASE("groups bear the names of their algebras in capitals")
{
    CHECK(algebra_of_group("SO(3) + R^2").value().name == "so(3) + R^2");
    CHECK(algebra_of_group("SO(2,1)").value().basis.size() == 3);
    CHECK_FALSE(algebra_of_group("so(3)").has_value());
    CHECK_FALSE(algebra_of_group("SO3").has_value());
    CHECK_FALSE(algebra_of_group("Heis(3)").has_value());
    for (const std::string& name : named_group_names()) CHECK(algebra_of_group(name).has_value());
}

TEST_CASE("logarithms of exponentials are what they came from, and half turns have none")
{
    const RealMatrix A{0.3L, -1.1L, 0.2L, 0.9L, -0.4L, 0.7L, -0.5L, 0.1L, 0.25L};
    const auto found = principal_logarithm(exponential(A, 3), 3);
    REQUIRE(found);
    for (std::size_t k = 0; k < 9; ++k) CHECK(std::abs((*found)[k] - A[k]) < 1e-17L);
    CHECK_FALSE(principal_logarithm({-1, 0, 0, 0, -1, 0, 0, 0, 1}, 3));
    CHECK_FALSE(principal_logarithm({1, 0, 0, 0}, 2));
    CHECK_FALSE(cayley_size({-1, 0, 0, -1}, 2) < 1e100L);
    const long double c = std::cos(1.2L), z = std::sin(1.2L);
    CHECK(std::abs(cayley_size({c, -z, z, c}, 2) - 2 * std::tan(0.6L)) < 1e-18L);
}

TEST_CASE("a logarithm beside the span of the generators tells what the relations leave")
{
    const auto turned = [](long double a, long double b) {
        return RealMatrix{std::cos(a), -std::sin(a), 0, 0, std::sin(a), std::cos(a), 0, 0, 0, 0,
                          std::cos(b), -std::sin(b), 0, 0, std::sin(b), std::cos(b)};
    };
    const std::vector<RealMatrix> line{{0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 0, -2, 0, 0, 2, 0}};
    CHECK(group_defect(line, turned(0.1L, 0.5L), 4).size < 1e-15L);
    CHECK(logarithm_defect(line, turned(0.1L, 0.2L), 4).size < 1e-15L);
    CHECK(logarithm_defect(line, turned(0.1L, 0.5L), 4).size > 0.1L);
}
