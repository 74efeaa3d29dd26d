// SPDX-License-Identifier: GPL-2.0-or-later
#include "reduction/by_routh.hpp"

#include "equations/routh.hpp"
#include "expression/rewrite.hpp"
#include "text/comma_list.hpp"
#include "text/usage_error.hpp"
#include "verify/cyclic.hpp"
#include "verify/verify_routh.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace lagen {

namespace {

class RouthDocument {
  public:
    /// `nonzero`: the momenta determine the velocities where these are not 0, for the domain.
    RouthDocument(const CheckedModel& whole, const std::vector<std::size_t>& cyclic, const RouthianText& text,
                  const std::vector<Tree>& nonzero)
        : model_(whole.model), cyclic_(cyclic), text_(text), nonzero_(nonzero),
          document_(whole, "by " + comma_list_of_coordinates())
    {
    }

    std::string write()
    {
        document_.write_out_rates(model_);
        TomlValue& parameters = document_.at("parameters");
        for (const std::size_t k : cyclic_) // until a scene says otherwise
            entry_in(parameters, momentum(k)) = toml_string("0");
        drop_coordinates();
        const std::string elsewhere = restrict_domain();
        add_velocities();
        entry_in(document_.at("lagrangian"), "L") = toml_string(to_text(text_.value));
        drop_claims();
        for (const Scene& scene : model_.scenes) move_start(scene);
        return document_.text(fmt::format(
            "# Routh's reduction of {} by {}: R = L - p_k y^k at p_k = dL/dy^k. The velocities of the cyclic\n"
            "# coordinates are definitions, their momenta parameters, they themselves states that run\n"
            "# where they are observed.\n{}",
            std::filesystem::path(model_.file->name).filename().string(), comma_list_of_coordinates(), elsewhere));
    }

  private:
    [[nodiscard]] const std::string& coordinate(std::size_t k) const { return model_.base.coordinates[k].name; }
    [[nodiscard]] const std::string& velocity(std::size_t k) const { return model_.fibre.coordinates[k].name; }
    [[nodiscard]] const std::string& momentum(std::size_t k) const { return model_.fibre.momenta[k].name; }
    [[nodiscard]] bool is_cyclic(std::size_t k) const { return std::ranges::find(cyclic_, k) != cyclic_.end(); }

    [[nodiscard]] std::string comma_list_of_coordinates() const
    {
        return comma_list(cyclic_, [&](std::size_t k) { return coordinate(k); });
    }

    /// The names that are not cyclic as the list `key`, which must have all of them one by one where it is there.
    void put_rest(TomlValue& table, const char* key, const std::vector<Symbol>& symbols)
    {
        TomlValue& list = entry_in(table, key);
        const auto text = [](const TomlValue& value) -> const std::string& { return value.text.text; };
        if (list.kind == TomlKind::array && !std::ranges::equal(list.items, symbols, {}, text, &Symbol::name))
            throw MathematicsError(
                fmt::format("the {} of model '{}' are written as a family, and one of them cannot be taken "
                            "out",
                            key, model_.name),
                "write them one by one");
        std::vector<std::string> rest;
        for (std::size_t k = 0; k < symbols.size(); ++k)
            if (!is_cyclic(k)) rest.push_back(symbols[k].name);
        list = toml_list(rest);
    }

    void drop_coordinates()
    {
        put_rest(document_.at("base"), "coordinates", model_.base.coordinates);
        TomlValue& fibre = document_.at("fibre");
        put_rest(fibre, "coordinates", model_.fibre.coordinates);
        put_rest(fibre, "momenta", model_.fibre.momenta);
        for (const std::size_t k : cyclic_) document_.erase("forces", {velocity(k), momentum(k)});
    }

    /// The domain is about base coordinates and parameters: what else must not be 0 is said in a comment.
    std::string restrict_domain()
    {
        const auto is_of_base = [&](const Tree& tree) {
            return !mentions(tree, "t") && std::ranges::none_of(model_.fibre.coordinates, [&](const Symbol& symbol) {
                return mentions(tree, symbol.name);
            });
        };
        std::vector<std::string> others;
        for (const Tree& factor : nonzero_) {
            const std::string condition = to_text(factor) + " != 0";
            if (!is_of_base(factor)) {
                others.push_back(condition);
                continue;
            }
            TomlValue& domain = entry_in(document_.at("base"), "domain");
            if (domain.kind != TomlKind::array) domain = toml_list({});
            domain.items.push_back(toml_string(condition));
        }
        return others.empty() ? "" : fmt::format("# It holds where {}.\n", fmt::join(others, " and "));
    }

    void add_velocities()
    {
        TomlValue& definitions = document_.at("definitions");
        for (std::size_t j = 0; j < cyclic_.size(); ++j)
            entry_in(definitions, velocity(cyclic_[j])) = toml_string(to_text(text_.velocities[j]));
        TomlValue& states = document_.at("states");
        for (const std::size_t k : cyclic_) entry_in(states, coordinate(k)) = toml_string(velocity(k));
    }

    /// Drops what is about the whole model alone, and claims that rest on the coordinates.
    void drop_claims()
    {
        document_.drop({"symmetries", "forms", "hamilton_jacobi"});
        const auto rests_on = [&](const NamedTree& claim) {
            return std::ranges::any_of(cyclic_, [&](std::size_t k) { return mentions(claim.value, coordinate(k)); });
        };
        for (const NamedTree& claim : model_.invariants)
            if (rests_on(claim)) document_.drop("invariants", claim.name, fmt::format("the invariant {}", claim.name));
    }

    /// The momenta of the start as parameters, in place of velocities or momenta there.
    void move_start(const Scene& scene)
    {
        TomlValue& table = document_.scene(scene.name);
        const bool first = &scene == &model_.scenes.front() || scene.name == "default";
        for (std::size_t j = 0; j < cyclic_.size(); ++j) {
            const std::size_t k = cyclic_[j];
            const Tree value = start_of(scene, k, text_.momenta[j]);
            const auto initial = std::ranges::find(table.entries, "initial", &TomlEntry::name);
            if (initial != table.entries.end())
                std::erase_if(initial->value.entries, [&](const TomlEntry& each) {
                    return each.name() == velocity(k) || each.name() == momentum(k);
                });
            if (value == nullptr) continue;
            if (first) entry_in(document_.at("parameters"), momentum(k)) = toml_string(to_text(value));
            entry_in(entry_in(table, "parameters"), momentum(k)) = toml_string(to_text(value));
        }
    }

    /// p_k at the start, over the parameters; null where the scene does not say.
    [[nodiscard]] Tree start_of(const Scene& scene, std::size_t k, const Tree& p) const
    {
        TreesByName values;
        for (const NamedTree& each : scene.initial) values[each.name] = each.value;
        if (const auto given = values.find(momentum(k)); given != values.end()) return given->second;
        values["t"] = scene.start != nullptr ? scene.start : number(0);
        bool known = true;
        for (const auto* symbols : {&model_.base.coordinates, &model_.fibre.coordinates})
            for (const Symbol& each : *symbols)
                known = known && (values.contains(each.name) || !mentions(p, each.name));
        if (!known) return nullptr;
        return replace_names(p, values);
    }

    const Model& model_;
    const std::vector<std::size_t>& cyclic_;
    const RouthianText& text_;
    const std::vector<Tree>& nonzero_;
    ReducedDocument document_;
};

std::vector<std::size_t> coordinates_to_reduce(const Model& model, const std::vector<std::string>& names)
{
    require_tangent_lagrangian(model, "Routh's reduction");
    if (names.empty()) throw UsageError("--routh names no coordinate");
    std::vector<std::size_t> cyclic;
    for (const std::string& name : names) {
        const auto found = std::ranges::find(model.base.coordinates, name, &Symbol::name);
        if (found == model.base.coordinates.end())
            throw UsageError(fmt::format("'{}' of --routh is no coordinate of model '{}'", name, model.name));
        const auto k = static_cast<std::size_t>(found - model.base.coordinates.begin());
        if (std::ranges::find(cyclic, k) == cyclic.end()) cyclic.push_back(k);
    }
    std::ranges::sort(cyclic);
    for (const Tree& condition : model.base.domain)
        for (const std::size_t k : cyclic)
            if (const std::string& name = model.base.coordinates[k].name; mentions(condition, name))
                throw MathematicsError(fmt::format("the domain of model '{}' has the coordinate '{}', which would be "
                                                   "reduced",
                                                   model.name, name),
                                       "a symmetry of the motions is none of the domain: leave the condition out");
    if (cyclic.size() == model.base.coordinates.size())
        throw MathematicsError(
            fmt::format("every coordinate of model '{}' would be reduced: nothing is left to move", model.name),
            "leave one out; with all momenta known the coordinates are quadratures of Hamilton's form");
    return cyclic;
}

/// Throws MathematicsError with the defect of a coordinate that is none.
void require_cyclic(const Model& model, const StructureReport& report, const std::vector<std::size_t>& coordinates)
{
    for (const Check& check : report.checks)
        for (const std::size_t k : coordinates)
            if (check.indices[0] == model.base.coordinates[k].name && check.decision.status == ProofStatus::refuted)
                throw MathematicsError(
                    fmt::format(
                        "model '{}' is not to be reduced by '{}', which is not cyclic: {} depends on it, with the "
                        "derivative {}",
                        model.name, check.indices[0], check.indices[1], check.decision.residual),
                    "lagen reduce without --routh lists the cyclic coordinates");
}

} // namespace

ReducedModel reduce_by_routh(const CheckedModel& checked, const std::vector<std::string>& names)
{
    const Model& model = checked.model;
    const std::vector<std::size_t> cyclic = coordinates_to_reduce(model, names);
    const StructureReport free_of = cyclic_coordinates(checked.system);
    require_cyclic(model, free_of, cyclic);
    Graph graph = checked.system.graph;
    const Routhian made = routhian(graph, checked.system, cyclic);
    const RouthianText text = routhian_text(model, checked.system, graph, made);
    const std::vector<Tree> factors = singular_factors_of_momenta(graph, checked.system, made);
    ReducedModel reduced;
    reduced.document = RouthDocument(checked, cyclic, text, factors).write();
    reduced.lagrangian = to_text(text.value);
    std::vector<std::string> where;
    for (const Tree& factor : factors) where.push_back(to_text(factor) + " != 0");
    const System read = elaborate(read_model_text(model.name + "_routh.toml", reduced.document));
    reduced.report = verify_routh(graph, checked.system, made, read, free_of, where);
    for (std::size_t j = 0; j < cyclic.size(); ++j)
        reduced.said +=
            fmt::format("  {} = {}\n", model.fibre.coordinates[cyclic[j]].name, to_text(text.velocities[j]));
    reduced.said += fmt::format("  R = {}\n", reduced.lagrangian);
    for (const Check& check : reduced.report.checks) // where momenta do not jump
        for (const std::string& each : check.where)
            if (std::ranges::find(where, each) == where.end()) where.push_back(each);
    if (!where.empty()) reduced.said += fmt::format("  where {}\n", fmt::join(where, " and "));
    return reduced;
}

} // namespace lagen
