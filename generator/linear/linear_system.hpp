// SPDX-License-Identifier: GPL-2.0-or-later
/// Linear equations s' = A s + B u in numbers, s of n entries and u of m, on the leaf N^T s = 0 that their motions
/// keep.
///
/// A rank counts singular values above 1e-9 of the largest, in units in which A is balanced, each row beside its own
/// terms and the columns of B and N of length 1: units of states, times and inputs are nothing. [Hautus 1969; Sontag
/// 1998]
#pragma once

#include <Eigen/Dense>

#include <complex>
#include <vector>

namespace lagen::linear {

using Matrix = Eigen::MatrixXd;
using Eigenvalue = std::complex<double>;

/// Of a square matrix, by real, then by imaginary parts; none where an entry is no finite number, or they are not
/// found.
[[nodiscard]] std::vector<Eigenvalue> eigenvalues(const Matrix& A);

struct LinearSystem {
    Matrix A, B;           ///< shapes (n, n), (n, m)
    Matrix leaf;           ///< T, shape (n, k): an orthonormal basis of the leaf
    Matrix normal;         ///< N, shape (n, n - k): one of what is orthogonal to it
    Eigen::VectorXd units; ///< of the states, powers of 2 that balance A

    [[nodiscard]] double size() const; ///< |A|, 1 of 0
    /// A basis of the leaf, shape (n, k), orthonormal in these units.
    [[nodiscard]] Matrix balanced_leaf() const;

    /// Hautus' tests at an eigenvalue of A: rank [(A - lambda) T, B, N] = n says that the inputs reach its modes on the
    /// leaf, rank [(A - lambda) T; Q T] = k that the weight Q, semidefinite, sees them.
    [[nodiscard]] bool is_reached(Eigenvalue lambda) const;
    [[nodiscard]] bool is_seen(Eigenvalue lambda, const Matrix& Q) const;
};

/// `slopes`: of functions whose zero set the leaf is, by rows, shape (any, n).
[[nodiscard]] LinearSystem linear_system(Matrix A, Matrix B, const Matrix& slopes);

/// An eigenvalue, as the mean of `multiplicity` ones that are equal but for rounding, no farther from it than `spread`.
struct MultipleEigenvalue {
    Eigenvalue value;
    std::size_t multiplicity = 1;
    double spread = 0;
};

struct Mode {
    Eigenvalue eigenvalue;
    std::size_t multiplicity = 0;
    double spread = 0;
    std::vector<Eigen::VectorXcd> eigenvectors; ///< independent ones; the largest entry of each is 1
    bool reached = true;                        ///< by the inputs, on the leaf

    [[nodiscard]] double frequency() const { return std::abs(eigenvalue); }           ///< |lambda|
    [[nodiscard]] double damping() const { return -eigenvalue.real() / frequency(); } ///< not of 0
};

/// The modes of A by all its eigenvalues, in their order.
[[nodiscard]] std::vector<Mode> modes_of(const LinearSystem& system,
                                         const std::vector<MultipleEigenvalue>& eigenvalues);

} // namespace lagen::linear
