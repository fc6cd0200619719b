// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#define HOOKE_ISA avx512
#include "hooke/backends/cpu/window_search.inl"
