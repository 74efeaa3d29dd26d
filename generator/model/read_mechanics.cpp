// SPDX-License-Identifier: GPL-2.0-or-later
/// The blocks that make a mechanical system or a control problem of an algebroid, and what is claimed of it:
/// [lagrangian], [hamiltonian], [forces], [dissipation], [control], [symmetries], [hamilton_jacobi]; and [discrete].
#include "model/algebroid_draft.hpp"

#include "model/complaints.hpp"
#include "model/families.hpp"
#include "model/read_values.hpp"
#include "model/total_cost.hpp"
#include "text/comma_list.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace lagen {

namespace {

constexpr std::size_t most_controls = 1000; // d2H/du2 has a million entries then

/// Every run tracks the energy without being asked, and the other two are there under these names.
void refuse_built_in_invariants(const ModelReader& reader)
{
    if (!reader.at("lagrangian") && !reader.at("hamiltonian") && !reader.at("control")) return;
    for (const auto& [key, value] : reader.invariants)
        if (key.text == "energy" || key.text == "lagrangian" || key.text == "hamiltonian")
            throw ModelError(fmt::format("the invariant '{0}' bears the name of the {0} of the model", key.text),
                             key.range(0, key.text.size()),
                             "choose another name; every run tracks the energy without being asked");
}

/// "-inf" or "inf" for no bound, as text or as a number of TOML.
bool is_open(const TomlValue& value, bool lower)
{
    const std::string& text = value.text.text;
    if (value.kind != TomlKind::string && (value.kind != TomlKind::decimal || value.finite)) return false;
    return lower ? text == "-inf" : text == "inf" || text == "+inf";
}

std::vector<ControlBound> read_bounds(const ModelReader& reader, const Item& block)
{
    const std::vector<Symbol>& controls = reader.model.control->controls;
    std::vector<ControlBound> out;
    for (const Item& item : block.items()) {
        const ResolvedKey key = require_key(controls, item.key(), block.title(), "control", &reader.model.scope);
        const std::string what = fmt::format("a bound of '{}'", key.name);
        std::vector<Tree> ends[2];
        for (const std::size_t end : {0U, 1U}) {
            const TomlValue& value = item.value().items[end];
            ends[end] = is_open(value, end == 0)
                            ? std::vector<Tree>(key.indices.size())
                            : fit_values(reader.close(read_array_expression(value, what), Role::parameter, what),
                                         key.shape, what, value.where);
        }
        for (std::size_t k = 0; k < key.indices.size(); ++k) {
            const std::size_t control = key.indices[k];
            if (std::ranges::find(out, control, &ControlBound::control) != out.end())
                throw complain::twice(item.title_of(controls[control].name), item.where());
            if (ends[0][k] || ends[1][k]) out.push_back({control, ends[0][k], ends[1][k], item.where()});
        }
    }
    return out;
}

/// Values of base coordinates.
std::vector<NamedTree> read_point(const ModelReader& reader, const Item& table)
{
    const std::vector<Symbol>& base = reader.model.base.coordinates;
    std::vector<NamedTree> out;
    reader.read_values(table, base, "base coordinate", [&](std::size_t i, const Tree& value, const Item& item) {
        out.push_back(NamedTree{base[i].name, value, item.where()});
    });
    return out;
}

ControlBoundary read_boundary(const ModelReader& reader, const Item& block)
{
    ControlBoundary boundary;
    boundary.where = block.where();
    boundary.from = read_point(reader, block.at("from"));
    boundary.to = read_point(reader, block.at("to"));
    if (const Item cost = block.at("terminal_cost")) boundary.terminal_cost = reader.scalar(cost);
    std::vector<std::string> missing;
    for (const Symbol& symbol : reader.model.base.coordinates)
        if (std::ranges::find(boundary.from, symbol.name, &NamedTree::name) == boundary.from.end())
            missing.push_back(symbol.name);
    if (!missing.empty())
        throw complain::leaves_out("'from' of [control.boundary]", comma_list(missing), boundary.where,
                                   "only 'to' may leave coordinates free");
    const Item duration = block.at("duration");
    boundary.free_duration = duration && duration.text() == "free" && reader.names.find("free") == nullptr;
    if (duration && !boundary.free_duration) boundary.duration = reader.scalar(duration);
    return boundary;
}

/// p_a s^a
Tree momentum_of(const Model& model, const std::vector<ComponentEntry>& section)
{
    std::vector<Tree> terms;
    for (const ComponentEntry& entry : section)
        terms.push_back(multiply({entry.value, name(model.fibre.momenta[entry.section].name)}));
    return sum_of(terms);
}

} // namespace

void declare_control(ModelReader& reader)
{
    const Item block = reader.at("control");
    if (!block) return;
    const Item controls = block.at("controls");
    reader.model.control.emplace().where = block.where();
    declare_symbols(reader, read_names(reader, controls), Role::control);
    const std::size_t count = reader.model.control->controls.size();
    if (count > most_controls)
        throw complain::too_many(controls.title(), count, "names", most_controls, controls.value().where);
    if (count == 0)
        throw complain::is_not(controls.title(), "an empty array", "one control at least", controls.value().where,
                               controls.row().hint);
}

void declare_total_cost(ModelReader& reader)
{
    if (reader.model.control && reader.names.find(total_cost_name) == nullptr)
        declare_symbols(reader, {Symbol{total_cost_name, {}, {}, {}, {}}}, Role::state);
}

void define_cost(ModelReader& reader)
{
    const Item cost = reader.at("control").at("cost");
    if (!cost || reader.names.find("cost") != nullptr) return;
    reader.observer.define(Definition{"cost", {}, read_expression(cost.value(), cost.title()), cost.where()});
}

void read_control(ModelReader& reader)
{
    const Item block = reader.at("control");
    if (!block) return;
    Control& control = *reader.model.control;
    control.sigma = read_components(reader, block.at("sigma"));
    control.cost = reader.scalar(block.at("cost"));
    for (std::size_t k = 0; k < reader.model.states.size(); ++k)
        if (is_total_cost(reader.model, k)) reader.model.states[k].rate = control.cost;
    control.bounds = read_bounds(reader, block.at("bounds"));
    if (const Item guess = block.at("guess")) {
        control.guess.resize(control.controls.size());
        reader.read_values(guess, control.controls, "control",
                           [&](std::size_t k, const Tree& value, const Item&) { control.guess[k] = value; });
    }
    if (const Item boundary = block.at("boundary")) control.boundary = read_boundary(reader, boundary);
}

void declare_mechanics(ModelReader& reader)
{
    refuse_built_in_invariants(reader);
    const Item L = reader.at("lagrangian").at("L"), R = reader.at("dissipation").at("R");
    // Pontryagin's equations have no place for forces: they would be passed over in silence.
    for (const char* key : {"forces", "dissipation"})
        if (const Item block = reader.at(key); block && reader.at("control") && !L && !reader.at("hamiltonian"))
            throw complain::beside(
                block.title(), "[control], where the model has neither [lagrangian] nor [hamiltonian] for it to act on",
                block.where(), "what acts on a system that is controlled is a part of sigma");
    if (L) {
        reader.lagrangian = read_expression(L.value(), L.title());
        reader.model.lagrangian_where = L.value().where;
    }
    if (R) reader.dissipation = read_expression(R.value(), R.title());
}

void read_mechanics(ModelReader& reader)
{
    Model& model = reader.model;
    constexpr Roles velocity = Role::time | Role::parameter | Role::base | Role::fibre;
    if (reader.lagrangian) model.lagrangian = reader.scalar(reader.lagrangian, velocity, "the Lagrangian");
    if (const Item H = reader.at("hamiltonian").at("H")) {
        model.hamiltonian = reader.scalar(H);
        model.hamiltonian_where = H.value().where;
    }
    if (reader.dissipation) model.dissipation = reader.scalar(reader.dissipation, velocity, "the Rayleigh function");
    model.forces = read_components(reader, reader.at("forces"));
    for (const ComponentEntry& force : reader.inherited_forces)
        model.forces.push_back({force.section, reader.mechanical.close(force.value, true), force.where});
    const Item candidate = reader.at("hamilton_jacobi");
    if (!candidate) return;
    refuse_nonholonomic(reader, candidate);
    if (!model.lagrangian && !model.hamiltonian)
        throw complain::needs(candidate.title(), "a Hamiltonian", candidate.where(),
                              "give [hamiltonian] H, or [lagrangian] L");
    HamiltonJacobi& claim = model.hamilton_jacobi.emplace();
    claim.where = candidate.where();
    if (const Item S = candidate.at("S")) claim.S = reader.scalar(S);
    claim.alpha = read_components(reader, candidate.at("alpha"));
}

void read_symmetries(ModelReader& reader)
{
    const Item block = reader.at("symmetries");
    if (!block) return;
    refuse_nonholonomic(reader, block);
    Model& model = reader.model;
    if (!model.lagrangian && !model.hamiltonian && !(model.discrete && model.discrete->lagrangian))
        throw complain::needs(block.title(), "a function that they leave invariant", block.where(),
                              "give [lagrangian] L, [hamiltonian] H or [discrete] L");
    for (const Item& item : block.items()) {
        require_identifier(item.name(), item.where(), "a name");
        Symmetry symmetry{item.name(), item.where(), read_components(reader, item), nullptr};
        symmetry.momentum = momentum_of(model, symmetry.section);
        model.observables.push_back({"momentum." + symmetry.name, symmetry.momentum, symmetry.where});
        model.symmetries.push_back(std::move(symmetry));
    }
}

std::vector<NamedTree> conserved_trees(const Model& model)
{
    std::vector<NamedTree> trees = model.invariants;
    if (!model.forces.empty() || model.dissipation || model.control) return trees;
    for (const Symmetry& symmetry : model.symmetries)
        trees.push_back({"momentum." + symmetry.name, symmetry.momentum, symmetry.where});
    return trees;
}

namespace {

/// A tangent bundle in its standard frame has the pair groupoid.
void imply_groupoid(Model& model, const Item& block)
{
    if (model.groupoid) return;
    const bool pairs = model.algebroid.kind == AlgebroidKind::tangent &&
                       model.algebroid.over.size() == model.base.coordinates.size() && !model.algebroid.over.empty() &&
                       std::ranges::is_sorted(model.algebroid.over);
    if (!pairs)
        throw complain::needs(block.title(), "a [groupoid], of which it gives the discrete Lagrangian", block.where(),
                              "[groupoid] kind = \"group\", group = \"SO(3)\"");
    model.groupoid.emplace().where = block.where();
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

} // namespace

void declare_discrete(ModelReader& reader)
{
    const Item block = reader.at("discrete");
    if (!block) return;
    Model& model = reader.model;
    imply_groupoid(model, block);
    DiscreteBlock& discrete = model.discrete.emplace();
    discrete.where = block.where();
    const Item step = block.at("step"), scheme = block.at("scheme"), retraction = block.at("retraction");
    // h is a parameter of the model, or a symbol of its own.
    discrete.step = Symbol{step.text(), step.value().where, {}, {}, {}};
    const Names::Entry* known = reader.names.find(step.text());
    if (known == nullptr || known->role != Role::parameter)
        reader.names.declare(step.text(), Role::step, discrete.step.where);
    if (scheme) {
        discrete.scheme = scheme.text();
        discrete.scheme_where = scheme.value().where;
    }
    if (!retraction) return;
    if (!model.groupoid->has_group())
        throw complain::takes_no("[discrete] on a pair groupoid", "retraction", retraction.where(),
                                 "it has no group part: leave it out");
    discrete.retraction = retraction.text();
    discrete.retraction_where = retraction.value().where;
}

void read_discrete(ModelReader& reader)
{
    if (!reader.model.discrete) return;
    DiscreteBlock& block = *reader.model.discrete;
    if (!block.scheme.empty() && !reader.model.lagrangian)
        throw complain::needs(fmt::format("the scheme '{}'", block.scheme),
                              "[lagrangian], of which it makes a discrete one", block.scheme_where,
                              "give [lagrangian] L, or the discrete Lagrangian itself: L = \"..\"");
    refuse_parameters_of_step(reader.model);
    const Item L = reader.at("discrete").at("L");
    if (!L) return;
    // Its motion has no place for forces: they would be passed over in silence.
    for (const char* key : {"forces", "dissipation", "control"})
        if (const Item other = reader.at(key))
            throw complain::beside(
                other.title(), "a discrete Lagrangian that is written out, which has no place for it", other.where(),
                "forces act on discrete motions that a scheme makes: [discrete] scheme = \"midpoint\"");
    const Tree tree = read_expression(L.value(), L.title());
    const ArrayValue closed = reader.close(tree, L.row().roles, L.title());
    if (closed.shape.rank != Rank::scalar)
        throw complain::is_not(L.title(), to_text(closed.shape), "a scalar", tree->where,
                               "a norm is written norm(x), a trace trace(W)");
    block.lagrangian = closed.entries[0];
}

} // namespace lagen
