// SPDX-License-Identifier: MIT
/// The arguments of the program behind `lagen run` (driver.hpp says what they mean), read without a model.
#pragma once

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lagen::detail {

/// Arguments as they were given; numbers already read.
struct DriveArguments {
    std::vector<double> parameters, initial;
    std::optional<double> start, end, step, relative, absolute, interval;
    std::optional<std::size_t> max_steps, samples, every, branch;
    bool from_arrow = false;
    std::optional<std::vector<double>> at; ///< times of rows
    std::vector<double> input_rows;        ///< t and the inputs, one row after another
    std::string at_event, report, events, format = "csv";
    std::optional<std::string> columns;
};

/// A sentence about what is wrong, or empty.
using Complaint = std::string;

/// One finite number, all of the text, as strtod reads it.
inline std::optional<double> read_number(const std::string& text)
{
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0' || !std::isfinite(value)) return std::nullopt;
    return value;
}

inline std::optional<std::size_t> read_count(const std::string& text)
{
    if (text.empty() || text.find_first_not_of("0123456789") != std::string::npos) return std::nullopt;
    errno = 0;
    const unsigned long long value = std::strtoull(text.c_str(), nullptr, 10);
    if (errno != 0) return std::nullopt;
    return static_cast<std::size_t>(value);
}

/// "a,b,c" in its parts; an empty text has none.
inline std::vector<std::string> split(std::string_view text, char separator)
{
    std::vector<std::string> parts;
    while (!text.empty()) {
        const std::size_t cut = text.find(separator);
        parts.emplace_back(text.substr(0, cut));
        if (cut == std::string_view::npos) break;
        text.remove_prefix(cut + 1);
        if (text.empty()) parts.emplace_back();
    }
    return parts;
}

inline Complaint read_numbers(const std::string& key, const std::string& text, std::vector<double>& values)
{
    for (const std::string& part : split(text, ',')) {
        const auto value = read_number(part);
        if (!value) return key + ": \"" + part + "\" is not a finite number";
        values.push_back(*value);
    }
    return {};
}

/// The numbers of a file, separated by white space or commas.
inline Complaint read_times(const std::string& path, std::vector<double>& times, const std::string& key = "--at-file")
{
    std::FILE* file = std::fopen(path.c_str(), "r");
    if (file == nullptr) return key + ": \"" + path + "\" could not be opened";
    std::string text;
    char buffer[4096];
    for (std::size_t got = 0; (got = std::fread(buffer, 1, sizeof buffer, file)) > 0;) text.append(buffer, got);
    std::fclose(file);
    const char* separators = ", \t\r\n";
    for (std::size_t at = text.find_first_not_of(separators); at != std::string::npos;) {
        const std::size_t end = text.find_first_of(separators, at);
        const auto value = read_number(text.substr(at, end == std::string::npos ? end : end - at));
        if (!value) return key + ": \"" + path + "\" holds something that is not a finite number";
        times.push_back(*value);
        at = end == std::string::npos ? end : text.find_first_not_of(separators, end);
    }
    return {};
}

inline Complaint read_argument(const std::string& key, const std::string& text, DriveArguments& into)
{
    const auto number = [&](std::optional<double>& target) -> Complaint {
        target = read_number(text);
        return target ? Complaint{} : key + ": \"" + text + "\" is not a finite number";
    };
    const auto count = [&](std::optional<std::size_t>& target) -> Complaint {
        target = read_count(text);
        return target ? Complaint{} : key + ": \"" + text + "\" is not a count";
    };
    if (key == "--parameters") return read_numbers(key, text, into.parameters);
    if (key == "--initial") return read_numbers(key, text, into.initial);
    if (key == "--start") return number(into.start);
    if (key == "--end") return number(into.end);
    if (key == "--step") return number(into.step);
    if (key == "--relative") return number(into.relative);
    if (key == "--absolute") return number(into.absolute);
    if (key == "--interval") return number(into.interval);
    if (key == "--max-steps") return count(into.max_steps);
    if (key == "--samples") return count(into.samples);
    if (key == "--every") return count(into.every);
    if (key == "--branch") return count(into.branch);
    if (key == "--from" && text == "arrow") return into.from_arrow = true, Complaint{};
    if (key == "--from") return "--from: \"" + text + "\" is not arrow";
    if (key == "--at-file") return read_times(text, into.at.emplace());
    if (key == "--at-event") return into.at_event = text, Complaint{};
    if (key == "--inputs") return read_times(text, into.input_rows, key);
    if (key == "--report") return into.report = text, Complaint{};
    if (key == "--events") return into.events = text, Complaint{};
    if (key == "--columns") return into.columns = text, Complaint{};
    if (key == "--format" && (text == "csv" || text == "binary")) return into.format = text, Complaint{};
    if (key == "--format") return "--format: \"" + text + "\" is neither csv nor binary";
    return "unknown argument \"" + key + "\"";
}

inline Complaint read_arguments(int argc, char** argv, DriveArguments& into)
{
    for (int i = 1; i < argc; i += 2) {
        if (i + 1 >= argc) return std::string(argv[i]) + ": a value is required";
        const Complaint complaint = read_argument(argv[i], argv[i + 1], into);
        if (!complaint.empty()) return complaint;
    }
    return {};
}

/// More rows than this are a mistake, not a wish.
inline constexpr double most_rows = 1e8;

/// Times from `start` to `end`, both included: `count` even ones.
inline std::vector<double> even_times(double start, double end, std::size_t count)
{
    std::vector<double> times;
    times.reserve(count);
    for (std::size_t k = 0; k < count; ++k) {
        const double part = count > 1 ? static_cast<double>(k) / static_cast<double>(count - 1) : 1.0;
        times.push_back(k + 1 == count ? end : start + (end - start) * part);
    }
    return times;
}

/// start, start + interval, .. and the end, where it is not met within 1e-9 of the interval.
inline std::vector<double> spaced_times(double start, double end, double interval)
{
    std::vector<double> times;
    const double pieces = std::abs(end - start) / interval;
    const double sign = end < start ? -1.0 : 1.0;
    for (double k = 0; k <= pieces + 1e-9; ++k) times.push_back(start + sign * k * interval);
    if (std::abs(times.back() - end) <= 1e-9 * interval)
        times.back() = end;
    else
        times.push_back(end);
    return times;
}

/// Times must not run against the direction of the run: rows are written once, on the way.
inline Complaint check_order(const std::vector<double>& times, bool backward)
{
    for (std::size_t k = 1; k < times.size(); ++k)
        if (backward ? times[k] > times[k - 1] : times[k] < times[k - 1]) {
            char text[160];
            std::snprintf(text, sizeof text,
                          "--at-file: %.17g stands after %.17g, times in the direction of the run are required",
                          times[k], times[k - 1]);
            return text;
        }
    return {};
}

} // namespace lagen::detail
