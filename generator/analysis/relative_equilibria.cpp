// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/relative_equilibria.hpp"

#include "analysis/augmented_energy.hpp"
#include "analysis/energy_momentum.hpp"
#include "analysis/find_invariants.hpp"
#include "analysis/generic_points.hpp"
#include "analysis/leaf.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/core/evaluate.hpp"
#include "mechanics/symplectic.hpp"
#include "proof/least_squares.hpp"
#include "text/activity.hpp"
#include "verify/proof_setting.hpp"
#include "verify/singular_set.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace lagen {

using proof::Ball;
using proof::BallMatrix;

const char* to_text(Stability stability)
{
    switch (stability) {
    case Stability::stable: return "stable";
    case Stability::spectrally_unstable: return "spectrally_unstable";
    case Stability::undecided: break;
    }
    return "undecided";
}

namespace {

constexpr slong search_bits = 64;
constexpr long near_bits = 20; ///< 1e-6, by which roots are told apart

class EquilibriumFinder {
  public:
    EquilibriumFinder(Graph& graph, const System& system, const HamiltonianNodes& hamiltonian,
                      const std::vector<NodeId>& start)
        : graph_(graph), system_(system)
    {
        put_start(start);
        phase_ = hamilton_system(graph, system, hamiltonian);
        std::vector<NodeId> rates = phase_.xdot;
        rates.insert(rates.end(), phase_.mudot.begin(), phase_.mudot.end());
        for (const NodeId x : system.algebroid.x)
            (depends_on_any(graph, rates, std::vector<NodeId>{x}) ? out_.coordinates : out_.cyclic).push_back(x);
        out_.coordinates.insert(out_.coordinates.end(), system.mu.begin(), system.mu.end());
        collect(hamiltonian);
        std::vector<NodeId> F;
        for (const ConservedFunction& each : out_.conserved) F.push_back(each.value);
        take_levels(F);
        const NodeId H = fixed(phase_.hamiltonian);
        energy_.emplace(graph, system_at_, H, F, out_.coordinates);
        for (std::size_t i = 0; i < system.n(); ++i)
            if (std::ranges::find(out_.cyclic, system.algebroid.x[i]) != out_.cyclic.end())
                cyclic_rates_.push_back(fixed(phase_.xdot[i]));
        commuting_ = commute(F);
        for (const NodeId z : out_.coordinates) is_angle_.push_back(is_angle(z));
    }

    RelativeEquilibria run(const EquilibriumSearch& search)
    {
        const std::size_t n = energy_->n();
        Doubles z0;
        for (const NodeId z : out_.coordinates) z0.push_back(start_.at(graph_.input_name(z)));
        const std::size_t base = n - system_.mu.size();
        const auto size = [&](std::size_t from, std::size_t to) {
            double largest = 0;
            for (std::size_t k = from; k < to; ++k) largest = std::max(largest, std::fabs(z0[k]));
            return largest > 0 ? largest : 1.0;
        };
        const double sizes[] = {std::max(size(0, base), 2.0), size(base, n)}; // whole turns of angles
        for (std::size_t i = 0; i < n; ++i) sizes_.push_back(sizes[i < base ? 0 : 1]);
        std::mt19937_64 random(search.seed);
        std::vector<Doubles> points{z0};
        for (std::size_t k = 0; k < search.starts; ++k) {
            Doubles& z = points.emplace_back();
            for (std::size_t i = 0; i < n; ++i) {
                const double part = static_cast<double>(random() >> 11U) * 0x1p-53;
                z.push_back(2 * (2 * part - 1) * sizes_[i]);
            }
        }
        for (const Doubles& z : points)
            for (const double slope : middles(energy_->at(exact_balls(z), search_bits)[0].slope))
                if (std::isfinite(slope)) slope_ = std::max(slope_, std::fabs(slope));
        Activity activity("searching from starts", points.size());
        for (const Doubles& z : points) {
            activity.next();
            consider(z);
        }
        std::ranges::stable_sort(out_.found, {}, &RelativeEquilibrium::energy);
        return std::move(out_);
    }

  private:
    void put_start(const std::vector<NodeId>& start)
    {
        const std::vector<double> numbers = evaluate<double>(graph_, start, {});
        for (std::size_t k = 0; k < start.size(); ++k) {
            const NodeId z = k < system_.n() ? system_.algebroid.x[k] : system_.mu[k - system_.n()];
            at_start_.emplace_back(z, start[k]);
            start_[graph_.input_name(z)] = numbers[k];
        }
    }

    /// F_i = c_i; base constraints are 0.
    void take_levels(const std::vector<NodeId>& F)
    {
        const proof::Evaluation there(graph_, substitute(graph_, F, at_start_));
        const std::vector<Ball> levels = there.enclose({}, AugmentedEnergy::precision);
        for (std::size_t i = constraints_; i < F.size(); ++i) out_.conserved[i].level = levels[i];
    }

    [[nodiscard]] NodeId fixed(NodeId node) { return substitute(graph_, {&node, 1}, system_.parameter_values)[0]; }

    /// Constraints, Casimirs, and what is found: Casimirs of E* and functions linear in the momenta.
    void collect(const HamiltonianNodes& hamiltonian)
    {
        system_at_ = system_;
        for (auto* columns : {&system_at_.algebroid.anchor, &system_at_.algebroid.bracket})
            for (Column& column : *columns)
                for (ColumnEntry& entry : column) entry.value = fixed(entry.value);
        const Leaves leaves = leaves_of(graph_, system_);
        std::vector<NodeId> candidates = leaves.constraints;
        candidates.insert(candidates.end(), leaves.casimirs.begin(), leaves.casimirs.end());
        for (const FoundInvariant& each : find_invariants(graph_, system_, hamiltonian))
            candidates.push_back(each.value);
        ProofSetting setting = setting_at_values(graph_, proof_setting(graph_, system_), system_.parameter_values);
        for (const NodeId mu : system_.mu)
            if (std::ranges::find(setting.variables, mu) == setting.variables.end()) setting.variables.push_back(mu);
        const std::vector<NamedNumbers> points = generic_points(graph_, setting, 5);
        GenericSpan differentials(graph_, points);
        for (std::size_t k = 0; k < candidates.size(); ++k) {
            const NodeId value = fixed(candidates[k]);
            const NodeId only[] = {value};
            if (depends_on_any(graph_, only, out_.cyclic)) continue;
            if (!differentials.add_differential(value, out_.coordinates)) continue;
            const bool flowless = generates_nothing(value, out_.coordinates);
            const std::vector<NodeId> by_momenta = gradient(graph_, value, system_.mu);
            if (!flowless && depends_on_any(graph_, by_momenta, system_.mu)) continue;
            out_.conserved.push_back({value, {}, flowless, flowless && generates_nothing(value, out_.cyclic)});
            if (k < system_.functions.constraints.size()) constraints_ = out_.conserved.size();
        }
    }

    [[nodiscard]] ZeroDecider& decider()
    {
        if (!decider_) {
            ProofSetting setting = proof_setting(graph_, system_);
            for (const NodeId mu : system_.mu)
                if (std::ranges::find(setting.variables, mu) == setting.variables.end())
                    setting.variables.push_back(mu);
            decider_ = ZeroDecider::make(graph_, setting);
        }
        if (!decider_) throw InternalError("a system whose constraints are not triangular");
        return *decider_;
    }
    [[nodiscard]] bool is_proved_zero(NodeId node)
    {
        return graph_.is_zero(node) || decider().status(node) == ProofStatus::proved;
    }
    [[nodiscard]] bool generates_nothing(NodeId f, const std::vector<NodeId>& coordinates)
    {
        return std::ranges::all_of(coordinates,
                                   [&](NodeId z) { return is_proved_zero(poisson_bracket(graph_, system_at_, f, z)); });
    }
    /// True where a whole turn of z changes nothing: not H, not what is conserved, not rho and C.
    [[nodiscard]] bool is_angle(NodeId z)
    {
        std::vector<NodeId> functions = system_at_.algebroid.entries();
        functions.push_back(fixed(phase_.hamiltonian));
        for (const ConservedFunction& each : out_.conserved) functions.push_back(each.value);
        const NodeId turned = graph_.add(z, graph_.multiply(graph_.constant(4), quarter_turn(graph_).node));
        const std::vector<NodeId> after = substitute(graph_, functions, Replacements{{z, turned}});
        for (std::size_t k = 0; k < functions.size(); ++k)
            if (!is_proved_zero(graph_.subtract(after[k], functions[k]))) return false;
        return true;
    }
    [[nodiscard]] bool commute(const std::vector<NodeId>& F)
    {
        for (std::size_t i = 0; i < F.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                if (!out_.conserved[i].flowless && !out_.conserved[j].flowless &&
                    !is_proved_zero(poisson_bracket(graph_, system_at_, F[i], F[j])))
                    return false;
        return true;
    }

    /// dH - lambda_i dF_i, then F_i - c_i, and the derivative of both by z and lambda.
    [[nodiscard]] proof::Residual residual(const Doubles& point) const
    {
        const std::size_t n = energy_->n(), m = energy_->count(), all = n + m;
        const auto split = point.begin() + static_cast<std::ptrdiff_t>(n);
        const Doubles lambda(split, point.end());
        const std::vector<FunctionJet> jets = energy_->at(exact_balls({point.begin(), split}), search_bits);
        proof::Residual out{Doubles(all, 0.0), Doubles(all * all, 0.0), 1e-3 * slope_};
        for (std::size_t k = 0; k < n; ++k) {
            const double slope = jets[0].slope.entries[k].middle();
            out.values[k] = slope;
            out.size = std::max(out.size, std::fabs(slope));
            for (std::size_t l = 0; l < n; ++l) out.slopes[k * all + l] = jets[0].curvature.at(k, l).middle();
        }
        for (std::size_t i = 0; i < m; ++i) {
            const FunctionJet& F = jets[i + 1];
            for (std::size_t k = 0; k < n; ++k) {
                const double slope = F.slope.entries[k].middle();
                out.values[k] -= lambda[i] * slope;
                out.size = std::max(out.size, std::fabs(lambda[i] * slope));
                out.slopes[k * all + n + i] = -slope;
                out.slopes[(n + i) * all + k] = slope;
                for (std::size_t l = 0; l < n; ++l)
                    out.slopes[k * all + l] -= lambda[i] * F.curvature.at(k, l).middle();
            }
            out.values[n + i] = F.value.middle() - out_.conserved[i].level.middle();
            out.size = std::max({out.size, std::fabs(out_.conserved[i].level.middle()), 1.0});
        }
        return out;
    }

    /// What the steps from z end at is certified, judged and kept if it is new.
    void consider(Doubles z)
    {
        const std::size_t n = energy_->n();
        z.resize(n + energy_->count(), 0.0);
        const auto found_root =
            proof::least_squares(std::move(z), [this](const Doubles& point) { return residual(point); });
        if (!found_root || !(found_root->at.length() <= 1e-10 * found_root->at.size)) return;
        const auto split = found_root->z.begin() + static_cast<std::ptrdiff_t>(n);
        z.assign(found_root->z.begin(), split);
        const Doubles lambda(split, found_root->z.end());
        if (!is_in_domain(z)) return;
        if (!is_new(z, energy_->at(exact_balls(z), search_bits)[0].value.middle())) return;
        EquilibriumCertificate certificate(graph_, *energy_, out_.conserved, commuting_,
                                           [this](NodeId node) { return is_proved_zero(node); });
        const RelativeEquilibrium found = certificate.judged(z, lambda);
        if (!found.certified && is_far(found.z)) return; // dH and dF may tend to zero at infinity
        if (!is_new(found.z, found.energy)) return;      // near a singular level the search ends less near
        out_.found.push_back(found);
        std::map<std::string, double> inputs;
        for (std::size_t k = 0; k < n; ++k) inputs[graph_.input_name(out_.coordinates[k])] = out_.found.back().z[k];
        if (!cyclic_rates_.empty()) out_.found.back().cyclic = evaluate<double>(graph_, cyclic_rates_, inputs);
    }

    /// With all that is as near as two roots that are told apart: a point of the boundary is outside.
    [[nodiscard]] bool is_in_domain(const Doubles& z) const
    {
        proof::BallInputs inputs;
        for (const auto& [node, value] : at_start_)
            inputs.emplace(node, exact_balls({start_.at(graph_.input_name(node))})[0]);
        for (const auto& [parameter, value] : system_.parameter_values)
            inputs.emplace(parameter, Ball(graph_.value(value), search_bits));
        for (std::size_t k = 0; k < z.size(); ++k)
            inputs.insert_or_assign(out_.coordinates[k], proof::widened(exact_balls({z[k]})[0], near_bits));
        return std::ranges::all_of(proof::Evaluation(graph_, system_.domain).enclose(inputs, search_bits),
                                   &Ball::is_positive);
    }

    [[nodiscard]] bool is_far(const Doubles& z) const
    {
        for (std::size_t k = 0; k < z.size(); ++k)
            if (std::fabs(z[k]) > 16 * sizes_[k]) return true;
        return false;
    }

    /// One of each family: another energy, or other coordinates that no flow moves. What is not certified may be one of
    /// a family that no flow makes: the first stands for all of its energy.
    [[nodiscard]] bool is_new(const Doubles& z, double energy) const
    {
        const auto differ = [](double a, double b) { return std::fabs(a - b) > 1e-6 * (1 + std::fabs(a)); };
        const auto apart = [&](std::size_t k, double a, double b) {
            return is_angle_[k] ? differ(std::remainder(a - b, 2 * std::numbers::pi), 0) : differ(a, b);
        };
        return std::ranges::none_of(out_.found, [&](const RelativeEquilibrium& known) {
            if (differ(known.energy, energy)) return false;
            if (!known.certified) return true;
            for (std::size_t k = 0; k < z.size(); ++k)
                if (!known.moved[k] && apart(k, known.z[k], z[k])) return false;
            return true;
        });
    }

    Graph& graph_;
    const System& system_;
    std::map<std::string, double> start_;
    Replacements at_start_;
    System system_at_; ///< with numbers for the parameters
    PhaseSystem phase_;
    RelativeEquilibria out_;
    std::optional<AugmentedEnergy> energy_;
    std::vector<NodeId> cyclic_rates_;
    std::unique_ptr<ZeroDecider> decider_;
    std::size_t constraints_ = 0; ///< the first of the F are base constraints, which are 0
    std::vector<bool> is_angle_;  ///< of each coordinate, proved
    Doubles sizes_;               ///< of the coordinates at the starts
    double slope_ = 0;            ///< the largest component of dH at the starts
    bool commuting_ = false;      ///< all {F_i, F_j} are proved to vanish
};

} // namespace

RelativeEquilibria relative_equilibria(Graph& graph, const System& system, const HamiltonianNodes& hamiltonian,
                                       const std::vector<NodeId>& start, const EquilibriumSearch& search)
{
    return EquilibriumFinder(graph, system, hamiltonian, start).run(search);
}

} // namespace lagen
