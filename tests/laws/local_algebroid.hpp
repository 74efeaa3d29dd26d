// SPDX-License-Identifier: GPL-2.0-or-later
/// Lie algebroids over formulas, and what one makes of others: frames, coordinates, products, prolongations. Every
/// function here keeps a valid algebroid valid.
#pragma once

#include "formula.hpp"
#include "support/dice.hpp"

#include <string>
#include <vector>

namespace lagen::laws {

using testing::Dice;

/// coordinate = value, or -value where `either_sign`, solves a constraint.
struct SolvedCoordinate {
    std::string coordinate;
    Formula value;
    bool either_sign;
};

/// [e_b, e_a] written out beside [e_a, e_b]; entries c < r.
struct SecondOrder {
    std::size_t a, b;
    std::vector<Formula> entries;
};

struct LocalAlgebroid {
    std::vector<std::string> parameters, base, fibre;
    std::vector<Formula> rho; ///< rho(e_a) = rho^i_a d/dx^i; shape (n, r)
    std::vector<Formula> C;   ///< [e_a, e_b] = C^c_ab e_c; shape (r, r, r), antisymmetric in a, b
    std::vector<Formula> constraints;
    std::vector<SolvedCoordinate> solved; ///< one a constraint: where points on it come from
    std::vector<Formula> positive;        ///< the domain: each is > 0
    std::vector<SecondOrder> second_orders;

    LocalAlgebroid() = default;
    /// rho = 0 and C = 0
    LocalAlgebroid(std::vector<std::string> base_names, std::vector<std::string> fibre_names);

    [[nodiscard]] std::size_t n() const { return base.size(); }
    [[nodiscard]] std::size_t r() const { return fibre.size(); }
    [[nodiscard]] Formula& anchor(std::size_t i, std::size_t a) { return rho[i * r() + a]; }
    [[nodiscard]] const Formula& anchor(std::size_t i, std::size_t a) const { return rho[i * r() + a]; }
    [[nodiscard]] const Formula& bracket(std::size_t c, std::size_t a, std::size_t b) const
    {
        return C[(c * r() + a) * r() + b];
    }
    /// Sets C^c_ab and C^c_ba.
    void set_bracket(std::size_t c, std::size_t a, std::size_t b, const Formula& value);
    void add_to_bracket(std::size_t c, std::size_t a, std::size_t b, const Formula& value)
    {
        set_bracket(c, a, b, bracket(c, a, b) + value);
    }
    [[nodiscard]] Formula coordinate(std::size_t i) const { return Formula::variable(base[i]); }
    /// rho(e_a) f
    [[nodiscard]] Formula along(std::size_t a, const Formula& f) const;
};

/// {prefix + "1", ..}
[[nodiscard]] std::vector<std::string> numbered(const std::string& prefix, std::size_t count);

/// e'_a = A_a^b e_b and its inverse, both (r, r) by rows.
struct Frame {
    std::vector<Formula> A, inverse;
};

/// C'^c_ab = (A^-1)_d^c [ A_a^p A_b^q C^d_pq + rho'_a(A_b^d) - rho'_b(A_a^d) ],  rho'_a = A_a^b rho_b
[[nodiscard]] LocalAlgebroid in_frame(const LocalAlgebroid& old, const Frame& frame);

/// The coordinate i is replaced by u = forward(x); backward is x^i as a formula in u (called x^i) and the others.
[[nodiscard]] LocalAlgebroid in_coordinate(const LocalAlgebroid& old, std::size_t i, const Formula& forward,
                                           const Formula& backward);

/// Coordinates and sections of the second are renamed: those of the product are x1, .. and e1, ...
[[nodiscard]] LocalAlgebroid direct_product(const LocalAlgebroid& one, const LocalAlgebroid& two);

/// T^E E, or T^E E* where `dual`: base (x, z_a), sections X_a with rho_a and C^c_ab, V_a with d/dz_a.
[[nodiscard]] LocalAlgebroid prolongation(const LocalAlgebroid& old, bool dual);

/// TQ/G in a local trivialisation, the horizontal frame e_i - A_i^c e_c: algebra constants c^c_ab as C of `structure`
/// (n = 0), connection[i * s + c] = A_i^c over the coordinates `base`:
///   [e_i, e_j] = -F^c_ij e_c,  F_ij = d_i A_j - d_j A_i - [A_i, A_j],  [e_i, e_b] = -A_i^a c^c_ab e_c
[[nodiscard]] LocalAlgebroid atiyah(const LocalAlgebroid& structure, const std::vector<std::string>& base,
                                    const std::vector<Formula>& connection);

} // namespace lagen::laws
