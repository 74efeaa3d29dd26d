// SPDX-License-Identifier: GPL-2.0-or-later
/// Discrete Lagrangian mechanics for a person: the target of an arrow g, the momenta F^-L(g) at its source and F^+L(g)
/// at its target, and the discrete Euler-Lagrange equations F^+L(g) = F^-L(h) of two arrows with t(g) = s(h).
#include "equations/derivations.hpp"

#include "equations/given_blocks.hpp"
#include "equations/symbolic_model.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/core/lower.hpp"
#include "mechanics/discrete.hpp"
#include "model/families.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {
namespace {

/// The discrete Euler-Lagrange equations as they are known for each kind.
struct KindFormula {
    GroupoidKind kind;
    const char* text;
    const char* latex;
};

constexpr KindFormula kind_formulas[] = {
    {GroupoidKind::pair, "D₂L(x, y) + D₁L(y, z) = 0", R"(D_2 L(x, y) + D_1 L(y, z) = 0)"},
    {GroupoidKind::group, "μ_{k+1} = Ad*_{g_k} μ_k,  μ_k = F⁻L(g_k)",
     R"(\mu_{k+1} = \mathrm{Ad}^*_{g_k} \mu_k,\quad \mu_k = F^-L(g_k))"},
    {GroupoidKind::action, "μ_{k+1} = Ad*_{h_k} μ_k + d(L_{h_{k+1}} ∘ x_{k+1}·)(e),  μ_k = d(L_{x_k} ∘ r_{h_k})(e)",
     R"(\mu_{k+1} = \mathrm{Ad}^*_{h_k} \mu_k + d(L_{h_{k+1}} \circ x_{k+1}\cdot)(e),\quad \mu_k = d(L_{x_k} \circ r_{h_k})(e))"},
    {GroupoidKind::atiyah, "D₂L(x, y, h_k) + D₁L(y, z, h_{k+1}) = 0,  μ_{k+1} = Ad*_{h_k} μ_k",
     R"(D_2 L(x, y, h_k) + D_1 L(y, z, h_{k+1}) = 0,\quad \mu_{k+1} = \mathrm{Ad}^*_{h_k} \mu_k)"},
};

class DiscreteDerivation {
  public:
    DiscreteDerivation(const Model& model, const System& system)
        : model_(model), graph_(system.graph), groupoid_(*system.groupoid),
          symbolic_(model, system.written.algebroid, {model.discrete->lagrangian}),
          legendre_(discrete_legendre(graph_, groupoid_, *system.discrete->lagrangian))
    {
        add_arrow_names(symbolic_, graph_, {groupoid_.arrow, second_arrow()});
    }

    EquationSet run()
    {
        EquationSet set = symbolic_.empty_set("discrete");
        set.given = given_blocks({lagrangian_block(symbolic_, symbolic_.lower(model_.discrete->lagrangian), "g")},
                                 constraints_and_invariants(symbolic_));
        if (!groupoid_.action.empty()) set.blocks.push_back(targets());
        set.blocks.push_back(momenta("momenta at the source", "F⁻L_a = →e_a(L)", R"(F^-L_a = \overrightarrow{e_a}(L))",
                                     legendre_.minus, false));
        set.blocks.push_back(momenta("momenta at the target", "F⁺L_a = ←e_a(L)", R"(F^+L_a = \overleftarrow{e_a}(L))",
                                     legendre_.plus, true));
        set.blocks.push_back(equations());
        return set;
    }

  private:
    [[nodiscard]] GiNaC::ex value(NodeId node)
    {
        return symbolic_.lower(to_tree(graph_, on_group(graph_, groupoid_, {groupoid_.arrow, second_arrow()}, node)));
    }

    /// x_next = x.W
    [[nodiscard]] EquationBlock targets()
    {
        EquationBlock block{"target", "t(g) = x.W", R"(t(g) = x \cdot W)", {}};
        for (std::size_t i = 0; i < groupoid_.n(); ++i)
            block.equations.push_back(symbolic_.equation(LeftSide::symbol, next_name(model_.base.coordinates[i].name),
                                                         {value(groupoid_.action[i])}));
        return block;
    }

    [[nodiscard]] EquationBlock momenta(const char* title, const char* formula, const char* latex,
                                        const std::vector<NodeId>& values, bool behind)
    {
        EquationBlock block{title, formula, latex, {}};
        for (std::size_t a = 0; a < values.size(); ++a)
            block.equations.push_back(symbolic_.equation(
                LeftSide::symbol, behind ? next_name(symbolic_.momentum_name(a)) : symbolic_.momentum_name(a),
                {value(values[a])}));
        return block;
    }

    /// h with s(h) = t(g): its own coordinates are new ones.
    [[nodiscard]] Arrow second_arrow()
    {
        const auto behind = [&](const std::vector<NodeId>& inputs) {
            std::vector<NodeId> out;
            for (const NodeId input : inputs) out.push_back(graph_.input(next_name(graph_.input_name(input))));
            return out;
        };
        return {target(graph_, groupoid_, groupoid_.arrow), behind(groupoid_.arrow.next), behind(groupoid_.arrow.W)};
    }

    [[nodiscard]] EquationBlock equations()
    {
        const Arrow h = second_arrow();
        const std::vector<NodeId> behind = at(graph_, groupoid_, legendre_.minus, h);
        const auto* row =
            std::ranges::find(kind_formulas, model_.groupoid->kind, [](const KindFormula& each) { return each.kind; });
        EquationBlock block{"discrete Euler-Lagrange equations",
                            fmt::format("F⁺L(g) - F⁻L(h) = 0,  t(g) = s(h);  {}", row->text),
                            fmt::format(R"(F^+L(g) - F^-L(h) = 0,\quad t(g) = s(h);\quad {})", row->latex),
                            {}};
        for (std::size_t a = 0; a < behind.size(); ++a)
            block.equations.push_back(
                {LeftSide::zero,
                 symbolic_.momentum_name(a),
                 {},
                 symbolic_.simplified({{"F⁺L(g)", value(legendre_.plus[a])}, {"-F⁻L(h)", -value(behind[a])}})});
        return block;
    }

    const Model& model_;
    Graph graph_;
    const Groupoid& groupoid_;
    SymbolicModel symbolic_;
    DiscreteLegendre legendre_;
};

} // namespace

void require_written_discrete(const System& system)
{
    if (!system.discrete || !system.discrete->written)
        throw MathematicsError(system.discrete ? "the discrete Lagrangian of the model is made by a scheme: there is "
                                                 "none that is written out"
                                               : "the model has no [discrete]",
                               system.discrete
                                   ? "--form lagrange derives the equations of the L that it is made of; or "
                                     "write it out, [discrete] L = \"..\" over x, x_next and the element"
                                   : "[discrete] L = \"..\" over x, x_next and the element");
}

NodeId on_group(Graph& graph, const Groupoid& groupoid, std::initializer_list<Arrow> arrows, NodeId node)
{
    Replacements constant;
    for (const Arrow& arrow : arrows)
        for (const auto& entry : constant_entries(graph, groupoid, arrow.W)) constant.push_back(entry);
    const auto shown = substitute_where_defined(graph, std::vector{node}, constant);
    return shown ? shown->front() : node;
}

void add_arrow_names(SymbolicModel& symbolic, const Graph& graph, std::initializer_list<Arrow> arrows)
{
    for (const Arrow& arrow : arrows)
        for (const auto* nodes : {&arrow.next, &arrow.W})
            for (const NodeId node : *nodes)
                if (graph.op(node) == Op::input) symbolic.add_variable(graph.input_name(node));
    const std::string& step = symbolic.model().discrete->step.name;
    if (const std::vector<std::string> names = symbol_names(symbolic.model()); // a parameter, or a symbol of its own
        std::ranges::find(names, step) == names.end())
        symbolic.add_variable(step);
}

EquationSet derive_discrete(const Model& model, const System& system)
{
    require_written_discrete(system);
    return derived(model, "the discrete equations", [&] { return DiscreteDerivation(model, system).run(); });
}

} // namespace lagen
