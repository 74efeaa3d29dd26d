// SPDX-License-Identifier: GPL-2.0-or-later
/// Taylor's method over compiled models beside the classes that they were made of: bits, events, domains, memory.
#include "counted_memory.hpp"

#include "heavy_top.hpp"

#include "compile/programs/compiled_series_models.hpp"

namespace {

using lagen::CompiledModel;
using lagen::Taylor;

CompiledModel loaded(const char* name)
{
    const std::string folder = std::filesystem::read_symlink("/proc/self/exe").parent_path().string() + "/";
    auto [status, model] = CompiledModel::load(folder + name + ".so");
    if (status != lagen::LoadStatus::ok) std::printf("%s %s\n", name, lagen::to_text(status));
    return std::move(model);
}

template <class State>
std::vector<lagen::EventRequest<double, State>> requests(std::size_t events)
{
    std::vector<lagen::EventRequest<double, State>> all(events);
    for (std::size_t k = 0; k < events; ++k) all[k].index = k;
    return all;
}

/// The same run of both: their ends, rows, events and counts.
template <class M>
void compare(const char* name, const M& model, const typename M::State& s, double end, const Taylor& method,
             std::size_t events = 0)
{
    const CompiledModel compiled = loaded(name);
    const std::vector<double> at{0.1 * end, 0.45 * end, end};
    const auto asked = requests<typename M::State>(events);
    const auto asked_later = requests<Eigen::VectorXd>(events);
    const auto a = lagen::integrate(model, s, {0.0, end}, method, {.at = at, .events = asked});
    const auto b =
        lagen::integrate(compiled, Eigen::VectorXd(s), {0.0, end}, method, {.at = at, .events = asked_later});
    bool same = a.status() == b.status() && a.t == b.t && a.failed_at == b.failed_at && same_bits(a.state, b.state);
    same = same && a.rhs_calls == b.rhs_calls && a.steps == b.steps && a.rejected == b.rejected;
    same = same && a.times == b.times && a.events.size() == b.events.size();
    for (std::size_t k = 0; same && k < a.states.size(); ++k) same = same_bits(a.states[k], b.states[k]);
    for (std::size_t k = 0; same && k < a.events.size(); ++k)
        same = a.events[k].t == b.events[k].t && a.events[k].request == b.events[k].request &&
               same_bits(a.events[k].state, b.events[k].state);
    std::printf("%s %s %s, %zu events\n", name, lagen::to_text(b.status()), same ? "same" : "other", b.events.size());
}

void count_memory(const char* name, const Eigen::VectorXd& s)
{
    bool good = false;
    const std::size_t taken = memory_of_steps(loaded(name), s, Taylor{.tolerance = 1e-12}, good);
    std::printf("memory %s %zu %s\n", name, taken, good ? "ok" : "failed");
}

/// Of a run that looks for an event in every step and meets none: a longer one takes no more.
std::size_t memory_of_watch(const CompiledModel& compiled, double end)
{
    const auto asked = requests<Eigen::VectorXd>(1);
    const Eigen::VectorXd s = Eigen::Vector2d(0.5, 0);
    const std::size_t before = allocations;
    const auto run = lagen::integrate(compiled, s, {0.0, end}, Taylor{.tolerance = 1e-12}, {.events = asked});
    return run && run.events.empty() ? allocations - before : 0;
}

} // namespace

int main()
{
    namespace t = lagen::testing;
    using Top = lagen::models::heavy_top<double>;
    const Top::State top = Top::state({.g1 = 0.1, .g2 = 0.6, .g3 = 0.8}, {.w1 = 0.3, .w2 = -0.2, .w3 = 5});
    const Eigen::Vector2d swaying(1, 0);
    const t::Growing<double>::State growing = t::Growing<double>::State::LinSpaced(0.001, 0.5);
    compare("heavy_top", Top{}, top, 3, Taylor{.tolerance = 1e-12});
    compare("heavy_top", Top{}, top, 3, Taylor{.order = 11});
    compare("heavy_top", Top{}, top, -3, Taylor{});
    compare("prey", t::Prey<double>{}, Eigen::Vector2d(0.5, 2), 30, Taylor{});
    compare("sway", t::Sway{}, swaying, 30, Taylor{.tolerance = 1e-12}, 2);
    compare("capped", t::Capped{}, Eigen::Vector2d(0.9, 0.1), 30, Taylor{.tolerance = 1e-12});
    compare("capped", t::Capped{}, Eigen::Vector2d(-1, 1.2), 30, Taylor{.tolerance = 1e-12}, 2);
    compare("falling", t::Falling<double>{}, Eigen::Matrix<double, 1, 1>(1), 0.9, Taylor{});
    compare("falling", t::Falling<double>{}, Eigen::Matrix<double, 1, 1>(1), 2, Taylor{});
    compare("bounded", t::Bounded<double>{}, Eigen::Matrix<double, 1, 1>(1), 2, Taylor{});
    compare("growing", t::Growing<double>{}, growing, 4, Taylor{.tolerance = 1e-13});
    count_memory("heavy_top", top);
    count_memory("sway", swaying);
    count_memory("capped", Eigen::Vector2d(0.9, 0.1));
    count_memory("bounded", Eigen::VectorXd::Constant(1, -1));
    const CompiledModel sway = loaded("sway");
    const std::size_t memory = memory_of_watch(sway, 20);
    std::printf("memory of a watch %s\n", memory > 0 && memory_of_watch(sway, 200) == memory ? "same" : "more");
    std::printf(
        "without series %s\n",
        lagen::to_text(lagen::integrate(loaded("without"), Eigen::VectorXd(top), {0.0, 1.0}, Taylor{}).status()));
}
