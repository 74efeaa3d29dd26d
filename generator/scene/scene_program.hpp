// SPDX-License-Identifier: GPL-2.0-or-later
/// The program of a scene: its text, and the job that it is given.
#pragma once

#include "graph/kernel.hpp"
#include "lagen_run/job.hpp"
#include "machine/process.hpp"
#include "scene/methods.hpp"
#include "scene/sample_times.hpp"
#include "scene/start_state.hpp"

namespace lagen {

/// Relative and absolute tolerance where neither the scene nor the command line gives one.
inline constexpr long double standard_tolerance = 1e-10L;

/// A program around a header: its folder in runtime/program, which has a driver.hpp, and the function in there.
struct Driver {
    const char* folder;
    const char* function;
    bool abreast = false; ///< several trajectories at a time, where the method allows it
};
inline constexpr Driver run_driver{"lagen_run", "drive"};
inline constexpr Driver sweep_driver{"lagen_sweep", "sweep", true};

/// The whole of a program that includes these headers, in this order, and returns this call of a function of lagen.
[[nodiscard]] std::string main_text(const std::vector<std::string>& headers, const std::string& call);

/// The whole main of the program that integrates class `name` (of header "model.hpp") with `method`.
[[nodiscard]] std::string program_text(const Driver& driver, const std::string& name, const MethodEntry& method,
                                       bool reversible = false);

/// The whole source of a compiled model of class `name` (of header "model.hpp"); `packs`: its right-hand side over
/// packs too.
[[nodiscard]] std::string model_text(const std::string& name, bool packs = false);

/// A column of the table: a state lane or an entry of the observables.
struct TableColumn {
    std::string name;
    bool state = true;
    std::size_t index = 0;
};

/// What a program's table can hold, in the program's order.
struct TableNames {
    std::vector<std::string> lanes, observables;
    std::vector<std::string> states; ///< the columns of a scene that observes nothing else; lanes or observables
};
[[nodiscard]] TableNames names_of(const Model& model, const KernelModule& module);

/// The columns of these names: lanes, else observables.
[[nodiscard]] std::vector<TableColumn> columns_named(const TableNames& names, const std::vector<std::string>& wanted);

/// `t` apart, what the scene observes: all states, or exactly its `observe` list.
[[nodiscard]] std::vector<TableColumn> columns_of(const TableNames& names, const Scene& scene);

/// Everything that a run is told, before it is rounded to doubles.
struct ProgramInput {
    std::string method_type; ///< the runtime's type of the method
    std::vector<long double> parameters;
    std::vector<long double> initial;    ///< state lanes, base first
    bool from_arrow = false;             ///< of a discrete motion: its momenta are those of the arrow
    std::optional<std::uint64_t> branch; ///< of one that starts from momenta: the number of its first arrow
    SampleTimes times;
    std::optional<long double> step, relative, absolute;
    std::optional<std::uint64_t> most_steps;      ///< without it the runtime's
    std::vector<std::vector<double>> held_inputs; ///< rows t, u_1, u_2, .. of a table; empty: none
    const std::vector<Event>* events = nullptr;
    std::vector<TableColumn> columns;
};

/// Gives `input`, whose columns are known, what the values of the scene say. Throws as `finite_numbers`, `start` and
/// sample_times (`stretch`) do.
void use_values(ProgramInput& input, const Scene& scene, const SceneValues& values, StartState& start, bool stretch);

/// The doubles next to these numbers.
[[nodiscard]] std::vector<double> doubles_of(const std::vector<long double>& values);

/// The job of a run with this input, in doubles.
[[nodiscard]] detail::RunJob job_of(const ProgramInput& input);
[[nodiscard]] std::vector<detail::EventAsked> events_asked(const std::vector<Event>& events);

/// Throws MachineError where the program was not started.
void require_started(const ProcessResult& result, const std::string& program);
/// MachineError of a program that ended as none may; `rest` stands behind what it said.
[[noreturn]] void refuse_end(const ProcessResult& result, const std::string& rest = {});

} // namespace lagen
