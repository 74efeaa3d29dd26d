// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/second_run.hpp"

#include "scene/integrate_scene.hpp"

#include <fmt/core.h>

#include <limits>

namespace lagen {

namespace {

constexpr double longest = 5; ///< seconds of a first run after which a second one is made unasked
/// Half the step takes twice as many, a tenth of the tolerance 10^(1/3) times as many where the error of a step is of
/// the third order, and fewer by higher ones.
constexpr std::uint64_t most_times = 5, spare_steps = 10000;
constexpr int most_tenths = 6;

std::optional<ProgramInput> at_a_tenth(ProgramInput input, std::string& said)
{
    const long double relative = input.relative.value_or(0) / 10, absolute = input.absolute.value_or(0) / 10;
    if (relative > 0 ? relative < std::numeric_limits<double>::epsilon()
                     : absolute < std::numeric_limits<double>::min()) {
        said = "a second run at a smaller tolerance cannot be made";
        return std::nullopt;
    }
    said = "a second run at a tenth of the tolerance";
    input.relative = relative;
    input.absolute = absolute;
    return input;
}

/// A discrete motion has its step among its parameters, and twice as many steps between its rows.
std::optional<ProgramInput> with_half_of_own_step(const RunSetting& run, std::string& said)
{
    const auto cannot = [&](const char* why) {
        said = fmt::format("a second run with half the step cannot be made: {}", why);
        return std::nullopt;
    };
    if (run.input.from_arrow) return cannot("the start is an arrow of one step");
    if (run.input.branch.value_or(1) != 1) return cannot("the branches of the first arrow are others");
    Scene half = run.scene;
    const long double step = *evaluate_scene(run.model, run.scene).step / 2;
    half.step = number(Rational(static_cast<double>(step)));
    ProgramInput input = run.input;
    try {
        const SceneValues values = evaluate_scene(run.model, half);
        input.parameters = finite_numbers(values.parameters, half);
        input.initial = run.start(values);
        if (values.own_step) input.parameters.push_back(*values.step);
    } catch (const ModelError&) {
        return cannot("the start is none for it");
    } catch (const MathematicsError&) {
        return cannot("the start is none for it");
    }
    if (input.parameters == run.input.parameters) return cannot("the model fixes its step");
    input.times.every *= 2;
    return input;
}

std::optional<ProgramInput> with_half_the_step(const RunSetting& run, std::string& said)
{
    said = "a second run with half the step";
    if (run.input.times.every > 0) return with_half_of_own_step(run, said);
    ProgramInput input = run.input;
    input.step = *input.step / 2;
    return input;
}

RunOutcome finer_run(const RunSetting& run, const ProgramInput& input, const RunOutcome& outcome)
{
    RunOutcome second;
    second.table.columns = outcome.table.columns;
    (void)is_uninterrupted([&] { integrate_scene(run.program, input, second); });
    return second;
}

} // namespace

std::string reason_for_one_run(const RunOutcome& outcome, SecondRun wanted)
{
    if (wanted == SecondRun::always || outcome.seconds <= longest) return "";
    return fmt::format("not estimated, the run took {:.2g} s; --second-run makes a second one", outcome.seconds);
}

std::optional<ProgramInput> finer_input(const RunSetting& run, std::string& said)
{
    return run.method.adaptive ? at_a_tenth(run.input, said) : with_half_the_step(run, said);
}

void judge_state(const RunSetting& run, SecondRun wanted, RunOutcome& outcome)
{
    if (wanted == SecondRun::none || outcome.steps == 0) return;
    outcome.second_run = reason_for_one_run(outcome, wanted);
    if (!outcome.second_run.empty()) return;
    std::optional<ProgramInput> input = finer_input(run, outcome.second_run);
    if (!input) return;
    std::string made = outcome.second_run;
    input->most_steps = most_times * (outcome.steps + outcome.rejected) + spare_steps;
    RunOutcome second = finer_run(run, *input, outcome);
    // The same steps confirm nothing.
    for (int k = 2; k <= most_tenths && run.method.adaptive && second.steps == outcome.steps; ++k) {
        std::string said;
        const std::optional<ProgramInput> next = at_a_tenth(*input, said);
        if (!next) break;
        input = next;
        second = finer_run(run, *input, outcome);
        made = fmt::format("a second run at 1e-{} of the tolerance", k);
        outcome.second_run = made + ": a tenth makes the same steps";
    }
    if (is_interrupted(second)) {
        outcome.second_run = "not estimated, the second run was interrupted";
        return;
    }
    outcome.accuracy = accuracy_of(outcome.table, second.table, input->times.kind == Sampling::Kind::event);
    if (!outcome.accuracy)
        outcome.second_run = made + " has no row to compare";
    else if (!succeeded(second.status) && second.status != outcome.status)
        outcome.second_run += fmt::format(", which ends at t = {:.6g}: {}", second.t, second.status);
}

} // namespace lagen
