// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/scene/largest_step.hpp"

#include "commands/scene/integrate_scene.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace lagen {

namespace {

constexpr long double shortest = 1.0L / 1024, most_steps = 1e6L;
constexpr int bisections = 10;

/// Three digits, which a model file can hold.
std::string rounded(long double step)
{
    return fmt::format("{:.3g}", static_cast<double>(step));
}

class StepSearch {
  public:
    StepSearch(const Model& model, Scene scene, const std::string& program, ProgramInput input, StartState& start,
               long double failed_at)
        : model_(model), scene_(std::move(scene)), program_(program), input_(std::move(input)), start_(start),
          failed_at_(failed_at)
    {
        scene_.duration = nullptr;
        scene_.sampling = {};
        scene_.sampling.kind = Sampling::Kind::count;
        scene_.sampling.count = 2;
        input_.columns.clear();
    }

    [[nodiscard]] std::string find(long double failing)
    {
        const long double first = failing;
        std::string found;
        for (long double step = failing / 2; found.empty(); step /= 2) {
            if (step < shortest * first) return {};
            if (works(rounded(step)))
                found = rounded(step);
            else
                failing = step;
        }
        for (int k = 0; k < bisections; ++k) {
            const long double middle = (std::strtold(found.c_str(), nullptr) + failing) / 2;
            const std::string step = rounded(middle);
            if (step == found || std::strtold(step.c_str(), nullptr) >= failing) break;
            if (works(step))
                found = step;
            else
                failing = std::strtold(step.c_str(), nullptr);
        }
        return found;
    }

  private:
    /// Whether the run goes beyond the time at which it failed.
    [[nodiscard]] bool works(const std::string& step)
    {
        const long double length = std::strtold(step.c_str(), nullptr);
        const long double count = std::max(1.0L, std::ceil((failed_at_ - input_.times.start) / length));
        spent_ += count;
        if (spent_ > most_steps) return false;
        scene_.step = number(Rational(std::strtod(step.c_str(), nullptr)));
        scene_.steps = static_cast<long>(count);
        use_values(input_, scene_, evaluate_scene(model_, scene_), start_, false);
        RunOutcome trial;
        trial.table.columns = {"t"};
        integrate_scene(program_, input_, trial);
        return succeeded(trial.status);
    }

    const Model& model_;
    Scene scene_;
    const std::string& program_;
    ProgramInput input_;
    StartState& start_;
    long double failed_at_, spent_ = 0;
};

} // namespace

std::string largest_step(const Model& model, Scene scene, const std::string& program, ProgramInput input,
                         StartState& start, const RunOutcome& outcome)
{
    constexpr std::array<std::string_view, 3> of_an_arrow{"no_solution", "branch_lost", "newton_diverged"};
    const SceneValues values = evaluate_scene(model, scene);
    if (!values.discrete || starts_from_arrow(values) || std::ranges::count(of_an_arrow, outcome.status) == 0)
        return {};
    return StepSearch(model, std::move(scene), program, std::move(input), start, outcome.failed_at).find(*values.step);
}

} // namespace lagen
