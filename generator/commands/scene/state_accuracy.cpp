// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/scene/state_accuracy.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace lagen {

namespace {

constexpr double lost = 1e-2; ///< of the size of the states: no digit is left

using Numbers = std::vector<double>;

/// The fields of a row; what is no finite number is NaN.
Numbers numbers_in(std::string_view line)
{
    Numbers numbers;
    for (const std::string_view field : fields(line))
        numbers.push_back(field.empty() ? NAN : std::strtod(std::string(field).c_str(), nullptr));
    return numbers;
}

/// Steps of half the length come to the same time but for rounding.
bool is_same_time(double a, double b)
{
    return std::fabs(a - b) <= 1e-13 * std::max(std::fabs(a), std::fabs(b));
}

/// |a - b|_2 over the columns behind t that are numbers in both.
double distance(const Numbers& a, const Numbers& b)
{
    double most = 0;
    for (std::size_t k = 1; k < a.size(); ++k)
        if (std::isfinite(a[k]) && std::isfinite(b[k])) most = std::hypot(most, a[k] - b[k]);
    return most;
}

/// "3e-9": a digit says how large an error is.
std::string one_digit(double value)
{
    std::string text = fmt::format("{:.1g}", value);
    const std::size_t exponent = text.find('e');
    if (exponent != std::string::npos && text[exponent + 2] == '0') text.erase(exponent + 2, 1);
    return text;
}

} // namespace

std::optional<StateAccuracy> accuracy_of(const Table& run, const Table& second, bool by_number)
{
    const std::vector<std::string_view> lines = run.lines(), finer = second.lines();
    std::vector<double> distances;
    double size = 0;
    for (std::size_t k = 0; k < std::min(lines.size(), finer.size()); ++k) {
        const Numbers here = numbers_in(lines[k]), there = numbers_in(finer[k]);
        if (here.size() != there.size() || here.size() < 2) break;
        if (!by_number && !is_same_time(here[0], there[0])) break;
        distances.push_back(distance(here, there));
        size = std::max(size, distance(there, Numbers(there.size(), 0.0)));
    }
    if (distances.empty()) return std::nullopt;
    const double most = *std::ranges::max_element(distances);
    if (!by_number && distances.size() == 1 && most == 0) return std::nullopt; // the start, it seems
    StateAccuracy accuracy{most > 0 ? most / size : 0};
    const auto first = std::ranges::find_if(distances, [&](double each) { return each > lost * size; });
    if (first != distances.end()) {
        const std::string_view line = lines[static_cast<std::size_t>(first - distances.begin())];
        accuracy.holds_until = line.substr(0, line.find(','));
    }
    return accuracy;
}

std::string text_of(const StateAccuracy& accuracy)
{
    if (accuracy.holds_until.empty()) return "error of the state: about " + one_digit(accuracy.estimate);
    return fmt::format("digits hold until t = {:.6g}", std::strtod(accuracy.holds_until.c_str(), nullptr));
}

std::string accuracy_line(const std::optional<StateAccuracy>& accuracy, const std::string& second_run)
{
    if (second_run.empty()) return "";
    return accuracy ? fmt::format("  {} ({})\n", text_of(*accuracy), second_run)
                    : fmt::format("  error of the state: {}\n", second_run);
}

std::string json_of(const StateAccuracy& accuracy)
{
    return fmt::format("{{\"estimate\": {}, \"holds_until\": {}}}",
                       std::isfinite(accuracy.estimate) ? fmt::format("{}", accuracy.estimate) : "null",
                       accuracy.holds_until.empty() ? "null" : accuracy.holds_until);
}

} // namespace lagen
