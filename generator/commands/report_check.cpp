// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/report_check.hpp"

#include "commands/describe_check.hpp"
#include "commands/report_nonholonomic.hpp"
#include "model/families.hpp"
#include "text/comma_list.hpp"

#include <fmt/format.h>

#include <array>
#include <map>
#include <set>

namespace lagen {

namespace {

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
