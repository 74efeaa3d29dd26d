// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/print_series.hpp"

#include "emit/print_function.hpp"
#include "emit/spell.hpp"
#include "text/comma_list.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

namespace {

/// True where a variable of `names` stands in the expression.
bool mentions(const Expression& expression, const std::set<std::string>& names)
{
    if (expression.is_variable() && names.contains(expression.name)) return true;
    return std::ranges::any_of(expression.operands, [&](const Expression& each) { return mentions(each, names); });
}

/// One body for the first coefficients and for all higher orders: what depends on no coefficient of order k stands
/// before the loop. Of a rate, they are fed back into the curve; other functions have a series of their own.
class SeriesPrinter {
  public:
    SeriesPrinter(TextBlock& out, const KernelModule& module, const ModuleNames& names, const Kernel& kernel)
        : out_(out), module_(module), names_(names), kernel_(kernel), series_(*kernel.recurrence),
          locals_(names.locals), is_rate_(kernel.outputs[0].role == ArrayRole::tangent),
          outputs_(kernel.outputs[0].entries.size()), lanes_(series_.curve.size() - 1), x_(fresh("x")),
          y_(is_rate_ ? x_ : fresh("y")), order_(fresh("order")),
          k_(fresh("k")), products_{"LowerSums", fresh("sums"), fresh("lower"), {}}, squares_{"LowerSquares",
                                                                                              fresh("squares"),
                                                                                              fresh("lower_squares"),
                                                                                              {}},
          share_(fresh("share")), next_(fresh("next")), unit_(fresh("unit")),
          carries_(is_rate_ && lanes_ <= most_carried)
    {
        find_terms();
        name_late(series_.order, fmt::format("S({})", k_));
        if (carries_) now_ = fresh("now"), after_ = fresh("after");
        const std::string row = carries_ ? now_ : fmt::format("{}[{}]", x_, k_);
        for (std::size_t i = 0; i < lanes_; ++i) name_late(series_.curve[i], fmt::format("{}[{}]", row, i));
        name_late(series_.curve[lanes_], fmt::format("({} == 1 ? {} : S(0))", k_, unit_));
        sort_pairs();
        for (const auto* group : {&products_, &squares_})
            for (std::size_t m = 0; m < group->pairs.size(); ++m)
                name_late(series_.sums[group->pairs[m]], sum_text(*group, m));
        for (const TermSums& sums : term_sums_)
            for (std::size_t m = 0; m < sums.groups.size(); ++m) {
                const std::string name = fmt::format("{}[{}]", sums.values, m);
                late_.insert(name);
                terms_.names[sums.groups[m]] = name;
                const std::vector<NodeId>& lanes = group_of(sums.groups[m]).lanes;
                for (std::size_t l = 0; l < lanes.size(); ++l) name_late(lanes[l], fmt::format("{}[{}]", name, l));
            }
    }

    Includes print()
    {
        const Body body = split_body();
        out_.comment("Sums over lower orders that a coefficient takes.");
        out_.line(fmt::format("static constexpr int {}_sums = {};", kernel_.name, series_.sums.size()));
        out_.blank();
        for (const std::string& line : kernel_.documentation) out_.comment(line);
        if (!term_sums_.empty()) out_.comment(about_terms);
        out_.comment(fmt::format(
            "{}[k][i], k <= order <= most: unit^k (d/dt)^k / k! of entry i; a power of two as the unit is exact.", y_));
        out_.line("template <int most>");
        const FunctionRequest request = request_for([this](std::size_t i, const std::string& value) {
            return fmt::format("{}[{}][{}] = {};", y_, is_rate_ ? 1 : 0, i, value);
        });
        std::string arguments = fmt::format("{}, int {}", arguments_of(body, request), order_);
        if (!is_rate_) arguments += fmt::format(", const TaylorSeries<S, {}, most>& {}", lanes_, x_);
        arguments += fmt::format(", TaylorSeries<S, {}, most>& {}, [[maybe_unused]] S {} = S(1)", outputs_, y_, unit_);
        open_block(out_, fmt::format("[[nodiscard]] status_t<S> {}({}) const noexcept", kernel_.name, arguments));
        for (std::size_t i = 0; i < lanes_ && is_rate_; ++i) out_.line(fmt::format("{}[0][{}] = s[{}];", x_, i, i));
        const bool has_status = print_lines(out_, body, request);
        if (is_rate_) out_.line(fmt::format("for (S& {0} : {1}[1]) {0} *= {2};", next_, y_, unit_));
        print_loop();
        out_.line(has_status ? "return status;" : "return StatusOf<S>::good();");
        close_block(out_);
        Includes includes = includes_of(body);
        includes.insert("lagen/series.hpp");
        if (!term_sums_.empty()) includes.insert("lagen/lanes/terms.hpp");
        return includes;
    }

  private:
    /// Sums that are made at once.
    struct Sums {
        const char* type = "";
        std::string object, values;
        std::vector<std::size_t> pairs; ///< among those of the recurrence
    };

    /// Sums of groups of so many terms, made at once from the series of other groups.
    struct TermSums {
        std::string object, values;
        std::vector<std::size_t> groups; ///< the sums
        std::vector<TermOperand> series; ///< the factors, each once
    };

    /// A row of so many coefficients stays in registers from one order to the next: read back from memory, each of them
    /// waits for its store.
    static constexpr std::size_t most_carried = 8;

    [[nodiscard]] const AlikeTerms& group_of(std::size_t k) const { return terms_.groups.groups[k]; }

    /// Groups of alike terms among the first coefficients and all others, the sums in groups by their lanes.
    void find_terms()
    {
        std::vector<NodeId> roots = nodes_of(kernel_);
        roots.insert(roots.end(), series_.outputs.begin(), series_.outputs.end());
        roots.insert(roots.end(), kernel_.checks->pivots.begin(), kernel_.checks->pivots.end());
        TermRequest request{roots, families_of(module_), {}};
        for (const std::vector<NodeId>& family : families_of(module_)) {
            std::vector<NodeId>& coefficients = request.families.emplace_back();
            const std::vector<Quantity> lanes = lanes_of(module_);
            for (std::size_t i = 0; i < lanes.size(); ++i)
                if (std::ranges::find(family, lanes[i].input) != family.end()) coefficients.push_back(series_.curve[i]);
        }
        std::vector<NodeId> kinds[2]; // sums, and means
        for (std::size_t m = 0; m < series_.sums.size(); ++m) {
            kinds[series_.are_means[m] ? 1 : 0].push_back(series_.sums[m]);
            request.sums[series_.sums[m]] = series_.pairs[m];
        }
        request.families.insert(request.families.end(), std::begin(kinds), std::end(kinds));
        terms_.groups = group_terms(*module_.graph, request);
        std::map<std::size_t, TermSums> by_lanes;
        for (std::size_t k = 0; k < terms_.groups.groups.size(); ++k) {
            const AlikeTerms& group = group_of(k);
            if (!request.sums.contains(group.lanes[0])) continue;
            TermSums& sums = by_lanes[group.lanes.size()];
            sums.groups.push_back(k);
            for (const TermOperand& factor : group.operands) {
                if (std::ranges::find(sums.series, factor) != sums.series.end()) continue;
                sums.series.push_back(factor);
                if (!factor.group) continue;
                const std::vector<NodeId>& lanes = group_of(*factor.group).lanes;
                terms_.kept.insert(terms_.kept.end(), lanes.begin(), lanes.end());
            }
        }
        for (auto& [lanes, sums] : by_lanes) {
            sums.object = fresh("series");
            sums.values = fresh("lower_terms");
            term_sums_.push_back(std::move(sums));
        }
    }

    /// Squares take half the terms, and half the room; but a few of them ride along where products leave lanes of a
    /// vector register idle.
    void sort_pairs()
    {
        constexpr std::size_t widest = 8;
        std::vector<std::size_t> squares;
        for (std::size_t m = 0; m < series_.pairs.size(); ++m)
            if (!terms_.groups.contains(series_.sums[m])) {
                (series_.pairs[m][0] == series_.pairs[m][1] ? squares : products_.pairs).push_back(m);
                single_.push_back(m);
            }
        const std::size_t idle = (widest - products_.pairs.size() % widest) % widest;
        (squares.size() <= idle ? products_ : squares_)
            .pairs.insert((squares.size() <= idle ? products_ : squares_).pairs.end(), squares.begin(), squares.end());
    }

    std::string fresh(const std::string& wish)
    {
        std::string name = wish;
        while (!locals_.taken.insert(name).second) name += '_';
        return name;
    }

    [[nodiscard]] std::string sum_text(const Sums& group, std::size_t m) const
    {
        const std::string sum = fmt::format("{}[{}]", group.values, m);
        return series_.are_means[group.pairs[m]] ? fmt::format("({} * {})", share_, sum) : sum;
    }

    void name_late(NodeId input, std::string text)
    {
        late_.insert(text);
        locals_.inputs[input] = std::move(text);
    }

    [[nodiscard]] FunctionRequest request_for(std::function<std::string(std::size_t, const std::string&)> store) const
    {
        return {module_, names_, kernel_.name, true, kernel_.inputs, {}, std::move(store)};
    }

    /// Rates, their coefficients of order k, both sides of the pairs, and values of order 0 that the loop reads.
    std::vector<NodeId> outputs()
    {
        std::vector<NodeId> nodes = nodes_of(kernel_);
        std::vector<NodeId> late = series_.outputs;
        for (const std::size_t side : {0U, 1U})
            for (const std::size_t m : single_) late.push_back(series_.pairs[m][side]);
        for (const TermSums& sums : term_sums_)
            for (const TermOperand& factor : sums.series)
                late.insert(late.end(), factor.nodes.begin(), factor.nodes.end());
        nodes.insert(nodes.end(), late.begin(), late.end());
        last_late_ = nodes.size();
        std::vector<NodeId> inputs = series_.curve;
        inputs.insert(inputs.end(), series_.sums.begin(), series_.sums.end());
        inputs.push_back(series_.order);
        const std::vector<bool> moves = depends_on(*module_.graph, inputs);
        std::set<NodeId> read;
        std::vector<NodeId> computed = late;
        computed.insert(computed.end(), terms_.kept.begin(), terms_.kept.end());
        for (const NodeId id : reachable(*module_.graph, computed))
            if (moves[id])
                for (const NodeId operand : module_.graph->operands(id))
                    if (!moves[operand] && kind_is_computed(operand) && !terms_.groups.contains(operand))
                        read.insert(operand);
        nodes.insert(nodes.end(), read.begin(), read.end());
        return nodes;
    }

    [[nodiscard]] bool kind_is_computed(NodeId id) const
    {
        return !module_.graph->operands(id).empty() && module_.graph->op(id) != Op::factor;
    }

    /// The body before the loop; that of the loop goes to `loop_`.
    Body split_body()
    {
        const std::vector<NodeId> nodes = outputs();
        Body body = write_body(
            {*module_.graph, locals_, nodes, kernel_.checks->pivots, names_.moving, Checking::state, {}, 0, terms_});
        names_of_groups_ = body.terms;
        BodyPart early;
        for (Statement& statement : body.parts.front()) {
            using Kind = Statement::Kind;
            const auto is_late = [&](const Expression& each) { return mentions(each, late_); };
            const bool late = statement.kind != Kind::load && std::ranges::any_of(statement.expressions, is_late);
            const bool stores_late =
                statement.kind == Kind::store && statement.index >= outputs_ && statement.index < last_late_;
            if (statement.kind == Kind::store && statement.index >= last_late_) continue;
            if (late && statement.kind != Kind::store)
                late_.insert(statement.names.begin(),
                             statement.kind == Kind::solve ? statement.names.begin() + 1 : statement.names.end());
            (late || stores_late ? loop_ : early).push_back(std::move(statement));
        }
        body.parts = {std::move(early)};
        return body;
    }

    void print_loop()
    {
        for (const TermSums& sums : term_sums_)
            out_.line(fmt::format("TermSeries<S, {}, {}, most> {};", group_of(sums.groups[0]).lanes.size(),
                                  sums.series.size(), sums.object));
        for (const Sums* sums : {&products_, &squares_})
            if (!sums->pairs.empty())
                out_.line(fmt::format("{}<S, {}, most> {};", sums->type, sums->pairs.size(), sums->object));
        if (carries_) out_.line(fmt::format("auto {0} = {1}[1], {2} = {0};", now_, x_, after_));
        out_.line(fmt::format("for (int {0} = 1; {0} {2} {1}; ++{0}) {{", k_, order_, is_rate_ ? "<" : "<="));
        out_.indent(1);
        for (const Sums* sums : {&products_, &squares_})
            if (!sums->pairs.empty()) out_.line(fmt::format("const auto {} = {}({});", sums->values, sums->object, k_));
        if (std::ranges::find(series_.are_means, true) != series_.are_means.end())
            out_.line(fmt::format("const OneOver<S> {}({});", share_, k_));
        if (is_rate_) out_.line(fmt::format("const OneOver<S> {}({} + 1, {});", next_, k_, unit_));
        for (const TermSums& sums : term_sums_) print_term_sums(sums);
        std::vector<std::string> factors(last_late_ - 2 * outputs_);
        for (const Statement& statement : loop_) {
            if (statement.kind != Statement::Kind::store) {
                for (const std::string& line : spell(statement)) out_.line(line);
                continue;
            }
            const std::size_t place = statement.index - outputs_;
            const Expression& value = statement.expressions[0];
            if (place >= outputs_)
                factors[place - outputs_] = spell(value).text;
            else if (is_rate_)
                out_.line(fmt::format("{}[{}] = {};", carries_ ? after_ : fmt::format("{}[{} + 1]", y_, k_), place,
                                      spell(operation(Op::multiply, variable(next_), value)).text));
            else
                out_.line(fmt::format("{}[{}][{}] = {};", y_, k_, place, spell(value).text));
        }
        keep(products_, 2, factors);
        keep(squares_, 1, factors);
        std::size_t used = 2 * single_.size();
        for (const TermSums& sums : term_sums_) keep(sums, factors, used);
        if (carries_) out_.line(fmt::format("{}[{} + 1] = {} = {};", x_, k_, now_, after_));
        close_block(out_);
    }

    void keep(const Sums& sums, std::size_t sides, const std::vector<std::string>& factors)
    {
        if (sums.pairs.empty()) return;
        for (std::size_t k = 0; k < sides; ++k) {
            std::vector<std::string> entries;
            for (const std::size_t m : sums.pairs) {
                const auto place = std::ranges::lower_bound(single_, m) - single_.begin();
                entries.push_back(factors[k * single_.size() + static_cast<std::size_t>(place)]);
            }
            if (k > 0) out_.indent(2);
            out_.list(k == 0 ? fmt::format("{}.keep({}, {{", sums.object, k_) : "{", entries,
                      k + 1 == sides ? "});" : "},");
            if (k > 0) out_.indent(-2);
        }
    }

    void keep(const TermSums& sums, const std::vector<std::string>& factors, std::size_t& used)
    {
        const std::size_t lanes = group_of(sums.groups[0]).lanes.size();
        std::vector<std::string> series;
        for (const TermOperand& factor : sums.series) {
            if (factor.group) {
                series.push_back(names_of_groups_[*factor.group]);
                continue;
            }
            std::vector<std::string> entries;
            for (std::size_t l = 0; l < lanes; ++l)
                entries.push_back(factors[used + (factor.nodes.size() == 1 ? 0 : l)]);
            used += factor.nodes.size();
            series.push_back(fmt::format("Terms<S, {}>::of({})", lanes, comma_list(entries)));
        }
        out_.list(fmt::format("{}.keep({}, {{", sums.object, k_), series, "});");
    }

    /// Which series are multiplied, pair by pair; then the means are divided by k.
    void print_term_sums(const TermSums& sums)
    {
        std::vector<std::string> pairs;
        for (const std::size_t k : sums.groups)
            for (const TermOperand& factor : group_of(k).operands)
                pairs.push_back(std::to_string(std::ranges::find(sums.series, factor) - sums.series.begin()));
        const auto is_mean = [&](std::size_t k) {
            const auto place = std::ranges::find(series_.sums, group_of(k).lanes[0]) - series_.sums.begin();
            return bool(series_.are_means[static_cast<std::size_t>(place)]);
        };
        const bool has_means = std::ranges::any_of(sums.groups, is_mean);
        out_.list(fmt::format("{} {} = {}.template sums<", has_means ? "auto" : "const auto", sums.values, sums.object),
                  pairs, fmt::format(">({});", k_));
        for (std::size_t m = 0; m < sums.groups.size(); ++m)
            if (is_mean(sums.groups[m])) out_.line(fmt::format("{0}[{1}] = {2} * {0}[{1}];", sums.values, m, share_));
    }

    TextBlock& out_;
    const KernelModule& module_;
    const ModuleNames& names_;
    const Kernel& kernel_;
    const TaylorRecurrence& series_;
    LocalNames locals_;
    bool is_rate_;
    std::size_t outputs_, lanes_;
    std::string x_, y_, order_, k_;
    Sums products_, squares_;
    std::string share_, next_; ///< 1/k, and unit/(k + 1)
    std::string unit_;         ///< of time
    bool carries_;             ///< the row of order k, and that of order k + 1
    std::string now_, after_;
    std::vector<std::size_t> single_; ///< pairs of sums that are in no group
    std::vector<TermSums> term_sums_; ///< by the number of lanes
    BodyTerms terms_;
    std::vector<std::string> names_of_groups_;
    std::set<std::string> late_; ///< what stands in the loop alone
    std::size_t last_late_ = 0;  ///< outputs from here on are there to get a name
    BodyPart loop_;
};

} // namespace

void print_series(TextBlock& out, const KernelModule& module, const ModuleNames& names, const Kernel& kernel,
                  Includes& includes)
{
    out.blank();
    includes.merge(SeriesPrinter(out, module, names, kernel).print());
}

} // namespace lagen
