// SPDX-License-Identifier: GPL-2.0-or-later
#include "elaborate/build_distribution.hpp"

#include "elaborate/build_workspace.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/calculus/places.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

namespace {

/// Solves B Y = beta for the Y that are not kept.
class ConstraintSolver {
  public:
    ConstraintSolver(const Model& model, WrittenDistribution& result)
        : block_(model.algebroid), ambient_(block_.of[0].fibre), work_(model), graph_(work_.graph()), result_(result),
          m_(block_.constraints.size()), r_(ambient_.size())
    {
        std::vector<NodeId> Y;
        for (const Symbol& symbol : ambient_) Y.push_back(graph_.input(symbol.name));
        const std::vector<NodeId> zeros(r_, graph_.constant(0));
        for (const Tree& constraint : block_.constraints) {
            const NodeId Psi = work_.lower(constraint);
            const std::vector<NodeId> row = gradient(graph_, Psi, Y);
            B_.insert(B_.end(), row.begin(), row.end());
            const NodeId only[] = {Psi};
            beta_.push_back(graph_.negate(substitute(graph_, only, replacements(Y, zeros))[0]));
        }
        for (std::size_t a = 0; a < r_; ++a)
            if (std::ranges::find(block_.kept, a) == block_.kept.end()) solved_.push_back(a);
        if (m_ > determinant_limit)
            throw ModelError(
                fmt::format("the constraints are {}, more than the {} that are solved for", m_, determinant_limit),
                block_.constraints[0]->where, "give sections that span what the constraints leave");
    }

    void solve()
    {
        for (std::size_t alpha = 0; alpha < block_.kept.size(); ++alpha)
            result_.sections.push_back({alpha, block_.kept[alpha], number(1, block_.where)});
        const NodeId minor = minor_of(solved_);
        if (vanishes(minor)) {
            refuse_fixed();
            result_.has_dependent = true;
            return;
        }
        result_.minor = work_.readable(minor);
        std::vector<std::vector<NodeId>> right;
        for (const std::size_t a : block_.kept) {
            std::vector<NodeId>& column = right.emplace_back();
            for (std::size_t A = 0; A < m_; ++A) column.push_back(graph_.negate(B_[A * r_ + a]));
        }
        right.push_back(beta_);
        const std::vector<std::vector<NodeId>> z = solve_exactly(graph_, columns(solved_), m_, right);
        for (std::size_t alpha = 0; alpha < right.size(); ++alpha)
            for (std::size_t j = 0; j < m_; ++j) {
                Tree value = work_.readable(z[alpha][j]);
                if (value == nullptr) continue;
                const bool is_drift = alpha == block_.kept.size();
                auto& list = is_drift ? result_.drift : result_.sections;
                list.push_back({is_drift ? 0 : alpha, solved_[j], std::move(value)});
            }
    }

  private:
    /// The m x m entries of these columns of B, by rows.
    [[nodiscard]] std::vector<NodeId> columns(const std::vector<std::size_t>& places) const
    {
        std::vector<NodeId> entries;
        for (std::size_t A = 0; A < m_; ++A)
            for (const std::size_t a : places) entries.push_back(B_[A * r_ + a]);
        return entries;
    }

    [[nodiscard]] NodeId minor_of(const std::vector<std::size_t>& places)
    {
        return determinant_of(graph_, columns(places), m_, first_places(m_), first_places(m_));
    }

    [[nodiscard]] bool vanishes(NodeId node) { return graph_.is_zero(node) || work_.readable(node) == nullptr; }

    /// A kept Y that could be solved for in place of another one is fixed by the constraints.
    void refuse_fixed()
    {
        for (const std::size_t kept : block_.kept)
            for (std::size_t j = 0; j < m_; ++j) {
                std::vector<std::size_t> exchanged = solved_;
                exchanged[j] = kept;
                if (vanishes(minor_of(exchanged))) continue;
                throw ModelError(fmt::format("[fibre] keeps '{}', which the constraints fix once the others are kept",
                                             ambient_[kept].name),
                                 block_.constraints[0]->where,
                                 fmt::format("keep '{}' in its place", ambient_[solved_[j]].name));
            }
    }

    const AlgebroidBlock& block_;
    const std::vector<Symbol>& ambient_;
    BuildWorkspace work_;
    Graph& graph_;
    WrittenDistribution& result_;
    std::size_t m_, r_;
    std::vector<NodeId> B_; ///< B^A_a, by rows
    std::vector<NodeId> beta_;
    std::vector<std::size_t> solved_; ///< the Y that are not kept
};

Section section_of(std::vector<ColumnEntry> entries)
{
    std::ranges::sort(entries, {}, &ColumnEntry::index);
    return entries;
}

} // namespace

WrittenDistribution build_distribution(const Model& model)
{
    const AlgebroidBlock& block = model.algebroid;
    WrittenDistribution result;
    result.y = model.fibre.coordinates;
    result.constraints = block.constraints;
    result.is_solved = block.sections.empty();
    if (result.is_solved) {
        ConstraintSolver(model, result).solve();
        return result;
    }
    for (const SectionEntry& entry : block.sections)
        result.sections.push_back({entry.section, entry.inner, entry.value});
    for (const SectionEntry& entry : block.drift) result.drift.push_back({0, entry.inner, entry.value});
    return result;
}

Distribution lower_distribution(Graph& graph, Lowering& lower, const WrittenDistribution& written)
{
    Distribution result;
    for (const Symbol& symbol : written.y) result.y.push_back(graph.input(symbol.name));
    std::vector<std::vector<ColumnEntry>> sections(written.y.size());
    const auto append = [&](std::vector<ColumnEntry>& section, const SectionValue& entry) {
        const NodeId value = lower(entry.value);
        if (!graph.is_zero(value)) section.push_back({entry.a, value});
    };
    for (const SectionValue& entry : written.sections) append(sections[entry.alpha], entry);
    for (std::vector<ColumnEntry>& section : sections) result.sections.push_back(section_of(std::move(section)));
    std::vector<ColumnEntry> drift;
    for (const SectionValue& entry : written.drift) append(drift, entry);
    result.drift = section_of(std::move(drift));
    for (const Tree& constraint : written.constraints) {
        result.constraints.push_back(lower(constraint));
        result.constraint_texts.push_back(to_text(constraint));
    }
    if (written.minor) result.minor = lower(written.minor);
    result.is_solved = written.is_solved;
    result.has_dependent = written.has_dependent;
    return result;
}

} // namespace lagen
