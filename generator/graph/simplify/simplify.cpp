// SPDX-License-Identifier: GPL-2.0-or-later
/// The portfolio: the outputs go through every strategy of graph/simplify/passes.cpp, the lightest form is kept.
#include "graph/simplify/simplify.hpp"

#include "graph/elimination/cut_solves.hpp"
#include "graph/simplify/passes.hpp"
#include "graph/simplify/probe_rounding.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace lagen {
namespace {

/// Beyond this the outputs stay as they are: the passes are quadratic in places.
constexpr std::size_t largest_graph = 200'000;

/// A form that is so many times heavier as written is not simplified to be compared.
constexpr double hopeless = 4;

/// An elimination in scalar operations takes the place of a factorisation, which compares its pivots with the matrix,
/// only where it saves this part of the weight.
constexpr double least_gain = 0.05;

/// What has been made so far; a form is counted in a copy of the graph, which stays as it would be without the
/// question.
OperationCount count_of(const Work& work)
{
    if (!work.form) return count_operations(work.graph, work.outputs);
    Graph copy = work.graph;
    const std::vector<NodeId> outputs = rebuild(*work.form, copy);
    return count_operations(copy, outputs);
}

std::vector<NodeId> factors_of(const Graph& graph, const std::vector<NodeId>& outputs)
{
    std::vector<NodeId> factors = reachable(graph, outputs);
    std::erase_if(factors, [&](NodeId id) { return graph.op(id) != Op::factor; });
    return factors;
}

/// What a strategy made of the outputs.
struct Candidate {
    std::vector<NodeId> outputs;
    std::vector<NodeId> source; ///< what was read as polynomials: the written outputs, or these with angles added
};

/// The written outputs and what every strategy makes of them.
class Portfolio {
  public:
    Portfolio(Graph& graph, const std::vector<NodeId>& written, SimplifyReport* report) : graph_(graph), report_(report)
    {
        keep({written, written}, {});
        for (const Choices strategy : strategies()) attempt(strategy);
        give_back_digits();
    }

    [[nodiscard]] const std::vector<Candidate>& candidates() const { return candidates_; }

    /// What rows of the matrices in `outputs` were divided by. A divisor of one is zero only where the matrix is
    /// singular as written, so all of them may be asked for whenever one is needed.
    [[nodiscard]] std::vector<NodeId> divisors_of(const std::vector<NodeId>& outputs) const
    {
        const bool divided = !std::ranges::includes(undivided_, factors_of(graph_, outputs));
        return divided ? std::vector<NodeId>(divisors_.begin(), divisors_.end()) : std::vector<NodeId>{};
    }

  private:
    void attempt(Choices strategy)
    {
        const auto first = std::ranges::find_if(passes(), [](const Pass& p) { return p.works_on != WorksOn::nodes; });
        const auto readings = static_cast<std::size_t>(first - passes().begin());
        try {
            std::optional<Work> work = read(strategy, passes().first(readings));
            if (!work || !run(*work, strategy, passes().subspan(readings))) return;
            std::vector<NodeId> outputs = rebuild(*work->form, graph_);
            const auto written = outputs.begin() + static_cast<std::ptrdiff_t>(work->outputs.size());
            const std::vector<NodeId> divisors(written, outputs.end());
            outputs.erase(written, outputs.end());
            keep({std::move(outputs), work->outputs}, divisors);
        } catch (const FormRefused&) {    // too large in this form
        } catch (const DivisionByZero&) { // a divisor vanishes identically: the outputs stay as written
        }
    }

    /// The outputs read as polynomials, once for all strategies that do so in one way; nothing where that is refused.
    const std::optional<Work>& read(Choices strategy, std::span<const Pass> readings)
    {
        Choices chosen = in_every_strategy;
        for (const Pass& pass : readings) chosen |= pass.choice & strategy;
        const auto [place, fresh] = read_.try_emplace(chosen);
        if (Work work{graph_, candidates_[0].outputs, {}}; fresh && run(work, strategy, readings))
            place->second.emplace(std::move(work));
        return place->second;
    }

    /// False where a guard says no.
    bool run(Work& work, Choices strategy, std::span<const Pass> part)
    {
        OperationCount before;
        if (report_ != nullptr) before = count_of(work);
        for (const Pass& pass : part) {
            if (!runs(pass, strategy)) continue;
            if (pass.guard != nullptr && !pass.guard(work)) return false;
            pass.apply(work);
            if (report_ == nullptr) continue;
            const OperationCount after = count_of(work);
            report_->passes.push_back({name_of(strategy), pass.name, before, after});
            before = after;
        }
        return true;
    }

    void keep(Candidate candidate, const std::vector<NodeId>& divisors)
    {
        divisors_.insert(divisors.begin(), divisors.end());
        for (const auto* outputs : {&candidate.source, &candidate.outputs}) {
            const std::vector<NodeId> factors = factors_of(graph_, *outputs);
            if (outputs == &candidate.source || divisors.empty()) undivided_.insert(factors.begin(), factors.end());
        }
        candidates_.push_back(std::move(candidate));
    }

    /// Outputs that lose digits become those of the source again.
    void give_back_digits()
    {
        std::map<std::vector<NodeId>, RoundingProbe> probes;
        for (auto& [outputs, source] : candidates_) {
            if (outputs == source) continue;
            const auto probe = probes.try_emplace(source, graph_, source).first;
            const std::vector<bool> keeps = probe->second.keeps_digits(outputs);
            for (std::size_t k = 0; k < outputs.size(); ++k)
                if (!keeps[k]) outputs[k] = source[k];
        }
    }

    Graph& graph_;
    SimplifyReport* report_; ///< may be null
    std::map<Choices, std::optional<Work>> read_;
    std::vector<Candidate> candidates_;
    std::set<NodeId> divisors_;
    std::set<NodeId> undivided_; ///< factorisations with rows as they were
};

/// Replaces single outputs of `best` by another candidate's where that makes the whole lighter.
void mix(const Graph& graph, std::vector<NodeId>& best, const std::vector<Candidate>& candidates)
{
    constexpr std::size_t largest_effort = 2'000'000; // nodes visited
    if (best.size() * candidates.size() * reachable(graph, best).size() > largest_effort) return;
    double weight = count_operations(graph, best).weight;
    for (std::size_t k = 0; k < best.size(); ++k)
        for (const Candidate& candidate : candidates) {
            const NodeId kept = best[k];
            if (candidate.outputs[k] == kept) continue;
            best[k] = candidate.outputs[k];
            const double tried = count_operations(graph, best).weight;
            if (tried < weight)
                weight = tried;
            else
                best[k] = kept;
        }
}

void tell(SimplifyReport* report, const Graph& graph, Stage stage, const std::vector<NodeId>& before,
          const std::vector<NodeId>& after)
{
    if (report != nullptr)
        report->passes.push_back(
            {to_text(stage), "", count_operations(graph, before), count_operations(graph, after), stage});
}

/// The forms of the outputs whose linear systems stay nodes.
std::vector<NodeId> simplify_pieces(Graph& graph, std::span<const NodeId> outputs, std::vector<NodeId>& divisors,
                                    SimplifyReport* report)
{
    const std::vector<NodeId> written(outputs.begin(), outputs.end());
    if (reachable(graph, outputs).size() > largest_graph) return written;
    const Portfolio portfolio(graph, written, report);
    std::vector<NodeId> best = std::ranges::min_element(portfolio.candidates(), {}, [&](const Candidate& candidate) {
                                   return count_operations(graph, candidate.outputs).weight;
                               })->outputs;
    tell(report, graph, Stage::lightest, written, best);
    mix(graph, best, portfolio.candidates());
    tell(report, graph, Stage::mixed, written, best);
    divisors = portfolio.divisors_of(best);
    return best;
}

/// Solved through the terms of remembered Hessians; empty where there are none.
std::vector<NodeId> eliminated(Graph& graph, std::span<const NodeId> outputs, std::vector<NodeId>& pivots,
                               SimplifyReport* report)
{
    const CutSolves cut(graph, outputs);
    if (cut.pieces().empty()) return {};
    const std::vector<NodeId> pieces = simplify_pieces(graph, cut.pieces(), pivots, report);
    std::vector<NodeId> joined = cut.join(pieces, pivots);
    if (!joined.empty()) tell(report, graph, Stage::eliminated, {outputs.begin(), outputs.end()}, joined);
    return joined;
}
std::vector<NodeId> choose_form(Graph& graph, std::span<const NodeId> outputs, std::vector<NodeId>& divisors,
                                SimplifyReport* report)
{
    std::vector<NodeId> pivots;
    std::vector<NodeId> sparse = eliminated(graph, outputs, pivots, report);
    if (sparse.empty()) return simplify_pieces(graph, outputs, divisors, report);
    const double weight = count_operations(graph, sparse).weight;
    if (count_operations(graph, outputs).weight < hopeless * weight) {
        std::vector<NodeId> factorised = simplify_pieces(graph, outputs, divisors, report);
        if (weight >= (1 - least_gain) * count_operations(graph, factorised).weight) return factorised;
    }
    divisors = std::move(pivots);
    return sparse;
}

} // namespace

std::vector<NodeId> simplify(Graph& graph, std::span<const NodeId> outputs)
{
    std::vector<NodeId> divisors;
    return simplify(graph, outputs, divisors);
}

std::vector<NodeId> simplify(Graph& graph, std::span<const NodeId> outputs, std::vector<NodeId>& divisors,
                             SimplifyReport* report)
{
    constexpr std::size_t terms_told = 10;
    std::vector<NodeId> result = choose_form(graph, outputs, divisors, report);
    if (report != nullptr) {
        report->written = count_operations(graph, outputs);
        report->kept = count_operations(graph, result);
        report->costliest = costliest_terms(graph, result, terms_told);
    }
    return result;
}

} // namespace lagen
