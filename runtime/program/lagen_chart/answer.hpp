// SPDX-License-Identifier: MIT
/// How the programs of `lagen chart` take what they are asked for, and answer on standard output.
#pragma once

#include "lagen/kernel.hpp"
#include "lagen_chart/request.hpp"
#include "lagen_run/archive.hpp"

#include <cstdio>
#include <vector>

namespace lagen::chart {

/// The model with these parameters, and the start; false where there are other numbers of them.
template <class M>
[[nodiscard]] bool fill(const std::vector<double>& parameters, const std::vector<double>& initial, M& model,
                        typename M::State& start)
{
    using Scalar = typename M::Scalar;
    if (initial.size() != static_cast<std::size_t>(M::dimension)) return false;
    for (std::size_t i = 0; i < initial.size(); ++i) start[static_cast<Eigen::Index>(i)] = Scalar(initial[i]);
    if constexpr (HasParameters<M>) {
        if (parameters.size() != M::parameter_names.size()) return false;
        for (std::size_t k = 0; k < parameters.size(); ++k) model.parameter(k) = Scalar(parameters[k]);
    }
    return true;
}

/// The request of the one argument of a program, the model with its parameters, and the start; false where there is
/// none, or the numbers of them differ.
template <class M>
[[nodiscard]] bool take_request(int argc, char** argv, Request& request, M& model, typename M::State& start)
{
    return argc == 2 && detail::read_packed(argv[1], request) &&
           fill(request.parameters, request.initial, model, start);
}

template <class Report>
void answer(const Report& report)
{
    const std::string bytes = detail::packed(report);
    std::fwrite(bytes.data(), 1, bytes.size(), stdout);
    std::fflush(stdout);
}

} // namespace lagen::chart
