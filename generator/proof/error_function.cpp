// SPDX-License-Identifier: GPL-2.0-or-later
/// erf in the ring: a generator for every argument up to its sign, with the signs of its argument. No formula takes
/// erf(a + b) apart.
#include "proof/elementary.hpp"
#include "proof/print_fraction.hpp"

#include <arb_hypgeom.h>

namespace lagen::proof {

Fraction Elementary::error_function(const Fraction& a)
{
    if (a.is_zero()) return {};
    if (a.num[0].coefficient < 0) return ring_.negate(error_function(ring_.negate(a)));
    const GeneratorId id = ring_.keyed("erf:" + key_of(a), [&] {
        const Signs signs = ring_.signs(a);
        Range range{End{false, -1, true}, End{false, 1, true}, !signs.zero};
        if (!signs.negative) range.low = End{false, 0, !signs.zero};
        if (!signs.positive) range.high = End{false, 0, !signs.zero};
        const Printed argument = print(ring_, a, longest_generator);
        Generator generator{"erf(" + argument.text + ")", range, 0, {}, -1, false};
        generator.tree = call_of(Function::erf, {argument.tree});
        if (const auto value = ring_.value_of(a)) {
            generator.value = Ball();
            arb_hypgeom_erf(generator.value->get(), value->get(), 256);
        }
        return ring_.add_generator(std::move(generator));
    });
    return ring_.of(id);
}

} // namespace lagen::proof
