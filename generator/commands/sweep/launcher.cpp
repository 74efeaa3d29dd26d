// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/sweep/launcher.hpp"

#include "commands/sweep/sweep_rows.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <thread>

namespace lagen {

namespace {

/// A variable of the environment that holds a whole number; nothing where it is not set.
std::optional<std::uint64_t> variable(const char* name)
{
    const char* text = std::getenv(name);
    if (text == nullptr || *text == '\0') return std::nullopt;
    const std::optional<std::uint64_t> value = read_whole(text);
    if (value) return value;
    throw UsageError(fmt::format("{} is '{}', where a whole number is required", name, text),
                     "--shard k/n says which rows are computed");
}

/// Of one launcher; nothing where its variables are not set.
std::optional<Shard> shard_of(const char* rank, const char* size)
{
    const std::optional<std::uint64_t> index = variable(rank), count = variable(size);
    if (!index || !count) return std::nullopt;
    if (*index < *count) return Shard{*index, *count};
    throw UsageError(fmt::format("{} is {} and {} is {}, which is no part of a sweep", rank, *index, size, *count),
                     "--shard k/n says which rows are computed");
}

/// Tasks of an array are numbered by its indices, which may begin anywhere and have a step, but no gaps.
Shard array_shard()
{
    const std::optional<std::uint64_t> task = variable("SLURM_ARRAY_TASK_ID"),
                                       count = variable("SLURM_ARRAY_TASK_COUNT");
    if (!task || !count) return {};
    const std::uint64_t least = variable("SLURM_ARRAY_TASK_MIN").value_or(0);
    const std::uint64_t step = std::max<std::uint64_t>(variable("SLURM_ARRAY_TASK_STEP").value_or(1), 1);
    const std::uint64_t most = variable("SLURM_ARRAY_TASK_MAX").value_or(least + (*count - 1) * step);
    if (*task >= least && (*task - least) % step == 0 && (*task - least) / step < *count &&
        most == least + (*count - 1) * step)
        return {(*task - least) / step, *count};
    throw UsageError(
        fmt::format("task {} of a Slurm array of {} from {} to {} cannot be numbered", *task, *count, least, most),
        fmt::format("give the array indices without gaps (--array=0-{}), or --shard k/n", *count - 1));
}

} // namespace

Shard read_shard(const std::string& text)
{
    const std::size_t slash = std::min(text.find('/'), text.size());
    const std::optional<std::uint64_t> index = read_whole(text.substr(0, slash));
    const std::optional<std::uint64_t> count = read_whole(text.substr(std::min(slash + 1, text.size())));
    if (index && count && *index < *count) return {*index, *count};
    throw UsageError(fmt::format("--shard is '{}', where k/n with 0 <= k < n is required", text));
}

Shard launched_shard()
{
    std::optional<Shard> found;
    for (const auto& [rank, size] : {std::pair("OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"),
                                     {"PMI_RANK", "PMI_SIZE"},
                                     {"SLURM_PROCID", "SLURM_NTASKS"}})
        if (!found) found = shard_of(rank, size);
    const Shard inner = found.value_or(Shard{}), outer = array_shard();
    return {outer.index * inner.count + inner.index, outer.count * inner.count};
}

std::size_t launched_threads()
{
    if (const std::optional<std::uint64_t> cpus = variable("SLURM_CPUS_PER_TASK"); cpus && *cpus > 0)
        return static_cast<std::size_t>(*cpus);
    const std::size_t cores = std::max(std::thread::hardware_concurrency(), 1U);
    const std::uint64_t processes = std::max<std::uint64_t>(variable("OMPI_COMM_WORLD_LOCAL_SIZE").value_or(1), 1);
    return std::max<std::size_t>(cores / static_cast<std::size_t>(processes), 1);
}

} // namespace lagen
