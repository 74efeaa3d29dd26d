// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/report_check.hpp"

#include <fmt/core.h>

#include <array>

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

using Point = std::vector<std::pair<std::string, std::string>>;

std::string point_text(const Point& point)
{
    std::string text;
    for (const auto& [name, value] : point) text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", name, value);
    return text.empty() ? "every point" : text;
}

std::string indices_text(const Check& check)
{
    std::string text;
    for (const std::string& index : check.indices) text += (text.empty() ? "" : ", ") + index;
    return text.empty() ? "" : fmt::format("({})", text);
}

/// The names of checks in order of first appearance.
std::vector<std::string> kinds_of(const VerifiedAlgebroid& verified)
{
    std::vector<std::string> kinds;
    for (const Check& check : verified.checks) {
        bool known = false;
        for (const std::string& kind : kinds) known = known || kind == check.name;
        if (!known) kinds.push_back(check.name);
    }
    return kinds;
}

std::string summary_line(const VerifiedAlgebroid& verified, const std::string& kind)
{
    std::array<std::size_t, 3> counts{};
    for (const Check& check : verified.checks)
        if (check.name == kind) ++counts[static_cast<std::size_t>(check.decision.status)];
    std::string text = fmt::format("  {:<16}", kind);
    const char* separator = "";
    for (const ProofStatus status : {ProofStatus::proved, ProofStatus::refuted, ProofStatus::undecided}) {
        const std::size_t count = counts[static_cast<std::size_t>(status)];
        if (count == 0) continue;
        text += fmt::format("{}{} {}", separator, count, to_text(status));
        separator = ", ";
    }
    return text + "\n";
}

std::string failure_text(const Check& check)
{
    const Decision& decision = check.decision;
    std::string text = fmt::format("\n{}: {} {}\n", to_text(decision.status), check.name, indices_text(check));
    if (!decision.residual.empty()) text += fmt::format("  residual {}\n", decision.residual);
    if (decision.witness)
        text += fmt::format("  at {}: {:.17g}\n", point_text(decision.witness->point), decision.witness->value);
    if (!decision.evidence.empty()) text += fmt::format("  {}\n", decision.evidence);
    if (!check.hint.empty()) text += fmt::format("  hint: {}\n", check.hint);
    return text;
}

std::string regularity_text(const Regularity& regularity)
{
    if (regularity.kind == Regularity::Kind::absent) return "";
    std::string text = fmt::format("  {:<16}{}, rank {}{}{}\n", "regularity", kind_text(regularity.kind),
                                   regularity.rank, regularity.positive_definite ? ", positive definite" : "",
                                   regularity.for_given_parameters ? " (for the parameter values of the file)" : "");
    if (regularity.kind == Regularity::Kind::degenerate)
        text += fmt::format("  {:<16}`generate` and `run` refuse a degenerate Lagrangian\n", "");
    if (!regularity.evidence.empty()) text += fmt::format("  {:<16}{}\n", "", regularity.evidence);
    for (const Point& point : regularity.singular_at)
        text += fmt::format("  {:<16}singular at {}\n", "", point_text(point));
    return text;
}

void point_json(JsonWriter& json, const Point& point)
{
    json.begin_object();
    for (const auto& [name, value] : point) json.key(name).value(value);
    json.end_object();
}

void check_json(JsonWriter& json, const Check& check)
{
    json.begin_object().key("name").value(check.name).key("indices").begin_array();
    for (const std::string& index : check.indices) json.value(index);
    json.end_array().key("status").value(to_text(check.decision.status)).key("residual").value(check.decision.residual);
    if (check.decision.witness) {
        json.key("witness");
        point_json(json, check.decision.witness->point);
        json.key("value").value(check.decision.witness->value);
    }
    if (!check.decision.evidence.empty()) json.key("evidence").value(check.decision.evidence);
    if (!check.hint.empty()) json.key("hint").value(check.hint);
    json.end_object();
}

} // namespace

std::string report_text(const std::string& model, const VerifiedAlgebroid& verified)
{
    std::string text = fmt::format("{}: {}\n", model, to_text(verified.verdict));
    for (const std::string& kind : kinds_of(verified)) text += summary_line(verified, kind);
    if (verified.trivial > 0) text += fmt::format("  {:<16}{} residuals\n", "trivially zero", verified.trivial);
    text += regularity_text(verified.regularity);
    if (!verified.note.empty()) text += fmt::format("  note: {}\n", verified.note);
    for (const Check& check : verified.checks)
        if (check.decision.status != ProofStatus::proved) text += failure_text(check);
    return text;
}

void report_json(JsonWriter& json, const std::string& model, const VerifiedAlgebroid& verified)
{
    json.begin_object().key("model").value(model).key("verdict").value(to_text(verified.verdict));
    json.key("trivial").value(verified.trivial).key("checks").begin_array();
    for (const Check& check : verified.checks) check_json(json, check);
    json.end_array();
    const Regularity& regularity = verified.regularity;
    json.key("regularity").begin_object().key("status").value(kind_text(regularity.kind));
    json.key("rank").value(regularity.rank).key("positive_definite").value(regularity.positive_definite);
    json.key("for_given_parameters").value(regularity.for_given_parameters);
    if (!regularity.evidence.empty()) json.key("evidence").value(regularity.evidence);
    json.key("singular_at").begin_array();
    for (const Point& point : regularity.singular_at) point_json(json, point);
    json.end_array().end_object();
    if (!verified.note.empty()) json.key("note").value(verified.note);
    json.end_object();
}

} // namespace lagen
