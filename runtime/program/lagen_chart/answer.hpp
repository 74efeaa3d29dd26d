// SPDX-License-Identifier: MIT
/// How the programs of `lagen chart` take what they are asked for, and answer on standard output.
#pragma once

#include "lagen/kernel.hpp"
#include "lagen_chart/request.hpp"
#include "lagen_run/archive.hpp"

#include <cstdio>

namespace lagen::chart {

/// The request of the one argument of a program, the model with its parameters, and the start; false where there is
/// none, or the numbers of them differ.
template <class M>
[[nodiscard]] bool take_request(int argc, char** argv, Request& request, M& model, typename M::State& start)
{
    using Scalar = typename M::Scalar;
    if (argc != 2 || !detail::read_packed(argv[1], request)) return false;
    if (request.initial.size() != static_cast<std::size_t>(M::dimension)) return false;
    for (std::size_t i = 0; i < request.initial.size(); ++i)
        start[static_cast<Eigen::Index>(i)] = Scalar(request.initial[i]);
    if constexpr (HasParameters<M>) {
        if (request.parameters.size() != M::parameter_names.size()) return false;
        for (std::size_t k = 0; k < request.parameters.size(); ++k) model.parameter(k) = Scalar(request.parameters[k]);
    }
    return true;
}

template <class Report>
void answer(const Report& report)
{
    const std::string bytes = detail::packed(report);
    std::fwrite(bytes.data(), 1, bytes.size(), stdout);
    std::fflush(stdout);
}

} // namespace lagen::chart
