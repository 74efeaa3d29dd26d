// SPDX-License-Identifier: GPL-2.0-or-later
#include "elaborate/make_frame.hpp"

#include "elaborate/bind_parameters.hpp"
#include "expression/linear_algebra.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/core/evaluate.hpp"
#include "proof/enclosure.hpp"
#include "proof/rank.hpp"
#include "text/comma_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lagen {
namespace {

// Points where several functions vanish at once, as on the singular set of a level set.
// Levenberg and Marquardt's method from a fixed list of starts; what it comes near to is rounded to small fractions,
// and only what vanishes there exactly counts.

constexpr int most_steps = 60;
constexpr std::size_t random_starts = 12;
constexpr long largest_denominator = 24;
constexpr double rounding = 1e-5; ///< how near a fraction must be: double zeros are found to half the digits

std::optional<Rational> near_fraction(double value)
{
    for (long denominator = 1; denominator <= largest_denominator; ++denominator) {
        const double scaled = value * static_cast<double>(denominator);
        if (!(std::abs(scaled) < 1e6) || std::abs(scaled - std::round(scaled)) > rounding) continue;
        Rational result(std::lround(scaled), denominator);
        result.canonicalize();
        return result;
    }
    return std::nullopt;
}

class ZeroSearch {
  public:
    ZeroSearch(Graph& graph, const std::vector<NodeId>& functions, const std::vector<NodeId>& x,
               const std::vector<NodeId>& domain, const std::map<NodeId, Rational>& fixed)
        : graph_(graph), functions_(functions), x_(x), domain_(domain), fixed_(fixed), nodes_(functions)
    {
        for (const NodeId function : functions)
            for (const NodeId slope : gradient(graph, function, x)) nodes_.push_back(slope);
    }

    [[nodiscard]] std::optional<NamedPoint> from(std::vector<double> point) const
    {
        for (int k = 0; k < most_steps && step(point); ++k) {
        }
        proof::ExactInputs inputs = fixed_;
        NamedPoint named;
        for (std::size_t i = 0; i < x_.size(); ++i) {
            const std::optional<Rational> value = near_fraction(point[i]);
            if (!value) return std::nullopt;
            inputs[x_[i]] = *value;
            named.emplace_back(graph_.input_name(x_[i]), *value);
        }
        const auto all_are = [&](const std::vector<NodeId>& nodes, int wanted) {
            const auto values = proof::Evaluation(graph_, nodes).exactly(inputs);
            return values && std::ranges::all_of(*values, [&](const Rational& value) { return value == wanted; });
        };
        return all_are(functions_, 0) && all_are(domain_, 1) ? std::optional(named) : std::nullopt;
    }

  private:
    /// x -= (J^T J + |F| 1)^-1 J^T F; false where it is a zero, or not defined.
    bool step(std::vector<double>& point) const
    {
        std::map<std::string, double> inputs;
        for (const auto& [input, value] : fixed_) inputs[graph_.input_name(input)] = value.get_d();
        for (std::size_t i = 0; i < x_.size(); ++i) inputs[graph_.input_name(x_[i])] = point[i];
        const std::vector<double> values = evaluate<double>(graph_, nodes_, inputs);
        const std::size_t n = x_.size(), count = functions_.size();
        std::vector<double> normal(n * n, 0), right(n, 0);
        double size = 0;
        for (std::size_t k = 0; k < count; ++k) {
            const double* slopes = &values[count + k * n];
            size += std::abs(values[k]);
            for (std::size_t i = 0; i < n; ++i) {
                right[i] += slopes[i] * values[k];
                for (std::size_t j = 0; j < n; ++j) normal[i * n + j] += slopes[i] * slopes[j];
            }
        }
        if (!std::isfinite(size) || size == 0) return false;
        for (std::size_t i = 0; i < n; ++i) normal[i * n + i] += std::min(size, 1.0);
        const std::vector<double> move = substitute(factorise(std::move(normal), n), right);
        for (std::size_t i = 0; i < n; ++i) point[i] -= move[i];
        return std::ranges::all_of(point, [](double value) { return std::isfinite(value); });
    }

    Graph& graph_;
    const std::vector<NodeId>&functions_, &x_, &domain_;
    const std::map<NodeId, Rational>& fixed_;
    std::vector<NodeId> nodes_; ///< the functions, then their gradients by rows
};

/// An exact point with small denominators where all of `functions` are 0 and the domain holds, with its values of `x`;
/// parameters are `fixed`. Nothing where the search finds none: then there may be one all the same.
std::optional<NamedPoint> common_zero(Graph& graph, const std::vector<NodeId>& functions, const std::vector<NodeId>& x,
                                      const std::vector<NodeId>& domain, const std::map<NodeId, Rational>& fixed)
{
    const ZeroSearch search(graph, functions, x, domain, fixed);
    std::vector<std::vector<double>> starts{std::vector<double>(x.size(), 0)};
    for (std::size_t i = 0; i < x.size(); ++i)
        for (const double value : {1.25, -1.25}) {
            starts.emplace_back(x.size(), 0);
            starts.back()[i] = value;
        }
    long seed = 7919;
    for (std::size_t k = 0; k < random_starts; ++k) {
        starts.emplace_back();
        for (std::size_t i = 0; i < x.size(); ++i) {
            seed = (seed * 48271) % 2147483647; // Lehmer's generator
            starts.back().push_back(static_cast<double>(seed % 4001) / 1000 - 2);
        }
    }
    for (const std::vector<double>& start : starts)
        if (auto point = search.from(start)) return point;
    return std::nullopt;
}

constexpr std::size_t most_minors = 64; ///< of which a common zero is looked for

/// A matrix that is symmetric says most of its entries twice: those that are another one, up to sign, or 0.
std::vector<std::size_t> without_repetitions(const Model& model)
{
    Graph graph;
    Lowering lower(graph);
    ProofSetting setting;
    for (const Symbol& symbol : model.base.coordinates) setting.variables.push_back(graph.input(symbol.name));
    for (const Parameter& parameter : model.parameters)
        setting.parameters.push_back(graph.input(parameter.symbol.name));
    const std::vector<SourceRange>& texts = model.base.constraint_texts;
    std::vector<NodeId> h;
    for (const Tree& constraint : model.base.constraints) h.push_back(lower(constraint));
    const auto same_text = [&](std::size_t j, std::size_t k) { return texts[j].begin == texts[k].begin; };
    const auto is_zero = [&](NodeId node) {
        return graph.is_zero(node) || ZeroDecider(graph, setting).status(node) == ProofStatus::proved;
    };
    std::vector<std::size_t> kept;
    for (std::size_t k = 0; k < h.size(); ++k) {
        const bool repeats = std::ranges::any_of(kept, [&](std::size_t j) {
            return same_text(j, k) && (is_zero(graph.subtract(h[j], h[k])) || is_zero(graph.add(h[j], h[k])));
        });
        const bool alone = (k == 0 || !same_text(k - 1, k)) && (k + 1 == h.size() || !same_text(k, k + 1));
        if (!repeats && (alone || !is_zero(h[k]))) kept.push_back(k);
    }
    return kept;
}

Model with_constraints(Model model, const std::vector<std::size_t>& places)
{
    Base& base = model.base;
    for (std::size_t k = 0; k < places.size(); ++k) {
        base.constraints[k] = base.constraints[places[k]];
        base.constraint_texts[k] = base.constraint_texts[places[k]];
    }
    base.constraints.resize(places.size());
    base.constraint_texts.resize(places.size());
    return model;
}

/// The largest whole number that divides all terms of the tree as it is written.
mpz_class whole_factor(const Tree& tree)
{
    switch (tree->kind) {
    case TreeKind::number: return tree->number.get_den() == 1 ? mpz_class(abs(tree->number.get_num())) : mpz_class(1);
    case TreeKind::multiply:
    case TreeKind::divide:
    case TreeKind::negate: return whole_factor(tree->arguments[0]);
    case TreeKind::add: {
        mpz_class common = 0;
        for (const Tree& term : tree->arguments) common = gcd(common, whole_factor(term));
        return common;
    }
    default: return 1;
    }
}

class FrameBuilder {
  public:
    FrameBuilder(const Model& model, const LevelSetRequest& request)
        : model_(model), request_(request), n_(model.base.coordinates.size()), m_(model.base.constraints.size())
    {
        require_numbers();
        work_.emplace(model_);
        Graph& graph = work_->graph();
        for (std::size_t i = 0; i < n_; ++i) x_.push_back(work_->coordinate(i));
        for (const Tree& constraint : model_.base.constraints) {
            h_.push_back(work_->lower(constraint));
            for (const NodeId slope : gradient(graph, h_.back(), x_)) rows_.B.push_back(slope);
        }
        rows_.m = m_;
        rows_.r = n_;
    }

    LevelSetFrame make()
    {
        require_independent();
        const KeptChoice choice = choose_free(*work_, rows_, model_.base.coordinates, request_.kept);
        if (choice.kept) return graph_frame(*choice.kept);
        const bool regular = is_regular();
        if (regular && n_ - m_ == 1 && request_.sections && request_.kept.empty()) return frame_of_minors();
        if (!regular) refuse_singular();
        refuse_empty();
        refuse_charts(choice, regular);
    }

  private:
    void require_numbers() const
    {
        if (m_ == 0)
            throw ModelError("an algebroid of kind 'level_set' needs 'constraints' in [base]", request_.where,
                             "[base] constraints = [\"x^2 + y^2 - 1\"]; without any: kind = \"tangent\"");
        if (m_ >= n_ || m_ > determinant_limit)
            throw ModelError(fmt::format("the constraints of the level set are {} on {} base coordinates", m_, n_),
                             model_.base.constraint_texts.back(),
                             fmt::format("at most {} independent ones, and fewer than the coordinates, make a level "
                                         "set that something can move on",
                                         determinant_limit));
        if (request_.sections && *request_.sections != n_ - m_)
            throw ModelError(
                fmt::format("the number of fibre coordinates is {}, where the level set of {} constraint{} "
                            "on {} base coordinates needs {}",
                            *request_.sections, m_, m_ == 1 ? "" : "s", n_, n_ - m_),
                request_.where, "without [fibre] lagen names them after the coordinates that it keeps");
    }

    /// Each gradient is independent of those before it somewhere on M, as far as its triangular constraints tell.
    void require_independent()
    {
        const ZeroDecider decider(work_->graph(), work_->setting());
        const auto minor = FunctionMatrix(work_->graph(), rows_.B, m_, n_).largest_minor(decider);
        for (std::size_t A = 1; minor && A < m_; ++A)
            if (std::ranges::find(minor->rows, A) == minor->rows.end())
                throw ModelError(
                    fmt::format("the constraint '{}' depends on those before it: the gradients of all of them are "
                                "linearly dependent at every point of the level set",
                                to_text(model_.base.constraints[A])),
                    model_.base.constraint_texts[A], "leave it out, or give one that cuts the level set down");
    }

    /// det B B^T, the sum of the squares of all minors, vanishes nowhere.
    bool is_regular()
    {
        Graph& graph = work_->graph();
        std::vector<NodeId> gram;
        for (std::size_t A = 0; A < m_; ++A)
            for (std::size_t C = 0; C < m_; ++C) {
                std::vector<NodeId> terms;
                for (std::size_t i = 0; i < n_; ++i)
                    terms.push_back(graph.multiply(rows_.B[A * n_ + i], rows_.B[C * n_ + i]));
                gram.push_back(graph.sum(terms));
            }
        const NodeId determinant = determinant_of(graph, gram, m_, first_places(m_), first_places(m_));
        const ZeroDecider decider(graph, work_->setting());
        if (decider.proves_nonzero(determinant)) return true;
        if (m_ > 1) return false;
        std::vector<NodeId> terms; // x^i df/dx^i, a number on quadrics and other homogeneous level sets
        for (std::size_t i = 0; i < n_; ++i) terms.push_back(graph.multiply(x_[i], rows_.B[i]));
        return decider.proves_nonzero(graph.sum(terms));
    }

    LevelSetFrame graph_frame(const Places& kept)
    {
        Graph& graph = work_->graph();
        const Places solved = rows_.solved(kept);
        std::vector<NodeId> matrix;
        std::vector<std::vector<NodeId>> right(kept.size());
        for (std::size_t A = 0; A < m_; ++A) {
            for (const std::size_t i : solved) matrix.push_back(rows_.B[A * n_ + i]);
            for (std::size_t a = 0; a < kept.size(); ++a) right[a].push_back(graph.negate(rows_.B[A * n_ + kept[a]]));
        }
        const std::vector<std::vector<NodeId>> z = solve_exactly(graph, matrix, m_, right);
        LevelSetFrame frame;
        frame.kept = kept;
        for (std::size_t a = 0; a < kept.size(); ++a) {
            frame.anchor.push_back({a, kept[a], number(1, request_.where), request_.where});
            for (std::size_t j = 0; j < m_; ++j) append(frame, a, solved[j], work_->readable(z[a][j]));
        }
        return frame;
    }

    /// The determinant of B with the row e below it is |e|^2: e turns to the left of the gradient of a single f(x, y).
    LevelSetFrame frame_of_minors()
    {
        Graph& graph = work_->graph();
        std::vector<NodeId> components;
        mpz_class common = 0;
        for (std::size_t i = 0; i < n_; ++i) {
            const NodeId minor = rows_.minor(graph, {i});
            components.push_back((n_ - 1 + i) % 2 == 0 ? minor : graph.negate(minor));
            if (const Tree tree = work_->readable(minor)) common = gcd(common, whole_factor(tree));
        }
        LevelSetFrame frame;
        for (std::size_t i = 0; i < n_; ++i)
            append(frame, 0, i, work_->readable(graph.divide(components[i], graph.constant(Rational(common)))));
        return frame;
    }

    void append(LevelSetFrame& frame, std::size_t a, std::size_t i, Tree value) const
    {
        if (value != nullptr) frame.anchor.push_back({a, i, std::move(value), request_.where});
    }

    /// A point of M where all minors vanish, for the values that the parameters have.
    void refuse_singular()
    {
        Graph& graph = work_->graph();
        std::vector<NodeId> functions = h_;
        Places kept = first_places(n_ - m_);
        do {
            const NodeId minor = rows_.minor(graph, kept);
            if (!graph.is_zero(minor)) functions.push_back(minor);
        } while (functions.size() <= most_minors && next_places(kept, n_));
        std::map<NodeId, Rational> fixed;
        for (const auto& [name, value] : parameter_values(graph, model_)) {
            const auto exact = proof::Evaluation(graph, {value}).exactly({});
            if (!exact || functions.size() > most_minors) return;
            fixed[graph.input(name)] = (*exact)[0];
        }
        const auto point = common_zero(graph, functions, x_, work_->setting().domain, fixed);
        if (!point) return;
        std::string text = comma_list(
            *point, [](const auto& entry) { return fmt::format("{} = {}", entry.first, to_text(entry.second)); });
        for (const auto& [parameter, value] : fixed)
            if (depends_on_any(graph, h_, std::vector{parameter}))
                text += fmt::format(", {} = {}", graph.input_name(parameter), value.get_str());
        throw ModelError(fmt::format("the level set is singular at {}: the gradient{} of its constraint{} there", text,
                                     m_ == 1 ? "" : "s", m_ == 1 ? " is zero" : "s are linearly dependent"),
                         model_.base.constraint_texts.front(),
                         "leave the point out by a condition of [base] domain, such as one on the side of it where "
                         "the motions are");
    }

    /// Throws where no point is found that satisfies the triangular constraints and the domain.
    void refuse_empty()
    {
        if (ZeroDecider(work_->graph(), work_->setting()).sample_point()) return;
        throw ModelError("no point of the level set is found: none of the points that are tried satisfies its "
                         "constraints and [base] domain",
                         model_.base.constraint_texts.front(),
                         "constraints such as x^2 + y^2 + 1 have no real solution: is a sign wrong, or the domain too "
                         "small?");
    }

    /// "x > 0", "y + 1 < 0" with what the domain says already: factors of a minor one by one, as the signs of a domain
    /// are looked for; a run would step over x != 0. The side is one on which the model has points.
    [[nodiscard]] std::vector<std::string> chart_conditions(const KeptChoice& choice)
    {
        std::vector<std::string> conditions;
        for (const Tree& inequality : model_.base.domain)
            conditions.push_back(fmt::format("\"{}\"", to_text(inequality)));
        Graph& graph = work_->graph();
        ProofSetting setting = work_->setting();
        for (const Tree& factor : choice.open) {
            const NodeId f = work_->lower(factor);
            setting.domain.push_back(graph.apply(Op::greater, f, graph.constant(0)));
            const auto decider = ZeroDecider::make(graph, setting);
            const bool above = decider != nullptr && decider->sample_point();
            if (!above) setting.domain.back() = graph.apply(Op::less, f, graph.constant(0));
            conditions.push_back(fmt::format("\"{} {} 0\"", to_text(factor), above ? ">" : "<"));
        }
        return conditions;
    }

    [[noreturn]] void refuse_charts(const KeptChoice& choice, bool regular)
    {
        const bool is_curve = n_ - m_ == 1;
        std::string text =
            regular ? "the level set is regular, and " : "the level set is not shown to be regular, and ";
        if (!request_.kept.empty())
            text += "the coordinates that [fibre] keeps are not proved to parametrise all of it";
        else if (is_curve)
            text += "no single coordinate is proved to parametrise all of it";
        else
            text += fmt::format("no {} of its coordinates are proved to parametrise all of it", n_ - m_);
        if (choice.minors.empty())
            throw ModelError(text, request_.where, "the constraints fix one of them: keep others");
        std::string hint = fmt::format("[base] domain = [{}] makes a chart, and the other side another",
                                       fmt::join(chart_conditions(choice), ", "));
        if (is_curve && regular) hint += "; a name of your own in [fibre], \"u\", takes a tangent that needs no chart";
        throw ModelError(text + fmt::format(": it needs several charts, where the minors {} are not 0", choice.minors),
                         request_.where, hint);
    }

    const Model& model_;
    const LevelSetRequest& request_;
    std::size_t n_, m_;
    std::optional<BuildWorkspace> work_;
    std::vector<NodeId> x_, h_;
    ConstraintRows rows_{{}, 0, 0};
};

} // namespace

LevelSetFrame make_frame(const Model& model, const LevelSetRequest& request)
{
    const std::vector<std::size_t> places = without_repetitions(model);
    const Model own = with_constraints(model, places);
    LevelSetFrame frame = FrameBuilder(own, request).make();
    frame.constraints = places;
    return frame;
}

Choosers choosers()
{
    return {choose_kept, make_frame};
}

namespace {

constexpr std::size_t most_kept_choices = 5000;
constexpr std::size_t listed_minors = 3;

/// The factors of a minor that the domain does not keep from zero, without signs and exponents.
void append_open(BuildWorkspace& work, const Tree& minor, std::vector<Tree>& open)
{
    switch (minor->kind) {
    case TreeKind::number: return;
    case TreeKind::multiply:
        for (const Tree& factor : minor->arguments) append_open(work, factor, open);
        return;
    case TreeKind::negate:
    case TreeKind::divide:
    case TreeKind::power: return append_open(work, minor->arguments[0], open);
    default: break;
    }
    if (!ZeroDecider(work.graph(), work.setting()).proves_nonzero(work.lower(minor))) open.push_back(minor);
}

/// "v_x, v_th"
std::string listed_names(const std::vector<Symbol>& symbols, const Places& places)
{
    return comma_list(places, [&](std::size_t place) { return symbols[place].name; });
}

} // namespace

Places ConstraintRows::solved(const Places& kept) const
{
    Places out;
    for (std::size_t a = 0; a < r; ++a)
        if (std::ranges::find(kept, a) == kept.end()) out.push_back(a);
    return out;
}

NodeId ConstraintRows::minor(Graph& graph, const Places& kept) const
{
    return determinant_of(graph, B, r, first_places(m), solved(kept));
}

KeptChoice choose_free(BuildWorkspace& work, const ConstraintRows& rows, const std::vector<Symbol>& coordinates,
                       const Places& wanted)
{
    Graph& graph = work.graph();
    KeptChoice choice;
    Places kept = wanted.empty() ? first_places(rows.r - rows.m) : wanted;
    std::size_t tried = 0, listed = 0;
    do {
        const NodeId minor = rows.minor(graph, kept);
        if (graph.is_zero(minor)) continue;
        if (ZeroDecider(graph, work.setting()).proves_nonzero(minor)) {
            choice.kept = kept;
            return choice;
        }
        const Tree text = work.readable(minor);
        if (text == nullptr) continue;
        std::vector<Tree> open;
        append_open(work, text, open);
        if (open.empty()) open = {text}; // the product is not shown, though its factors are
        if (choice.open.empty() || open.size() < choice.open.size()) choice.open = std::move(open);
        if (++listed <= listed_minors)
            choice.minors += fmt::format("{}{} (keeping {})", listed == 1 ? "" : ", ", to_text(text),
                                         listed_names(coordinates, kept));
    } while (wanted.empty() && ++tried < most_kept_choices && next_places(kept, rows.r));
    if (listed > listed_minors) choice.minors += ", ..";
    return choice;
}

std::vector<std::size_t> choose_kept(const Model& model)
{
    const std::vector<Symbol>& ambient = ambient_fibre(model);
    const std::vector<Tree>& constraints = model.algebroid.constraints;
    const std::size_t r = ambient.size(), m = constraints.size();
    if (m >= r || m > determinant_limit)
        throw ModelError(fmt::format("the constraints are {} on {} ambient fibre coordinates", m, r),
                         model.algebroid.where,
                         fmt::format("at most {}, and fewer than the coordinates, are solved for", determinant_limit));
    BuildWorkspace work(model);
    std::vector<NodeId> Y;
    for (const Symbol& symbol : ambient) Y.push_back(work.graph().input(symbol.name));
    ConstraintRows rows{{}, m, r};
    for (const Tree& constraint : constraints)
        for (const NodeId slope : gradient(work.graph(), work.lower(constraint), Y)) rows.B.push_back(slope);
    const KeptChoice choice = choose_free(work, rows, ambient);
    if (choice.kept) return *choice.kept;
    if (choice.minors.empty()) return first_places(r - m);
    throw MathematicsError(
        fmt::format("the constraints of model '{}' are not proved to leave {} of its ambient fibre coordinates free at "
                    "every point of the domain: the minors are {}",
                    model.name, r - m, choice.minors),
        "[fibre] coordinates = [..] keeps coordinates where their minor is not 0; [algebroid.sections] need none");
}

} // namespace lagen
