// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#define HOOKE_ISA avx2
#define HOOKE_REAL double
#include "hooke/backends/cpu/tile_pass.inl"
