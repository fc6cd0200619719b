// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "hooke/io/hdf5.h"

namespace hooke::io::hdf5 {

/// File access properties that make HDF5 keep a file's bytes in `bytes`, which must outlive the file.
Handle access_through(JournaledFile& bytes);

/// The errno of the first read that failed in the file of an object; 0 if none did.
int read_error_of(hid_t object);

}  // namespace hooke::io::hdf5
