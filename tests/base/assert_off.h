// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

/// How often two assertions evaluate their expressions and values where assertions are off.
int evaluations_without_assertions();
