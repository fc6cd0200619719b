// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#define HOOKE_ISA portable
#include "hooke/backends/cpu/window_search.inl"
