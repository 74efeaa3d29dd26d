// SPDX-License-Identifier: GPL-2.0-or-later
/// kind = "nonholonomic": the coordinates Y of its ambient algebroid, and the affine distribution b + D in it, by
/// `sections` and `drift` or by `constraints`.
#include "model/algebroid_draft.hpp"

#include "expression/fold.hpp"
#include "expression/parse.hpp"
#include "model/families.hpp"
#include "model/read_values.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace lagen {

namespace {

void refuse_beside(const TomlEntry* block, const char* hint)
{
    if (block == nullptr) return;
    throw ModelError(fmt::format("[{}] stands beside a nonholonomic algebroid", block->name()), block->where(), hint);
}

void refuse_other_blocks(const ModelReader& reader)
{
    refuse_beside(reader.groupoid, "a distribution has no groupoid");
    refuse_beside(reader.discrete, "nonholonomic models move in continuous time: give [lagrangian] L");
    refuse_beside(reader.mechanics.control, "nonholonomic models move by d'Alembert's principle: give [lagrangian] L");
    refuse_beside(reader.mechanics.hamiltonian, "the equations need L on the ambient algebroid: give [lagrangian] L");
}

/// Degrees of trees in Y: 0, 1, or 2 for what is not affine.
class Degrees {
  public:
    explicit Degrees(const std::vector<Symbol>& ambient)
    {
        for (const Symbol& symbol : ambient) ambient_.insert(symbol.name);
    }

    int of(const Tree& tree)
    {
        return degrees_(tree,
                        [this](const Tree& part, const std::vector<int>& parts) { return of_node(*part, parts); });
    }

    /// The first term of a sum of degree 2 that is none itself.
    Tree term_of_degree_two(const Tree& tree)
    {
        if (tree->kind == TreeKind::add || tree->kind == TreeKind::negate)
            for (const Tree& part : tree->arguments)
                if (of(part) == 2) return term_of_degree_two(part);
        return tree;
    }

  private:
    [[nodiscard]] int of_node(const TreeNode& node, const std::vector<int>& parts) const
    {
        const int largest = parts.empty() ? 0 : *std::ranges::max_element(parts);
        int degree = largest == 0 ? 0 : 2;
        if (node.kind == TreeKind::name) degree = ambient_.contains(node.name) ? 1 : 0;
        if (node.kind == TreeKind::add || node.kind == TreeKind::negate) degree = largest;
        if (node.kind == TreeKind::divide && parts[1] == 0) degree = parts[0];
        if (node.kind == TreeKind::multiply) {
            degree = 0;
            for (const int part : parts) degree = std::min(2, degree + part);
        }
        return degree;
    }

    std::set<std::string> ambient_;
    Fold<int> degrees_;
};

void require_affine(const Tree& constraint, Degrees& degrees, const Excerpt& text)
{
    const SourceRange where = text.range(0, text.text.size());
    const int degree = degrees.of(constraint);
    if (degree == 0)
        throw ModelError(fmt::format("the constraint '{}' depends on no ambient fibre coordinate", text.text), where,
                         "a constraint on positions is holonomic: [base] constraints = [..]");
    if (degree == 1) return;
    const Tree term = degrees.term_of_degree_two(constraint);
    throw ModelError(
        fmt::format("the constraint '{}' is not affine in the ambient fibre coordinates: it has the term {}", text.text,
                    to_text(term)),
        term->where.file ? term->where : where, "constraints are linear in velocities, up to a drift");
}

void read_constraints(const ModelReader& reader, AlgebroidBlock& block, const TomlEntry& entry)
{
    Degrees degrees(block.of[0].fibre);
    for (const Excerpt& text : read_list(entry.value, "'constraints' of [algebroid]")) {
        refuse_equation(text, "the constraint");
        const ArrayValue closed = reader.close_array(
            parse_expression(text), {Role::time, Role::parameter, Role::base, Role::ambient}, "a constraint");
        for (const Tree& constraint : closed.entries) {
            require_affine(constraint, degrees, text);
            block.constraints.push_back(constraint);
        }
    }
    if (block.constraints.empty())
        throw ModelError("'constraints' of [algebroid] is an empty array", entry.value.where,
                         "without a constraint the algebroid is that of [algebroid.of]");
}

void read_drift(const ModelReader& reader, AlgebroidBlock& block, const TomlEntry& entry)
{
    const std::vector<Symbol>& ambient = block.of[0].fibre;
    const TableReader table(entry.value, "'drift' of [algebroid]");
    std::set<std::size_t> seen;
    for (const TomlEntry& line : entry.value.entries) {
        const ResolvedKey key = require_key(ambient, line.key, "the drift", "ambient fibre coordinate");
        const std::string what = fmt::format("the component '{}' of the drift", key.name);
        const ArrayValue closed = reader.close_array(read_array_expression(line.value, what),
                                                     {Role::time, Role::parameter, Role::base}, what);
        const std::vector<Tree> values = fit_values(closed, key.shape, what, line.value.where);
        for (std::size_t k = 0; k < values.size(); ++k) {
            if (!seen.insert(key.indices[k]).second)
                throw ModelError(fmt::format("{} is given twice", what), line.where());
            const bool zero = values[k]->kind == TreeKind::number && values[k]->number == 0;
            if (!zero) block.drift.push_back({0, key.indices[k], values[k], line.value.where});
        }
    }
}

/// As many as the constraints leave.
void require_kept(const ModelReader& reader, const AlgebroidBlock& block)
{
    const std::size_t r = block.of[0].fibre.size(), m = block.constraints.size(), kept = block.kept.size();
    if (kept + m == r) return;
    throw ModelError(
        fmt::format("the number of fibre coordinates is {}, where {} constraint{} on {} ambient ones leave{} {}", kept,
                    m, m == 1 ? "" : "s", r, m == 1 ? "s" : "", m < r ? r - m : 0),
        reader.model.fibre.coordinates.empty() ? block.where : reader.model.fibre.coordinates.front().where,
        "[fibre] names the ambient coordinates that are kept; the others are solved for");
}

} // namespace

void require_distribution(const AlgebroidDraft& draft)
{
    if (draft.kind == nullptr || draft.kind->kind != AlgebroidKind::nonholonomic) return;
    const TomlEntry *sections = find_entry(*draft.table, "sections"), *drift = find_entry(*draft.table, "drift");
    const TomlEntry* constraints = find_entry(*draft.table, "constraints");
    if (sections == nullptr && constraints == nullptr)
        throw ModelError("an algebroid of kind 'nonholonomic' needs 'sections' or 'constraints'", draft.where,
                         "sections = { y = { Y = \"..\" } } for e_y = .. e_Y, or constraints = [\"..\"]");
    if (sections == nullptr && drift != nullptr)
        throw ModelError("'drift' stands beside 'constraints' alone", drift->where(),
                         "the constraints say what the drift is; 'sections' leave it open");
}

bool has_constraints_alone(const ModelReader& reader)
{
    const bool nonholonomic = is_nonholonomic(reader.model);
    return nonholonomic && find_entry(*reader.draft->table, "sections") == nullptr;
}

void declare_ambient(ModelReader& reader)
{
    if (!is_nonholonomic(reader.model)) return;
    refuse_other_blocks(reader);
    declare_symbols(reader, reader.model.algebroid.of[0].fibre, Role::ambient);
}

void keep_coordinates(ModelReader& reader, const std::vector<Symbol>& names)
{
    AlgebroidBlock& block = reader.model.algebroid;
    const std::vector<Symbol>& ambient = block.of[0].fibre;
    (void)group_symbols(names); // families are kept whole
    for (const Symbol& symbol : names) {
        const std::size_t place = index_of(ambient, symbol.name);
        if (place == ambient.size())
            throw ModelError(fmt::format("[fibre] names '{}', which is no ambient fibre coordinate", symbol.name),
                             symbol.where, hint_for(symbol.name, declared_names(ambient), "ambient fibre coordinates"));
        if (std::ranges::find(block.kept, place) != block.kept.end())
            throw ModelError(fmt::format("[fibre] names '{}' twice", symbol.name), symbol.where);
        block.kept.push_back(place);
        reader.model.fibre.coordinates.push_back(symbol);
    }
}

void read_distribution(const ModelReader& reader, AlgebroidBlock& block, const AlgebroidDraft& draft)
{
    if (block.kind != AlgebroidKind::nonholonomic) return;
    if (const TomlEntry* drift = find_entry(*draft.table, "drift")) read_drift(reader, block, *drift);
    if (const TomlEntry* constraints = find_entry(*draft.table, "constraints"))
        read_constraints(reader, block, *constraints);
    if (has_constraints_alone(reader) && !reader.is_probe) require_kept(reader, block);
}

void refuse_nonholonomic(const ModelReader& reader, const TomlEntry& block)
{
    if (!is_nonholonomic(reader.model)) return;
    throw ModelError(fmt::format("[{}] of a nonholonomic model are not there yet", block.name()), block.where(),
                     "a function that is conserved can be claimed under [invariants]");
}

} // namespace lagen
