// SPDX-License-Identifier: GPL-2.0-or-later
/// The families of random algebroids, each valid by construction.
#pragma once

#include "local_algebroid.hpp"

#include <functional>

namespace lagen::laws {

/// An algebroid; and where its kind has a notation of its own, the part from which that notation builds it.
struct Specimen {
    LocalAlgebroid algebroid;
    LocalAlgebroid part;                                        ///< what own_kind starts from
    std::function<std::string(const LocalAlgebroid&)> own_kind; ///< a whole model text of a part; may be absent
    bool part_decides = true;                                   ///< whether the model is invalid where the part is
};

struct AlgebroidFamily {
    std::string name;
    std::function<Specimen(Dice&)> build;
};

[[nodiscard]] const std::vector<AlgebroidFamily>& algebroid_families();

} // namespace lagen::laws
