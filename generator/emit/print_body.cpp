// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/print_body.hpp"

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
            if (is_checked(pivot)) roots.push_back(pivot);
        plan_ = plan_body(graph_, roots);
        load_inputs();
        for (const NodeId id : plan_.order) print_node(id);
        for (const NodeId pivot : std::span(roots).subspan(request_.outputs.size())) {
            if (graph_.op(pivot) == Op::factor) continue; // checked where it stands
            body_.statements.push_back(fmt::format(
                "StatusOf<S>::fail(status, {} == S(0), Status::singular_mass_matrix);", spell_.at_least(1, pivot)));
            body_.has_status = true;
        }
        for (const NodeId id : request_.outputs) body_.values.push_back(spell_(id).text);
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

    void load_inputs()
    {
        for (const NodeId id : graph_.inputs()) {
            if (!plan_.used[id]) continue;
            spell_.name(id, request_.names.inputs.at(id));
            body_.inputs.push_back(id);
        }
    }

    std::string next_term() { return fresh(prefix_ + std::to_string(terms_++)); }

    void define(const std::string& name, const std::string& value)
    {
        body_.statements.push_back(fmt::format("const S {} = {};", name, value));
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
        body_.statements.push_back(
            fmt::format("const auto {} = {}{};", name, roots ? "square_roots" : "reciprocals", arguments_of(batch)));
        name_entries(batch.values, name);
    }

    /// The sines and cosines of one batch from one call.
    void print_angles(const Batch& batch)
    {
        if (batch.arguments.size() == 1) {
            const NodeId angle = batch.arguments[0];
            const auto [sine, cosine] = names_of_pair(angle);
            body_.statements.push_back(
                fmt::format("const auto [{}, {}] = sincos<S>({});", sine, cosine, spell_(angle).text));
            spell_.name(batch.values[0], sine);
            spell_.name(batch.cosines[0], cosine);
            return;
        }
        const std::string sines = fresh("sines");
        const std::string cosines = fresh("cosines");
        body_.statements.push_back(fmt::format("const auto [{}, {}] = sincos{};", sines, cosines, arguments_of(batch)));
        name_entries(batch.values, sines);
        name_entries(batch.cosines, cosines);
    }

    /// The Stumpff functions of one argument from one call, an entry an order; false where this one stands alone.
    bool print_family(NodeId id)
    {
        if (spell_.has_name(id)) return true;
        std::vector<NodeId> family;
        for (const NodeId node : plan_.order)
            if (graph_.op(node) == Op::stumpff && graph_.operands(node)[0] == graph_.operands(id)[0])
                family.push_back(node);
        if (family.size() < 2) return false;
        const auto [lowest, highest] =
            std::ranges::minmax_element(family, {}, [&](NodeId node) { return graph_.payload(node); });
        const std::uint32_t first = graph_.payload(*lowest);
        const std::string name = next_term();
        body_.statements.push_back(fmt::format("const auto {} = stumpff_orders<{}, {}, S>({});", name, first,
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
        return {graph_, spell_, body_.statements, [this](const std::string& wish) { return fresh(wish); }};
    }

    void print_factor_node(NodeId id)
    {
        const bool check = is_checked(id);
        const bool solved = std::ranges::any_of(
            plan_.order, [&](NodeId user) { return graph_.op(user) == Op::solve && graph_.operands(user)[0] == id; });
        factors_[id] = print_factor(context(), id, factors_.size(), check, solved);
        body_.has_status = body_.has_status || check;
        body_.has_pivoting = body_.has_pivoting || factors_[id].kind == PrintedFactor::Kind::pivoted;
    }

    void print_solve_node(NodeId id)
    {
        const std::size_t n = graph_.operands(id).size() - 1;
        std::vector<NodeId> components(n, id);
        std::vector<bool> wanted(n, false);
        for (NodeId user = id + 1; user < graph_.size(); ++user) {
            if (graph_.op(user) != Op::component || graph_.operands(user)[0] != id || !plan_.used[user]) continue;
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

std::vector<bool> depends_on(const Graph& graph, std::span<const NodeId> inputs)
{
    std::vector<bool> depends(graph.size(), false);
    for (const NodeId id : inputs) depends[id] = true;
    for (NodeId id = 0; id < graph.size(); ++id)
        for (const NodeId operand : graph.operands(id))
            if (depends[operand]) depends[id] = true;
    return depends;
}

Body print_body(const BodyRequest& request)
{
    return BodyPrinter(request).print();
}

} // namespace lagen
