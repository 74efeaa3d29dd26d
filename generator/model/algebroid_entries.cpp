// SPDX-License-Identifier: GPL-2.0-or-later
/// The entries of [algebroid]: anchor, bracket, spanned_by, sections, connection, representation. Keys of rows and
/// entries are coordinates or families of them; of two families the value is a matrix, (entries of the inner key) x
/// (entries of the outer one). A line of an anchor may be by a base coordinate, x = "..", which says x' = .., linear in
/// the fibre coordinates: R = "R*hat(w)". Behind them kind = "nonholonomic": the coordinates Y of its ambient
/// algebroid, and the affine distribution b + D in it, by `sections` and `drift` or by `constraints`.
#include "expression/derivative.hpp"
#include "expression/fold.hpp"
#include "expression/parse.hpp"
#include "model/algebroid_draft.hpp"
#include "model/complaints.hpp"
#include "model/families.hpp"
#include "model/read_values.hpp"
#include "text/comma_list.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace lagen {

namespace {

/// The symbols that the keys of a table of rows, and of the rows, name, and how messages call them.
struct RowSymbols {
    const std::vector<Symbol>& rows;
    const char* row_noun;
    const std::vector<Symbol>& entries;
    const char* entry_noun;
    Roles roles = Role::parameter | Role::base; ///< of the values
};

/// The shape of the value of an entry.
Shape shape_of(const ResolvedKey& outer, const ResolvedKey& inner)
{
    if (outer.shape.rank == Rank::scalar) return inner.shape;
    if (inner.shape.rank == Rank::scalar) return {Rank::vector, outer.indices.size(), 1};
    return {Rank::matrix, inner.indices.size(), outer.indices.size()};
}

/// Calls take(row, entry, value, where) for every entry of these lines that is not a plain 0.
template <class Take>
void read_rows(const ModelReader& reader, const std::vector<Item>& lines, const std::string& title,
               const RowSymbols& symbols, Take take)
{
    std::set<std::pair<std::size_t, std::size_t>> seen;
    for (const Item& line : lines) {
        const ResolvedKey outer = require_key(symbols.rows, line.key(), title, symbols.row_noun);
        if (!line.is(TomlKind::table))
            throw complain::is_not(line.title(), kind_text(line.value().kind), "a table", line.value().where);
        for (const Item& item : line.items()) {
            const ResolvedKey inner = require_key(symbols.entries, item.key(), line.title(), symbols.entry_noun);
            const std::vector<Tree> values = reader.entries(item, shape_of(outer, inner), symbols.roles);
            const bool by_columns = outer.shape.rank != Rank::scalar;
            for (std::size_t k = 0; k < values.size(); ++k) {
                const std::size_t a = outer.indices[by_columns ? k % outer.indices.size() : 0];
                const std::size_t b = inner.indices[by_columns ? k / outer.indices.size() : k];
                if (!seen.emplace(a, b).second)
                    throw complain::twice(fmt::format("the entry '{}' of '{}' in {}", symbols.entries[b].name,
                                                      symbols.rows[a].name, title),
                                          item.where());
                if (!is_plain_zero(values[k])) take(a, b, values[k], item.value().where);
            }
        }
    }
}

/// The fibre coordinates of an inner frame are none of the model's names.
Scope scope_with_fibre(const Scope& scope, const std::vector<Symbol>& fibre)
{
    Scope wider = scope;
    for (const SymbolGroup& group : group_symbols(fibre))
        if (!wider.has_symbol(group.name) && wider.find_family(group.name) == nullptr)
            wider.declare_family(group.name, group.shape, fibre[group.first].where);
    return wider;
}

/// rho^x_a is the coefficient of y^a.
void read_rate_line(const ModelReader& reader, AlgebroidBlock& block, const Item& line, const ResolvedKey& key)
{
    const std::string what = fmt::format("the rate of '{}'", line.name());
    const std::vector<std::string> fibre = names_of(block.fibre);
    const Names::Entry* own = fibre.empty() ? nullptr : reader.names.find(fibre[0]);
    const ArrayValue closed =
        reader.close_in(scope_with_fibre(reader.model.scope, block.fibre), read_array_expression(line.value(), what),
                        Role::parameter | Role::base | (own != nullptr ? own->role : Role::built_in), what);
    const std::vector<Tree> rates = fit_values(closed, key.shape, what, line.value().where);
    for (std::size_t k = 0; k < rates.size(); ++k) {
        const std::size_t i = block.base[key.indices[k]];
        if (std::ranges::find(block.anchor, i, &AnchorEntry::coordinate) != block.anchor.end())
            throw complain::twice(what, line.where(), "by the lines of the sections too: keep one of them");
        const std::optional<std::vector<Tree>> coefficients = linear_coefficients(rates[k], fibre);
        if (!coefficients)
            throw ModelError(
                fmt::format("{} is not linear in the fibre coordinates", what), line.value().where,
                "an anchor is linear: x' = rho^x_a y^a, and each term has one fibre coordinate for a factor");
        for (std::size_t a = 0; a < fibre.size(); ++a)
            if ((*coefficients)[a]) block.anchor.push_back({a, i, (*coefficients)[a], line.value().where});
    }
}

/// Lines by sections first, then those by coordinates.
void read_anchor(const ModelReader& reader, AlgebroidBlock& block, const Item& table)
{
    const std::vector<Symbol> base = coordinates_of(reader.model, block);
    std::vector<Item> sections;
    std::vector<std::pair<Item, ResolvedKey>> rates;
    for (const Item& line : table.items()) {
        const auto key = line.is(TomlKind::table) ? std::nullopt : resolve_key(base, line.name());
        if (key)
            rates.emplace_back(line, *key);
        else
            sections.push_back(line);
    }
    read_rows(reader, sections, table.title(), {block.fibre, "fibre coordinate", base, "base coordinate"},
              [&](std::size_t a, std::size_t i, const Tree& value, const SourceRange& where) {
                  block.anchor.push_back({a, block.base[i], value, where});
              });
    for (const auto& [line, key] : rates) read_rate_line(reader, block, line, key);
}

/// A section that is zero depends on the others: it is named here, before any determinant.
template <class Entry>
void require_every_section(const AlgebroidBlock& block, const std::vector<Entry>& entries, const Item& table)
{
    for (std::size_t a = 0; a < block.fibre.size(); ++a) {
        if (std::ranges::find(entries, a, &Entry::section) != entries.end()) continue;
        throw ModelError(fmt::format("the section '{}' is zero, or not given", block.fibre[a].name), table.where(),
                         fmt::format("every section stands in '{}', and they are independent", table.name()));
    }
}

/// A fibre that is too short makes vertical coordinates horizontal ones: the message says how it is read.
void read_connection(const ModelReader& reader, AlgebroidBlock& block, const Item& table)
{
    const std::size_t n = std::min(block.base.size(), block.fibre.size());
    const std::vector<Symbol> horizontal = part_of(block.fibre, 0, n);
    const std::vector<Symbol> vertical = part_of(block.fibre, n, block.fibre.size() - n);
    for (const Item& line : table.items())
        for (const Item& item : line.items())
            if (resolve_key(horizontal, item.name()))
                throw complain::names_no(
                    line.title(), item.name(), "vertical fibre coordinate", item.where(),
                    fmt::format("the fibre has first one horizontal coordinate a base coordinate, {}, then the "
                                "vertical ones, {}",
                                comma_list(declared_names(horizontal)), comma_list(declared_names(vertical))));
    read_rows(reader, table.items(), table.title(),
              {coordinates_of(reader.model, block), "base coordinate", vertical, "vertical fibre coordinate"},
              [&](std::size_t i, std::size_t c, const Tree& value, const SourceRange& where) {
                  block.connection.push_back({block.base[i], c + block.base.size(), value, where});
              });
}

std::size_t section_index(const AlgebroidBlock& block, const Excerpt& key, const std::string& owner)
{
    const std::size_t found = require_entry(block.fibre, key, owner, "fibre coordinate");
    if (block.kind == AlgebroidKind::atiyah && found < block.base.size())
        throw complain::names_no(owner, block.fibre[found].name, "vertical fibre coordinate", place_of(key),
                                 "the brackets of horizontal sections follow from 'connection'");
    return found;
}

void read_bracket(const ModelReader& reader, AlgebroidBlock& block, const Item& table)
{
    std::set<std::pair<std::size_t, std::size_t>> seen;
    for (const Item& pair : table.items()) {
        const std::vector<Excerpt> names = split_at_commas(pair.key());
        if (names.size() != 2)
            throw complain::wrong_number(fmt::format("sections in the key '{}'", pair.name()), names.size(),
                                         table.title(), 2, pair.where(),
                                         "write \"a,b\" = { c = \"..\" } for [e_a, e_b] = .. e_c");
        const std::size_t a = section_index(block, names[0], table.title());
        const std::size_t b = section_index(block, names[1], table.title());
        if (!seen.emplace(a, b).second) throw complain::twice(pair.title(), pair.where());
        if (a == b && !pair.value().entries.empty())
            throw ModelError(fmt::format("{} is that of a section with itself", pair.title()), pair.where(),
                             "[e, e] = 0 for every section; leave it out");
        // An empty table says zero, which the other order of the pair must agree with.
        if (pair.value().entries.empty()) block.bracket.push_back({a, b, a, number(0), pair.value().where});
        for (const Item& item : pair.items()) {
            const std::size_t c = section_index(block, item.key(), pair.title());
            const Tree parsed = read_expression(item.value(), item.title());
            const Roles roles = block.kind == AlgebroidKind::general ? Role::parameter | Role::base : Role::parameter;
            block.bracket.push_back({a, b, c, reader.scalar(parsed, roles, item.title()), item.value().where});
        }
    }
}

/// A_a, rho_a = -(A_a x)^i d/dx^i, x the vector of base coordinates.
void read_representation(const ModelReader& reader, AlgebroidBlock& block, const Item& list)
{
    block.representation_where = list.value().where;
    if (list.value().items.size() != block.fibre.size())
        throw complain::wrong_number("matrices in 'representation'", list.value().items.size(), "the fibre",
                                     block.fibre.size(), list.value().where, "one matrix a section");
    const Shape wanted{Rank::matrix, block.base.size(), block.base.size()};
    block.representation =
        read_matrices(reader, list, wanted, "it acts on the vector of all base coordinates",
                      [&](std::size_t a) { return fmt::format("the matrix of '{}'", block.fibre[a].name); });
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
    const SourceRange where = place_of(text);
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

void read_constraints(const ModelReader& reader, AlgebroidBlock& block, const Item& list)
{
    Degrees degrees(block.of[0].fibre);
    for (const Excerpt& text : list.texts()) {
        refuse_equation(text, "the constraint");
        const ArrayValue closed = reader.close(
            parse_expression(text), Role::time | Role::parameter | Role::base | Role::ambient, "a constraint");
        for (const Tree& constraint : closed.entries) {
            require_affine(constraint, degrees, text);
            block.constraints.push_back(constraint);
        }
    }
}

/// Throws ModelError unless as many are kept as the constraints leave.
void require_kept(const ModelReader& reader, const AlgebroidBlock& block)
{
    const std::size_t r = block.of[0].fibre.size(), m = block.constraints.size(), kept = block.kept.size();
    if (kept + m == r) return;
    throw complain::wrong_number(
        "fibre coordinates", kept, fmt::format("a model with {} ambient ones and {} of constraints", r, m),
        m < r ? r - m : 0,
        reader.model.fibre.coordinates.empty() ? block.where : reader.model.fibre.coordinates.front().where,
        "[fibre] names the ambient coordinates that are kept; the others are solved for");
}

} // namespace

std::vector<ArrayValue> read_matrices(const ModelReader& reader, const Item& list, std::optional<Shape> wanted,
                                      const char* hint, const std::function<std::string(std::size_t)>& title)
{
    std::vector<ArrayValue> out;
    for (const TomlValue& item : list.value().items) {
        const std::string what = title(out.size());
        out.push_back(reader.close(read_array_expression(item, what), Role::parameter, what));
        const Shape shape = out.back().shape;
        const bool square = shape.rank == Rank::matrix && shape.rows == shape.columns;
        if (!wanted && !square) throw complain::is_not(what, to_text(shape), "a square matrix", item.where);
        if (!wanted) wanted = shape;
        if (!(shape == *wanted)) throw complain::is_not(what, to_text(shape), to_text(*wanted), item.where, hint);
    }
    return out;
}

void read_entries(const ModelReader& reader, AlgebroidBlock& block, const AlgebroidDraft& draft)
{
    if (!draft.kind) return; // the file's own reader has read them
    const auto at = [&](const char* key) { return draft.table.at(key); };
    if (const Item anchor = at("anchor")) read_anchor(reader, block, anchor);
    if (const Item spanned_by = at("spanned_by")) {
        read_anchor(reader, block, spanned_by);
        require_every_section(block, block.anchor, spanned_by);
    }
    if (const Item bracket = at("bracket")) read_bracket(reader, block, bracket);
    if (const Item representation = at("representation")) read_representation(reader, block, representation);
    if (const Item connection = at("connection")) read_connection(reader, block, connection);
    if (const Item sections = at("sections")) {
        Roles roles = Role::parameter | Role::base;
        if (block.kind == AlgebroidKind::nonholonomic) roles = roles | Role::time;
        read_rows(
            reader, sections.items(), sections.title(),
            {block.fibre, "fibre coordinate", block.of[0].fibre, "fibre coordinate of the inner algebroid", roles},
            [&](std::size_t a, std::size_t b, const Tree& value, const SourceRange& where) {
                block.sections.push_back({a, b, value, where});
            });
        require_every_section(block, block.sections, sections);
    }
    for (std::size_t k = 0; k < draft.of.size(); ++k) read_entries(reader, block.of[k], draft.of[k]);
}

bool has_constraints_alone(const ModelReader& reader)
{
    const bool nonholonomic = is_nonholonomic(reader.model);
    return nonholonomic && !reader.draft->table.at("sections");
}

void declare_ambient(ModelReader& reader)
{
    if (!is_nonholonomic(reader.model)) return;
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
            throw complain::names_no("[fibre]", symbol.name, "ambient fibre coordinate", symbol.where,
                                     hint_for(symbol.name, declared_names(ambient), "ambient fibre coordinates"));
        if (std::ranges::find(block.kept, place) != block.kept.end())
            throw complain::names_twice("[fibre]", symbol.name, symbol.where);
        block.kept.push_back(place);
        reader.model.fibre.coordinates.push_back(symbol);
    }
}

void read_distribution(const ModelReader& reader, AlgebroidBlock& block, const AlgebroidDraft& draft)
{
    if (block.kind != AlgebroidKind::nonholonomic) return;
    reader.read_values(draft.table.at("drift"), block.of[0].fibre, "ambient fibre coordinate",
                       [&](std::size_t b, const Tree& value, const Item& item) {
                           if (!is_plain_zero(value)) block.drift.push_back({0, b, value, item.value().where});
                       });
    if (const Item constraints = draft.table.at("constraints")) read_constraints(reader, block, constraints);
    if (has_constraints_alone(reader) && !reader.is_probe) require_kept(reader, block);
}

} // namespace lagen
