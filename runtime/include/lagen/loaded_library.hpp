// SPDX-License-Identifier: MIT
/// A shared object that holds a compiled model, loaded into the process, and why one cannot be loaded. What the loader
/// of the system does not look at is looked at before: a file that was cut off would end the process by a signal.
#pragma once

#include "lagen/requirements.hpp"

#include "lagen/compiled_model.h"

#include <dlfcn.h>
#if defined(__linux__)
#include <elf.h>
#include <link.h>
#endif

#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>

namespace lagen {

/// What `CompiledModel::load` answers.
enum class LoadStatus {
    ok,
    not_found,     ///< there is no such file, or it cannot be read
    not_a_model,   ///< it is no shared object, a damaged one, or one without a compiled model
    other_version, ///< of lagen/compiled_model.h
    other_machine, ///< compiled for another processor, or for instructions that this one does not have
};

[[nodiscard]] constexpr const char* to_text(LoadStatus status) noexcept
{
    switch (status) {
    case LoadStatus::ok: return "ok";
    case LoadStatus::not_found: return "not_found";
    case LoadStatus::not_a_model: return "not_a_model";
    case LoadStatus::other_version: return "other_version";
    case LoadStatus::other_machine: return "other_machine";
    }
    return "unknown";
}

namespace detail {

/// Has this processor the instructions that LAGEN_COMPILED_MODEL_MACHINE named?
[[nodiscard]] inline bool runs_here([[maybe_unused]] std::string_view machine) noexcept
{
    if (machine == "base") return true;
#if defined(__x86_64__)
    if (machine == "avx512f") return __builtin_cpu_supports("avx512f") != 0;
    if (machine == "avx2") return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
    if (machine == "avx") return __builtin_cpu_supports("avx") != 0;
    if (machine == "sse4.2") return __builtin_cpu_supports("sse4.2") != 0;
#endif
    return false;
}

/// `ok` where the file is a whole shared object for this kind of processor, as far as its headers tell.
[[nodiscard]] inline LoadStatus look_at_object(const std::string& path)
{
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
    if (!file) return LoadStatus::not_found;
#if defined(__linux__)
    ElfW(Ehdr) header{}, own{};
    if (std::fread(&header, sizeof header, 1, file.get()) != 1) return LoadStatus::not_a_model;
    if (std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0) return LoadStatus::not_a_model;
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> self(std::fopen("/proc/self/exe", "rb"), std::fclose);
    if (self && std::fread(&own, sizeof own, 1, self.get()) == 1 &&
        (header.e_machine != own.e_machine || header.e_ident[EI_CLASS] != own.e_ident[EI_CLASS] ||
         header.e_ident[EI_DATA] != own.e_ident[EI_DATA]))
        return LoadStatus::other_machine;
    if (header.e_type != ET_DYN || header.e_phentsize != sizeof(ElfW(Phdr))) return LoadStatus::not_a_model;
    if (std::fseek(file.get(), 0, SEEK_END) != 0) return LoadStatus::not_a_model;
    const auto size = static_cast<unsigned long>(std::ftell(file.get()));
    if (header.e_shoff + static_cast<unsigned long>(header.e_shnum) * header.e_shentsize > size)
        return LoadStatus::not_a_model;
    std::fseek(file.get(), static_cast<long>(header.e_phoff), SEEK_SET);
    for (unsigned k = 0; k < header.e_phnum; ++k) {
        ElfW(Phdr) part{};
        if (std::fread(&part, sizeof part, 1, file.get()) != 1) return LoadStatus::not_a_model;
        if (part.p_offset > size || part.p_filesz > size - part.p_offset) return LoadStatus::not_a_model;
    }
#endif
    return LoadStatus::ok;
}

/// Closed with the last model that uses it.
class LoadedLibrary {
  public:
    LoadedLibrary(const LoadedLibrary&) = delete;
    LoadedLibrary& operator=(const LoadedLibrary&) = delete;
    ~LoadedLibrary() { ::dlclose(handle_); }

    /// The library where its compiled model can be used here; else why not.
    [[nodiscard]] static std::pair<LoadStatus, std::shared_ptr<const LoadedLibrary>> open(const std::string& path)
    {
        const LoadStatus looked = look_at_object(path);
        if (looked != LoadStatus::ok) return {looked, nullptr};
        // A name without a slash would be looked for in the system's folders.
        const std::string place = path.find('/') == std::string::npos ? "./" + path : path;
        void* handle = ::dlopen(place.c_str(), RTLD_NOW | RTLD_LOCAL);
        if (handle == nullptr) return {LoadStatus::not_a_model, nullptr};
        std::shared_ptr<LoadedLibrary> library(new LoadedLibrary(handle));
        const void* machine = ::dlsym(handle, "lagen_compiled_model_machine");
        void* function = ::dlsym(handle, "lagen_compiled_model_of");
        if (machine == nullptr || function == nullptr) return {LoadStatus::not_a_model, nullptr};
        if (!runs_here(static_cast<const char*>(machine))) return {LoadStatus::other_machine, nullptr};
        library->table_ = reinterpret_cast<const lagen_compiled_model* (*)()>(function)();
        if (library->table_->version != LAGEN_COMPILED_MODEL_VERSION ||
            library->table_->size != sizeof(lagen_compiled_model))
            return {LoadStatus::other_version, nullptr};
        return {LoadStatus::ok, library};
    }

    [[nodiscard]] const lagen_compiled_model& table() const noexcept { return *table_; }
    /// Another symbol of it; null where there is none.
    [[nodiscard]] void* symbol(const char* name) const noexcept { return ::dlsym(handle_, name); }

  private:
    explicit LoadedLibrary(void* handle) noexcept : handle_(handle) {}

    void* handle_;
    const lagen_compiled_model* table_ = nullptr;
};

} // namespace detail

} // namespace lagen
