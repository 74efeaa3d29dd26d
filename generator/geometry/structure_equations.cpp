// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry/structure_equations.hpp"

#include "geometry/form.hpp"

#include <algorithm>

namespace lagen {
namespace {

class Equations {
  public:
    Equations(BaseGradient& partial, const Algebroid& algebroid)
        : graph_(partial.graph()), algebroid_(algebroid), d_(partial, algebroid), r_(algebroid.r())
    {
    }

    void append_antisymmetry()
    {
        for (std::size_t a = 0; a < r_; ++a)
            for (std::size_t b = a; b < r_; ++b) {
                if (!algebroid_.given[a * r_ + b] || !algebroid_.given[b * r_ + a]) continue;
                const Column both = sum(graph_, algebroid_.C(a, b), algebroid_.C(b, a));
                list_.trivial += r_ - both.size();
                for (const ColumnEntry& entry : both)
                    list_.residuals.push_back({"antisymmetry", {a, b, entry.index}, entry.value});
            }
    }

    /// (d d x^i)_ab, sorted by a, b, i
    void append_anchor()
    {
        std::vector<ExteriorForm> dd;
        for (const NodeId x : algebroid_.x) dd.push_back(d_(d_(function_form(x))));
        append("anchor", dd, r_ * (r_ - std::min<std::size_t>(r_, 1)) / 2, false);
    }

    /// -(d d e^v)_abc, sorted by a, b, c, v
    void append_jacobi()
    {
        std::vector<ExteriorForm> dd;
        for (std::size_t v = 0; v < r_; ++v) dd.push_back(d_(d_(basis_form(graph_, v))));
        append("jacobi", dd, r_ < 3 ? 0 : r_ * (r_ - 1) * (r_ - 2) / 6, true);
    }

    /// (d f)_a, sorted by f, a
    void append_differentials(const char* name, const std::vector<NodeId>& functions)
    {
        for (std::size_t k = 0; k < functions.size(); ++k) {
            const ExteriorForm df = d_(function_form(functions[k]));
            list_.trivial += r_ - df.components.size();
            for (const auto& [index, value] : df.components) list_.residuals.push_back({name, {index[0], k}, value});
        }
    }

    [[nodiscard]] ResidualList take() { return std::move(list_); }

  private:
    /// Components of forms[k] as residuals (index, k); `count` components has each form at most.
    void append(const char* name, const std::vector<ExteriorForm>& forms, std::size_t count, bool negative)
    {
        std::vector<Residual> residuals;
        for (std::size_t k = 0; k < forms.size(); ++k)
            for (const auto& [index, value] : forms[k].components) {
                residuals.push_back({name, index, negative ? graph_.negate(value) : value});
                residuals.back().indices.push_back(k);
            }
        list_.trivial += count * forms.size() - residuals.size();
        std::ranges::sort(residuals, {}, &Residual::indices);
        list_.residuals.insert(list_.residuals.end(), residuals.begin(), residuals.end());
    }

    Graph& graph_;
    const Algebroid& algebroid_;
    Differential d_;
    std::size_t r_;
    ResidualList list_;
};

} // namespace

ResidualList structure_equations(BaseGradient& partial, const Algebroid& algebroid, const BaseFunctions& functions)
{
    Equations equations(partial, algebroid);
    equations.append_antisymmetry();
    equations.append_anchor();
    equations.append_jacobi();
    equations.append_differentials("tangency", functions.constraints);
    equations.append_differentials("casimir", functions.casimirs);
    return equations.take();
}

Column anchor_defect(BaseGradient& partial, const Algebroid& algebroid, std::size_t a, std::size_t b)
{
    return difference(partial.graph(), bracket(partial, algebroid.anchor[a], algebroid.anchor[b]),
                      anchor_of(partial.graph(), algebroid, algebroid.C(a, b)));
}

Column jacobiator(BaseGradient& partial, const Algebroid& algebroid, std::size_t a, std::size_t b, std::size_t c)
{
    Graph& graph = partial.graph();
    const auto nested = [&](std::size_t outer, std::size_t p, std::size_t q) {
        return bracket(partial, algebroid, basis_section(graph, outer), algebroid.C(p, q));
    };
    return sum(graph, sum(graph, nested(a, b, c), nested(b, c, a)), nested(c, a, b));
}

} // namespace lagen
