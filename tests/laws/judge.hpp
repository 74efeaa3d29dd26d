// SPDX-License-Identifier: GPL-2.0-or-later
/// What `verify` says of a model text, and whether that is so.
#pragma once

#include "oracle.hpp"
#include "support/stages.hpp"

namespace lagen::laws {

struct Answer {
    std::string verdict;     ///< valid, invalid, undecided, or the text of an exception
    std::string reason;      ///< of undecided: the first evidence, numbers taken out
    double milliseconds = 0; ///< processor time of reading and verifying
    std::vector<Check> refuted;
    WrittenAlgebroid algebroid; ///< as lagen built it
};

/// Reads and verifies the text.
[[nodiscard]] Answer answer_of(const std::string& text);

/// What is wrong with the witnesses of an answer by the oracle's own values, or empty. A witness is looked at where
/// it is an exact point of the constraint set.
[[nodiscard]] std::string witness_fault(const LocalAlgebroid& algebroid, const Answer& answer);

} // namespace lagen::laws
