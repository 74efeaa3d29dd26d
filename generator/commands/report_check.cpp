// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/report_check.hpp"

#include "commands/describe_check.hpp"
#include "commands/report_nonholonomic.hpp"
#include "model/families.hpp"

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
    std::string text;
    for (const auto& [name, value] : values)
        text += fmt::format("{}{}{} = {}", text.empty() ? "" : ", ", prefix, name, to_text(value));
    return text;
}

std::string witness_text(const NamedPoint& point)
{
    return point.empty() ? "every point" : values_text(point, "");
}

std::string indices_text(const Check& check)
{
    std::string text;
    for (const std::string& index : check.indices) text += (text.empty() ? "" : ", ") + index;
    return text.empty() ? "" : fmt::format(" ({})", text);
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
    std::string text;
    for (const ProofStatus status : {ProofStatus::proved, ProofStatus::refuted, ProofStatus::undecided}) {
        const std::size_t count = counts[static_cast<std::size_t>(status)];
        if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, to_text(status));
    }
    return text;
}

/// "24 equations zero by structure, 12 proved"
std::string summary_text(const StructureReport& structure)
{
    const std::string counts = counts_text(counts_of(structure, ""));
    const std::string trivial = structure.trivial == 0 ? ""
                                                       : fmt::format("{} {} zero by structure", structure.trivial,
                                                                     structure.trivial == 1 ? "equation" : "equations");
    if (trivial.empty() && counts.empty()) return "";
    return fmt::format("  {}{}{}\n", trivial, trivial.empty() || counts.empty() ? "" : ", ", counts);
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
    std::string equations;
    for (const std::string& factor : regularity.singular_where)
        equations += fmt::format("{}{} = 0", equations.empty() ? "" : " or ", factor);
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
void values_json(JsonWriter& json, const Values& values)
{
    json.begin_object();
    for (const auto& [name, value] : values) json.key(name).value(to_text(value));
    json.end_object();
}

void check_json(JsonWriter& json, const Check& check)
{
    json.begin_object().key("name").value(check.name).key("indices").begin_array();
    for (const std::string& index : check.indices) json.value(index);
    json.end_array().key("status").value(to_text(check.decision.status)).key("residual").value(check.decision.residual);
    if (check.decision.witness) {
        json.key("witness");
        values_json(json, check.decision.witness->point);
        json.key("value").value(check.decision.witness->value);
    }
    if (!check.where.empty()) {
        json.key("where").begin_array();
        for (const std::string& condition : check.where) json.value(condition);
        json.end_array();
    }
    if (!check.decision.evidence.empty()) json.key("evidence").value(check.decision.evidence);
    if (!check.hint.empty()) json.key("hint").value(check.hint);
    json.end_object();
}

void regularity_json(JsonWriter& json, const Regularity& regularity)
{
    json.begin_object().key("status").value(kind_text(regularity.kind));
    json.key("rank");
    regularity.kind == Regularity::Kind::undecided ? json.null() : json.value(regularity.rank);
    json.key("positive_definite").value(regularity.positive_definite);
    json.key("for_given_parameters").value(regularity.for_given_parameters);
    if (!regularity.evidence.empty()) json.key("evidence").value(regularity.evidence);
    if (!regularity.coordinates.empty()) json.key("coordinates").value(regularity.coordinates);
    if (regularity.of == Regularity::Matrix::hamiltonian) json.key("of").value("d2H/dmu2");
    if (regularity.of == Regularity::Matrix::constrained) json.key("of").value("d2L/dY2 on D");
    if (regularity.of == Regularity::Matrix::newton) json.key("of").value("N");
    if (regularity.kind == Regularity::Kind::degenerate) {
        json.key("kernel").begin_array();
        for (const auto& vector : regularity.kernel) values_json(json, vector);
        json.end_array();
    }
    json.key("singular_everywhere").value(regularity.singular_everywhere);
    json.key("singular_at").begin_array();
    for (const NamedPoint& point : regularity.singular_at) values_json(json, point);
    json.end_array().key("singular_where").begin_array();
    for (const std::string& factor : regularity.singular_where) json.value(factor);
    json.end_array().end_object();
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

void checks_json(JsonWriter& json, const std::vector<Check>& checks)
{
    json.begin_array();
    for (const Check& check : checks) check_json(json, check);
    json.end_array();
}

void structure_json(JsonWriter& json, const StructureReport& structure)
{
    checks_json(json.key("trivial").value(structure.trivial).key("checks"), structure.checks);
    if (!structure.forms.empty()) {
        json.key("forms").begin_array();
        for (const FormReport& form : structure.forms)
            json.begin_object()
                .key("name")
                .value(form.name)
                .key("degree")
                .value(form.degree)
                .key("closed")
                .value(to_text(form.closed))
                .end_object();
        json.end_array();
    }
    if (const auto& candidate = structure.hamilton_jacobi) {
        json.key("hamilton_jacobi").begin_object();
        json.key("closed").value(to_text(candidate->closed));
        json.key("constant_on_leaves").value(to_text(candidate->equation));
        json.key("lifts").value(to_text(candidate->lifts));
        if (candidate->action) json.key("action").value(to_text(*candidate->action));
        json.end_object();
    }
}

void report_json(JsonWriter& json, const std::string& model, const Report& verified)
{
    const StructureReport& structure = verified.structure;
    json.begin_object().key("model").value(model).key("verdict").value(to_text(structure.verdict));
    structure_json(json, structure);
    const Regularity &discrete = verified.mechanics.discrete, &regularity = verified.mechanics.regularity;
    const bool is_discrete = discrete.kind != Regularity::Kind::absent;
    regularity_json(json.key("regularity"), is_discrete ? discrete : regularity);
    if (is_discrete && regularity.kind != Regularity::Kind::absent)
        regularity_json(json.key("regularity_of_lagrangian"), regularity);
    nonholonomic_json(json, verified.mechanics);
    if (!structure.note.empty()) json.key("note").value(structure.note);
    json.end_object();
}

} // namespace lagen
