// SPDX-License-Identifier: GPL-2.0-or-later
/// The methods of this room by the names of their types; a file a family.
#pragma once

#include "methods/any_stepper.hpp"
#include "methods/integrate_compiled.hpp"

#include <span>
#include <variant>

namespace lagen {

struct ListedMethod {
    const char* type;
    std::variant<AnyAdaptive, AnyFixed> method;
    KernelsAsked asks{};
};

[[nodiscard]] std::span<const ListedMethod> fixed_step_methods();
[[nodiscard]] std::span<const ListedMethod> pair_methods();
[[nodiscard]] std::span<const ListedMethod> verner_methods();
[[nodiscard]] std::span<const ListedMethod> nystrom_methods();
[[nodiscard]] std::span<const ListedMethod> implicit_methods();

} // namespace lagen
