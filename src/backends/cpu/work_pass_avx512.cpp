// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#define HOOKE_ISA avx512
#include "hooke/backends/cpu/work_pass.inl"
