// SPDX-License-Identifier: GPL-2.0-or-later
/// The table of a sweep on its way: FILE.partial holds the rows that are done, in their order, and becomes FILE with
/// the last of them. FILE.sweep says which rows of which sweep these are, for --resume and the merge.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lagen {

// Which part of a sweep this process computes, where mpirun, srun or a Slurm array started several of them.

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

/// What FILE.sweep says.
struct SweepIdentity {
    std::string key;        ///< of everything that the rows follow from
    std::string build;      ///< lagen with its runtime, and the compiler, in a line that is the same on all machines
    std::string command;    ///< for people
    std::uint64_t rows = 0; ///< of the whole sweep
    Shard shard;
    bool complete = false;
};

class SweepFile {
  public:
    /// Begins FILE.partial with `heading`; with `resume`, goes on with what is there, from its last whole row on, or
    /// leaves a complete FILE as it is. Throws UsageError where that is of another sweep, MachineError where nothing
    /// can be written.
    SweepFile(std::string path, const SweepIdentity& identity, const std::string& heading, bool resume);
    ~SweepFile();
    SweepFile(const SweepFile&) = delete;
    SweepFile& operator=(const SweepFile&) = delete;

    /// Rows that are in the file.
    [[nodiscard]] std::uint64_t rows() const { return rows_; }
    /// How many of them have which status.
    [[nodiscard]] const std::map<std::string, std::uint64_t>& statuses() const { return statuses_; }
    /// Whole lines behind the others. On MachineError those that were written stay.
    void append(std::string_view lines);
    /// FILE.partial becomes FILE.
    void complete();

  private:
    SweepFile(std::string path, const SweepIdentity& identity);
    void let_go();
    void start(const std::string& heading, bool resume);
    void begin(const std::string& heading);
    void go_on(const std::string& heading);
    void write(std::string_view lines);
    void see(std::string_view row);

    std::string path_, partial_;
    SweepIdentity identity_;
    int file_ = -1;
    std::uint64_t rows_ = 0;
    std::map<std::string, std::uint64_t> statuses_;
};

/// What stands in FILE.sweep; nothing where there is no such file.
[[nodiscard]] std::optional<SweepIdentity> find_identity(const std::string& path);
void write_identity(const std::string& path, const SweepIdentity& identity);

/// Whether FILE is there and is this sweep, whole. Throws UsageError where it is another one, or nothing says which.
[[nodiscard]] bool is_finished(const std::string& path, const SweepIdentity& identity);

/// The file `path`, made where it is missing, held by this process alone until it is closed. -1 with errno where that
/// cannot be; EWOULDBLOCK where another one holds it, unless `waits`. A file that was renamed or removed meanwhile is
/// not the one that is held.
[[nodiscard]] int open_locked(const std::string& path, bool waits);

/// `file` under the name `partial` becomes `path`, with its content on the disk before its name; false with errno.
[[nodiscard]] bool put_in_place(int file, const std::string& partial, const std::string& path);

/// Puts the parts of a sweep together, in the order of rows. Throws UsageError where they are not all parts of one, and
/// leaves what was there before.
void merge_sweep(const std::vector<std::string>& parts, const std::string& path);

/// The file of a rank that its launcher started: FILE.0-of-4.
[[nodiscard]] std::string rank_file(const std::string& path, const Shard& shard);

/// Where all files of the ranks of a sweep are complete: merges them and removes them, and answers true.
bool merge_ranks(const std::string& path, const SweepIdentity& identity);

} // namespace lagen
