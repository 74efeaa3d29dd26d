// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/report_nonholonomic.hpp"

#include <fmt/format.h>

namespace lagen {

namespace {

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

} // namespace

std::string nonholonomic_text(const MechanicsReport& mechanics)
{
    std::string text;
    if (mechanics.integrable) text += integrable_text(*mechanics.integrable);
    if (mechanics.conserved) text += conserved_text(*mechanics.conserved);
    return text;
}

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

} // namespace lagen
