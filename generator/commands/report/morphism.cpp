// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/report/morphism.hpp"

#include "advice/advise.hpp"
#include "commands/report/check.hpp"
#include "elaborate/elaborate_morphism.hpp"
#include "machine/write_file.hpp"
#include "pipeline.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

namespace {

Report verify_model(const System& system)
{
    Report report = verify(system);
    advise(system, report);
    return report;
}

/// `source`: what is known of the source already; null where nothing is.
VerifiedMorphism verify_one(const MorphismFile& file, const SystemMorphism& morphism, const Report* source)
{
    VerifiedMorphism verified;
    verified.name = file.name;
    verified.source_name = morphism.source.name;
    verified.target_name = morphism.target.name;
    verified.map = verify(morphism);
    verified.source = source != nullptr ? *source : verify_model(morphism.source);
    verified.target = verify_model(morphism.target);
    return verified;
}

struct Consequence {
    const char* name;
    bool holds;
    const char* text;
};

std::vector<Consequence> consequences(const VerifiedMorphism& verified)
{
    const MorphismTheorems& theorems = verified.map.theorems;
    const auto reduces = [](const VerifiedMorphism& stage) {
        return stage.map.theorems.reduction || stage.map.theorems.discrete;
    };
    return {{"reduction", theorems.reduction,
             theorems.of_pulled_momenta ? "solutions of the source with momenta Φ*μ' project to solutions of the target"
                                        : "solutions of the source project to solutions of the target"},
            {"reconstruction", theorems.reconstruction,
             "admissible curves over solutions of the target are solutions of the source"},
            {"discrete", theorems.discrete,
             "arrows solve the source's discrete equations where their images solve the target's, and there alone"},
            {"stages",
             !verified.stages.empty() && verdict_of(verified) == Verdict::valid &&
                 std::ranges::all_of(verified.stages, reduces),
             "the composition is the reduction by its stages"}};
}

std::string rank_text(const GenericRank& rank)
{
    if (!rank.rank) return "not decided";
    std::string text = std::to_string(*rank.rank);
    if (rank.surjective && rank.injective)
        text += ", surjective and injective";
    else if (rank.surjective || rank.injective)
        text += rank.surjective ? ", surjective" : ", injective";
    if (!rank.where.empty()) text += fmt::format(" where {}", fmt::join(rank.where, " and "));
    return text;
}

/// On what part of the source the claims are made, and what they leave out.
std::string extent_text(const MorphismReport& map)
{
    std::string text;
    const auto line = [&](const char* name, const std::string& words) { text += labelled(name, words); };
    if (!map.reach.obstacle.empty())
        line("domain", "a part of the source: there the map is continuous and reaches the target's domain");
    else if (!map.reach.where.empty())
        line("domain", fmt::format("where {}: there the map is continuous and reaches the target's domain",
                                   fmt::join(map.reach.where, " and ")));
    if (!map.compares_motions)
        line("motions",
             "not compared: one model has L, the other H; `[hamiltonian]` or `[lagrangian]` in both compares them");
    return text;
}

Record body_of(const VerifiedMorphism& verified)
{
    const GenericRank& rank = verified.map.rank;
    const ReachOfMap& reach = verified.map.reach;
    Record record = {{"model", verified.name}, {"verdict", to_text(verdict_of(verified))}};
    add_structure(record, verified.map.structure);
    Record& of_rank =
        record["rank"] = {{"rank", or_null(rank.rank)}, {"surjective", rank.surjective}, {"injective", rank.injective}};
    add_unless_empty(of_rank, "where", rank.where);
    if (!reach.where.empty() || !reach.obstacle.empty()) {
        Record& domain = record["domain"] = {{"where", reach.where}};
        add_unless_empty(domain, "evidence", reach.obstacle);
    }
    Record& follows = record["follows"] = Record::array();
    for (const Consequence& each : consequences(verified))
        if (each.holds) follows.push_back(each.name);
    return record;
}

void decide_equal(VerifiedMorphism& verified, const MorphismFile& file, const SystemMorphism& map)
{
    for (const MorphismFile& other : file.equals) append_equality(verified.map.structure, map, elaborate_whole(other));
}

} // namespace

VerifiedMorphism verify_morphism(const MorphismFile& file)
{
    if (file.stages.empty()) {
        const SystemMorphism map = elaborate(file);
        VerifiedMorphism verified = verify_one(file, map, nullptr);
        decide_equal(verified, file, map);
        return verified;
    }
    std::vector<VerifiedMorphism> stages;
    std::optional<SystemMorphism> whole;
    for (const MorphismFile& stage : file.stages) {
        SystemMorphism next = elaborate(stage);
        const Report* middle = stages.empty() ? nullptr : &stages.back().target; // the same model as the source
        stages.push_back(verify_one(stage, next, middle));
        whole = whole ? composition(*whole, next) : std::move(next);
    }
    VerifiedMorphism verified;
    verified.name = file.name;
    verified.source_name = stages.front().source_name;
    verified.target_name = stages.back().target_name;
    verified.map = verify(*whole);
    decide_equal(verified, file, *whole);
    verified.source = stages.front().source;
    verified.target = stages.back().target;
    verified.stages = std::move(stages);
    return verified;
}

Verdict verdict_of(const VerifiedMorphism& verified)
{
    Verdict verdict = worse(verified.map.structure.verdict,
                            worse(verified.source.structure.verdict, verified.target.structure.verdict));
    for (const VerifiedMorphism& stage : verified.stages) verdict = worse(verdict, verdict_of(stage));
    return verdict;
}

void warn_of_morphism(const VerifiedMorphism& verified, const std::string& file, bool unchecked)
{
    const auto warn_of = [&](const char* noun, const std::string& name, const StructureReport& structure) {
        warn(require_unrefuted(noun, name, file, structure, unchecked));
    };
    for (const VerifiedMorphism& stage : verified.stages) warn_of("morphism", stage.name, stage.map.structure);
    for (std::size_t k = 1; k < verified.stages.size(); ++k)
        warn_of("model", verified.stages[k].source_name, verified.stages[k].source.structure);
    warn_of("morphism", verified.name, verified.map.structure);
}

std::string morphism_text(const VerifiedMorphism& verified)
{
    std::string out =
        fmt::format("{}: {}\n{}", verified.name, to_text(verdict_of(verified)), claims_text(verified.map.structure));
    out += labelled("fibrewise rank", rank_text(verified.map.rank)) + extent_text(verified.map);
    const auto add = [&](const char* label, const std::string& name, Verdict verdict) {
        out += labelled(label, fmt::format("{}: {}", name, to_text(verdict)));
    };
    for (const VerifiedMorphism& stage : verified.stages) add("stage", stage.name, verdict_of(stage));
    add("source", verified.source_name, verified.source.structure.verdict);
    add("target", verified.target_name, verified.target.structure.verdict);
    for (const Consequence& each : consequences(verified))
        if (each.holds) out += labelled(each.name, each.text);
    out += failures_text(verified.map.structure);
    for (const VerifiedMorphism& stage : verified.stages)
        if (verdict_of(stage) != Verdict::valid) out += "\n" + morphism_text(stage);
    if (!verified.stages.empty()) return out;
    if (verified.source.structure.verdict != Verdict::valid)
        out += "\n" + report_text(verified.source_name, verified.source);
    if (verified.target.structure.verdict != Verdict::valid)
        out += "\n" + report_text(verified.target_name, verified.target);
    return out;
}

Record record_of(const VerifiedMorphism& verified)
{
    Record record = body_of(verified);
    record["source"] = record_of(verified.source_name, verified.source);
    record["target"] = record_of(verified.target_name, verified.target);
    add_unless_empty(record, "stages",
                     list_of(verified.stages, [](const VerifiedMorphism& stage) { return record_of(stage); }));
    return record;
}

} // namespace lagen
