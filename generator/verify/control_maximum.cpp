// SPDX-License-Identifier: GPL-2.0-or-later
#include "verify/control_maximum.hpp"

#include "verify/angle_controls.hpp"
#include "verify/definiteness.hpp"
#include "verify/legendre_obstacle.hpp"
#include "verify/regularity.hpp"
#include "verify/smooth_controls.hpp"

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

} // namespace lagen
