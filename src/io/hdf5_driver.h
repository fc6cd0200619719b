// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/io/hdf5.h"

namespace hooke::hdf5 {

/// File access properties that make HDF5 keep a file's bytes in `bytes`, which must outlive the file.
Handle access_through(JournaledFile& bytes);

}  // namespace hooke::hdf5
