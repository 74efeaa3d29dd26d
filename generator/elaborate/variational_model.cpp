// SPDX-License-Identifier: GPL-2.0-or-later
#include "elaborate/variational_model.hpp"

#include "elaborate/build_algebroid.hpp"
#include "geometry/named_algebra.hpp"
#include "graph/calculus/differentiate.hpp"
#include "model/families.hpp"
#include "model/scene_form.hpp"
#include "proof/rational_matrix.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace lagen {

namespace {

using Matrix = std::vector<Rational>; ///< by rows

[[noreturn]] void refuse(const Model& model, const std::string& why)
{
    throw MathematicsError(fmt::format("model '{}' has no groupoid, and none is made for it: {}", model.name, why),
                           "a [groupoid] beside the [algebroid] says which one is meant");
}

/// Matrices E_c of a group with the algebra of the model, and its right action on x.
class GroupBuilder {
  public:
    explicit GroupBuilder(const Model& model)
        : model_(model), n_(model.base.coordinates.size()), written_(build_algebroid(model)), lower_(graph_)
    {
        algebroid_ = lower_algebroid(graph_, lower_, written_);
    }

    /// Of the sections from `first` on.
    [[nodiscard]] std::vector<ArrayValue> generators(std::size_t first)
    {
        const std::size_t r = algebroid_.r() - first;
        std::vector<Matrix> moving = first == 0 ? anchor_matrices() : std::vector<Matrix>(r);
        const std::size_t m = moved_;
        if (independent(moving)) return as_arrays(moving, m);
        const std::vector<Matrix> own = algebra_matrices(first);
        const std::size_t k = side_of(own[0].size());
        std::vector<Matrix> joined;
        for (std::size_t c = 0; c < r; ++c) {
            Matrix& E = joined.emplace_back((m + k) * (m + k));
            for (std::size_t i = 0; i < m; ++i)
                for (std::size_t j = 0; j < m; ++j) E[i * (m + k) + j] = moving[c][i * m + j];
            for (std::size_t i = 0; i < k; ++i)
                for (std::size_t j = 0; j < k; ++j) E[(m + i) * (m + k) + m + j] = own[c][i * k + j];
        }
        return as_arrays(joined, m + k);
    }

    /// (W^-1 (x, 1))^i with the rows and columns of W that act on x; W by rows.
    [[nodiscard]] std::vector<Tree> action(const std::vector<Symbol>& W) const
    {
        const std::size_t m = moved_;
        const std::size_t size = side_of(W.size());
        const auto entry = [&](std::size_t i, std::size_t j) { return name(W[i * size + j].name, W[0].where); };
        const auto x = [&](std::size_t i) {
            return i < n_ ? name(model_.base.coordinates[i].name, W[0].where) : number(1, W[0].where);
        };
        std::vector<Tree> out;
        if (skew_) {
            for (std::size_t i = 0; i < n_; ++i) {
                std::vector<Tree> terms;
                for (std::size_t j = 0; j < m; ++j) terms.push_back(multiply({entry(j, i), x(j)}));
                out.push_back(add(std::move(terms)));
            }
            return out;
        }
        std::vector<Tree> matrix, right;
        for (std::size_t i = 0; i < m; ++i)
            for (std::size_t j = 0; j < m; ++j) matrix.push_back(entry(i, j));
        for (std::size_t i = 0; i < m; ++i) right.push_back(x(i));
        for (std::size_t i = 0; i < n_; ++i) out.push_back(solve_component(matrix, right, i));
        return out;
    }

  private:
    /// Rows of a square matrix with so many entries.
    [[nodiscard]] static std::size_t side_of(std::size_t entries)
    {
        std::size_t m = 0;
        while (m * m < entries) ++m;
        return m;
    }

    [[nodiscard]] Rational constant(NodeId node, const char* what) const
    {
        if (!graph_.is_constant(node))
            refuse(model_, fmt::format("{} is no number: {}", what, to_text(graph_, node, 60)));
        return graph_.value(node);
    }

    /// A_a, or [[A_a, b_a], [0, 0]] where some b_a is not 0.
    [[nodiscard]] std::vector<Matrix> anchor_matrices()
    {
        const std::vector<NodeId>& x = algebroid_.x;
        const std::vector<NodeId> zeros(n_, graph_.constant(0));
        std::vector<Matrix> A, b;
        bool affine = false;
        for (const Column& column : algebroid_.anchor) {
            Matrix& linear = A.emplace_back(n_ * n_);
            Matrix& rest = b.emplace_back(n_);
            for (const ColumnEntry& entry : column) {
                const std::vector<NodeId> row = gradient(graph_, entry.value, x);
                for (std::size_t j = 0; j < n_; ++j)
                    linear[entry.index * n_ + j] = -constant(row[j], "a derivative of its anchor");
                const auto at_zero = substitute_where_defined(graph_, {&entry.value, 1}, origin(zeros));
                rest[entry.index] = -constant(at_zero ? (*at_zero)[0] : entry.value, "its anchor at 0");
                affine = affine || rest[entry.index] != 0;
            }
        }
        const std::size_t m = n_ + (affine ? 1 : 0);
        std::vector<Matrix> out;
        for (std::size_t c = 0; c < A.size(); ++c) {
            Matrix& E = out.emplace_back(m * m);
            for (std::size_t i = 0; i < n_; ++i) {
                for (std::size_t j = 0; j < n_; ++j) E[i * m + j] = A[c][i * n_ + j];
                if (affine) E[i * m + n_] = b[c][i];
            }
            for (std::size_t i = 0; i < m; ++i)
                for (std::size_t j = 0; j < m; ++j) skew_ = skew_ && E[i * m + j] == -E[j * m + i];
        }
        moved_ = m;
        return out;
    }
    [[nodiscard]] std::vector<std::pair<NodeId, NodeId>> origin(const std::vector<NodeId>& zeros) const
    {
        std::vector<std::pair<NodeId, NodeId>> out;
        for (std::size_t i = 0; i < n_; ++i) out.emplace_back(algebroid_.x[i], zeros[i]);
        return out;
    }

    /// The basis of a named algebra, else ad: (ad_a)_cb = C^c_ab.
    [[nodiscard]] std::vector<Matrix> algebra_matrices(std::size_t first) const
    {
        std::vector<Matrix> out;
        if (!model_.algebroid.algebra.empty()) {
            const NamedAlgebra algebra = *named_algebra(model_.algebroid.algebra);
            for (const SparseMatrix& E : algebra.basis) out.push_back(dense(E, algebra.size));
            return out;
        }
        const std::size_t r = algebroid_.r() - first;
        for (std::size_t a = 0; a < r; ++a) {
            Matrix& ad = out.emplace_back(r * r);
            for (std::size_t b = 0; b < r; ++b)
                for (const ColumnEntry& entry : algebroid_.C(first + a, first + b))
                    ad[(entry.index - first) * r + b] = constant(entry.value, "a component of its bracket");
        }
        if (!independent(out))
            refuse(model_, "its algebra has a centre, and no name that says which matrices are meant");
        return out;
    }

    /// By Gram's matrix.
    [[nodiscard]] static bool independent(const std::vector<Matrix>& matrices)
    {
        const std::size_t r = matrices.size();
        Matrix gram(r * r);
        for (std::size_t a = 0; a < r; ++a)
            for (std::size_t b = 0; b < r; ++b)
                for (std::size_t k = 0; k < matrices[a].size(); ++k) gram[a * r + b] += matrices[a][k] * matrices[b][k];
        return r > 0 && rank_of(std::move(gram), r) == r;
    }

    [[nodiscard]] std::vector<ArrayValue> as_arrays(const std::vector<Matrix>& matrices, std::size_t m) const
    {
        std::vector<ArrayValue> out;
        for (const Matrix& matrix : matrices) {
            ArrayValue& array = out.emplace_back(ArrayValue{{Rank::matrix, m, m}, {}});
            for (const Rational& entry : matrix) array.entries.push_back(number(entry, model_.algebroid.where));
        }
        return out;
    }

    const Model& model_;
    std::size_t n_;
    WrittenAlgebroid written_;
    Graph graph_;
    Lowering lower_;
    Algebroid algebroid_;
    std::size_t moved_ = 0; ///< rows of W that act on (x, 1)
    bool skew_ = true;
};

/// A name that the model does not have.
std::string free_name(const Model& model, std::string wanted)
{
    std::set<std::string> taken;
    for (const std::string& each : symbol_names(model)) taken.insert(family_name(each));
    for (const Symbol& each : model.fibre.momenta) taken.insert(family_name(each.name));
    for (const Definition& each : model.definitions) taken.insert(each.name);
    for (const NamedTree& each : model.observables) taken.insert(each.name);
    while (taken.contains(wanted)) wanted += '_';
    return wanted;
}

void declare_element(Model& model)
{
    GroupoidBlock& block = *model.groupoid;
    const Shape shape = block.generators[0].shape;
    const std::string W = free_name(model, "W");
    for (std::size_t k = 0; k < shape.size(); ++k)
        block.element.push_back(Symbol{entry_name(W, shape, k), block.where, {}, {}, {}});
    model.families.push_back({W, Role::element, shape, 0, block.where});
}

void declare_next(Model& model)
{
    GroupoidBlock& block = *model.groupoid;
    for (const Symbol& each : model.base.coordinates)
        block.next.push_back(Symbol{next_name(each.name), each.where, {}, {}, {}});
    const std::vector<Family> families = model.families;
    for (const Family& each : families)
        if (each.role == Role::base)
            model.families.push_back({next_name(each.name), Role::next, each.shape, each.first, each.where});
    for (const Symbol& each : block.next)
        if (free_name(model, each.name) != each.name)
            refuse(model,
                   fmt::format("'{}' would be a coordinate of its arrows, and is a name of the model", each.name));
}

void give_groupoid(Model& model)
{
    const AlgebroidBlock& algebroid = model.algebroid;
    GroupoidBlock& block = model.groupoid.emplace();
    block.where = algebroid.where;
    switch (algebroid.kind) {
    case AlgebroidKind::tangent:
        if (algebroid.over.size() != model.base.coordinates.size() || !std::ranges::is_sorted(algebroid.over))
            refuse(model, "some of its base coordinates do not move, or in another order");
        return declare_next(model);
    case AlgebroidKind::lie_algebra:
    case AlgebroidKind::action:
        block.kind = model.base.coordinates.empty() ? GroupoidKind::group : GroupoidKind::action;
        break;
    case AlgebroidKind::atiyah: block.kind = GroupoidKind::atiyah; break;
    default: refuse(model, "its algebroid is neither a tangent bundle, a Lie algebra, an action nor one of Atiyah");
    }
    GroupBuilder group(model);
    block.generators = group.generators(block.has_targets() ? model.base.coordinates.size() : 0);
    declare_element(model);
    if (block.has_targets()) declare_next(model);
    if (block.kind == GroupoidKind::action) block.action = group.action(block.element);
}

} // namespace

Model variational_model(Model model, const std::string& scheme, const std::string& method)
{
    if (!model.lagrangian)
        throw MathematicsError(
            fmt::format("model '{}' has no [lagrangian], of which a discrete one could be made", model.name));
    if (!model.groupoid) give_groupoid(model);
    DiscreteBlock block;
    block.step =
        model.discrete ? model.discrete->step : Symbol{free_name(model, "h"), model.lagrangian_where, {}, {}, {}};
    block.scheme = scheme;
    block.where = block.scheme_where = model.lagrangian_where;
    model.discrete = std::move(block);
    for (Scene& scene : model.scenes) { // the same motions, in steps, with a row each where the scene counts rows
        if (is_form(scene.form, FormKind::lagrange)) scene.form.clear();
        scene.stepped_by = method;
        if (scene.sampling.kind == Sampling::Kind::count) scene.sampling = {};
    }
    return model;
}

} // namespace lagen
