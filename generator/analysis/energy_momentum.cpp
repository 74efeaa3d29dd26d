// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/energy_momentum.hpp"

#include "geometry/orthonormal_span.hpp"
#include "geometry/rational_near.hpp"
#include "graph/calculus/differentiate.hpp"
#include "proof/rational_matrix.hpp"

#include <algorithm>
#include <cmath>

namespace lagen {

using proof::Ball;
using proof::BallMatrix;

namespace {

constexpr slong full_bits = AugmentedEnergy::precision;
constexpr double nearly = 1e-5; ///< of what may be 0, of differentials that may be dependent: judged, then certified

OrthonormalSpan::Vector vector_of(const Doubles& v)
{
    return {v.begin(), v.end()};
}

Doubles doubles_of(const OrthonormalSpan::Vector& v)
{
    Doubles out;
    for (const long double each : v) out.push_back(static_cast<double>(each));
    return out;
}

/// The least eigenvalue of the middle of a symmetric matrix.
double least_eigenvalue(const BallMatrix& A)
{
    BallMatrix middle(A.rows, A.columns);
    for (std::size_t i = 0; i < A.rows; ++i)
        for (std::size_t j = 0; j < A.columns; ++j)
            middle.at(i, j) = exact_ball((A.at(i, j).middle() + A.at(j, i).middle()) / 2);
    return proof::eigenvalues(middle, 64, 0x1p-50).front().real;
}

} // namespace

EquilibriumCertificate::EquilibriumCertificate(Graph& graph, const AugmentedEnergy& energy,
                                               const std::vector<ConservedFunction>& conserved, bool commuting,
                                               std::function<bool(NodeId)> is_zero)
    : graph_(graph), energy_(energy), conserved_(conserved), commuting_(commuting), is_zero_(std::move(is_zero))
{
}

/// S and the flows, by what is independent at z.
void EquilibriumCertificate::choose(const std::vector<FunctionJet>& jets)
{
    OrthonormalSpan span(nearly);
    for (std::size_t i = 0; i < conserved_.size(); ++i)
        if (span.add(vector_of(middles(jets[i + 1].slope)))) chosen_.push_back(i);
    for (std::size_t i = 0; i < conserved_.size(); ++i) {
        if (conserved_[i].flowless) continue;
        const OrthonormalSpan::Vector flow = vector_of(middles(jets[i + 1].flow));
        if (!(length_of(flow) > nearly) || !span.add(flow)) continue;
        directions_.push_back(doubles_of(span[span.size() - 1]));
        flows_.push_back(i);
    }
}

/// Those near 0 whose equations hold identically where all of them are 0.
void EquilibriumCertificate::take_out_zeros(const Doubles& z)
{
    zero_.assign(z.size(), false);
    for (std::size_t k = 0; k < z.size(); ++k) zero_[k] = std::fabs(z[k]) < nearly;
    for (bool changed = true; changed;) {
        changed = false;
        Replacements zeros;
        for (std::size_t k = 0; k < z.size(); ++k)
            if (zero_[k]) zeros.emplace_back(energy_.z()[k], graph_.constant(0));
        for (std::size_t k = 0; k < z.size() && !changed; ++k) {
            if (!zero_[k]) continue;
            std::vector<NodeId> slopes{energy_.slope_node({}, k)};
            for (const std::size_t i : chosen_) slopes.push_back(energy_.slope_node(i, k));
            const auto at_zeros = substitute_where_defined(graph_, slopes, zeros);
            if (at_zeros && std::ranges::all_of(*at_zeros, is_zero_)) continue;
            zero_[k] = false;
            changed = true;
        }
    }
    for (std::size_t k = 0; k < z.size(); ++k)
        if (!zero_[k]) free_.push_back(k);
    // A flow that leaves the zeros is no symmetry of the equations on them.
    for (std::size_t j = 0; j < directions_.size(); ++j) {
        Doubles w = directions_[j];
        bool stays = true;
        for (std::size_t k = 0; k < z.size(); ++k) {
            stays = stays && (!zero_[k] || std::fabs(w[k]) < nearly);
            if (zero_[k]) w[k] = 0;
        }
        if (!stays) continue;
        gauge_.push_back(w);
        gauge_flows_.push_back(flows_[j]);
    }
}

std::vector<Ball> EquilibriumCertificate::point(const std::vector<Ball>& u) const
{
    std::vector<Ball> z(energy_.n());
    for (std::size_t k = 0; k < free_.size(); ++k) z[free_[k]] = u[k];
    return z;
}

proof::NewtonEquations EquilibriumCertificate::equations(const std::vector<Ball>& u) const
{
    const std::size_t f = free_.size(), s = chosen_.size(), g = gauge_.size(), all = f + s + g;
    const std::vector<FunctionJet> jets = energy_.at(point(u));
    proof::NewtonEquations out{BallMatrix(all, 1), BallMatrix(all, all)};
    const auto add = [](Ball& to, const Ball& a, const Ball& b) { arb_addmul(to.get(), a.get(), b.get(), full_bits); };
    const auto subtract = [](Ball& to, const Ball& a, const Ball& b) {
        arb_submul(to.get(), a.get(), b.get(), full_bits);
    };
    for (std::size_t k = 0; k < f; ++k) {
        out.value.at(k, 0) = jets[0].slope.at(free_[k], 0);
        for (std::size_t l = 0; l < f; ++l) out.slope.at(k, l) = jets[0].curvature.at(free_[k], free_[l]);
        for (std::size_t i = 0; i < s; ++i) {
            const FunctionJet& F = jets[chosen_[i] + 1];
            const Ball& slope = F.slope.at(free_[k], 0);
            subtract(out.value.at(k, 0), u[f + i], slope);
            for (std::size_t l = 0; l < f; ++l)
                subtract(out.slope.at(k, l), u[f + i], F.curvature.at(free_[k], free_[l]));
            out.slope.at(f + i, k) = slope;
            arb_neg(out.slope.at(k, f + i).get(), slope.get());
        }
        for (std::size_t j = 0; j < g; ++j) {
            const Ball w = exact_ball(gauge_[j][free_[k]]);
            add(out.value.at(k, 0), u[f + s + j], w);
            out.slope.at(k, f + s + j) = out.slope.at(f + s + j, k) = w;
            Ball moved = u[k];
            arb_sub(moved.get(), moved.get(), exact_ball(near_[free_[k]]).get(), full_bits);
            add(out.value.at(f + s + j, 0), w, moved);
        }
    }
    for (std::size_t i = 0; i < s; ++i) {
        Ball& value = out.value.at(f + i, 0);
        arb_sub(value.get(), jets[chosen_[i] + 1].value.get(), conserved_[chosen_[i]].level.get(), full_bits);
    }
    return out;
}

/// False where no box is mapped into itself.
bool EquilibriumCertificate::certify(const Doubles& lambda)
{
    std::vector<Ball> start;
    for (const std::size_t k : free_) start.push_back(exact_ball(near_[k]));
    for (const std::size_t i : chosen_) start.push_back(exact_ball(lambda[i]));
    for (std::size_t j = 0; j < gauge_.size(); ++j) start.push_back(exact_ball(0));
    proof::RefinedRoot root = proof::refined_root([this](const std::vector<Ball>& u) { return equations(u); }, start,
                                                  free_.size(), full_bits);
    solution_ = std::move(root.z);
    return root.certified && (gauge_.empty() || (commuting_ && is_regular_gauge()));
}

/// w_k.X_j: then the gauge multipliers are 0.
bool EquilibriumCertificate::is_regular_gauge() const
{
    const std::vector<FunctionJet> jets = energy_.at(point(solution_));
    BallMatrix pairs(gauge_.size(), gauge_.size());
    for (std::size_t k = 0; k < gauge_.size(); ++k)
        for (std::size_t j = 0; j < gauge_.size(); ++j)
            for (std::size_t l = 0; l < energy_.n(); ++l)
                arb_addmul(pairs.at(k, j).get(), exact_ball(gauge_[k][l]).get(),
                           jets[gauge_flows_[j] + 1].flow.at(l, 0).get(), full_bits);
    return proof::solved(pairs, BallMatrix::identity(gauge_.size()), full_bits).has_value();
}

/// Simple fractions at which dH is exactly a combination of the dF_S, and F on its level; empty where there are none.
std::vector<Rational> EquilibriumCertificate::rational_point(const Doubles& z) const
{
    std::vector<Rational> point;
    for (const double each : z) {
        const std::optional<Rational> near = rational_near(each, 1e-14L);
        if (!near) return {};
        point.push_back(*near);
    }
    const auto functions = energy_.exactly_at(point);
    if (!functions) return {};
    for (std::size_t i = 0; i < conserved_.size(); ++i)
        if (!arb_overlaps(conserved_[i].level.get(), Ball((*functions)[i + 1][0], full_bits).get())) return {};
    const std::size_t size = std::max(energy_.n(), chosen_.size() + 1);
    const auto rank_with = [&](bool energy) {
        std::vector<Rational> rows(size * size, Rational(0));
        const auto put = [&](std::size_t row, const std::vector<Rational>& function) {
            for (std::size_t k = 0; k < energy_.n(); ++k) rows[row * size + k] = function[k + 1];
        };
        for (std::size_t i = 0; i < chosen_.size(); ++i) put(i, (*functions)[chosen_[i] + 1]);
        if (energy) put(chosen_.size(), (*functions)[0]);
        return rank_of(rows, size);
    };
    return rank_with(true) == rank_with(false) ? point : std::vector<Rational>();
}

/// Directions within ker dF_S that complete the flows: N = V - dF^T (dF dF^T)^-1 dF V, V orthonormal to both.
std::optional<BallMatrix> EquilibriumCertificate::complement(const std::vector<FunctionJet>& jets) const
{
    const std::size_t n = energy_.n();
    OrthonormalSpan span(0);
    std::vector<BallMatrix> slopes;
    for (const std::size_t i : chosen_) {
        slopes.push_back(jets[i + 1].slope);
        span.add(vector_of(middles(slopes.back())));
    }
    for (const Doubles& direction : directions_) span.add(vector_of(direction));
    std::vector<BallMatrix> columns;
    for (std::size_t k = 0; k < n; ++k) {
        OrthonormalSpan::Vector unit(n, 0);
        unit[k] = 1;
        // One that is nearly spanned is left to the others, which span the rest.
        if (!(length_of(span.outside(unit)) > 1e-3L) || !span.add(unit)) continue;
        BallMatrix& column = columns.emplace_back(n, 1);
        const Doubles direction = doubles_of(span[span.size() - 1]);
        for (std::size_t l = 0; l < n; ++l) column.at(l, 0) = exact_ball(direction[l]);
    }
    if (columns.size() + chosen_.size() + directions_.size() != n) return std::nullopt;
    const BallMatrix V = proof::joined_columns(columns, n), D = proof::joined_columns(slopes, n);
    if (slopes.empty()) return V;
    const BallMatrix Dt = proof::transposed(D);
    const auto shares = proof::solved(proof::product(Dt, D, full_bits), proof::product(Dt, V, full_bits), full_bits);
    if (!shares) return std::nullopt;
    return proof::sum(V, exact_ball(-1), proof::product(D, *shares, full_bits), full_bits);
}

/// Of H_zz - lambda_i F_i,zz on N for some lambda that leaves H_lambda critical.
void EquilibriumCertificate::find_definite(const std::vector<FunctionJet>& jets, const BallMatrix& N,
                                           RelativeEquilibrium& out) const
{
    const std::size_t f = free_.size(), s = chosen_.size();
    const auto on_N = [&](const BallMatrix& Q) {
        return proof::product(proof::transposed(N), proof::product(Q, N, full_bits), full_bits);
    };
    BallMatrix Q = jets[0].curvature;
    for (std::size_t i = 0; i < s; ++i) {
        Ball factor = solution_[f + i];
        arb_neg(factor.get(), factor.get());
        Q = proof::sum(Q, factor, jets[chosen_[i] + 1].curvature, full_bits);
    }
    const BallMatrix fixed = on_N(Q);
    // Where the chosen differentials span all free directions, the other ones are combinations of them.
    struct Combination {
        std::size_t t;
        Doubles c; // dF_t = c_i dF_i
    };
    std::vector<BallMatrix> shifts;
    std::vector<Combination> combinations;
    if (s == f)
        for (std::size_t t = 0; t < conserved_.size(); ++t) {
            if (std::ranges::find(chosen_, t) != chosen_.end()) continue;
            bool spanned = true;
            BallMatrix right(f, 1), D(f, f);
            for (std::size_t k = 0; k < energy_.n(); ++k)
                spanned = spanned && (!zero_[k] || arb_is_zero(jets[t + 1].slope.at(k, 0).get()) != 0);
            for (std::size_t k = 0; k < f; ++k) {
                right.at(k, 0) = jets[t + 1].slope.at(free_[k], 0);
                for (std::size_t i = 0; i < s; ++i) D.at(k, i) = jets[chosen_[i] + 1].slope.at(free_[k], 0);
            }
            const auto shares = spanned ? proof::solved(D, right, full_bits) : std::nullopt;
            if (!shares) continue;
            combinations.push_back({t, middles(*shares)});
            BallMatrix shift = jets[t + 1].curvature;
            for (std::size_t i = 0; i < s; ++i) {
                Ball factor = shares->at(i, 0);
                arb_neg(factor.get(), factor.get());
                shift = proof::sum(shift, factor, jets[chosen_[i] + 1].curvature, full_bits);
            }
            shifts.push_back(on_N(shift));
        }
    for (const int sign : {1, -1}) {
        Doubles shares(shifts.size(), 0.0);
        const auto form = [&](const Doubles& at) {
            BallMatrix A = fixed;
            for (std::size_t t = 0; t < shifts.size(); ++t) A = proof::sum(A, exact_ball(at[t]), shifts[t], full_bits);
            return proof::sum(BallMatrix(A.rows, A.columns), exact_ball(sign), A, full_bits);
        };
        // The least eigenvalue is concave in the shares: climb along each in steps that halve.
        double best = shifts.empty() ? 0 : least_eigenvalue(form(shares));
        for (double step = 1e3; step > 1e-6 && !shifts.empty(); step /= 1.6)
            for (std::size_t t = 0; t < shares.size(); ++t)
                for (const double change : {step, -step}) {
                    Doubles tried = shares;
                    tried[t] += change;
                    if (const double value = least_eigenvalue(form(tried)); value > best) best = value, shares = tried;
                }
        if (!proof::is_certainly_definite(form(shares), full_bits)) continue;
        out.definite = sign;
        if (std::ranges::all_of(shares, [](double share) { return share == 0; })) return;
        out.definite_at = out.multipliers;
        for (std::size_t k = 0; k < shares.size(); ++k) {
            out.definite_at[combinations[k].t] -= shares[k];
            for (std::size_t i = 0; i < s; ++i) out.definite_at[chosen_[i]] += shares[k] * combinations[k].c[i];
        }
        return;
    }
}

void EquilibriumCertificate::judge(RelativeEquilibrium& out)
{
    const std::vector<FunctionJet> jets = energy_.at(point(solution_));
    out.energy = jets[0].value.middle();
    const std::optional<BallMatrix> N = complement(jets);
    if (!N) return;
    out.dimension = N->columns;
    std::vector<BallMatrix> frame, flows;
    for (std::size_t j = 0; j < N->columns; ++j) {
        BallMatrix& column = frame.emplace_back(energy_.n(), 1);
        for (std::size_t k = 0; k < energy_.n(); ++k) column.at(k, 0) = N->at(k, j);
    }
    for (const std::size_t i : flows_) frame.push_back(jets[i + 1].flow);
    for (const std::size_t i : chosen_) frame.push_back(jets[i + 1].slope);
    BallMatrix A = jets[0].flow_slope;
    for (std::size_t i = 0; i < chosen_.size(); ++i) {
        Ball factor = solution_[free_.size() + i];
        arb_neg(factor.get(), factor.get());
        A = proof::sum(A, factor, jets[chosen_[i] + 1].flow_slope, full_bits);
    }
    const auto within =
        proof::solved(proof::joined_columns(frame, energy_.n()), proof::product(A, *N, full_bits), full_bits);
    if (!within) return;
    BallMatrix reduced(N->columns, N->columns);
    for (std::size_t i = 0; i < N->columns; ++i)
        for (std::size_t j = 0; j < N->columns; ++j) reduced.at(i, j) = within->at(i, j);
    out.eigenvalues = proof::eigenvalues(reduced, full_bits, out.certified ? 0x1p-128 : 0x1p-46);
    if (!out.certified) return;
    find_definite(jets, *N, out);
    if (out.definite != 0)
        out.stability = Stability::stable;
    else if (std::ranges::any_of(out.eigenvalues, [](const auto& each) { return each.certain && each.least > 0; }))
        out.stability = Stability::spectrally_unstable;
}

RelativeEquilibrium EquilibriumCertificate::judged(const Doubles& z, const Doubles& lambda)
{
    near_ = z;
    choose(energy_.at(exact_balls(z)));
    take_out_zeros(z);
    RelativeEquilibrium out;
    out.certified = certify(lambda);
    const std::vector<Ball> exact_z = point(solution_);
    for (std::size_t k = 0; k < z.size(); ++k) {
        out.z.push_back(exact_z[k].middle());
        out.radius = std::max(out.radius, proof::radius_of(exact_z[k]));
    }
    out.multipliers.assign(conserved_.size(), 0.0);
    for (std::size_t i = 0; i < chosen_.size(); ++i) out.multipliers[chosen_[i]] = solution_[free_.size() + i].middle();
    out.flows = flows_.size();
    out.moved.assign(z.size(), false);
    for (const std::size_t i : flows_)
        for (std::size_t k = 0; k < z.size(); ++k) out.moved[k] = out.moved[k] || energy_.moves(i, k);
    if (out.certified) out.exact = rational_point(out.z);
    judge(out);
    return out;
}

} // namespace lagen
