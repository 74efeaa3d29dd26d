// SPDX-License-Identifier: GPL-2.0-or-later
/// Depth-first search with its own stack: a chain of parameters is as long as a user makes it.
#include "model/dependency_order.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <unordered_map>

namespace lagen {

namespace {

struct Visit {
    std::size_t value;
    std::vector<std::string> uses;
    std::size_t next;
};

[[noreturn]] void refuse_cycle(const std::vector<NamedTree>& values, const std::vector<Visit>& path, std::size_t first,
                               const char* noun)
{
    constexpr std::size_t most = 8;
    const auto start = std::find_if(path.begin(), path.end(), [&](const Visit& v) { return v.value == first; });
    std::string cycle;
    for (auto each = start; each != path.end(); ++each) {
        if (static_cast<std::size_t>(each - start) == most) {
            cycle += "... -> ";
            break;
        }
        cycle += values[each->value].name + " -> ";
    }
    throw ModelError(fmt::format("the {} depend on each other in a cycle: {}{}", noun, cycle, values[first].name),
                     values[first].where, "give one of them a value of its own");
}

} // namespace

std::vector<std::size_t> dependency_order(const std::vector<NamedTree>& values, const char* noun)
{
    std::unordered_map<std::string, std::size_t> index; // looked up, never iterated
    for (std::size_t k = 0; k < values.size(); ++k) index.emplace(values[k].name, k);
    enum class State { fresh, open, done };
    std::vector<State> state(values.size(), State::fresh);
    std::vector<std::size_t> order;
    std::vector<Visit> path;
    const auto enter = [&](std::size_t k) {
        state[k] = State::open;
        path.push_back(Visit{k, names_in(values[k].value), 0});
    };
    for (std::size_t first = 0; first < values.size(); ++first) {
        if (state[first] == State::fresh) enter(first);
        while (!path.empty()) {
            Visit& top = path.back();
            if (top.next == top.uses.size()) {
                state[top.value] = State::done;
                order.push_back(top.value);
                path.pop_back();
                continue;
            }
            const auto place = index.find(top.uses[top.next++]);
            if (place == index.end() || state[place->second] == State::done) continue;
            if (state[place->second] == State::open) refuse_cycle(values, path, place->second, noun);
            enter(place->second);
        }
    }
    return order;
}

} // namespace lagen
