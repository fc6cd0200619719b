// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <exception>
#include <new>

#include "hooke/base/expected.h"

namespace hooke::volumes {

/// Calls `work`, which returns an Expected, and turns exceptions into errors: OpenVDB reports errors by exceptions.
template <class Work>
auto no_throw(const Work& work) noexcept -> decltype(work()) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return fail(Error::Kind::io, "", "there is not enough memory for it");
  } catch (const std::exception& other) {
    return fail(Error::Kind::io, "", other.what());
  }
}

}  // namespace hooke::volumes
