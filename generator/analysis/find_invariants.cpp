// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/find_invariants.hpp"

#include "analysis/generic_points.hpp"
#include "geometry/orthonormal_span.hpp"
#include "geometry/rational_near.hpp"
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

constexpr long double negligible_part = 1e-10L; ///< of what is 0 but for rounding
constexpr std::size_t more_points = 16;         ///< than unknowns

constexpr std::size_t rank_points = 5;

/// Factors of monomials, none of them over t: `momenta` first.
class Generators {
  public:
    Generators(Graph& graph, const System& system, std::vector<NodeId> momenta)
        : graph_(graph), system_(system), momenta_(std::move(momenta))
    {
    }

    /// Coordinates outside of functions, and the functions, roots and divisors in `roots`.
    [[nodiscard]] std::vector<NodeId> of_energy(const std::vector<NodeId>& roots)
    {
        const std::vector<NodeId> parts = parts_of(roots), functions = functions_in(parts);
        std::set<NodeId> inside; // coordinates under functions of angles and the like
        for (const NodeId f : functions)
            if (graph_.op(f) != Op::sqrt)
                for (const NodeId x : system_.algebroid.x)
                    if (is_of(f, {x})) inside.insert(x);
        std::vector<NodeId> out = momenta_;
        for (const NodeId x : system_.algebroid.x)
            if (!inside.contains(x)) out.push_back(x);
        out.insert(out.end(), functions.begin(), functions.end());
        add_factors(out, parts, functions);
        return out;
    }

    /// All coordinates and the functions in `roots`, sin beside cos.
    [[nodiscard]] std::vector<NodeId> of_fields(const std::vector<NodeId>& roots)
    {
        const std::vector<NodeId> parts = parts_of(roots), functions = functions_in(parts);
        std::vector<NodeId> out = system_.algebroid.x;
        const auto append = [&](NodeId node) {
            if (std::ranges::find(out, node) == out.end()) out.push_back(node);
        };
        for (const NodeId f : functions) {
            append(f);
            if (graph_.op(f) == Op::sin) append(graph_.apply(Op::cos, graph_.operands(f)[0]));
            if (graph_.op(f) == Op::cos) append(graph_.apply(Op::sin, graph_.operands(f)[0]));
        }
        add_factors(out, parts, functions);
        return out;
    }

  private:
    [[nodiscard]] bool is_of(NodeId node, const std::vector<NodeId>& inputs) const
    {
        const NodeId self[] = {node};
        return depends_on_any(graph_, self, inputs);
    }

    [[nodiscard]] std::vector<NodeId> parts_of(const std::vector<NodeId>& roots) const
    {
        std::vector<NodeId> parts = reachable(graph_, roots);
        std::erase_if(parts, [&](NodeId node) { return is_of(node, {system_.time}); });
        return parts;
    }

    [[nodiscard]] std::vector<NodeId> functions_in(const std::vector<NodeId>& parts) const
    {
        std::vector<NodeId> functions;
        for (const NodeId node : parts)
            if (kind_of(graph_.op(node)) == OpKind::function && !is_of(node, momenta_) &&
                is_of(node, system_.algebroid.x))
                functions.push_back(node);
        return functions;
    }

    /// Divisors, and functions with the parameters that they are multiplied by.
    void add_factors(std::vector<NodeId>& out, const std::vector<NodeId>& parts, const std::vector<NodeId>& functions)
    {
        const auto is_parameter = [&](NodeId node) {
            return !is_of(node, momenta_) && !is_of(node, system_.algebroid.x) && is_of(node, system_.parameters);
        };
        for (const NodeId node : parts) {
            const Op op = graph_.op(node);
            if (op != Op::divide && op != Op::multiply) continue;
            const NodeId a = graph_.operands(node)[0], b = graph_.operands(node)[1];
            NodeId factor = node;
            if (op == Op::divide) {
                if (is_of(b, momenta_) || !is_of(b, system_.algebroid.x)) continue;
                if (!is_parameter(a)) factor = graph_.divide(graph_.constant(1), b);
            } else {
                const bool scales = (is_parameter(a) && std::ranges::find(functions, b) != functions.end()) ||
                                    (is_parameter(b) && std::ranges::find(functions, a) != functions.end());
                if (!scales) continue;
            }
            if (std::ranges::find(out, factor) == out.end()) out.push_back(factor);
        }
    }

    Graph& graph_;
    const System& system_;
    std::vector<NodeId> momenta_;
};

/// By degree, then in the order of the generators, at most two of the first `momenta` in each.
std::vector<NodeId> monomials(Graph& graph, const std::vector<NodeId>& generators, std::size_t momenta,
                              const InvariantAnsatz& ansatz)
{
    struct Term {
        NodeId value;
        std::size_t last, momenta;
    };
    std::vector<NodeId> out;
    std::vector<Term> before{{graph.constant(1), 0, 0}};
    for (std::size_t degree = 1; degree <= ansatz.degree; ++degree) {
        std::vector<Term> now;
        for (const Term& term : before)
            for (std::size_t k = term.last; k < generators.size(); ++k) {
                const std::size_t more = term.momenta + (k < momenta ? 1 : 0);
                if (more <= 2) now.push_back({graph.multiply(term.value, generators[k]), k, more});
            }
        if (out.size() + now.size() > ansatz.monomials) break;
        for (const Term& term : now)
            if (std::ranges::find(out, term.value) == out.end()) out.push_back(term.value);
        before = std::move(now);
    }
    return out;
}

/// Combinations of monomials that are constant along flows, as they are or with `values` for parameters.
class ConstantSearch {
  public:
    /// `z`: what functions are differentiated by.
    ConstantSearch(Graph& graph, ProofSetting setting, std::vector<NodeId> z, Replacements values)
        : graph_(graph), setting_(std::move(setting)), z_(std::move(z)), values_(std::move(values))
    {
    }

    /// False where no points are found to search at. `known`: what found functions are no functions of.
    bool prepare(std::vector<NodeId> monomials, const std::vector<NodeId>& known)
    {
        monomials_ = std::move(monomials);
        points_ = generic_points(graph_, setting_, monomials_.size() + more_points);
        if (points_.size() < monomials_.size() + more_points) return false;
        few_.assign(points_.begin(), points_.begin() + rank_points);
        independent_.emplace(graph_, few_);
        for (const NodeId each : fixed(known)) (void)independent_->add_differential(each, z_);
        return true;
    }

    /// Functions that are constant along all flows.
    [[nodiscard]] std::vector<NodeId> search(const std::vector<Flow>& flows)
    {
        std::vector<NodeId> found;
        if (flows.empty()) return found;
        const std::vector<Numbers> values = at_points(fixed(monomials_));
        OrthonormalSpan independent(negligible_part);
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
        for (const Numbers& coefficients : kernel(std::move(columns), sizes))
            if (const std::optional<NodeId> function = taken(kept, coefficients, flows)) found.push_back(*function);
        return found;
    }

  private:
    /// With the parameters of the file, where these are fixed.
    [[nodiscard]] std::vector<NodeId> fixed(const std::vector<NodeId>& nodes)
    {
        return values_.empty() ? nodes : substitute(graph_, nodes, values_);
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
            if (!(length_of(columns[k]) > negligible_part * size)) {
                out.push_back(combination[k]);
                continue;
            }
            pivots.push_back(columns[k]);
            of_pivots.push_back(combination[k]);
            rows.push_back(row);
        }
        return out;
    }

    /// The combination, where it is new, rational and proved.
    [[nodiscard]] std::optional<NodeId> taken(const std::vector<NodeId>& monomials, const Numbers& coefficients,
                                              const std::vector<Flow>& flows)
    {
        std::vector<std::pair<Rational, NodeId>> terms;
        mpz_class common = 1; // denominator
        for (std::size_t k = 0; k < coefficients.size(); ++k) {
            if (std::abs(coefficients[k]) < negligible_part) continue;
            const std::optional<Rational> c = rational_near(coefficients[k], 1e-9L);
            if (!c) return {};
            common = lcm(common, c->get_den());
            terms.emplace_back(*c, monomials[k]);
        }
        NodeId sum = graph_.constant(0);
        for (const auto& [c, monomial] : terms)
            sum = graph_.add(sum, graph_.multiply(graph_.constant(c * common), monomial));
        if (is_constant(sum)) return {};
        GenericSpan with = *independent_;
        if (!with.add_differential(fixed({sum})[0], z_)) return {};
        const ZeroDecider decider(graph_, setting_);
        for (const Flow& flow : flows) {
            const NodeId rate = fixed(directional(graph_, std::vector{sum}, flow))[0];
            if (!graph_.is_zero(rate) && decider.status(rate) != ProofStatus::proved) return {};
        }
        independent_.emplace(std::move(with));
        return sum;
    }

    /// True of a function of the parameters alone.
    [[nodiscard]] bool is_constant(NodeId f)
    {
        const long double size = length_of(at_points(fixed({f}))[0]);
        return std::ranges::all_of(at_points(fixed(gradient(graph_, f, z_))),
                                   [&](const Numbers& slope) { return length_of(slope) <= negligible_part * size; });
    }

    Graph& graph_;
    ProofSetting setting_;
    std::vector<NodeId> z_;
    Replacements values_;
    std::vector<NodeId> monomials_;
    std::vector<NamedNumbers> points_, few_;
    std::optional<GenericSpan> independent_;
};

class InvariantSearch {
  public:
    InvariantSearch(Graph& graph, const System& system, const HamiltonianNodes& hamiltonian,
                    const InvariantAnsatz& ansatz)
        : graph_(graph), system_(system), phase_(hamilton_system(graph, system, hamiltonian)),
          monomials_(monomials(graph, Generators(graph, system, system.mu).of_energy({phase_.hamiltonian}),
                               system.mu.size(), ansatz))
    {
    }

    /// Invariants with coefficients that no parameter changes first, then those for the values of the file.
    std::vector<FoundInvariant> run()
    {
        std::vector<NodeId> z = system_.algebroid.x, known = system_.functions.constraints;
        z.insert(z.end(), system_.mu.begin(), system_.mu.end());
        known.insert(known.end(), system_.functions.casimirs.begin(), system_.functions.casimirs.end());
        known.push_back(phase_.hamiltonian);
        std::vector<FoundInvariant> out;
        for (const bool at_values : {false, true}) {
            if (at_values && system_.parameter_values.empty()) break;
            ConstantSearch search(graph_, setting(at_values), z, at_values ? system_.parameter_values : Replacements());
            if (!search.prepare(monomials_, known)) continue;
            for (const std::vector<Flow>& flows : {coordinate_flows(), {hamiltonian_flow()}})
                for (const NodeId found : search.search(flows)) {
                    known.push_back(found);
                    out.push_back({found, at_values});
                }
        }
        return out;
    }

  private:
    /// xdot and mudot.
    [[nodiscard]] Flow hamiltonian_flow() const
    {
        Flow flow = replacements(system_.algebroid.x, phase_.xdot);
        const Replacements more = replacements(phase_.mu, phase_.mudot);
        flow.insert(flow.end(), more.begin(), more.end());
        return flow;
    }

    /// The flows of the coordinates of E*, along which Casimirs are constant: {mu_a, x^i} = rho^i_a, {mu_a, mu_b} =
    /// C^c_ab mu_c. A function that is constant along those of the mu_a and that of the x^i is one.
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

    [[nodiscard]] ProofSetting setting(bool at_values)
    {
        ProofSetting made = proof_setting(graph_, system_);
        for (const NodeId mu : system_.mu)
            if (std::ranges::find(made.variables, mu) == made.variables.end()) made.variables.push_back(mu);
        // H may divide by parameters that no domain keeps from 0.
        for (const std::vector<NodeId>& nodes : {std::vector{phase_.hamiltonian}, phase_.xdot, phase_.mudot})
            for (const NodeId node : nodes)
                if (!graph_.is_constant(node)) made.defined.push_back(node);
        return at_values ? setting_at_values(graph_, std::move(made), system_.parameter_values) : made;
    }

    Graph& graph_;
    const System& system_;
    PhaseSystem phase_;
    std::vector<NodeId> monomials_;
};

} // namespace

std::vector<FoundInvariant> find_invariants(Graph& graph, const System& system, const HamiltonianNodes& hamiltonian,
                                            const InvariantAnsatz& ansatz)
{
    return InvariantSearch(graph, system, hamiltonian, ansatz).run();
}

std::vector<NodeId> find_constants(Graph& graph, const System& system, const std::vector<std::vector<NodeId>>& fields,
                                   const std::vector<NodeId>& known, std::size_t wanted)
{
    const std::vector<NodeId>& x = system.algebroid.x;
    std::vector<Flow> flows;
    for (const std::vector<NodeId>& field : fields) flows.push_back(replacements(x, field));
    const ProofSetting setting = setting_at_values(graph, proof_setting(graph, system), system.parameter_values);
    const std::vector<NodeId> generators = Generators(graph, system, {}).of_fields(joined_rows(fields));
    std::vector<NodeId> found, all = known;
    std::size_t count = 0;
    for (std::size_t degree = 1; degree <= InvariantAnsatz().degree && found.size() < wanted; ++degree) {
        std::vector<NodeId> now = monomials(graph, generators, 0, {degree});
        ConstantSearch search(graph, setting, x, {});
        if (now.size() == count || !search.prepare(now, all)) break; // more of that degree are too many
        count = now.size();
        for (const NodeId each : search.search(flows)) {
            found.push_back(each);
            all.push_back(each);
        }
    }
    return found;
}

} // namespace lagen
