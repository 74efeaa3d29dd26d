// SPDX-License-Identifier: MIT
/// What the programs of `lagen chart` are asked for in a file, and what they answer (lagen_run/archive.hpp). No name of
/// the runtime is in here.
#pragma once

#include "lagen_run/job.hpp"
#include "lagen_run/report.hpp"

namespace lagen::chart {

/// Points first, first ratio, .. to last, or until so many calls are expected; one point where the ratio is 1.
struct Ladder {
    std::string method;
    double first = 0, ratio = 1, last = 0;
    std::size_t calls = 0; ///< no point is run that is expected to take more

    static void each(auto& self, auto& archive) { archive(self.method, self.first, self.ratio, self.last, self.calls); }
};

struct Request {
    std::vector<double> parameters; ///< every one, in the order of the header
    std::vector<double> initial;    ///< every state lane, base first
    double start = 0, end = 0;
    std::vector<double> at;                 ///< sample times, in the direction of the run
    std::vector<double> reference;          ///< at each of them every lane of the reference, as the sum of two doubles
    double tolerance = 1e-20;               ///< of the reference
    std::size_t most = 1'000'000;           ///< steps of each run
    std::vector<detail::EventAsked> events; ///< of the reference: the run ends there
    std::vector<Ladder> ladders;

    static void each(auto& self, auto& archive)
    {
        archive(self.parameters, self.initial, self.start, self.end, self.at, self.reference, self.tolerance, self.most,
                self.events, self.ladders);
    }
};

/// A run of a method with one tolerance or step.
struct PointReport {
    std::string method;
    double parameter = 0;
    double error = detail::not_known; ///< against the reference; none where the run failed
    detail::RunReport run;            ///< its seconds are the least of several runs

    static void each(auto& self, auto& archive) { archive(self.method, self.parameter, self.error, self.run); }
};

/// What a reference came to; where events are asked for no rows, and `t` is that of the event.
struct ReferenceReport {
    std::string status;
    double t = 0;
    std::size_t steps = 0, calls = 0;
    std::vector<double> rows; ///< high and low part of every lane, a sample that was reached after the other

    static void each(auto& self, auto& archive) { archive(self.status, self.t, self.steps, self.calls, self.rows); }
};

} // namespace lagen::chart
