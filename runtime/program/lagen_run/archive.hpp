// SPDX-License-Identifier: MIT
/// Structures as bytes, between lagen and the programs that it compiles around models: both are made of these headers,
/// on one machine. A structure S that is written and read has
///   static void each(auto& self, auto& archive) { archive(self.a, self.b, ..); }
/// with members that are numbers, enumerations, strings, optionals, vectors, or such structures.
#pragma once

#include <cfloat>
#include <cstdio>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

namespace lagen::detail {

template <class T>
inline constexpr bool is_plain = std::is_arithmetic_v<T> || std::is_enum_v<T>;
/// The bytes of a number; those behind the digits of an extended one say nothing.
template <class T>
inline constexpr std::size_t plain_size = std::is_same_v<T, long double>&& LDBL_MANT_DIG == 64 ? 10 : sizeof(T);

class Packer {
  public:
    template <class... Members>
    void operator()(const Members&... members)
    {
        (put(members), ...);
    }
    template <class T>
    void put(const T& value)
    {
        if constexpr (is_plain<T>) {
            bytes.append(reinterpret_cast<const char*>(&value), plain_size<T>);
        } else if constexpr (requires { value.has_value(); }) {
            put(value.has_value());
            if (value) put(*value);
        } else if constexpr (requires { value.begin(); }) {
            put(value.size());
            for (const auto& each : value) put(each);
        } else {
            T::each(value, *this);
        }
    }

    std::string bytes{};
};

class Unpacker {
  public:
    explicit Unpacker(std::string_view bytes) : rest(bytes) {}

    template <class... Members>
    void operator()(Members&... members)
    {
        (get(members), ...);
    }
    template <class T>
    void get(T& value)
    {
        if constexpr (is_plain<T>) {
            good = good && rest.size() >= plain_size<T>;
            if (!good) return;
            if constexpr (std::is_same_v<T, bool>)
                value = rest[0] != 0;
            else
                std::memcpy(&value, rest.data(), plain_size<T>);
            rest.remove_prefix(plain_size<T>);
        } else if constexpr (requires { value.has_value(); }) {
            value.reset();
            if (bool has = false; get(has), has) get(value.emplace());
        } else if constexpr (requires { value.begin(); }) {
            std::size_t size = 0;
            get(size);
            value.clear();
            for (std::size_t k = 0; k < size && good; ++k) {
                value.push_back({});
                get(value.back());
            }
        } else {
            T::each(value, *this);
        }
    }

    std::string_view rest; ///< bytes that are behind
    bool good = true;      ///< none was missing
};

template <class T>
[[nodiscard]] std::string packed(const T& value)
{
    Packer packer;
    packer.put(value);
    return packer.bytes;
}

/// Takes one structure from the front of `bytes`; false where these are none.
template <class T>
[[nodiscard]] bool take_packed(std::string_view& bytes, T& value)
{
    Unpacker unpacker(bytes);
    unpacker.get(value);
    bytes = unpacker.rest;
    return unpacker.good;
}

/// False where the file cannot be read, or holds something else.
template <class T>
[[nodiscard]] bool read_packed(const char* path, T& value)
{
    std::FILE* file = std::fopen(path, "rb");
    if (file == nullptr) return false;
    std::string text;
    char buffer[4096];
    for (std::size_t got = 0; (got = std::fread(buffer, 1, sizeof buffer, file)) > 0;) text.append(buffer, got);
    std::fclose(file);
    std::string_view bytes = text;
    return take_packed(bytes, value) && bytes.empty();
}

[[nodiscard]] inline bool write_bytes(const char* path, std::string_view bytes)
{
    std::FILE* file = std::fopen(path, "wb");
    if (file == nullptr) return false;
    const bool good = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
    return std::fclose(file) == 0 && good;
}

} // namespace lagen::detail
