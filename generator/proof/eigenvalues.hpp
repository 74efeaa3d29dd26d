// SPDX-License-Identifier: GPL-2.0-or-later
/// Eigenvalues of matrices of balls with their multiplicities, which always add up to the number of rows.
///
/// A is split into its irreducible blocks, each balanced by powers of two; QR in many bits gives approximations. Those
/// of a Jordan block of k rows miss their eigenvalue by about (rounding)^(1/k) |A|, while their mean m and the
/// coefficients of prod (x - lambda_i) are as good as A itself. So eigenvalues are one, m with multiplicity k, where
///   prod (x + m - lambda_i) = x^k      to within rounding, in units of |A|.        [Kato 1966, II.2; Osborne 1960]
#pragma once

#include "proof/ball_matrix.hpp"

namespace lagen::proof {

struct Eigenvalue {
    double real = 0, imaginary = 0;
    std::size_t multiplicity = 1;
    double spread = 0;    ///< what it is the mean of lies no farther from it than this
    bool certain = false; ///< the real part lies between these bounds
    double least = 0, most = 0;
};

/// All of a square matrix of real entries, by real parts, then imaginary ones; those that are not real in pairs.
/// `rounding` is how well A is known, in units of its norm: parts below 16 times that are 0.
[[nodiscard]] std::vector<Eigenvalue> eigenvalues(const BallMatrix& A, slong precision, double rounding);

} // namespace lagen::proof
