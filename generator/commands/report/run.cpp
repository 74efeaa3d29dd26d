// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/report/run.hpp"

#include "lagen_run/text.hpp"
#include "machine/write_file.hpp"
#include "model/scene_form.hpp"
#include "scene/methods.hpp"
#include "text/comma_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <span>

namespace lagen {

namespace {

using detail::Drift;

constexpr double rounding = 0x1p-53; ///< of it: no double is nearer

/// "3e-9": a digit says how large an error is.
std::string one_digit(double value)
{
    std::string text = fmt::format("{:.1g}", value);
    const std::size_t exponent = text.find('e');
    if (exponent != std::string::npos && text[exponent + 2] == '0') text.erase(exponent + 2, 1);
    return text;
}

/// A list of numbers as JSON, with the digits of a table in CSV.
std::string numbers_json(std::span<const double> numbers)
{
    std::string text;
    for (const double each : numbers)
        text += (text.empty() ? "" : ", ") + (std::isfinite(each) ? detail::number_text(each) : "null");
    return "[" + text + "]";
}

std::string brief(double number, int digits)
{
    return fmt::format("{:.{}g}", number, digits);
}

/// Whether the arrow that was asked for is none of those that are found.
bool is_branch_missing(const RunOutcome& outcome)
{
    return outcome.branch > 0 && outcome.branches && outcome.branch > outcome.branches->size();
}

/// How many arrows have the momenta of the start of a run that failed, where that is known, and how to take them.
std::string branches_text(const RunOutcome& outcome)
{
    if (succeeded(outcome.status) || !outcome.branches) return "";
    const std::vector<double>& found = *outcome.branches;
    return found.empty()
               ? "  no arrow with the momenta of the start is found\n"
               : fmt::format("  arrows with the momenta of the start (`--branch 1` to `--branch {}`) are at the "
                             "distances {}\n",
                             found.size(), comma_list(found, [](double each) { return brief(each, 6); }));
}

/// What ended a run whose controls could not be followed, a discrete one, one on a group, or one of jumps.
std::string reason_text(const RunOutcome& outcome)
{
    const std::string& status = outcome.status;
    const MethodEntry* method = find_method(outcome.method);
    if (is_branch_missing(outcome)) return fmt::format("branch {} is not there", outcome.branch);
    if (status == "no_solution")
        return "no arrow on this branch has these momenta: they lie behind a fold of F^-L; shorter steps reach further";
    if (status == "branch_lost" && outcome.form != "discrete")
        return "the step turns farther than the chart of the group reaches: take a shorter one";
    if (status == "branch_lost" && outcome.table.count() == 0)
        return "the momenta of the first arrow are not found: its inner unknowns, of `exp` its logarithm, have no "
               "value that Newton's method reaches from 0, as a half turn has none";
    if (status == "branch_lost")
        return "no arrow with these momenta is connected with the one before: its branch ends at a fold of F^-L";
    if (status == "newton_diverged" && outcome.form == "discrete")
        return "Newton's method reaches no arrow with these momenta, and meets no fold on the way to them";
    if (status == "newton_diverged" && !outcome.searches && method != nullptr &&
        method->kind == MethodKind::implicit_stages)
        return "Newton's method finds no stages: the equations of a step of this length are singular, or nearly so, or "
               "their solution is far off; take another step";
    if (status == "not_a_maximum")
        return "no maximum of H is found from the controls before, or from the guess: d2H/du2 is not negative definite";
    if (status == "zeno")
        return fmt::format(
            "infinitely many jumps of event {} lead up to here, ever faster; the model does not say what "
            "follows them",
            outcome.events.empty() ? "" : outcome.events.back().name);
    if (status == "singular_control") return "H does not depend on a control: b = c = 0 in a + b cos u + c sin u";
    return {};
}

bool changes_by_itself(const RunOutcome& outcome, const Drift& drift)
{
    return outcome.energy_changes && is_energy(drift);
}

/// Whether the equations keep it. The energy of discrete motions, -dL/dh, swings.
bool is_exact(const RunOutcome& outcome, const Drift& drift)
{
    return !changes_by_itself(outcome, drift) && !(is_energy(drift) && form_named(outcome.form).steps);
}

/// What is followed: its start and how far it moved, or the largest value of what should be 0.
Record record_of(const RunOutcome& outcome, const Drift& drift, bool from_start)
{
    Record record = Record::object();
    if (from_start) record["initial"] = drift.initial;
    record[from_start ? "max_drift" : "max"] = drift.most;
    record["t"] = drift.t;
    if (std::isfinite(drift.slope)) record.update({{"slope", drift.slope}, {"slope_error", drift.error}});
    if (std::isfinite(drift.moved_at) && is_exact(outcome, drift))
        record.update({{"size", drift.size}, {"moved_at", drift.moved_at}});
    return record;
}

Record record_of(const RunOutcome& outcome, const std::vector<Drift>& drifts, bool from_start)
{
    Record record = Record::object();
    for (const Drift& drift : drifts) record[drift.name] = record_of(outcome, drift, from_start);
    return record;
}

void add_figures(Record& record, const RunOutcome& outcome)
{
    record["invariants"] = record_of(outcome, outcome.invariants, true);
    record["casimirs"] = record_of(outcome, outcome.casimirs, true);
    record["constraints"] = record_of(outcome, outcome.constraints, false);
    for (const Drift& drift : outcome.balance) {
        Record& balance = record["energy_balance"] = record_of(outcome, drift, true);
        balance["work"] = outcome.work;
    }
    if (outcome.manifold) record["manifold_distance"] = {{"max", *outcome.manifold}, {"t", outcome.manifold_t}};
}

std::string slope_text(const Drift& drift)
{
    if (!std::isfinite(drift.slope)) return "";
    return fmt::format(", slope {} +- {}", brief(drift.slope, 3), brief(drift.error, 2));
}

/// A line a function, for people.
std::string figures_text(const RunOutcome& outcome)
{
    std::string text;
    for (const auto* drifts : {&outcome.invariants, &outcome.balance, &outcome.casimirs})
        for (const Drift& drift : *drifts) {
            if (is_energy(drift) && drift.initial == 0 && drift.most == 0) continue; // costates that are 0
            if (!std::isfinite(drift.initial))
                text += fmt::format("  {}: no finite number at the start\n", drift.name);
            else
                text += fmt::format(
                    "  {}: {} at the start, largest drift {} at t = {}{}{}\n", drift.name, brief(drift.initial, 9),
                    brief(drift.most, 3), brief(drift.t, 6), slope_text(drift),
                    changes_by_itself(outcome, drift) ? " (not conserved: forces, time, a drift or jumps)" : "");
        }
    for (const Drift& drift : outcome.constraints)
        text += fmt::format("  {} = 0: at most {} off at t = {}{}\n", drift.name, brief(drift.most, 3),
                            brief(drift.t, 6), slope_text(drift));
    if (outcome.manifold)
        text += fmt::format("  distance from the manifold: at most {} at t = {}\n", brief(*outcome.manifold, 3),
                            brief(outcome.manifold_t, 6));
    if (!outcome.left_out.empty())
        text += fmt::format("  {}: left out, as the form '{}' does not have what {} of\n",
                            fmt::join(outcome.left_out, ", "), outcome.form,
                            outcome.left_out.size() == 1 ? "it is made" : "they are made");
    return text;
}

/// The largest first variation, what its separate terms come to before they cancel, and the least and largest second
/// variation. The two parts may be round-off both, where L does not depend on x: they are no measure of it.
struct ActionSizes {
    double first = 0, part = 0, least = INFINITY, largest = -INFINITY;
};
ActionSizes sizes_of(const ActionReport& action)
{
    ActionSizes sizes;
    for (std::size_t k = 0; k < action.base.size(); ++k) {
        sizes.first = std::max(sizes.first, std::fabs(action.base[k] + action.fibre[k]));
        sizes.part = std::max(sizes.part, std::sqrt(action.squares[k]));
        sizes.least = std::min(sizes.least, action.second[k]);
        sizes.largest = std::max(sizes.largest, action.second[k]);
    }
    return sizes;
}

std::string action_text(const RunOutcome& outcome)
{
    if (!outcome.action) return "";
    const ActionSizes sizes = sizes_of(*outcome.action);
    const std::size_t count = outcome.action->base.size();
    return fmt::format("  action {}; along {} with fixed ends its first variation is at most {:.3g}, "
                       "with parts to {:.3g}\n  second variations from {:.6g} to {:.6g}\n",
                       brief(outcome.action->action, 9), count_text(count, "random variation"), sizes.first, sizes.part,
                       sizes.least, sizes.largest);
}

Record record_of(const ActionReport& action)
{
    const ActionSizes sizes = sizes_of(action);
    return {{"value", action.action}, {"first", sizes.first},  {"parts", sizes.part},
            {"base", action.base},    {"fibre", action.fibre}, {"second", action.second}};
}

constexpr std::size_t most_lanes = 12; ///< of a state in a line

Record lanes_record(const RunOutcome& outcome, const std::vector<double>& values)
{
    Record record = Record::object();
    for (std::size_t k = 0; k < values.size(); ++k) record[outcome.lanes.at(k)] = values[k];
    return record;
}

/// "x = 0, v = -1", but for lanes that are as `before`.
std::string lanes_text(const RunOutcome& outcome, const std::vector<double>& values, const std::vector<double>& before)
{
    std::string text;
    for (std::size_t k = 0; k < values.size(); ++k)
        if (before.empty() || before[k] != values[k])
            text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", outcome.lanes.at(k), brief(values[k], 9));
    return text;
}

/// A line an event, with its state where that has few lanes; of many events the first ones and the last ones.
std::string events_text(const RunOutcome& outcome)
{
    constexpr std::size_t most = 20, shown = 10;
    const std::vector<detail::FoundCrossing>& events = outcome.events;
    std::string text;
    for (std::size_t k = 0; k < events.size(); ++k) {
        if (events.size() > most && k == shown) {
            text += fmt::format("  and {} events more, all of them in `--format json`\n", events.size() - 2 * shown);
            k = events.size() - shown;
        }
        const detail::FoundCrossing& event = events[k];
        text += fmt::format("  event {} at t = {}", event.name, brief(event.t, 15));
        if (!event.state.empty() && event.state.size() <= most_lanes) {
            const std::string after = lanes_text(outcome, event.after, event.state);
            text += ": " + lanes_text(outcome, event.state, {}) + (after.empty() ? "" : ", then " + after);
        }
        text += "\n";
    }
    return text;
}

/// The last good state of a run that failed, where it has few lanes.
std::string last_state(const RunOutcome& outcome)
{
    const bool few = !outcome.state.empty() && outcome.state.size() <= most_lanes;
    return fmt::format("  the last good state is at t = {}{}\n", brief(outcome.t, 15),
                       few ? ": " + lanes_text(outcome, outcome.state, {}) : "");
}

/// Lanes that moved and never exceeded the absolute tolerance.
std::string small_lanes_warning(const RunOutcome& outcome)
{
    constexpr std::size_t most = 6; // in a line
    const std::vector<detail::SmallLane>& lanes = outcome.below;
    std::string names;
    for (std::size_t k = 0; k < std::min(lanes.size(), most); ++k)
        names += fmt::format("{}{} (at most {})", k == 0 ? "" : ", ", outcome.lanes.at(lanes[k].lane),
                             brief(lanes[k].most, 2));
    if (lanes.size() > most) names += fmt::format(" and {} more", lanes.size() - most);
    return lanes.empty() ? "" : below_absolute_warning(names, outcome.absolute);
}

Record record_of(const RunOutcome& outcome, const detail::FoundCrossing& event)
{
    Record record = {{"name", event.name}, {"t", event.t}, {"state", lanes_record(outcome, event.state)}};
    if (!event.after.empty()) record["after"] = lanes_record(outcome, event.after);
    return record;
}

/// Everything but the rows.
Record record_of(const RunOutcome& outcome)
{
    Record record = {{"model", outcome.model},
                     {"scene", outcome.scene},
                     {"form", outcome.form},
                     {"method", outcome.method},
                     {"status", outcome.status},
                     {"t", outcome.t},
                     {"state", lanes_record(outcome, outcome.state)}};
    if (!succeeded(outcome.status)) record["failed_at"] = outcome.failed_at;
    if (outcome.branches) record["branches"] = *outcome.branches;
    record.update({{"steps", outcome.steps}, {"rejected", outcome.rejected}, {"rhs_calls", outcome.rhs_calls}});
    if (outcome.newton > 0)
        record.update({{"newton_iterations", outcome.newton}, {"decompositions", outcome.decompositions}});
    record["seconds"] = outcome.seconds;
    record["accuracy"] = outcome.accuracy ? record_of(*outcome.accuracy) : Record();
    record["below_absolute"] =
        list_of(outcome.below, [&](const detail::SmallLane& each) { return outcome.lanes.at(each.lane); });
    if (outcome.least)
        record["least"] = {{"states", outcome.least->states},
                           {"of", outcome.least->of},
                           {"relations", outcome.least->relations},
                           {"not_followed", outcome.least->not_followed}};
    add_figures(record, outcome);
    if (outcome.action) record["action"] = record_of(*outcome.action);
    record["events"] =
        list_of(outcome.events, [&](const detail::FoundCrossing& event) { return record_of(outcome, event); });
    record["columns"] = outcome.table.columns;
    return record;
}

std::string accuracy_line(const std::optional<StateAccuracy>& accuracy, const std::string& second_run)
{
    if (second_run.empty()) return "";
    return accuracy ? fmt::format("  {} ({})\n", text_of(*accuracy), second_run)
                    : fmt::format("  error of the state: {}\n", second_run);
}

/// Of a run that did not leave its start.
const char* start_hint(const RunOutcome& outcome)
{
    const std::string& status = outcome.status;
    if (outcome.searches && (status == "newton_diverged" || status == "not_a_maximum"))
        return "hint: the search for the controls found no maximum of H at the start: `guess = { u = .. }` in "
               "[control] "
               "says where it begins\n";
    if (status == "non_finite" && outcome.method == "taylor")
        return "hint: the right-hand side or its Taylor series is no finite number at the start: the model is not "
               "defined there, overflows, takes a root of 0, or raises 0 to a power whose exponent is a parameter; "
               "`--bind` makes it a "
               "number, other methods such as dop853 take no series\n";
    if (status == "non_finite")
        return "hint: the right-hand side is no finite number at the start: the model is not defined there, or "
               "overflows\n";
    if (status == "singular_mass_matrix")
        return "hint: the mass matrix has no inverse at the start: `lagen check` says where it has none\n";
    return "";
}

/// Devices, pipes and standard output stay what they are.
std::string partial_place(const std::string& output)
{
    std::error_code ignored;
    const auto status = std::filesystem::status(output, ignored);
    const bool is_stream = output == "-" || (exists(status) && !is_regular_file(status));
    return output + (is_stream ? "" : ".partial");
}

} // namespace

SecondRun second_run_of(const Options& options)
{
    if (!options.has("no-second-run")) return options.has("second-run") ? SecondRun::always : SecondRun::short_runs;
    if (options.has("second-run")) throw UsageError("--second-run and --no-second-run exclude each other");
    return SecondRun::none;
}

std::string text_of(const StateAccuracy& accuracy)
{
    const double known = accuracy.estimate < rounding ? 0 : accuracy.estimate;
    if (!accuracy.holds_until) return "error of the state: about " + one_digit(known);
    return fmt::format("digits hold until t = {:.6g}", *accuracy.holds_until);
}

Record record_of(const StateAccuracy& accuracy)
{
    return {{"estimate", accuracy.estimate}, {"holds_until", or_null(accuracy.holds_until)}};
}

std::string report_json(const RunOutcome& outcome)
{
    std::string rows;
    for (std::size_t k = 0; k < outcome.table.count(); ++k)
        rows += (k == 0 ? "" : ", ") + numbers_json(outcome.table.row(k));
    return with_member(to_json(record_of(outcome)), "rows", "[" + rows + "]");
}

std::string report_text(const RunOutcome& outcome)
{
    std::string text = fmt::format(
        "{}, scene {}: {} at t = {}; {}, {} ({} rejected), {}, {}\n", outcome.model, outcome.scene, outcome.status,
        brief(outcome.failed_at, 9), outcome.method, count_text(outcome.steps, "step"), outcome.rejected,
        count_text(outcome.rhs_calls, "right-hand side"), count_text(outcome.table.count(), "row"));
    if (outcome.newton > 0)
        text += fmt::format("  {}, {}\n", count_text(outcome.newton, "Newton iteration"),
                            count_text(outcome.decompositions, "factorisation"));
    text += events_text(outcome);
    const bool failed = !succeeded(outcome.status);
    if (const std::string reason = reason_text(outcome); !reason.empty())
        text += fmt::format("  {}\n{}", reason, last_state(outcome));
    else if (failed && outcome.steps > 0)
        text += last_state(outcome);
    text += branches_text(outcome);
    if (!outcome.not_finite.empty())
        text += fmt::format("  {} is no finite number there: {} needs the Jacobian; explicit methods such as dop853 do "
                            "not\n",
                            outcome.not_finite, outcome.method);
    if (failed && outcome.steps == 0) return text + start_hint(outcome);
    return text + accuracy_line(outcome.accuracy, outcome.second_run) + action_text(outcome) + figures_text(outcome);
}

std::string below_absolute_warning(const std::string& lanes, const std::string& tolerance)
{
    return fmt::format("warning: {} moved and never exceeded the absolute tolerance{}{}: the digits may be noise\n"
                       "hint: `absolute` in the scene far below them, or other units\n",
                       lanes, tolerance.empty() ? "" : " ", tolerance);
}

std::string start_note(const RunOutcome& outcome)
{
    const std::vector<std::string>& names = outcome.starts_on;
    if (names.empty()) return "";
    const bool one = names.size() == 1;
    return fmt::format("note: the run starts on event{} '{}', or beyond {}, and {} not happen there: at a start only "
                       "events with a direction and a jump do, whose function is 0 to the tolerance\n",
                       one ? "" : "s", fmt::join(names, "', '"), one ? "it" : "them", one ? "it does" : "they do");
}

std::string run_warnings(const RunOutcome& outcome)
{
    std::string text;
    for (const auto* drifts : {&outcome.invariants, &outcome.balance, &outcome.casimirs, &outcome.constraints})
        for (const Drift& drift : *drifts)
            if (std::isfinite(drift.moved_at) && is_exact(outcome, drift))
                text += fmt::format("warning: {} should be constant and moved by {}: by more than 1e-3 of its size {} "
                                    "from t = {} on{}\n",
                                    drift.name, brief(drift.most, 3), brief(drift.size, 3), brief(drift.moved_at, 9),
                                    outcome.status == "left_domain" ? ", where the run left the domain"
                                                                    : "; a smaller step or tolerance keeps it better");
    return text + small_lanes_warning(outcome);
}

ExitCode leave_rows(const Options& options, const Table& rows, const std::vector<std::string>& known,
                    const std::string& report, double t)
{
    const std::string output = options.get("output");
    const bool as_json = options.as_json();
    std::string place = "on standard output";
    if (!output.empty()) {
        const std::string file = partial_place(output);
        write_file(file, output.ends_with(".json") ? report : to_csv(rows, known));
        place = fmt::format("in '{}'", file);
    }
    if (as_json || output.empty()) write_standard_output(as_json ? report : to_csv(rows, known));
    const std::size_t count = rows.count();
    const std::string when = std::isfinite(t) ? fmt::format(" at t = {:.9g}", t) : "";
    write_standard_error(fmt::format("lagen: interrupted{}; {} so far {} {}\n", when,
                                     count == 1 ? "the row" : fmt::format("the {} rows", count),
                                     count == 1 ? "is" : "are", place));
    return ExitCode::interrupted;
}

} // namespace lagen
