// SPDX-License-Identifier: GPL-2.0-or-later
#include "verify/smooth_controls.hpp"

#include "graph/core/operators.hpp"
#include "proof/enclosure.hpp"

#include <algorithm>

namespace lagen {
namespace {

constexpr slong piece_precision = 128;    ///< bits
constexpr std::size_t most_pieces = 4096; ///< of one interval
constexpr int deepest_piece = 40;         ///< halvings

/// The piece [k, k + 1] / 2^depth of an interval that is mapped to [0, 1].
struct Piece {
    mpz_class k;
    int depth;
};

/// lower + (upper - lower) w, w in the piece.
proof::Ball values_on(const Piece& piece, const proof::Ball& lower, const proof::Ball& upper)
{
    mpz_class scale = 1;
    mpz_mul_2exp(scale.get_mpz_t(), scale.get_mpz_t(), static_cast<mp_bitcnt_t>(piece.depth + 1));
    Rational middle(2 * piece.k + 1, scale);
    middle.canonicalize();
    proof::Ball value(middle, piece_precision);
    arb_add_error_2exp_si(value.get(), -static_cast<slong>(piece.depth) - 1);
    proof::Ball length;
    arb_sub(length.get(), upper.get(), lower.get(), piece_precision);
    arb_mul(value.get(), value.get(), length.get(), piece_precision);
    arb_add(value.get(), value.get(), lower.get(), piece_precision);
    return value;
}

/// Linear systems as a whole; their factorisation tells.
bool is_partial(const Graph& graph, NodeId node)
{
    return kind_of(graph.op(node)) == OpKind::system || domain_of(graph, node) != Sense::always;
}

} // namespace

ControlProofs::ControlProofs(Graph& graph, const ControlProblem& control, const ProofSetting& setting,
                             const ProofBudget& budget)
    : graph_(graph), control_(control), setting_(setting)
{
    setting_.defined.clear();
    for (const NodeId node : setting.defined) {
        if (!depends_on_controls(node)) {
            setting_.defined.push_back(node);
            continue;
        }
        // What is free of controls in it is defined along every motion.
        const std::vector<NodeId> needed = reachable(graph_, std::vector<NodeId>{node});
        const bool branches = std::ranges::any_of(needed, [&](NodeId id) { return graph_.op(id) == Op::select; });
        for (const NodeId part : needed)
            if (!branches && is_partial(graph_, part) && !depends_on_controls(part)) setting_.defined.push_back(part);
    }
    for (std::size_t k = 0; k < control.u.size(); ++k) {
        if (control.lower[k]) setting_.domain.push_back(graph_.apply(Op::less_equal, *control.lower[k], control.u[k]));
        if (control.upper[k]) setting_.domain.push_back(graph_.apply(Op::less_equal, control.u[k], *control.upper[k]));
    }
    decider_ = std::make_unique<ZeroDecider>(graph_, setting_, budget);
}

bool ControlProofs::depends_on_controls(NodeId node) const
{
    for (std::size_t id = moves_.size(); id <= node; ++id) {
        const auto next = static_cast<NodeId>(id);
        const auto operands = graph_.operands(next);
        moves_.push_back(std::ranges::count(control_.u, next) > 0 ||
                         std::ranges::any_of(operands, [&](NodeId operand) { return moves_[operand]; }));
    }
    return moves_[node];
}

bool ControlProofs::positive_on_pieces(NodeId value) const
{
    const proof::Evaluation evaluation(graph_, {value});
    if (evaluation.inputs().size() != 1) return false;
    const auto at = std::ranges::find(control_.u, evaluation.inputs()[0]);
    if (at == control_.u.end()) return false;
    const auto k = static_cast<std::size_t>(at - control_.u.begin());
    if (!control_.lower[k] || !control_.upper[k]) return false;
    const proof::Evaluation bounds(graph_, {*control_.lower[k], *control_.upper[k]});
    if (!bounds.inputs().empty()) return false;
    const std::vector<proof::Ball> ends = bounds.enclose({}, piece_precision);
    if (!ends[0].is_finite() || !ends[1].is_finite()) return false;
    std::vector<Piece> open{{0, 0}};
    for (std::size_t count = 0; !open.empty(); ++count) {
        if (count == most_pieces) return false;
        const Piece piece = open.back();
        open.pop_back();
        const proof::BallInputs inputs{{*at, values_on(piece, ends[0], ends[1])}};
        if (evaluation.enclose(inputs, piece_precision)[0].is_positive()) continue;
        if (piece.depth == deepest_piece) return false;
        open.push_back({2 * piece.k, piece.depth + 1});
        open.push_back({2 * piece.k + 1, piece.depth + 1});
    }
    return true;
}

bool ControlProofs::positive(NodeId value) const
{
    return decider_->proves_positive(value) || positive_on_pieces(value);
}

bool ControlProofs::nonzero(NodeId value) const
{
    return decider_->proves_nonzero(value) || positive_on_pieces(value) || positive_on_pieces(graph_.negate(value));
}

bool ControlProofs::zero(NodeId value) const
{
    if (graph_.is_constant(value)) return graph_.is_zero(value);
    return decider_->status(value) == ProofStatus::proved;
}

std::string ControlProofs::kink_in(const std::vector<NodeId>& roots)
{
    for (const NodeId node : reachable(graph_, roots)) {
        const std::vector<NodeId> operands(graph_.operands(node).begin(), graph_.operands(node).end());
        const auto unless = [&](NodeId turning) {
            if (!depends_on_controls(turning) || nonzero(turning)) return std::string();
            return to_text(graph_, node, 60) + ", where " + to_text(graph_, turning, 60) +
                   " was not proved to keep its sign";
        };
        std::string found;
        switch (operator_of(graph_.op(node)).smoothness) {
        case Smoothness::kinked:
        case Smoothness::stepped: found = unless(condition_of(graph_, node)); break;
        case Smoothness::cut: // jumps across v = 0, w < 0
            if (depends_on_controls(node) && !positive(operands[1]) && !nonzero(operands[0]))
                found = to_text(graph_, node, 60) + ", which was not proved to keep off its cut";
            break;
        case Smoothness::chosen: found = unless(operands[0]); break;
        case Smoothness::meromorphic: // partial_in
        case Smoothness::analytic:
        case Smoothness::system: break;
        }
        if (!found.empty()) return found;
    }
    return {};
}

/// Whether the operation is defined, with all its derivatives, for all admissible controls; kinks and cuts are told by
/// kink_in().
bool ControlProofs::is_smooth(NodeId node)
{
    const Sense sense = smooth_where(graph_, node);
    switch (sense) {
    case Sense::always: // of a solution the factorisation tells
    case Sense::off_origin:
    case Sense::off_cut:
    case Sense::same_branch: return true;
    case Sense::regular: return !depends_on_controls(node);
    case Sense::nonzero:
    case Sense::nonnegative:
    case Sense::positive: break;
    }
    const NodeId condition = condition_of(graph_, node);
    const bool moves = depends_on_controls(graph_.op(node) == Op::real_power ? node : condition); // the exponent may
    return !moves || (sense == Sense::nonzero ? nonzero(condition) : positive(condition));
}

std::string ControlProofs::partial_in(const std::vector<NodeId>& roots)
{
    for (const NodeId node : reachable(graph_, roots))
        if (is_partial(graph_, node) && !is_smooth(node)) return to_text(graph_, node, 60);
    return {};
}

} // namespace lagen
