// SPDX-License-Identifier: GPL-2.0-or-later
/// Trials in order of plausibility: signs, then values that the anchor asks for. A trial is first looked at where the
/// equations were refuted; what vanishes there is decided like any model.
#include "advice/repair.hpp"

#include "graph/core/lower.hpp"
#include "verify/judge.hpp"

#include <algorithm>
#include <functional>

namespace lagen {

namespace {

/// An entry of C ([e_a, e_b] along e_index) or, with `anchor`, of rho (rho(e_a) along d/dx^index).
struct EntryPlace {
    bool anchor = false;
    std::size_t a = 0, b = 0;
    std::size_t index = 0;
};

enum class RepairKind {
    sign,  ///< of one entry
    order, ///< [a, b] is given for [b, a]
    needed ///< the only value with which the anchor equations of its pair hold, the other entries being as they are
};

/// These entries get these values.
struct Repair {
    RepairKind kind;
    std::vector<std::pair<EntryPlace, NodeId>> changes;
};

constexpr std::size_t most_operations = 3'000'000; ///< in evaluations at points
constexpr std::size_t most_proofs = 12;            ///< trials that are decided in full
constexpr std::size_t most_refuted = 4;            ///< refuted equations that a trial is looked at with
constexpr std::size_t alternatives = 2;
constexpr std::size_t longest_value = 200; ///< characters; a longer one helps nobody

/// True where the file gives the pair in both orders; else a change is one of both at once.
bool both_given(const Algebroid& algebroid, std::size_t a, std::size_t b)
{
    return algebroid.given[a * algebroid.r() + b] && algebroid.given[b * algebroid.r() + a];
}

/// Carries out changes on an algebroid, and undoes them when it goes. A bracket that the model gives in one order, or
/// not at all, changes in both.
class Trial {
  public:
    Trial(Graph& graph, Algebroid& algebroid, const Repair& repair)
        : graph_(graph), algebroid_(algebroid), before_(algebroid)
    {
        const std::size_t r = algebroid.r();
        for (const auto& [place, value] : repair.changes) {
            if (place.anchor) {
                set(algebroid.anchor[place.a], place.index, value);
                continue;
            }
            set(algebroid.bracket[place.a * r + place.b], place.index, value);
            if (!both_given(algebroid, place.a, place.b))
                set(algebroid.bracket[place.b * r + place.a], place.index, graph.negate(value));
        }
    }
    ~Trial() { algebroid_ = std::move(before_); }
    Trial(const Trial&) = delete;
    Trial& operator=(const Trial&) = delete;

  private:
    void set(Column& column, std::size_t index, NodeId value)
    {
        std::erase_if(column, [&](const ColumnEntry& entry) { return entry.index == index; });
        if (graph_.is_zero(value)) return;
        const auto after = std::ranges::find_if(column, [&](const ColumnEntry& entry) { return entry.index > index; });
        column.insert(after, {index, value});
    }

    Graph& graph_;
    Algebroid& algebroid_;
    Algebroid before_;
};

class RepairSearch {
  public:
    RepairSearch(Judge& judge, BaseGradient& partial, const Algebroid& algebroid, const WrittenAlgebroid& names,
                 const BaseFunctions& functions, Editable editable)
        : judge_(judge), partial_(partial), graph_(partial.graph()), algebroid_(algebroid), names_(names),
          functions_(functions), editable_(editable)
    {
    }

    /// "all equations hold with .., or with .."; "" where no change is found.
    std::string hint(const ResidualList& list)
    {
        for (const Residual& residual : list.residuals) {
            const Decision& decision = judge_.decide(residual.value);
            if (decision.status == ProofStatus::refuted && decision.witness)
                refuted_.emplace_back(&residual, *decision.witness);
        }
        if (refuted_.empty()) return {};
        const std::vector<Repair> signs = select(sign_repairs());
        return describe(signs.empty() ? select(needed_values()) : signs);
    }

  private:
    /// Every entry with its sign flipped, brackets first, then whole pairs of more than one component.
    [[nodiscard]] std::vector<Repair> sign_repairs()
    {
        std::vector<Repair> repairs, orders;
        const std::size_t r = algebroid_.r();
        const auto append = [&](std::size_t a, std::size_t b) {
            for (const ColumnEntry& entry : algebroid_.C(a, b))
                repairs.push_back({RepairKind::sign, {{{false, a, b, entry.index}, graph_.negate(entry.value)}}});
        };
        for (std::size_t a = 0; a < r && editable_.bracket; ++a)
            for (std::size_t b = a + 1; b < r; ++b) {
                append(a, b);
                if (both_given(algebroid_, a, b)) {
                    append(b, a);
                    continue;
                }
                Repair order{RepairKind::order, {}};
                for (const ColumnEntry& entry : algebroid_.C(a, b))
                    order.changes.emplace_back(EntryPlace{false, a, b, entry.index}, graph_.negate(entry.value));
                if (order.changes.size() > 1) orders.push_back(std::move(order));
            }
        for (std::size_t a = 0; a < r && editable_.anchor; ++a)
            for (const ColumnEntry& entry : algebroid_.anchor[a])
                repairs.push_back({RepairKind::sign, {{{true, a, 0, entry.index}, graph_.negate(entry.value)}}});
        std::ranges::move(orders, std::back_inserter(repairs));
        return repairs;
    }

    /// For the pairs of refuted anchor equations R the brackets C^c_ab + R^i / rho^i_c, one component c each.
    [[nodiscard]] std::vector<Repair> needed_values()
    {
        std::vector<Repair> needed;
        std::set<std::pair<std::size_t, std::size_t>> done;
        for (const auto& [residual, witness] : refuted_) {
            if (done.size() == most_refuted || !editable_.bracket) break;
            const std::vector<std::size_t>& k = residual->indices;
            if (residual->name != "anchor" || !done.emplace(k[0], k[1]).second) continue;
            const Column equations = anchor_defect(partial_, algebroid_, k[0], k[1]);
            for (std::size_t c = 0; c < algebroid_.r(); ++c)
                if (const auto more = quotient(equations, algebroid_.anchor[c])) {
                    const NodeId value = Algebroid::entry(graph_, algebroid_.C(k[0], k[1]), c);
                    needed.push_back(
                        {RepairKind::needed, {{{false, k[0], k[1], c}, simplified(graph_.add(value, *more))}}});
                }
        }
        return needed;
    }

    /// R^i / v^i at the first i with the simplest v^i.
    [[nodiscard]] std::optional<NodeId> quotient(const Column& residual, const Column& divisor)
    {
        std::optional<NodeId> found;
        for (const ColumnEntry& entry : residual) {
            const NodeId below = Algebroid::entry(graph_, divisor, entry.index);
            if (graph_.is_zero(below) || graph_.is_zero(entry.value)) continue;
            if (graph_.is_constant(below)) return graph_.divide(entry.value, below);
            if (!found) found = graph_.divide(entry.value, below);
        }
        return found;
    }

    /// A value that is a number, as such: x*y/(y*x) is 1.
    [[nodiscard]] NodeId simplified(NodeId value)
    {
        if (graph_.is_constant(value)) return value;
        const Decision& decision = judge_.decide(value);
        if (decision.status == ProofStatus::proved) return graph_.constant(0);
        const NodeId form = decision.normal_form ? Lowering(graph_)(decision.normal_form) : value;
        return graph_.is_constant(form) ? form : value;
    }

    /// The first two of `candidates` with which all equations hold.
    [[nodiscard]] std::vector<Repair> select(const std::vector<Repair>& candidates)
    {
        std::vector<Repair> found;
        for (const Repair& candidate : candidates) {
            if (found.size() == alternatives || !affords(1)) break;
            if (is_admissible(candidate) && fits(candidate) && all_hold(candidate)) found.push_back(candidate);
        }
        return found;
    }

    /// False of an entry that depends on the base in a bracket of constants.
    [[nodiscard]] bool is_admissible(const Repair& repair) const
    {
        return !editable_.constant_bracket || std::ranges::all_of(repair.changes, [&](const auto& change) {
            return change.first.anchor || !depends_on_any(graph_, std::vector{change.second}, algebroid_.x);
        });
    }

    [[nodiscard]] bool affords(std::size_t operations)
    {
        effort_ += operations;
        return effort_ < most_operations;
    }

    /// Do the refuted equations vanish, as far as can be seen, where they were refuted?
    [[nodiscard]] bool fits(const Repair& repair)
    {
        const Trial trial(graph_, algebroid_, repair);
        for (std::size_t k = 0; k < std::min(refuted_.size(), most_refuted); ++k) {
            const NodeId value = again(*refuted_[k].first);
            WitnessPoint point(graph_, refuted_[k].second.whole);
            const bool vanishes = point.may_vanish(value);
            if (!affords(point.effort() + algebroid_.r()) || !vanishes) return false;
        }
        return true;
    }

    /// The residual with the same name and indices, of the algebroid as it is changed.
    [[nodiscard]] NodeId again(const Residual& residual)
    {
        const auto& k = residual.indices;
        if (residual.name == "anchor")
            return Algebroid::entry(graph_, anchor_defect(partial_, algebroid_, k[0], k[1]), k[2]);
        if (residual.name == "jacobi")
            return Algebroid::entry(graph_, jacobiator(partial_, algebroid_, k[0], k[1], k[2]), k[3]);
        if (residual.name == "antisymmetry")
            return graph_.add(Algebroid::entry(graph_, algebroid_.C(k[0], k[1]), k[2]),
                              Algebroid::entry(graph_, algebroid_.C(k[1], k[0]), k[2]));
        const NodeId f = (residual.name == "tangency" ? functions_.constraints : functions_.casimirs)[k[1]];
        return partial_.along(algebroid_.anchor[k[0]], f);
    }

    [[nodiscard]] bool all_hold(const Repair& repair)
    {
        if (++proofs_ > most_proofs) return false;
        const Trial trial(graph_, algebroid_, repair);
        const ResidualList list = structure_equations(partial_, algebroid_, functions_);
        return std::ranges::all_of(list.residuals, [&](const Residual& residual) {
            return judge_.decide(residual.value).status == ProofStatus::proved;
        });
    }

    // Repairs in the words and in the order of the model file.

    /// True where the file has the pair (b, a) alone: the hint speaks of that order.
    [[nodiscard]] bool is_reversed(const EntryPlace& place) const
    {
        const std::size_t r = algebroid_.r();
        return !place.anchor && algebroid_.given[place.b * r + place.a] && !algebroid_.given[place.a * r + place.b];
    }

    [[nodiscard]] std::string owner(const EntryPlace& place) const
    {
        if (place.anchor) return "the anchor of " + names_.fibre[place.a].name;
        const auto [a, b] = is_reversed(place) ? std::pair(place.b, place.a) : std::pair(place.a, place.b);
        return "[" + names_.fibre[a].name + ", " + names_.fibre[b].name + "]";
    }

    /// A structure function as the file has it.
    [[nodiscard]] std::string given_text(const EntryPlace& place) const
    {
        const auto [a, b] = is_reversed(place) ? std::pair(place.b, place.a) : std::pair(place.a, place.b);
        for (const StructureValue& entry : names_.C)
            if (entry.a == a && entry.b == b && entry.c == place.index) return to_text(entry.value);
        return "none";
    }

    /// "[a, b] needs component c = V, given is W; with it all hold", or "all hold with ..".
    [[nodiscard]] std::string describe(const std::vector<Repair>& repairs)
    {
        const std::string all = "all equations of the algebroid hold";
        std::string text;
        for (const Repair& repair : repairs) {
            const auto& [place, value] = repair.changes.front();
            const std::string whose = owner(place);
            const std::string which = "component " + (place.anchor ? names_.base : names_.fibre)[place.index].name;
            std::string phrase = "the opposite sign of " + which + " of " + whose;
            if (repair.kind == RepairKind::order)
                phrase = "the opposite sign of " + whose + ", as if its sections were given in the wrong order";
            if (repair.kind == RepairKind::needed) {
                const NodeId shown = is_reversed(place) ? graph_.negate(value) : value;
                const std::string wanted = graph_.is_zero(shown) ? "0" : judge_.decide(shown).residual;
                const std::string given = given_text(place);
                if (wanted.size() > longest_value || given.size() > longest_value) continue;
                if (repairs.size() == 1)
                    return whose + " needs " + which + " = " + wanted + ", given is " + given + "; with it " + all;
                phrase = which + " = " + wanted + " of " + whose + " (given is " + given + ")";
            }
            text += (text.empty() ? all + " with " : ", or with ") + phrase;
        }
        return text;
    }

    Judge& judge_;
    BaseGradient& partial_;
    Graph& graph_;
    Algebroid algebroid_; ///< changed and changed back by each trial
    const WrittenAlgebroid& names_;
    const BaseFunctions& functions_;
    Editable editable_;
    std::vector<std::pair<const Residual*, Witness>> refuted_;
    std::size_t effort_ = 0, proofs_ = 0;
};

} // namespace

std::vector<std::string> repair_hints(Judge& judge, BaseGradient& partial, const Algebroid& algebroid,
                                      const WrittenAlgebroid& names, const BaseFunctions& functions, Editable editable,
                                      const ResidualList& list)
{
    const std::string hint = RepairSearch(judge, partial, algebroid, names, functions, editable).hint(list);
    std::vector<std::string> hints;
    for (const Residual& residual : list.residuals)
        hints.push_back(judge.decide(residual.value).status == ProofStatus::refuted ? hint : "");
    return hints;
}

} // namespace lagen
