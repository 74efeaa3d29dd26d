// SPDX-License-Identifier: GPL-2.0-or-later
/// The [discrete] block: the step, and the discrete Lagrangian or the scheme that makes it.
#include "model/families.hpp"

#include "model/read_values.hpp"
#include "model/table_reader.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace lagen {

namespace {

/// A scheme of stages is written "gauss:2"; the others have a name alone.
struct SchemeRow {
    const char* name;
    long least, most; ///< stages; 0: none are given
};

constexpr SchemeRow scheme_rows[] = {
    {"midpoint", 0, 0}, {"trapezoidal", 0, 0}, {"left", 0, 0}, {"gauss", 1, 4}, {"lobatto", 2, 5},
};

std::string text_of(const TomlEntry& entry)
{
    return read_text(entry.value, fmt::format("'{}' of [discrete]", entry.name()));
}

void require_scheme(const std::string& text, const SourceRange& where)
{
    const std::size_t colon = std::min(text.find(':'), text.size());
    const std::string name = text.substr(0, colon), stages = text.substr(std::min(colon + 1, text.size()));
    std::vector<std::string> known;
    for (const SchemeRow& row : scheme_rows) {
        if (row.most == 0) known.emplace_back(row.name);
        for (long s = row.least; row.most > 0 && s <= row.most; ++s) known.push_back(fmt::format("{}:{}", row.name, s));
        if (name != row.name) continue;
        if (row.most == 0 && colon == text.size()) return;
        const bool digit = stages.size() == 1 && stages[0] >= '0' && stages[0] <= '9';
        if (row.most > 0 && digit && stages[0] - '0' >= row.least && stages[0] - '0' <= row.most) return;
        throw ModelError(fmt::format("the scheme is '{}', where {} is required", text,
                                     row.most == 0
                                         ? fmt::format("'{}'", row.name)
                                         : fmt::format("'{0}:{1}' to '{0}:{2}'", row.name, row.least, row.most)),
                         where, row.most == 0 ? "this scheme has no stages" : "the number is that of the stages");
    }
    throw ModelError(fmt::format("unknown scheme '{}'", text), where, hint_for(text, known, "schemes"));
}

void read_scheme(DiscreteBlock& block, const TomlEntry& entry)
{
    block.scheme = text_of(entry);
    block.scheme_where = entry.value.where;
    require_scheme(block.scheme, block.scheme_where);
}

void read_retraction(const Model& model, DiscreteBlock& block, const TomlEntry& entry)
{
    block.retraction = text_of(entry);
    block.retraction_where = entry.value.where;
    if (block.retraction != "cayley" && block.retraction != "exp")
        throw ModelError(fmt::format("unknown retraction '{}'", block.retraction), entry.value.where,
                         hint_for(block.retraction, {"cayley", "exp"}, "retractions"));
    if (!model.groupoid->has_group())
        throw ModelError("[discrete] gives 'retraction', but a pair groupoid has no group part", entry.where(),
                         "leave it out");
}

/// h: a parameter of the model, or a symbol of its own.
void declare_step(ModelReader& reader, DiscreteBlock& block, const TomlEntry& discrete, const TomlEntry* entry)
{
    if (entry == nullptr)
        throw ModelError("[discrete] needs the key 'step'", discrete.where(), "step = \"h\" names the step");
    const std::string name = text_of(*entry);
    block.step = Symbol{name, entry->value.where, {}, {}, {}};
    const Names::Entry* known = reader.names.find(name);
    if (known == nullptr || known->role != Role::parameter) reader.names.declare(name, Role::step, block.step.where);
}

/// A tangent bundle in its standard frame has the pair groupoid.
void imply_groupoid(ModelReader& reader)
{
    Model& model = reader.model;
    if (model.groupoid) return;
    const bool pairs = model.algebroid.kind == AlgebroidKind::tangent &&
                       model.algebroid.over.size() == model.base.coordinates.size() && !model.algebroid.over.empty() &&
                       std::ranges::is_sorted(model.algebroid.over);
    if (!pairs)
        throw ModelError("[discrete] needs a [groupoid], of which it gives the discrete Lagrangian",
                         reader.discrete->where(), "[groupoid] kind = \"group\", group = \"SO(3)\"");
    model.groupoid.emplace().where = reader.discrete->where();
}

/// A parameter that is made of the step: derivatives by the step would pass it over.
void refuse_parameters_of_step(const Model& model)
{
    for (const Parameter& parameter : model.parameters) {
        if (!mentions(parameter.value, model.discrete->step.name)) continue;
        throw ModelError(
            fmt::format("the parameter '{}' is made of the step '{}', which no derivative by the step knows, "
                        "the energy -dL/dh least of all",
                        parameter.symbol.name, model.discrete->step.name),
            parameter.symbol.where,
            fmt::format("make it a definition: [definitions] {} = \"..\"", parameter.symbol.name));
    }
}

/// The discrete motion of an L that is written out has none: they would be passed over in silence.
void refuse_forces(const ModelReader& reader)
{
    const MechanicsBlocks& blocks = reader.mechanics;
    for (const TomlEntry* block : {blocks.forces, blocks.dissipation, blocks.control})
        if (block != nullptr)
            throw ModelError(fmt::format("[{}] stands beside a discrete Lagrangian that is written out, which has no "
                                         "place for it",
                                         block->name()),
                             block->where(),
                             "forces act on discrete motions that a scheme makes: [discrete] scheme = \"midpoint\"");
}

} // namespace

void declare_discrete(ModelReader& reader)
{
    if (reader.discrete == nullptr) return;
    imply_groupoid(reader);
    TableReader table(reader.discrete->value, "[discrete]");
    DiscreteBlock block;
    block.where = reader.discrete->where();
    declare_step(reader, block, *reader.discrete, table.take("step"));
    const TomlEntry* L = table.take("L");
    const TomlEntry* scheme = table.take("scheme");
    const TomlEntry* retraction = table.take("retraction");
    table.finish();
    if (L != nullptr && scheme != nullptr)
        throw ModelError("[discrete] gives both 'L' and 'scheme'", scheme->where(), "keep one of them");
    if (L == nullptr && scheme == nullptr)
        throw ModelError(
            "[discrete] needs 'L' or 'scheme'", block.where,
            "L = \"..\" over x, x_next and the element, or scheme = \"midpoint\" to make it of [lagrangian]");
    if (L != nullptr) reader.discrete_lagrangian = read_expression(L->value, "the discrete Lagrangian 'L'");
    if (scheme != nullptr) read_scheme(block, *scheme);
    if (retraction != nullptr) read_retraction(reader.model, block, *retraction);
    reader.model.discrete = std::move(block);
}

void read_discrete(ModelReader& reader)
{
    if (!reader.model.discrete) return;
    DiscreteBlock& block = *reader.model.discrete;
    if (!block.scheme.empty() && !reader.model.lagrangian)
        throw ModelError(
            fmt::format("the scheme '{}' makes a discrete Lagrangian of [lagrangian], which the model does "
                        "not have",
                        block.scheme),
            block.scheme_where, "give [lagrangian] L, or the discrete Lagrangian itself: L = \"..\"");
    refuse_parameters_of_step(reader.model);
    if (!reader.discrete_lagrangian) return;
    refuse_forces(reader);
    const auto arrow = {Role::time, Role::parameter, Role::base, Role::next, Role::element, Role::step};
    const ArrayValue closed = reader.close_arrow(reader.discrete_lagrangian, arrow, "the discrete Lagrangian");
    if (closed.shape.rank != Rank::scalar)
        throw ModelError(
            fmt::format("the discrete Lagrangian is {}, where a scalar is required", to_text(closed.shape)),
            reader.discrete_lagrangian->where, "a norm is written norm(x), a trace trace(W)");
    block.lagrangian = closed.entries[0];
}

} // namespace lagen
