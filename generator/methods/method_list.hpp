// SPDX-License-Identifier: GPL-2.0-or-later
/// The methods of this room by the names of their types; a file a family.
#pragma once

#include "lagen/taylor.hpp"

#include "methods/any_stepper.hpp"
#include "methods/integrate_compiled.hpp"

#include <span>
#include <variant>

namespace lagen {

/// Taylor's method has a loop over steps of its own: it is the one that knows where events change their signs, foresees
/// its lengths and has dense output of order 30.
struct ListedMethod {
    const char* type;
    std::variant<AnyAdaptive, AnyFixed, Taylor> method;
    KernelsAsked asks{};
};

[[nodiscard]] std::span<const ListedMethod> fixed_step_methods();
[[nodiscard]] std::span<const ListedMethod> pair_methods();
[[nodiscard]] std::span<const ListedMethod> verner_methods();
[[nodiscard]] std::span<const ListedMethod> nystrom_methods();
[[nodiscard]] std::span<const ListedMethod> implicit_methods();
[[nodiscard]] std::span<const ListedMethod> splitting_methods();
[[nodiscard]] std::span<const ListedMethod> taylor_methods();

} // namespace lagen
