// SPDX-License-Identifier: GPL-2.0-or-later
/// Frames e'_a = A_a^b e_b of an algebroid, and its prolongations.
#include "elaborate/build_workspace.hpp"
#include "graph/calculus/places.hpp"
#include "graph/core/evaluate.hpp"
#include "proof/rational_matrix.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace lagen {
namespace {

/// True where some pair is given in both orders, so that antisymmetry is a claim that the frame must keep.
bool gives_both_orders(const Algebroid& inner)
{
    const std::size_t r = inner.r();
    for (std::size_t a = 0; a < r; ++a)
        for (std::size_t b = a; b < r; ++b)
            if (inner.given[a * r + b] && inner.given[b * r + a]) return true;
    return false;
}

/// A frame e'_a = A_a^b e_b on the graph, before its entries are made readable.
struct FrameFormulas {
    std::vector<Column> anchor;                             ///< anchor[a]: rho'^i_a = A_a^b rho^i_b
    std::vector<std::pair<std::size_t, std::size_t>> pairs; ///< (a, b), a < b; all of them where `both_orders`
    std::vector<std::vector<NodeId>> bracket;               ///< bracket[k][c]: C'^c_ab of pairs[k]
    bool both_orders = false;                               ///< the inner block lists a pair in both orders
};

class MovingFrameBuilder {
  public:
    MovingFrameBuilder(BuildWorkspace& work, const AlgebroidBlock& block, const BlockParts& inner)
        : work_(work), graph_(work.graph()), block_(block), inner_(work.lowered(block.of[0], inner)),
          r_(block.fibre.size()), rows_(r_)
    {
        std::vector<std::vector<NodeId>> entries(r_, std::vector<NodeId>(r_, graph_.constant(0)));
        for (const SectionEntry& entry : block.sections)
            entries[entry.section][entry.inner] =
                graph_.add(entries[entry.section][entry.inner], work.lower(entry.value));
        for (std::size_t a = 0; a < r_; ++a)
            for (std::size_t b = 0; b < r_; ++b)
                if (!graph_.is_zero(entries[a][b])) rows_[a].push_back({b, entries[a][b]});
        for (std::size_t b = 0; b < r_; ++b)
            for (std::size_t a = 0; a < r_; ++a) transposed_.push_back(entries[a][b]);
    }

    BlockParts build()
    {
        require_independent();
        const FrameFormulas frame = formulas();
        BlockParts parts;
        for (std::size_t a = 0; a < r_; ++a)
            for (const ColumnEntry& entry : frame.anchor[a])
                work_.append_anchor(parts, entry.index, a, entry.value, block_.where);
        for (std::size_t k = 0; k < frame.pairs.size(); ++k) {
            const auto& [a, b] = frame.pairs[k];
            const std::size_t before = parts.C.size();
            for (std::size_t c = 0; c < r_; ++c)
                work_.append_structure(parts, c, a, b, frame.bracket[k][c], block_.where);
            // A zero order that is left out would be read as the negative of the other.
            if (frame.both_orders && parts.C.size() == before)
                parts.C.push_back({0, a, b, number(0, block_.where), block_.where});
        }
        if (frame.both_orders)
            work_.forget_construction();
        else
            state_construction(frame, parts);
        return parts;
    }

  private:
    /// C'^c_ab from A_c^d C'^c_ab = V^d, where V = [e'_a, e'_b] in the inner frame
    FrameFormulas formulas()
    {
        FrameFormulas frame;
        frame.both_orders = gives_both_orders(inner_);
        for (const Section& row : rows_) frame.anchor.push_back(anchor_of(graph_, inner_, row));
        std::vector<std::vector<NodeId>> right;
        for (std::size_t a = 0; a < r_; ++a)
            for (std::size_t b = frame.both_orders ? 0 : a + 1; b < r_; ++b) {
                frame.pairs.emplace_back(a, b);
                right.push_back(dense(bracket(work_.gradients(), inner_, rows_[a], rows_[b])));
            }
        frame.bracket = solve_exactly(graph_, transposed_, r_, right);
        return frame;
    }

    /// The entries as they are written are those of the frame, and det A is not zero, a block at a time.
    void state_construction(const FrameFormulas& frame, const BlockParts& parts)
    {
        Construction* construction = work_.construction();
        if (construction == nullptr) return;
        const Algebroid written = work_.lowered(block_, parts);
        for (std::size_t a = 0; a < r_; ++a) state_equal(written.anchor[a], frame.anchor[a]);
        for (std::size_t k = 0; k < frame.pairs.size(); ++k) {
            Column bracket;
            for (std::size_t c = 0; c < r_; ++c) bracket.push_back({c, frame.bracket[k][c]});
            state_equal(written.C(frame.pairs[k].first, frame.pairs[k].second), bracket);
        }
        const std::vector<NodeId> entries = written.entries();
        for (const std::vector<NodeId>* nodes : {&entries, &std::as_const(transposed_)})
            construction->analytic.insert(construction->analytic.end(), nodes->begin(), nodes->end());
        for (const CoupledBlock& each : coupled_blocks(graph_, transposed_, r_))
            construction->nonzero.push_back(one_where_regular(each));
    }

    /// Of a block A of any size the first entry of A A^-1 e_1, which has a value where det A is not zero; of a single
    /// entry the entry.
    [[nodiscard]] NodeId one_where_regular(const CoupledBlock& block)
    {
        const std::vector<NodeId> entries = entries_of(block);
        const std::size_t m = block.rows.size();
        if (m == 1) return entries[0];
        std::vector<NodeId> terms, right(m, graph_.constant(0));
        right[0] = graph_.constant(1);
        const std::vector<NodeId> z = graph_.solve(entries, right, MatrixStructure::general);
        for (std::size_t k = 0; k < m; ++k) terms.push_back(graph_.multiply(entries[k], z[k]));
        return graph_.sum(terms);
    }

    [[nodiscard]] std::vector<NodeId> entries_of(const CoupledBlock& block) const
    {
        std::vector<NodeId> entries;
        for (const std::size_t row : block.rows)
            for (const std::size_t column : block.columns) entries.push_back(transposed_[row * r_ + column]);
        return entries;
    }

    /// Two columns, up to entries that are the same node.
    void state_equal(const Column& a, const Column& b)
    {
        std::set<std::size_t> indices;
        for (const Column* column : {&a, &b})
            for (const ColumnEntry& entry : *column) indices.insert(entry.index);
        for (const std::size_t index : indices) {
            const NodeId x = Algebroid::entry(graph_, a, index), y = Algebroid::entry(graph_, b, index);
            if (x != y) work_.construction()->zero.push_back(graph_.subtract(x, y));
        }
    }

    /// det A is not zero everywhere, a block at a time.
    void require_independent()
    {
        bool dependent = false;
        const char* what = "everywhere: the determinant of 'sections' is zero";
        for (const CoupledBlock& each : coupled_blocks(graph_, transposed_, r_)) {
            dependent = dependent || each.rows.size() != each.columns.size();
            if (dependent) continue;
            if (each.rows.size() > written_determinant_limit) {
                dependent = is_singular_at_points(each);
                what = "at every point tried: the determinant of 'sections' is zero there";
                continue;
            }
            const NodeId determinant = determinant_of(graph_, transposed_, r_, each.rows, each.columns);
            dependent = graph_.is_zero(determinant) || work_.readable(determinant) == nullptr;
        }
        if (!dependent) return;
        throw ModelError(std::string("the sections of the frame are linearly dependent ") + what,
                         block_.sections.empty() ? block_.where : block_.sections[0].where,
                         "a frame has as many independent sections as the algebroid that it frames");
    }

    /// Of a block too large for a determinant: exact ranks at three points. False where entries are not rational, or
    /// constraints leave fewer points than these.
    [[nodiscard]] bool is_singular_at_points(const CoupledBlock& block) const
    {
        if (!work_.setting().constraints.empty()) return false;
        const std::vector<NodeId> entries = entries_of(block);
        for (long k = 0; k < 3; ++k) {
            std::map<std::string, Rational> point;
            long seed = 7919 + 104729 * k;
            for (const NodeId input : graph_.inputs()) {
                seed = (seed * 48271) % 2147483647; // Lehmer's generator
                point.emplace(graph_.input_name(input), Rational(seed % 10007 + 2, 101));
            }
            for (auto& [name, value] : point) value.canonicalize();
            const std::vector<Rational> matrix = evaluate_exactly(graph_, entries, point);
            if (matrix.empty() || rank_of(matrix, block.rows.size()) == block.rows.size()) return false;
        }
        return true;
    }

    [[nodiscard]] std::vector<NodeId> dense(const Section& section)
    {
        std::vector<NodeId> components(r_, graph_.constant(0));
        for (const ColumnEntry& entry : section) components[entry.index] = entry.value;
        return components;
    }

    BuildWorkspace& work_;
    Graph& graph_;
    const AlgebroidBlock& block_;
    Algebroid inner_;
    std::size_t r_;
    std::vector<Section> rows_;      ///< rows_[a]: e'_a = A_a^b e_b
    std::vector<NodeId> transposed_; ///< transposed_[d * r + c] = A_c^d
};

} // namespace

BlockParts build_frame(BuildWorkspace& work, const AlgebroidBlock& block, const BlockParts& inner)
{
    return MovingFrameBuilder(work, block, inner).build();
}

/// rho(X_a) = rho^i_a d/dx^i, rho(V_a) = d/dy^a (or d/dmu_a); [X_a, X_b] = C^c_ab X_c, the other brackets are zero.
BlockParts build_prolongation(const AlgebroidBlock& block, const BlockParts& inner)
{
    const std::size_t r = block.of.at(0).fibre.size();
    BlockParts parts = inner;
    for (std::size_t a = 0; a < r; ++a)
        parts.rho.push_back({block.base.at(block.base.size() - r + a), r + a, number(1, block.where), block.where});
    return parts;
}

// Subbundles of TM: C^c_ab is solved from [rho_a, rho_b]^i = rho^i_c C^c_ab in as many rows i as there are sections.
// The rows that are left are the condition that the distribution is involutive; they are checked with all anchors.

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
