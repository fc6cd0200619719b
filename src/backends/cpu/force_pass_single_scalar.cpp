// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#define HOOKE_ISA scalar
#define HOOKE_ONE_LANE
#define HOOKE_REAL float
#include "hooke/backends/cpu/tile_pass.inl"
