// SPDX-License-Identifier: GPL-2.0-or-later
/// The matrix functions at random points against Eigen.
#include "closing.hpp"
#include "parsing.hpp"

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <random>

using namespace lagen;
using namespace lagen::test;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

constexpr double roundoff = 1e-13; ///< some hundred operations on numbers of size 1, in units of 2e-16

/// Values for every symbol of array_scope.
class RandomPoint {
  public:
    explicit RandomPoint(unsigned seed) : random_(seed)
    {
        for (const char* name : {"a", "b", "c", "s"}) point[name] = next();
        for (const char* name : {"u", "v", "w"}) fill(name, {Rank::vector, 3, 1});
        for (const char* name : {"A", "B"}) fill(name, {Rank::matrix, 3, 3});
    }

    [[nodiscard]] Vector3d vector(const std::string& name) const
    {
        Vector3d result;
        for (int k = 0; k < 3; ++k)
            result[k] = point.at(entry_name(name, {Rank::vector, 3, 1}, static_cast<std::size_t>(k)));
        return result;
    }
    [[nodiscard]] Matrix3d matrix(const std::string& name) const
    {
        Matrix3d result;
        for (int k = 0; k < 9; ++k)
            result(k / 3, k % 3) = point.at(entry_name(name, {Rank::matrix, 3, 3}, static_cast<std::size_t>(k)));
        return result;
    }

    Point point;

  private:
    double next() { return static_cast<double>(static_cast<int>(random_() % 129) - 64) / 61; }
    void fill(const std::string& name, const Shape& shape)
    {
        for (std::size_t k = 0; k < shape.size(); ++k) point[entry_name(name, shape, k)] = next();
    }

    std::mt19937 random_;
};

Matrix3d hat(const Vector3d& v)
{
    Matrix3d result;
    result << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0;
    return result;
}

/// By its series, which is another route than Rodrigues' formula.
Matrix3d exponential(const Matrix3d& a)
{
    Matrix3d term = Matrix3d::Identity();
    Matrix3d sum = term;
    for (int k = 1; k < 60; ++k) {
        term = term * a / k;
        sum += term;
    }
    return sum;
}

Matrix3d cayley(const Matrix3d& a)
{
    const Matrix3d one = Matrix3d::Identity();
    return (one - a / 2).fullPivLu().solve(one + a / 2);
}

struct Law {
    const char* text;
    std::function<Eigen::MatrixXd(const RandomPoint&)> expected;
};

Eigen::MatrixXd one_by_one(double value)
{
    return Eigen::MatrixXd::Constant(1, 1, value);
}

const std::vector<Law>& laws()
{
    using P = const RandomPoint&;
    static const std::vector<Law> all{
        {"dot(u, A*v)",
         [](P p) -> Eigen::MatrixXd { return one_by_one(p.vector("u").dot(p.matrix("A") * p.vector("v"))); }},
        {"cross(u, v) + 2*hat(u)*w",
         [](P p) -> Eigen::MatrixXd { return p.vector("u").cross(p.vector("v") + 2 * p.vector("w")); }},
        {"norm(u - v)", [](P p) -> Eigen::MatrixXd { return one_by_one((p.vector("u") - p.vector("v")).norm()); }},
        {"tr(A*B)", [](P p) -> Eigen::MatrixXd { return one_by_one((p.matrix("A") * p.matrix("B")).trace()); }},
        {"det(A + B)",
         [](P p) -> Eigen::MatrixXd { return one_by_one((p.matrix("A") + p.matrix("B")).determinant()); }},
        {"transpose(A)*B", [](P p) -> Eigen::MatrixXd { return p.matrix("A").transpose() * p.matrix("B"); }},
        {"A*B*A*v",
         [](P p) -> Eigen::MatrixXd { return p.matrix("A") * p.matrix("B") * p.matrix("A") * p.vector("v"); }},
        {"u*transpose(v)", [](P p) -> Eigen::MatrixXd { return p.vector("u") * p.vector("v").transpose(); }},
        {"A^5",
         [](P p) -> Eigen::MatrixXd {
             const Matrix3d square = p.matrix("A") * p.matrix("A");
             return square * square * p.matrix("A");
         }},
        {"inverse(3*identity(3) + A)*B*v",
         [](P p) -> Eigen::MatrixXd {
             return (3 * Matrix3d::Identity() + p.matrix("A")).fullPivLu().solve(p.matrix("B") * p.vector("v"));
         }},
        {"(3*identity(3) + A)^-2",
         [](P p) -> Eigen::MatrixXd {
             const Matrix3d inverse = (3 * Matrix3d::Identity() + p.matrix("A")).inverse();
             return inverse * inverse;
         }},
        {"transpose(inverse(3*identity(3) + A))",
         [](P p) -> Eigen::MatrixXd { return (3 * Matrix3d::Identity() + p.matrix("A")).inverse().transpose(); }},
        {"diag(u)*A", [](P p) -> Eigen::MatrixXd { return p.vector("u").asDiagonal() * p.matrix("A"); }},
        {"exp(hat(u))", [](P p) -> Eigen::MatrixXd { return exponential(hat(p.vector("u"))); }},
        {"exp(-a*hat(u) + hat(v)/2)",
         [](P p) -> Eigen::MatrixXd { return exponential(hat(-p.point.at("a") * p.vector("u") + p.vector("v") / 2)); }},
        {"exp(A - transpose(A))",
         [](P p) -> Eigen::MatrixXd { return exponential(p.matrix("A") - p.matrix("A").transpose()); }},
        {"cay(hat(u))", [](P p) -> Eigen::MatrixXd { return cayley(hat(p.vector("u"))); }},
        {"cay(A/4)", [](P p) -> Eigen::MatrixXd { return cayley(p.matrix("A") / 4); }},
        {"exp(hat(s))", [](P p) -> Eigen::MatrixXd { return Eigen::Rotation2Dd(p.point.at("s")).toRotationMatrix(); }},
        {"cay(hat(s))",
         [](P p) -> Eigen::MatrixXd {
             return Eigen::Rotation2Dd(2 * std::atan(p.point.at("s") / 2)).toRotationMatrix();
         }},
    };
    return all;
}

} // namespace

TEST_CASE("the functions of matrices have Eigen's values at random points")
{
    const Scope scope = array_scope();
    for (const Law& law : laws()) {
        const ArrayValue closed = scope.close_array(parse(law.text));
        for (unsigned seed = 1; seed <= 20; ++seed) {
            const RandomPoint at(seed);
            const Eigen::MatrixXd expected = law.expected(at);
            INFO(law.text << " at point " << seed);
            REQUIRE(closed.shape.rows == static_cast<std::size_t>(expected.rows()));
            REQUIRE(closed.shape.columns == static_cast<std::size_t>(expected.cols()));
            REQUIRE(expected.norm() > 1e-3);
            double error = 0;
            for (std::size_t k = 0; k < closed.entries.size(); ++k) {
                const auto row = static_cast<Eigen::Index>(k / closed.shape.columns);
                const auto column = static_cast<Eigen::Index>(k % closed.shape.columns);
                error = std::max(error, std::abs(value_at(closed.entries[k], at.point) - expected(row, column)));
            }
            CHECK(error < roundoff * (10 + expected.norm()));
        }
    }
}

TEST_CASE("determinants of any size up to 8 are Eigen's")
{
    std::mt19937 random(5);
    for (std::size_t n = 1; n <= 8; ++n) {
        Eigen::MatrixXd matrix(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
        std::string text = "det([";
        for (std::size_t i = 0; i < n; ++i) {
            text += i == 0 ? "[" : ", [";
            for (std::size_t j = 0; j < n; ++j) {
                const int entry = static_cast<int>(random() % 19) - 9;
                matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = entry;
                text += (j == 0 ? "" : ", ") + std::to_string(entry);
            }
            text += "]";
        }
        const double value = value_at(Scope().close(parse(text + "])")), {});
        CHECK(value == Approx(matrix.determinant()).epsilon(1e-11));
    }
}

TEST_CASE("what is printed of random arrays and sums has their values")
{
    const std::vector<std::string> pieces{"u",
                                          "A*u",
                                          "(u + v)",
                                          "2*w",
                                          "cross(u, w)",
                                          "[a, b, c]",
                                          "hat(v)*u",
                                          "inverse(9*identity(3) + A)*v",
                                          "sum(i, 1, 3, u[i]*A*w)",
                                          "-v/3",
                                          "exp(hat(u))*v",
                                          "(A*B)*v",
                                          "[u[1], v[2], A[3,1]]"};
    const std::vector<std::string> forms{"dot({}, {})",
                                         "({} - {})[2]",
                                         "sum(k, 1, 3, ({})[k]*({})[k]^2)",
                                         "product(k, 2, 3, [k, 1, 2][k] + ({} + {})[k])",
                                         "norm({} + 2*{})",
                                         "det([{}, {}, [1, 2, 4]])",
                                         "tr([[1, 2, 3], {}, {}])"};
    const Scope scope = array_scope();
    std::mt19937 random(11);
    for (int k = 0; k < 400; ++k) {
        std::string text = forms[random() % forms.size()];
        while (text.find("{}") != std::string::npos) text.replace(text.find("{}"), 2, pieces[random() % pieces.size()]);
        INFO(text);
        const Tree parsed = parse(text);
        const Tree closed = scope.close(parsed);
        CHECK(same_tree(parse(to_text(parsed)), parse(to_text(parse(to_text(parsed))))));
        const RandomPoint at(static_cast<unsigned>(k));
        const double expected = value_at(closed, at.point);
        const double tolerance = 1e-10 * (1 + std::abs(expected));
        CHECK(std::abs(value_at(scope.close(parse(to_text(parsed))), at.point) - expected) < tolerance);
        CHECK(std::abs(value_at(scope.close(parse(to_text(closed))), at.point) - expected) < tolerance);
    }
}
