// SPDX-License-Identifier: GPL-2.0-or-later
#include "mechanics/scheme.hpp"

#include "geometry/cayley.hpp"
#include "geometry/retraction.hpp"
#include "graph/calculus/differentiate.hpp"

#include <fmt/format.h>

namespace lagen {

namespace {

class SchemeBuilder {
  public:
    SchemeBuilder(Graph& graph, const System& system, const QuadratureRule& rule, NodeId step,
                  const Exponential* exponential)
        : graph_(graph), system_(system), groupoid_(*system.groupoid), rule_(rule), step_(step),
          exponential_(exponential), polynomials_(rule.degree), span_(graph, groupoid_),
          retraction_(graph, groupoid_, exponential)
    {
        if (exponential != nullptr) inner_ = exponential->s;
        for (std::size_t i = 0; i < groupoid_.horizontal(); ++i)
            chord_.push_back(graph.subtract(groupoid_.arrow.next[i], groupoid_.arrow.x[i]));
        for (const NodeId xi : logarithm()) chord_.push_back(xi);
        for (std::size_t k = 1; k < rule.degree; ++k)
            for (std::size_t a = 0; a < chord_.size(); ++a) {
                inside_.push_back(graph.input(fmt::format("inner {} {}", k, a + 1)));
                inner_.push_back(inside_.back());
            }
    }

    SchemeLagrangian build()
    {
        std::vector<NodeId> terms;
        for (std::size_t k = 0; k < rule_.nodes.size(); ++k) {
            const CurvePoint there = at(rule_.nodes[k]);
            const NodeId weight = graph_.constant(rule_.weights[k]);
            terms.push_back(
                graph_.multiply(weight, substitute(graph_, std::vector<NodeId>{*system_.lagrangian}, there.places)[0]));
            if (!system_.forces.empty()) add_work(there, graph_.multiply(step_, weight));
        }
        return {graph_.multiply(step_, graph_.sum(terms)), inner_, std::move(work_), bond()};
    }

  private:
    /// cay^-1(W) over the generators, or the unknowns xi.
    [[nodiscard]] std::vector<NodeId> logarithm()
    {
        const std::size_t n = groupoid_.size;
        if (n == 0) return {};
        if (exponential_ != nullptr) return exponential_->s;
        return span_.components(cayley_inverse(graph_, less_one(graph_, groupoid_.arrow.W, n), n));
    }

    [[nodiscard]] std::optional<ArrowLogarithm> bond()
    {
        if (exponential_ == nullptr) return {};
        return ArrowLogarithm{logarithm_conditions(graph_, groupoid_, *exponential_),
                              right_differential(graph_, groupoid_, *exponential_),
                              one_and(graph_, 1, exponential_->less_one, groupoid_.size)};
    }

    /// Along the sections at c, of the chord and its inner corrections.
    [[nodiscard]] std::vector<NodeId> curve(const Rational& c, bool slope)
    {
        std::vector<NodeId> out;
        for (std::size_t a = 0; a < chord_.size(); ++a) {
            std::vector<NodeId> terms{slope ? chord_[a] : graph_.multiply(graph_.constant(c), chord_[a])};
            for (std::size_t k = 1; k < rule_.degree; ++k) {
                const Rational factor = slope ? polynomials_.slope(k, c) : polynomials_.value(k, c);
                terms.push_back(graph_.multiply(graph_.constant(factor), inside_[(k - 1) * chord_.size() + a]));
            }
            out.push_back(graph_.sum(terms));
        }
        return out;
    }

    [[nodiscard]] std::span<const NodeId> vertical(const std::vector<NodeId>& along) const
    {
        return std::span(along).subspan(groupoid_.horizontal());
    }

    /// A point of the curve: x, W, and what stands there for x, y and t.
    struct CurvePoint {
        std::vector<NodeId> x, W;
        std::vector<std::pair<NodeId, NodeId>> places;
    };

    [[nodiscard]] std::vector<NodeId> element(const Rational& c, const std::vector<NodeId>& along)
    {
        if (c == 0) return matrix_one(graph_, groupoid_.size);
        if (c == 1) return groupoid_.arrow.W;
        return retraction_.element(vertical(along));
    }

    [[nodiscard]] std::vector<NodeId> point(const Rational& c, const std::vector<NodeId>& along,
                                            const std::vector<NodeId>& W)
    {
        const Arrow& g = groupoid_.arrow;
        std::vector<NodeId> x;
        if (groupoid_.action.empty()) {
            for (std::size_t i = 0; i < groupoid_.horizontal(); ++i)
                x.push_back(c == 1 ? g.next[i] : graph_.add(g.x[i], along[i]));
            return x;
        }
        return c == 0 ? g.x : target(graph_, groupoid_, {g.x, {}, W});
    }

    [[nodiscard]] CurvePoint at(const Rational& c)
    {
        const std::vector<NodeId> along = curve(c, false), slope = curve(c, true), W = element(c, along);
        const std::vector<NodeId> x = point(c, along, W);
        std::vector<NodeId> y = slope;
        const std::size_t horizontal = groupoid_.horizontal();
        if (rule_.degree > 1 && groupoid_.size > 0) {
            const std::vector<NodeId> body = retraction_.body_velocity(vertical(along), vertical(slope));
            std::copy(body.begin(), body.end(), y.begin() + static_cast<std::ptrdiff_t>(horizontal));
        }
        add_connection(x, y);
        std::vector<std::pair<NodeId, NodeId>> places = replacements(groupoid_.arrow.x, x);
        const NodeId per_step = graph_.divide(graph_.constant(1), step_);
        for (std::size_t a = 0; a < y.size(); ++a)
            places.emplace_back(system_.algebroid.y[a], graph_.multiply(y[a], per_step));
        places.emplace_back(system_.time, graph_.add(system_.time, graph_.multiply(graph_.constant(c), step_)));
        return {x, W, std::move(places)};
    }

    /// The derivatives of x and W along a field of seeds, as a variation in E: (dx, W^-1 (dW + S W) + A dx), where S
    /// moves the start of the curve.
    [[nodiscard]] std::vector<NodeId> variation(const CurvePoint& there,
                                                const std::vector<std::pair<NodeId, NodeId>>& seeds,
                                                const std::vector<NodeId>& S)
    {
        std::vector<NodeId> out;
        if (groupoid_.horizontal() > 0) out = directional(graph_, there.x, seeds);
        if (groupoid_.size > 0) {
            std::vector<NodeId> moved = directional(graph_, there.W, seeds);
            const std::vector<NodeId> start = S.empty() ? S : matrix_product(graph_, S, there.W, groupoid_.size);
            for (std::size_t k = 0; k < start.size(); ++k) moved[k] = graph_.add(moved[k], start[k]);
            const std::vector<NodeId> body = matrix_quotient(graph_, there.W, moved, groupoid_.size);
            for (const NodeId component : span_.components(body)) out.push_back(component);
        }
        add_connection(there.x, out);
        return out;
    }

    /// The element by which e_a moves the start: E_c, or -A_i^c E_c.
    [[nodiscard]] std::vector<NodeId> moved_start(std::size_t a)
    {
        if (groupoid_.size == 0) return {};
        std::vector<NodeId> components(system_.r(), graph_.constant(0));
        if (a >= groupoid_.horizontal())
            components[a] = graph_.constant(1);
        else if (!groupoid_.connection.empty())
            for (std::size_t c = 0; c < groupoid_.generators.size(); ++c)
                components[groupoid_.horizontal() + c] = graph_.negate(groupoid_.connection[a][c]);
        return span_.matrix(vertical(components));
    }

    /// weight Q(there) . variation, of the starts, the ends and the inner unknowns.
    void add_work(const CurvePoint& there, NodeId weight)
    {
        const std::vector<NodeId> Q = substitute(graph_, system_.forces, there.places);
        const std::vector<NodeId> coordinates = groupoid_.coordinates();
        const auto add = [&](std::vector<NodeId>& work, std::size_t place,
                             const std::vector<std::pair<NodeId, NodeId>>& seeds, const std::vector<NodeId>& S) {
            if (work.size() <= place) work.resize(place + 1, graph_.constant(0));
            const std::vector<NodeId> eta = variation(there, seeds, S);
            for (std::size_t a = 0; a < Q.size(); ++a)
                work[place] = graph_.add(work[place], graph_.multiply(weight, graph_.multiply(Q[a], eta[a])));
        };
        for (std::size_t a = 0; a < system_.r(); ++a) {
            std::vector<std::pair<NodeId, NodeId>> start, end;
            for (const ColumnEntry& entry : groupoid_.right[a])
                start.emplace_back(coordinates[entry.index], graph_.negate(entry.value));
            for (const ColumnEntry& entry : groupoid_.left[a]) end.emplace_back(coordinates[entry.index], entry.value);
            add(work_.source, a, start, moved_start(a));
            add(work_.target, a, end, {});
        }
        for (std::size_t k = 0; k < inner_.size(); ++k) add(work_.inner, k, {{inner_[k], graph_.constant(1)}}, {});
    }

    /// y^a += A_i^a(x) y^i
    void add_connection(const std::vector<NodeId>& x, std::vector<NodeId>& y)
    {
        if (groupoid_.connection.empty()) return;
        const std::vector<std::pair<NodeId, NodeId>> here = replacements(groupoid_.arrow.x, x);
        for (std::size_t i = 0; i < groupoid_.horizontal(); ++i) {
            const std::vector<NodeId> A = substitute(graph_, groupoid_.connection[i], here);
            for (std::size_t c = 0; c < A.size(); ++c) {
                NodeId& component = y[groupoid_.horizontal() + c];
                component = graph_.add(component, graph_.multiply(A[c], y[i]));
            }
        }
    }

    Graph& graph_;
    const System& system_;
    const Groupoid& groupoid_;
    const QuadratureRule& rule_;
    NodeId step_;
    const Exponential* exponential_;
    InnerPolynomials polynomials_;
    GeneratorSpan span_;
    Retraction retraction_;
    std::vector<NodeId> chord_;  ///< x_next - x, then tau^-1(W)
    std::vector<NodeId> inside_; ///< w of each point inside, along the sections
    std::vector<NodeId> inner_;  ///< xi of exp, and w
    DiscreteWork work_;
};

} // namespace

SchemeLagrangian scheme_lagrangian(Graph& graph, const System& system, const QuadratureRule& rule, NodeId step,
                                   const Exponential* exponential)
{
    return SchemeBuilder(graph, system, rule, step, exponential).build();
}

} // namespace lagen
