// SPDX-License-Identifier: GPL-2.0-or-later
/// The claims of a model, one kind after another, with names for people.
#include "geometry/claims.hpp"
#include "geometry/equations_of_motion.hpp"

namespace lagen {

/// The flip of one sign in [e_a, e_b] with which all its anchor equations hold, as a hint; empty where there is none.
std::string Claims::sign_hint(const std::vector<Residual>& residuals, std::size_t a, std::size_t b)
{
    for (const ColumnEntry& entry : lowered_.C(a, b)) {
        std::vector<NodeId> repaired(lowered_.x.size(), graph_.constant(0));
        for (const Residual& residual : residuals)
            if (residual.name == "anchor" && residual.indices[0] == a && residual.indices[1] == b)
                repaired[residual.indices[2]] = residual.value;
        for (const ColumnEntry& anchor : lowered_.anchor[entry.index]) {
            const NodeId product = graph_.multiply(anchor.value, entry.value);
            repaired[anchor.index] = graph_.add(repaired[anchor.index], graph_.add(product, product));
        }
        bool holds = true;
        for (const NodeId residual : repaired)
            holds = holds && (graph_.is_zero(residual) || decider_->decide(residual).status == ProofStatus::proved);
        if (holds)
            return "the anchor equations of [" + algebroid_.fibre[a].name + ", " + algebroid_.fibre[b].name +
                   "] hold with the opposite sign of its component " + algebroid_.fibre[entry.index].name;
    }
    return {};
}

void Claims::decide_structure(VerifiedAlgebroid& verified)
{
    ResidualList list;
    append_antisymmetry(list, graph_, lowered_);
    append_anchor(list, graph_, *partial_, lowered_);
    append_jacobi(list, graph_, *partial_, lowered_);
    verified.note = note_;
    verified.trivial += list.trivial;
    std::map<std::pair<std::size_t, std::size_t>, std::string> hints;
    for (const Residual& residual : list.residuals) {
        Check check{residual.name, {}, decide(residual.value, *decider_), {}};
        for (std::size_t k = 0; k < residual.indices.size(); ++k) {
            const bool base = residual.name == "anchor" && k == 2;
            check.indices.push_back((base ? algebroid_.base : algebroid_.fibre)[residual.indices[k]].name);
        }
        if (residual.name == "anchor" && check.decision.status == ProofStatus::refuted) {
            const std::pair<std::size_t, std::size_t> pair(residual.indices[0], residual.indices[1]);
            if (!hints.contains(pair)) hints[pair] = sign_hint(list.residuals, pair.first, pair.second);
            check.hint = hints[pair];
        }
        verified.checks.push_back(std::move(check));
    }
}

/// rho_a(f) = 0 for every section; indices (section, text).
void Claims::decide_anchor_derivative(VerifiedAlgebroid& verified, const std::string& name, const std::string& text,
                                      NodeId f)
{
    for (std::size_t a = 0; a < lowered_.r(); ++a) {
        std::vector<NodeId> terms;
        partial_->append_anchor_derivative(terms, lowered_.anchor[a], f, false);
        if (terms.empty()) {
            ++verified.trivial;
            continue;
        }
        verified.checks.push_back({name, {algebroid_.fibre[a].name, text}, decide(graph_.sum(terms), *decider_), {}});
    }
}

void Claims::decide_surfaces(VerifiedAlgebroid& verified)
{
    for (std::size_t k = 0; k < algebroid_.constraints.size(); ++k)
        decide_anchor_derivative(verified, "tangency", to_text(algebroid_.constraints[k]), setting_.constraints[k]);
    for (const NamedTree& casimir : model_.base.casimirs)
        decide_anchor_derivative(verified, "casimir", casimir.name, (*lower_)(casimir.value));
}

void Claims::decide_invariants(VerifiedAlgebroid& verified, const std::vector<NamedTree>& extra)
{
    EquationsOfMotion motion(graph_, lowered_, hessian_ ? &*hessian_ : nullptr, time_);
    Binding binding = motion.names(model_);
    binding.insert(binding_.begin(), binding_.end());
    Lowering lower(graph_, binding);
    std::vector<NamedTree> claims = model_.invariants;
    claims.insert(claims.end(), extra.begin(), extra.end());
    for (const NamedTree& claim : claims) {
        Check check{"invariant", {claim.name}, {}, {}};
        const NodeId f = lower(claim.value);
        const Rate rate = motion.rate(f);
        if (!rate.value) {
            check.decision.evidence = rate.obstacle;
        } else {
            // d log(x)/dt = xdot/x is defined where log(x) is not: the claim is about points where f is.
            ProofSetting setting = setting_;
            setting.defined.push_back(motion.in_states(f));
            check.decision = decide(*rate.value, ZeroDecider(graph_, setting));
        }
        verified.checks.push_back(std::move(check));
    }
}

} // namespace lagen
