// SPDX-License-Identifier: MIT
/// What the programs of `lagen chart` are asked for: a file of lines of words,
///   parameters v v ..            every parameter, in the order of the header
///   initial v v ..               every state lane, base first
///   span START END
///   at T T ..                    sample times, in the direction of the run
///   reference HIGH LOW ..        at each of them every lane of the reference, as the sum of two doubles
///   tolerance TOL, most N        of the reference: the tolerance; of each run: steps
///   event NAME DIRECTION COUNT   of the reference: the run ends there (DIRECTION rising, falling or any)
///   ladder METHOD FIRST RATIO LAST CALLS   points FIRST, FIRST RATIO, .. to LAST, or until so many calls are expected;
///                                one point where RATIO is 1
/// Numbers are decimals with the digits of a double.
#pragma once

#include "lagen/integrate/options.hpp"

#include <cstddef>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace lagen::chart {

struct Ladder {
    std::string method;
    double first = 0, ratio = 1, last = 0;
    std::size_t calls = 0; ///< no point is run that is expected to take more
};

struct EventAsked {
    std::string name, direction;
    std::size_t count = 1;
};

struct Request {
    std::vector<double> parameters, initial, at, reference;
    Interval<double> span{0, 0};
    double tolerance = 1e-20;
    std::size_t most = 1'000'000;
    std::vector<EventAsked> events;
    std::vector<Ladder> ladders;
};

inline std::vector<double> rest_of(std::istringstream& words)
{
    std::vector<double> numbers;
    for (std::string word; words >> word;) numbers.push_back(std::strtod(word.c_str(), nullptr));
    return numbers;
}

/// False where the file cannot be read or a line says something else.
inline bool read_request(const char* path, Request& request)
{
    std::ifstream file(path);
    if (!file) return false;
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string key;
        words >> key;
        Ladder ladder;
        EventAsked event;
        if (key == "parameters")
            request.parameters = rest_of(words);
        else if (key == "initial")
            request.initial = rest_of(words);
        else if (key == "at")
            request.at = rest_of(words);
        else if (key == "reference")
            request.reference = rest_of(words);
        else if (key == "span" && words >> request.span.start >> request.span.end)
            continue;
        else if (key == "tolerance" && words >> request.tolerance)
            continue;
        else if (key == "most" && words >> request.most)
            continue;
        else if (key == "event" && words >> event.name >> event.direction >> event.count)
            request.events.push_back(event);
        else if (key == "ladder" &&
                 words >> ladder.method >> ladder.first >> ladder.ratio >> ladder.last >> ladder.calls)
            request.ladders.push_back(ladder);
        else
            return false;
    }
    return true;
}

/// The model with the parameters asked for, and the start; false where the numbers of them differ.
template <class M>
bool fill(const Request& request, M& model, typename M::State& start)
{
    using Scalar = typename M::Scalar;
    if (request.initial.size() != static_cast<std::size_t>(M::dimension)) return false;
    for (std::size_t i = 0; i < request.initial.size(); ++i)
        start[static_cast<Eigen::Index>(i)] = Scalar(request.initial[i]);
    if constexpr (HasParameters<M>) {
        if (request.parameters.size() != M::parameter_names.size()) return false;
        for (std::size_t k = 0; k < request.parameters.size(); ++k) model.parameter(k) = Scalar(request.parameters[k]);
    }
    return true;
}

} // namespace lagen::chart
