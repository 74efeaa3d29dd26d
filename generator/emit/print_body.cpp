// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/print_body.hpp"

#include "emit/cut_body.hpp"
#include "emit/print_solve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace lagen {

namespace {

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

class BodyPrinter {
  public:
    explicit BodyPrinter(const BodyRequest& request)
        : request_(request), graph_(request.graph), spell_(request.graph), taken_(request.names.taken),
          prefix_(choose_prefix(request.names.taken)), moves_(depends_on(request.graph, request.moving))
    {
    }

    Body print()
    {
        std::vector<NodeId> roots(request_.outputs.begin(), request_.outputs.end());
        for (const NodeId pivot : request_.pivots)
            if (is_checked(pivot)) roots.push_back(pivot); // a factorisation is checked where it stands
        plan_ = plan_body(graph_, roots);
        name_inputs();
        const std::vector<BodyStep> steps =
            order_body(graph_, plan_,
                       {request_.outputs, std::span(roots).subspan(request_.outputs.size()), request_.arrangements});
        const CutBody cut = cut_body(graph_, plan_, steps, request_.longest_part);
        body_.workspace = cut.workspace;
        for (const std::vector<BodyStep>& part : cut.parts) {
            body_.parts.emplace_back();
            for (const BodyStep& step : part) print_step(step);
            body_.has_status = body_.has_status || body_.parts.back().has_status;
        }
        body_.functions = spell_.functions();
        return std::move(body_);
    }

  private:
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

    void name_inputs()
    {
        for (const NodeId id : graph_.inputs()) {
            if (!plan_.used[id]) continue;
            spell_.name(id, request_.names.inputs.at(id));
            body_.inputs.push_back(id);
        }
    }

    void add_line(BodyLine line) { body_.parts.back().lines.push_back(std::move(line)); }
    void add_statement(std::string text) { add_line({BodyLine::Kind::statement, 0, std::move(text)}); }

    void print_step(const BodyStep& step)
    {
        switch (step.kind) {
        case BodyStep::Kind::load: return add_line({BodyLine::Kind::load, step.node, ""});
        case BodyStep::Kind::define: return print_node(step.node);
        case BodyStep::Kind::check: return print_check(step.node);
        case BodyStep::Kind::store: return add_line({BodyLine::Kind::store, step.index, spell_(step.node).text});
        case BodyStep::Kind::keep:
            return add_statement(fmt::format("work[{}] = {};", step.index, spell_(step.node).text));
        case BodyStep::Kind::recall: return print_recall(step);
        }
    }

    void print_check(NodeId pivot)
    {
        if (graph_.op(pivot) == Op::factor) return;
        add_statement(fmt::format("StatusOf<S>::fail(status, {} == S(0), Status::singular_mass_matrix);",
                                  spell_.at_least(1, pivot)));
        body_.parts.back().has_status = true;
    }

    /// Under its own name, where that is a name (and no entry of an array).
    void print_recall(const BodyStep& step)
    {
        std::string name = spell_(step.node).text;
        if (name.find_first_of("[( ") != std::string::npos) name = next_term();
        define(name, fmt::format("work[{}]", step.index));
        spell_.name(step.node, name);
    }

    std::string next_term() { return fresh(prefix_ + std::to_string(terms_++)); }

    void define(const std::string& name, const std::string& value)
    {
        add_statement(fmt::format("const S {} = {};", name, value));
    }

    void print_node(NodeId id)
    {
        if (graph_.op(id) == Op::factor) return print_factor_node(id);
        if (graph_.op(id) == Op::solve) return print_solve_node(id);
        if (graph_.op(id) == Op::stumpff && print_family(id)) return;
        if (const auto batch = plan_.batch_of.find(id); batch != plan_.batch_of.end())
            return print_batch(plan_.batches[batch->second]);
        const std::string value = needs_chain(graph_, id) ? print_chain(id) : spell_.operation(id).text;
        const std::string name = next_term();
        define(name, value);
        spell_.name(id, name);
    }

    /// sin_x and cos_x where x is an input, else two further terms.
    std::pair<std::string, std::string> names_of_pair(NodeId angle)
    {
        if (graph_.op(angle) != Op::input) {
            const std::string sine = next_term();
            return {sine, next_term()};
        }
        const std::string& name = request_.names.inputs.at(angle);
        const std::string sine = fresh("sin_" + name);
        return {sine, fresh("cos_" + name)};
    }

    /// "<S, K>({a, b, ..})": the K arguments of a batch.
    std::string arguments_of(const Batch& batch)
    {
        std::string text;
        for (const NodeId argument : batch.arguments) text += (text.empty() ? "" : ", ") + spell_(argument).text;
        return fmt::format("<S, {}>({{{}}})", batch.arguments.size(), text);
    }

    void name_entries(const std::vector<NodeId>& nodes, const std::string& array)
    {
        for (std::size_t k = 0; k < nodes.size(); ++k)
            if (nodes[k] != no_node) spell_.name(nodes[k], fmt::format("{}[{}]", array, k));
    }

    void print_batch(const Batch& batch)
    {
        if (batch.kind == Batch::Kind::angles) return print_angles(batch);
        const bool roots = batch.kind == Batch::Kind::roots;
        const std::string name = fresh(roots ? "roots" : "inverses");
        add_statement(
            fmt::format("const auto {} = {}{};", name, roots ? "square_roots" : "reciprocals", arguments_of(batch)));
        name_entries(batch.values, name);
    }

    /// The sines and cosines of one batch from one call.
    void print_angles(const Batch& batch)
    {
        if (batch.arguments.size() == 1) {
            const NodeId angle = batch.arguments[0];
            const auto [sine, cosine] = names_of_pair(angle);
            add_statement(fmt::format("const auto [{}, {}] = sincos<S>({});", sine, cosine, spell_(angle).text));
            spell_.name(batch.values[0], sine);
            spell_.name(batch.cosines[0], cosine);
            return;
        }
        const std::string sines = fresh("sines");
        const std::string cosines = fresh("cosines");
        add_statement(fmt::format("const auto [{}, {}] = sincos{};", sines, cosines, arguments_of(batch)));
        name_entries(batch.values, sines);
        name_entries(batch.cosines, cosines);
    }

    /// The Stumpff functions of one argument from one call, an entry an order; false where this one stands alone.
    bool print_family(NodeId id)
    {
        const std::vector<NodeId> family = plan_.family_of(graph_, id);
        if (family.size() < 2) return false;
        const auto [lowest, highest] =
            std::ranges::minmax_element(family, {}, [&](NodeId node) { return graph_.payload(node); });
        const std::uint32_t first = graph_.payload(*lowest);
        const std::string name = next_term();
        add_statement(fmt::format("const auto {} = stumpff_orders<{}, {}, S>({});", name, first,
                                  graph_.payload(*highest), spell_(graph_.operands(id)[0]).text));
        for (const NodeId node : family) spell_.name(node, fmt::format("{}[{}]", name, graph_.payload(node) - first));
        return true;
    }

    /// b^n by squares, a statement each; answers the last product.
    std::string print_chain(NodeId id)
    {
        const auto exponent = static_cast<std::int32_t>(graph_.payload(id));
        auto rest = static_cast<std::uint32_t>(exponent < 0 ? -static_cast<std::int64_t>(exponent) : exponent);
        std::string square = spell_.at_least(5, graph_.operands(id)[0]);
        std::string product;
        for (; rest > 0; rest >>= 1U) {
            if ((rest & 1U) != 0) product = product.empty() ? square : product + " * " + square;
            if (rest == 1) break;
            const std::string name = next_term();
            define(name, square + " * " + square);
            square = name;
        }
        return exponent > 0 ? product : fmt::format("S(1) / ({})", product);
    }

    [[nodiscard]] SolveContext context()
    {
        return {graph_, spell_, [this](std::string text) { add_statement(std::move(text)); },
                [this](const std::string& wish) { return fresh(wish); }};
    }

    void print_factor_node(NodeId id)
    {
        const bool check = is_checked(id);
        factors_[id] = print_factor(context(), id, factors_.size(), check, plan_.users.contains(id));
        body_.parts.back().has_status = body_.parts.back().has_status || check;
        body_.has_pivoting = body_.has_pivoting || factors_[id].kind == PrintedFactor::Kind::pivoted;
    }

    void print_solve_node(NodeId id)
    {
        const std::size_t n = graph_.operands(id).size() - 1;
        std::vector<NodeId> components(n, id);
        std::vector<bool> wanted(n, false);
        const auto users = plan_.users.find(id);
        for (const NodeId user : users == plan_.users.end() ? std::vector<NodeId>{} : users->second) {
            wanted[graph_.payload(user)] = true;
            components[graph_.payload(user)] = user;
        }
        const PrintedFactor& factor = factors_.at(graph_.operands(id)[0]);
        const std::vector<std::string> names = print_solution(context(), factor, id, solves_++, wanted);
        for (std::size_t k = 0; k < n; ++k)
            if (wanted[k]) spell_.name(components[k], names[k]);
    }

    const BodyRequest& request_;
    const Graph& graph_;
    Speller spell_;
    std::set<std::string> taken_;
    std::string prefix_;
    std::vector<bool> moves_;
    BodyPlan plan_;
    Body body_;
    std::map<NodeId, PrintedFactor> factors_;
    std::size_t terms_ = 0;
    std::size_t solves_ = 0;
};

} // namespace

Body print_body(const BodyRequest& request)
{
    return BodyPrinter(request).print();
}

} // namespace lagen
