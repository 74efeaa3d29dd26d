// SPDX-License-Identifier: GPL-2.0-or-later
/// `verify` on random morphisms that are true by construction and on mutants of them, whose truth exact rational values
/// decide. LAGEN_PROPERTY_MODELS (any value) prints the tables.
#include "elaborate/elaborate_morphism.hpp"
#include "expression/parse.hpp"
#include "model_text.hpp"
#include "random_morphism.hpp"
#include "support/sanitized.hpp"
#include "tally.hpp"
#include "verify/verify_morphism.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cstdlib>
#include <ctime>
#include <iostream>

namespace lagen::laws {
namespace {

constexpr std::size_t exact_points = 4;

std::string fibre_text(const RandomMorphism& morphism, std::size_t a)
{
    std::string text;
    for (std::size_t b = 0; b < morphism.source.r(); ++b)
        if (!morphism.entry(a, b).is_zero())
            text += fmt::format("{}({})*{}", text.empty() ? "" : " + ", morphism.entry(a, b).text(),
                                morphism.source.fibre[b]);
    return text.empty() ? "0" : text;
}

/// As a morphism file would say it.
MorphismFile morphism_file(const RandomMorphism& morphism)
{
    MorphismFile file;
    file.name = "random";
    const std::string& own = morphism.source_text;
    file.source =
        read_model_text("source.toml", "name = \"source\"\n" + (own.empty() ? model_text(morphism.source) : own));
    file.target = read_model_text("target.toml", "name = \"target\"\n" + model_text(morphism.target));
    const auto tree = [&](const std::string& text) {
        return file.source.scope.close(parse_expression(whole_text("random.toml", text)));
    };
    for (const Formula& each : morphism.base) file.base.push_back(tree(each.text()));
    for (std::size_t a = 0; a < morphism.target.r(); ++a) file.fibre.push_back(tree(fibre_text(morphism, a)));
    file.parameters.resize(file.target.parameters.size());
    return file;
}

std::string described_morphism(const RandomMorphism& morphism)
{
    std::string text = "source\n" + model_text(morphism.source) + "target\n" + model_text(morphism.target) + "base\n";
    for (const Formula& each : morphism.base) text += "  " + each.text() + "\n";
    for (std::size_t a = 0; a < morphism.target.r(); ++a)
        text += morphism.target.fibre[a] + " = " + fibre_text(morphism, a) + "\n";
    return text;
}

bool has_witnesses(const MorphismReport& report)
{
    for (const Check& check : report.structure.checks)
        if (check.decision.status == ProofStatus::refuted && !check.decision.witness) return false;
    return true;
}

struct MorphismTrials {
    Tally proved, refuted, lucky; ///< true ones, false mutants, and mutants that are morphisms, by sort or mutation
    std::size_t unknown = 0;
    std::vector<std::string> failures;
};

void judge_morphism(const RandomMorphism& morphism, const std::string& name, Truth truth, Tally& tally,
                    MorphismTrials& trials)
{
    const std::clock_t begin = std::clock();
    const MorphismReport report = verify(elaborate(morphism_file(morphism)));
    const double milliseconds = 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    const Verdict verdict = report.structure.verdict;
    const Verdict expected = truth == Truth::holds ? Verdict::valid : Verdict::invalid;
    const bool undecided = verdict == Verdict::undecided;
    const bool wrong = (!undecided && verdict != expected) || !has_witnesses(report);
    tally.of(name).add(wrong, undecided ? "undecided" : "", milliseconds);
    if (wrong)
        trials.failures.push_back(name + ": found " + to_text(verdict) + ", expected " + to_text(expected) + "\n" +
                                  described_morphism(morphism));
}

void run_morphism_trial(std::size_t number, MorphismTrials& trials)
{
    Dice dice(number);
    RandomMorphism morphism = random_morphism(number, dice);
    if (truth_of(morphism, dice, exact_points) != Truth::holds)
        trials.failures.push_back("the construction is no morphism\n" + described_morphism(morphism));
    judge_morphism(morphism, morphism.sort, Truth::holds, trials.proved, trials);
    morphism.source_text = number % 2 == 0 ? morphism.source_text : "";
    const std::string mutation = mutate(morphism, dice);
    const Truth truth = truth_of(morphism, dice, exact_points);
    if (truth == Truth::unknown)
        ++trials.unknown;
    else
        judge_morphism(morphism, morphism.sort + ", " + mutation, truth,
                       truth == Truth::holds ? trials.lucky : trials.refuted, trials);
}

void check_morphism_trials(std::size_t count)
{
    MorphismTrials trials;
    for (std::size_t number = 0; number < count; ++number) run_morphism_trial(number, trials);
    if (std::getenv("LAGEN_PROPERTY_MODELS") != nullptr) // NOLINT(concurrency-mt-unsafe)
        std::cout << table_text("true", trials.proved) << "\n"
                  << table_text("mutants", trials.refuted) << "\n"
                  << table_text("mutants that are true", trials.lucky);
    for (std::size_t k = 0; k < trials.failures.size() && k < 3; ++k) {
        INFO(trials.failures[k]);
        CHECK(trials.failures.empty());
    }
    const Count proved = trials.proved.total(), refuted = trials.refuted.total(), lucky = trials.lucky.total();
    INFO(proved.undecided << " true ones undecided, " << refuted.undecided << " false ones, " << lucky.number
                          << " mutants are morphisms, " << lucky.undecided << " of them undecided");
    CHECK(proved.wrong + refuted.wrong + lucky.wrong == 0);
    CHECK(trials.unknown == 0);
    CHECK(proved.number == count);
    CHECK(refuted.number + lucky.number == count);
    CHECK(refuted.number > count * 2 / 3);
    CHECK((proved.undecided + refuted.undecided + lucky.undecided) * 50 <= count);
}

} // namespace

TEST_CASE("random changes of frame, quotients by ideals and projections are proved, and mutants of them refuted")
{
    check_morphism_trials(LAGEN_SANITIZED ? 50 : 100);
}

TEST_CASE("of the verdicts on five hundred random morphisms and their mutants none is wrong", "[all]")
{
    check_morphism_trials(LAGEN_SANITIZED ? 150 : 500);
}

} // namespace lagen::laws
