// SPDX-License-Identifier: GPL-2.0-or-later
#include "verify/find_invariants.hpp"

#include "algebra/orthonormal_span.hpp"
#include "algebra/rational_near.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/core/evaluate.hpp"
#include "graph/core/operators.hpp"
#include "verify/proof_setting.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace lagen {

namespace {

using Numbers = std::vector<long double>; ///< a function at all points
using Flow = Replacements;                ///< the rates of coordinates of E*

constexpr long double negligible = 1e-10L; ///< of what is 0 but for rounding
constexpr std::size_t more_points = 16;    ///< than unknowns

class InvariantSearch {
  public:
    InvariantSearch(Graph& graph, const System& system, const HamiltonianNodes& hamiltonian,
                    const InvariantAnsatz& ansatz)
        : graph_(graph), system_(system), phase_(hamilton_system(graph, system, hamiltonian)), ansatz_(ansatz),
          values_(system.parameter_values)
    {
        monomials_ = monomials(generators());
    }

    /// Those with coefficients that no parameter changes first, then those for the values of the file.
    std::vector<FoundInvariant> run()
    {
        const std::vector<Flow> motion{hamiltonian_flow()}, all = coordinate_flows();
        for (const bool at_values : {false, true}) {
            at_values_ = at_values;
            if (!take_points()) continue;
            search(all);
            search(motion);
        }
        return std::move(found_);
    }

  private:
    /// Factors of monomials, none of them over t: the momenta first, how many of them `momenta_` says.
    [[nodiscard]] std::vector<NodeId> generators()
    {
        std::vector<NodeId> out = system_.mu;
        momenta_ = out.size();
        const NodeId only[] = {phase_.hamiltonian};
        std::set<NodeId> inside; // coordinates under functions of angles and the like
        std::vector<NodeId> functions, parts;
        for (const NodeId node : reachable(graph_, only))
            if (!depends_on_any(graph_, std::vector{node}, std::vector{system_.time})) parts.push_back(node);
        for (const NodeId node : parts) {
            const NodeId self[] = {node};
            if (depends_on_any(graph_, self, system_.mu) || !depends_on_any(graph_, self, system_.algebroid.x))
                continue;
            if (kind_of(graph_.op(node)) == OpKind::function) {
                functions.push_back(node);
                if (graph_.op(node) != Op::sqrt)
                    for (const NodeId x : system_.algebroid.x)
                        if (depends_on_any(graph_, self, std::vector<NodeId>{x})) inside.insert(x);
            }
        }
        for (const NodeId x : system_.algebroid.x)
            if (!inside.contains(x)) out.push_back(x);
        for (const NodeId f : functions) out.push_back(f);
        // What H divides by, and functions with the parameters that they are multiplied by.
        const auto is_of = [&](NodeId node, const std::vector<NodeId>& inputs) {
            const NodeId self[] = {node};
            return depends_on_any(graph_, self, inputs);
        };
        const auto is_parameter = [&](NodeId node) {
            return !is_of(node, system_.mu) && !is_of(node, system_.algebroid.x) && is_of(node, system_.parameters);
        };
        for (const NodeId node : parts) {
            const Op op = graph_.op(node);
            if (op != Op::divide && op != Op::multiply) continue;
            const NodeId a = graph_.operands(node)[0], b = graph_.operands(node)[1];
            NodeId factor = node;
            if (op == Op::divide) {
                if (is_of(b, system_.mu) || !is_of(b, system_.algebroid.x)) continue;
                if (!is_parameter(a)) factor = graph_.divide(graph_.constant(1), b);
            } else {
                const bool scales = (is_parameter(a) && std::ranges::find(functions, b) != functions.end()) ||
                                    (is_parameter(b) && std::ranges::find(functions, a) != functions.end());
                if (!scales) continue;
            }
            if (std::ranges::find(out, factor) == out.end()) out.push_back(factor);
        }
        return out;
    }

    /// xdot and mudot.
    [[nodiscard]] Flow hamiltonian_flow() const
    {
        Flow flow = replacements(system_.algebroid.x, phase_.xdot);
        const Replacements more = replacements(phase_.mu, phase_.mudot);
        flow.insert(flow.end(), more.begin(), more.end());
        return flow;
    }

    /// Those of the coordinates of E*, along which Casimirs are constant: {mu_a, x^i} = rho^i_a, {mu_a, mu_b} = C^c_ab
    /// mu_c. A function that is constant along those of the mu_a and that of the x^i is one.
    [[nodiscard]] std::vector<Flow> coordinate_flows()
    {
        const Algebroid& algebroid = system_.algebroid;
        std::vector<Flow> flows(system_.r() + system_.n());
        for (std::size_t a = 0; a < system_.r(); ++a) {
            for (const ColumnEntry& entry : algebroid.anchor[a]) {
                flows[a].emplace_back(algebroid.x[entry.index], entry.value);
                flows[system_.r() + entry.index].emplace_back(system_.mu[a], entry.value);
            }
            for (std::size_t b = 0; b < system_.r(); ++b) {
                NodeId bracket = graph_.constant(0);
                for (const ColumnEntry& entry : algebroid.C(a, b))
                    bracket = graph_.add(bracket, graph_.multiply(entry.value, system_.mu[entry.index]));
                if (!graph_.is_zero(bracket)) flows[a].emplace_back(system_.mu[b], bracket);
            }
        }
        std::erase_if(flows, [](const Flow& flow) { return flow.empty(); });
        return flows;
    }

    /// Functions that are constant along all flows.
    void search(const std::vector<Flow>& flows)
    {
        if (flows.empty()) return;
        const std::vector<Numbers> values = at_points(fixed(monomials_));
        OrthonormalSpan independent(negligible);
        (void)independent.add(Numbers(points_.size(), 1.0L));
        std::vector<NodeId> kept;
        std::vector<long double> sizes;
        for (std::size_t k = 0; k < monomials_.size(); ++k)
            if (independent.add(values[k])) kept.push_back(monomials_[k]), sizes.push_back(length_of(values[k]));
        std::vector<Numbers> columns(kept.size());
        for (const Flow& flow : flows) {
            const std::vector<Numbers> rates = at_points(fixed(directional(graph_, kept, flow)));
            for (std::size_t k = 0; k < kept.size(); ++k)
                columns[k].insert(columns[k].end(), rates[k].begin(), rates[k].end());
        }
        for (const Numbers& coefficients : kernel(std::move(columns), sizes)) take(kept, coefficients, flows);
    }

    /// By degree, then in the order of the generators.
    [[nodiscard]] std::vector<NodeId> monomials(const std::vector<NodeId>& generators)
    {
        struct Term {
            NodeId value;
            std::size_t last, momenta;
        };
        std::vector<NodeId> out;
        std::vector<Term> before{{graph_.constant(1), 0, 0}};
        for (std::size_t degree = 1; degree <= ansatz_.degree; ++degree) {
            std::vector<Term> now;
            for (const Term& term : before)
                for (std::size_t k = term.last; k < generators.size(); ++k) {
                    const std::size_t momenta = term.momenta + (k < momenta_ ? 1 : 0);
                    if (momenta <= 2) now.push_back({graph_.multiply(term.value, generators[k]), k, momenta});
                }
            if (out.size() + now.size() > ansatz_.monomials) break;
            for (const Term& term : now)
                if (std::ranges::find(out, term.value) == out.end()) out.push_back(term.value);
            before = std::move(now);
        }
        return out;
    }

    /// With the parameters of the file, where these are fixed.
    [[nodiscard]] std::vector<NodeId> fixed(const std::vector<NodeId>& nodes)
    {
        return at_values_ ? substitute(graph_, nodes, values_) : nodes;
    }

    [[nodiscard]] ProofSetting setting()
    {
        ProofSetting made = proof_setting(graph_, system_);
        for (const NodeId mu : system_.mu)
            if (std::ranges::find(made.variables, mu) == made.variables.end()) made.variables.push_back(mu);
        // H may divide by parameters that no domain keeps from 0.
        for (const std::vector<NodeId>& nodes : {std::vector{phase_.hamiltonian}, phase_.xdot, phase_.mudot})
            for (const NodeId node : nodes)
                if (!graph_.is_constant(node)) made.defined.push_back(node);
        if (at_values_) made.parameters.clear();
        for (auto* nodes : {&made.constraints, &made.domain, &made.defined}) *nodes = fixed(*nodes);
        std::erase_if(made.defined, [&](NodeId node) { return graph_.is_constant(node); });
        return made;
    }

    /// As many as there may be unknowns, and a few more; false where there are not so many.
    bool take_points()
    {
        points_.clear();
        const ProofSetting where = setting();
        for (std::size_t seed = 0; points_.size() < monomials_.size() + more_points; ++seed) {
            if (seed > 2 * (monomials_.size() + more_points)) return false;
            ProofBudget budget;
            budget.seed = seed;
            const auto decider = ZeroDecider::make(graph_, where, budget);
            if (!decider) return false;
            const std::optional<NamedPoint> point = decider->sample_point();
            if (!point) continue;
            std::map<std::string, long double>& inputs = points_.emplace_back();
            for (const auto& [name, value] : *point)
                inputs[name] = value.exact ? static_cast<long double>(value.exact->get_d()) : std::stold(value.decimal);
        }
        return true;
    }

    /// Each function at all points, in units of its largest value.
    [[nodiscard]] std::vector<Numbers> at_points(const std::vector<NodeId>& functions) const
    {
        std::vector<Numbers> out(functions.size());
        for (const auto& inputs : points_) {
            const std::vector<long double> values = evaluate<long double>(graph_, functions, inputs);
            for (std::size_t k = 0; k < functions.size(); ++k) out[k].push_back(values[k]);
        }
        return out;
    }

    /// Coefficients c with sum c_k f_k = 0 at all points, one of them 1 and no later ones: by columns from the left.
    /// `sizes`: of what the columns are rates of.
    [[nodiscard]] static std::vector<Numbers> kernel(std::vector<Numbers> columns,
                                                     const std::vector<long double>& sizes)
    {
        std::vector<Numbers> out;
        const std::size_t n = columns.size();
        // combination[k]: what of the original columns stands in column k.
        std::vector<Numbers> combination(n, Numbers(n, 0.0L)), pivots, of_pivots;
        std::vector<std::size_t> rows;
        for (std::size_t k = 0; k < n; ++k) {
            combination[k][k] = 1;
            const long double size = std::max(length_of(columns[k]), sizes[k]);
            for (std::size_t j = 0; j < pivots.size(); ++j) {
                const long double factor = columns[k][rows[j]] / pivots[j][rows[j]];
                for (std::size_t i = 0; i < columns[k].size(); ++i) columns[k][i] -= factor * pivots[j][i];
                for (std::size_t i = 0; i < n; ++i) combination[k][i] -= factor * of_pivots[j][i];
            }
            std::size_t row = 0;
            for (std::size_t i = 0; i < columns[k].size(); ++i)
                if (std::abs(columns[k][i]) > std::abs(columns[k][row])) row = i;
            if (!(length_of(columns[k]) > negligible * size)) {
                out.push_back(combination[k]);
                continue;
            }
            pivots.push_back(columns[k]);
            of_pivots.push_back(combination[k]);
            rows.push_back(row);
        }
        return out;
    }

    /// Keeps what is new, rational and proved.
    void take(const std::vector<NodeId>& monomials, const Numbers& coefficients, const std::vector<Flow>& flows)
    {
        std::vector<std::pair<Rational, NodeId>> terms;
        mpz_class common = 1; // denominator
        for (std::size_t k = 0; k < coefficients.size(); ++k) {
            if (std::abs(coefficients[k]) < negligible) continue;
            const std::optional<Rational> c = rational_near(coefficients[k], 1e-9L);
            if (!c) return;
            common = lcm(common, c->get_den());
            terms.emplace_back(*c, monomials[k]);
        }
        NodeId sum = graph_.constant(0);
        for (const auto& [c, monomial] : terms)
            sum = graph_.add(sum, graph_.multiply(graph_.constant(c * common), monomial));
        if (is_constant(sum) || known().contains(at_points(fixed({sum}))[0])) return;
        const ZeroDecider decider(graph_, setting());
        if (std::ranges::all_of(flows, [&](const Flow& flow) {
                const NodeId rate = fixed(directional(graph_, std::vector{sum}, flow))[0];
                return graph_.is_zero(rate) || decider.status(rate) == ProofStatus::proved;
            }))
            found_.push_back({sum, at_values_});
    }

    /// Whether it is a function of the parameters alone.
    [[nodiscard]] bool is_constant(NodeId f)
    {
        std::vector<NodeId> z = system_.algebroid.x;
        z.insert(z.end(), system_.mu.begin(), system_.mu.end());
        const long double size = length_of(at_points(fixed({f}))[0]);
        return std::ranges::all_of(at_points(fixed(gradient(graph_, f, z))),
                                   [&](const Numbers& slope) { return length_of(slope) <= negligible * size; });
    }

    /// 1, H, the invariants found, the Casimirs of the base, and products of two of them.
    [[nodiscard]] OrthonormalSpan known()
    {
        std::vector<NodeId> functions{phase_.hamiltonian};
        for (const NodeId casimir : system_.functions.casimirs) functions.push_back(casimir);
        for (const FoundInvariant& each : found_) functions.push_back(each.value);
        const std::size_t count = functions.size();
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t j = i; j < count; ++j) functions.push_back(graph_.multiply(functions[i], functions[j]));
        OrthonormalSpan span(negligible);
        (void)span.add(Numbers(points_.size(), 1.0L));
        for (const Numbers& values : at_points(fixed(functions))) (void)span.add(values);
        return span;
    }

    Graph& graph_;
    const System& system_;
    PhaseSystem phase_;
    InvariantAnsatz ansatz_;
    Replacements values_;
    bool at_values_ = false; ///< the parameters are those of the file
    std::size_t momenta_ = 0;
    std::vector<NodeId> monomials_;
    std::vector<std::map<std::string, long double>> points_;
    std::vector<FoundInvariant> found_;
};

} // namespace

std::vector<FoundInvariant> find_invariants(Graph& graph, const System& system, const HamiltonianNodes& hamiltonian,
                                            const InvariantAnsatz& ansatz)
{
    return InvariantSearch(graph, system, hamiltonian, ansatz).run();
}

} // namespace lagen
