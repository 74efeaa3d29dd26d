// SPDX-License-Identifier: GPL-2.0-or-later
/// Which truth is expected of which text, and what is counted as wrong.
#include "trial.hpp"

#include "compare.hpp"
#include "judge.hpp"
#include "model_text.hpp"
#include "mutate.hpp"

namespace lagen::laws {
namespace {

/// Points at which the oracle looks before it believes in "holds"; branches are met by half of them or so.
constexpr std::size_t few_points = 2, many_points = 12;

std::string file_name(std::size_t number, const std::string& family, const std::string& what)
{
    std::string name = std::to_string(number) + "_" + family + "_" + what;
    for (char& letter : name)
        if (std::isalnum(static_cast<unsigned char>(letter)) == 0) letter = '_';
    return name;
}

struct Case {
    std::size_t number;
    std::string family, what, expected;
};

/// Counts an answer; `fault` is a complaint about a witness.
void count(const Case& one, const std::string& text, const Answer& answer, const std::string& fault,
           const std::vector<Count*>& counts, Trials& trials)
{
    const bool undecided = answer.verdict == "undecided";
    const bool wrong = !fault.empty() || (!undecided && answer.verdict != one.expected);
    const std::string reason = answer.reason.empty() ? "no reason given" : answer.reason;
    for (Count* line : counts) line->add(wrong, undecided ? reason : "", answer.milliseconds);
    std::string complaint = "# expected " + one.expected + ", found " + answer.verdict + "\n# " + fault + "\n";
    for (std::size_t at = complaint.find('\n'); at + 1 < complaint.size(); at = complaint.find('\n', at + 1))
        if (complaint[at + 1] != '#') complaint.insert(at + 1, "# ");
    const Failure failure{file_name(one.number, one.family, one.what), complaint + "# " + answer.reason + "\n" + text};
    if (wrong) trials.failures.push_back(failure);
    if (undecided || answer.milliseconds > 5000) trials.undecided.push_back(failure);
}

void judge_near_miss(std::size_t number, const AlgebroidFamily& family, const LocalAlgebroid& valid, Dice& dice,
                     Trials& trials)
{
    const std::size_t first = dice.below(mutations().size());
    for (std::size_t attempt = 0; attempt < mutations().size(); ++attempt) {
        const Mutation& mutation = mutations()[(first + attempt) % mutations().size()];
        LocalAlgebroid mutant = valid;
        if (!mutation.apply(mutant, dice)) continue;
        if (truth_of(mutant, dice, many_points) != Truth::violated) {
            ++trials.by_mutation.discarded;
            continue;
        }
        const std::string text = model_text(mutant);
        const Answer answer = answer_of(text);
        count({number, family.name, mutation.name, "invalid"}, text, answer, witness_fault(mutant, answer),
              {&trials.near_misses.of(family.name), &trials.by_mutation.of(mutation.name)}, trials);
        return;
    }
}

/// The notation of the kind: valid as the general one is, and invalid where its part is changed into an invalid one.
void judge_own_kind(std::size_t number, const AlgebroidFamily& family, const Specimen& specimen, Dice& dice,
                    Trials& trials)
{
    if (!specimen.own_kind) return;
    const std::string text = specimen.own_kind(specimen.part);
    const Answer answer = answer_of(text);
    const std::string fault =
        answer.verdict == "valid" ? difference_from(answer.algebroid, specimen.algebroid, dice) : "";
    count({number, family.name, "own kind", "valid"}, text, answer, fault, {&trials.own_kind.of(family.name)}, trials);
    if (!specimen.part_decides) return;
    LocalAlgebroid part = specimen.part;
    const Mutation& mutation = dice.pick(mutations());
    if (!mutation.apply(part, dice) || truth_of(part, dice, few_points) != Truth::violated) return;
    const std::string changed = specimen.own_kind(part);
    count({number, family.name, "own kind " + mutation.name, "invalid"}, changed, answer_of(changed), "",
          {&trials.own_kind.of(family.name + ", near miss")}, trials);
}

} // namespace

void run_trial(std::size_t number, Trials& trials)
{
    Dice dice(number);
    const AlgebroidFamily& family = algebroid_families()[number % algebroid_families().size()];
    const Specimen specimen = family.build(dice);
    const LocalAlgebroid& algebroid = specimen.algebroid;
    const Truth truth = truth_of(algebroid, dice, few_points);
    if (truth == Truth::unknown) {
        ++trials.valid.discarded;
        return;
    }
    const std::string text = model_text(algebroid);
    const Answer answer = answer_of(text);
    // A construction that the oracle refutes is a defect of these tests.
    const std::string fault = truth == Truth::violated ? "the construction is not valid" : "";
    count({number, family.name, "valid", "valid"}, text, answer, fault, {&trials.valid.of(family.name)}, trials);
    judge_own_kind(number, family, specimen, dice, trials);
    judge_near_miss(number, family, algebroid, dice, trials);
}

} // namespace lagen::laws
