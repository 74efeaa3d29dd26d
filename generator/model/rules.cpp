// SPDX-License-Identifier: GPL-2.0-or-later
/// Blocks and keys that do not go with what the model is, or that need something of it: a rule a row. The needs of one
/// table by itself stand in the schema.
#include "model/complaints.hpp"
#include "model/families.hpp"

#include <algorithm>

namespace lagen {

/// Short names for the table alone.
namespace rules {

enum class Says {
    beside,  ///< X stands beside OTHER
    needs,   ///< X needs OTHER
    takes_no ///< the block of X, and OTHER behind it, takes no X
};

using enum Known;
using enum Says;

struct Rule {
    Known known;
    std::string_view paths; ///< of X, in the schema, with | between them
    Says says;
    const char* other;
    const char* hint;
    bool (*is_broken)(const ModelReader&);
};

bool nonholonomic(const ModelReader& reader)
{
    return is_nonholonomic(reader.model);
}

bool first_order(const ModelReader& reader)
{
    return reader.model.algebroid.kind == AlgebroidKind::first_order;
}

bool has_no_discrete(const ModelReader& reader)
{
    return !reader.model.discrete;
}

/// A tangent bundle in its standard frame has the pair groupoid.
bool has_no_groupoid(const ModelReader& reader)
{
    const AlgebroidBlock& block = reader.model.algebroid;
    const bool pairs = block.kind == AlgebroidKind::tangent && block.over.size() == block.base.size() &&
                       !block.over.empty() && std::ranges::is_sorted(block.over);
    return !reader.model.groupoid && !pairs;
}

bool has_no_group(const ModelReader& reader)
{
    const std::optional<GroupoidBlock>& groupoid = reader.model.groupoid;
    return !groupoid || !groupoid->has_group();
}

constexpr const char* distribution = "a nonholonomic algebroid";

constexpr Rule rows[] = {
    {algebroid, "groupoid", beside, distribution, "a distribution has no groupoid", nonholonomic},
    {algebroid, "discrete", beside, distribution, "nonholonomic models move in continuous time: give [lagrangian] L",
     nonholonomic},
    {algebroid, "control", beside, distribution,
     "nonholonomic models move by d'Alembert's principle: give [lagrangian] L", nonholonomic},
    {algebroid, "hamiltonian", beside, distribution,
     "the equations need L on the ambient algebroid: give [lagrangian] L", nonholonomic},
    {algebroid, "forms|symmetries|hamilton_jacobi", beside, distribution,
     "a function that is conserved can be claimed under [invariants]", nonholonomic},
    {algebroid,
     "fibre|groupoid|control|lagrangian|hamiltonian|forces|dissipation|discrete|symmetries|forms|"
     "hamilton_jacobi|reconstruct",
     beside, "an algebroid of kind 'first_order'", "such a system is its [rates] alone", first_order},
    {algebroid, "rates", needs, "an algebroid of kind 'first_order'", "[algebroid] kind = \"first_order\"",
     [](const ModelReader& reader) { return !first_order(reader); }},
    {algebroid, "algebroid.drift", beside, "'constraints' alone",
     "the constraints say what the drift is; 'sections' leave it open", has_constraints_alone},
    {algebroid, "reconstruct", needs, "an algebroid whose fibre is a Lie algebra, wholly or in part",
     "kinds: lie_algebra, action, atiyah", [](const ModelReader& reader) { return !first_vertical(reader.model); }},
    // Neither Pontryagin's equations nor a discrete Lagrangian have a place for forces, which would be passed over.
    {blocks, "forces|dissipation", beside,
     "[control], where the model has neither [lagrangian] nor [hamiltonian] for it to act on",
     "what acts on a system that is controlled is a part of sigma",
     [](const ModelReader& reader) {
         return reader.at("control") && !reader.at("lagrangian") && !reader.at("hamiltonian");
     }},
    {blocks, "discrete", needs, "a [groupoid], of which it gives the discrete Lagrangian",
     "[groupoid] kind = \"group\", group = \"SO(3)\"", has_no_groupoid},
    {blocks, "forces|dissipation|control", beside,
     "a discrete Lagrangian that is written out, which has no place for it",
     "forces act on discrete motions that a scheme makes: [discrete] scheme = \"midpoint\"",
     [](const ModelReader& reader) { return bool(reader.at("discrete").at("L")); }},
    {blocks, "discrete.retraction", takes_no, " on a pair groupoid", "it has no group part: leave it out",
     has_no_group},
    {functions, "hamilton_jacobi", needs, "a Hamiltonian", "give [hamiltonian] H, or [lagrangian] L",
     [](const ModelReader& reader) { return !reader.model.lagrangian && !reader.model.hamiltonian; }},
    {functions, "symmetries", needs, "a function that they leave invariant",
     "give [lagrangian] L, [hamiltonian] H or [discrete] L",
     [](const ModelReader& reader) {
         return !reader.model.lagrangian && !reader.model.hamiltonian && !reader.at("discrete").at("L");
     }},
    {functions, "scene.*.element|scene.*.next|scene.*.steps", needs, "[discrete] of the model", "", has_no_discrete},
    {functions, "scene.*.element", takes_no, " on a pair groupoid", "give 'next', the target of the first arrow",
     has_no_group},
    {functions, "scene.*.next", takes_no, " on this groupoid",
     "the target of an arrow follows from its 'element': leave it out",
     [](const ModelReader& reader) { return !reader.model.groupoid->has_targets(); }},
    {functions, "scene.*.inputs", needs, "[inputs] of the model", "[inputs] u = 0, and u in [forces]",
     [](const ModelReader& reader) { return reader.model.inputs.empty(); }},
    {functions, "scene.*.events.*.jump", beside,
     "[control], whose costates jump by the condition that the motion is the best one",
     "leave the jump out, or the model without [control]",
     [](const ModelReader& reader) { return reader.model.control.has_value(); }},
};

ModelError complaint_of(const Rule& rule, const Item& owner, const Item& item)
{
    switch (rule.says) {
    case beside: return complain::beside(item.title(), rule.other, item.where(), rule.hint);
    case needs: return complain::needs(item.title(), rule.other, item.where(), rule.hint);
    case takes_no: break;
    }
    return complain::takes_no(owner.title() + rule.other, item.name(), item.where(), rule.hint);
}

void require_below(const ModelReader& reader, Known known, const Item& owner)
{
    const auto is_about = [](std::string_view paths, std::string_view path) {
        return fmt::format("|{}|", paths).find(fmt::format("|{}|", path)) != std::string::npos;
    };
    for (const Item& item : owner.items()) {
        for (const Rule& rule : rows)
            if (rule.known == known && is_about(rule.paths, item.row().path) && rule.is_broken(reader))
                throw complaint_of(rule, owner, item);
        require_below(reader, known, item);
    }
}

} // namespace rules

void require_rules(const ModelReader& reader, Known known)
{
    if (!reader.is_probe) rules::require_below(reader, known, Item(reader.document));
}

} // namespace lagen
