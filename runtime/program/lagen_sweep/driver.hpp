// SPDX-License-Identifier: MIT
/// The program behind `lagen sweep`: integrates one model with one method from many starts, by several threads. The
/// whole generated main is
///   #include "model.hpp"
///   #include "lagen_sweep/driver.hpp"
///   int main(int argc, char** argv) { return lagen::sweep<lagen::models::NAME<double>, lagen::METHOD>(argc, argv); }
///
/// Standard input holds a SweepJob (lagen_run/archive.hpp) behind its size, then native doubles, for each trajectory
///   failure, parameters.., state lanes.., start, end, step, relative, absolute, interval, times..
/// `failure` is 0, or a number that stands for the reason why there is nothing to integrate: then the line of the
/// trajectory is "#" and that number. Standard output has a line for each trajectory, in their order: "<LANE>" of each
/// lane that moved and never exceeded the absolute tolerance (no part of the row), t of the last
/// good state, the columns there, for each event how often it happened and when it did last, for each column its least
/// and largest value at accepted steps and rows, the status as to_text(Status). Numbers are shortest decimals; what is
/// no finite number is an empty field. The bits are those of lagen_run/driver.hpp, whatever the number of threads. Exit
/// codes: 0 done, 4 there is no job that fits the model, 5 standard input ends within a trajectory, standard output
/// takes no more, or there is not memory enough.
#pragma once

#include "lagen/ensemble/in_order.hpp"
#include "lagen/lanes/abreast.hpp"
#include "lagen_run/driver.hpp"
#include "lagen_run/text.hpp"
#include "lagen_sweep/record.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <optional>

namespace lagen {

namespace detail {

/// Trajectories that are read together, and their lines, which are written together.
struct SweepBlock {
    std::vector<double> numbers;
    std::vector<std::string> lines;
    std::size_t begun = 0, ended = 0;
};

template <class M, class Method>
class Sweep {
  public:
    explicit Sweep(const SweepJob& job) : job_(job), starts_on_(job.run.events.size())
    {
        if constexpr (HasParameters<M>) parameters_ = M::parameter_names.size();
        length_ = 1 + parameters_ + static_cast<std::size_t>(M::dimension) + 6 + job.run.rows.at.size();
    }

    int run()
    {
        const auto begin = [this](SweepBlock& block) { return read(block); };
        const auto work = [this](auto& source) { this->integrate_all(source); };
        const auto deliver = [this](SweepBlock& block) {
            std::string text;
            for (const std::string& line : block.lines) text += line;
            if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
                cut_ = true;
        };
        const std::size_t threads = thread_count(job_.threads), slots = slots_a_thread(1);
        InOrder<SweepBlock, decltype(begin), decltype(work), decltype(deliver)> pieces(slots * threads, begin, work,
                                                                                       deliver);
        pieces.run(threads);
        tell_starts();
        return cut_ ? complain("the trajectories could not be read or written to their end", 5) : 0;
    }

  private:
    /// A line on standard error for each event on which trajectories start, and that does not happen there.
    void tell_starts() const
    {
        for (std::size_t k = 0; k < starts_on_.size(); ++k)
            if (const std::size_t count = starts_on_[k]; count > 0)
                std::fprintf(stderr, "note: %zu row%s on event '%s', or beyond it, and it does not happen there\n",
                             count, count == 1 ? " starts" : "s start", job_.run.events[k].name.c_str());
    }

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

    /// A trajectory that is integrated, and what its march asks for.
    struct Row {
        SweepBlock* block = nullptr;
        std::size_t index = 0;
        RunPlan<M> plan;
        Method method{};
        Options<M> options;
        std::optional<SweepRecord<M>> record;
    };

    /// What one thread does: a row after another from the blocks of `source`.
    template <class Source>
    class Rows {
      public:
        Rows(const Sweep& sweep, Source& source) : sweep_(sweep), source_(source), job_(sweep.job_.run) {}

        /// Sets `row` to the next one that there is something to integrate of; false where there is none now.
        bool next(Row& row)
        {
            for (;;) {
                if (open_ == nullptr) {
                    open_ = source_.next(unfinished_ == 0);
                    if (open_ == nullptr) return false;
                    open_->lines.assign(open_->numbers.size() / sweep_.length_, {});
                    open_->begun = open_->ended = 0;
                    ++unfinished_;
                }
                row.block = open_;
                row.index = open_->begun;
                if (++open_->begun == open_->lines.size()) open_ = nullptr;
                const double* from = &row.block->numbers[row.index * sweep_.length_];
                const double failure = *from++;
                if (failure != 0) {
                    done(row, '#' + std::to_string(static_cast<int>(failure)) + '\n');
                    continue;
                }
                const bool usable = sweep_.use(from, job_, row.plan, row.method);
                row.options = {.at = row.plan.times, .events = row.plan.events};
                row.record.emplace(row.plan.model, job_.columns, absolute_of(row.method));
                if (usable) return true;
                Run<M> run;
                run.outcome = Status::invalid_input;
                run.t = std::numeric_limits<double>::quiet_NaN();
                done(row, run);
            }
        }

        void done(Row& row, const Run<M>& run) { done(row, sweep_.line_of(*row.record, run)); }

      private:
        void done(Row& row, std::string line)
        {
            SweepBlock& block = *row.block;
            block.lines[row.index] = std::move(line);
            if (++block.ended < block.lines.size()) return;
            --unfinished_;
            const auto now = std::chrono::steady_clock::now();
            const std::chrono::duration<double> passed = now - last_;
            last_ = now;
            sweep_.seconds_ = std::max(passed.count(), 1e-9) / static_cast<double>(block.lines.size());
            source_.done(block);
        }

        const Sweep& sweep_;
        Source& source_;
        RunJob job_;                 ///< of a row
        SweepBlock* open_ = nullptr; ///< the block that is being begun
        std::size_t unfinished_ = 0;
        std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
    };

    template <class Source>
    void integrate_all(Source& source) const
    {
        Rows<Source> rows(*this, source);
        if constexpr (GoesAbreast<M, Method>) {
            constexpr int lanes = abreast_lanes<double>;
            std::vector<Row> each(static_cast<std::size_t>(lanes));
            std::array<Trajectory<M, Method, SweepRecord<M>>, static_cast<std::size_t>(lanes)> given;
            const auto next = [&](int lane) -> const Trajectory<M, Method, SweepRecord<M>>* {
                Row& row = each[static_cast<std::size_t>(lane)];
                if (!rows.next(row)) return nullptr;
                auto& asked = given[static_cast<std::size_t>(lane)];
                asked = {&row.plan.model, &row.plan.initial, row.plan.span, &row.method, &row.options, &*row.record};
                return &asked;
            };
            const auto done = [&](int lane, const Run<M>& run) {
                rows.done(each[static_cast<std::size_t>(lane)], run);
            };
            Abreast<M, Method, lanes, SweepRecord<M>>().run(next, done);
        } else {
            for (Row row; rows.next(row);)
                rows.done(row, integrate(row.plan.model, row.plan.initial, row.plan.span, row.method, row.options,
                                         *row.record));
        }
    }

    std::string line_of(const SweepRecord<M>& record, const Run<M>& run) const
    {
        for (const std::size_t request : run.starts_on) ++starts_on_[request];
        std::string line;
        const auto& small = record.small_lanes();
        for (Eigen::Index i = 0; i < small.size(); ++i)
            if (small.is_small(i)) line += '<' + std::to_string(i) + '>';
        std::vector<double> numbers{run.t};
        numbers.insert(numbers.end(), record.values().begin(), record.values().end());
        append_fields(line, numbers);
        append_events(line, run);
        for (std::size_t k = 0; k < record.values().size(); ++k) {
            line += ',';
            append_fields(line, std::array{record.least()[k], record.most()[k]});
        }
        return line + ',' + to_text(run.status()) + '\n';
    }

    /// What the numbers of a trajectory say; false where they make no sense.
    bool use(const double* from, RunJob& job, RunPlan<M>& plan, Method& method) const
    {
        const auto take = [&from](std::size_t count) {
            const double* begin = from;
            from += count;
            return std::vector<double>(begin, from);
        };
        job.parameters = take(parameters_);
        job.initial = take(static_cast<std::size_t>(M::dimension));
        for (double* const number : {&job.start, &job.end, &job.step, &job.relative, &job.absolute, &job.rows.interval})
            *number = *from++;
        job.rows.at = take(job.rows.at.size());
        return plan_events(job, plan) && plan_values(job, plan) && plan_method<M>(job, method);
    }

    void append_events(std::string& lines, const Run<M>& run) const
    {
        for (std::size_t request = 0; request < job_.run.events.size(); ++request) {
            std::size_t count = 0;
            double last = std::numeric_limits<double>::quiet_NaN();
            for (const auto& found : run.events)
                if (found.request == request) ++count, last = found.t;
            lines += ',' + std::to_string(count) + ',';
            append_fields(lines, std::array{last});
        }
    }

    const SweepJob& job_;
    std::size_t parameters_ = 0, length_ = 0;
    mutable std::vector<std::atomic<std::size_t>> starts_on_; ///< of each event, how many trajectories start on it
    mutable std::atomic<double> seconds_ = 1;                 ///< of a trajectory of the last block
    std::atomic<bool> cut_ = false;                           ///< what is read or written ended early
};

} // namespace detail

/// The whole program; see the top of the file. It takes no arguments. Returns the exit code.
template <class M, class Method>
int sweep(int, char**)
try {
    static_assert(std::is_same_v<typename M::Scalar, double>, "lagen sweep integrates in double");
    detail::SweepJob job;
    std::size_t size = 0;
    bool good = std::fread(&size, sizeof size, 1, stdin) == 1 && size < 100'000'000;
    std::string bytes(good ? size : 0, ' ');
    std::string_view rest = bytes;
    good = good && std::fread(bytes.data(), 1, size, stdin) == size && detail::take_packed(rest, job) && rest.empty();
    if (detail::RunPlan<M> plan;
        !good || !detail::plan_columns(job.run, plan.model) || !detail::plan_events(job.run, plan))
        return detail::complain("a job for this model is required", 4);
    return detail::Sweep<M, Method>(job).run();
} catch (const std::exception& error) {
    return detail::complain((std::string("the trajectories cannot be integrated: ") + error.what()).c_str(), 5);
}

} // namespace lagen
