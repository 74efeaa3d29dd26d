// SPDX-License-Identifier: GPL-2.0-or-later
/// Elimination along the definitions of a sparse Hessian, in scalar operations.
#include "graph/elimination/eliminate_pair.hpp"
#include "graph/elimination/sparse_hessian.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace lagen {
namespace {

using Terms = SparseHessian::Terms;

/// With up to so many partners H_ja H_ak is multiplied out while the reciprocal is on its way: the next pivot waits for
/// two operations less, which is what a chain of pivots takes most of its time for.
constexpr std::size_t largest_early_products = 3;

/// Nodes that one elimination may make: a matrix without structure has n^3/6 of them, and stays one node instead.
constexpr std::size_t largest_elimination = 500'000;

class Eliminator {
  public:
    Eliminator(Graph& graph, const SparseHessian& hessian)
        : graph_(graph), hessian_(hessian), rows_(hessian.definitions.size()), holders_(hessian.order),
          gone_(hessian.definitions.size(), false)
    {
        for (const SparseHessian::Entry& entry : hessian.entries) add(entry.row, entry.column, entry.value);
        find_holders();
        result_.order = hessian.order;
        for (std::size_t k = 0; k < rows_.size(); ++k) result_.is_term.push_back(k >= hessian.order);
    }

    std::optional<Elimination> run()
    {
        const std::size_t limit = graph_.size() + largest_elimination;
        for (std::size_t left = hessian_.order; left > 0; --left) {
            const std::size_t chosen = choose();
            const std::size_t next = exchange(chosen);
            std::vector<std::size_t> terms;
            for (const std::size_t term : holders_[chosen]) { // users first
                if (gone_[term]) continue;
                gone_[term] = true;
                result_.steps.push_back({term, hessian_.definitions[term], 0});
                terms.push_back(term);
            }
            gone_[next] = true;
            const auto heads = heads_of(terms, next);
            const bool regular =
                heads ? eliminate_through_heads(*heads, terms, next) : eliminate_through_rows(terms, next);
            if (!regular || graph_.size() > limit) return {};
        }
        return std::move(result_);
    }

  private:
    using Row = LinearForm::Sum;
    using Pair = std::pair<std::size_t, std::size_t>;

    /// By variable: the terms that depend on it, in descending order.
    void find_holders()
    {
        std::vector<std::set<std::size_t>> variables(rows_.size());
        for (std::size_t k = 0; k < rows_.size(); ++k) {
            if (k < hessian_.order) variables[k] = {k};
            for (const auto& [operand, coefficient] : hessian_.definitions[k])
                variables[k].insert(variables[operand].begin(), variables[operand].end());
        }
        for (std::size_t k = rows_.size(); k-- > hessian_.order;)
            for (const std::size_t variable : variables[k]) holders_[variable].push_back(k);
    }

    /// The variable that the fewest terms hide; of several the last.
    [[nodiscard]] std::size_t choose() const
    {
        std::size_t best = 0;
        std::size_t fewest = SIZE_MAX;
        for (std::size_t k = hessian_.order; k-- > 0;) {
            if (gone_[k]) continue;
            const auto hidden = static_cast<std::size_t>(
                std::ranges::count_if(holders_[k], [this](std::size_t term) { return !gone_[term]; }));
            if (hidden >= fewest) continue;
            best = k;
            fewest = hidden;
        }
        return best;
    }

    /// Where `y` stands in one term u = alpha y + .. alone, and its factor is a number, u takes its place and y becomes
    /// a term, (u - ..) / alpha: joint angles become angles. Answers the variable to be eliminated.
    std::size_t exchange(std::size_t y)
    {
        const auto is_squared = [&](const auto& entry) { return concerns(entry.first, {}, y); };
        if (!rows_[y].empty() || std::ranges::any_of(squares_, is_squared)) return y;
        std::size_t user = y;
        for (const std::size_t term : holders_[y]) {
            if (gone_[term]) continue;
            const Terms& terms = hessian_.definitions[term];
            if (std::ranges::find(terms, y, &Terms::value_type::first) == terms.end()) continue;
            if (user != y) return y;
            user = term;
        }
        if (user == y || hessian_.definitions[user].size() < 2) return y;
        NodeId factor = graph_.constant(0);
        for (const auto& [operand, coefficient] : hessian_.definitions[user])
            if (operand == y) factor = graph_.add(factor, coefficient);
        if (!graph_.is_constant(factor) || graph_.is_zero(factor)) return y;
        const NodeId inverse = graph_.divide(graph_.constant(1), factor);
        Terms terms{{user, inverse}};
        for (const auto& [operand, coefficient] : hessian_.definitions[user])
            if (operand != y) terms.emplace_back(operand, graph_.negate(graph_.multiply(coefficient, inverse)));
        result_.steps.push_back({y, std::move(terms), 0});
        result_.is_term[y] = true;
        result_.is_term[user] = false;
        gone_[y] = gone_[user] = true;
        return user;
    }

    /// `terms` (users first) put in, then `y` eliminated; false where its pivot is the constant 0.
    bool eliminate_through_rows(const std::vector<std::size_t>& terms, std::size_t y)
    {
        write_squares(terms, y);
        std::vector<std::size_t> multiples;
        for (const std::size_t term : terms) {
            const Terms& definition = hessian_.definitions[term];
            if (definition.size() == 1 && definition[0].first == y)
                multiples.push_back(term);
            else
                put_in(term);
        }
        put_in_multiples(multiples, y);
        const auto pivot = rows_[y].find(y);
        if (pivot == rows_[y].end()) return false;
        const NodeId value = pivot->second;
        result_.steps.push_back({y, multipliers(y, value), value});
        return true;
    }

    /// The squares of `y` and of `terms`, multiplied out.
    void write_squares(const std::vector<std::size_t>& terms, std::size_t y)
    {
        std::erase_if(squares_, [&](const auto& entry) {
            if (!concerns(entry.first, terms, y)) return false;
            write({{entry.first.first, entry.second.first}, {entry.first.second, entry.second.second}}, entry.second);
            return true;
        });
    }

    static bool concerns(const Pair& pair, const std::vector<std::size_t>& terms, std::size_t y)
    {
        const auto is_one = [&](std::size_t k) { return k == y || std::ranges::find(terms, k) != terms.end(); };
        return is_one(pair.first) || is_one(pair.second);
    }

    /// The square of sum form_j v_j, multiplied out.
    void write(const Row& form, const WeightedSquare& square)
    {
        for (auto j = form.begin(); j != form.end(); ++j)
            for (auto k = j; k != form.end(); ++k)
                add(j->first, k->first, weigh(graph_, square, graph_.multiply(j->second, k->second)));
    }

    /// `y` acts through `heads` alone (see heads_of()), one or two of `terms`: m (g + e y)^2 leaves nothing behind, two
    /// terms leave a square (graph/elimination/eliminate_pair.hpp). False where the pivot is the constant 0.
    bool eliminate_through_heads(const std::vector<std::size_t>& heads, const std::vector<std::size_t>& terms,
                                 std::size_t y)
    {
        const auto forms = forms_of(graph_, hessian_, terms, y);
        if (heads.size() == 2) return eliminate_pair(heads[0], heads[1], forms.at(heads[0]), forms.at(heads[1]), y);
        const LinearForm& form = forms.at(heads[0]);
        const NodeId push = graph_.multiply(form.slope, entry(heads[0], heads[0]));
        static_cast<void>(take_row(heads[0]));
        const NodeId pivot = graph_.multiply(form.slope, push);
        if (graph_.is_zero(pivot)) return false;
        finish(y, pivot, {{&form, push}});
        return true;
    }

    /// Those of `terms` that stand in products, ascending; nothing where they are more than two, or where another
    /// variable than these enters the products.
    [[nodiscard]] std::optional<std::vector<std::size_t>> heads_of(const std::vector<std::size_t>& terms, std::size_t y)
    {
        std::vector<std::size_t> heads;
        for (const std::size_t term : terms)
            if (!rows_[term].empty()) heads.insert(heads.begin(), term);
        if (!rows_[y].empty() || heads.empty() || heads.size() > 2) return {};
        for (const std::size_t head : heads)
            for (const auto& [other, value] : rows_[head])
                if (other != heads.front() && other != heads.back()) return {};
        for (const auto& [pair, square] : squares_)
            if (pair != Pair{heads.front(), heads.back()} && concerns(pair, terms, y)) return {};
        return heads;
    }

    /// u = one, w = two.
    bool eliminate_pair(std::size_t u, std::size_t w, const LinearForm& one, const LinearForm& two, std::size_t y)
    {
        std::optional<WeightedSquare> square;
        if (const auto found = squares_.find({u, w}); found != squares_.end()) {
            square = found->second;
            squares_.erase(found);
        }
        const PairMatrix matrix{entry(u, u), entry(u, w), entry(w, w), square};
        static_cast<void>(take_row(u));
        static_cast<void>(take_row(w));
        const PairPivot pivot = pivot_of(graph_, matrix, one.slope, two.slope);
        if (graph_.is_zero(pivot.value)) return false;
        const NodeId reciprocal = finish(y, pivot.value, {{&one, pivot.pushes[0]}, {&two, pivot.pushes[1]}});
        leave({pivot.determinant, reciprocal, two.slope, graph_.negate(one.slope)}, one.rest, two.rest);
        return true;
    }

    /// The step of `y`; the multiplier of a variable is the sum of its coefficients times the pushes, over the pivot.
    NodeId finish(std::size_t y, NodeId pivot, const std::vector<std::pair<const LinearForm*, NodeId>>& pushes)
    {
        Row row;
        for (const auto& [form, push] : pushes)
            for (const auto& [variable, coefficient] : form->rest)
                add_to(graph_, row, variable, graph_.multiply(coefficient, push));
        const NodeId reciprocal = graph_.divide(graph_.constant(1), pivot);
        Terms terms;
        for (const auto& [variable, value] : row) terms.emplace_back(variable, graph_.multiply(value, reciprocal));
        result_.steps.push_back({y, std::move(terms), pivot});
        return reciprocal;
    }

    /// The square of first g_1 + second g_2: kept where these are two variables, else multiplied out.
    void leave(WeightedSquare square, const Row& one, const Row& two)
    {
        if (graph_.is_zero(square.numerator)) return;
        Row form;
        for (const auto& [rest, factor] : {std::pair{&one, square.first}, std::pair{&two, square.second}})
            for (const auto& [variable, coefficient] : *rest)
                add_to(graph_, form, variable, graph_.multiply(coefficient, factor));
        if (form.size() == 2) {
            const auto& [first, second] = std::pair{*form.begin(), *form.rbegin()};
            square.first = first.second;
            square.second = second.second;
            if (squares_.try_emplace({first.first, second.first}, square).second) return;
        }
        write(form, square);
    }

    void add(std::size_t i, std::size_t j, NodeId value)
    {
        if (graph_.is_zero(value)) return;
        const auto [place, fresh] = rows_[i].try_emplace(j, value);
        if (!fresh) place->second = graph_.add(place->second, value);
        const NodeId sum = place->second;
        if (graph_.is_zero(sum)) {
            rows_[i].erase(j);
            rows_[j].erase(i);
        } else {
            rows_[j][i] = sum;
        }
    }

    [[nodiscard]] NodeId entry(std::size_t i, std::size_t j)
    {
        const auto found = rows_[i].find(j);
        return found == rows_[i].end() ? graph_.constant(0) : found->second;
    }

    [[nodiscard]] Row take_row(std::size_t k)
    {
        Row row = std::move(rows_[k]);
        rows_[k].clear();
        for (const auto& [j, value] : row)
            if (j != k) rows_[j].erase(k);
        return row;
    }

    /// u = sum alpha_w w in u^T H u.
    void put_in(std::size_t u)
    {
        const Terms& terms = hessian_.definitions[u];
        const Row row = take_row(u);
        for (const auto& [j, value] : row) {
            if (j == u) continue;
            for (const auto& [operand, coefficient] : terms) {
                const NodeId product = graph_.multiply(coefficient, value);
                add(j, operand, j == operand ? graph_.multiply(graph_.constant(2), product) : product);
            }
        }
        const auto diagonal = row.find(u);
        if (diagonal == row.end()) return;
        for (std::size_t p = 0; p < terms.size(); ++p) {
            const NodeId product = graph_.multiply(terms[p].second, diagonal->second);
            for (std::size_t q = p; q < terms.size(); ++q)
                add(terms[p].first, terms[q].first, graph_.multiply(product, terms[q].second));
        }
    }

    /// All u = alpha_u y at once: H_jy = sum_u alpha_u H_ju, then H_yy = sum_u alpha_u H_uy, products that the rows of
    /// other terms share.
    void put_in_multiples(const std::vector<std::size_t>& multiples, std::size_t y)
    {
        const auto factor = [&](std::size_t u) { return hessian_.definitions[u][0].second; };
        NodeId diagonal = entry(y, y);
        for (const std::size_t u : multiples) {
            const NodeId own = entry(u, y);
            NodeId half = own;
            for (const std::size_t w : multiples) half = graph_.add(half, graph_.multiply(factor(w), entry(u, w)));
            diagonal = graph_.add(diagonal, graph_.multiply(factor(u), graph_.add(own, half)));
        }
        Row column;
        for (const std::size_t u : multiples)
            for (const auto& [j, value] : rows_[u]) {
                if (j == y || std::ranges::find(multiples, j) != multiples.end()) continue;
                add_to(graph_, column, j, graph_.multiply(factor(u), value));
            }
        for (const std::size_t u : multiples) static_cast<void>(take_row(u));
        for (const auto& [j, value] : column) add(j, y, value);
        rows_[y].erase(y);
        add(y, y, diagonal);
    }

    /// H_jk -= H_ja H_ak / H_aa; answers H_ja / H_aa.
    Terms multipliers(std::size_t a, NodeId pivot)
    {
        Row row = take_row(a);
        row.erase(a);
        if (row.empty()) return {};
        const NodeId reciprocal = graph_.divide(graph_.constant(1), pivot);
        const bool few = row.size() <= largest_early_products;
        Terms result;
        for (const auto& [j, value] : row) {
            const NodeId multiplier = graph_.multiply(value, reciprocal);
            for (const auto& [k, other] : row) {
                if (k < j) continue;
                const NodeId product = few ? graph_.multiply(graph_.multiply(value, other), reciprocal)
                                           : graph_.multiply(multiplier, other);
                add(j, k, graph_.negate(product));
            }
            result.emplace_back(j, multiplier);
        }
        return result;
    }

    Graph& graph_;
    const SparseHessian& hessian_;
    std::vector<Row> rows_; ///< H, both triangles
    std::vector<std::vector<std::size_t>> holders_;
    std::vector<bool> gone_;
    std::map<std::pair<std::size_t, std::size_t>, WeightedSquare> squares_; ///< H is `rows_` and these
    Elimination result_;
};

} // namespace

std::optional<Elimination> eliminate(Graph& graph, const SparseHessian& hessian)
{
    return Eliminator(graph, hessian).run();
}

// The right-hand side through the steps of an elimination, and the solution back through them.
namespace {

/// A variable that needs so many terms is split; of more the products would cost more than the wait.
constexpr std::size_t most_split_terms = 3;

/// From the last step to the first, z of every variable. Where a variable needs terms that wait for the one found just
/// before, z', it is written (what does not need z') - (slope) z': the next is one operation away from it.
class BackSubstitution {
  public:
    BackSubstitution(Graph& graph, const Elimination& elimination)
        : graph_(graph), elimination_(elimination), z_(elimination.is_term.size(), graph.constant(0))
    {
    }

    std::vector<NodeId> run(const std::vector<NodeId>& force)
    {
        for (std::size_t k = elimination_.steps.size(); k-- > 0;) {
            const Elimination::Step& step = elimination_.steps[k];
            if (elimination_.is_term[step.variable])
                define(step);
            else
                solve(step, force[step.variable]);
        }
        return std::move(z_);
    }

  private:
    /// A term as older + slope z'.
    struct Split {
        NodeId older = 0;
        NodeId slope = 0;
    };

    void define(const Elimination::Step& step)
    {
        NodeId value = graph_.constant(0);
        Split split{graph_.constant(0), graph_.constant(0)};
        for (const auto& [variable, factor] : step.terms) {
            value = graph_.add(value, graph_.multiply(factor, z_[variable]));
            const Split part = split_of(variable);
            split.older = graph_.add(split.older, graph_.multiply(factor, part.older));
            split.slope = graph_.add(split.slope, graph_.multiply(factor, part.slope));
        }
        z_[step.variable] = value;
        splits_[step.variable] = split;
    }

    void solve(const Elimination::Step& step, NodeId force)
    {
        NodeId value = graph_.multiply(force, graph_.divide(graph_.constant(1), step.pivot));
        NodeId slope = graph_.constant(0);
        const bool few = step.terms.size() <= most_split_terms;
        for (const auto& [variable, factor] : step.terms) {
            const Split part = few ? split_of(variable) : Split{z_[variable], graph_.constant(0)};
            value = graph_.subtract(value, graph_.multiply(factor, part.older));
            slope = graph_.add(slope, graph_.multiply(factor, part.slope));
        }
        z_[step.variable] = graph_.subtract(value, graph_.multiply(slope, last_));
        last_ = z_[step.variable];
        splits_.clear();
        splits_[step.variable] = {graph_.constant(0), graph_.constant(1)};
    }

    [[nodiscard]] Split split_of(std::size_t variable)
    {
        const auto found = splits_.find(variable);
        return found == splits_.end() ? Split{z_[variable], graph_.constant(0)} : found->second;
    }

    Graph& graph_;
    const Elimination& elimination_;
    std::vector<NodeId> z_;
    NodeId last_ = 0;                     ///< z'
    std::map<std::size_t, Split> splits_; ///< of z' and the terms defined since
};

} // namespace

std::vector<NodeId> solve_by(Graph& graph, const Elimination& elimination, std::span<const NodeId> right)
{
    if (right.size() != elimination.order) throw InternalError("solve_by() wants one entry of b for every variable");
    std::vector<NodeId> force(elimination.is_term.size(), graph.constant(0));
    std::copy(right.begin(), right.end(), force.begin());
    for (const Elimination::Step& step : elimination.steps)
        for (const auto& [variable, factor] : step.terms) {
            const NodeId product = graph.multiply(factor, force[step.variable]);
            force[variable] = elimination.is_term[step.variable] ? graph.add(force[variable], product)
                                                                 : graph.subtract(force[variable], product);
        }
    std::vector<NodeId> z = BackSubstitution(graph, elimination).run(force);
    z.resize(elimination.order);
    return z;
}

} // namespace lagen
