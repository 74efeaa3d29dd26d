// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/report_check.hpp"

#include "model/families.hpp"
#include "text/comma_list.hpp"
#include "text/record.hpp"
#include "verify/verify.hpp"

#include <array>
#include <fmt/format.h>
#include <map>
#include <set>

namespace lagen {

namespace {

// Lines of `check` on a nonholonomic model, beside its verdict.

/// "v_x = sin(th), v_y = -cos(th)"
template <class Values>
std::string values_text(const Values& values)
{
    std::string text;
    for (const auto& [name, value] : values) text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", name, value);
    return text;
}

std::string point_text(const Witness& witness)
{
    std::string text;
    for (const auto& [name, value] : witness.point)
        text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", name, to_text(value));
    return text.empty() ? "every point" : text;
}

std::string integrable_text(const Integrability& integrable)
{
    switch (integrable.status) {
    case ProofStatus::proved:
        return fmt::format("  {:<16}yes: brackets of sections lie in their span{}\n", "integrable",
                           integrable.moves_with_time ? " at each t"
                           : integrable.has_drift     ? ""
                                                      : ", and kind = \"subbundle\" says more");
    case ProofStatus::undecided: return fmt::format("  {:<16}not decided\n", "integrable");
    case ProofStatus::refuted: break;
    }
    std::string text = fmt::format("  {:<16}no: [{}, {}] is {}\n", "integrable", integrable.bracket[0],
                                   integrable.bracket[1], values_text(integrable.components));
    text += fmt::format("  {:<16}{} is 0 on the sections\n", "", integrable.violates);
    if (integrable.witness)
        text += fmt::format("  {:<16}and {:.17g} on their bracket at {}\n", "", integrable.witness->value,
                            point_text(*integrable.witness));
    return text;
}

std::string conserved_text(const ConservedEnergy& energy)
{
    const std::string name = energy.name == "energy" ? "energy" : "moving energy";
    const char* what = energy.status == ProofStatus::proved    ? "conserved"
                       : energy.status == ProofStatus::refuted ? "not conserved"
                                                               : "not decided whether conserved";
    return fmt::format("  {:<16}{}\n", name, what);
}

/// Empty for other models.
std::string nonholonomic_text(const MechanicsReport& mechanics)
{
    std::string text;
    if (mechanics.integrable) text += integrable_text(*mechanics.integrable);
    if (mechanics.conserved) text += conserved_text(*mechanics.conserved);
    return text;
}

/// Adds "integrable" and "conserved"; nothing for other models.
void add_nonholonomic(Record& record, const MechanicsReport& mechanics)
{
    if (const auto& integrable = mechanics.integrable) {
        Record& member = record["integrable"] = {{"status", to_text(integrable->status)}};
        if (integrable->status == ProofStatus::refuted) {
            member["bracket"] = integrable->bracket;
            member["is"] = object_of(integrable->components, [](const auto& value) { return value; });
            member["violates"] = integrable->violates;
            if (integrable->witness) {
                member["witness"] = object_of(integrable->witness->point, [](const auto& x) { return to_text(x); });
                member["value"] = integrable->witness->value;
            }
        }
        if (integrable->status == ProofStatus::proved && !integrable->has_drift && !integrable->moves_with_time)
            member["hint"] = "D is a Lie algebroid: kind = \"subbundle\" says more of it";
    }
    if (const auto& energy = mechanics.conserved)
        record["conserved"] = {{"name", energy->name}, {"status", to_text(energy->status)}};
}

// Sentences that say what a check has decided.

/// "a,b" of (A, a, b); "value" of a function.
std::string component_of(const Check& check)
{
    std::string text;
    for (std::size_t k = 1; k < check.indices.size(); ++k) text += (k == 1 ? "" : ",") + check.indices[k];
    return text.empty() ? "value" : text;
}

/// The equation that a claim of a morphism Phi over phi makes, in words of its indices.
std::string map_equation_text(const Check& check)
{
    const std::vector<std::string>& k = check.indices;
    if (check.name == "constraint" && k[0] == "Phi(D)") return "the rank of D' less that of Phi(D)";
    if (check.name == "constraint" && k.size() == 2 && k[0].starts_with("Phi("))
        return fmt::format("component {} of {} less its part along the constraint of the target", k[1], k[0]);
    if (check.name == "constraint" && k.size() == 1)
        return fmt::format("the constraint {} of the target at phi(x)", k[0]);
    if (check.name == "admissible" && k.size() == 2)
        return fmt::format("coordinate {1} of rho'(Phi({0})) - Tphi(rho({0}))", k[0], k[1]);
    if (check.name == "morphism" && k.size() == 3)
        return fmt::format("component {2} of [Phi({0}), Phi({1})] - Phi([{0}, {1}])", k[0], k[1], k[2]);
    if (check.name == "invariance" && k.size() == 1)
        return fmt::format("{0} of the source less {0} of the target along the map", k[0]);
    if (check.name == "invariance" && k.size() == 2)
        return fmt::format("{} of the source, component {}, less that of the target along the map", k[0], k[1]);
    if (check.name == "target" && k.size() == 1)
        return fmt::format("coordinate {} of the target of the image less phi(t(g))", k[0]);
    if (check.name == "product" && k.size() == 2)
        return fmt::format("entry {},{} of W'(g h) - W'(g) W'(h)", k[0], k[1]);
    if (check.name == "unit" && k.size() == 2) return fmt::format("entry {},{} of W' - 1 at the arrows 1", k[0], k[1]);
    if (check.name == "element") return "an entry of dW' at the arrows 1 outside of the algebra of the target's group";
    if (check.name == "fibre" && k.size() == 2)
        return fmt::format("component {} of Phi({}) as it is given less that of the map of arrows", k[0], k[1]);
    return "";
}

/// The equation that a check decides, in sections by name; empty for kinds whose name says it.
std::string equation_text(const Check& check)
{
    const std::vector<std::string>& k = check.indices;
    if (!check.meaning.empty()) return check.meaning;
    if (check.name == "antisymmetry" && k.size() == 3)
        return fmt::format("component {2} of [{0}, {1}] + [{1}, {0}]", k[0], k[1], k[2]);
    if (check.name == "anchor" && k.size() == 3)
        return fmt::format("component {2} of [rho({0}), rho({1})] - rho([{0}, {1}])", k[0], k[1], k[2]);
    if (check.name == "jacobi" && k.size() == 4)
        return fmt::format("component {3} of [{0}, [{1}, {2}]] + [{1}, [{2}, {0}]] + [{2}, [{0}, {1}]]", k[0], k[1],
                           k[2], k[3]);
    if (check.name == "tangency" && k.size() == 2)
        return fmt::format("rho({}) of the constraint {}, on the constraints", k[0], k[1]);
    if (check.name == "casimir" && k.size() == 2) return fmt::format("rho({}) of {}", k[0], k[1]);
    if (check.name == "unit" && k.size() == 1) return fmt::format("coordinate {0} of x.1 less {0}", k[0]);
    if (check.name == "action" && k.size() == 2)
        return fmt::format("d/ds {1} of x.(W exp(s E)) less {1} of the field of the action at x.W, generator {0}", k[0],
                           k[1]);
    if (check.name == "action" && k.size() == 1) return fmt::format("coordinate {} of x.(W W') less (x.W).W'", k[0]);
    if (check.name == "algebroid_of_groupoid" && k.size() == 2)
        return fmt::format("coordinate {1} of rho({0}) as it is given less that of the groupoid", k[0], k[1]);
    if (check.name == "algebroid_of_groupoid" && k.size() == 3)
        return fmt::format("component {2} of [{0}, {1}] as it is given less that of the groupoid", k[0], k[1], k[2]);
    if (const std::string of_map = map_equation_text(check); !of_map.empty()) return of_map;
    if (check.name == "constraint" && k.size() == 2)
        return k[0] == "drift" ? fmt::format("{} at the drift", k[1])
                               : fmt::format("the linear part of {} at the section {}", k[1], k[0]);
    if (check.name == "closed" && !k.empty()) return fmt::format("component {} of d({})", component_of(check), k[0]);
    if (check.name == "equals" && !k.empty())
        return fmt::format("component {} of {} less what it is said to equal", component_of(check), k[0]);
    if (check.name == "legendre") return "H at mu = dL/dy less y dL/dy - L";
    if (check.name == "maximum") return "H = mu_a sigma^a - cost is largest at the controls of Pontryagin's equations";
    if (check.name == "symmetry" && !k.empty())
        return fmt::format("the derivative of the Lagrangian (Hamiltonian) along the complete lift of {}", k[0]);
    if (check.name == "invariant" && k.size() == 1)
        return fmt::format("the rate of {} along the equations of motion", k[0]);
    return "";
}

const char* kind_text(Regularity::Kind kind)
{
    switch (kind) {
    case Regularity::Kind::regular: return "regular";
    case Regularity::Kind::generically_regular: return "generically_regular";
    case Regularity::Kind::degenerate: return "degenerate";
    case Regularity::Kind::absent: return "absent";
    case Regularity::Kind::undecided: return "undecided";
    }
    return "undecided";
}

/// "x = 1, y = 3/5" of named values that have a text.
template <class Values>
std::string values_text(const Values& values, const char* prefix)
{
    return comma_list(values, [&](const auto& entry) {
        return fmt::format("{}{} = {}", prefix, entry.first, to_text(entry.second));
    });
}

std::string witness_text(const NamedPoint& point)
{
    return point.empty() ? "every point" : values_text(point, "");
}

std::string indices_text(const Check& check)
{
    return check.indices.empty() ? "" : fmt::format(" ({})", comma_list(check.indices));
}

/// The names of checks in order of first appearance.
std::vector<std::string> kinds_of(const StructureReport& structure)
{
    std::vector<std::string> kinds;
    for (const Check& check : structure.checks) {
        bool known = false;
        for (const std::string& kind : kinds) known = known || kind == check.name;
        if (!known) kinds.push_back(check.name);
    }
    return kinds;
}

/// How many checks of a kind (of every kind: "") have each status.
std::array<std::size_t, 3> counts_of(const StructureReport& structure, const std::string& kind)
{
    std::array<std::size_t, 3> counts{};
    for (const Check& check : structure.checks)
        if (kind.empty() || check.name == kind) ++counts[static_cast<std::size_t>(check.decision.status)];
    return counts;
}

std::string counts_text(const std::array<std::size_t, 3>& counts)
{
    return comma_list(std::array{ProofStatus::proved, ProofStatus::refuted, ProofStatus::undecided},
                      [&](ProofStatus status) {
                          const std::size_t count = counts[static_cast<std::size_t>(status)];
                          return count == 0 ? "" : fmt::format("{} {}", count, to_text(status));
                      });
}

/// "24 equations zero by structure, 12 proved"
std::string summary_text(const StructureReport& structure)
{
    const std::string counts = counts_text(counts_of(structure, ""));
    const std::string trivial = structure.trivial == 0 ? ""
                                                       : fmt::format("{} {} zero by structure", structure.trivial,
                                                                     structure.trivial == 1 ? "equation" : "equations");
    if (trivial.empty() && counts.empty()) return "";
    return fmt::format("  {}\n", comma_list(std::array{trivial, counts}));
}

std::string failure_text(const Check& check, bool with_hint)
{
    const Decision& decision = check.decision;
    std::string text = fmt::format("\n{}: {}{}\n", to_text(decision.status), check.name, indices_text(check));
    if (const std::string equation = equation_text(check); !equation.empty()) text += fmt::format("  {}\n", equation);
    if (!decision.residual.empty()) text += fmt::format("  residual {}\n", decision.residual);
    if (decision.witness)
        text += fmt::format("  at {}: {:.17g}\n", witness_text(decision.witness->point), decision.witness->value);
    if (!decision.evidence.empty()) text += fmt::format("  known: {}\n", decision.evidence);
    if (with_hint) text += fmt::format("  hint: {}\n", check.hint);
    return text;
}

/// "casimir f" of what one line of the model claims, an entry f[1,2] too; empty of every other check.
std::string claim_of(const Check& check)
{
    if (check.name == "tangency") return check.name + " " + check.indices.back();
    if (check.name != "casimir" && check.name != "invariant") return "";
    return check.name + " " + family_name(check.indices.back());
}

/// Checks with a status, a hint only where it first occurs; of one claim the first, with the number of the others.
std::string failures_text(const StructureReport& structure, ProofStatus status)
{
    constexpr std::size_t most = 20;
    std::map<std::string, std::size_t> of_claim;
    for (const Check& check : structure.checks)
        if (check.decision.status == status) ++of_claim[claim_of(check)];
    std::string text;
    std::set<std::string> hints = {""}, told;
    std::size_t count = 0;
    for (const Check& check : structure.checks) {
        const std::string claim = claim_of(check);
        if (check.decision.status != status || (!claim.empty() && !told.insert(claim).second)) continue;
        if (++count > most) continue;
        text += failure_text(check, hints.insert(check.hint).second);
        if (const std::size_t others = of_claim[claim] - 1; !claim.empty() && others > 0)
            text += fmt::format("  and {} more of {}; --format json lists them all\n", others, claim);
    }
    if (count > most)
        text += fmt::format("\n{} more are {}; --format json lists them all\n", count - most, to_text(status));
    return text;
}

/// Which matrix it is, where it is not d2L/dy2.
const char* matrix_text(Regularity::Matrix matrix)
{
    switch (matrix) {
    case Regularity::Matrix::lagrangian: break;
    case Regularity::Matrix::hamiltonian: return "d2H/dmu2: the model has no Lagrangian";
    case Regularity::Matrix::constrained: return "d2L/dY2 on the constraint";
    case Regularity::Matrix::newton: return "N_ab = <-e_b(F^-L_a) of the discrete Lagrangian";
    }
    return "";
}

std::string regularity_text(const Regularity& regularity)
{
    if (regularity.kind == Regularity::Kind::absent) return "";
    if (regularity.is_first_order())
        return fmt::format("  {:<16}H is affine in the momenta: a first-order system ẋ = ρ(∂H/∂μ), with costates\n",
                           "regularity");
    const std::string rank =
        regularity.kind == Regularity::Kind::undecided ? "" : fmt::format(", rank {}", regularity.rank);
    std::string text = fmt::format("  {:<16}{}{}{}{}\n", "regularity", kind_text(regularity.kind), rank,
                                   regularity.positive_definite ? ", positive definite" : "",
                                   regularity.for_given_parameters ? " (for the parameter values of the file)" : "");
    if (const char* matrix = matrix_text(regularity.of); *matrix != '\0')
        text += fmt::format("  {:<16}of {}\n", "", matrix);
    if (regularity.kind == Regularity::Kind::degenerate && regularity.of != Regularity::Matrix::hamiltonian)
        text += fmt::format("  {:<16}`generate` and `run` refuse a degenerate Lagrangian\n", "");
    for (const auto& vector : regularity.kernel)
        text += fmt::format("  {:<16}kernel vector {}\n", "", values_text(vector, "k_"));
    if (!regularity.evidence.empty()) text += fmt::format("  {:<16}{}\n", "", regularity.evidence);
    const std::string equations = comma_list(
        regularity.singular_where, [](const std::string& factor) { return factor + " = 0"; }, " or ");
    if (!equations.empty()) text += fmt::format("  {:<16}singular where {}\n", "", equations);
    if (regularity.singular_everywhere)
        text += fmt::format("  {:<16}singular everywhere for the parameter values of the file\n", "");
    for (const NamedPoint& point : regularity.singular_at)
        text += fmt::format("  {:<16}singular at {}\n", "", witness_text(point));
    if (!regularity.coordinates.empty()) text += fmt::format("  {:<16}{}\n", "", regularity.coordinates);
    return text;
}

const char* closed_text(ProofStatus closed)
{
    if (closed == ProofStatus::undecided) return "not decided whether closed";
    return closed == ProofStatus::proved ? "closed" : "not closed";
}

const char* lifts_text(ProofStatus lifts)
{
    if (lifts == ProofStatus::undecided) return "not decided whether integral curves of ρ(∂H/∂μ ∘ α) lift to solutions";
    return lifts == ProofStatus::proved
               ? "along integral curves of ρ(∂H/∂μ ∘ α) the momenta α solve Hamilton's equations"
               : "along integral curves of ρ(∂H/∂μ ∘ α) the momenta α do not solve Hamilton's equations";
}

const char* action_text(ProofStatus action)
{
    if (action == ProofStatus::undecided) return "not decided whether ∫ (L + H) dt along them is the integral of α";
    return action == ProofStatus::proved
               ? "along them ∫ (L + H) dt is the integral of α: S(x(t₁)) - S(x(t₀)) where α = dS"
               : "along them ∫ (L + H) dt is not the integral of α";
}

/// How a proved maximum is known, where more is to be said of it than its name says.
std::string maximum_text(const StructureReport& structure)
{
    std::string text;
    for (const Check& check : structure.checks)
        if (check.name == "maximum" && check.decision.status == ProofStatus::proved && !check.decision.evidence.empty())
            text += fmt::format("  {:<16}{}\n", "", check.decision.evidence);
    return text;
}

/// "x != 0 and y > 0" of each check that is proved there alone.
std::string where_text(const StructureReport& structure, const std::string& kind)
{
    std::string text;
    for (const Check& check : structure.checks)
        if (check.name == kind && !check.where.empty())
            text += fmt::format("  {:<16}{} where {}; may change where a motion crosses\n", "",
                                fmt::join(check.indices, ", "), fmt::join(check.where, " and "));
    return text;
}

template <class Values>
Record values_record(const Values& values)
{
    return object_of(values, [](const auto& value) { return to_text(value); });
}

Record record_of(const Check& check)
{
    const Decision& decision = check.decision;
    Record record = {{"name", check.name},
                     {"indices", check.indices},
                     {"status", to_text(decision.status)},
                     {"residual", decision.residual}};
    if (decision.witness) {
        record["witness"] = values_record(decision.witness->point);
        record["value"] = decision.witness->value;
    }
    add_unless_empty(record, "where", check.where);
    add_unless_empty(record, "evidence", decision.evidence);
    add_unless_empty(record, "hint", check.hint);
    return record;
}

/// The matrix whose rank it is, where that is not d2L/dy2.
const char* matrix_name(Regularity::Matrix matrix)
{
    switch (matrix) {
    case Regularity::Matrix::lagrangian: break;
    case Regularity::Matrix::hamiltonian: return "d2H/dmu2";
    case Regularity::Matrix::constrained: return "d2L/dY2 on D";
    case Regularity::Matrix::newton: return "N";
    }
    return "";
}

Record record_of(const Regularity& regularity)
{
    Record record = {{"status", kind_text(regularity.kind)},
                     {"rank", regularity.kind == Regularity::Kind::undecided ? Record() : Record(regularity.rank)},
                     {"positive_definite", regularity.positive_definite},
                     {"for_given_parameters", regularity.for_given_parameters}};
    add_unless_empty(record, "evidence", regularity.evidence);
    add_unless_empty(record, "coordinates", regularity.coordinates);
    add_unless_empty(record, "of", std::string(matrix_name(regularity.of)));
    const auto values = [](const auto& each) { return values_record(each); };
    if (regularity.kind == Regularity::Kind::degenerate) record["kernel"] = list_of(regularity.kernel, values);
    record["singular_everywhere"] = regularity.singular_everywhere;
    record["singular_at"] = list_of(regularity.singular_at, values);
    record["singular_where"] = regularity.singular_where;
    return record;
}

} // namespace

ExitCode code_of(Verdict verdict)
{
    switch (verdict) {
    case Verdict::valid: return ExitCode::done;
    case Verdict::invalid: return ExitCode::refuted;
    case Verdict::undecided: return ExitCode::undecided;
    }
    return ExitCode::undecided;
}

std::string claims_text(const StructureReport& structure)
{
    std::string text = summary_text(structure);
    for (const std::string& kind : kinds_of(structure)) {
        text += fmt::format("  {:<15} {}\n", kind, counts_text(counts_of(structure, kind)));
        text += where_text(structure, kind);
        if (kind == "maximum") text += maximum_text(structure);
    }
    return text;
}

std::string failures_text(const StructureReport& structure)
{
    return failures_text(structure, ProofStatus::refuted) + failures_text(structure, ProofStatus::undecided);
}

std::string report_text(const std::string& model, const Report& verified)
{
    const StructureReport& structure = verified.structure;
    std::string text = fmt::format("{}: {}\n{}", model, to_text(structure.verdict), claims_text(structure));
    for (const FormReport& form : structure.forms)
        text += fmt::format("  {:<16}degree {}, {}\n", "form " + form.name, form.degree, closed_text(form.closed));
    if (const auto& candidate = structure.hamilton_jacobi) {
        text += fmt::format("  {:<16}{}\n", "solutions", lifts_text(candidate->lifts));
        if (candidate->action) text += fmt::format("  {:<16}{}\n", "action", action_text(*candidate->action));
    }
    for (const Regularity* each : {&verified.mechanics.discrete, &verified.mechanics.regularity})
        text += regularity_text(*each);
    text += nonholonomic_text(verified.mechanics);
    if (!structure.note.empty()) text += fmt::format("  note: {}\n", structure.note);
    return text + failures_text(structure);
}

Record checks_record(const std::vector<Check>& checks)
{
    return list_of(checks, [](const Check& check) { return record_of(check); });
}

void add_structure(Record& record, const StructureReport& structure)
{
    record["trivial"] = structure.trivial;
    record["checks"] = checks_record(structure.checks);
    add_unless_empty(record, "forms", list_of(structure.forms, [](const FormReport& form) {
                         return Record{{"name", form.name}, {"degree", form.degree}, {"closed", to_text(form.closed)}};
                     }));
    if (const auto& candidate = structure.hamilton_jacobi) {
        Record& member = record["hamilton_jacobi"] = {{"closed", to_text(candidate->closed)},
                                                      {"constant_on_leaves", to_text(candidate->equation)},
                                                      {"lifts", to_text(candidate->lifts)}};
        if (candidate->action) member["action"] = to_text(*candidate->action);
    }
}

Record record_of(const std::string& model, const Report& verified)
{
    const StructureReport& structure = verified.structure;
    Record record = {{"model", model}, {"verdict", to_text(structure.verdict)}};
    add_structure(record, structure);
    const Regularity &discrete = verified.mechanics.discrete, &regularity = verified.mechanics.regularity;
    const bool is_discrete = discrete.kind != Regularity::Kind::absent;
    record["regularity"] = record_of(is_discrete ? discrete : regularity);
    if (is_discrete && regularity.kind != Regularity::Kind::absent)
        record["regularity_of_lagrangian"] = record_of(regularity);
    add_nonholonomic(record, verified.mechanics);
    add_unless_empty(record, "note", structure.note);
    return record;
}

} // namespace lagen
