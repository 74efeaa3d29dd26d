// SPDX-License-Identifier: MIT
/// `lagen::ensemble`: many trajectories of one model, by several threads and by the lanes of packs, handed over in
/// their order.
///   lagen::ensemble(top, 1'000'000,
///                   [](std::size_t k, Top& each) { return Top::state({.g3 = 1}, {.w3 = 5 + 1e-6 * double(k)}); },
///                   {0.0, 10.0}, lagen::Dop853{}, [&](std::size_t k, const lagen::Run<Top>& run) { .. });
/// A program that uses it is linked with the threads of its platform (-pthread).
#pragma once

#include "lagen/ensemble/in_order.hpp"
#include "lagen/integrate.hpp"
#include "lagen/lanes/abreast.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <exception>
#include <optional>
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

namespace detail {

/// Trajectories that are begun and handed over together.
template <class M>
struct EnsembleBlock {
    std::size_t first = 0, begun = 0, ended = 0;
    std::vector<Run<M>> runs;
};

/// What one thread of an ensemble does with the blocks that `source` hands out: one trajectory after another.
template <class M, class MakeState, class Method, class Source>
void integrate_blocks(const M& model, MakeState& make_state, Interval<real_t<typename M::Scalar>> span,
                      const Method& method, const Options<M>& options, Source& source)
{
    while (EnsembleBlock<M>* block = source.next(true)) {
        for (std::size_t k = 0; k < block->runs.size(); ++k) {
            M each = model;
            const typename M::State s = make_state(block->first + k, each);
            block->runs[k] = integrate(each, s, span, method, options);
        }
        source.done(*block);
    }
}

/// The same by the lanes of packs. What make_state throws is thrown when the trajectories before it have ended.
template <class M, class MakeState, class Method, class Source>
requires GoesAbreast<M, Method>
void integrate_blocks(const M& model, MakeState& make_state, Interval<real_t<typename M::Scalar>> span,
                      const Method& method, const Options<M>& options, Source& source)
{
    Nobody nobody;
    struct Place {
        EnsembleBlock<M>* block = nullptr;
        std::size_t index = 0;
        std::optional<M> model;
        typename M::State start;
        Trajectory<M, Method, Nobody> given;
    };
    constexpr int lanes = abreast_lanes<typename M::Scalar>;
    std::array<Place, static_cast<std::size_t>(lanes)> places;
    EnsembleBlock<M>* open = nullptr;
    std::size_t unfinished = 0;
    std::exception_ptr failure;
    const auto next = [&](int lane) -> const Trajectory<M, Method, Nobody>* {
        if (failure) return nullptr;
        if (open == nullptr) {
            open = source.next(unfinished == 0);
            if (open == nullptr) return nullptr;
            open->begun = open->ended = 0;
            ++unfinished;
        }
        Place& place = places[static_cast<std::size_t>(lane)];
        place.block = open;
        place.index = open->begun;
        place.model.emplace(model);
        try {
            place.start = make_state(open->first + place.index, *place.model);
        } catch (...) {
            failure = std::current_exception();
            return nullptr;
        }
        if (++open->begun == open->runs.size()) open = nullptr;
        place.given = {&*place.model, &place.start, span, &method, &options, &nobody};
        return &place.given;
    };
    const auto done = [&](int lane, Run<M>&& run) {
        const Place& place = places[static_cast<std::size_t>(lane)];
        place.block->runs[place.index] = std::move(run);
        if (++place.block->ended < place.block->runs.size()) return;
        --unfinished;
        source.done(*place.block);
    };
    Abreast<M, Method, lanes, Nobody>().run(next, done);
    if (failure) std::rethrow_exception(failure);
}

} // namespace detail

/// Integrates trajectories 0, 1, .., count - 1.
/// @param make_state make_state(k, each) returns the start of trajectory k; `each` is a copy of `model` for it alone,
///                   whose parameters it may change. Called by several threads at once.
/// @param take       take(k, run) is called once for each trajectory, in the order of k, one call at a time; `run` may
///                   be moved from. It may be called by any of the threads.
/// The runs are those of `integrate`, with the same bits, whatever the number of threads. Where the model can be had
/// over packs (a generated one, or one that says so by a member `takes_packs`) and the method is an explicit
/// Runge-Kutta or Nystrom method or Taylor's, trajectories go by the lanes of packs: lanes/abreast.hpp says when
/// the bits depend on the compiler's options. What make_state or take throws ends the work and is thrown to the caller;
/// those of the blocks before it were handed over. At most 4 blocks a thread exist at a time, and as many more as the
/// lanes take.
template <RightHandSide M, class MakeState, class Method, class Take>
void ensemble(const M& model, std::size_t count, MakeState&& make_state,
              std::type_identity_t<Interval<real_t<typename M::Scalar>>> span, const Method& method, Take&& take,
              const std::type_identity_t<EnsembleOptions<M>>& options = {})
{
    using Block = detail::EnsembleBlock<M>;
    const std::size_t size = options.block == 0 ? 1 : options.block;
    std::size_t next = 0;
    const auto begin = [&](Block& block) {
        block.first = next;
        block.runs.resize(std::min(size, count - next));
        next += block.runs.size();
        return !block.runs.empty();
    };
    const auto work = [&](auto& source) {
        detail::integrate_blocks(model, make_state, span, method, options.run, source);
    };
    const auto deliver = [&](Block& block) {
        for (std::size_t k = 0; k < block.runs.size(); ++k) take(block.first + k, block.runs[k]);
    };
    const std::size_t threads = detail::thread_count(options.threads), slots = detail::slots_a_thread(size);
    detail::InOrder<Block, decltype(begin), decltype(work), decltype(deliver)> pieces(slots * threads, begin, work,
                                                                                      deliver);
    pieces.run(threads);
}

} // namespace lagen
