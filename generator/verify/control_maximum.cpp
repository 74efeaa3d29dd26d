// SPDX-License-Identifier: GPL-2.0-or-later
#include "verify/control_maximum.hpp"

#include "graph/calculus/differentiate.hpp"
#include "graph/core/operators.hpp"
#include "proof/enclosure.hpp"
#include "verify/definiteness.hpp"
#include "verify/legendre_obstacle.hpp"
#include "verify/regularity.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {
namespace {

using Kind = ControlMaximum::Kind;

constexpr const char* cost_hint = "H = mu_a sigma^a - cost is maximised: a cost is to be convex in the controls";
constexpr std::size_t most_pairs = 100; ///< that are looked at for a wrong sign

class MaximumDecision {
  public:
    MaximumDecision(Graph& graph, const ControlProblem& control, const std::vector<NodeId>& mu,
                    const ProofSetting& setting, const ProofBudget& budget)
        : graph_(graph), control_(control), mu_(mu), setting_(setting), budget_(budget),
          hamiltonian_(control_hamiltonian(graph, control, mu)), proofs_(graph, control, setting, budget)
    {
        parts_ = control.parts;
        parts_.push_back(hamiltonian_.value);
    }

    [[nodiscard]] ControlMaximum decide()
    {
        if (const std::string kink = proofs_.kink_in(parts_); !kink.empty())
            return {Kind::nonsmooth, "H is not smooth in the controls: it contains " + kink,
                    "write a cost that is smooth in the controls"};
        if (const auto linear = affine_control()) return of_affine(*linear);
        std::vector<std::size_t> angles = find_angles(graph_, control_, hamiltonian_, parts_, setting_, budget_);
        return angles.empty() ? of_stationary() : beside(std::move(angles));
    }

  private:
    /// Between bounds the control switches where dH/du changes its sign; without them H has no maximum elsewhere.
    [[nodiscard]] ControlMaximum of_affine(std::size_t k) const
    {
        constexpr std::size_t longest = 60; // characters of a switching function in the message
        const std::string& name = name_of(k);
        const std::string slope = proofs_.decider().decide(hamiltonian_.dH_du[k]).residual;
        const std::string shown = slope.empty() || slope.size() > longest ? "" : " = " + slope;
        const bool switches = control_.lower[k] && control_.upper[k];
        const std::string missing =
            switches
                ? fmt::format("between its bounds it is bang-bang, at the upper one where dH/d{0}{1} > 0 and at the "
                              "lower one where it is < 0, and what is missing are motions that switch there",
                              name, shown)
                : fmt::format("without two bounds H has a maximum only where dH/d{0}{1} is 0 (a singular control)",
                              name, shown);
        return {Kind::unsolved,
                fmt::format("H is affine in the control {0}: dH/d{0} = 0 does not determine it; {1}", name, missing),
                fmt::format("give the cost a term in which {0} is strictly convex{1}", name,
                            switches
                                ? fmt::format(": a small multiple of {}^2 gives motions near those that switch", name)
                                : "")};
    }

    [[nodiscard]] ControlMaximum of_stationary() { return control_.bounded() ? between_bounds() : without_bounds(); }

    /// The other controls stand apart from the angles, and are smooth and affine in none, since all controls are.
    [[nodiscard]] ControlMaximum beside(std::vector<std::size_t> angles)
    {
        ControlMaximum maximum{Kind::maximal, {}, {}};
        const ControlProblem rest = without_angles(graph_, control_, angles);
        MaximumDecision others(graph_, rest, mu_, setting_, budget_);
        if (!rest.u.empty()) maximum = others.of_stationary();
        if (maximum.kind == Kind::maximal) maximum.reason = words_for(angles) + others.words_for_stationary(maximum);
        maximum.angles = std::move(angles);
        return maximum;
    }

    /// "H = a + b cos(th) + c sin(th) is largest at th = atan2(c, b), wherever b or c is not 0"
    [[nodiscard]] std::string words_for(const std::vector<std::size_t>& angles) const
    {
        std::string text;
        for (const std::size_t k : angles)
            text += fmt::format("{0}H = a + b cos({1}) + c sin({1}) is largest at {1} = atan2(c, b)",
                                text.empty() ? "" : "; ", name_of(k));
        return text + ", wherever b or c is not 0";
    }

    /// "; H is concave in (u, w), and largest where dH/d(u, w) = 0"; between bounds each control by itself
    [[nodiscard]] std::string words_for_stationary(const ControlMaximum& maximum) const
    {
        std::vector<std::string> names;
        for (std::size_t k = 0; k < count(); ++k) names.push_back(name_of(k));
        if (!control_.bounded() && count() > 1) names = {fmt::format("({})", fmt::join(names, ", "))};
        std::string text;
        for (std::size_t k = 0; k < names.size(); ++k) {
            const bool bounded = control_.lower[k] || control_.upper[k];
            const char* part = maximum.on_part ? " where it is defined" : bounded ? " within its bounds" : "";
            text += fmt::format("; H is concave in {0}{1}, and largest where dH/d{0} = 0{2}", names[k], part,
                                bounded ? " or at the bound next to that" : "");
        }
        return text;
    }

    [[nodiscard]] const std::string& name_of(std::size_t k) const { return graph_.input_name(control_.u[k]); }
    /// "d2H/du2", "d2H/d(u2)2", "d2H/dudw"
    [[nodiscard]] std::string second(std::size_t k, std::size_t l) const
    {
        const std::string& name = name_of(k);
        if (k != l) return fmt::format("d2H/d{}d{}", name, name_of(l));
        const bool plain = name.find_first_of("0123456789[") == std::string::npos;
        return plain ? fmt::format("d2H/d{}2", name) : fmt::format("d2H/d({})2", name);
    }
    [[nodiscard]] std::size_t count() const { return control_.u.size(); }
    /// -d2H/du^k du^l
    [[nodiscard]] NodeId curvature(std::size_t k, std::size_t l) const { return hamiltonian_.negative.W(k, l); }

    /// A control whose row of d2H/du2 vanishes.
    [[nodiscard]] std::optional<std::size_t> affine_control() const
    {
        for (std::size_t k = 0; k < count(); ++k) {
            bool vanishes = true;
            for (std::size_t l = 0; l < count() && vanishes; ++l) vanishes = proofs_.zero(curvature(k, l));
            if (vanishes) return k;
        }
        return std::nullopt;
    }

    [[nodiscard]] ControlMaximum between_bounds()
    {
        const auto unsolved = [](const std::string& why) {
            return ControlMaximum{Kind::unsolved,
                                  "with bounds on controls H must be separable, smooth and strictly concave in them, "
                                  "or dH/du = 0 and the bounds do not give its maximum: " +
                                      why,
                                  "without bounds dH/du = 0 is solved as it is"};
        };
        for (std::size_t k = 0; k < count(); ++k)
            for (std::size_t l = k + 1; l < count(); ++l)
                if (!proofs_.zero(curvature(k, l))) return unsolved(second(k, l) + " is not zero");
        for (std::size_t k = 0; k < count(); ++k)
            if (!proofs_.positive(curvature(k, k)))
                return unsolved(fmt::format("{} < 0 was not proved for all admissible {}", second(k, k), name_of(k)));
        if (const std::string part = proofs_.partial_in(parts_); !part.empty())
            return unsolved(fmt::format("{} was not proved to be smooth for all admissible controls", part));
        return {Kind::maximal, {}, {}};
    }

    [[nodiscard]] ControlMaximum without_bounds()
    {
        const Regularity regularity =
            decide_regularity(graph_, hamiltonian_.negative, proofs_.setting(), proofs_.decider(), {});
        if (regularity.kind == Regularity::Kind::degenerate)
            return {Kind::unsolved,
                    fmt::format("dH/du = 0 does not determine the controls: d2H/du2 has rank {}, and {} controls need "
                                "rank {}",
                                regularity.rank, count(), count()),
                    "give the cost a term that is strictly convex in all controls together"};
        // Of a function that is concave and smooth everywhere each stationary point is a maximum.
        const bool concave =
            regularity.positive_definite || proves_semidefinite(graph_, hamiltonian_.negative, proofs_.decider());
        const std::string part = proofs_.partial_in(parts_);
        if (concave && part.empty()) return {Kind::maximal, {}, {}};
        // Costs with a barrier, -log(1 - u^2): H is defined on a convex set of controls, and strictly concave there.
        if (const auto start = strictly_convex_start(graph_, hamiltonian_.negative, proofs_.setting(), budget_))
            return {Kind::maximal, {}, {}, true, *start};
        if (concave)
            return {Kind::stationary, fmt::format("{} was not proved to be smooth for all controls", part), {}};
        // Where H ends its maximum may be at the end.
        if (part.empty())
            if (ControlMaximum refuted = refutation(); refuted.kind == Kind::refuted) return refuted;
        const FibreHessian opposite = fibre_hessian(graph_, hamiltonian_.value, control_.u);
        if (strictly_convex_start(graph_, opposite, proofs_.setting(), budget_))
            return {Kind::refuted, "dH/du = 0 is where H is least: d2H/du2 > 0 wherever H is defined", cost_hint};
        return {
            Kind::stationary,
            fmt::format("d2H/du2 < 0 was not proved for all {}", count() == 1 ? name_of(0) : std::string("controls")),
            {}};
    }

    /// At a maximum d2H/du2 has no positive diagonal entry and no negative 2 x 2 minor. Here everything in the model is
    /// taken to be defined: elsewhere there is no H.
    [[nodiscard]] ControlMaximum refutation()
    {
        const ZeroDecider decider(graph_, setting_, budget_);
        for (std::size_t k = 0; k < count(); ++k)
            if (decider.proves_positive(graph_.negate(curvature(k, k))))
                return {Kind::refuted,
                        fmt::format("H has no maximum in the control '{}': {} > 0", name_of(k), second(k, k)),
                        cost_hint};
        std::size_t minors = 0;
        for (std::size_t k = 0; k < count(); ++k)
            for (std::size_t l = k + 1; l < count(); ++l) {
                if (graph_.is_zero(curvature(k, l)) || ++minors > most_pairs) continue;
                const NodeId minor = graph_.subtract(graph_.power(curvature(k, l), 2),
                                                     graph_.multiply(curvature(k, k), curvature(l, l)));
                if (decider.proves_positive(minor))
                    return {Kind::refuted,
                            fmt::format("H has no maximum in the controls '{}' and '{}': d2H/du2 is indefinite",
                                        name_of(k), name_of(l)),
                            cost_hint};
            }
        return {};
    }

    Graph& graph_;
    const ControlProblem& control_;
    const std::vector<NodeId>& mu_;
    const ProofSetting& setting_;
    ProofBudget budget_;
    ControlHamiltonian hamiltonian_;
    ControlProofs proofs_;
    std::vector<NodeId> parts_;
};

} // namespace

ControlMaximum decide_maximum(Graph& graph, const ControlProblem& control, const std::vector<NodeId>& mu,
                              const ProofSetting& setting, const ProofBudget& budget)
{
    return MaximumDecision(graph, control, mu, setting, budget).decide();
}

void require_maximum(const std::string& model, const ControlMaximum& maximum)
{
    if (maximum.kind == Kind::absent || maximum.kind == Kind::maximal || maximum.kind == Kind::stationary) return;
    throw MathematicsError(fmt::format("the controls of model '{}' are not solved for: {}", model, maximum.reason),
                           maximum.hint);
}

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

/// True where the operation is defined, with all its derivatives, for all admissible controls; kinks and cuts are told
/// by kink_in().
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

namespace {

NodeId derivative(Graph& graph, NodeId f, NodeId u)
{
    const NodeId inputs[] = {u};
    return gradient(graph, f, inputs)[0];
}

/// Is u_k, for which dH/du_k is `slope`, an angle? H = a + b cos u_k + c sin u_k, where a, b and c are free of it, and
/// b and c, which are read off, hold no other control.
bool is_angle(Graph& graph, const ControlProblem& control, std::size_t k, NodeId slope,
              const std::vector<NodeId>& parts, const ProofSetting& setting, const ProofBudget& budget)
{
    if (control.lower[k] || control.upper[k]) return false;
    const NodeId second = derivative(graph, slope, control.u[k]);
    const NodeId third = derivative(graph, second, control.u[k]);
    if (graph.is_constant(third)) return false; // a polynomial in u
    // The other controls are as any state.
    const ControlProblem alone{{control.u[k]}, control.sigma, control.cost, {std::nullopt}, {std::nullopt}, {}};
    ControlProofs proofs(graph, alone, setting, budget);
    if (!proofs.zero(graph.add(third, slope)) || proofs.zero(second) || !proofs.partial_in(parts).empty()) return false;
    const AngleTerms terms = angle_terms(graph, slope, control.u[k]);
    const NodeId both[] = {terms.b, terms.c};
    return !depends_on_any(graph, both, control.u);
}

} // namespace

std::vector<std::size_t> find_angles(Graph& graph, const ControlProblem& control, const ControlHamiltonian& hamiltonian,
                                     const std::vector<NodeId>& parts, const ProofSetting& setting,
                                     const ProofBudget& budget)
{
    std::vector<std::size_t> angles;
    for (std::size_t k = 0; k < control.u.size(); ++k)
        if (is_angle(graph, control, k, hamiltonian.dH_du[k], parts, setting, budget)) angles.push_back(k);
    return angles;
}

AngleTerms angle_terms(Graph& graph, NodeId slope, NodeId u)
{
    const NodeId both[] = {graph.negate(derivative(graph, slope, u)), slope};
    const std::pair<NodeId, NodeId> zero[] = {{u, graph.constant(0)}};
    const std::vector<NodeId> terms = substitute(graph, both, zero);
    return {terms[0], terms[1]};
}

std::vector<std::size_t> other_controls(std::size_t count, const std::vector<std::size_t>& angles)
{
    std::vector<std::size_t> others;
    for (std::size_t k = 0; k < count; ++k)
        if (!std::ranges::binary_search(angles, k)) others.push_back(k);
    return others;
}

ControlProblem without_angles(Graph& graph, const ControlProblem& control, const std::vector<std::size_t>& angles)
{
    Replacements zeros;
    for (const std::size_t k : angles) zeros.emplace_back(control.u[k], graph.constant(0));
    ControlProblem rest;
    for (const std::size_t k : other_controls(control.u.size(), angles)) {
        rest.u.push_back(control.u[k]);
        rest.lower.push_back(control.lower[k]);
        rest.upper.push_back(control.upper[k]);
    }
    const NodeId cost[] = {control.cost};
    rest.sigma = substitute(graph, control.sigma, zeros);
    rest.cost = substitute(graph, cost, zeros)[0];
    rest.parts = substitute(graph, control.parts, zeros);
    return rest;
}

} // namespace lagen
