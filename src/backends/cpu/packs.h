// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

// The packs of the instruction set that a file is compiled for: HOOKE_ISA names it, HOOKE_ONE_LANE picks the pack of
// one lane. Rules of inclusion as in pack.h.

#if defined(HOOKE_ONE_LANE)
#include "hooke/backends/cpu/lane_sums.h"
#include "hooke/passes/pack_lane.h"
#else
#include "hooke/backends/cpu/pack_attraction.h"
#include "hooke/backends/cpu/pack_records.h"
#include "hooke/backends/cpu/pack_sums.h"
#endif
