// SPDX-License-Identifier: GPL-2.0-or-later
/// A start is evaluated as `run` evaluates it, from the decimals that stand in its row: `lagen run` with these values
/// has the same bits.
#include "commands/sweep/sweep_run.hpp"

#include "commands/report/run.hpp"
#include "commands/sweep/sweep_rows.hpp"
#include "lagen_run/archive.hpp"
#include "machine/write_file.hpp"
#include "model/families.hpp"
#include "model/plain_names.hpp"
#include "text/diagnostic.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <utility>

namespace lagen {

namespace {

/// Starts that are asked for at once.
constexpr int most_starts = 16;

/// Fields between the swept names and the status.
std::size_t inner_fields(std::size_t columns, std::size_t events)
{
    return 1 + columns + 2 * events + 2 * columns;
}

void append_doubles(std::string& bytes, const std::vector<long double>& values)
{
    for (const long double value : values) {
        const auto number = static_cast<double>(value);
        char raw[sizeof number];
        std::memcpy(raw, &number, sizeof number);
        bytes.append(raw, sizeof raw);
    }
}

} // namespace

std::string sweep_heading(const SweepSetting& setting, const SweepRows& rows)
{
    std::vector<std::string> names{"index", "status", "t"};
    for (const TableColumn& column : columns_of(setting.record.names, setting.scene)) names.push_back(column.name);
    const std::vector<std::string> known = all_names(setting.model), columns = plain_names(names, known);
    std::vector<std::string> swept;
    for (const SweptName& name : rows.names) swept.push_back(name.name);
    swept = plain_names(swept, known);
    std::string text = columns[0];
    const auto put = [&](const std::string& name) { text += ',' + name; };
    for (std::size_t k = 0; k < swept.size(); ++k) put(rows.names[k].option + '.' + swept[k]);
    for (std::size_t k = 2; k < columns.size(); ++k) put(columns[k]);
    for (const Event& event : setting.scene.events) {
        const std::string name = "event." + plain_name(event.name);
        put(name + ".count");
        put(name + ".t");
    }
    for (std::size_t k = 3; k < columns.size(); ++k) {
        put("min." + columns[k]);
        put("max." + columns[k]);
    }
    put(columns[1]);
    return text + "\r\n";
}

SweepRun::SweepRun(const SweepSetting& setting, const SweepRows& rows, const Shard& shard, StartState start,
                   SweepFile& file)
    : setting_(setting), rows_(rows), shard_(shard), start_(std::move(start)), file_(file), first_rows_(file.rows()),
      evaluate_(setting.model, setting.scene), next_(shard.index + file.rows() * shard.count)
{
    input_.columns = columns_of(setting_.record.names, setting_.scene);
    input_.events = &setting_.scene.events;
}

detail::SweepJob SweepRun::job() const
{
    ProgramInput common = input_;
    const Sampling& sampling = setting_.scene.sampling;
    common.times.kind = sampling.kind;
    common.times.event = sampling.event;
    common.times.count = sampling.kind == Sampling::Kind::count ? sampling.count : 201;
    common.times.at.resize(sampling.at.size());
    return {job_of(common), setting_.threads};
}

/// The status of a row that cannot start, or "".
std::string SweepRun::start_of(const std::vector<std::string>& texts)
{
    for (std::size_t k = 0; k < texts.size(); ++k) {
        const auto& [option, name] = rows_.names[k];
        (option == "set" ? parameters_ : initial_)[name] = std::strtold(texts[k].c_str(), nullptr);
    }
    try {
        const SceneValues values = evaluate_(parameters_, initial_);
        const RunRecord& record = setting_.record;
        if (!record.proved_for.empty() &&
            !is_proved_for(record, setting_.model, finite_numbers(values.parameters, setting_.scene))) {
            ++unproved_;
            return "left_domain";
        }
        use_values(input_, setting_.scene, values, start_, false);
        return "";
    } catch (const StartError& error) {
        return reasons_.try_emplace(error.status(), error.diagnostic().message).first->first;
    } catch (const ModelError& error) {
        return reasons_.try_emplace("invalid_input", error.diagnostic().message).first->first;
    } catch (const MathematicsError& error) {
        return reasons_.try_emplace("newton_diverged", error.message()).first->first;
    }
}

/// The start of a row in the form of lagen_sweep/driver.hpp.
void SweepRun::append_start(std::string& bytes, std::uint64_t index)
{
    std::string fields = std::to_string(index);
    std::vector<std::string> texts;
    for (const double value : rows_.values(index)) {
        texts.push_back(fmt::format("{}", value));
        fields += ',' + texts.back();
    }
    pending_.push_back(std::move(fields));
    const std::size_t known = reasons_.size();
    const std::string status = start_of(texts);
    if (reasons_.size() > known) reasons_[status] = fmt::format("row {}: {}", index, reasons_[status]);
    const auto failure = std::ranges::find(failures_, status) - failures_.begin();
    if (!status.empty() && failure == std::ssize(failures_)) failures_.push_back(status);
    append_doubles(bytes, {status.empty() ? 0 : static_cast<long double>(failure + 1)});
    input_.parameters.resize(free_parameters(setting_.model).size());
    input_.initial.resize(setting_.record.names.lanes.size());
    append_doubles(bytes, input_.parameters);
    append_doubles(bytes, input_.initial);
    append_doubles(bytes, {input_.times.start, input_.times.end, input_.step.value_or(0), input_.relative.value_or(0),
                           input_.absolute.value_or(0), input_.times.interval.value_or(0)});
    input_.times.at.resize(setting_.scene.sampling.at.size());
    append_doubles(bytes, input_.times.at);
}

std::string SweepRun::next_starts()
{
    std::string bytes;
    for (int k = 0; k < most_starts && next_ < rows_.count; ++k, next_ += shard_.count) append_start(bytes, next_);
    return bytes;
}

/// The status of the start with this number, which the program was told not to integrate.
const std::string& SweepRun::failed_status(const std::string& number) const
{
    const std::optional<std::uint64_t> place = read_whole(number);
    if (!place || *place == 0 || *place > failures_.size())
        throw InternalError("the program of a sweep names a failure that it was not told of");
    return failures_[static_cast<std::size_t>(*place - 1)];
}

/// "<LANE>" before the row.
void SweepRun::take_small_lanes(std::string& line)
{
    if (line.starts_with('<')) ++rows_below_absolute_;
    for (; line.starts_with('<'); line.erase(0, line.find('>') + 1))
        lanes_below_absolute_.insert(setting_.record.names.lanes.at(std::strtoull(line.c_str() + 1, nullptr, 10)));
}

void SweepRun::take(const char* bytes, std::size_t count)
{
    unfinished_.append(bytes, count);
    std::string lines;
    std::size_t begin = 0;
    for (std::size_t end = 0; (end = unfinished_.find('\n', begin)) != std::string::npos; begin = end + 1) {
        if (pending_.empty()) throw InternalError("the program of a sweep gave a row too many");
        std::string line = unfinished_.substr(begin, end - begin);
        take_small_lanes(line);
        if (line.starts_with('#'))
            line = std::string(inner_fields(input_.columns.size(), setting_.scene.events.size()), ',') +
                   failed_status(line.substr(1));
        lines += pending_.front() + ',' + line + "\r\n";
        pending_.pop_front();
    }
    unfinished_.erase(0, begin);
    file_.append(lines);
    if (file_.rows() > first_rows_) progress_.show([this] { return progress(); });
}

std::string SweepRun::progress() const
{
    std::uint64_t failed = 0;
    for (const auto& [status, rows] : file_.statuses())
        if (!succeeded(status)) failed += rows;
    const std::uint64_t done = file_.rows(), all = shard_.size(rows_.count);
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begun_;
    const double left = passed.count() * static_cast<double>(all - done) / static_cast<double>(done - first_rows_);
    return fmt::format("{:3.0f} %  {} of {} rows{}, {} left",
                       100 * static_cast<double>(done) / static_cast<double>(all), done, all,
                       failed == 0 ? "" : fmt::format(", {} failed", failed), duration_text(left));
}

void SweepRun::run()
{
    const std::uint64_t wanted = shard_.size(rows_.count);
    if (file_.rows() == wanted) return;
    std::string first = detail::packed(detail::packed(job())); // with its size
    const ProcessResult result = run_process(
        {setting_.record.program}, [this](const char* bytes, std::size_t count) { take(bytes, count); },
        [this, &first] { return std::exchange(first, {}) + next_starts(); });
    progress_.clear();
    require_started(result, setting_.record.program);
    if (file_.rows() == wanted && result.exit_code == 0) return write_standard_error(result.error);
    if (result.interrupted)
        throw InterruptedError(fmt::format("lagen: interrupted, {} of {} rows are done; --resume goes on with them",
                                           file_.rows(), wanted));
    refuse_end(result, fmt::format("hint: {} of {} rows are done; --resume goes on with them", file_.rows(), wanted));
}

std::string duration_text(double seconds)
{
    constexpr double minute = 60, hour = 60 * minute, day = 24 * hour;
    const double whole = std::ceil(seconds);
    const auto two = [&](double unit, const char* name, double part, const char* part_name) {
        return fmt::format("{:.0f} {} {:.0f} {}", std::floor(whole / unit), name,
                           std::floor(std::fmod(whole, unit) / part), part_name);
    };
    if (!(whole >= minute)) return fmt::format("{:.0f} s", whole);
    if (whole < hour) return two(minute, "min", 1, "s");
    if (whole < day) return two(hour, "h", minute, "min");
    return two(day, "d", hour, "h");
}

} // namespace lagen
