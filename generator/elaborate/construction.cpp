// SPDX-License-Identifier: GPL-2.0-or-later
/// The construction gone through again, from the innermost blocks out.
#include "elaborate/construction.hpp"

#include "algebroid/structure_equations.hpp"
#include "elaborate/build_workspace.hpp"
#include "graph/core/operators.hpp"
#include "proof/almost_everywhere.hpp"

#include <algorithm>
#include <set>

namespace lagen {
namespace {

bool is_strict(Op op)
{
    const Trichotomy& holds = operator_of(op).holds;
    return (holds.below || holds.above) && !holds.equal;
}

class Construction {
  public:
    explicit Construction(const Model& model)
        : work_(model), graph_(work_.graph()), decider_(graph_, work_.setting()), smooth_(true)
    {
        for (const NodeId condition : work_.setting().domain)
            smooth_ = smooth_ && is_strict(graph_.op(condition)) &&
                      are_analytic({graph_.operands(condition)[0], graph_.operands(condition)[1]});
    }

    /// `parts` of the block satisfy the structure equations.
    bool holds(const AlgebroidBlock& block, const BlockParts& parts)
    {
        if (!smooth_) return false;
        switch (block.kind) {
        case AlgebroidKind::frame: return frame_holds(block, parts);
        case AlgebroidKind::product: return product_holds(block, parts);
        case AlgebroidKind::prolongation: {
            const BlockParts inner = build_block(work_, block.of[0]);
            return stands_on_its_base(block.of[0], inner) && holds(block.of[0], inner) &&
                   are_same(block, parts, build_prolongation(block, inner));
        }
        default: return is_proved(block, parts);
        }
    }

  private:
    /// Polynomials in them that are not zero at a point are so almost everywhere.
    [[nodiscard]] bool are_analytic(const std::vector<NodeId>& functions)
    {
        return lagen::are_analytic(graph_, functions, work_.setting(), decider_);
    }

    [[nodiscard]] bool are_analytic(const Algebroid& algebroid) { return are_analytic(algebroid.entries()); }

    /// Neither the directions nor the functions of the block know coordinates outside its own base.
    bool stands_on_its_base(const AlgebroidBlock& block, const BlockParts& parts)
    {
        const Algebroid lowered = work_.lowered(block, parts);
        const std::set<std::size_t> base(block.base.begin(), block.base.end());
        std::set<NodeId> outside;
        for (std::size_t i = 0; i < lowered.x.size(); ++i)
            if (!base.contains(i)) outside.insert(lowered.x[i]);
        const std::vector<NodeId> nodes = reachable(graph_, lowered.entries());
        return std::none_of(nodes.begin(), nodes.end(), [&](NodeId node) { return outside.contains(node); }) &&
               std::all_of(parts.rho.begin(), parts.rho.end(), [&](const auto& e) { return base.contains(e.i); });
    }

    [[nodiscard]] bool is_zero(NodeId node) const
    {
        return graph_.is_zero(node) || decider_.status(node) == ProofStatus::proved;
    }

    /// By the zero decision, equation by equation.
    bool is_proved(const AlgebroidBlock& block, const BlockParts& parts)
    {
        const Algebroid lowered = work_.lowered(block, parts);
        if (!are_analytic(lowered)) return false;
        BaseGradient partial(graph_, lowered.x);
        const ResidualList list = structure_equations(partial, lowered);
        std::set<NodeId> values;
        for (const Residual& residual : list.residuals) values.insert(residual.value);
        return std::all_of(values.begin(), values.end(), [&](NodeId value) { return is_zero(value); });
    }

    /// Equal columns, up to entries whose difference is proved to be zero.
    bool are_equal(const Column& a, const Column& b)
    {
        std::set<std::size_t> indices;
        for (const Column* column : {&a, &b})
            for (const ColumnEntry& entry : *column) indices.insert(entry.index);
        return std::all_of(indices.begin(), indices.end(), [&](std::size_t index) {
            const NodeId x = Algebroid::entry(graph_, a, index), y = Algebroid::entry(graph_, b, index);
            return x == y || is_zero(graph_.subtract(x, y));
        });
    }

    bool are_same(const AlgebroidBlock& block, const BlockParts& parts, const BlockParts& expected)
    {
        const Algebroid a = work_.lowered(block, parts), b = work_.lowered(block, expected);
        const auto same = [&](const Column& x, const Column& y) { return are_equal(x, y); };
        return are_analytic(a) && are_analytic(b) && a.given == b.given &&
               std::equal(a.anchor.begin(), a.anchor.end(), b.anchor.begin(), b.anchor.end(), same) &&
               std::equal(a.bracket.begin(), a.bracket.end(), b.bracket.begin(), b.bracket.end(), same);
    }

    /// det A, a block at a time, is certainly not zero at one of a few points.
    bool is_invertible(const std::vector<NodeId>& matrix, std::size_t r)
    {
        constexpr std::size_t points = 5;
        for (const CoupledBlock& each : coupled_blocks(graph_, matrix, r)) {
            if (each.rows.size() != each.columns.size() || each.rows.size() > written_determinant_limit) return false;
            const NodeId determinant = determinant_of(graph_, matrix, r, each.rows, each.columns);
            if (!decider_.reevaluate(determinant, points).zero_excluded) return false;
        }
        return true;
    }

    bool frame_holds(const AlgebroidBlock& block, const BlockParts& parts)
    {
        const BlockParts inner = build_block(work_, block.of[0]);
        const FrameFormulas frame = frame_formulas(work_, block, inner);
        const std::size_t r = block.fibre.size();
        const Algebroid lowered = work_.lowered(block, parts);
        if (frame.both_orders || !are_analytic(lowered) || !are_analytic(frame.transposed)) return false;
        for (std::size_t k = 0; k < frame.pairs.size(); ++k) {
            const auto& [a, b] = frame.pairs[k];
            Column bracket;
            for (std::size_t c = 0; c < r; ++c) bracket.push_back({c, frame.bracket[k][c]});
            if (lowered.given[b * r + a] || !are_equal(lowered.C(a, b), bracket)) return false;
        }
        for (std::size_t a = 0; a < r; ++a)
            if (lowered.given[a * r + a] || !are_equal(lowered.anchor[a], frame.anchor[a])) return false;
        return is_invertible(frame.transposed, r) && holds(block.of[0], inner);
    }

    /// Factors over separate bases.
    bool product_holds(const AlgebroidBlock& block, const BlockParts& parts)
    {
        std::set<std::size_t> base;
        for (const AlgebroidBlock& factor : block.of) {
            for (const std::size_t i : factor.base)
                if (!base.insert(i).second) return false;
            const BlockParts inner = build_block(work_, factor);
            if (!stands_on_its_base(factor, inner) || !holds(factor, inner)) return false;
        }
        return are_same(block, parts, build_block(work_, block));
    }

    BuildWorkspace work_;
    Graph& graph_;
    ZeroDecider decider_;
    bool smooth_; ///< the domain is open and its conditions are meromorphic
};

/// True where a frame stands in the block, or in what its products and prolongations are made of.
bool contains_frame(const AlgebroidBlock& block)
{
    return block.kind == AlgebroidKind::frame || std::any_of(block.of.begin(), block.of.end(), contains_frame);
}

} // namespace

std::function<bool()> construction_of(const Model& model, const WrittenAlgebroid& algebroid)
{
    // A Casimir's name stands for a function of the base, here and nowhere else a symbol of its own.
    if (!model.base.constraints.empty() || !model.base.casimirs.empty()) return {};
    if (!contains_frame(model.algebroid)) return {};
    return [model, parts = BlockParts{algebroid.rho, algebroid.C}] {
        AlgebroidBlock block = model.algebroid;
        block.fibre = model.fibre.coordinates;
        return Construction(model).holds(block, parts);
    };
}

} // namespace lagen
