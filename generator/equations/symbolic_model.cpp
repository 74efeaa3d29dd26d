// SPDX-License-Identifier: GPL-2.0-or-later
#include "equations/symbolic_model.hpp"

#include "expression/rewrite.hpp"
#include "text/activity.hpp"
#include "typeset/latex_names.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace lagen {
namespace {

bool is_zero(const Tree& tree)
{
    return tree->kind == TreeKind::number && tree->number == 0;
}

/// An expansion keeps the place of the definition: what the user wrote out a second time stands elsewhere.
bool is_expansion(const Tree& tree, const Tree& value)
{
    const SourceRange& here = tree->where;
    const SourceRange& there = value->where;
    return there.file != nullptr && here.file == there.file && here.begin == there.begin && here.end == there.end &&
           same_tree(tree, value);
}

/// `tree` with every expansion of a Casimir that was written by its name replaced by that name: the labels of leaves
/// are constants of the motion, and equations read better with them.
Tree label_casimirs(const Tree& tree, const std::vector<NamedTree>& casimirs)
{
    return rewrite(tree, [&](const Tree& node) {
        Tree label;
        for (const NamedTree& casimir : casimirs)
            if (is_expansion(node, casimir.value)) label = name(casimir.name, node->where);
        return label;
    });
}

} // namespace

void append_right_side(EquationBlock& block, const std::vector<FormulaTerm>& terms)
{
    const auto occurs = [&](const std::string& label) { // groups with like terms are one, "ρ_a(L) - p_c C^c_ab y^b"
        const std::string unsigned_label = label.substr(label.starts_with('-') ? 1 : 0);
        return std::ranges::any_of(block.equations, [&](const Equation& equation) {
            return std::ranges::any_of(equation.groups, [&](const TermGroup& group) {
                return group.label.find(unsigned_label) != std::string::npos;
            });
        });
    };
    const auto append = [](std::string& formula, const std::string& term, bool first) {
        const bool negative = term.starts_with('-');
        formula += first ? " = " + term : (negative ? " - " : " + ") + term.substr(negative ? 1 : 0);
    };
    bool first = true;
    for (const FormulaTerm& term : terms) {
        if (!occurs(term.label)) continue;
        append(block.formula, term.label, first);
        append(block.latex_formula, term.latex, first);
        first = false;
    }
    if (!first) return;
    append(block.formula, "0", true);
    append(block.latex_formula, "0", true);
}

GiNaC::ex total(const Sum& terms)
{
    return GiNaC::ex(GiNaC::dynallocate<GiNaC::add>(terms));
}

std::set<std::string> name_set(const std::vector<Symbol>& symbols)
{
    std::set<std::string> names;
    for (const Symbol& symbol : symbols) names.insert(symbol.name);
    return names;
}

SymbolicModel::SymbolicModel(const Model& model, const WrittenAlgebroid& algebroid, const std::vector<Tree>& functions,
                             const DefinitionChoice& choice, const std::set<std::string>& substituted)
    : model_(model), algebroid_(algebroid), longest_(choice.longest),
      kept_(std::make_unique<KeptSymbols>(
          model, DefinitionChoice{}, substituted, [](const Tree& tree) { return tree; }, symbols_, order_))
{
    for (const Parameter& parameter : model.parameters) order_.parameters.push_back(parameter.symbol.name);
    for (const NamedTree& casimir : model.base.casimirs)
        if (!is_declared(casimir.name)) order_.parameters.push_back(casimir.name);
    if (!is_declared("t")) {
        order_.variables.emplace_back("t");
        time_ = symbols_.symbol("t");
    }
    for (const Symbol& symbol : algebroid.base) x_.push_back(variable(symbol.name));
    for (const Symbol& symbol : algebroid.fibre) y_.push_back(variable(symbol.name));
    if (is_nonholonomic(model))
        for (const Symbol& symbol : model.fibre.coordinates)
            if (std::ranges::find(algebroid.fibre, symbol.name, &Symbol::name) == algebroid.fibre.end())
                add_variable(symbol.name);
    for (const Symbol& symbol : model.fibre.momenta) mu_.push_back(variable(symbol.name));
    if (model.control)
        for (const Symbol& symbol : model.control->controls) controls_.push_back(variable(symbol.name));
    for (const Input& input : model.inputs) add_variable(input.symbol.name);
    for (const FirstOrderState& state : model.states) add_variable(state.symbol.name);
    lower_structure();
    take_labels(functions);
    if (!choice.kept) return;
    kept_ = std::make_unique<KeptSymbols>(
        model, choice, substituted, [this](const Tree& tree) { return label_casimirs(tree, labels_); }, symbols_,
        order_);
    lower_structure();
    lower_curvature();
}

GiNaC::ex SymbolicModel::derivative(const GiNaC::ex& f, const GiNaC::ex& symbol) const
{
    return kept_->derivative(f, symbol);
}

bool SymbolicModel::depends_on(const GiNaC::ex& f, const Sum& symbols) const
{
    return std::ranges::any_of(symbols, [&](const GiNaC::ex& each) { return kept_->depends_on(f, each); });
}

GiNaC::ex SymbolicModel::reduced(const GiNaC::ex& f) const
{
    Sum moving = y_;
    moving.insert(moving.end(), mu_.begin(), mu_.end());
    return kept_->reduced(f, moving);
}

GiNaC::ex SymbolicModel::named(const std::string& name, const GiNaC::ex& value)
{
    return kept_->named(name, value);
}

bool SymbolicModel::is_declared(const std::string& name) const
{
    if (kept_->declares(name)) return true;
    const std::vector<std::string> names = symbol_names(model_);
    if (std::find(names.begin(), names.end(), name) != names.end()) return true;
    const auto called = [&](const Symbol& symbol) { return symbol.name == name; };
    const auto& momenta = model_.fibre.momenta;
    return std::any_of(momenta.begin(), momenta.end(), called) ||
           (model_.control && std::any_of(model_.control->controls.begin(), model_.control->controls.end(), called));
}

std::string SymbolicModel::free_name(const std::vector<std::string>& names) const
{
    const auto free = std::find_if(names.begin(), names.end(), [&](const auto& name) { return !is_declared(name); });
    return free != names.end() ? *free : names.back();
}

GiNaC::ex SymbolicModel::variable(const std::string& name)
{
    order_.variables.push_back(name);
    return symbols_.symbol(name);
}

void SymbolicModel::lower_structure()
{
    anchor_.assign(r() * n(), 0);
    for (const AnchorValue& entry : algebroid_.rho) anchor_[entry.a * n() + entry.i] += lower(entry.value);
    std::vector<bool> given(r() * r(), false);
    bracket_.assign(r() * r() * r(), 0);
    for (const StructureValue& entry : algebroid_.C) {
        given[entry.a * r() + entry.b] = true;
        bracket_[(entry.a * r() + entry.b) * r() + entry.c] += lower(entry.value);
    }
    for (std::size_t a = 0; a < r(); ++a)
        for (std::size_t b = 0; b < r(); ++b)
            if (given[a * r() + b] && !given[b * r() + a])
                for (std::size_t c = 0; c < r(); ++c)
                    bracket_[(b * r() + a) * r() + c] = -bracket_[(a * r() + b) * r() + c];
}

/// An Atiyah algebroid has its structure functions elaborated without the definitions. With e_i = d/dx^i - A_i^c e_c,
/// [e_i, e_j]^c = dA_i^c/dx^j - dA_j^c/dx^i + A_i^a A_j^b c^c_ab and [e_i, e_b]^c = -A_i^a c^c_ab.
void SymbolicModel::lower_curvature()
{
    const AlgebroidBlock& block = model_.algebroid;
    const std::size_t m = block.base.size();
    if (block.kind != AlgebroidKind::atiyah || block.fibre.size() != r() || n() != model_.base.coordinates.size())
        return;
    std::vector<GiNaC::ex> A(m * r(), 0);
    for (const ConnectionEntry& entry : block.connection)
        for (std::size_t i = 0; i < m; ++i)
            if (block.base[i] == entry.coordinate) A[i * r() + entry.section] += lower(entry.value);
    const auto set = [&](std::size_t c, std::size_t a, std::size_t b, const GiNaC::ex& value) {
        bracket_[(a * r() + b) * r() + c] = value;
        bracket_[(b * r() + a) * r() + c] = -value;
    };
    for (std::size_t i = 0; i < m; ++i)
        for (std::size_t c = m; c < r(); ++c) {
            for (std::size_t b = m; b < r(); ++b) {
                Sum terms;
                for (std::size_t a = m; a < r(); ++a) terms.push_back(-A[i * r() + a] * C(c, a, b));
                set(c, i, b, total(terms));
            }
            for (std::size_t j = i + 1; j < m; ++j) {
                Sum terms{derivative(A[i * r() + c], x_[block.base[j]]),
                          -derivative(A[j * r() + c], x_[block.base[i]])};
                for (std::size_t a = m; a < r(); ++a)
                    for (std::size_t b = m; b < r(); ++b) terms.push_back(A[i * r() + a] * A[j * r() + b] * C(c, a, b));
                set(c, i, j, total(terms));
            }
        }
}

void SymbolicModel::take_labels(const std::vector<Tree>& functions)
{
    std::vector<NamedTree> constant;
    for (const NamedTree& casimir : model_.base.casimirs) {
        const GiNaC::ex f = to_ginac(casimir.value, symbols_);
        bool zero = !is_declared(casimir.name);
        for (std::size_t a = 0; a < r() && zero; ++a) zero = total(along_anchor(a, f)).expand().is_zero();
        if (zero) constant.push_back(casimir);
    }
    for (const NamedTree& casimir : constant) {
        const bool used = std::ranges::any_of(functions, [&](const Tree& function) {
            return function != nullptr && mentions(label_casimirs(function, constant), casimir.name);
        });
        if (used) labels_.push_back(casimir);
    }
}

GiNaC::ex SymbolicModel::lower(const Tree& tree)
{
    return to_ginac(kept_->folded(label_casimirs(tree, labels_)), symbols_);
}

/// An expression that is not smooth stands for itself: it is not differentiated, and comes back as it is written.
GiNaC::ex SymbolicModel::lower_rough(const Tree& tree)
{
    return to_ginac(rewrite(kept_->folded(label_casimirs(tree, labels_)),
                            [&](const Tree& node) {
                                if (!is_rough(*node)) return Tree{};
                                const std::string text = to_text(node);
                                rough_.emplace(text, node);
                                return name(text);
                            }),
                    symbols_);
}

Tree SymbolicModel::shortest(const GiNaC::ex& e) const
{
    return replace_names(shortest_form(e, symbols_, order_), rough_);
}

GiNaC::ex SymbolicModel::simpler(const GiNaC::ex& e)
{
    if (kept_->vanishes(e)) return 0;
    return to_ginac(shortest_form(e, symbols_, order_), symbols_);
}

GiNaC::ex SymbolicModel::time_derivative(const GiNaC::ex& f)
{
    return time_ ? derivative(f, *time_) : GiNaC::ex(0);
}

Sum SymbolicModel::along_anchor(std::size_t a, const GiNaC::ex& f) const
{
    Sum terms;
    for (std::size_t i = 0; i < n(); ++i)
        if (!rho(i, a).is_zero()) terms.push_back(rho(i, a) * derivative(f, x_[i]));
    return terms;
}

Sum SymbolicModel::bracket_terms(std::size_t a, const Sum& p, const Sum& y) const
{
    Sum terms;
    for (std::size_t b = 0; b < r(); ++b)
        for (std::size_t c = 0; c < r(); ++c)
            if (!C(c, a, b).is_zero()) terms.push_back(-p[c] * C(c, a, b) * y[b]);
    return terms;
}

/// The velocities that are not the symbols y themselves, by the names of these.
std::map<std::string, Tree> SymbolicModel::velocities(const Sum& y) const
{
    std::map<std::string, Tree> inserted;
    for (std::size_t a = 0; a < r(); ++a)
        if (!y[a].is_equal(y_[a])) inserted.emplace(algebroid_.fibre[a].name, shortest(y[a]));
    return inserted;
}

GiNaC::ex SymbolicModel::lower_at(const Tree& tree, const std::map<std::string, Tree>& velocities)
{
    return lower_rough(replace_names(tree, velocities));
}

EquationBlock states_block(std::vector<Equation> equations)
{
    return {"first-order states", "ż = f(t, x, y, z)", R"(\dot z = f(t, x, y, z))", std::move(equations)};
}

EquationBlock SymbolicModel::states(const Sum& y)
{
    EquationBlock block = states_block({});
    const std::map<std::string, Tree> inserted = velocities(y);
    for (std::size_t k = 0; k < model_.states.size(); ++k)
        if (const FirstOrderState& state = model_.states[k]; !is_total_cost(model_, k))
            block.equations.push_back(
                equation(LeftSide::time_derivative, state.symbol.name, {lower_at(state.rate, inserted)}));
    return block;
}

Sum SymbolicModel::forces(const Sum& y)
{
    Sum forces(r(), 0);
    const std::map<std::string, Tree> inserted = velocities(y);
    for (const ComponentEntry& entry : model_.forces) forces[entry.section] += lower_at(entry.value, inserted);
    if (model_.dissipation == nullptr) return forces;
    GiNaC::exmap substituted;
    for (std::size_t a = 0; a < r(); ++a) substituted[y_[a]] = y[a];
    const GiNaC::ex R = lower(model_.dissipation);
    for (std::size_t a = 0; a < r(); ++a)
        forces[a] -= derivative(R, y_[a]).subs(substituted, GiNaC::subs_options::no_pattern);
    return forces;
}

std::vector<TermGroup> SymbolicModel::simplified(std::vector<Group> groups) const
{
    for (std::size_t k = 0; k < groups.size(); ++k)
        for (std::size_t l = k + 1; l < groups.size(); ++l) {
            const auto first = expanded_length(groups[k].value);
            const auto second = expanded_length(groups[l].value);
            const auto both = expanded_length(groups[k].value + groups[l].value);
            if (!first || !second || !both || *first == 0 || *second == 0 || *both >= *first + *second) continue;
            groups[k].value += groups[l].value;
            const std::string& label = groups[l].label;
            groups[k].label += label.starts_with('-') ? " - " + label.substr(1) : " + " + label;
            groups.erase(groups.begin() + static_cast<std::ptrdiff_t>(l));
            l = k;
        }
    std::vector<TermGroup> result;
    for (const Group& group : groups)
        if (Tree value = shortest(group.value); !is_zero(value)) {
            written_ += to_text(value).size();
            if (written_ > longest_) throw TooMuchToRead();
            result.push_back({group.label, std::move(value)});
        }
    return result;
}

Equation SymbolicModel::equation(LeftSide left, const std::string& symbol, const Sum& terms) const
{
    return {left, symbol, {}, simplified({{"", total(terms)}})};
}

std::vector<Equation> SymbolicModel::kinematics(const Sum& y) const
{
    std::vector<Equation> equations;
    for (std::size_t i = 0; i < n(); ++i) {
        Sum terms;
        for (std::size_t a = 0; a < r(); ++a) terms.push_back(rho(i, a) * y[a]);
        equations.push_back(equation(LeftSide::time_derivative, algebroid_.base[i].name, terms));
    }
    return equations;
}

EquationBlock SymbolicModel::casimirs()
{
    EquationBlock block{"labels of the leaves (constant along every motion)", "ρ_a(f) = 0", R"(\rho_a(f) = 0)", {}};
    for (const NamedTree& casimir : labels_)
        block.equations.push_back(equation(LeftSide::symbol, casimir.name, {to_ginac(casimir.value, symbols_)}));
    return block;
}

std::string SymbolicModel::fibre_latex(std::size_t a) const
{
    return LatexNames(empty_set({}).symbols).symbol(algebroid_.fibre[a].name);
}

EquationSet SymbolicModel::empty_set(const std::string& form) const
{
    EquationSet set{model_.name, model_.title, form, {}, {}};
    for (const Parameter& parameter : model_.parameters)
        set.symbols.push_back({parameter.symbol.name, parameter.symbol.latex});
    for (const std::vector<Symbol>* list : {&algebroid_.base, &algebroid_.fibre})
        for (const Symbol& symbol : *list) set.symbols.push_back({symbol.name, symbol.latex});
    if (is_nonholonomic(model_))
        for (const Symbol& symbol : model_.fibre.coordinates) set.symbols.push_back({symbol.name, symbol.latex});
    for (std::size_t a = 0; a < model_.fibre.momenta.size(); ++a) {
        const Symbol& momentum = model_.fibre.momenta[a];
        const Symbol& coordinate = model_.fibre.coordinates[a];
        const bool follows =
            momentum.latex.empty() && !coordinate.latex.empty() && momentum.name == "p_" + coordinate.name;
        // p_theta, the momentum of the velocity \dot\theta
        const bool dotted = coordinate.latex.starts_with("\\dot\\") || coordinate.latex.starts_with("\\dot{");
        const std::string index = dotted ? coordinate.latex.substr(4) : coordinate.latex;
        set.symbols.push_back({momentum.name, follows ? "p_{" + index + "}" : momentum.latex});
    }
    if (model_.control)
        for (const Symbol& symbol : model_.control->controls) set.symbols.push_back({symbol.name, symbol.latex});
    for (const Input& input : model_.inputs) set.symbols.push_back({input.symbol.name, input.symbol.latex});
    for (std::size_t k = 0; k < model_.states.size(); ++k)
        if (const Symbol& symbol = model_.states[k].symbol; !is_total_cost(model_, k))
            set.symbols.push_back({symbol.name, symbol.latex});
    return set;
}

EquationSet SymbolicModel::closed(EquationSet set) const
{
    set.where = kept_->where(set);
    kept_->append_latex(set);
    return set;
}

EquationSet derived(const Model& model, const char* equations, Definitions definitions,
                    const std::function<EquationSet(const DefinitionChoice&)>& derivation)
{
    return derived(model, equations, [&] { return with_definitions(model, definitions, derivation); });
}

EquationSet derived(const Model& model, const char* equations, const std::function<EquationSet()>& derivation)
{
    const Activity activity(fmt::format("deriving {}", equations));
    return with_ginac(fmt::format("{} of model '{}' could not be derived", equations, model.name), derivation);
}

} // namespace lagen
