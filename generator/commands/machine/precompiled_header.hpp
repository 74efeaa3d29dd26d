// SPDX-License-Identifier: GPL-2.0-or-later
/// The headers that every compiled model begins with, read by the compiler once and kept in the cache: KEY.hpp, which
/// includes them and says how long KEY.hpp.gch is. One that does not fit is left alone and made anew.
#pragma once

#include <string>
#include <vector>

namespace lagen {

class PrecompiledHeader {
  public:
    /// For models that are compiled by `command`, in the folder of the cache; `key` tells that command, the runtime and
    /// the compiler apart from others.
    PrecompiledHeader(const std::string& cache, const std::string& key);

    /// True where the precompiled header is there and whole; it then counts as used just now.
    [[nodiscard]] bool is_ready() const;
    /// The arguments of the compiler that use it.
    [[nodiscard]] std::vector<std::string> arguments() const;

    /// The arguments that make it, in the folder `scratch`, which is there.
    [[nodiscard]] std::vector<std::string> making(const std::string& scratch) const;
    /// Keeps what was made there; a failure is none of the command's.
    void keep(const std::string& scratch) const;
    /// It is not ready any more: the compiler did not take it.
    void discard() const;

  private:
    std::string header_; ///< the path of KEY.hpp
};

} // namespace lagen
