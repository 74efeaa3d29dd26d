// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/report/check.hpp"

#include "model/families.hpp"
#include "text/comma_list.hpp"
#include "text/record.hpp"
#include "verify/verify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <span>

namespace lagen {

namespace {

/// One of three sentences, by what is known of a claim.
const char* said(ProofStatus status, const char* proved, const char* refuted, const char* undecided)
{
    return status == ProofStatus::proved ? proved : status == ProofStatus::refuted ? refuted : undecided;
}

/// "x = 1, y = 3/5" of named values that have a text; of an empty point that it is every one.
template <class Values>
std::string values_text(const Values& values, const char* prefix = "")
{
    if (values.empty()) return "every point";
    return comma_list(values, [&](const auto& entry) {
        return fmt::format("{}{} = {}", prefix, entry.first, to_text(entry.second));
    });
}

template <class Values>
Record values_record(const Values& values)
{
    return object_of(values, [](const auto& value) { return to_text(value); });
}

void add_witness(Record& record, const std::optional<Witness>& witness)
{
    if (!witness) return;
    record["witness"] = values_record(witness->point);
    record["value"] = witness->value;
}

// What a check of a nonholonomic model says beside its verdict.

std::string integrable_text(const Integrability& integrable)
{
    if (integrable.status != ProofStatus::refuted)
        return labelled("integrable", integrable.status == ProofStatus::undecided ? "not decided"
                                      : integrable.moves_with_time
                                          ? "yes: brackets of sections lie in their span at each t"
                                      : integrable.has_drift ? "yes: brackets of sections lie in their span"
                                                             : "yes: brackets of sections lie in their span, and kind "
                                                               "= \"subbundle\" says more");
    const std::string components = comma_list(
        integrable.components, [](const auto& entry) { return fmt::format("{} = {}", entry.first, entry.second); });
    std::string text = labelled("integrable", fmt::format("no: [{}, {}] is {}", integrable.bracket[0],
                                                          integrable.bracket[1], components)) +
                       labelled("", integrable.violates + " is 0 on the sections");
    if (integrable.witness)
        text += labelled("", fmt::format("and {:.17g} on their bracket at {}", integrable.witness->value,
                                         values_text(integrable.witness->point)));
    return text;
}

/// Empty for other models.
std::string nonholonomic_text(const MechanicsReport& mechanics)
{
    std::string text;
    if (mechanics.integrable) text += integrable_text(*mechanics.integrable);
    if (const auto& energy = mechanics.conserved)
        text += labelled(energy->name == "energy" ? "energy" : "moving energy",
                         said(energy->status, "conserved", "not conserved", "not decided whether conserved"));
    return text;
}

/// Adds "integrable" and "conserved"; nothing for other models.
void add_nonholonomic(Record& record, const MechanicsReport& mechanics)
{
    if (const auto& integrable = mechanics.integrable) {
        Record& member = record["integrable"] = {{"status", to_text(integrable->status)}};
        if (integrable->status == ProofStatus::refuted) {
            member["bracket"] = integrable->bracket;
            member["is"] = object_of(integrable->components, std::identity());
            member["violates"] = integrable->violates;
            add_witness(member, integrable->witness);
        }
        if (integrable->status == ProofStatus::proved && !integrable->has_drift && !integrable->moves_with_time)
            member["hint"] = "D is a Lie algebroid: kind = \"subbundle\" says more of it";
    }
    if (const auto& energy = mechanics.conserved)
        record["conserved"] = {{"name", energy->name}, {"status", to_text(energy->status)}};
}

// Sentences that say what a check has decided.

/// The equation of a check with so many indices, {0} to {3}; {4} is its component, "a,b" of (A, a, b).
struct Sentence {
    const char* check;
    std::size_t indices;
    const char* text;
};

constexpr std::size_t any_number = SIZE_MAX;

constexpr Sentence sentences[] = {
    {"antisymmetry", 3, "component {2} of [{0}, {1}] + [{1}, {0}]"},
    {"anchor", 3, "component {2} of [rho({0}), rho({1})] - rho([{0}, {1}])"},
    {"jacobi", 4, "component {3} of [{0}, [{1}, {2}]] + [{1}, [{2}, {0}]] + [{2}, [{0}, {1}]]"},
    {"tangency", 2, "rho({0}) of the constraint {1}, on the constraints"},
    {"casimir", 2, "rho({0}) of {1}"},
    {"unit", 1, "coordinate {0} of x.1 less {0}"},
    {"action", 2, "d/ds {1} of x.(W exp(s E)) less {1} of the field of the action at x.W, generator {0}"},
    {"action", 1, "coordinate {0} of x.(W W') less (x.W).W'"},
    {"algebroid_of_groupoid", 2, "coordinate {1} of rho({0}) as it is given less that of the groupoid"},
    {"algebroid_of_groupoid", 3, "component {2} of [{0}, {1}] as it is given less that of the groupoid"},
    {"constraint", 1, "the constraint {0} of the target at phi(x)"},
    {"constraint", 2, "the linear part of {1} at the section {0}"},
    {"admissible", 2, "coordinate {1} of rho'(Phi({0})) - Tphi(rho({0}))"},
    {"morphism", 3, "component {2} of [Phi({0}), Phi({1})] - Phi([{0}, {1}])"},
    {"invariance", 1, "{0} of the source less {0} of the target along the map"},
    {"invariance", 2, "{0} of the source, component {1}, less that of the target along the map"},
    {"target", 1, "coordinate {0} of the target of the image less phi(t(g))"},
    {"product", 2, "entry {0},{1} of W'(g h) - W'(g) W'(h)"},
    {"unit", 2, "entry {0},{1} of W' - 1 at the arrows 1"},
    {"element", any_number, "an entry of dW' at the arrows 1 outside of the algebra of the target's group"},
    {"fibre", 2, "component {1} of Phi({0}) as it is given less that of the map of arrows"},
    {"closed", any_number, "component {4} of d({0})"},
    {"equals", any_number, "component {4} of {0} less what it is said to equal"},
    {"legendre", any_number, "H at mu = dL/dy less y dL/dy - L"},
    {"maximum", any_number, "H = mu_a sigma^a - cost is largest at the controls of Pontryagin's equations"},
    {"symmetry", any_number, "the derivative of the Lagrangian (Hamiltonian) along the complete lift of {0}"},
    {"invariant", 1, "the rate of {0} along the equations of motion"},
};

/// The equation that a check decides, in sections by name; empty for kinds whose name says it.
std::string equation_text(const Check& check)
{
    std::vector<std::string> k = check.indices;
    if (!check.meaning.empty()) return check.meaning;
    if (check.name == "constraint" && k[0] == "Phi(D)") return "the rank of D' less that of Phi(D)";
    if (check.name == "constraint" && k[0].starts_with("Phi(") && k.size() == 2)
        return fmt::format("component {} of {} less its part along the constraint of the target", k[1], k[0]);
    if (check.name == "constraint" && k[0] == "drift" && k.size() == 2) return k[1] + " at the drift";
    const std::string component = k.size() < 2 ? "value" : comma_list(std::span(k).subspan(1), {}, ",");
    const std::size_t count = k.size();
    k.resize(4);
    for (const Sentence& each : sentences)
        if (check.name == each.check && (each.indices == any_number || each.indices == count))
            return fmt::format(fmt::runtime(each.text), k[0], k[1], k[2], k[3], component);
    return "";
}

const char* kind_text(Regularity::Kind kind)
{
    switch (kind) {
    case Regularity::Kind::regular: return "regular";
    case Regularity::Kind::generically_regular: return "generically_regular";
    case Regularity::Kind::degenerate: return "degenerate";
    case Regularity::Kind::absent: return "absent";
    case Regularity::Kind::undecided: break;
    }
    return "undecided";
}

/// "3 proved, 1 refuted" of the checks of a kind (of every kind: "").
std::string counts_text(const StructureReport& structure, const std::string& kind)
{
    return comma_list(std::array{ProofStatus::proved, ProofStatus::refuted, ProofStatus::undecided},
                      [&](ProofStatus status) {
                          const auto count = std::ranges::count_if(structure.checks, [&](const Check& check) {
                              return (kind.empty() || check.name == kind) && check.decision.status == status;
                          });
                          return count == 0 ? "" : fmt::format("{} {}", count, to_text(status));
                      });
}

/// "24 equations zero by structure, 12 proved"
std::string summary_text(const StructureReport& structure)
{
    const std::string trivial = structure.trivial == 0 ? ""
                                                       : fmt::format("{} {} zero by structure", structure.trivial,
                                                                     structure.trivial == 1 ? "equation" : "equations");
    const std::string text = comma_list(std::array{trivial, counts_text(structure, "")});
    return text.empty() ? "" : fmt::format("  {}\n", text);
}

std::string failure_text(const Check& check, bool with_hint)
{
    const Decision& decision = check.decision;
    const std::string indices = check.indices.empty() ? "" : fmt::format(" ({})", comma_list(check.indices));
    std::string text = fmt::format("\n{}: {}{}\n", to_text(decision.status), check.name, indices);
    if (const std::string equation = equation_text(check); !equation.empty()) text += fmt::format("  {}\n", equation);
    if (!decision.residual.empty()) text += fmt::format("  residual {}\n", decision.residual);
    if (decision.witness)
        text += fmt::format("  at {}: {:.17g}\n", values_text(decision.witness->point), decision.witness->value);
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

/// The matrix whose rank it is, where that is not d2L/dy2: its name, and what more a person is told of it.
std::pair<const char*, const char*> matrix_of(Regularity::Matrix matrix)
{
    switch (matrix) {
    case Regularity::Matrix::lagrangian: break;
    case Regularity::Matrix::hamiltonian: return {"d2H/dmu2", "d2H/dmu2: the model has no Lagrangian"};
    case Regularity::Matrix::constrained: return {"d2L/dY2 on D", "d2L/dY2 on the constraint"};
    case Regularity::Matrix::newton: return {"N", "N_ab = <-e_b(F^-L_a) of the discrete Lagrangian"};
    }
    return {"", ""};
}

std::string regularity_text(const Regularity& regularity)
{
    if (regularity.kind == Regularity::Kind::absent) return "";
    if (regularity.is_first_order())
        return labelled("regularity", "H is affine in the momenta: a first-order system ẋ = ρ(∂H/∂μ), with costates");
    const std::string rank =
        regularity.kind == Regularity::Kind::undecided ? "" : fmt::format(", rank {}", regularity.rank);
    std::string text = labelled(
        "regularity", fmt::format("{}{}{}{}", kind_text(regularity.kind), rank,
                                  regularity.positive_definite ? ", positive definite" : "",
                                  regularity.for_given_parameters ? " (for the parameter values of the file)" : ""));
    const auto add = [&](const std::string& value) { text += value.empty() ? "" : labelled("", value); };
    if (const char* matrix = matrix_of(regularity.of).second; *matrix != '\0') add(fmt::format("of {}", matrix));
    if (regularity.kind == Regularity::Kind::degenerate && regularity.of != Regularity::Matrix::hamiltonian)
        add("`generate` and `run` refuse a degenerate Lagrangian");
    for (const auto& vector : regularity.kernel) add("kernel vector " + values_text(vector, "k_"));
    add(regularity.evidence);
    const std::string equations = comma_list(
        regularity.singular_where, [](const std::string& factor) { return factor + " = 0"; }, " or ");
    if (!equations.empty()) add("singular where " + equations);
    if (regularity.singular_everywhere) add("singular everywhere for the parameter values of the file");
    for (const NamedPoint& point : regularity.singular_at) add("singular at " + values_text(point));
    add(regularity.coordinates);
    return text;
}

/// What is said of checks of a kind that are proved: where alone, or how the maximum is known.
std::string proved_text(const StructureReport& structure, const std::string& kind)
{
    std::string text;
    for (const Check& check : structure.checks) {
        if (check.name != kind) continue;
        if (!check.where.empty())
            text += labelled("", fmt::format("{} where {}; may change where a motion crosses",
                                             comma_list(check.indices), comma_list(check.where, {}, " and ")));
        if (kind == "maximum" && check.decision.status == ProofStatus::proved && !check.decision.evidence.empty())
            text += labelled("", check.decision.evidence);
    }
    return text;
}

Record record_of(const Check& check)
{
    const Decision& decision = check.decision;
    Record record = {{"name", check.name},
                     {"indices", check.indices},
                     {"status", to_text(decision.status)},
                     {"residual", decision.residual}};
    add_witness(record, decision.witness);
    add_unless_empty(record, "where", check.where);
    add_unless_empty(record, "evidence", decision.evidence);
    add_unless_empty(record, "hint", check.hint);
    return record;
}

Record record_of(const Regularity& regularity)
{
    Record record = {{"status", kind_text(regularity.kind)},
                     {"rank", regularity.kind == Regularity::Kind::undecided ? Record() : Record(regularity.rank)},
                     {"positive_definite", regularity.positive_definite},
                     {"for_given_parameters", regularity.for_given_parameters}};
    add_unless_empty(record, "evidence", regularity.evidence);
    add_unless_empty(record, "coordinates", regularity.coordinates);
    add_unless_empty(record, "of", std::string(matrix_of(regularity.of).first));
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
    for (const std::string& kind : distinct(structure.checks, &Check::name))
        text += labelled(kind, counts_text(structure, kind)) + proved_text(structure, kind);
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
        text += labelled("form " + form.name,
                         fmt::format("degree {}, {}", form.degree,
                                     said(form.closed, "closed", "not closed", "not decided whether closed")));
    if (const auto& candidate = structure.hamilton_jacobi) {
        text += labelled("solutions",
                         said(candidate->lifts,
                              "along integral curves of ρ(∂H/∂μ ∘ α) the momenta α solve Hamilton's equations",
                              "along integral curves of ρ(∂H/∂μ ∘ α) the momenta α do not solve Hamilton's equations",
                              "not decided whether integral curves of ρ(∂H/∂μ ∘ α) lift to solutions"));
        if (candidate->action)
            text += labelled("action",
                             said(*candidate->action,
                                  "along them ∫ (L + H) dt is the integral of α: S(x(t₁)) - S(x(t₀)) where α = dS",
                                  "along them ∫ (L + H) dt is not the integral of α",
                                  "not decided whether ∫ (L + H) dt along them is the integral of α"));
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
