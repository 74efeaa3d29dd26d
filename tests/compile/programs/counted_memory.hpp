// SPDX-License-Identifier: GPL-2.0-or-later
/// For programs that run a compiled model beside its class: how often memory was taken, and whether numbers have the
/// same bits. It stands before every header of Eigen.
#pragma once

#define EIGEN_RUNTIME_NO_MALLOC
#include "lagen/compiled_model.hpp"
#include "lagen/integrate.hpp"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <new>

namespace {

std::size_t allocations = 0;

} // namespace

[[gnu::noinline]] void* operator new(std::size_t size)
{
    ++allocations;
    if (void* memory = std::malloc(size)) return memory;
    throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept
{
    std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept
{
    std::free(memory);
}

namespace {

[[maybe_unused]] bool same_bits(const auto& a, const auto& b)
{
    return a.size() == b.size() &&
           std::memcmp(a.data(), b.data(), static_cast<std::size_t>(a.size()) * sizeof(double)) == 0;
}

/// The number of times that 100 steps behind the first one take memory; Eigen's own are an assertion.
template <class Method>
std::size_t memory_of_steps(const lagen::CompiledModel& model, const Eigen::VectorXd& s, const Method& method,
                            bool& good)
{
    lagen::Integrator integrator(model, s, 0.0, method);
    (void)integrator.step();
    const std::size_t before = allocations;
    Eigen::internal::set_is_malloc_allowed(false);
    good = true;
    for (int k = 0; k < 100 && good; ++k) good = integrator.step() == lagen::Status::ok;
    Eigen::internal::set_is_malloc_allowed(true);
    return allocations - before;
}

} // namespace
