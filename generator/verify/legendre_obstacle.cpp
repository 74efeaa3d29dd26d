// SPDX-License-Identifier: GPL-2.0-or-later
/// The set of fibre coordinates where L is smooth, condition by condition, and the sign of W there.
#include "verify/legendre_obstacle.hpp"

#include "graph/calculus/differentiate.hpp"
#include "graph/core/evaluate.hpp"
#include "graph/core/lower.hpp"
#include "graph/core/operators.hpp"
#include "graph/unknowns/implicit.hpp"
#include "verify/definiteness.hpp"
#include "verify/proof_setting.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>

namespace lagen {
namespace {

constexpr std::size_t longest_condition = 100; ///< characters of a condition in a message

/// The operations of `root` that depend on one of `inputs`, operands first.
std::vector<NodeId> dependents(const Graph& graph, NodeId root, const std::vector<NodeId>& inputs)
{
    const std::vector<bool> depends = depends_on(graph, inputs);
    const NodeId roots[] = {root};
    std::vector<NodeId> result = reachable(graph, roots);
    std::erase_if(result, [&](NodeId node) { return !depends[node] || graph.op(node) == Op::input; });
    return result;
}

/// Conditions f > 0 that make L smooth, taken in as long as the set where they hold is convex in y: f is positive
/// already, or concave in y.
class SmoothSet {
  public:
    SmoothSet(Graph& graph, const FibreHessian& hessian, const ProofSetting& setting, const ProofBudget& budget,
              const char* function)
        : graph_(graph), hessian_(hessian), setting_(setting), budget_(budget), function_(function)
    {
        // What depends on y is what the conditions are about.
        std::erase_if(setting_.defined, [&](NodeId node) { return depends_on_y(node); });
        std::vector<NodeId> open = dependents(graph_, hessian_.lagrangian, hessian_.y);
        // Again while a condition came in: a root keeps a divisor away from zero.
        for (std::size_t before = 0; before != open.size();) {
            before = open.size();
            obstacle_.clear();
            std::erase_if(open, [&](NodeId node) { return is_smooth(node); });
        }
    }

    /// The first condition that was not shown; empty where L is smooth on a convex set.
    [[nodiscard]] const std::string& obstacle() const { return obstacle_; }
    /// With the conditions in its domain.
    [[nodiscard]] const ZeroDecider& decider()
    {
        if (!decider_) decider_ = std::make_unique<ZeroDecider>(graph_, setting_, budget_);
        return *decider_;
    }

  private:
    [[nodiscard]] bool depends_on_y(NodeId node) const
    {
        const NodeId nodes[] = {node};
        return depends_on_any(graph_, nodes, hessian_.y);
    }

    [[nodiscard]] bool is_smooth(NodeId node)
    {
        switch (smooth_where(graph_, node)) {
        case Sense::always: return true;
        case Sense::nonzero: return holds(condition_of(graph_, node), false);
        case Sense::nonnegative:
        case Sense::positive: return holds(condition_of(graph_, node), true);
        case Sense::off_origin:
        case Sense::off_cut: { // and slopes that do not see it
            const NodeId u = graph_.operands(node)[1];
            return decider().proves_positive(u) || obstructed(not_shown(u, "positive"));
        }
        case Sense::same_branch: return obstructed(std::string(function_) + " is not smooth");
        case Sense::regular: break;
        }
        return obstructed(std::string(function_) +
                          " contains the solution of a linear system whose matrix is not constant");
    }

    /// False; the first obstacle is kept.
    bool obstructed(std::string why)
    {
        if (obstacle_.empty()) obstacle_ = std::move(why);
        return false;
    }

    bool holds(NodeId f, bool positive)
    {
        if (!depends_on_y(f)) return true;
        if (positive ? decider().proves_positive(f) : decider().proves_nonzero(f)) return true;
        if (!positive || !is_concave(f)) return obstructed(not_shown(f, positive ? "positive" : "nonzero"));
        setting_.domain.push_back(graph_.apply(Op::greater, f, graph_.constant(0)));
        decider_.reset();
        return true;
    }

    [[nodiscard]] bool is_concave(NodeId f)
    {
        const FibreHessian below = fibre_hessian(graph_, graph_.negate(f), hessian_.y);
        return proves_semidefinite(graph_, below, decider());
    }

    [[nodiscard]] std::string not_shown(NodeId f, const char* what) const
    {
        std::string text = to_text(to_tree(graph_, f));
        if (text.size() > longest_condition) text = "an operand";
        return fmt::format("{} is not shown to be {}, and {} is smooth only where it is", text, what, function_);
    }

    Graph& graph_;
    const FibreHessian& hessian_;
    ProofSetting setting_;
    ProofBudget budget_;
    const char* function_;                 ///< its letter
    std::unique_ptr<ZeroDecider> decider_; ///< made where it is needed, anew for each further condition
    std::string obstacle_;
};

/// True where W does not depend on y: its derivatives are proved to be zero.
bool is_quadratic(Graph& graph, const FibreHessian& hessian, SmoothSet& smooth)
{
    std::set<NodeId> seen; // most entries are the same 0
    for (const NodeId entry : hessian.hessian) {
        if (graph.is_constant(entry) || !seen.insert(entry).second) continue;
        for (const NodeId slope : gradient(graph, entry, hessian.y))
            if (!graph.is_zero(slope) && smooth.decider().status(slope) != ProofStatus::proved) return false;
    }
    return true;
}

/// Fibre coordinates of a sample point where L, momenta or W are not defined or smooth at 0, as for L = v log(v); else
/// empty.
std::vector<Rational> newton_start(Graph& graph, const FibreHessian& hessian, const ZeroDecider& decider)
{
    const auto point = decider.sample_point();
    if (!point) return {};
    std::map<std::string, double> inputs;
    for (const auto& [name, value] : *point) inputs[name] = to_double(value);
    std::vector<Rational> start;
    for (const NodeId y : hessian.y) {
        double& value = inputs[graph.input_name(y)];
        start.emplace_back(value);
        value = 0;
    }
    std::vector<NodeId> nodes = hessian.momenta;
    nodes.push_back(hessian.lagrangian);
    nodes.insert(nodes.end(), hessian.hessian.begin(), hessian.hessian.end());
    const std::vector<double> at_zero = evaluate<double>(graph, nodes, inputs);
    const std::vector<double> conditions =
        evaluate<double>(graph, positive_operands(graph, hessian.lagrangian, hessian.y), inputs);
    const bool is_defined = std::ranges::all_of(at_zero, [](double x) { return std::isfinite(x); }) &&
                            std::ranges::all_of(conditions, [](double x) { return x > 0; });
    return is_defined ? std::vector<Rational>{} : start;
}

/// An obstacle, or where Newton's method starts.
struct Transform {
    std::string obstacle;
    std::vector<Rational> newton_start;
};

Transform transform_of(Graph& graph, const FibreHessian& hessian, const ProofSetting& setting,
                       const ProofBudget& budget, const Regularity& regularity)
{
    const bool is_hamiltonian = regularity.of == Regularity::Matrix::hamiltonian;
    const std::string matrix = is_hamiltonian ? "d2H/dmu2" : "d2L/dy2";
    SmoothSet smooth(graph, hessian, setting, budget, is_hamiltonian ? "H" : "L");
    if (!smooth.obstacle().empty()) return {smooth.obstacle(), {}};
    if (is_quadratic(graph, hessian, smooth)) return {};
    if (regularity.kind == Regularity::Kind::degenerate) return {matrix + " is singular", {}};
    // Anew: forces, which count for the verdict on W, may be defined for fewer velocities.
    const FibreHessian negative = fibre_hessian(graph, graph.negate(hessian.lagrangian), hessian.y);
    for (const FibreHessian* each : {&hessian, &negative})
        if (proves_definite(graph, *each, smooth.decider()))
            return {{}, newton_start(graph, hessian, smooth.decider())};
    return {matrix + " is not shown to be definite", {}};
}

} // namespace

void decide_legendre_transform(Graph& graph, const FibreHessian& hessian, const ProofSetting& setting,
                               const ProofBudget& budget, const Replacements& values, Regularity& regularity)
{
    Transform transform = transform_of(graph, hessian, setting, budget, regularity);
    const auto succeeds_for = [&](const Replacements& some) {
        const auto there = at_values(graph, hessian, setting, budget, some);
        if (!there || !there->decider->sample_point()) return false;
        Transform here = transform_of(graph, there->hessian, there->setting, budget, regularity);
        const bool succeeds = here.obstacle.empty();
        if (succeeds) transform = std::move(here);
        return succeeds;
    };
    if (!transform.obstacle.empty() && regularity.kind != Regularity::Kind::degenerate) {
        std::vector<NodeId> roots = hessian.momenta;
        roots.insert(roots.end(), setting.domain.begin(), setting.domain.end());
        Replacements some = values;
        std::erase_if(some, [&](const auto& each) { return !depends_on_any(graph, roots, std::vector{each.first}); });
        if (!some.empty() && succeeds_for(some)) {
            for (std::size_t k = some.size(); k-- > 0;) {
                Replacements fewer = some;
                fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(k));
                if (succeeds_for(fewer)) some = std::move(fewer);
            }
            regularity.legendre_values = std::move(some);
        }
    }
    regularity.legendre_obstacle = std::move(transform.obstacle);
    regularity.newton_start = std::move(transform.newton_start);
}

std::optional<std::vector<Rational>> strictly_convex_start(Graph& graph, const FibreHessian& hessian,
                                                           const ProofSetting& setting, const ProofBudget& budget)
{
    SmoothSet smooth(graph, hessian, setting, budget, "F");
    if (!smooth.obstacle().empty() || !proves_definite(graph, hessian, smooth.decider())) return std::nullopt;
    return newton_start(graph, hessian, smooth.decider());
}

void require_legendre_transform(const std::string& model, const Regularity& regularity)
{
    if (regularity.legendre_obstacle.empty()) return;
    throw MathematicsError(
        fmt::format("the momenta dL/dy of model '{}' are not shown to fix the velocities, as its Hamiltonian form "
                    "needs: {}",
                    model, regularity.legendre_obstacle),
        "give [hamiltonian] H, or conditions on x and parameters in [base] domain under which d2L/dy2 is definite");
}

} // namespace lagen
