// SPDX-License-Identifier: GPL-2.0-or-later
/// Frames e'_a = A_a^b e_b of an algebroid, and its prolongations.
#include "elaborate/build_workspace.hpp"
#include "graph/core/evaluate.hpp"
#include "proof/rational_matrix.hpp"

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

} // namespace lagen
