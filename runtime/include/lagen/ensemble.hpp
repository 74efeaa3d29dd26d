// SPDX-License-Identifier: MIT
/// `lagen::ensemble`: many trajectories of one model, by several threads, handed over in their order.
///   lagen::ensemble(top, 1'000'000,
///                   [](std::size_t k, Top& each) { return Top::state({.g3 = 1}, {.w3 = 5 + 1e-6 * double(k)}); },
///                   {0.0, 10.0}, lagen::Dop853{}, [&](std::size_t k, const lagen::Run<Top>& run) { .. });
/// A program that uses it is linked with the threads of its platform (-pthread).
#pragma once

#include "lagen/ensemble/in_order.hpp"
#include "lagen/integrate.hpp"

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace lagen {

/// Everything optional of an ensemble.
template <class M>
struct EnsembleOptions {
    std::size_t threads = 0; ///< 0: as many as the machine gives this process
    std::size_t block = 16;  ///< trajectories that a thread takes at once
    Options<M> run{};        ///< of each trajectory; what it points to is shared, `progress` is called by all threads
};

/// Integrates trajectories 0, 1, .., count - 1.
/// @param make_state make_state(k, each) returns the start of trajectory k; `each` is a copy of `model` for it alone,
///                   whose parameters it may change. Called by several threads at once.
/// @param take       take(k, run) is called once for each trajectory, in the order of k, one call at a time; `run` may
///                   be moved from. It may be called by any of the threads.
/// The runs are those of `integrate`, with the same bits, whatever the number of threads. At most 4 blocks a thread
/// exist at a time. What make_state or take throws ends the work and is thrown to the caller; those of the blocks
/// before it were handed over.
template <RightHandSide M, class MakeState, class Method, class Take>
void ensemble(const M& model, std::size_t count, MakeState&& make_state,
              std::type_identity_t<Interval<real_t<typename M::Scalar>>> span, const Method& method, Take&& take,
              const std::type_identity_t<EnsembleOptions<M>>& options = {})
{
    struct Block {
        std::size_t first = 0;
        std::vector<Run<M>> runs;
    };
    const std::size_t size = options.block == 0 ? 1 : options.block;
    std::size_t next = 0;
    const auto begin = [&](Block& block) {
        block.first = next;
        block.runs.resize(std::min(size, count - next));
        next += block.runs.size();
        return !block.runs.empty();
    };
    const auto work = [&](Block& block) {
        for (std::size_t k = 0; k < block.runs.size(); ++k) {
            M each = model;
            const typename M::State s = make_state(block.first + k, each);
            block.runs[k] = integrate(each, s, span, method, options.run);
        }
    };
    const auto deliver = [&](Block& block) {
        for (std::size_t k = 0; k < block.runs.size(); ++k) take(block.first + k, block.runs[k]);
    };
    const std::size_t threads = detail::thread_count(options.threads);
    detail::InOrder<Block, decltype(begin), decltype(work), decltype(deliver)> pieces(4 * threads, begin, work,
                                                                                      deliver);
    pieces.run(threads);
}

} // namespace lagen
