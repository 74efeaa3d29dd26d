// SPDX-License-Identifier: GPL-2.0-or-later
/// Which part of a sweep this process computes, where mpirun, srun or a Slurm array started several of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace lagen {

/// Rows index, index + count, index + 2 count, .. of a sweep.
struct Shard {
    std::uint64_t index = 0, count = 1;

    [[nodiscard]] std::string text() const { return std::to_string(index) + "/" + std::to_string(count); }
    /// How many of `rows` rows these are.
    [[nodiscard]] std::uint64_t size(std::uint64_t rows) const { return (rows + count - 1 - index) / count; }
    [[nodiscard]] bool operator==(const Shard&) const = default;
};

/// "k/n" with 0 <= k < n; UsageError otherwise.
[[nodiscard]] Shard read_shard(const std::string& text);

/// Of the environment: rank and size of mpirun (OMPI_COMM_WORLD_RANK and _SIZE, or PMI_RANK and _SIZE), else of srun
/// (SLURM_PROCID, SLURM_NTASKS), within each task of a Slurm array (SLURM_ARRAY_TASK_ID, _MIN, _COUNT, _STEP). 0/1
/// where nothing is set. UsageError where what is set gives no part.
[[nodiscard]] Shard launched_shard();

/// How many threads a process may take where its launcher started others on this machine or says how many it has:
/// SLURM_CPUS_PER_TASK, else the cores of this process over OMPI_COMM_WORLD_LOCAL_SIZE.
[[nodiscard]] std::size_t launched_threads();

} // namespace lagen
