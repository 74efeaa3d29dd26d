// SPDX-License-Identifier: GPL-2.0-or-later
#include "elaborate/lower_forms.hpp"

#include "proof/partial_parts.hpp"

namespace lagen {

namespace {

class FormLowering {
  public:
    FormLowering(System& system, Lowering& lower)
        : graph_(system.graph), algebroid_(system.algebroid), lower_(lower), partial_(system.graph, system.algebroid.x)
    {
    }

    std::vector<FormClaim> run(const std::vector<NamedForm>& forms)
    {
        std::vector<FormClaim> claims;
        for (const NamedForm& named : forms) {
            FormClaim& claim = claims.emplace_back();
            claim.name = named.name;
            claim.closed = named.closed;
            claim.form = value_of(named, claim.partial_parts);
        }
        for (std::size_t k = 0; k < forms.size(); ++k)
            if (forms[k].equals) claims[k].equals = value_of(*forms[k].equals, claims, claims[k].equals_parts);
        return claims;
    }

  private:
    /// Each component is given once.
    ExteriorForm value_of(const NamedForm& named, std::vector<NodeId>& parts)
    {
        ExteriorForm form{named.degree, {}};
        for (const FormComponent& component : named.components) {
            ExteriorForm term = function_form(lower_(component.value));
            for (const std::size_t a : component.indices) term = wedge(graph_, term, basis_form(graph_, a));
            for (const auto& [index, value] : term.components)
                if (!graph_.is_zero(value)) form.components.emplace(index, value);
            const std::vector<NodeId> more = partial_parts(graph_, lower_, component.value);
            parts.insert(parts.end(), more.begin(), more.end());
        }
        return form;
    }

    /// `used`: what must be defined where the expression is.
    ExteriorForm value_of(const FormExpression& expression, const std::vector<FormClaim>& claims,
                          std::vector<NodeId>& used)
    {
        std::vector<ExteriorForm> parts;
        for (const FormExpression& part : expression.parts) parts.push_back(value_of(part, claims, used));
        switch (expression.kind) {
        case FormExpression::Kind::form: {
            const FormClaim& named = claims[expression.form];
            for (const auto& [index, value] : named.form.components)
                if (!graph_.is_constant(value)) used.push_back(value);
            used.insert(used.end(), named.partial_parts.begin(), named.partial_parts.end());
            return named.form;
        }
        case FormExpression::Kind::function: return function_form(lowered(expression.function, used));
        case FormExpression::Kind::negative: return product(graph_, graph_.constant(-1), parts[0]);
        case FormExpression::Kind::differential: return differential(partial_, algebroid_, parts[0]);
        case FormExpression::Kind::contraction: return contraction(graph_, section_of(expression, used), parts[0]);
        case FormExpression::Kind::sum:
        case FormExpression::Kind::wedge: break;
        }
        ExteriorForm result = parts[0];
        for (std::size_t k = 1; k < parts.size(); ++k)
            result = expression.kind == FormExpression::Kind::sum ? sum(graph_, result, parts[k])
                                                                  : wedge(graph_, result, parts[k]);
        return result;
    }

    NodeId lowered(const Tree& function, std::vector<NodeId>& used)
    {
        const std::vector<NodeId> parts = partial_parts(graph_, lower_, function);
        used.insert(used.end(), parts.begin(), parts.end());
        const NodeId node = lower_(function);
        if (!graph_.is_constant(node)) used.push_back(node);
        return node;
    }

    Section section_of(const FormExpression& expression, std::vector<NodeId>& used)
    {
        Section section;
        for (std::size_t a = 0; a < expression.section.size(); ++a)
            if (const NodeId value = lowered(expression.section[a], used); !graph_.is_zero(value))
                section.push_back({a, value});
        return section;
    }

    Graph& graph_;
    const Algebroid& algebroid_;
    Lowering& lower_;
    BaseGradient partial_;
};

} // namespace

std::vector<FormClaim> lower_forms(System& system, Lowering& lower, const std::vector<NamedForm>& forms)
{
    return FormLowering(system, lower).run(forms);
}

} // namespace lagen
