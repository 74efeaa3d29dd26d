// SPDX-License-Identifier: GPL-2.0-or-later
/// Nothing is allocated in a step: the number of allocations does not depend on the number of steps.
/// Left out of sanitizer builds, which replace the same operators themselves.
#include "support/sanitized.hpp"
#if !LAGEN_SANITIZED

#include "lagen/ensemble/in_order.hpp"
#include "lagen/lagen.hpp"
#include "runtime/pendulum.hpp"

#include <atomic>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <new>

namespace {

std::size_t allocations = 0;
std::atomic<long> allowed = -1; ///< further allocations; as many as are wanted where it is negative

} // namespace

void* operator new(std::size_t size)
{
    ++allocations;
    if (allowed >= 0 && allowed-- == 0) throw std::bad_alloc();
    if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
    throw std::bad_alloc();
}
void operator delete(void* memory) noexcept
{
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept
{
    std::free(memory);
}

using namespace lagen;
using Pendulum = problems::Pendulum<double>;

TEST_CASE("A longer run allocates no more than a short one")
{
    const auto count = [](const auto& method, double end) {
        // An event that is watched and never crossed: th = 2 is above the amplitude.
        const std::array<EventRequest<double, Pendulum::State>, 1> never{
            {{.when = [](double, const Pendulum::State& s) { return s[0] - 2; }}}};
        const std::size_t before = allocations;
        const auto run = integrate(Pendulum{}, Pendulum::State(1, 0), {0.0, end}, method, {.events = never});
        const std::size_t after = allocations;
        CHECK(run.status() == Status::ok);
        CHECK(run.events.empty());
        return after - before;
    };
    const auto check = [&](const auto& method) { CHECK(count(method, 100.0) == count(method, 1.0)); };
    check(Rk4{.step = 0.01});
    check(Rk4{.step = 0.01, .compensated = true});
    check(Yoshida6{.step = 0.01});
    check(Srkn6{.step = 0.01});
    check(Dopri5{});
    check(Tsit5{});
    check(Dop853{});
    check(Gauss2{.step = 0.01});
    check(Gauss8{.step = 0.01});
    check(Gauss16{.step = 0.01});
    check(Radau3Fixed{.step = 0.01});
    check(Radau5Fixed{.step = 0.01});
    check(Radau5{});
    const std::size_t before = allocations;
    const auto plain = integrate(Pendulum{}, Pendulum::State(1, 0), {0.0, 100.0}, Dop853{});
    const auto implicit = integrate(Pendulum{}, Pendulum::State(1, 0), {0.0, 100.0}, Gauss8{.step = 0.1});
    CHECK(plain.steps > 50);
    CHECK(implicit.steps == 1000);
    CHECK(allocations == before);
}

TEST_CASE("Steps of an Integrator, values inside them, turns and failures allocate nothing")
{
    const auto check = [](const auto& method) {
        const std::size_t before = allocations;
        Integrator integrator(Pendulum{}, Pendulum::State(1, 0), 0, method);
        double sum = 0;
        for (int k = 0; k < 100; ++k) {
            if (integrator.step() != Status::ok) ++sum;
            sum += integrator.at((integrator.t_before() + integrator.t()) / 2)[0];
        }
        if (integrator.advance_to(1) != Status::ok) ++sum;
        if (integrator.advance_to(std::numeric_limits<double>::quiet_NaN()) != Status::invalid_input) ++sum;
        const std::size_t after = allocations;
        CHECK(after == before);
        CHECK(integrator.t() == 1);
        CHECK(std::isfinite(sum));
    };
    check(Euler{.step = 0.01});
    check(Rk4{.step = 0.01});
    check(Rk4{.step = 0.01, .compensated = true});
    check(Yoshida6{.step = 0.01});
    check(Srkn6{.step = 0.01});
    check(Dopri5{});
    check(Tsit5{});
    check(Dop853{});
    check(Gauss8{.step = 0.01});
    check(Gauss16{.step = 0.01});
    check(Radau5{});
}

TEST_CASE("Where there is no memory for another thread, those that are there do all the work")
{
    int begun = 0, delivered = 0;
    struct Piece {
        int number = 0;
    };
    const auto begin = [&](Piece& piece) { return (piece.number = begun) < 100 && ++begun > 0; };
    const auto work = [](auto& source) {
        while (Piece* piece = source.next(true)) {
            piece->number *= 2;
            source.done(*piece);
        }
    };
    const auto deliver = [&](Piece& piece) {
        if (piece.number == 2 * delivered) ++delivered;
    };
    // None for a thread; none for the second one, while the first one works.
    for (const long enough : {0, 1, 2, 3}) {
        begun = delivered = 0;
        detail::InOrder<Piece, decltype(begin), decltype(work), decltype(deliver)> pieces(8, begin, work, deliver);
        allowed = enough;
        std::exception_ptr thrown;
        try {
            pieces.run(4);
        } catch (...) {
            thrown = std::current_exception();
        }
        allowed = -1;
        CHECK(thrown == nullptr);
        CHECK(delivered == 100);
    }
}

TEST_CASE("A lambda is called without an allocation, and a dense solution allocates outside of the steps alone")
{
    const auto model = ode<2>([](double, const auto& s, auto& ds) {
        ds[0] = s[1];
        ds[1] = -s[0];
    });
    const std::size_t before = allocations;
    const auto plain = integrate(model, Eigen::Vector2d(1, 0), {0.0, 100.0}, Rk4{.step = 0.01});
    CHECK(allocations == before);
    CHECK(plain.steps == 10000);
    const auto dense = integrate(model, Eigen::Vector2d(1, 0), {0.0, 100.0}, Rk4{.step = 0.01}, {.dense = true});
    CHECK(allocations - before < 100); // vectors that double
    CHECK(dense.solution.times().size() == 10001);
}

#endif
