// SPDX-License-Identifier: GPL-2.0-or-later
/// From drafts to blocks: sections and base coordinates get their numbers, blocks of files theirs in this model.
#include "model/algebroid_draft.hpp"

#include "expression/rewrite.hpp"
#include "model/read_values.hpp"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <numeric>

namespace lagen {

namespace {

using Places = std::vector<std::size_t>;

/// Numbers of the file's base coordinates become numbers of the model's.
void move_block(AlgebroidBlock& block, const Places& base)
{
    const auto move = [&](std::size_t& i) { i = base.at(i); };
    for (std::size_t& i : block.base) move(i);
    for (std::size_t& i : block.over) move(i);
    for (AnchorEntry& entry : block.anchor) move(entry.coordinate);
    for (ConnectionEntry& entry : block.connection) move(entry.coordinate);
    for (AlgebroidBlock& inner : block.of) move_block(inner, base);
}

/// New names in the entries of a block.
void rename_block(AlgebroidBlock& block, const std::map<std::string, Tree>& names)
{
    const auto rename = [&](Tree& value) { value = replace_names(value, names); };
    for (AnchorEntry& entry : block.anchor) rename(entry.value);
    for (BracketEntry& entry : block.bracket) rename(entry.value);
    for (SectionEntry& entry : block.sections) rename(entry.value);
    for (ConnectionEntry& entry : block.connection) rename(entry.value);
    for (ArrayValue& matrix : block.representation)
        for (Tree& entry : matrix.entries) rename(entry);
    for (AlgebroidBlock& inner : block.of) rename_block(inner, names);
}

AlgebroidBlock block_of_file(const ModelReader& reader, const AlgebroidDraft& draft)
{
    const IncludedModel& included = reader.included[draft.included];
    AlgebroidBlock block = included.model.algebroid;
    block.fibre = included.model.fibre.coordinates;
    block.where = draft.where;
    move_block(block, included.base);
    if (!included.renamed.empty()) rename_block(block, included.renamed);
    return block;
}

/// Sections of this many are required; the file says which table.
void require_inner_rank(const AlgebroidBlock& block, const std::string& title)
{
    const std::optional<RequiredRank> rank = required_rank(block);
    if (!rank || rank->fits(block.fibre.size())) return;
    throw ModelError(fmt::format("the number of fibre coordinates of {} is {}, where {} needs {}", title,
                                 block.fibre.size(), rank->reason, rank->text()),
                     block.where);
}

Places first_places(std::size_t count)
{
    Places out(count);
    std::iota(out.begin(), out.end(), std::size_t{0});
    return out;
}

} // namespace

std::string with_sizes(const std::string& algebra, const std::vector<Size>& sizes)
{
    const auto in_name = [&](std::size_t k) {
        return k < algebra.size() && (std::isalnum(static_cast<unsigned char>(algebra[k])) != 0 || algebra[k] == '_');
    };
    std::string out;
    for (std::size_t k = 0; k < algebra.size();) {
        std::size_t end = k;
        while (in_name(end)) ++end;
        const std::string word = algebra.substr(k, std::max<std::size_t>(end - k, 1));
        const auto size = std::find_if(sizes.begin(), sizes.end(), [&](const Size& each) { return each.name == word; });
        const bool stands_for_number = k > 0 && (algebra[k - 1] == '(' || algebra[k - 1] == '^');
        out += size != sizes.end() && stands_for_number ? std::to_string(size->value) : word;
        k += word.size();
    }
    return out;
}

AlgebroidBlock make_block(const ModelReader& reader, const AlgebroidDraft& draft, std::size_t leaf_size)
{
    if (draft.kind == nullptr) return block_of_file(reader, draft);
    const std::vector<Symbol>& all = reader.model.base.coordinates;
    const std::vector<Symbol> leaf_base(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(leaf_size));
    const DraftSpace space = space_of(reader, draft, leaf_base);
    AlgebroidBlock block;
    block.kind = draft.kind->kind;
    block.fibre = space.fibre;
    block.base = first_places(space.base.size());
    block.dual = draft.dual;
    block.where = draft.where;
    for (const AlgebroidDraft& inner : draft.of) block.of.push_back(make_block(reader, inner, leaf_size));
    if (block.kind == AlgebroidKind::tangent) block.over = read_over(*draft.table, draft.title, space.base);
    block.anchor = draft.level_set.anchor;
    if (block.kind == AlgebroidKind::groupoid) block.rank = rank_of(*reader.model.groupoid, space.base.size());
    if (const TomlEntry* algebra = find_entry(*draft.table, "algebra")) {
        block.algebra =
            with_sizes(read_text(algebra->value, fmt::format("'algebra' of {}", draft.title)), reader.model.sizes);
        block.algebra_where = algebra->value.where;
    }
    if (!draft.outermost) require_inner_rank(block, draft.title);
    return block;
}

bool RequiredRank::fits(std::size_t rank) const
{
    return at_least ? rank >= least : at_most ? rank <= least : rank == least;
}

std::string RequiredRank::text() const
{
    return at_least || at_most ? fmt::format("at {} {}", at_least ? "least" : "most", least) : std::to_string(least);
}

std::optional<RequiredRank> required_rank(const AlgebroidBlock& block)
{
    const auto inner_rank = [&](std::size_t k) { return block.of.at(k).fibre.size(); };
    switch (block.kind) {
    case AlgebroidKind::tangent: return RequiredRank{block.over.size(), false, "a tangent bundle"};
    case AlgebroidKind::atiyah: return RequiredRank{block.base.size(), true, "an Atiyah algebroid"};
    case AlgebroidKind::frame: return RequiredRank{inner_rank(0), false, "a frame of the inner algebroid"};
    case AlgebroidKind::prolongation: return RequiredRank{2 * inner_rank(0), false, "the prolongation"};
    case AlgebroidKind::groupoid: return RequiredRank{block.rank, false, "the groupoid"};
    case AlgebroidKind::nonholonomic:
        return RequiredRank{inner_rank(0) == 0 ? 0 : inner_rank(0) - 1, false, "a nonholonomic constraint", true};
    case AlgebroidKind::product: {
        std::size_t rank = 0;
        for (const AlgebroidBlock& factor : block.of) rank += factor.fibre.size();
        return RequiredRank{rank, false, "the product"};
    }
    default: return std::nullopt;
    }
}

} // namespace lagen
