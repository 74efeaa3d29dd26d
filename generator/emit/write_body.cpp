// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/write_body.hpp"

#include "emit/order_body.hpp"
#include "emit/unroll_solve.hpp"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <functional>
#include <queue>
#include <set>

namespace lagen {

namespace {

// Long function bodies in parts, since compilers take more than linear time for one long function. Values that a later
// part reads go through a workspace whose places are used again.

struct CutBody {
    std::vector<std::vector<BodyStep>> parts; ///< with loads, keeps and recalls put in
    std::size_t workspace = 0;                ///< places
};

/// A body of so many times the longest part is left whole: only beyond it do compilers take notably longer, and parts
/// cost a little, since what they hand on goes through memory.
constexpr std::size_t largest_whole = 5;

class Cutter {
  public:
    Cutter(const Graph& graph, const std::vector<BodyStep>& steps)
        : graph_(graph), steps_(steps), born_(graph.size(), 0), last_(graph.size(), 0)
    {
        for (std::size_t k = 0; k < steps.size(); ++k) {
            for (const NodeId id : steps[k].defines) born_[id] = k;
            for (const NodeId id : steps[k].needs) last_[id] = k;
        }
    }

    CutBody cut(std::size_t longest)
    {
        CutBody result;
        std::size_t begin = 0;
        for (const std::size_t end : places(longest)) {
            result.parts.push_back(part(begin, end));
            begin = end;
        }
        result.workspace = workspace_;
        return result;
    }

  private:
    /// Where parts end; the last of them is the number of steps.
    [[nodiscard]] std::vector<std::size_t> places(std::size_t longest) const
    {
        const std::size_t count = steps_.size();
        if (longest == 0 || count <= largest_whole * longest) return {count};
        const std::vector<std::size_t> crossing = count_crossing();
        std::vector<std::size_t> ends;
        std::size_t begin = 0;
        while (count - begin > longest) {
            std::size_t best = begin + longest;
            for (std::size_t k = begin + longest / 2; k <= begin + longest; ++k)
                if (crossing[k] < crossing[best]) best = k;
            while (best < count && crossing[best] >= forbidden) ++best;
            ends.push_back(best);
            begin = best;
        }
        if (begin < count) ends.push_back(count);
        return ends;
    }

    /// By step: how many values come from before it and are read from it on; no less than `forbidden` where a
    /// factorisation is one of them.
    [[nodiscard]] std::vector<std::size_t> count_crossing() const
    {
        std::vector<std::size_t> crossing(steps_.size() + 1, 0);
        std::vector<std::size_t> enter(steps_.size() + 1, 0);
        std::vector<std::size_t> leave(steps_.size() + 1, 0);
        for (const BodyStep& step : steps_)
            for (const NodeId id : step.defines) {
                if (last_[id] <= born_[id]) continue;
                const std::size_t weight = graph_.op(id) == Op::factor ? forbidden : 1;
                enter[born_[id] + 1] += weight;
                leave[last_[id] + 1] += weight;
            }
        std::size_t alive = 0;
        for (std::size_t k = 0; k < steps_.size(); ++k) crossing[k] = alive = alive + enter[k] - leave[k];
        return crossing;
    }

    /// The steps from `begin` to `end`; what they read is loaded or recalled before its first reader, what later parts
    /// read is kept after its definition.
    std::vector<BodyStep> part(std::size_t begin, std::size_t end)
    {
        std::vector<BodyStep> result;
        std::set<NodeId> known;
        for (std::size_t k = begin; k < end; ++k) {
            for (const NodeId id : steps_[k].needs) {
                if (!known.insert(id).second) continue;
                if (graph_.op(id) == Op::input) result.push_back({BodyStep::Kind::load, id, 0});
                if (const auto place = place_of_.find(id); place != place_of_.end())
                    result.push_back({BodyStep::Kind::recall, id, place->second});
            }
            result.push_back(steps_[k]);
            for (const NodeId id : steps_[k].defines) {
                known.insert(id);
                if (last_[id] >= end) result.push_back({BodyStep::Kind::keep, id, new_place(id)});
            }
        }
        release(end);
        return result;
    }

    std::size_t new_place(NodeId id)
    {
        std::size_t place = workspace_;
        if (free_.empty()) {
            ++workspace_;
        } else {
            place = free_.top();
            free_.pop();
        }
        return place_of_[id] = place;
    }

    /// The places of values that nothing from step `end` on reads.
    void release(std::size_t end)
    {
        std::erase_if(place_of_, [&](const auto& entry) {
            if (last_[entry.first] >= end) return false;
            free_.push(entry.second);
            return true;
        });
    }

    static constexpr std::size_t forbidden = std::size_t{1} << 32U;

    const Graph& graph_;
    const std::vector<BodyStep>& steps_;
    std::vector<std::size_t> born_; ///< by node: the step that computes it
    std::vector<std::size_t> last_; ///< by node: the last step that reads it
    std::map<NodeId, std::size_t> place_of_;
    std::priority_queue<std::size_t, std::vector<std::size_t>, std::greater<>> free_;
    std::size_t workspace_ = 0;
};

/// Parts of about `longest` steps or fewer, cut where few values are alive and never between a factorisation and a
/// solution by it. A body of up to five times that is left whole; 0 for `longest`: always.
CutBody cut_body(const Graph& graph, const std::vector<BodyStep>& steps, std::size_t longest)
{
    return Cutter(graph, steps).cut(longest);
}

/// "w", unless a name of the model is w with digits behind it; then the next that is free of such names.
std::string choose_prefix(const std::set<std::string>& taken)
{
    const auto clashes = [&](const std::string& prefix) {
        return std::ranges::any_of(taken, [&](const std::string& name) {
            return name.size() > prefix.size() && name.starts_with(prefix) &&
                   std::isdigit(static_cast<unsigned char>(name[prefix.size()])) != 0;
        });
    };
    std::string prefix = "w";
    for (const char* candidate : {"w", "u", "q", "k", "term", "shared"}) {
        prefix = candidate;
        if (!clashes(prefix)) return prefix;
    }
    while (clashes(prefix)) prefix += "_term";
    return prefix;
}

class BodyWriter {
  public:
    explicit BodyWriter(const BodyRequest& request)
        : request_(request), graph_(request.graph), expressions_(request.graph, request.type),
          taken_(request.names.taken), prefix_(choose_prefix(request.names.taken)),
          moves_(depends_on(request.graph, request.moving))
    {
    }

    Body write()
    {
        std::vector<NodeId> roots(request_.outputs.begin(), request_.outputs.end());
        for (const NodeId pivot : request_.pivots)
            if (is_checked(pivot)) roots.push_back(pivot); // a factorisation is checked where it stands
        CutBody cut = plan(roots, request_.terms);
        if (cut.parts.size() > 1 && !request_.terms.groups.groups.empty()) cut = plan(roots, {});
        name_inputs();
        body_.workspace = cut.workspace;
        body_.type = request_.type;
        for (const std::vector<BodyStep>& part : cut.parts) {
            body_.parts.emplace_back();
            for (const BodyStep& step : part) write_step(step);
        }
        return std::move(body_);
    }

  private:
    using Kind = Statement::Kind;

    CutBody plan(const std::vector<NodeId>& roots, const BodyTerms& terms)
    {
        plan_ = plan_body(graph_, roots, terms.groups, terms.kept);
        const auto checked = std::span(roots).subspan(request_.outputs.size());
        return cut_body(graph_,
                        order_body(graph_, plan_, {request_.outputs, checked, request_.arrangements, terms.kept}),
                        request_.longest_part);
    }

    [[nodiscard]] bool is_checked(NodeId id) const
    {
        if (request_.checking == Checking::none || graph_.is_constant(id)) return false;
        return moves_[id] == (request_.checking == Checking::state);
    }

    std::string fresh(const std::string& wish)
    {
        std::string name = wish;
        while (!taken_.insert(name).second) name += '_';
        return name;
    }

    std::string next_term() { return fresh(prefix_ + std::to_string(terms_++)); }

    void name_inputs()
    {
        for (const NodeId id : graph_.inputs()) {
            if (!plan_.used[id]) continue;
            expressions_.name(id, variable(request_.names.inputs.at(id)));
            body_.inputs.push_back(id);
        }
        body_.terms.resize(request_.terms.groups.groups.size());
        for (const auto& [group, name] : request_.terms.names) body_.terms[group] = name;
    }

    void add(Statement statement, const std::string& type)
    {
        statement.type = type;
        body_.parts.back().push_back(std::move(statement));
    }
    void add(Statement statement) { add(std::move(statement), request_.type); }

    void write_step(const BodyStep& step)
    {
        switch (step.kind) {
        case BodyStep::Kind::load: return add({.kind = Kind::load, .node = step.node});
        case BodyStep::Kind::define: return define_node(step.node);
        case BodyStep::Kind::check:
            if (graph_.op(step.node) != Op::factor)
                add({.kind = Kind::check, .expressions = {expressions_(step.node)}});
            return;
        case BodyStep::Kind::store:
            return add({.kind = Kind::store, .expressions = {expressions_(step.node)}, .index = step.index});
        case BodyStep::Kind::keep:
            return add({.kind = Kind::keep, .expressions = {expressions_(step.node)}, .index = step.index});
        case BodyStep::Kind::recall: return recall(step);
        }
    }

    /// Under its own name, where it has one (and is no entry of an array).
    void recall(const BodyStep& step)
    {
        const Expression known = expressions_(step.node);
        const std::string name = known.is_variable() && !known.entry ? known.name : next_term();
        add({.kind = Kind::recall, .names = {name}, .index = step.index});
        expressions_.name(step.node, variable(name));
    }

    Expression define(Expression value)
    {
        const std::string name = next_term();
        add({.kind = Kind::define, .names = {name}, .expressions = {std::move(value)}});
        return variable(name);
    }

    void define_node(NodeId id)
    {
        if (graph_.op(id) == Op::factor) return define_factor(id);
        if (graph_.op(id) == Op::solve) return define_solution(id);
        if (graph_.op(id) == Op::stumpff && define_family(id)) return;
        if (const auto batch = plan_.batch_of.find(id); batch != plan_.batch_of.end())
            return define_batch(plan_.batches[batch->second]);
        expressions_.name(id, define(needs_chain(graph_, id) ? chain(id) : expressions_.operation(id)));
    }

    void name_entries(const std::vector<NodeId>& nodes, const std::string& array)
    {
        for (std::size_t k = 0; k < nodes.size(); ++k)
            if (nodes[k] != no_node) expressions_.name(nodes[k], variable(array, k));
    }

    void define_batch(const Batch& batch)
    {
        if (batch.kind == Batch::Kind::terms) return define_terms(batch);
        std::vector<Expression> arguments;
        for (const NodeId argument : batch.arguments) arguments.push_back(expressions_(argument));
        if (batch.kind == Batch::Kind::angles) return define_angles(batch, std::move(arguments));
        const bool roots = batch.kind == Batch::Kind::roots;
        const std::string name = fresh(roots ? "roots" : "inverses");
        add({.kind = roots ? Kind::roots : Kind::reciprocals, .names = {name}, .expressions = std::move(arguments)});
        name_entries(batch.values, name);
    }

    /// v3 = v1 * v2, and v3_lanes where a lane of it is read by itself.
    void define_terms(const Batch& batch)
    {
        const AlikeTerms& group = request_.terms.groups.groups[batch.group];
        const NodeId first = group.lanes[0];
        Expression value{.op = graph_.op(first), .payload = graph_.payload(first)};
        if (group.is_inverse_cube) value = variable("inverse_cubes_of_roots");
        for (const TermOperand& operand : group.operands) value.operands.push_back(vector_of(operand, batch));
        std::string& name = body_.terms[batch.group];
        name = fresh(fmt::format("v{}", batch.group));
        Statement statement{.kind = Kind::terms, .names = {name}, .expressions = {std::move(value)}};
        if (batch.taken_apart) statement.names.push_back(fresh(name + "_lanes"));
        name_entries(group.lanes, statement.names.back());
        add(std::move(statement));
    }

    [[nodiscard]] Expression vector_of(const TermOperand& operand, const Batch& batch) const
    {
        if (operand.group) return variable(body_.terms[*operand.group]);
        if (operand.nodes.size() == 1) return expressions_(operand.nodes[0]);
        Expression gathered = variable(fmt::format("Terms<S, {}>::of", batch.values.size()));
        for (const NodeId id : operand.nodes) gathered.operands.push_back(expressions_(id));
        return gathered;
    }

    /// The sines and cosines of one batch: sin_x and cos_x of one angle x that is an input, two further terms of
    /// another.
    void define_angles(const Batch& batch, std::vector<Expression> angles)
    {
        const bool several = angles.size() > 1;
        const NodeId angle = batch.arguments[0];
        const bool input = graph_.op(angle) == Op::input;
        const auto name_of = [&](const char* function, const char* array) {
            if (several) return fresh(array);
            return input ? fresh(std::string(function) + request_.names.inputs.at(angle)) : next_term();
        };
        const std::string sine = name_of("sin_", "sines");
        const std::string cosine = name_of("cos_", "cosines");
        add({.kind = Kind::angles, .names = {sine, cosine}, .expressions = std::move(angles)});
        if (several) {
            name_entries(batch.values, sine);
            return name_entries(batch.cosines, cosine);
        }
        expressions_.name(batch.values[0], variable(sine));
        expressions_.name(batch.cosines[0], variable(cosine));
    }

    /// The Stumpff functions of one argument, an entry an order; false where this one stands alone.
    bool define_family(NodeId id)
    {
        const std::vector<NodeId> family = plan_.family_of(graph_, id);
        if (family.size() < 2) return false;
        const auto [lowest, highest] =
            std::ranges::minmax_element(family, {}, [&](NodeId node) { return graph_.payload(node); });
        const std::uint32_t first = graph_.payload(*lowest);
        const std::string name = next_term();
        add({.kind = Kind::stumpff,
             .names = {name},
             .expressions = {expressions_(graph_.operands(id)[0])},
             .index = first,
             .last = graph_.payload(*highest)});
        for (const NodeId node : family) expressions_.name(node, variable(name, graph_.payload(node) - first));
        return true;
    }

    /// b^n by squares, a statement each; answers the last product.
    Expression chain(NodeId id)
    {
        const auto exponent = static_cast<std::int32_t>(graph_.payload(id));
        auto rest = static_cast<std::uint32_t>(exponent < 0 ? -static_cast<std::int64_t>(exponent) : exponent);
        Expression square = expressions_(graph_.operands(id)[0]);
        std::optional<Expression> product;
        for (; rest > 0; rest >>= 1U) {
            if ((rest & 1U) != 0) product = product ? operation(Op::multiply, *product, square) : square;
            if (rest == 1) break;
            square = define(operation(Op::multiply, square, square));
        }
        return exponent > 0 ? *product : operation(Op::divide, literal(1), *product);
    }

    [[nodiscard]] SolveContext context(const std::string& type)
    {
        return {graph_, expressions_, [this, type](Statement statement) { add(std::move(statement), type); },
                [this](const std::string& wish) { return fresh(wish); }};
    }

    void define_factor(NodeId id)
    {
        factors_[id] = unroll_factor(context("S"), id, factors_.size(), is_checked(id), plan_.users.contains(id));
    }

    void define_solution(NodeId id)
    {
        const std::size_t n = graph_.operands(id).size() - 1;
        std::vector<NodeId> components(n, id);
        std::vector<bool> wanted(n, false);
        const auto users = plan_.users.find(id);
        for (const NodeId user : users == plan_.users.end() ? std::vector<NodeId>{} : users->second) {
            wanted[graph_.payload(user)] = true;
            components[graph_.payload(user)] = user;
        }
        const UnrolledFactor& factor = factors_.at(graph_.operands(id)[0]);
        const std::vector<Expression> values = unroll_solution(context(request_.type), factor, id, solves_++, wanted);
        for (std::size_t k = 0; k < n; ++k)
            if (wanted[k]) expressions_.name(components[k], values[k]);
    }

    const BodyRequest& request_;
    const Graph& graph_;
    NodeExpressions expressions_;
    std::set<std::string> taken_;
    std::string prefix_;
    std::vector<bool> moves_;
    BodyPlan plan_;
    Body body_;
    std::map<NodeId, UnrolledFactor> factors_;
    std::size_t terms_ = 0;
    std::size_t solves_ = 0;
};

} // namespace

Body write_body(const BodyRequest& request)
{
    return BodyWriter(request).write();
}

} // namespace lagen
