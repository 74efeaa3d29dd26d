// SPDX-License-Identifier: GPL-2.0-or-later
/// Subbundles of TM: C^c_ab is solved from [rho_a, rho_b]^i = rho^i_c C^c_ab in as many rows i as there are sections.
/// The rows that are left are the condition that the distribution is involutive; they are checked with all anchors.
#include "elaborate/build_workspace.hpp"
#include "graph/calculus/places.hpp"

#include <algorithm>

namespace lagen {
namespace {

constexpr std::size_t most_row_choices = 64; ///< choices of rows whose determinants are compared
constexpr std::size_t most_choices = 4096;   ///< choices of rows in all; most determinants are zero by structure

class SubbundleBuilder {
  public:
    SubbundleBuilder(BuildWorkspace& work, const AlgebroidBlock& block)
        : work_(work), graph_(work.graph()), block_(block), n_(work.model().base.coordinates.size()),
          r_(block.fibre.size()), columns_(r_), entries_(n_ * r_, graph_.constant(0))
    {
        for (const AnchorEntry& entry : block.anchor) {
            const NodeId value = work.lower(entry.value);
            entries_[entry.coordinate * r_ + entry.section] = value;
            if (!graph_.is_zero(value)) columns_[entry.section].push_back({entry.coordinate, value});
        }
        for (Column& column : columns_)
            std::sort(column.begin(), column.end(),
                      [](const ColumnEntry& a, const ColumnEntry& b) { return a.index < b.index; });
    }

    BlockParts build()
    {
        BlockParts parts;
        for (const AnchorEntry& entry : block_.anchor)
            parts.rho.push_back({entry.coordinate, entry.section, entry.value, entry.where});
        if (r_ == 0) return parts;
        require_bounds();
        const std::vector<std::size_t> rows = solvable_rows();
        std::vector<NodeId> matrix;
        for (const std::size_t i : rows)
            for (std::size_t c = 0; c < r_; ++c) matrix.push_back(entries_[i * r_ + c]);
        std::vector<std::pair<std::size_t, std::size_t>> pairs;
        std::vector<std::vector<NodeId>> right;
        for (std::size_t a = 0; a < r_; ++a)
            for (std::size_t b = a + 1; b < r_; ++b) {
                pairs.emplace_back(a, b);
                right.push_back(components(a, b, rows));
            }
        const std::vector<std::vector<NodeId>> C = solve_exactly(graph_, matrix, r_, right);
        for (std::size_t k = 0; k < pairs.size(); ++k)
            for (std::size_t c = 0; c < r_; ++c)
                work_.append_structure(parts, c, pairs[k].first, pairs[k].second, C[k][c], block_.where);
        return parts;
    }

  private:
    [[nodiscard]] SourceRange where() const { return block_.anchor.empty() ? block_.where : block_.anchor[0].where; }

    [[noreturn]] void refuse_dependent() const
    {
        throw ModelError("the sections of the subbundle are linearly dependent everywhere: their number is " +
                             std::to_string(r_) + ", and the rank of the distribution is smaller",
                         where(), "give as many sections as the distribution has dimensions");
    }

    void require_bounds() const
    {
        if (r_ > block_.base.size()) refuse_dependent();
        if (r_ > written_determinant_limit)
            throw ModelError("the subbundle has " + std::to_string(r_) + " sections, more than the " +
                                 std::to_string(written_determinant_limit) + " that C is solved for",
                             where(), "give rho and C outright: kind = \"general\"");
    }

    /// [rho_a, rho_b]^i for these i
    std::vector<NodeId> components(std::size_t a, std::size_t b, const std::vector<std::size_t>& rows)
    {
        const VectorField field = bracket(work_.gradients(), columns_[a], columns_[b]);
        std::vector<NodeId> values;
        for (const std::size_t i : rows) values.push_back(Algebroid::entry(graph_, field, i));
        return values;
    }

    /// Of the rows whose determinant is certainly not zero everywhere those with the shortest one.
    std::vector<std::size_t> solvable_rows()
    {
        const Places columns = first_places(r_);
        struct Choice {
            std::size_t cost;
            std::vector<std::size_t> rows;
            NodeId determinant;
        };
        std::vector<Choice> choices;
        Places places = columns; // of block_.base, ascending; walked in lexicographic order
        std::size_t tried = 0;
        do {
            ++tried;
            std::vector<std::size_t> rows;
            for (const std::size_t k : places) rows.push_back(block_.base[k]);
            const NodeId determinant = determinant_of(graph_, entries_, r_, rows, columns);
            if (graph_.is_zero(determinant)) continue;
            const Tree text = work_.readable(determinant);
            if (text != nullptr) choices.push_back({to_text(text).size(), rows, determinant});
        } while (choices.size() < most_row_choices && tried < most_choices && next_places(places, block_.base.size()));
        std::ranges::stable_sort(choices, {}, &Choice::cost);
        bool undecided = false;
        for (const Choice& choice : choices) {
            const ProofStatus status = work_.decide(choice.determinant).status;
            if (status == ProofStatus::refuted) return choice.rows;
            undecided = undecided || status == ProofStatus::undecided;
        }
        if (!undecided && tried < most_choices) refuse_dependent();
        throw ModelError("it could not be shown that the sections of the subbundle are linearly independent somewhere",
                         where(), "give rho and C outright: kind = \"general\"");
    }

    BuildWorkspace& work_;
    Graph& graph_;
    const AlgebroidBlock& block_;
    std::size_t n_, r_;
    std::vector<VectorField> columns_; ///< columns_[a]: rho^i_a
    std::vector<NodeId> entries_;      ///< entries_[i * r + a] = rho^i_a, i over all base coordinates of the model
};

} // namespace

BlockParts build_subbundle(BuildWorkspace& work, const AlgebroidBlock& block)
{
    return SubbundleBuilder(work, block).build();
}

} // namespace lagen
