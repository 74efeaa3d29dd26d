// SPDX-License-Identifier: MIT
/// The program behind `lagen sweep`: integrates one model with one method from many starts, by several threads. The
/// whole generated main is
///   #include "model.hpp"
///   #include "lagen_sweep/driver.hpp"
///   int main(int argc, char** argv) { return lagen::sweep<lagen::models::NAME<double>, lagen::METHOD>(argc, argv); }
///
/// Arguments, each followed by its value; --columns, --events and --samples mean what they mean to the program of
/// `lagen run` (lagen_run/driver.hpp):
///   --threads N           0: as many as the machine gives this process
///   --rows count|interval|at   where the rows of a trajectory are: --samples of them, an interval of its own apart, or
///                         at --times K times of its own
///
/// Standard input holds native doubles, for each trajectory
///   failure, parameters.., state lanes.., start, end, step, relative, absolute, interval, times..
/// `failure` is 0, or a number that stands for the reason why there is nothing to integrate: then the line of the
/// trajectory is "#" and that number. Standard output has a line for each trajectory, in their order: t of the last
/// good state, the columns there, for each event how often it happened and when it did last, for each column its least
/// and largest value at accepted steps and rows, the status as to_text(Status). Numbers are shortest decimals; what is
/// no finite number is an empty field. The bits are those of lagen_run/driver.hpp, whatever the number of threads. Exit
/// codes: 0 done, 4 wrong arguments, 5 standard input ends within a trajectory, standard output takes no more, or there
/// is not memory enough.
#pragma once

#include "lagen/ensemble/in_order.hpp"
#include "lagen_run/driver.hpp"
#include "lagen_sweep/record.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>

namespace lagen {

namespace detail {

struct SweepArguments {
    DriveArguments run;
    std::size_t threads = 0, times = 0;
    std::string rows = "count";
};

inline Complaint read_sweep_arguments(int argc, char** argv, SweepArguments& into)
{
    for (int i = 1; i < argc; i += 2) {
        const std::string key = argv[i];
        if (i + 1 >= argc) return key + ": a value is required";
        const std::string text = argv[i + 1];
        Complaint complaint;
        if (key == "--threads" || key == "--times") {
            const auto count = read_count(text);
            if (!count) return key + ": \"" + text + "\" is not a count";
            (key == "--threads" ? into.threads : into.times) = *count;
        } else if (key == "--rows") {
            into.rows = text;
            if (text != "count" && text != "interval" && text != "at")
                return "--rows: \"" + text + "\" is neither count, interval nor at";
        } else if (complaint = read_argument(key, text, into.run); !complaint.empty()) {
            return complaint;
        }
    }
    return {};
}

/// Trajectories that one thread integrates one after the other: what is read, and the lines that are written.
struct SweepBlock {
    std::vector<double> numbers;
    std::string lines;
};

template <class M, class Method>
class Sweep {
  public:
    Sweep(const SweepArguments& given, const DrivePlan<M>& plan) : given_(given), plan_(plan)
    {
        if constexpr (HasParameters<M>) parameters_ = M::parameter_names.size();
        length_ = 1 + parameters_ + static_cast<std::size_t>(M::dimension) + 6 + given.times;
    }

    int run()
    {
        const auto begin = [this](SweepBlock& block) { return read(block); };
        const auto work = [this](SweepBlock& block) { integrate_all(block); };
        const auto deliver = [this](SweepBlock& block) {
            if (std::fwrite(block.lines.data(), 1, block.lines.size(), stdout) != block.lines.size() ||
                std::fflush(stdout) != 0)
                cut_ = true;
        };
        const std::size_t threads = thread_count(given_.threads);
        InOrder<SweepBlock, decltype(begin), decltype(work), decltype(deliver)> pieces(4 * threads, begin, work,
                                                                                       deliver);
        pieces.run(threads);
        return cut_ ? complain("the trajectories could not be read or written to their end", 5) : 0;
    }

  private:
    /// As many trajectories as take about a millisecond: finished ones are written soon, short ones cost no locks.
    std::size_t block_size() const noexcept
    {
        constexpr double wanted = 1e-3, most = 64;
        return static_cast<std::size_t>(std::clamp(wanted / seconds_.load(), 1.0, most));
    }

    bool read(SweepBlock& block)
    {
        block.numbers.resize(block_size() * length_);
        const std::size_t got = std::fread(block.numbers.data(), sizeof(double), block.numbers.size(), stdin);
        if (got % length_ != 0) cut_ = true;
        block.numbers.resize(got / length_ * length_);
        return !block.numbers.empty();
    }

    void integrate_all(SweepBlock& block)
    {
        DrivePlan<M> plan = plan_;
        DriveArguments given = given_.run;
        block.lines.clear();
        const auto begin = std::chrono::steady_clock::now();
        for (std::size_t k = 0; k < block.numbers.size(); k += length_)
            append_line(block.lines, &block.numbers[k], given, plan);
        const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
        seconds_ =
            std::max(passed.count(), 1e-9) * static_cast<double>(length_) / static_cast<double>(block.numbers.size());
    }

    void append_line(std::string& lines, const double* from, DriveArguments& given, DrivePlan<M>& plan) const
    {
        const double failure = *from++;
        if (failure != 0) {
            lines += '#' + std::to_string(static_cast<int>(failure)) + '\n';
            return;
        }
        Method method{};
        const bool usable = use(from, given, plan, method);
        SweepRecord<M> record(plan.model, plan.columns);
        Run<M> run;
        run.outcome = Status::invalid_input;
        run.t = std::numeric_limits<double>::quiet_NaN();
        if (usable)
            run = integrate(plan.model, plan.initial, plan.span, method,
                            Options<M>{.at = plan.times, .events = plan.events}, record);
        append_number(lines, run.t);
        for (const double value : record.values()) append_field(lines, value);
        append_events(lines, run);
        for (std::size_t k = 0; k < record.values().size(); ++k) {
            append_field(lines, record.least()[k]);
            append_field(lines, record.most()[k]);
        }
        lines += std::string(",") + to_text(run.status()) + '\n';
    }

    /// What the numbers of a trajectory say; false where they make no sense.
    bool use(const double* from, DriveArguments& given, DrivePlan<M>& plan, Method& method) const
    {
        const auto take = [&from](std::size_t count) {
            const double* begin = from;
            from += count;
            return std::vector<double>(begin, from);
        };
        given.parameters = take(parameters_);
        given.initial = take(static_cast<std::size_t>(M::dimension));
        given.start = *from++;
        given.end = *from++;
        given.step = *from++;
        given.relative = *from++;
        given.absolute = *from++;
        given.interval = *from++;
        if (given_.rows != "interval") given.interval.reset();
        Complaint complaint = plan_values(given, plan);
        if (complaint.empty()) complaint = plan_times(given, plan);
        if (given_.rows == "at") plan.times = take(given_.times);
        if (complaint.empty()) complaint = plan_method<M>(given, method);
        return complaint.empty();
    }

    static void append_field(std::string& lines, double value)
    {
        lines += ',';
        append_number(lines, value);
    }

    void append_events(std::string& lines, const Run<M>& run) const
    {
        for (std::size_t request = 0; request < plan_.events.size(); ++request) {
            std::size_t count = 0;
            double last = std::numeric_limits<double>::quiet_NaN();
            for (const auto& found : run.events)
                if (found.request == request) ++count, last = found.t;
            lines += ',' + std::to_string(count);
            append_field(lines, last);
        }
    }

    const SweepArguments& given_;
    const DrivePlan<M>& plan_;
    std::size_t parameters_ = 0, length_ = 0;
    std::atomic<double> seconds_ = 1; ///< of a trajectory of the last block
    std::atomic<bool> cut_ = false;   ///< what is read or written ended early
};

} // namespace detail

/// The whole program; see the top of the file. Returns the exit code.
template <class M, class Method>
int sweep(int argc, char** argv)
try {
    static_assert(std::is_same_v<typename M::Scalar, double>, "lagen sweep integrates in double");
    detail::SweepArguments given;
    detail::DrivePlan<M> plan;
    detail::Complaint complaint = detail::read_sweep_arguments(argc, argv, given);
    if (complaint.empty()) complaint = detail::plan_columns(given.run, plan);
    for (const std::string& event : detail::split(given.run.events, ','))
        if (complaint.empty()) complaint = detail::plan_event(event, plan);
    if (!complaint.empty()) return detail::complain(complaint, 4);
    return detail::Sweep<M, Method>(given, plan).run();
} catch (const std::exception& error) {
    return detail::complain(std::string("the trajectories cannot be integrated: ") + error.what(), 5);
}

} // namespace lagen
