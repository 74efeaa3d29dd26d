// SPDX-License-Identifier: GPL-2.0-or-later
#include "linear/linear_system.hpp"

#include <algorithm>
#include <cmath>

namespace lagen::linear {

namespace {

using Complex = Eigen::MatrixXcd;

constexpr double rank_tolerance = 1e-9;
constexpr double least_threshold = 1e-11; ///< of a pivot that is 0, relative to the largest

/// True where the rank of M is the smaller of its dimensions. The real matrix of twice the size that M is written as
/// has each of its singular values twice.
bool has_full_rank(const Complex& M)
{
    if (M.size() == 0) return true;
    Matrix twice(2 * M.rows(), 2 * M.cols());
    twice << M.real(), -M.imag(), M.imag(), M.real();
    const Eigen::VectorXd values = Eigen::JacobiSVD<Matrix>(twice).singularValues();
    return values.minCoeff() > rank_tolerance * values.maxCoeff();
}

/// Powers of 2 d with which rows and columns of diag(d)^-1 A diag(d) are of one size. [Parlett and Reinsch 1969]
Eigen::VectorXd balance(Matrix A)
{
    Eigen::VectorXd units = Eigen::VectorXd::Ones(A.rows());
    for (bool changed = A.allFinite(); changed;) {
        changed = false;
        for (Eigen::Index k = 0; k < A.rows(); ++k) {
            const double diagonal = std::abs(A(k, k)), column = A.col(k).lpNorm<1>() - diagonal,
                         row = A.row(k).lpNorm<1>() - diagonal;
            if (!(column > 0 && row > 0)) continue;
            const double factor = std::exp2(std::round(std::log2(row / column) / 2));
            if (!(column * factor + row / factor < 0.9 * (column + row))) continue;
            A.col(k) *= factor, A.row(k) /= factor, units[k] *= factor;
            changed = true;
        }
    }
    return units;
}

Complex shifted(const LinearSystem& system, Eigenvalue lambda)
{
    Complex M = system.A.cast<Eigenvalue>();
    M.diagonal().array() -= lambda;
    return M;
}

/// (A - lambda) T in the units of the system, T an orthonormal basis of the leaf there; `rows` has what divides rows so
/// that each is beside the size of what it is a sum of: what rounding leaves of a row that vanishes stays small.
struct Pencil {
    Complex values;       ///< diag(rows) (A - lambda) basis
    Matrix basis;         ///< D T
    Eigen::VectorXd rows; ///< of vectors
};

Pencil pencil(const LinearSystem& system, Eigenvalue lambda)
{
    const auto& D = system.units;
    Pencil out{{}, system.balanced_leaf(), {}};
    out.rows = (system.A * D.asDiagonal()).cwiseAbs().rowwise().sum() + std::abs(lambda) * D;
    for (double& row : out.rows) row = row > 0 ? 1 / row : 1;
    out.values = out.rows.asDiagonal() * shifted(system, lambda) * out.basis;
    return out;
}

/// Columns of length 1, but those that are 0.
Complex unit_columns(Matrix M)
{
    for (Eigen::Index k = 0; k < M.cols(); ++k) M.col(k).normalize();
    return M.cast<Eigenvalue>();
}

/// The first of the entries that are largest becomes 1; what is nothing beside it becomes 0.
Eigen::VectorXcd normalised(Eigen::VectorXcd v)
{
    const double largest = v.cwiseAbs().maxCoeff();
    Eigen::Index first = 0;
    while (std::abs(v[first]) < (1 - 1e-9) * largest) ++first;
    v /= Eigenvalue(v[first]);
    for (Eigenvalue& entry : v) {
        const auto clean = [](double x) { return std::abs(x) < 1e-12 ? 0.0 : x; };
        entry = {clean(entry.real()), clean(entry.imag())};
    }
    return v;
}

/// M, its rows and columns divided by their largest entries, so that what is small is so beside its own equation.
Eigen::VectorXd equilibrate(Complex& M)
{
    Eigen::VectorXd columns = Eigen::VectorXd::Ones(M.cols());
    for (int sweep = 0; sweep < 3; ++sweep) {
        for (Eigen::Index i = 0; i < M.rows(); ++i)
            if (const double size = M.row(i).cwiseAbs().maxCoeff(); size > 0) M.row(i) /= size;
        for (Eigen::Index j = 0; j < M.cols(); ++j)
            if (const double size = M.col(j).cwiseAbs().maxCoeff(); size > 0) M.col(j) /= size, columns[j] /= size;
    }
    return columns;
}

/// One at least and no more than the eigenvalue has multiplicity.
std::vector<Eigen::VectorXcd> eigenvectors(const LinearSystem& system, const MultipleEigenvalue& each)
{
    Complex M = shifted(system, each.value);
    for (Eigen::Index k = 0; k < M.rows(); ++k) // a diagonal entry that is the eigenvalue but for its last digit
        if (std::abs(M(k, k)) <= 4e-16 * std::abs(each.value)) M(k, k) = 0;
    const Eigen::VectorXd columns = equilibrate(M);
    Eigen::FullPivLU<Complex> lu(M);
    for (double threshold = least_threshold; threshold < 1; threshold *= 10) {
        lu.setThreshold(threshold);
        if (lu.dimensionOfKernel() > 0) break;
    }
    const Complex kernel = lu.kernel();
    std::vector<Eigen::VectorXcd> out;
    for (Eigen::Index k = 0; k < kernel.cols() && out.size() < each.multiplicity; ++k)
        out.push_back(normalised(columns.cast<Eigenvalue>().cwiseProduct(kernel.col(k))));
    return out;
}

} // namespace

LinearSystem linear_system(Matrix A, Matrix B, const Matrix& slopes)
{
    const Eigen::Index n = A.rows();
    Eigen::VectorXd units = balance(A);
    LinearSystem system{std::move(A), std::move(B), Matrix::Identity(n, n), Matrix(n, 0), std::move(units)};
    if (slopes.rows() == 0) return system;
    Eigen::JacobiSVD<Matrix> svd(slopes, Eigen::ComputeFullV);
    svd.setThreshold(rank_tolerance);
    system.normal = svd.matrixV().leftCols(svd.rank());
    system.leaf = svd.matrixV().rightCols(n - svd.rank());
    return system;
}

std::vector<Eigenvalue> eigenvalues(const Matrix& A)
{
    if (A.size() == 0 || !A.allFinite()) return {};
    const Eigen::EigenSolver<Matrix> solver(A, false);
    if (solver.info() != Eigen::Success) return {};
    std::vector<Eigenvalue> out(solver.eigenvalues().begin(), solver.eigenvalues().end());
    std::ranges::sort(out, [](const Eigenvalue& a, const Eigenvalue& b) {
        return a.real() != b.real() ? a.real() < b.real() : a.imag() < b.imag();
    });
    return out;
}

double LinearSystem::size() const
{
    const double norm = A.norm();
    return norm > 0 ? norm : 1;
}

Matrix LinearSystem::balanced_leaf() const
{
    const Matrix scaled = units.cwiseInverse().asDiagonal() * leaf;
    Matrix basis = Matrix::Identity(leaf.rows(), leaf.cols());
    if (scaled.size() > 0) basis.applyOnTheLeft(scaled.householderQr().householderQ());
    return units.asDiagonal() * basis;
}

bool LinearSystem::is_reached(Eigenvalue lambda) const
{
    const auto [values, basis, rows] = pencil(*this, lambda);
    Complex M(A.rows(), values.cols() + B.cols() + normal.cols());
    M << values, unit_columns(rows.asDiagonal() * B), unit_columns(rows.asDiagonal() * normal);
    return has_full_rank(M);
}

bool LinearSystem::is_seen(Eigenvalue lambda, const Matrix& Q) const
{
    const auto [values, basis, rows] = pencil(*this, lambda);
    Complex M(2 * A.rows(), leaf.cols());
    M << values, unit_columns((Q * basis).transpose()).transpose();
    return has_full_rank(M);
}

std::vector<Mode> modes_of(const LinearSystem& system, const std::vector<MultipleEigenvalue>& eigenvalues)
{
    std::vector<Mode> modes;
    for (const MultipleEigenvalue& each : eigenvalues)
        modes.push_back(
            {each.value, each.multiplicity, each.spread, eigenvectors(system, each), system.is_reached(each.value)});
    return modes;
}

} // namespace lagen::linear
