// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#define HOOKE_ISA scalar
#define HOOKE_ONE_LANE
#include "hooke/backends/cpu/work_pass.inl"
