// SPDX-License-Identifier: GPL-2.0-or-later
/// Is this a build with the address sanitizer? Then long series of trials are shorter: what they decide is decided by
/// the other builds, and faults of memory show in a part of them.
#pragma once

#if defined(__SANITIZE_ADDRESS__)
#define LAGEN_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define LAGEN_SANITIZED 1
#endif
#endif
#ifndef LAGEN_SANITIZED
#define LAGEN_SANITIZED 0
#endif
